/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * A row a set-up: the separation that is guaranteed at a few depths, and the depth up to which three separations are.
 * The set-up that takes the middle one farthest comes first; sentences below say what follows.
 */
#include "quantity/cmd_table/compare.h"
#include "quantity/cmd_table/request.h"
#include "quantity/cmd_table/slices.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/depth24plus.h"
#include "camera/cmd/slant.h"
#include "camera/cost.h"
#include "core/append.h"
#include "core/elementary.h"
#include "core/engine.h"
#include "quantity/cmd/resolved.h"
#include "report/number.h"
#include "solve/distance.h"

enum {
    DEPTHS = 5,
    DEPTHS_OF_PRESETS = 3,
    LIMITS = RESOLVED_LIMITS,
    MIDDLE = RESOLVED_MIDDLE,
    NAMED = 3,
    SLANTED_NAMED = 4,
    DIGITS_BOUND = 2,
    DIGITS_Z = 6,
    DIGITS_FOV = 4
};
enum { NAME_WIDTH = 20, COLUMN_WIDTH = 7, BYTES_WIDTH = 3, CODES_WIDTH = 11, PERCENT_WIDTH = 7, DIGITS_PERCENT = 3 };

/* Lengths are in the unit of the comparison; the set-up has its own, see camera_of(). */
typedef struct compared {
    const dp_setup *setup;
    size_t camera;
    const unit_row *unit; /* of the set-up; null where nothing says it */
    double znear, zfar, fov_y;
    char raster[32];
    bool unbounded; /* slanted surfaces, under a mapping that promises those that face the camera alone */
    cost cost;
    char name[SETUP_LABEL_SIZE];
    double separation[DEPTHS]; /* NaN where the depth is not in the range of the set-up */
    double uncertain;          /* the first of these, before far, behind which nothing is certain; NaN: none */
    double up_to[LIMITS];      /* NaN: not even at near */
    dp_setup assumed;          /* at any slant, see each_setup.h */
    double slanted_to;         /* how far the middle limit goes there; NaN: not even at near, or nothing is known */
    uint64_t bytes;
    double codes, percent; /* that a depth range keeps, and of all */
} compared;

typedef struct comparison {
    const table_request *o;
    each_setup *each;
    compared *rows;
    size_t bounded; /* rows that have what is asked for; the others stand behind them, and below the table */
    double depths[DEPTHS];
    size_t depth_count;
    char titles[DEPTHS + LIMITS][NUMBER_SIZE];
    int name_width, limit_begin, limit_end; /* limits that are shown */
} comparison;

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
    for (size_t i = 0; i < LIMITS; i++)
        r->up_to[i] = unit_convert(r->up_to[i], r->unit, unit);
    r->slanted_to = (double)NAN;
    if (r->assumed.spec.triangles.width > 0)
        r->slanted_to = unit_convert(distance_about(&r->assumed, r->assumed.spec.znear, r->assumed.spec.zfar,
                                                    resolved_limit(MIDDLE, r->unit), RESOLVED_DIGITS),
                                     r->unit, unit);
}

/* Sorts what was asked for first, then by how far it goes, how close it comes and how cheap it is. */
static int better(const void *a, const void *b) {
    const compared *first = a, *second = b;
    if (first->unbounded != second->unbounded)
        return first->unbounded ? 1 : -1;
    for (size_t i = 0; i < LIMITS; i++) {
        const size_t limit = (MIDDLE + i) % LIMITS;
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
    for (double k = ceil(near / step); k <= floor(far / step) && c->depth_count < DEPTHS; k++)
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
    const int most = o->camera.preset_count > 1 ? DEPTHS_OF_PRESETS : DEPTHS;
    if (!(near > 0)) {
        choose_multiples(c, near, far, most);
        return;
    }
    const int first = (int)ceil(dp_log10(near) - 1e-9), last = (int)floor(dp_log10(far) + 1e-9);
    const int step = (last - first) / most + 1;
    for (int e = last - (last - first) / step * step; e <= last && c->depth_count < DEPTHS; e += step)
        c->depths[c->depth_count++] = fmin(fmax(dp_pow(10.0, e), near), far);
    if (c->depth_count == 0)
        c->depths[c->depth_count++] = far;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static bool to_the_end(const compared *r) {
    return r->up_to[MIDDLE] >= r->zfar;
}

static number_text at_a_slant(const comparison *c) {
    const dp_triangles *t = &c->o->camera.triangles;
    number_text out = {""};
    if (t->width > 0)
        append(out.text, sizeof out.text, " at %s", slant_words(t).text);
    else
        append(out.text, sizeof out.text, " " SLANT_FACING);
    return out;
}

/* The next of them at any slant, behind one that reaches `from`, the first where two reach as far; null: no more. */
static const compared *next_slanted(const comparison *c, const compared *last) {
    const compared *next = NULL;
    for (const compared *r = c->rows; r < c->rows + c->each->all.count; r++) {
        const bool behind =
            last == NULL || r->slanted_to < last->slanted_to || (r->slanted_to == last->slanted_to && r > last);
        if (!isnan(r->slanted_to) && behind && (next == NULL || r->slanted_to > next->slanted_to))
            next = r;
    }
    return next;
}

/* The table is of surfaces that face the camera: this is what it comes to at any slant. */
static void say_slanted(page *p, const comparison *c, const char *limit) {
    char said[512] = "", view[SLANT_ASSUMED_SIZE] = "presets' views", text[RESOLVED_TEXT_SIZE];
    const compared *of = c->rows, *r = NULL;
    while (of < c->rows + c->each->all.count && of->assumed.spec.triangles.width == 0)
        of++;
    if (of == c->rows + c->each->all.count)
        return;
    if (c->o->camera.preset_count < 2)
        slant_assumed(&of->assumed.spec.triangles, view);
    for (size_t i = 0; i < SLANTED_NAMED && (r = next_slanted(c, r)) != NULL; i++)
        append(said, sizeof said, "%s %s up to %s", *said != '\0' ? "," : "", r->name,
               resolved_text(r->zfar, r->slanted_to, c->o->camera.lengths.unit, text));
    if (*said != '\0')
        page_text(p, "At any slant (%s) %s is resolved by%s.", view, limit, said);
    else
        page_text(p, "At any slant (%s) none is guaranteed to resolve %s, even at the near plane.", view, limit);
}

static void say_farthest(page *p, const comparison *c, const char *limit) {
    const compared *best = c->rows;
    const number_text slanted = at_a_slant(c);
    const char *const slant = slanted.text;
    char names[256] = "", text[RESOLVED_TEXT_SIZE];
    size_t all = 0;
    while (all < c->bounded && to_the_end(&c->rows[all]))
        all++;
    for (size_t i = 0; i < all && i < NAMED; i++)
        append(names, sizeof names, "%s%s", i == 0 ? "" : i + 1 == all ? " and " : ", ", c->rows[i].name);
    if (all > NAMED)
        append(names, sizeof names, " and %zu other%s", all - NAMED, all - NAMED == 1 ? "" : "s");
    if (c->bounded == 0 || isnan(best->up_to[MIDDLE]))
        page_text(p, "None of these is guaranteed to resolve %s%s, even at the near plane.", limit, slant);
    else if (all == 0)
        page_text(p, "%s reaches farthest: it resolves %s%s up to z = %s.", best->name, limit, slant,
                  resolved_text(best->zfar, best->up_to[MIDDLE], c->o->camera.lengths.unit, text));
    else
        page_text(p, "%s resolve%s %s%s all the way to the far plane.", names, all == 1 ? "s" : "", limit, slant);
}

/* The row of the same format, reversed with the same range of NDC depth; null where there is none. */
static const compared *reversed_of(const comparison *c, const compared *r) {
    const dp_mapping_row *here = dp_mapping_get(r->setup->spec.mapping);
    for (size_t i = 0; i < c->each->all.count; i++) {
        const dp_spec *other = &c->rows[i].setup->spec;
        const dp_mapping_row *there = dp_mapping_get(other->mapping);
        if (c->rows[i].camera == r->camera && !here->reversed && there->reversed &&
            memcmp(other->depth_range, r->setup->spec.depth_range, sizeof other->depth_range) == 0 &&
            here->ndc_signed == there->ndc_signed && here->curve == DP_CURVE_PERSPECTIVE &&
            strcmp(other->format.name, r->setup->spec.format.name) == 0)
            return &c->rows[i];
    }
    return NULL;
}

static void say_reversing(page *p, const comparison *c, const char *limit) {
    char gains[512] = "", before[RESOLVED_TEXT_SIZE], after[RESOLVED_TEXT_SIZE];
    for (size_t i = 0; i < c->each->all.count; i++) {
        const compared *r = &c->rows[i], *other = reversed_of(c, r);
        if (other == NULL || r->cost.buffer == 0 || isnan(r->up_to[MIDDLE]))
            continue;
        resolved_text(r->zfar, r->up_to[MIDDLE], c->o->camera.lengths.unit, before);
        resolved_text(other->zfar, other->up_to[MIDDLE], c->o->camera.lengths.unit, after);
        append(gains, sizeof gains, "%s %s", *gains != '\0' ? "," : "", r->name);
        append(gains, sizeof gains, strcmp(before, after) == 0 ? " not at all" : " from %s to %s", before, after);
    }
    if (*gains != '\0')
        page_text(p, "Reversing moves the limit for %s:%s.", limit, gains);
}

/* Its mapping is not affine on the screen. */
static void say_facing(page *p, const comparison *c, const compared *r, const char *limit) {
    char text[RESOLVED_TEXT_SIZE];
    if (isnan(r->up_to[MIDDLE]))
        page_text(p, "%s guarantees nothing at a slant, nor %s where surfaces face the camera.", r->name, limit);
    else
        page_text(
            p, "%s guarantees nothing at a slant; facing the camera it resolves %s up to %s%s.", r->name, limit,
            to_the_end(r) ? "" : "z = ", resolved_text(r->zfar, r->up_to[MIDDLE], c->o->camera.lengths.unit, text));
}

/* Says the cost of a mapping in each frame, where the hardware does not compute depth by itself. */
static void say_costs(page *p, const comparison *c) {
    unsigned said = 0;
    for (size_t i = 0; i < c->each->all.count; i++) {
        const dp_mapping mapping = c->rows[i].setup->spec.mapping;
        const dp_mapping_row *row = dp_mapping_get(mapping);
        if (row->curve == DP_CURVE_PERSPECTIVE || dp_format_is_rg(&c->rows[i].setup->spec.format))
            continue;
        if ((said >> mapping & 1U) == 0)
            page_text(p, "Cost of %s: %s.", row->name, row->effort);
        said |= 1U << mapping;
    }
}

/* A guarantee may exceed the distance that is left up to far. */
static void say_uncertain(page *p, const comparison *c) {
    char names[1024] = "";
    for (size_t i = 0; i < c->bounded; i++)
        if (!isnan(c->rows[i].uncertain))
            append(names, sizeof names, "%s %s from z = %s", *names != '\0' ? "," : "", c->rows[i].name,
                   number_of(c->rows[i].uncertain, DIGITS_Z).text);
    if (*names != '\0')
        page_text(p, "Nothing behind is certain, up to far:%s.", names);
}

static void say_notes(page *p, void *item) {
    const comparison *c = item;
    const number_text limit = resolved_limit_text(MIDDLE, c->o->camera.lengths.unit);
    bool linear = false;
    output_char(p->out, '\n');
    say_farthest(p, c, limit.text);
    slices_say(p, &c->o->camera, &c->each->all);
    say_slanted(p, c, limit.text);
    say_reversing(p, c, limit.text);
    for (size_t i = c->bounded; i < c->each->all.count; i++)
        say_facing(p, c, &c->rows[i], limit.text);
    say_costs(p, c);
    for (size_t i = 0; i < c->each->all.count; i++)
        linear = linear || (dp_mapping_get(c->rows[i].setup->spec.mapping)->curve == DP_CURVE_LINEAR &&
                            !dp_format_is_rg(&c->rows[i].setup->spec.format));
    if (linear)
        page_text(p, "linear is judged without the arithmetic of its shader (model staged).");
    size_t rg = 0;
    while (rg < c->each->all.count && !dp_format_is_rg(&c->rows[rg].setup->spec.format))
        rg++;
    if (rg < c->each->all.count)
        page_text(p, RG_NOTE);
    for (size_t i = 0; i < c->each->all.count; i++)
        if (c->rows[i].cost.buffer == 0) {
            page_text(p, "No API has %s as a depth buffer.", c->rows[i].setup->spec.format.name);
            break;
        }
    depth24plus_say(p, &c->o->camera);
    say_uncertain(p, c);
    page_text(p, "%s%s--full prints codes, errors, intervals, worst cases.",
              c->o->camera.triangles.width == 0 ? "Facing the camera: " SLANT_AS_WALL ". " : "",
              c->limit_end - c->limit_begin == LIMITS && c->bounded > 0 ? "B: bytes a pixel. " : "");
}

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
    static const char *const above_limits[LIMITS + 1] = {"", "to z", "up to z", "resolved up to z"};
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
    const char *const *words = above_depths[t->width == 0 ? 0 : t->slant_lo < t->slant_hi ? 1 : 2];
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
    const bool all = room >= COLUMN_WIDTH * LIMITS + BYTES_WIDTH;
    c->limit_begin = all ? 0 : MIDDLE;
    c->limit_end = all ? LIMITS : MIDDLE + (room >= COLUMN_WIDTH * 2 ? 2 : 1);
}

static void write(comparison *c) {
    column rows[1 + 2 + DEPTHS + LIMITS + 2] = {{TEXT_FIELD(compared, name, "", -c->name_width, 0)}};
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
        char *title = c->titles[DEPTHS + i];
        snprintf(title, NUMBER_SIZE, "%s", resolved_limit_text((size_t)i, c->o->camera.lengths.unit).text);
        rows[n++] = (column){TEXT_FIELD(compared, up_to[0], title, COLUMN_WIDTH, RESOLVED_DIGITS), .downward = true,
                             .brief = true};
        rows[n - 1].offset = offsetof(compared, up_to[i]);
    }
    if (c->limit_end - c->limit_begin == LIMITS)
        rows[n++] = (column){TEXT_FIELD(compared, bytes, "B", BYTES_WIDTH, 0)};
    rows[n] = (column){.kind = COLUMN_END};
    const column columns[] = {{LIST(NULL, rows, next_row), .head = say_head, .notes = say_notes}, {.kind = COLUMN_END}};
    report_write(&(report_spec){"table", columns, c, .label = 16}, &c->each->out, FORM_TEXT);
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

bool compare_suits(const each_setup *w, const table_request *o) {
    return o->out.form == FORM_TEXT && w->all.count > 1 && !o->out.full && !option_given(o->line, "model") &&
           !option_given(o->line, "range") && !option_given(o->line, "tolerance") &&
           (!option_given(o->line, "at") || w->at.count <= DEPTHS);
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
