/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A row a set-up: the separation that is guaranteed at a few depths, and the depth up to which three separations are.
 * The set-up that takes the middle one farthest comes first; sentences below say what follows.
 */
#include "quantity/cmd_table/compare.h"
#include "quantity/cmd_table/compared.h"
#include "quantity/cmd_table/request.h"
#include "quantity/cmd_table/slices.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/slant.h"
#include "core/append.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "quantity/cmd/resolved.h"
#include "report/number.h"
#include "solve/distance.h"

enum { DEPTHS_OF_PRESETS = 3, DIGITS_BOUND = 2, DIGITS_Z = 6, DIGITS_FOV = 4 };
enum { NAME_WIDTH = 20, COLUMN_WIDTH = 7, BYTES_WIDTH = 3, CODES_WIDTH = 11, PERCENT_WIDTH = 7, DIGITS_PERCENT = 3 };

static bool is_sliced(const comparison *c) {
    return c->o->camera.range_count > 1;
}

/* ---- What is measured -------------------------------------------------------------------------------------------- */

static void compute_row(const comparison *c, compared *r) {
    const unit_row *unit = c->o->camera.lengths.unit;
    const dp_setup full = dp_setup_guaranteed(r->setup); /* of what is unbounded, for surfaces that face the camera */
    r->uncertain = (double)NAN;
    for (size_t i = 0; i < c->depth_count; i++) {
        const double z = unit_convert(c->depths[i], unit, r->unit);
        const bool inside = z >= full.spec.znear && z <= full.spec.zfar;
        const double separation = inside ? dp_separation(&full, z) : (double)NAN;
        r->separation[i] = unit_convert(separation, r->unit, unit);
        if (inside && z < full.spec.zfar && full.spec.triangles.width == 0 && isfinite(full.spec.zfar) &&
            !dp_is_certain(&full, z, separation) && !(r->uncertain <= c->depths[i]))
            r->uncertain = c->depths[i];
    }
    resolved_up_to(&full, r->unit, r->up_to);
    for (size_t i = 0; i < RESOLVED_LIMITS; i++)
        r->up_to[i] = unit_convert(r->up_to[i], r->unit, unit);
    r->slanted_to = (double)NAN;
    if (r->assumed.spec.triangles.width > 0)
        r->slanted_to = unit_convert(distance_about(&r->assumed, r->assumed.spec.znear, r->assumed.spec.zfar,
                                                    resolved_limit(RESOLVED_MIDDLE, r->unit), RESOLVED_DIGITS),
                                     r->unit, unit);
}

/* Sorts what was asked for first, then by how far it goes, how close it comes and how cheap it is. */
static int better(const void *a, const void *b) {
    const compared *first = a, *second = b;
    if (first->unbounded != second->unbounded)
        return first->unbounded ? 1 : -1;
    for (size_t i = 0; i < RESOLVED_LIMITS; i++) {
        const size_t limit = (RESOLVED_MIDDLE + i) % RESOLVED_LIMITS;
        const double x = fmax(first->up_to[limit], 0.0), y = fmax(second->up_to[limit], 0.0);
        if (x != y)
            return x < y ? 1 : -1;
    }
    const int cheaper = cost_compare(&first->cost, &second->cost);
    return cheaper != 0 ? cheaper : first->setup < second->setup ? -1 : 1;
}

/* Between planes without powers of ten: multiples of 1, 2 or 5 times one, as many as there is room for. */
static void choose_multiples(comparison *c, double near, double far, double most) {
    static const double of[] = {1.0, 2.0, 5.0};
    const double power = floor(dp_log10(far - near)) - 1.0;
    double step = far - near;
    for (size_t i = 0; i < 2 * sizeof of / sizeof of[0]; i++) {
        step = of[i % 3] * dp_pow(10.0, power + (double)(i / 3));
        if (floor(far / step) - ceil(near / step) < most)
            break;
    }
    for (double k = ceil(near / step); k <= floor(far / step) && c->depth_count < COMPARED_DEPTHS; k++)
        c->depths[c->depth_count++] = fmin(fmax(k * step + 0.0, near), far); /* 0 is not -0 */
}

/* Chooses at most five of the depths asked about, else powers of ten: those that a reader looks for. */
static void choose_depths(comparison *c) {
    const table_request *o = c->o;
    double near = INFINITY, far = -INFINITY;
    for (size_t i = 0; i < c->each->all.count; i++) {
        near = fmin(near, c->rows[i].znear);
        far = fmax(far, isinf(c->rows[i].zfar) ? 1e6 * c->rows[i].znear : c->rows[i].zfar);
    }
    if (option_given(o->line, "at")) {
        for (c->depth_count = 0; c->depth_count < o->camera.at.count; c->depth_count++)
            c->depths[c->depth_count] = depths_get(&o->camera.at, c->depth_count);
        return;
    }
    const int most = o->camera.preset_count > 1 ? DEPTHS_OF_PRESETS : COMPARED_DEPTHS;
    if (!(near > 0)) {
        choose_multiples(c, near, far, most);
        return;
    }
    const int first = (int)ceil(dp_log10(near) - 1e-9), last = (int)floor(dp_log10(far) + 1e-9);
    const int step = (last - first) / most + 1;
    for (int e = last - (last - first) / step * step; e <= last && c->depth_count < COMPARED_DEPTHS; e += step)
        c->depths[c->depth_count++] = fmin(fmax(dp_pow(10.0, e), near), far);
    if (c->depth_count == 0)
        c->depths[c->depth_count++] = far;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* Says what the cameras have in common, and where there are several the planes of each. */
static void say_cameras(page *p, const comparison *c) {
    const table_request *o = c->o;
    char planes[1024] = "", more[64 + SETUP_RANGE_SIZE] = "", words[PRESET_WORDS_SIZE];
    const setup_fields f = setup_fields_asked(&c->each->all.items[0], &o->camera);
    if (o->camera.range_count < 2)
        setup_range(&f, more);
    if (o->camera.rounding != DP_ROUND_NEAREST)
        append(more, sizeof more, ", rounding %s", dp_rounding_name(o->camera.rounding));
    if (p->unit != NULL)
        append(more, sizeof more, ", lengths in %s", p->unit);
    if (o->camera.preset_count < 2) {
        page_title(p, "near %s, far %s, %s%s", setup_near(&f).text, setup_far(&f).text, f.projection, more);
        setup_say_planes(p, &f);
        slant_say(p, page_title, &o->camera, NULL);
        return;
    }
    page_title(p, "%zu presets, %s%s", o->camera.preset_count, f.projection, more);
    slant_say(p, page_title, &o->camera, NULL);
    for (size_t k = 0; k < o->camera.preset_count; k++)
        for (size_t i = 0; i < c->each->all.count; i++)
            if (c->rows[i].camera == k) {
                append(planes, sizeof planes, "%s%s near %s, far %s", k > 0 ? "; " : "",
                       camera_preset_label(&o->camera, k, words), number_full(c->rows[i].znear).text,
                       number_full(c->rows[i].zfar).text);
                if (o->camera.triangles.width > 0)
                    append(planes, sizeof planes, ", fov %s, %s", number_of(c->rows[i].fov_y, DIGITS_FOV).text,
                           c->rows[i].raster);
                break;
            }
    page_text(p, "%s", planes);
}

static void say_head(page *p, void *item) {
    static const char *const above_limits[RESOLVED_LIMITS + 1] = {"", "to z", "up to z", "resolved up to z"};
    static const char *const above_depths[3][3] = {{"guaranteed facing, at z", "facing, at z", "facing"},
                                                   {"guaranteed at any slant, z", "any slant, at z", "any slant"},
                                                   {"guaranteed at that slant, z", "that slant, at z", "that slant"}};
    const comparison *c = item;
    const int width = COLUMN_WIDTH * (int)c->depth_count, limits = c->limit_end - c->limit_begin;
    p->unit = camera_unit(&c->o->camera);
    say_cameras(p, c);
    if (c->bounded == 0)
        return;
    const dp_triangles *t = &c->o->camera.triangles;
    const char *const *words = above_depths[t->width == 0 ? 0 : surfaces_any_slant(t) ? 1 : 2];
    output_format(p->out, "%s%-*s%*s%*s%s\n", p->soft, c->name_width + (is_sliced(c) ? CODES_WIDTH + PERCENT_WIDTH : 0),
                  width > 20 ? "" : words[2], width,
                  width > 27   ? words[0]
                  : width > 20 ? words[1]
                  : width > 0  ? "at z"
                               : "",
                  COLUMN_WIDTH * limits, above_limits[limits], p->plain);
}

static void *next_row(void *of, size_t i) {
    comparison *c = of;
    return i < c->bounded ? &c->rows[i] : NULL;
}

/* Names of presets take room: of the limits, those beside the middle one go first. */
static void fit(comparison *c) {
    for (size_t i = 0; i < c->each->all.count; i++)
        c->name_width = (int)fmax(c->name_width, (double)strlen(c->rows[i].name) + 1);
    const int width =
        page_start(&c->each->out, 0).width - c->name_width - (is_sliced(c) ? CODES_WIDTH + PERCENT_WIDTH : 0);
    while (c->depth_count > 0 && width < COLUMN_WIDTH * (int)(c->depth_count + 1)) /* the farther ones stay */
        memmove(c->depths, c->depths + 1, --c->depth_count * sizeof c->depths[0]);
    const int room = width - COLUMN_WIDTH * (int)c->depth_count;
    const bool all = room >= COLUMN_WIDTH * RESOLVED_LIMITS + BYTES_WIDTH;
    c->limit_begin = all ? 0 : RESOLVED_MIDDLE;
    c->limit_end = all ? RESOLVED_LIMITS : RESOLVED_MIDDLE + (room >= COLUMN_WIDTH * 2 ? 2 : 1);
}

static void write(comparison *c) {
    column rows[1 + 2 + COMPARED_DEPTHS + RESOLVED_LIMITS + 2] = {{TEXT_FIELD(compared, name, "", -c->name_width, 0)}};
    size_t n = 1;
    if (is_sliced(c)) {
        rows[n++] = (column){TEXT_FIELD(compared, codes, "codes", CODES_WIDTH, 0)};
        rows[n++] = (column){TEXT_FIELD(compared, percent, "%", PERCENT_WIDTH, DIGITS_PERCENT), .brief = true};
    }
    for (size_t i = 0; i < c->depth_count; i++) {
        snprintf(c->titles[i], NUMBER_SIZE, "%s", number_of(c->depths[i], DIGITS_Z).text);
        rows[n++] = (column){TEXT_FIELD(compared, separation[0], c->titles[i], COLUMN_WIDTH, DIGITS_BOUND),
                             .upward = true, .brief = true};
        rows[n - 1].offset = offsetof(compared, separation[i]);
    }
    for (int i = c->limit_begin; i < c->limit_end; i++) {
        char *title = c->titles[COMPARED_DEPTHS + i];
        snprintf(title, NUMBER_SIZE, "%s", resolved_limit_text((size_t)i, c->o->camera.lengths.unit).text);
        rows[n++] = (column){TEXT_FIELD(compared, up_to[0], title, COLUMN_WIDTH, RESOLVED_DIGITS), .downward = true,
                             .brief = true};
        rows[n - 1].offset = offsetof(compared, up_to[i]);
    }
    if (c->limit_end - c->limit_begin == RESOLVED_LIMITS)
        rows[n++] = (column){TEXT_FIELD(compared, bytes, "B", BYTES_WIDTH, 0)};
    rows[n] = (column){.kind = COLUMN_END};
    const column columns[] = {{LIST(NULL, rows, next_row), .head = say_head, .notes = compared_say},
                              {.kind = COLUMN_END}};
    report_write(&(report_spec){"table", columns, c, .label = 16}, &c->each->out, FORM_TEXT);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

bool compare_suits(const each_setup *w, const table_request *o) {
    return o->out.form == FORM_TEXT && w->all.count > 1 && !o->out.full && !option_given(o->line, "model") &&
           !option_given(o->line, "range") && !option_given(o->line, "tolerance") &&
           (!option_given(o->line, "at") || w->at.count <= COMPARED_DEPTHS);
}

static void compare_setup(comparison *c, size_t i) {
    compared *r = &c->rows[i];
    const table_request *o = c->o;
    const bool slanted = o->camera.triangles.width > 0;
    each_setup_go(c->each, i);
    const dp_mapping mapping = c->each->setup->spec.mapping;
    char words[PRESET_WORDS_SIZE] = "";
    const char *engine =
        c->each->fields.preset != NULL ? camera_preset_label(&o->camera, c->each->all.cameras[i], words) : NULL;
    *r = (compared){
        .setup = c->each->setup,
        .camera = c->each->all.cameras[i],
        .unit = c->each->here->lengths.unit,
        .znear = unit_convert(c->each->setup->spec.znear, c->each->here->lengths.unit, o->camera.lengths.unit),
        .zfar = unit_convert(c->each->setup->spec.zfar, c->each->here->lengths.unit, o->camera.lengths.unit),
        .fov_y = c->each->here->triangles.fov_y,
        .unbounded = slanted && dp_mapping_get(mapping)->curve != DP_CURVE_PERSPECTIVE,
        .assumed = c->each->assumed,
        .cost = cost_of(&c->each->setup->spec.format, mapping)};
    char label[SETUP_LABEL_SIZE], slice[SETUP_RANGE_SIZE];
    const raster_row *raster = c->each->here->raster;
    if (raster != NULL)
        snprintf(r->raster, sizeof r->raster, "%s", raster->name);
    else
        snprintf(r->raster, sizeof r->raster, "%d subpixel bits", c->each->here->triangles.subpixel);
    snprintf(r->name, sizeof r->name, "%s%s%s%s", engine != NULL ? engine : "", engine != NULL ? " " : "",
             setup_label(r->setup, false, label), setup_slice(&o->camera, r->setup, slice));
    r->codes = slice_codes(r->setup);
    r->percent = 100.0 * slice_share(r->setup);
    r->bytes = (uint64_t)r->cost.bytes;
}

int compare_write(each_setup *w, const table_request *o) {
    comparison c = {.o = o, .each = w, .rows = calloc(w->all.count, sizeof(compared)), .name_width = NAME_WIDTH};
    int status = c.rows != NULL ? output_start(&o->out, &o->camera, &w->out) : usage_error("table: no memory");
    if (status == EXIT_FINE) {
        for (size_t i = 0; i < w->all.count; i++)
            compare_setup(&c, i);
        choose_depths(&c);
        fit(&c);
        for (size_t i = 0; i < w->all.count; i++)
            compute_row(&c, &c.rows[i]);
        for (size_t i = 0; i < w->all.count; i++)
            c.bounded += !c.rows[i].unbounded;
        qsort(c.rows, w->all.count, sizeof *c.rows, better);
        write(&c);
        status = output_close(&w->out);
    }
    free(c.rows);
    setups_release(&w->all);
    return status;
}
