/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * texture --product effect:NAME without an image: what the stored depth does to an effect, depth by depth, from which
 * (or up to which) value of its parameter on that is no more than a level of 8 bits, and up to which depth it is none
 * without --at. Of several set-ups these two stand side by side.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/each_setup.h"
#include "core/append.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"

enum { DIGITS = 6, DIGITS_Z = 9 };

static const double ONE_LEVEL = 1;

/* ---- Which effect ------------------------------------------------------------------------------------------------ */

int texture_effect_resolve(const texture_request *o, bool pictured, const effect_row **row,
                           double parameters[PARAMETERS_MAX]) {
    const parameter_use unused = pictured ? PARAMETER_TABLE : PARAMETER_IMAGE;
    int status = EXIT_FINE;
    *row = o->image.effect;
    parameter_defaults((*row)->parameters, parameters);
    for (size_t i = 0; i < o->image.parameter_count && status == EXIT_FINE; i++) {
        status = texture_parameter_set((*row)->name, (*row)->parameters, &o->image.parameters[i], unused, parameters);
        for (size_t k = 0; k < i && status == EXIT_FINE; k++)
            if (parameter_find((*row)->parameters, o->image.parameters[k].name) ==
                parameter_find((*row)->parameters, o->image.parameters[i].name))
                status = option_error("parameter", "must not be given twice for '%s', got '%s' too",
                                      o->image.parameters[k].name, o->image.parameters[i].name);
    }
    return status;
}

/* ---- The table --------------------------------------------------------------------------------------------------- */

typedef struct row {
    dp_sample sample;
    double levels, share, usable, ceiling;
} row;

/* Below `row`, what is usable at all depths shown, and the depth that decides; NaN when at one of them nothing is. */
typedef struct table {
    each_setup each;
    const texture_request *o;
    const effect_row *effect;
    const texture_parameter *wanted;
    const char *name, *wanted_name, *direction;
    double parameters[PARAMETERS_MAX];
    struct parameter {
        const char *name, *unit;
        double value;
    } parameter;
    camera_spec spec; /* where the effect needs the position: the camera, and the pixel */
    uint32_t column, line;
    texture_camera camera, last;
    effect_view view;
    row row;
    bool begun;
    double usable, z, ceiling, ceiling_z;
    effect_slopes slopes;   /* the least of the first and the largest of the last, */
    double first_z, last_z; /* and the depths where they are */
    bool steps;        /* of the stored depth, whose edges show as bands; of the others a plane is drawn right or not */
    double reach;      /* up to which depth no step is more than a level; NaN where one is at near */
    double rounding;   /* the same of the rounding of depths, about half a step */
    double everywhere; /* what is usable at all depths, not at those alone that are shown; NaN where nothing is */
    char label[SETUP_LABEL_SIZE];
} table;

static bool needs(const table *t, unsigned what) {
    return (t->effect->needs & what) != 0;
}

/* The pixel of --pixel, or the middle of the lowest row, which sees the ground. */
static int make_view(table *t, const dp_setup *setup) {
    const texture_request *o = t->o;
    const char *wrong = camera_init(&t->camera, setup, &t->spec);
    int status = wrong != NULL ? usage_error("texture: %s", wrong) : EXIT_FINE;
    if (status == EXIT_FINE && needs(t, EFFECT_LAST_FRAME))
        status = texture_last_camera(o, setup, &t->spec, &t->last);
    if (status == EXIT_FINE)
        t->view = effect_view_of(&t->camera, needs(t, EFFECT_LAST_FRAME) ? &t->last : NULL, t->column, t->line);
    t->view.setup = setup;
    return status;
}

static int choose_pixel(table *t, const texture_request *o) {
    t->spec = o->camera.spec;
    t->column = t->spec.width / 2;
    t->line = t->spec.height - 1;
    int status = view_vertical(&o->camera, (int)t->spec.width, (int)t->spec.height, &t->spec.fov_y);
    if (status == EXIT_FINE)
        status = texture_camera_place(o, &t->spec);
    if (status != EXIT_FINE || !option_given(o->line, "pixel"))
        return status;
    if (o->image.pixels.count != 2)
        return option_error("pixel", "must be one pixel with an effect alone, got %zu", o->image.pixels.count / 2);
    t->column = (uint32_t)depths_get(&o->image.pixels, 0);
    t->line = (uint32_t)depths_get(&o->image.pixels, 1);
    return texture_pixels_check(o, t->spec.width, t->spec.height);
}

/* Without --at all depths are meant, not those alone that are shown. What compares pixels or frames
 * comes and goes.
 */
static bool is_asked_of_all(const table *t) {
    return !option_given(t->o->line, "at") && effect_is_steady(t->effect);
}

/* The depths that are shown without --at end there, too. */
static double farthest(const dp_setup *setup) {
    return isinf(setup->spec.zfar) ? 1e6 * setup->spec.znear : setup->spec.zfar;
}

static void *next_setup(void *of, size_t i) {
    table *t = of;
    t->begun = false;
    t->slopes.plane = (double)NAN;
    if (!each_setup_go(&t->each, i) || make_view(t, t->each.setup) != EXIT_FINE)
        return NULL;
    const dp_setup *setup = t->each.setup;
    const double lo = setup->spec.znear, hi = farthest(setup);
    if (!is_asked_of_all(t))
        return t;
    t->reach = effect_reach(t->effect, &t->view, t->parameters, t->steps, lo, hi, ONE_LEVEL);
    t->rounding = effect_reach(t->effect, &t->view, t->parameters, false, lo, hi, ONE_LEVEL);
    t->everywhere = effect_usable_over(t->effect, &t->view, t->parameters, t->steps, lo, hi, ONE_LEVEL);
    return t;
}

/* Over the rows: where the first edge is soonest, and where it is latest that all places have one. */
static void add_slopes(table *t, double z) {
    const effect_slopes s = effect_slopes_at(t->effect, &t->view, t->parameters, z);
    if (isnan(s.first) || isnan(s.last)) /* too near far to be one */
        return;
    if (isnan(t->slopes.plane) || s.first < t->slopes.first) {
        t->slopes.first = s.first;
        t->first_z = z;
    }
    if (isnan(t->slopes.plane) || s.last > t->slopes.last) {
        t->slopes.last = s.last;
        t->last_z = z;
    }
    t->slopes.plane = s.plane;
}

static void *next_row(void *of, size_t i) {
    table *t = of;
    row *x = &t->row;
    double z;
    if (!each_setup_depth(&t->each, i, &z))
        return NULL;
    x->levels = effect_error(t->effect, &t->view, t->parameters, z);
    x->share = effect_share(t->effect, &t->view, t->parameters, z);
    x->usable = effect_usable(t->effect, &t->view, t->parameters, z, ONE_LEVEL);
    x->ceiling = effect_ceiling(t->effect, &t->view, t->parameters, z);
    dp_sample_at(t->each.setup, z, &x->sample); /* depths_resolve() has seen to it */
    const bool decides = isnan(x->usable) || (t->effect->smallest ? x->usable > t->usable : x->usable < t->usable);
    if (!t->begun || (decides && !isnan(t->usable))) {
        t->usable = x->usable;
        t->z = x->sample.z;
    }
    if (!t->begun || ((isnan(x->ceiling) || x->ceiling < t->ceiling) && !isnan(t->ceiling))) {
        t->ceiling = x->ceiling;
        t->ceiling_z = x->sample.z;
    }
    add_slopes(t, z);
    t->begun = true;
    return x;
}

/* Those that the table uses. */
static void *next_parameter(void *of, size_t i) {
    table *t = of;
    const texture_parameter *p = t->effect->parameters;
    for (size_t k = 0; p[k].name != NULL; k++)
        if (p[k].use != PARAMETER_IMAGE && i-- == 0) {
            t->parameter = (struct parameter){p[k].name, p[k].unit, t->parameters[k]};
            return &t->parameter;
        }
    return NULL;
}

/* "at every depth", or as far as it was looked. */
static void every_depth(const page *p, const dp_setup *setup, char out[64]) {
    const bool all = !isinf(setup->spec.zfar);
    snprintf(out, 64, "at every depth%s%s",
             all ? "" : " up to z = ", all ? "" : number_in(number_full(farthest(setup)), p->unit).text);
}

/* "Up to z = 81.1 " and what is behind it. */
static void say_within(page *p, const table *t, double reach, const char *all, const char *within) {
    if (isnan(reach))
        page_text(p, "At no depth, not even at near, is it certain that %s", within);
    else if (reach >= farthest(t->each.setup))
        page_text(p, "A%s %s", all + 1, within);
    else
        page_text(p, "Up to z = %s %s", number_in(number_down(reach, DIGITS), p->unit).text, within);
}

/* Says what a level is, how far the effect stays within one, and up to which parameter it does so everywhere.
 */
static void say_reach(page *p, const table *t) {
    char all[64], within[256];
    if (!is_asked_of_all(t)) {
        page_text(p, "levels: changes of the output by 1/255, from the rounding of the depth%s",
                  t->steps ? "; those of a step are about twice as large" : "");
        return;
    }
    every_depth(p, t->each.setup, all);
    snprintf(within, sizeof within, "%s; with ",
             t->steps ? "a step of the stored depth changes the output by at most a level (1/255: what 8 bits hold)"
                      : "a plane is drawn right");
    if (isnan(t->everywhere))
        append(within, sizeof within, "no %s", t->wanted_name);
    else if (t->everywhere == (t->effect->smallest ? t->wanted->lo : t->wanted->hi))
        append(within, sizeof within, "every %s", t->wanted_name);
    else
        append(within, sizeof within, "%s %s %s%s", t->wanted_name, t->direction,
               (t->effect->smallest ? number_up : number_down)(t->everywhere, DIGITS).text,
               t->effect->smallest ? " up" : "");
    append(within, sizeof within, t->reach >= farthest(t->each.setup) ? ", too." : " %s.", all);
    say_within(p, t, t->reach, all, within);
    if (t->steps && !(t->reach >= farthest(t->each.setup)))
        say_within(p, t, t->rounding, all, "the rounding of the depth, about half a step, does.");
}

static void say_parameters(page *p, table *t) {
    char parameters[512] = "";
    for (size_t i = 0; next_parameter(t, i) != NULL; i++)
        append(parameters, sizeof parameters, ", %s %s", t->parameter.name,
               number_of(t->parameter.value, DIGITS_Z).text);
    if (t->effect->reference != NULL)
        append(parameters, sizeof parameters, "; %s at its worst", t->effect->reference);
    page_text(p, "%s%s", t->name, parameters);
    if (needs(t, EFFECT_POSITION))
        page_text(p, "pixel %u,%u of %u x %u, %s %s", t->column, t->line, t->spec.width, t->spec.height,
                  t->camera.ortho ? "half height" : "field of view",
                  number_of(t->camera.ortho ? t->spec.half_height : t->spec.fov_y, DIGITS_Z).text);
}

static void say_effect(page *p, void *item) {
    table *t = item;
    each_setup_title(p, item);
    say_parameters(p, t);
    if (t->effect->alone)
        page_text(p, "share: of the places of a plane that are wrong");
    say_reach(p, t);
}

/* Says the limit of another parameter, with the wanted one as it is. */
static void say_ceiling(page *p, const table *t) {
    const texture_parameter *other = &t->effect->parameters[t->effect->ceiling];
    const number_text wanted = number_of(t->parameters[t->effect->wanted], DIGITS_Z),
                      z = number_of(t->ceiling_z, DIGITS_Z);
    if (isnan(t->ceiling))
        page_line(p, "with %s %s no %s does at z = %s", t->wanted_name, wanted.text, other->name, z.text);
    else if (t->ceiling == other->hi)
        page_line(p, "with %s %s every %s does", t->wanted_name, wanted.text, other->name);
    else
        page_line(p, "with %s %s a %s up to %s does, too, and no larger one; z = %s decides", t->wanted_name,
                  wanted.text, other->name, number_down(t->ceiling, DIGITS).text, z.text);
}

/* The slope of a wall from which on it is one edge, and between which it is one here and there. */
static void say_slopes(page *p, const table *t) {
    const effect_slopes *s = &t->slopes;
    if (isnan(s->plane))
        return;
    const double slope = t->parameters[parameter_find(t->effect->parameters, "slope")];
    page_line(p,
              "a flat wall is drawn as an edge from a slope of %s on; as it is stored, at some pixels from %s on "
              "(z = %s), at all from %s on (z = %s)",
              number_of(s->plane, DIGITS).text, s->first > s->plane * 1e-6 ? number_down(s->first, DIGITS).text : "0",
              number_of(t->first_z, DIGITS_Z).text, number_up(s->last, DIGITS).text,
              number_of(t->last_z, DIGITS_Z).text);
    if (slope >= s->first && slope < s->last)
        page_line(p,
                  "a slope of %s lies between the two: edges come and go, 255 levels, with a pixel's place in its cell",
                  number_full(slope).text);
}

/* It is usable as it is printed. At the end of the range no depth decides. */
static void say_usable(page *p, void *item) {
    const table *t = item;
    const number_text usable = (t->effect->smallest ? number_up : number_down)(t->usable, DIGITS);
    const number_text z = number_of(t->z, DIGITS_Z);
    say_slopes(p, t);
    char decides[64] = "";
    if (t->usable != (t->effect->smallest ? t->wanted->lo : t->wanted->hi))
        snprintf(decides, sizeof decides, "; z = %s decides", z.text);
    if (is_asked_of_all(t))
        ; /* say_reach() has said it of all depths */
    else if (isnan(t->usable))
        page_line(p, "no %s is usable at z = %s", t->wanted_name, z.text);
    else
        page_line(p, "%s %s %s%s keeps the error at most one level at every depth shown%s", t->wanted_name,
                  t->direction, usable.text, t->effect->smallest ? " up" : "", decides);
    if (t->effect->ceiling > 0)
        say_ceiling(p, t);
}

static const column parameter_columns[] = {{FIELD(struct parameter, name, "name", "")},
                                           {FIELD(struct parameter, unit, "unit", "")},
                                           {FIELD(struct parameter, value, "value", "")},
                                           {.kind = COLUMN_END}};

enum { WITH_SHARE = 1, WITH_RADIUS = 2, WITH_STEPS = 4, USABLE_WIDTH = 17 };

static const column all_columns[] = {{FIELD(table, usable, "usable", "")},
                                     {FIELD(table, z, "z", "scene")},
                                     {FIELD(table, ceiling, "usable_radius", "scene"), .when = WITH_RADIUS},
                                     {FIELD(table, ceiling_z, "radius_z", "scene"), .when = WITH_RADIUS},
                                     {.kind = COLUMN_END}};

/* The last column is named by the parameter that is wanted, where there is room for that. */
static int write_table(table *t, int status) {
    char usable[64], shown[64];
    snprintf(usable, sizeof usable, "%s %s", t->wanted_name, t->direction);
    snprintf(shown, sizeof shown, "%s %s", strlen(usable) < USABLE_WIDTH ? t->wanted_name : "usable", t->direction);
    const column rows[] = {
        {FIELD(row, sample.z, "z", "scene"), SHOWN("z", 12, DIGITS_Z)},
        {FIELD(row, sample.code, "code", ""), SHOWN("code", 11, 0)},
        {FIELD(row, sample.stored, "z_stored", "scene"), SHOWN("stored", 15, DIGITS_Z)},
        {FIELD(row, sample.interval, "interval", "scene"), SHOWN("interval", 13, DIGITS), .spare = 1},
        {FIELD(row, levels, "levels", "1/255"), SHOWN("levels", 12, DIGITS), .upward = true},
        {FIELD(row, share, "share", ""), SHOWN("share", 12, DIGITS), .when = WITH_SHARE},
        {FIELD(row, usable, "usable", ""), SHOWN(shown, USABLE_WIDTH, DIGITS), .only = AS_JSON | AS_TEXT,
         .upward = t->effect->smallest, .downward = !t->effect->smallest},
        {FIELD(row, usable, usable, t->wanted->unit), .only = AS_CSV},
        {FIELD(row, ceiling, "usable_radius", "scene"), SHOWN("radius up to", 13, DIGITS), .when = WITH_RADIUS,
         .downward = true},
        {.kind = COLUMN_END}};
    const column setup_report[] = {{PART(table, each.fields, NULL, setup_columns)},
                                   {FIELD(table, name, "effect", ""), .only = AS_CSV},
                                   {LIST("rows", rows, next_row)},
                                   {GROUP("all", all_columns), .only = AS_JSON},
                                   {.kind = COLUMN_END}};
    const column columns[] = {{FIELD(table, name, "effect", ""), .only = AS_JSON},
                              {LIST("parameters", parameter_columns, next_parameter), .only = AS_JSON},
                              {FIELD(table, wanted_name, "wanted", ""), .only = AS_JSON},
                              {FIELD(table, direction, "direction", ""), .only = AS_JSON},
                              {LIST("setups", setup_report, next_setup), .head = say_effect, .notes = say_usable},
                              {.kind = COLUMN_END}};
    const unsigned when = (t->effect->alone ? WITH_SHARE : 0) | (t->effect->ceiling > 0 ? WITH_RADIUS : 0);
    const report_spec spec = {.command = "texture", .columns = columns, .item = t, .when = when};
    return each_setup_write(&t->each, &spec, status);
}

/* ---- Several set-ups beside each other --------------------------------------------------------------------------- */

static void *next_beside(void *of, size_t i) {
    table *t = of;
    if (next_setup(t, i) == NULL)
        return NULL;
    setup_label(t->each.setup, false, t->label);
    return t;
}

static void say_beside(page *p, void *item) {
    table *t = item;
    const texture_request *o = t->o;
    p->unit = camera_unit(&o->camera);
    page_title(p, "near %s, far %s, %s%s%s", number_full(o->camera.znear).text, number_full(o->camera.zfar).text,
               o->camera.ortho ? "orthographic" : "perspective", p->unit != NULL ? ", lengths in " : "",
               p->unit != NULL ? p->unit : "");
    say_parameters(p, t);
}

static void say_columns(page *p, void *item) {
    const table *t = item;
    char all[64];
    every_depth(p, &t->each.all.items[0], all);
    output_char(p->out, '\n');
    if (t->effect->kind == EFFECT_STEP)
        page_text(p, "Up to that z a plane is drawn right; with that %s it is %s.", t->wanted_name, all);
    else
        page_text(p,
                  "Up to the first z a step of the stored depth changes the output by at most a level (1/255: what 8 "
                  "bits hold), up to the second its rounding, about half a step; with that %s steps do so %s.",
                  t->wanted_name, all);
    page_text(p, "--full prints the tables: codes, depths, levels.");
}

static int write_beside(table *t, int status) {
    char usable[64];
    snprintf(usable, sizeof usable, "%s %s", t->wanted_name, t->direction);
    const column rows[] = {
        {TEXT_FIELD(table, label, "", -22, 0)},
        {TEXT_FIELD(table, reach, "up to z", 12, DIGITS), .downward = true, .brief = true},
        {TEXT_FIELD(table, rounding, "rounding", 12, DIGITS), .when = WITH_STEPS, .downward = true, .brief = true},
        {TEXT_FIELD(table, everywhere, usable, 24, DIGITS), .upward = t->effect->smallest,
         .downward = !t->effect->smallest, .brief = true},
        {.kind = COLUMN_END}};
    const column list[] = {{LIST(NULL, rows, next_beside), .head = say_beside, .notes = say_columns},
                           {.kind = COLUMN_END}};
    return each_setup_write(
        &t->each, &(report_spec){.command = "texture", .columns = list, .item = t, .when = t->steps ? WITH_STEPS : 0},
        status);
}

int texture_effect_table(const texture_request *o) {
    table t = {.o = o};
    int status = texture_effect_resolve(o, false, &t.effect, t.parameters);
    if (status == EXIT_FINE)
        status = texture_camera_check(o);
    if (status == EXIT_FINE)
        status = choose_pixel(&t, o);
    if (status == EXIT_FINE && t.effect->eye01 && isinf(o->camera.zfar))
        status = option_error("far", "must be finite for %s, which uses z/far, got inf", t.effect->name);
    if (status == EXIT_FINE)
        status = each_setup_start(&t.each, &o->camera, &o->out);
    if (status == EXIT_FINE)
        status = make_view(&t, &t.each.all.items[0]);
    t.name = t.effect->name;
    t.steps = t.effect->kind != EFFECT_STEP && effect_is_steady(t.effect);
    t.wanted = &t.effect->parameters[t.effect->wanted];
    t.wanted_name = t.wanted->name;
    t.direction = t.effect->smallest ? "from" : "up to";
    const bool beside = o->out.form == FORM_TEXT && !o->out.full && is_asked_of_all(&t);
    return (beside && t.each.all.count > 1 ? write_beside : write_table)(&t, status);
}
