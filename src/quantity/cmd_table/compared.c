/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/compared.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "camera/cmd/depth24plus.h"
#include "camera/cmd/slant.h"
#include "cli/option/names.h"
#include "core/append.h"
#include "core/engine.h"
#include "quantity/cmd_table/slices.h"
#include "report/number.h"

enum { NAMED = 3, SLANTED_NAMED = 4, DIGITS_Z = 6 };

static bool to_the_end(const compared *r) {
    return r->up_to[RESOLVED_MIDDLE] >= r->zfar;
}

static number_text at_a_slant(const comparison *c) {
    const dp_triangles *t = &c->o->camera.triangles;
    number_text out = {""};
    if (t->width > 0)
        append(out.text, sizeof out.text, " at %s", surfaces_words(t).text);
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
    if (c->bounded == 0 || isnan(best->up_to[RESOLVED_MIDDLE]))
        page_text(p, "None of these is guaranteed to resolve %s%s, even at the near plane.", limit, slant);
    else if (all == 0)
        page_text(p, "%s reaches farthest: it resolves %s%s up to z = %s.", best->name, limit, slant,
                  resolved_text(best->zfar, best->up_to[RESOLVED_MIDDLE], c->o->camera.lengths.unit, text));
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
        if (other == NULL || r->cost.buffer == 0 || isnan(r->up_to[RESOLVED_MIDDLE]))
            continue;
        resolved_text(r->zfar, r->up_to[RESOLVED_MIDDLE], c->o->camera.lengths.unit, before);
        resolved_text(other->zfar, other->up_to[RESOLVED_MIDDLE], c->o->camera.lengths.unit, after);
        append(gains, sizeof gains, "%s %s", *gains != '\0' ? "," : "", r->name);
        append(gains, sizeof gains, strcmp(before, after) == 0 ? " not at all" : " from %s to %s", before, after);
    }
    if (*gains != '\0')
        page_text(p, "Reversing moves the limit for %s:%s.", limit, gains);
}

/* Its mapping is not affine on the screen. */
static void say_facing(page *p, const comparison *c, const compared *r, const char *limit) {
    char text[RESOLVED_TEXT_SIZE];
    if (isnan(r->up_to[RESOLVED_MIDDLE]))
        page_text(p, "%s guarantees nothing at a slant, nor %s where surfaces face the camera.", r->name, limit);
    else
        page_text(p, "%s guarantees nothing at a slant; facing the camera it resolves %s up to %s%s.", r->name, limit,
                  to_the_end(r) ? "" : "z = ",
                  resolved_text(r->zfar, r->up_to[RESOLVED_MIDDLE], c->o->camera.lengths.unit, text));
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

/* Names the formats that no API has as depth buffers, the first few. */
static void say_targets(page *p, const comparison *c) {
    const char *words[NAMED + 2] = {NULL};
    const name_list targets = {.words = words};
    char text[NAMES_SIZE];
    size_t count = 0;
    for (size_t i = 0; i < c->each->all.count; i++) {
        const char *name = c->rows[i].setup->spec.format.name;
        if (c->rows[i].cost.buffer == 0 && !names_find(&targets, name, NULL, NULL) && count <= NAMED) {
            words[count] = count < NAMED ? name : "others";
            count++;
        }
    }
    if (count > 0)
        page_text(p, "No API has %s as a depth buffer.", names_join(&targets, ", ", " or ", text));
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

void compared_say(page *p, void *item) {
    const comparison *c = item;
    const number_text limit = resolved_limit_text(RESOLVED_MIDDLE, c->o->camera.lengths.unit);
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
    say_targets(p, c);
    depth24plus_say(p, &c->o->camera);
    say_uncertain(p, c);
    page_text(p, "%s%s--full prints codes, errors, intervals, worst cases.",
              c->o->camera.triangles.width == 0 ? "Facing the camera: " SLANT_AS_WALL ". " : "",
              c->limit_end - c->limit_begin == RESOLVED_LIMITS && c->bounded > 0 ? "B: bytes a pixel. " : "");
}
