/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file rows.h  The option table, from which reading, help and completion are made, and how options are read.
 *
 * An option is an enumerator and a field of options.h, a row here, and a use by each command that takes it (uses.h).
 * Its kind is the function that reads its argument into the field. Only what is a language of its own (lists, depths,
 * sizes) has a function of its own.
 */
#ifndef CLI_OPTION_ROWS_H
#define CLI_OPTION_ROWS_H

#include "cli/option/names.h"
#include "cli/option/options.h"

struct option_row;

/** Reads an argument of the option of that row. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
typedef int option_parser(options *o, const struct option_row *row, const char *value);

typedef struct option_row {
    const char *name;       /**< long name without dashes */
    char letter;            /**< short name, 0 when there is none */
    const char *argument;   /**< how help writes the argument, "Z"; null when there is none, or one of `names` */
    const char *help;       /**< what it does; @ stands for the names, limits and default follow */
    option_parser *parse;   /**< null for --help and --version */
    size_t place, size;     /**< of the field in `options` */
    double least, most;     /**< of a number; least alone is the form of a parse_form */
    const char *unit;       /**< of a number; null when it has none */
    const name_list *names; /**< what it may be; null when it is no name */
    const char *standard;   /**< the default, as a user would write it; null when there is none */
    const char *without;    /**< what the default means, or holds without the option; or null */
    const char *instead;    /**< what a command that does not take it may be meant to have; or null */
    const char *optional;   /**< an argument that may be left out, and is written behind "=": "FILE"; else null */
    bool repeats;           /**< it may be given several times */
    const char *group;      /**< the heading above this row and those behind it; null where the one before goes on */
} option_row;

/** Index: option_id. */
extern const option_row option_rows[OPTION_COUNT];

enum { OPTION_TEXT_SIZE = NAMES_SIZE };

/** How help writes the argument, with the names where there is no other; "" when there is none. @return out */
const char *option_argument(const option_row *row, char out[OPTION_TEXT_SIZE]);

/** "LEAST to MOST UNIT". @return out */
const char *option_limits(const option_row *row, char out[OPTION_TEXT_SIZE]);

/** As option_error(), which knows the rows; the rows know the kinds that call this. @return EXIT_USAGE */
int option_refuse(const option_row *row, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Presets and platforms choose what the user did not give: option_error() says so of these, until all is forgotten. */
void option_chosen(const options *o, option_id by, const char *name, const option_id *ids, size_t count);
void option_forget_choosers(void);

/** What follows from other options, once all are read; several presets are resolved. @return as above */
int options_complete(options *o);

/** Reads WIDTHxHEIGHT, each from 1 to `most`, or N for both where `square`. @return an exit status, after one line on
 *  stderr */
int option_read_sides(const option_row *row, const char *value, unsigned most, bool square, uint64_t sides[2]);

/** What the options of slanted triangles say together; without --viewport surfaces face the camera. @return as above */
int slant_complete(options *o);

/** With --viewport: a preset's field of view and rasterizer, where none were given. */
void slant_take_preset(options *o, const preset *p);
/** With --viewport: the rasterizer of a name of raster_find(), where none was given. */
void slant_take_raster(options *o, const char *name);

/** The field of a row. */
void *option_field(options *o, const option_row *row);

/* ---- Kinds ------------------------------------------------------------------------------------------------------- */

option_parser parse_flag;    /**< bool, no argument */
option_parser parse_text;    /**< const char * */
option_parser parse_some;    /**< the same, not empty */
option_parser parse_read;    /**< the name of a file that is read */
option_parser parse_written; /**< the name of a file that is written */
option_parser parse_number;  /**< double, finite, from least to most */
option_parser parse_length;  /**< double: scene units, or with a unit behind; from least to most, or positive */
option_parser parse_whole;   /**< unsigned or 64 bits wide, from least to most */
option_parser parse_word;    /**< the same: the index of one of `names` */
option_parser parse_row;     /**< a pointer to the row of one of `names` */
option_parser parse_list;    /**< depths: numbers from least to most, separated by commas */
option_parser parse_codes;   /**< the same, whole ones */
option_parser parse_pixels;  /**< the same, pairs of them with a semicolon in between */

/* ---- Languages of their own -------------------------------------------------------------------------------------- */

/** NAME[,NAME...]: one after the other to `add`. */
int parse_names(options *o, const option_row *row, const char *value, option_parser *add);

option_parser parse_unit, parse_preset, parse_presets, parse_near, parse_far, parse_fars, parse_formats, parse_mappings,
    parse_tolerance, parse_at, parse_schemes, parse_range, parse_origin, parse_distances, parse_error_map,
    parse_size_or_n, parse_figure_size, parse_axes, parse_separation_or_0, parse_intrinsics, parse_metric, parse_units,
    parse_stereo, parse_sky, parse_tint;
option_parser parse_product, parse_apis, parse_size, parse_parameter, parse_form, parse_link, parse_against, parse_also,
    parse_define, parse_mine;
option_parser parse_arith, parse_raster; /**< a name, or the profile of a GPU */
option_parser parse_viewport, parse_slant, parse_slant_or_plane, parse_triangle, parse_light_box, parse_ortho,
    parse_cascades, parse_curvature, parse_camera_depth, parse_hi_z;

#endif
