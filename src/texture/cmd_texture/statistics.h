/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file statistics.h  The statistics of an image: what is measured, and what text says of them. */
#ifndef TEXTURE_CMD_TEXTURE_STATISTICS_H
#define TEXTURE_CMD_TEXTURE_STATISTICS_H

#include "camera/cmd/setups.h"
#include "texture/cmd_texture/texture.h"
#include "texture/sensor_buffer.h"
#include "texture/survey.h"
#include "texture/units.h"

enum { ERRORS_MAX = 32 };

/** How far a product is off over all pixels; see frame_product. */
typedef struct error_line {
    char name[48]; /* "eye depth", "normal high" */
    const char *unit;
    frame_summary sum;
    uint64_t masked;
    double most; /* of all: INFINITY where some have no bound, */
    char at[64]; /* and the pixel, or how many these are, and the unit */
} error_line;

/** The lattice of metric depth as it is printed. */
typedef struct lattice_fields {
    const char *name, *from, *other, *like;
    double step, step_error, offset, offset_error, before, constant, levels, bits, off_pixels, residual;
} lattice_fields;

/** How far apart its levels are, scene units. */
typedef struct lattice_gap {
    double z, gap;
} lattice_gap;

/** The statistics; what does not exist is null or NaN. Below `named`, the items of lists at hand. */
typedef struct statistics {
    const texture_request *o;
    texture_source source;
    survey survey;
    survey_pairs pairs;
    double condition; /* of the view-projection matrix, 2-norm; NaN where the mapping has none */
    size_t error_count;
    error_line errors[ERRORS_MAX];
    lattice_fields lattice;
    lattice_gap gap;
    sensor_buffer buffer;
    stereo_spec stereo;
    setup_fields setup;
    struct {
        const char *synthetic, *truth, *packing, *type, *channel, *rounded, *format, *format_from, *mapping_from,
            *direction_from, *metric_from, *moved, *moved_from;
        double metric, radial, step, pixels, steps, steps_or, bits, fov, half_height;
        bool coarser, certain;
        const bool *reversed;
        const survey_pairs *pairs;
        const sensor_buffer *buffer;
        uint64_t hidden;
    } named;
    const char *parameter;
    double parameter_value;
    texture_reading reading;
    unit_reading unit;
    survey_band band;
    double band_steps;
} statistics;

static inline bool statistics_of_image(const statistics *r) {
    return r->source.path != NULL;
}

/** The parameters of the synthetic image, an item after the other. */
void *statistics_next_parameter(void *of, size_t i);

/** Fills in `lattice`; how far apart its levels are at 1, 2, 5 and 10, an item after the other. */
void statistics_name_lattice(statistics *r);
void *statistics_next_gap(void *of, size_t i);

/** Above the bands, and below them. */
void statistics_say_head(page *p, void *item);
void statistics_say_geometry(page *p, void *item);

#endif
