/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a requirement file, each checked where it is read; the pieces that requirement.c puts together. */
#ifndef SOLVE_READER_H
#define SOLVE_READER_H

#include "camera/make.h"
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

/* The same of the file that a setting names, by a number of errno. */
bool reader_unreadable(reader *r, const setting *s, int number);

/* The same of a fault of a camera: at its key, or else at the preset, which then chose the value, or the group. */
bool reader_fault(reader *r, const setting *group, const preset *of, const camera_fault *fault);

/* Adds a name to those that would have been known in place of `given`. */
void reader_known(reader *r, const char *given, const char *name);

/* A value as messages show it: "'text'", "12", "a group". */
const char *reader_shown(reader *r, const setting *s);

/* found[i] = the setting names[i] of a group, or null; any other setting in it is an error. names ends with null. */
bool reader_keys(reader *r, const setting *group, const char *what, const char *const *names, setting **found);

bool reader_string(reader *r, const setting *s, const char **out);
/* The path of a file beside the requirement file; an absolute one stays. @return out */
enum { READER_PATH_SIZE = 4096 };
const char *reader_path(const reader *r, const char *name, char out[READER_PATH_SIZE]);

/* The name that a profile, a file beside the requirement file, has in place of one. */
bool reader_profile(reader *r, const setting *s, camera_key key, camera_said *c, char name[PROFILE_NAME_SIZE]);
bool reader_name(reader *r, const setting *s, const char *name); /* fit for a line of a report */
bool reader_unit(reader *r, const setting *s);
bool reader_length(reader *r, const setting *s, const char *key, unsigned allowed, double *out);
/* A number from `least` to `most`, in no unit; says nothing where it is not. */
bool reader_number_within(const setting *s, double least, double most, double *out);

bool reader_share(reader *r, const setting *s, const char *key, double *out);

/* Reads what a key of a camera says. */
typedef bool reader_key(reader *r, setting *s, camera_said *c);
reader_key reader_depth_range, reader_viewport, reader_angle, reader_subpixel, reader_slant, reader_class;

bool reader_camera(reader *r, setting *group, need_camera *out);

#endif
