/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Stand-ins for what the page lacks: the commands and figures that need files, threads, GSL or jansson, and
 * the rows that their options name. Each refuses in a sentence; the program has them all.
 */
#pragma clang diagnostic ignored "-Wunused-parameter"

#include <gsl/gsl_chebyshev.h>
#include <gsl/gsl_spline.h>
#include <stdio.h>

#include "bias/cmd_bias/trial.h"
#include "camera/cmd/setups.h"
#include "camera/depth_range.h"
#include "camera/profile.h"
#include "cli/link.h"
#include "cli/words.h"
#include "convert/convert.h"
#include "draw/pixels.h"
#include "judge/cmd_judge/request.h"
#include "judge/pairs.h"
#include "method/cmd_methods/methods.h"
#include "method/cmd_methods/mine.h"
#include "method/truth.h"
#include "plot/figure.h"
#include "quantity/cmd_table/constants.h"
#include "quantity/cmd_table/in_preset.h"
#include "quantity/cmd_table/levels.h"
#include "quantity/cmd_table/slices.h"
#include "scene/cmd_scene/drawing.h"
#include "scene/find.h"
#include "shader/pack.h"
#include "shadow/cmd_shadow/maps.h"
#include "shadow/engine.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"
#include "texture/cmd_texture/request.h"
#include "texture/device.h"
#include "texture/units.h"
#include "world/arithmetic.h"
#include "zfight/cmd_prepass/request.h"

static int absent(const asked_line *line) {
    return usage_error("%s is not in the page: the program has it", line->command->name);
}

/* The page asks for none of these. */
#define STUB(type, name, parameters, value)                                                                            \
    type name parameters {                                                                                             \
        return value;                                                                                                  \
    }

#define ABSENT(name)                                                                                                   \
    int name(void *request) {                                                                                          \
        return absent(*(asked_line *const *)request);                                                                  \
    }

/* Their options are known of where others take them, too. */
static const option_use no_uses[] = {END};
static const option_place no_places[] = {{.table = NULL}};
#define ABSENT_COMMAND(of)                                                                                             \
    const command_row command_##of = {.name = #of, .request = sizeof(void *), .places = no_places, .uses = no_uses};   \
    ABSENT(cmd_##of)

static const option_row no_rows[] = {{.name = NULL}};
#define ABSENT_OPTIONS(of) const option_table of##_options = {.rows = no_rows};

ABSENT_OPTIONS(convert)
ABSENT_OPTIONS(range)
ABSENT_OPTIONS(scene)
ABSENT_OPTIONS(scene_eye)
ABSENT_OPTIONS(shadow)
ABSENT_OPTIONS(shadow_size)
const option_use scene_model[] = {END}, shadow_cascade_uses[] = {END}, shadow_map_uses[] = {END};

/* Options of a command that is there. */
static int absent_option(asked_line *line, const option_row *row, const char *value, void *group) {
    return option_refuse(row, "is not in the page: the program has it");
}

#define ABSENT_OPTION(of)                                                                                              \
    { .name = (of), .argument = "X", .help = "", .parse = absent_option }
static const option_row stored_rows[] = {ABSENT_OPTION("prepass-format"), ABSENT_OPTION("resolve"),
                                         ABSENT_OPTION("half"), END};
const option_table stored_options = {.rows = stored_rows};
const option_use stored_uses[] = {ROWS(stored_rows), END};

ABSENT(cmd_completions)
ABSENT_COMMAND(convert)
ABSENT(cmd_help)
ABSENT_COMMAND(list)
ABSENT_COMMAND(methods)
ABSENT_COMMAND(scene)
ABSENT_COMMAND(shadow)
ABSENT(cmd_texture)
ABSENT_COMMAND(world)

const column setup_end_columns[] = {{.kind = COLUMN_END}};

STUB(const setup_depths *, setup_ends, (const dp_spec *spec), NULL)
STUB(const char *, setup_range, (const setup_fields *f, char out[SETUP_RANGE_SIZE]), (*out = '\0', out))
STUB(int, range_complete, (const camera_asked *c), EXIT_FINE)
STUB(int, parse_depth_ranges, (asked_line * line, const option_row *row, const char *value, void *group),
     absent_option(line, row, value, group))
STUB(const char *, setup_range_option, (const dp_spec *spec, char out[SETUP_RANGE_SIZE]), (*out = '\0', out))
STUB(const char *, setup_slice, (const camera_asked *c, const dp_setup *setup, char out[SETUP_RANGE_SIZE]),
     (*out = '\0', out))
STUB(bool, setup_repeats, (const setups *all, size_t i), false)
STUB(bool, camera_range_takes, (const char *api, const double range[2], camera_fault *fault),
     camera_range_suits(NULL, range, fault))
STUB(bool, camera_range_suits, (const bias_api *api, const double range[2], camera_fault *fault), true)
STUB(bool, camera_range_refused, (const dp_spec *spec, dp_status status, camera_fault *fault), false)

const column slice_columns[] = {{.kind = COLUMN_END}};

STUB(double, slice_codes, (const dp_setup *setup), 0.0)
STUB(double, slice_share, (const dp_setup *setup), slice_codes(setup))
STUB(bool, slices_shared, (const setups *all, size_t index, slice_pair *out), setup_repeats(all, index))
STUB(void, slices_say, (page * p, const camera_asked *c, const setups *all), )
STUB(int, constants_write, (const table_request *o), absent(o->line))
STUB(int, solve_preset, (const solve_request *o),
     usage_error("solve for a number that a preset leaves open is not in the page: the program has it"))

void in_preset_find(const table_request *o, in_preset *out) {
    *out = (in_preset){.parameter = NULL};
}

STUB(bool, levels_wanted, (const table_request *o), o->lattice != NULL)
STUB(int, levels_write, (const table_request *o), absent(o->line))
STUB(int, prepass_stored, (const prepass_request *o), absent(o->camera.line))
STUB(int, link_write, (const asked_line *line), absent(line))
STUB(int, bias_try,
     (const raster_row *row, const dp_setup *setup, const bias_state *state, double slope, double lo, double hi,
      const char *render, bias_judged *judged, bias_trial *out),
     usage_error("bias --rasterize is not in the page: the program has it"))

const column bias_trial_columns[] = {{.kind = COLUMN_END}};

STUB(void, bias_say_trial, (page * p, bias_trial *trial), )

#define ABSENT_FIGURE(name)                                                                                            \
    const char *name(const figure_request *request, chart *out) {                                                      \
        return "plot: this figure is not in the page: the program has it";                                             \
    }

ABSENT_FIGURE(cost_build)
ABSENT_FIGURE(fight_build)
ABSENT_FIGURE(linear01_build)
ABSENT_FIGURE(scene_build)
ABSENT_FIGURE(normals_build)
ABSENT_FIGURE(pareto_build)
ABSENT_FIGURE(needs_build)
ABSENT_FIGURE(shadow_build)
ABSENT_FIGURE(shadow_distance_build)
ABSENT_FIGURE(stability_build)
ABSENT_FIGURE(world_build)

/* ---- Rows that options of those commands name ---------------------------------------------------------------------
 */

#define ABSENT_TABLE(name) const named_table name##_table = {NULL, 0, 0};

ABSENT_TABLE(upscaler)
ABSENT_TABLE(effect)
ABSENT_TABLE(normal)
ABSENT_TABLE(pack)
ABSENT_TABLE(position)
ABSENT_TABLE(convert_read)
ABSENT_TABLE(convert_write)
ABSENT_TABLE(shadow_engine)
ABSENT_TABLE(shadow_filter)
ABSENT_TABLE(word)
ABSENT_TABLE(question)
ABSENT_TABLE(synthetic)

/* Families of methods but interval, which figures are drawn by. */
static const size_t none;
const method_family_row worst_family = {.method_count = &none}, position_family = {.method_count = &none},
                        normal_family = {.method_count = &none};

void method_start(void) {}

STUB(int, methods_resolve, (const judge_request *o, const method_family_row *family, methods_asked *out),
     absent(o->line))
STUB(int, methods_single, (const judge_request *o, methods_asked *asked), absent(o->line))
STUB(const char *, methods_machine, (char *out, size_t size), out)
STUB(double, truth_width, (const dp_setup *setup, uint32_t code, bool *cut), 0.0)

/* Steps of worlds, which `world` and its figure compute with; their bounds are there. */
#define ABSENT_STEPS(name)                                                                                             \
    void arithmetic_##name(const world_scheme *s, const world_camera *camera, const world_place *place, float out[3]) {}
ABSENT_STEPS(camera_double)
ABSENT_STEPS(camera_float)
ABSENT_STEPS(cell)
ABSENT_STEPS(local)
ABSENT_STEPS(split)
ABSENT_STEPS(tile)
ABSENT_STEPS(two_sum)
ABSENT_STEPS(world)
STUB(int, mine_open, (const judge_request *o, methods_asked *asked, bool on_device, mine **out), absent(o->line))
STUB(const char *, mine_device, (const mine *m), "")
STUB(void, mine_close, (mine * m), )

/* ---- What the figures of those commands call ----------------------------------------------------------------------
 */

int judge_pairs_read(const char *path, judge_pairs *out, char error[PAIRS_ERROR_SIZE]) {
    snprintf(error, PAIRS_ERROR_SIZE, "the page reads no files");
    return -1;
}

STUB(int, shadow_maps_make, (const shadow_request *o, const dp_format *format, dp_mapping mapping, shadow_maps *out),
     absent(o->line))
STUB(const bias_api *, shadow_asked_api, (const shadow_request *o, size_t index), NULL)
STUB(int, scene_figure_begin, (scene * s, const scene_request *o), absent(o->line))
STUB(int, scene_look, (scene * s, output *out), EXIT_USAGE)
STUB(bool, scene_figure_take, (const scene *s, fights_asked *out, chart *c), false)
STUB(int, scene_figure_height, (const chart *c, int width), width)
STUB(void, scene_end, (scene * s), )
STUB(bool, pixels_write_png, (FILE * out, const pixels *p, const notes *words), false)

/* Splines and series of the GNU Scientific Library, which no language has and nothing here runs. */
STUB(double, gsl_spline_eval, (const gsl_spline *s, double x, gsl_interp_accel *a), 0.0)
STUB(gsl_spline *, gsl_spline_alloc, (const gsl_interp_type *type, size_t n), NULL)
STUB(int, gsl_spline_init, (gsl_spline * s, const double x[], const double y[], size_t n), 1)
STUB(void, gsl_spline_free, (gsl_spline * s), )
STUB(gsl_interp_accel *, gsl_interp_accel_alloc, (void), NULL)
STUB(void, gsl_interp_accel_free, (gsl_interp_accel * a), )
STUB(double, gsl_cheb_eval, (const gsl_cheb_series *s, double x), 0.0)
STUB(gsl_cheb_series *, gsl_cheb_alloc, (size_t n), NULL)
STUB(int, gsl_cheb_init, (gsl_cheb_series * s, const gsl_function *f, double a, double b), 1)
STUB(void, gsl_cheb_free, (gsl_cheb_series * s), )
const gsl_interp_type *gsl_interp_cspline;

/* ---- Names alone, where the program reads the profile of a GPU too --------------------------------------------- */

STUB(int, parse_arith, (asked_line * line, const option_row *row, const char *value, void *group),
     parse_word(line, row, value, group))
STUB(int, parse_raster, (asked_line * line, const option_row *row, const char *value, void *group),
     parse_row(line, row, value, group))
STUB(bool, profile_is_file, (const char *text), false)
STUB(int, profile_add,
     (profile * to, const char *path, const char *key, char name[PROFILE_NAME_SIZE], char error[PROFILE_ERROR_SIZE]),
     -1)

/* ---- Of commands that are not here ------------------------------------------------------------------------------- */

#define ABSENT_PARSER(name)                                                                                            \
    int name(asked_line *line, const option_row *row, const char *value, void *group) {                                \
        return absent(line);                                                                                           \
    }

ABSENT_PARSER(parse_error_map)
ABSENT_PARSER(parse_hi_z)
ABSENT_PARSER(parse_parameter)
ABSENT_PARSER(parse_define)
ABSENT_PARSER(parse_product)
