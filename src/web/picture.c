/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The flickering picture's door: a gap, a distance and a command's words make it, each frame is one call. What the page
 * says about gap and distance is written to stdout as JSON, sentences, places of sliders and all. picture.js is the
 * other side; all calls have the same instance.
 */
#include "raster/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bias/cmd_bias/call.h"
#include "camera/cmd/setups.h"
#include "camera/paste.h"
#include "camera/profile.h"
#include "core/append.h"
#include "core/elementary.h"
#include "report/number.h"
#include "solve/cmd/written.h"
#include "solve/distance.h"
#include "solve/plane.h"
#include "web/gpu.h"
#include "web/page.h"

enum { DIGITS = 3, STEPS = 1000, TEXT_SIZE = 256 };
enum { PIXELS = DRAW_PICTURE_WIDTH * DRAW_PICTURE_HEIGHT };

/* The lengths that have a slider, from one end to the other, in metres, or in scene units where nothing says what they
 * are. */
typedef struct axis {
    const char *name;
    double lo, hi;
} axis;

enum { GAP, DISTANCE, AXES, NEAR = AXES, FAR, SLIDERS }; /* the first two are the picture's */
static const axis axes[SLIDERS] = {
    {"gap", 1e-4, 10.0}, {"distance", 0.1, 1e5}, {"near", 1e-3, 100.0}, {"far", 1.0, 1e7}};

/* A length that was typed, and the unit in which what is beside it is said. */
typedef struct typed {
    double value; /* scene units */
    const unit_row *as;
} typed;

static draw_picture picture; /* z is 0: there is none */
static uint32_t *pixels;
static typed given[AXES];
static const unit_row *scene; /* null where nothing says what a scene unit is */
static draw_picture_count count;
static dp_spec set_up;           /* whether it is drawn or not */
static const raster_row *raster; /* null where none is named */
static paste engine;
static bias_api biased;     /* by its rule, and in its words */
static const char *undrawn; /* why there is no picture; null: there is one */

static void let_go(void) {
    if (picture.z > 0.0)
        draw_picture_close(&picture);
    picture = (draw_picture){0};
}

/* ---- Lengths ----------------------------------------------------------------------------------------------------- */

static int read_length(lengths *in, int which, const char *text) {
    length_reader seen = {.in = in};
    const int before = (int)in->typed_count;
    typed *to = &given[which];
    if (!length_read(&seen, text, strlen(text), NUMBER_FINITE, &to->value) || !(to->value > 0.0))
        return usage_error("%s: must be a length above 0, such as 2cm, got '%s'%s", axes[which].name, text,
                           length_hint(text, strlen(text)));
    to->as = (int)in->typed_count > before ? in->typed[before].unit : in->unit;
    return EXIT_FINE;
}

/* The metric unit that makes few digits of it. */
static const char *metric(double metres) {
    return metres < 0.01 ? "mm" : metres < 1.0 ? "cm" : metres < 1000.0 ? "m" : "km";
}

/* At least as much, as much, or at most, in the unit in which the length of that axis was typed, or one that suits. */
static number_text length_in(int which, double value, int way) {
    const unit_row *as = given[which].as;
    if (as != NULL && way != 0 && strchr(as->name, 'm') != NULL)
        as = unit_find(metric(unit_convert(value, scene, unit_find("m"))));
    const double there = unit_convert(value, scene, as);
    const number_text number = way > 0   ? number_up(there, DIGITS)
                               : way < 0 ? number_down(there, DIGITS)
                                         : number_of(there, 6);
    return number_in(number_brief(number), as != NULL ? as->name : NULL);
}

static double in_metres(double value) {
    return unit_convert(value, scene, unit_find("m"));
}

static int step_of(int which, double value) {
    const axis *a = &axes[which];
    const double share = dp_log(fmax(value, a->lo) / a->lo) / dp_log(a->hi / a->lo);
    return (int)rint(STEPS * fmin(share, 1.0));
}

/** Prints the length at a place of a slider, 0 to 1000: of gap, distance, near or far, whose last is infinity; with a
 * unit or without. */
PAGE_EXPORT("length_at") void length_at(int which, int step, int named) {
    const axis *a = &axes[which];
    const double at = a->lo * dp_pow(a->hi / a->lo, (double)step / STEPS);
    const char *name = named == 0 ? NULL : metric(at);
    const double there = name == NULL ? at : unit_convert(at, unit_find("m"), unit_find(name));
    if (which == FAR && step == STEPS)
        printf("inf");
    else
        printf("%s%s", number_brief(number_of(there, DIGITS)).text, name != NULL ? name : "");
    fflush(NULL);
}

/** The length of the first word in the unit that is the second, as a command reads it; NaN where it is none. */
PAGE_EXPORT("length_value") double length_value(int n) {
    char **words;
    double value = (double)NAN;
    const int argc = page_words(n, &words);
    lengths in = {.unit = argc > 2 ? unit_find(words[2]) : NULL};
    length_reader seen = {.in = &in};
    if (argc < 2 || !length_read(&seen, words[1], strlen(words[1]), NUMBER_FAR, &value))
        return (double)NAN;
    return value;
}

/** The place of a length on a slider; what is finite is not at the last place of far. */
PAGE_EXPORT("length_step") int length_step(int which, double value) {
    if (isnan(value))
        return 0;
    return which == FAR && isfinite(value) ? (int)fmin(step_of(which, value), STEPS - 2) : step_of(which, value);
}

/* ---- The picture ------------------------------------------------------------------------------------------------- */

/* Makes the picture of the first camera, format and mapping, where it can be drawn. */
static int make(const camera_asked *all) {
    const camera_asked *c = camera_of(all, 0);
    set_up = camera_to_spec(&c->said);
    raster = c->raster;
    undrawn = draw_picture_open(&picture, &set_up, raster, given[DISTANCE].value);
    return EXIT_FINE;
}

/* The camera of whatever command takes one. */
static int make_of(const asked_line *line, char **typed_words) {
    camera_asked *all = option_group(line, option_find(line->command, "near"));
    if (all == NULL)
        return usage_error("%s has no camera", line->command->name);
    lengths in = camera_of(all, 0)->lengths;
    for (int i = 0; i < AXES; i++)
        if (read_length(&in, i, typed_words[i]) != EXIT_FINE)
            return EXIT_USAGE;
    scene = in.unit;
    engine = (paste){all->preset_count > 0 ? all->presets[0] : NULL, scene};
    const char *api = camera_api(all);
    const dp_spec spec = camera_to_spec(&camera_of(all, 0)->said);
    biased = profile_bias(&all->gpu, all->platform, bias_api_find(api != NULL ? api : "d3d11"), &spec.format);
    return make(all);
}

static int picture_of(int argc, char **words) {
    asked_line line;
    let_go();
    undrawn = NULL;
    pixels = pixels != NULL ? pixels : malloc(PIXELS * sizeof *pixels);
    if (argc < 1 + AXES)
        return usage_error("too many words, or too few");
    int status = options_parse(&line, argc - AXES, words + AXES);
    if (status == EXIT_FINE)
        status = pixels != NULL ? make_of(&line, words + 1) : usage_error("no memory for a picture");
    options_release(&line);
    return status;
}

/* ---- What is said ------------------------------------------------------------------------------------------------ */

/* From near to the distance, of surfaces that face the camera, whatever the mapping is. */
static double facing(void) {
    const dp_setup guaranteed = dp_setup_guaranteed(&picture.asked), setup = dp_setup_facing(&guaranteed);
    dp_separation_worst found;
    const double to = fmin(picture.reach, setup.spec.zfar);
    return dp_separation_over(&setup, setup.spec.znear, to, 0.0, &found) == DP_OK ? found.bound : (double)INFINITY;
}

/* How far the gap is guaranteed at any slant; NaN where it is not even at near. */
static double reach_of(const dp_setup *setup) {
    return distance_about(setup, setup->spec.znear, setup->spec.zfar, given[GAP].value, DIGITS + 1);
}

static void print_place(const char *name, int which, double value, int way, const char *end) {
    if (isfinite(value))
        printf("\"%s\": {\"step\": %d, \"value\": %s, \"text\": \"%s\"}%s", name, step_of(which, in_metres(value)),
               number_full(value).text, length_in(which, value, way).text, end);
    else
        printf("\"%s\": null%s", name, end);
}

static void say_headline(double reach, char out[TEXT_SIZE]) {
    const number_text gap = length_in(GAP, given[GAP].value, 0), far_at = length_in(DISTANCE, given[DISTANCE].value, 0);
    const bool none = !isfinite(picture.guaranteed);
    out[0] = '\0';
    append(out, TEXT_SIZE, "%s apart, %s away: ", gap.text, far_at.text);
    if (none)
        append(out, TEXT_SIZE, "no gap is guaranteed at any slant%s.",
               picture.asked.spec.ortho                     ? " in an orthographic view"
               : picture.asked.spec.model != DP_MODEL_FLOAT ? ", as this mapping is not affine on the screen"
                                                            : "");
    else if (given[GAP].value >= picture.guaranteed)
        append(out, TEXT_SIZE, "resolved at any slant, guaranteed from %s on, and this gap %s%s.",
               length_in(GAP, picture.guaranteed, 1).text, reach >= picture.asked.spec.zfar ? "up to far" : "up to ",
               reach >= picture.asked.spec.zfar ? "" : length_in(DISTANCE, reach, -1).text);
    else if (isnan(reach))
        append(out, TEXT_SIZE, "may flicker. At any slant %s is guaranteed, and this gap at no distance.",
               length_in(GAP, picture.guaranteed, 1).text);
    else
        append(out, TEXT_SIZE, "may flicker. At any slant %s is guaranteed, or this gap up to %s.",
               length_in(GAP, picture.guaranteed, 1).text, length_in(DISTANCE, reach, -1).text);
}

static void print_given(void) {
    for (int i = 0; i < AXES; i++)
        print_place(axes[i].name, i, given[i].value, 0, i + 1 < AXES ? ", " : "}\n");
}

static void print_facts(void) {
    char label[SETUP_LABEL_SIZE], text[TEXT_SIZE];
    const bool told = isfinite(picture.guaranteed);
    double reach = told ? reach_of(&picture.asked) : (double)NAN;
    if (told && picture.row != NULL)
        reach = fmin(reach, reach_of(&picture.setup));
    say_headline(reach, text);
    printf("{\"name\": \"%s%s\", \"headline\": \"%s\", ", setup_label(&picture.setup, false, label),
           picture.asked.spec.ortho ? ", orthographic" : "", text);
    const double parallel = facing();
    if (isfinite(parallel))
        printf("\"facing\": \"Facing the camera, as a wall straight ahead does: guaranteed from %s on.\", ",
               length_in(GAP, parallel, 1).text);
    else
        printf("\"facing\": \"Facing the camera, as a wall straight ahead does: no gap is guaranteed.\", ");
    const dp_spec *spec = &picture.setup.spec;
    printf("\"model\": \"%s\", \"arith\": \"%s\", \"format\": \"%s\", \"mapping\": \"%s\", \"resolved\": %s, ",
           spec->model == DP_MODEL_FLOAT         ? "float"
           : picture.asked.curve == DP_CURVE_LOG ? "shader"
                                                 : "exact",
           dp_arith_get(spec->arith)->name, spec->format.name, dp_mapping_get(spec->mapping)->name,
           told && given[GAP].value >= picture.guaranteed ? "true" : "false");
    print_place("enough", GAP, picture.guaranteed, 1, ", ");
    print_place("limit", DISTANCE, told ? reach : (double)NAN, -1, ", ");
    print_given();
}

/** Makes the picture of the command behind a gap and a distance, `n` words in all. @return its exit status; EXIT_FINE:
 * there is one, and stdout says what is known of it */
PAGE_EXPORT("picture_set") int picture_set(int n) {
    char **words;
    const int argc = page_words(n, &words), status = picture_of(argc, words);
    if (status == EXIT_FINE && undrawn != NULL) {
        printf("{\"error\": \"Nothing is drawn %s away: %s.\", ", length_in(DISTANCE, given[DISTANCE].value, 0).text,
               undrawn);
        print_given();
    } else if (status == EXIT_FINE)
        print_facts();
    fflush(NULL);
    return status;
}

/* ---- Ways out ---------------------------------------------------------------------------------------------------- */

/* The separation that is guaranteed from near to the distance at any slant; INFINITY where nothing is. */
static double needed(const dp_spec *spec) {
    dp_setup setup;
    dp_separation_worst found;
    const double to = given[DISTANCE].value;
    return to > spec->znear && to <= spec->zfar && dp_setup_init(&setup, spec) == DP_OK &&
                   dp_separation_over(&setup, setup.spec.znear, to, 0.0, &found) == DP_OK
               ? found.bound
               : (double)INFINITY;
}

/* The least near plane of three digits that does, as text; "" where none does that leaves something to be seen. */
static number_text near_enough(dp_spec spec) {
    enum { TRIES = 12 };
    const double gap = given[GAP].value, z = given[DISTANCE].value;
    const solve_problem problem = {spec, SOLVE_NEAR, QUANTITY_SEPARATION, gap, z, z};
    plane_answer answer;
    number_text out = {""};
    if (z > spec.zfar || plane_solve(&problem, &answer) != DP_OK || !answer.possible)
        return out;
    double near = answer.value;
    for (int i = 0; i < TRIES && near < z / 3.0; i++, near *= 1.1) { /* nearer depths may need more */
        out = number_brief(number_up(near, DIGITS));
        spec.znear = strtod(out.text, NULL);
        if (needed(&spec) <= gap)
            return out;
    }
    return (number_text){""};
}

static void print_way(const char *text, const char *changes, const char *code) {
    printf("{\"text\": \"%s\", \"set\": {%s}, \"code\": \"", text, changes);
    for (; *code != '\0'; code++)
        printf("%s%c", *code == '"' ? "\\" : "", *code);
    printf("\"}, ");
}

static dp_mapping turned(dp_mapping mapping) {
    const dp_mapping_row *row = dp_mapping_get(mapping);
    return row->ndc_signed ? DP_MAPPING_GL_REVERSED : DP_MAPPING_REVERSED;
}

/* Depth as another format or mapping, where that does. */
static bool print_other(const dp_spec *asked, bool reversed, bool as_float) {
    dp_spec spec = *asked;
    dp_format formats[2];
    char changes[TEXT_SIZE] = "", code[TEXT_SIZE] = "";
    spec.mapping = reversed ? turned(spec.mapping) : spec.mapping;
    if (as_float && dp_format_parse("fp32", formats) == 1)
        spec.format = formats[0];
    const bool turns = spec.mapping != asked->mapping, floats = strcmp(spec.format.name, asked->format.name) != 0;
    if (turns != reversed || floats != as_float || !(needed(&spec) <= given[GAP].value))
        return false;
    const dp_mapping_row *row = dp_mapping_get(spec.mapping);
    if (turns)
        append(changes, sizeof changes, "\"mapping\": \"%s\"%s", row->name, floats ? ", " : "");
    if (floats)
        append(changes, sizeof changes, "\"format\": \"%s\"", spec.format.name);
    const char *own = turns ? paste_reversed(&engine) : NULL;
    append(code, sizeof code, "%s", own != NULL ? own : turns ? row->effort : "");
    if (floats)
        append(code, sizeof code, "%sa depth buffer of 32-bit float: D32_FLOAT, depth32float", turns ? "; " : "");
    print_way(turns && floats ? "Reverse depth, in 32-bit float"
              : turns         ? "Reverse depth"
                              : "Take 32-bit float",
              changes, code);
    return true;
}

/* A bias that moves the surfaces in front nearer by the gap, as the command bias says it. */
static void print_bias(void) {
    dp_spec spec = picture.asked.spec;
    dp_setup setup;
    char changes[TEXT_SIZE];
    spec.model = DP_MODEL_EXACT;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return;
    const bias_goal goal = {.api = &biased, .factor = bias_factor_least(&setup), .gap = given[GAP].value};
    const double units = bias_signed(&setup, bias_needed(&setup, &goal, given[DISTANCE].value));
    snprintf(changes, sizeof changes, "\"api\": \"%s\"", biased.name);
    if (!isnan(units) && isfinite(goal.factor))
        print_way("Bias what is in front", changes, bias_call(&biased, units, bias_sign(&setup) * goal.factor).text);
}

static void print_ways(void) {
    char text[TEXT_SIZE], changes[TEXT_SIZE], code[TEXT_SIZE];
    dp_spec spec = picture.asked.spec;
    if (isfinite(picture.guaranteed)) {
        const number_text near = near_enough(spec);
        snprintf(text, sizeof text, "Raise near to %s", number_in(near, scene != NULL ? scene->name : NULL).text);
        snprintf(changes, sizeof changes, "\"near\": \"%s\"", near.text);
        const char *own = paste_near(&engine, near.text, code, sizeof code);
        if (near.text[0] != '\0')
            print_way(text, changes, own != NULL ? own : "");
    }
    spec.model = DP_MODEL_FLOAT;
    if (dp_mapping_get(spec.mapping)->curve != DP_CURVE_PERSPECTIVE)
        spec.mapping = DP_MAPPING_D3D;
    if (!print_other(&spec, true, false) && !print_other(&spec, false, true))
        print_other(&spec, true, true);
    if (!isfinite(picture.guaranteed))
        return;
    print_bias();
    const number_text apart = length_in(GAP, picture.guaranteed, 1);
    snprintf(text, sizeof text, "Set them %s apart", apart.text);
    char bare[sizeof apart.text] = "";
    for (const char *at = apart.text; *at != '\0'; at++)
        if (*at != ' ')
            append(bare, sizeof bare, "%c", *at);
    snprintf(changes, sizeof changes, "\"gap\": \"%s\"", bare);
    print_way(text, changes, "");
}

/** Prints what else would do, the cheapest first, of a gap, a distance and a command as picture_set() has them: of each
 * what it is in words, what it changes, and what the engine's users write. @return exit status */
PAGE_EXPORT("ways") int ways(int n) {
    char **words;
    const int argc = page_words(n, &words), status = picture_of(argc, words);
    printf("[");
    if (status == EXIT_FINE && undrawn == NULL && !(given[GAP].value >= picture.guaranteed))
        print_ways();
    printf("null]\n");
    fflush(NULL);
    return status;
}

/** Prints a requirement file that asks what the headline answers, of words as picture_set() has them.
 * @return exit status */
PAGE_EXPORT("need") int need_words(int n) {
    static output out;
    char **words;
    const int argc = page_words(n, &words), status = picture_of(argc, words);
    const double distance = given[DISTANCE].value;
    if (status != EXIT_FINE || output_open(&out, NULL) != EXIT_FINE)
        return status;
    const bool computed = !set_up.ortho && dp_mapping_get(set_up.mapping)->curve == DP_CURVE_PERSPECTIVE;
    set_up.model = computed ? DP_MODEL_FLOAT : DP_MODEL_EXACT;
    output_text(&out, "# What a camera must resolve: run `depthprec check` on this file.\n");
    if (scene != NULL)
        output_format(&out, "unit = \"%s\";\n", scene->name);
    output_text(&out, "\ncameras = {\n  a");
    need_write_camera(&out, &set_up, computed ? "float" : "auto", raster);
    output_text(&out, "};\n\nrequirements = {\n  apart =\n");
    need_write_separation(&out, "a", fmin(set_up.znear, distance), distance, given[GAP].value);
    output_text(&out, "};\n");
    return output_close(&out);
}

/* Whether the gap is not too wide to be drawn. */
static bool is_drawn(void) {
    return picture.z > 0.0 && given[GAP].value <= draw_picture_widest(&picture);
}

/** Draws a frame. @return how many pixels are wrong, -1 where nothing is drawn */
PAGE_EXPORT("picture_draw") int picture_draw(unsigned frame, int marks) {
    if (!is_drawn())
        return -1;
    count = draw_picture_frame(&picture, given[GAP].value, frame, marks != 0, pixels);
    return (int)count.wrong;
}

/** The picture drawn: 640 x 360 pixels of red, green, blue and alpha, row by row from the top. */
PAGE_EXPORT("picture_pixels") const uint32_t *picture_pixels(void) {
    return pixels;
}

/** Says what the gap does, as the last frame was; `quiet`: no pixel was wrong lately. */
PAGE_EXPORT("picture_say") void picture_say(int quiet) {
    const double share = 100.0 * (double)count.wrong / fmax((double)count.covered, 1.0);
    if (!is_drawn())
        printf("A gap of %s is too wide to be drawn %s away: at most %s.", length_in(GAP, given[GAP].value, 0).text,
               length_in(DISTANCE, given[DISTANCE].value, 0).text,
               length_in(GAP, draw_picture_widest(&picture), -1).text);
    else if (given[GAP].value >= picture.guaranteed)
        printf("No pixel is wrong, nor will be.");
    else if (quiet != 0)
        printf("No pixel is wrong just now.");
    else
        printf("%s %% of sign, poster and marks shows what is behind.", number_brief(number_of(share, 2)).text);
    fflush(NULL);
}

/* ---- The same by the browser's GPU ------------------------------------------------------------------------------- */

enum { TRIANGLES = 64 };

typedef struct corners {
    uint32_t count, who[TRIANGLES];
    raster_vertex at[TRIANGLES][3];
} corners;

static void take_corners(void *context, const double place[3][3], unsigned who) {
    corners *c = context;
    if (c->count == TRIANGLES)
        return;
    for (int i = 0; i < 3; i++)
        c->at[c->count][i] = draw_clip(&picture.camera, place[i]);
    c->who[c->count++] = who;
}

/* Who is seen takes the place of the model's in the buffer. Characters of the output are the bytes of pixels. */
static int draw_by_gpu(unsigned frame) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32"};
    static corners all;
    char text[GPU_TEXT_SIZE];
    gpu_request r = {.what = GPU_PICTURE, .other = picture.camera.pipeline.reversed != 0, .out = pixels};
    size_t differ = 0;
    while (r.format < 3 && strcmp(formats[r.format], picture.setup.spec.format.name) != 0)
        r.format++;
    if (r.format == 3 || picture.setup.spec.ortho || picture.setup.spec.model != DP_MODEL_FLOAT || !is_drawn())
        return usage_error("this GPU draws unorm16, unorm24 and fp32 in perspective, of gaps that can be drawn");
    const double gap = given[GAP].value;
    const size_t wrong = draw_picture_frame(&picture, gap, frame, false, NULL).wrong;
    draw_picture_triangles(&picture, gap, frame, take_corners, &all);
    r.a = (float)picture.camera.target.width;
    r.b = (float)picture.camera.target.height;
    r.count = all.count;
    r.in = all.at;
    r.second = all.who;
    if (!gpu_ask(&r, text))
        return usage_error("%s", text);
    for (size_t i = 0; i < PIXELS; i++) {
        differ += picture.buffer.winner[i] != pixels[i];
        picture.buffer.winner[i] = (uint8_t)pixels[i];
    }
    count = draw_picture_show(&picture, false, pixels);
    for (size_t i = 0; i < sizeof *pixels * PIXELS; i++) {
        const unsigned char byte = ((const unsigned char *)pixels)[i];
        if (byte >= 0x80)
            putchar(0xC0 | byte >> 6);
        putchar(byte >= 0x80 ? 0x80 | (byte & 0x3F) : byte);
    }
    fprintf(stderr, "This GPU, gap %s: %zu of %d pixels differ from the model of %s; %zu are wrong here, %zu there.\n",
            length_in(GAP, gap, 0).text, differ, PIXELS, picture.camera.target.row->name, count.wrong, wrong);
    return EXIT_FINE;
}

/** A frame by the GPU: the first word is its number; then come a gap, a distance and a command, as of picture_set().
 * @return exit status; what is said of it is on stderr */
PAGE_EXPORT("seen") int seen_words(int n) {
    char **words;
    if (page_words(n, &words) < 2)
        return EXIT_USAGE;
    const unsigned frame = (unsigned)atoi(words[1]);
    int status = picture_of(n, &words[1]);
    if (status == EXIT_FINE)
        status = undrawn == NULL ? draw_by_gpu(frame) : usage_error("nothing is drawn: %s", undrawn);
    fflush(NULL);
    return status;
}
