/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a requirement file, each checked where it is read; the pieces that requirement.c puts together. */
#ifndef SOLVE_READER_H
#define SOLVE_READER_H

#include "camera/presets.h"
#include "camera/rules.h"
#include "camera/unit.h"
#include "solve/requirement.h"
#include "solve/setting.h"

typedef struct reader {
    need_file *file;
    need_error *error;
    const unit_row *unit; /* of a scene unit; null when the file does not say */
    char shown[80];
} reader;

/* Bits for lengths other than finite ones of at least 0; of any sign, they are finite or infinite. */
enum { READER_POSITIVE = 1 << 0, READER_INFINITE = 1 << 1, READER_SIGNED = 1 << 2 };

/* Notes what is wrong and where; s may be null. @return false */
bool reader_fail(reader *r, const setting *s, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* The same of a fault of a camera: at its key, or else at the preset, which then chose the value, or the group. */
bool reader_fault(reader *r, const setting *group, const preset *of, const camera_fault *fault);

/* Adds a name to those that would have been known in place of `given`. */
void reader_known(reader *r, const char *given, const char *name);

/* A value as messages show it: "'text'", "12", "a group". */
const char *reader_shown(reader *r, const setting *s);

/* found[i] = the setting names[i] of a group, or null; any other setting in it is an error. names ends with null. */
bool reader_keys(reader *r, const setting *group, const char *what, const char *const *names, setting **found);

bool reader_string(reader *r, const setting *s, const char **out);
/* The name of a row, or of that which a profile has under `key`, a file beside the requirement file: its GPU is
 * then added to the camera's. `known` says whether a row has that name; one that the file spells out is not asked for.
 */
bool reader_row(reader *r, const setting *s, const char *key, bool (*known)(const char *name), need_camera *camera,
                char name[PROFILE_NAME_SIZE]);
bool reader_name(reader *r, const setting *s, const char *name); /* fit for a line of a report */
bool reader_unit(reader *r, const setting *s);
bool reader_length(reader *r, const setting *s, const char *key, unsigned allowed, double *out);
/* A number from `least` to `most`, in no unit; says nothing where it is not. */
bool reader_number_within(const setting *s, double least, double most, double *out);

bool reader_share(reader *r, const setting *s, const char *key, double *out);

/* The keys of slanted triangles, in the order in which they are read. */
enum { VIEW_VIEWPORT, VIEW_FOV, VIEW_HFOV, VIEW_RASTER, VIEW_SUBPIXEL, VIEW_SLANT, VIEW_TRIANGLE, VIEW_COUNT };
#define VIEW_KEYS "viewport", "fov", "hfov", "raster", "subpixel", "slant", "triangle"

/* The triangles of a specification, by those that were found; what of them is not, a preset may say, or null. */
bool reader_view(reader *r, const setting *group, setting *const found[VIEW_COUNT], const preset *of,
                 need_camera *camera, dp_spec *spec);

bool reader_camera(reader *r, setting *group, need_camera *out);

#endif
