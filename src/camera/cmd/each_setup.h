/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file each_setup.h  A report of depths, one after the other, in each set-up: what such commands share.
 *
 *     typedef struct table { each_setup each; row row; } table;  // `each` stands first
 *     int status = each_setup_start(&t.each, &o->camera, &o->out);                 // set-ups and depths
 *     each_setup_write(&t.each, &spec, status);                  // its lists ask each_setup_go(), each_setup_depth()
 */
#ifndef CAMERA_CMD_EACH_SETUP_H
#define CAMERA_CMD_EACH_SETUP_H

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "cli/output/output.h"
#include "cli/progress.h"

typedef struct each_setup {
    const camera_asked *camera;
    const output_asked *how;
    size_t rows; /**< how many depths where --at names none; 0: nine */
    setups all;
    const camera_asked *here; /**< that of the set-up at hand, see camera_of() */
    depths at;                /**< of the set-up at hand, before there is one of the first */
    output out;
    progress progress;
    uint64_t done;
    const dp_setup *setup; /**< the one at hand */
    setup_fields fields;
    slant_fields slant;
    const slant_fields *triangles; /**< null: surfaces face the camera */
    dp_setup full, slanted;        /**< dp_setup_guaranteed() of those that do, and of any that are asked about */
    dp_setup assumed;              /**< and, where none are, of those of camera_assumed(); without a viewport: none */
} each_setup;

/** Conditions of columns that each_setup_write() knows: several depth ranges, or several presets, were asked about. */
enum { EACH_OF_RANGES = 1 << 30, EACH_OF_PRESETS = 1 << 29 };

/** Columns that tell the set-ups of a report apart in CSV, beside setup_columns: before the rows, and behind them. */
#define EACH_RANGE_COLUMNS(type)                                                                                       \
    {FIELD(type, each.full.spec.depth_range[0], "depth_range_lo", ""), .only = AS_CSV, .when = EACH_OF_RANGES}, {      \
        FIELD(type, each.full.spec.depth_range[1], "depth_range_hi", ""), .only = AS_CSV, .when = EACH_OF_RANGES       \
    }
#define EACH_PRESET_COLUMNS(type)                                                                                      \
    {FIELD(type, each.fields.preset, "preset", ""), .only = AS_CSV, .when = EACH_OF_PRESETS}, {                        \
        FIELD(type, each.fields.unit, "unit", ""), .only = AS_CSV, .when = EACH_OF_PRESETS                             \
    }

/** The guaranteed separation of surfaces, scene units. */
typedef struct guarantee {
    double facing;
    double slanted; /**< at any slant that is asked about; NaN without triangles, or a pipeline */
    bool certain;   /**< the facing one ends before far */
} guarantee;

/** Resolves set-ups and depths. @return an exit status, after one line on stderr */
int each_setup_start(each_setup *w, const camera_asked *camera, const output_asked *how);

/**
 * Writes the report where `status` is EXIT_FINE, says on stderr what binary32 clipping loses, and frees what
 * each_setup_start() made in any case.
 * @return an exit status
 */
int each_setup_write(each_setup *w, const report_spec *spec, int status);

/** Goes to set-up i. @return false behind the last */
bool each_setup_go(each_setup *w, size_t i);

/** Goes to depth i, each in turn. @return false behind the last, and where nothing more can be written */
bool each_setup_depth(each_setup *w, size_t i, double *z);

/** In the set-up at hand. */
guarantee each_setup_guarantee(const each_setup *w, double z);

/** Whether surfaces at a slant have one. */
bool each_setup_slanted(const each_setup *w);

/** Writes text above a set-up: for reports whose item begins with an each_setup. */
void each_setup_title(page *p, void *item);

#endif
