/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file setups.h  From options to set-ups: every format with every mapping, checked, named, and clipped. */
#ifndef CAMERA_CMD_SETUPS_H
#define CAMERA_CMD_SETUPS_H

#include <stddef.h>

#include "camera/cmd/camera.h"
#include "report/report.h"

typedef struct setups {
    dp_setup *items;
    size_t *cameras; /**< the camera of each, see camera_of() */
    size_t count;
} setups;

/**
 * Expands formats x mappings of each camera, format-major in the order given (fp16 d3d, fp16 reversed, fp32 d3d, ...),
 * each in all of its depth ranges, and checks each with dp_setup_init(); where only budgets are asked for, those of
 * logarithmic mappings are in the model exact, for they have no codes in binary32. depth24plus stands for two formats,
 * so it gives two set-ups per mapping.
 *
 * @return EXIT_FINE, or EXIT_USAGE after one line on stderr that names the option at fault
 */
int setups_make(const camera_asked *c, setups *out);

/** The same in the model float, whatever --model is. */
int setups_make_float(const camera_asked *c, setups *out);

void setups_release(setups *s);

/** Whether one of them has a logarithmic mapping. */
bool setups_have_log(const setups *all);

/** Says why a set-up cannot be made, by the option at fault; near and the like are in their ranges. @return EXIT_USAGE
 */
int setup_refused(const camera_asked *c, const dp_spec *spec, dp_status status);

/** The same of a format that a GPU's profile does not store, or that a rasterizer draws without a bound:
 * camera_keeps().
 * @return EXIT_FINE or EXIT_USAGE */
int setup_kept(const camera_asked *c, const dp_format *format);

/**
 * Refuses a platform that stores one of two formats, as the device has it, where neither was named and one is wanted.
 * @return EXIT_FINE or EXIT_USAGE
 */
int setup_decided(const camera_asked *c);

/** The room that setup_label() and setup_range() need, with the terminating null. */
enum { SETUP_LABEL_SIZE = 240, SETUP_RANGE_SIZE = 80 };

/**
 * One line about a set-up for legends and headers, "unorm24 d3d", and, where `full`, the rest as well:
 * "unorm24 d3d, near 0.1, far 1000, perspective, nearest, exact". @return out
 */
const char *setup_label(const dp_setup *setup, bool full, char out[SETUP_LABEL_SIZE]);

/** A depth range, as a specification has it. */
typedef struct setup_depths {
    double lo, hi;
} setup_depths;

/** That of a specification; null where it is 0 to 1. */
const setup_depths *setup_ends(const dp_spec *spec);

extern const column setup_end_columns[];

/**
 * The fields that name a set-up in JSON and CSV: near, far, projection, mapping, format, rounding, model. In JSON
 * `arith` follows where the model is float, `log_c` where the mapping is log, the depth range where it is not 0 to 1,
 * and the unit, null where nothing says it.
 */
typedef struct setup_fields {
    double znear, zfar, log_c; /**< log_c is NaN unless the mapping is log */
    const char *projection, *mapping, *format, *rounding, *model;
    const char *arith;        /**< null unless the model is float */
    const char *unit;         /**< what a scene unit is; null where nothing says it */
    const char *preset;       /**< null where there are not several */
    const setup_depths *ends; /**< the viewport's depth range; null where it is 0 to 1 */
    const dp_planes *planes;  /**< what near and far may be, where a matrix was rounded; else null */
} setup_fields;

extern const column setup_columns[];

/** Points into the set-up, which must stay where it is. The unit is that of its lengths, or null. */
setup_fields setup_fields_of(const dp_setup *setup, const char *unit);

/** The same of a camera that was asked for: its unit, and what its matrix leaves open of the planes. */
setup_fields setup_fields_asked(const dp_setup *setup, const camera_asked *c);

/** Near and far of them, to the digits that a matrix carries. */
number_text setup_near(const setup_fields *f);
number_text setup_far(const setup_fields *f);

/** ", depth range 0:0.1", or "" where it is 0 to 1. @return out */
const char *setup_range(const setup_fields *f, char out[SETUP_RANGE_SIZE]);

/** " --depth-range 0:0.1", or "" where it is 0 to 1. @return out */
const char *setup_range_option(const dp_spec *spec, char out[SETUP_RANGE_SIZE]);

/** Whether set-up i is the one before it in another depth range. */
bool setup_repeats(const setups *all, size_t i);

/** " 0:0.1", where several ranges were asked for; else "". @return out */
const char *setup_slice(const camera_asked *c, const dp_setup *setup, char out[SETUP_RANGE_SIZE]);

/** The model of its separations: a shader's are in binary32, too. */
dp_model setup_model(const dp_setup *setup);

/** The same of a budget: that of a logarithmic mapping is of binary32 arithmetic, too, though it has no codes there. */
void setup_fields_budget(const dp_setup *setup, setup_fields *fields);

/** The label as such fields have model and arithmetic. @return out */
const char *setup_label_as(const dp_setup *setup, const setup_fields *fields, char out[SETUP_LABEL_SIZE]);

/** Tells a page the unit of a camera's lengths, and those that were asked for as they were written. */
void camera_page(page *p, const camera_asked *c);

/** The eye depth of what a preset that computes its planes looks at, scene units; NaN where none is known. */
double camera_focus(const camera_asked *c);

/** Writes it below a title. */
void camera_say_focus(page *p, const camera_asked *c);

/** Writes a set-up's label and unit, which is that of the page from here on, and what its planes may be. */
void setup_title(page *p, const dp_setup *setup, const setup_fields *fields);

/** The line that says what the planes may be, where a matrix leaves them open. */
void setup_say_planes(page *p, const setup_fields *fields);

/** The line that prints the code of a camera; nothing of one without a projection matrix, or orthographic. */
void setup_say_code(page *p, const dp_spec *spec);

/** Explains rg, where dp_format_is_rg(). */
#define RG_NOTE                                                                                                        \
    "rg is depth of Unity's DepthNormals, eye depth over far. Far itself becomes 0 by frac, and reads as the camera."

/** The depths between the planes that binary32 clipping draws. */
typedef struct clipping {
    double znear, zfar; /**< the effective planes; both NaN when nothing is drawn, or there is no pipeline */
    bool loses;         /**< depths that binary32 has between the planes are not drawn */
} clipping;

/** The clipping of a set-up of the model float; NaN and false for the others. */
clipping clipping_of(const dp_setup *setup);

/** A line on stderr: what clipping keeps, these planes and `rest` behind them, or nothing where znear is NaN. */
void clipping_say(const dp_setup *setup, double znear, double zfar, const char *rest);

/** The same for each set-up that loses geometry. */
void clipping_warn(const setups *all);

#endif
