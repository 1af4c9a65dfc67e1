/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file texture.h  The command texture: what it works on, and what its files make of that. */
#ifndef TEXTURE_CMD_TEXTURE_TEXTURE_H
#define TEXTURE_CMD_TEXTURE_TEXTURE_H

#include "report/report.h"
#include "texture/cmd_texture/request.h"
#include "texture/frame.h"
#include "texture/metric.h"
#include "texture/recognise.h"

/* ---- The image, its format and mapping, the camera --------------------------------------------------------------- */

/** How a name came about. */
typedef enum texture_origin { ORIGIN_GIVEN = 0, ORIGIN_FOUND, ORIGIN_ASSUMED } texture_origin;

/** How the pixel that is named would be read otherwise. */
typedef struct texture_reading {
    const char *what; /**< "mapping" or "format" */
    const char *name;
    double z; /**< eye depth; NaN where it has none */
} texture_reading;

enum { READINGS_MAX = 8, READINGS_SIZE = 512 };

/** The projection matrix of --matrix. */
typedef struct texture_matrix {
    const char *path; /**< null: none of 16 numbers */
    dp_projection taken;
    bool oblique;
    double fov[2];     /**< degrees, across and up; NaN where it is orthographic */
    double edges[4];   /**< left, right, bottom, top: slopes, or scene units where it is orthographic */
    const char *looks; /**< "+z", "-z" */
} texture_matrix;

typedef struct texture_source {
    const char *path; /**< null for a synthetic image */
    image picture;
    dp_recognised found;
    char why[RECOGNISE_WHY_SIZE];
    texture_origin format_from, mapping_from, direction_from, metric_from;
    image_type type; /**< of the file, where --metric has changed the picture's */
    uint32_t channels;
    metric metric;              /**< with --metric */
    moved moved;                /**< what the samples show of their bits; nothing where --metric has said it */
    unpacked unpacked;          /**< with --packing */
    bool noted;                 /**< the file itself says its mapping */
    char note[IMAGE_NOTE_SIZE]; /**< its words, which options may point to */
    grain grain;                /**< of an image */
    size_t reading_count;       /**< 0 where nothing is assumed that would be read otherwise */
    texture_reading readings[READINGS_MAX];
    uint32_t column, row; /**< the pixel of the readings */
    dp_setup planes;      /**< with --metric: what --near and --far say */
    double parameters[PARAMETERS_MAX];
    texture_matrix matrix;
    double fov_y; /**< degrees; read where there is no matrix, and no orthographic camera */
    dp_setup setup;
    texture_camera camera, last; /**< last frame's: where an effect needs it */
    image colours;               /**< of --picture */
    frame_normals normals;       /**< where an effect needs them that no synthetic image has */
    frame frame;                 /**< points into this struct, which must stay where it is */
} texture_source;

/** "given", "found", "assumed". */
const char *texture_origin_name(texture_origin origin);

/**
 * Reads the image, or prepares a synthetic one; texture_source_close() frees it. What a file of ours says of itself and
 * was not given is filled into the options. @return an exit status, after one line on stderr
 */
int texture_source_open(texture_request *o, texture_source *out);
void texture_source_close(texture_source *s);

/** Options of window depth that are given beside samples that are none: before a file is read, and again when it has
 * said what its samples are. @return an exit status, after one line on stderr */
int texture_window_check(const texture_request *o);

/** Reads the file: its picture, in the unit, the channel and the packing that are given, or that it says; what was
 * found of its samples. @return as above */
int texture_image_read(texture_request *o, texture_source *s);

/** Reads the text of --lattice or --as, a sensor by name, in the unit of a scene, metres where that is open; NaN for
 * what it leaves out, no row where the text is null. @return an exit status, after one line on stderr */
int texture_lattice(const unit_row *unit, const char *id, const char *text, sensor *out);

/** One line on stderr where the image contradicts it. */
void texture_lattice_warn(const texture_request *o, const texture_source *s);

/** Whether something says where far is, which metric depth does not need. */
bool texture_far_known(const texture_request *o);

/** Whether the image holds window depths, which have a format and a mapping. */
bool texture_is_window(const texture_request *o);

/**
 * Reads what an image does not say: fills in grain, how the samples were rounded, which is said in `why` of what was
 * found, and the readings of a pixel. One line on stderr about what is assumed, if anything is.
 */
void texture_read_on(const texture_request *o, texture_source *s);

/** Whether the samples are coarser than the format, and not by its own steps. */
bool texture_coarser(const texture_source *s);

/** Whether its samples may be metric depth, or disparity: whole numbers with holes at 0, or numbers above 1. */
bool texture_may_be_metric(const texture_source *s);

/** A sentence about the pixels that hold 0 of a packing that wraps. @return out */
const char *texture_zeros_of(const texture_request *o, const texture_source *s, char out[READINGS_SIZE]);

/** "320,180 is at z = 4.2 as d3d, 0.4 as reversed", of "mapping" or "format"; "" where it has none. @return out */
const char *texture_readings_of(const texture_source *s, const char *what, char out[READINGS_SIZE]);

/**
 * Sets one --parameter of a synthetic image or an effect, called `whose`.
 * @param unused  parameters of this use count as none: PARAMETER_ALWAYS for none of them
 * @return EXIT_FINE, or EXIT_USAGE after one line that names those it has
 */
int texture_parameter_set(const char *whose, const texture_parameter *list, const named_number *given,
                          parameter_use unused, double *out);

/** Options of cameras that have no meaning beside others. @return an exit status, after one line on stderr */
int texture_camera_check(const texture_request *o);

/** Puts it at --eye, and turns it to --look. @return as texture_camera_check() */
int texture_camera_place(const texture_request *o, camera_spec *spec);

/** Last frame's camera: as `now`, but for what --last-eye and --last-look say. @return as texture_camera_check() */
int texture_last_camera(const texture_request *o, const dp_setup *setup, const camera_spec *now, texture_camera *out);

/** Takes --matrix apart, once the image has said its mapping: planes and mapping into the camera, the rest into
 * s->matrix.
 *  @return an exit status, after one line on stderr */
int texture_matrix_open(texture_request *o, texture_source *s);

/** The frustum of four tangents; planes are not its matter. */
void texture_tangents_take(const camera_matrix *m, texture_matrix *t);

/** The frustum of --intrinsics, in a picture of such a size; planes are not its matter. */
void texture_intrinsics_take(const double intrinsics[4], const double size[2], texture_matrix *t);

/** For a report: its lines, and its columns, of a texture_matrix. */
void texture_matrix_say(const texture_matrix *t, page *p);
extern const column texture_matrix_columns[];

/** Does the synthetic image have a parameter of this name? Then parameters not taken are the effect's. */
bool texture_scene_takes(const texture_request *o, const char *name);

/* ---- What --product makes: an image of numbers, or a figure ------------------------ */

enum { PRODUCT_NAME_SIZE = 96 };

typedef struct texture_product {
    frame_product made;
    frame_product error; /**< of it, for the file of --error-map */
    double settings[PARAMETERS_MAX];
    sensor as;                        /**< with --as */
    char name[PRODUCT_NAME_SIZE];     /**< "normals by high, error" */
    const char *unit, *unit_of_error; /**< "scene units", "degrees", "levels of 1/255", "" */
} texture_product;

/** Is one asked for? --pixel describes an effect instead. */
bool texture_product_wanted(const texture_request *o);

/** The normals of an effect that needs some: of --product, those of the packing, else by projective.
 *  @return an exit status, after one line on stderr */
int texture_effect_normals(const texture_request *o, texture_source *s);

/** Reads the picture that an effect is composed on: PNG, of the image's size. @return as above */
int texture_picture_open(const texture_request *o, texture_source *s);

/** The effect of --product, its parameters and reference, as above. */
int texture_product_effect(const texture_request *o, texture_product *out);

/** Names and combinations, before anything is read. @return an exit status, after one line on stderr */
int texture_product_resolve(const texture_request *o, texture_product *out);

/** Whether it can be made of this source, likewise. */
int texture_product_check(const texture_request *o, const texture_source *s, texture_product *p);

/** Writes the file of -o. */
int texture_product_write(const texture_request *o, const texture_source *s, const texture_product *p);

/** Options that have no meaning beside --product pack and packed-normal are refused. @return an exit status */
int texture_pack_check(const texture_request *o);

/** Writes the depths to the file of -o as --product pack:NAME says. */
int texture_pack_write(const texture_request *o, const texture_source *s);

/** Writes the normals that the image holds beside its depths. */
int texture_packed_normal_write(const texture_request *o, const texture_source *s);

/** Codes of a format as a depth image of the camera's size, to the file of -o: integers or floats as the format has
 *  them. Null: those of a synthetic image, of its format. */
int texture_depth_write(const texture_request *o, const texture_source *s, const dp_format *format,
                        const uint32_t *codes);

/** --hi-z: what has no meaning beside it; and the level, to the file of -o, whose size the source then has.
 *  @return an exit status */
int texture_hi_z_check(const texture_request *o);
int texture_hi_z_write(const texture_request *o, texture_source *s);

/** Draws the file of --figure. */
int texture_figure_draw(const texture_request *o, const texture_source *s, const texture_product *p);

/** Draws the file of --histogram. */
int texture_histogram_draw(const texture_request *o, const texture_source *s);

/* ---- Reports ----------------------------------------------------------------------------------------------------- */

/** The statistics of a depth image: text, JSON, CSV. @return an exit status */
int texture_report_write(const texture_request *o, const texture_source *source);

/** Whether the pixels of --pixel lie in so many. @return an exit status, after one line on stderr */
int texture_pixels_check(const texture_request *o, uint32_t width, uint32_t height);

/** Writes the pixels of --pixel, likewise; `effect` is the effect of --product beside it, or null. */
int texture_pixel_write(const texture_request *o, const texture_source *source, const frame_product *effect);

/** The effect that --product names, and its parameters, in an image or not. @return EXIT_FINE, or EXIT_USAGE after one
 *  line on stderr */
int texture_effect_resolve(const texture_request *o, bool pictured, const effect_row **row,
                           double parameters[PARAMETERS_MAX]);

/** An effect without an image: for each set-up and depth, the error in levels and the usable values of the wanted
 *  parameter. @return an exit status */
int texture_effect_table(const texture_request *o);

#endif
