/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What list prints: every row of every table with its own note, source, spellings and numbers, in all three forms. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/bias.h"
#include "api/platform.h"
#include "api/presets.h"
#include "frame/synthetic.h"
#include "method/choose.h"
#include "plot/figure.h"
#include "printed.h"
#include "raster/raster.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/pack.h"
#include "shader/packing.h"
#include "shader/position.h"

enum { NUMBERS = 32 };

/** A row as its table has it. */
typedef struct listed {
    const char *name, *aliases, *note, *source;
    double numbers[NUMBERS]; /**< that the claim names, in order, to three digits */
    size_t count;
} listed;

static void add_number(listed *l, double number) {
    assert_true(l->count < NUMBERS);
    l->numbers[l->count++] = number;
}

/* ---- The tables -------------------------------------------------------------------------------------------------- */

static bool format(size_t i, listed *l) {
    const dp_format_row *r = dp_format_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->format.name, r->aliases, r->note, r->source, {r->claim_absolute, r->claim_relative}, 2};
    l->count = r->claim_relative > 0 ? 2 : 1;
    return true;
}

static bool mapping(size_t i, listed *l) {
    const dp_mapping_row *r = i < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)i) : NULL;
    if (r != NULL)
        *l = (listed){r->name, r->aliases, r->note, r->source, {0}, 0};
    return r != NULL;
}

static bool arith(size_t i, listed *l) {
    const dp_arith_row *r = dp_arith_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    return r != NULL;
}

static bool model(size_t i, listed *l) {
    if (i > DP_MODEL_COUNT)
        return false;
    *l = (listed){i < DP_MODEL_COUNT ? dp_model_name((dp_model)i) : "auto", "", NULL, NULL, {0}, 0};
    return true;
}

static bool cause(size_t i, listed *l) {
    if (i < DP_CAUSE_COUNT)
        *l = (listed){dp_cause_name((dp_cause)i), "", NULL, NULL, {0}, 0};
    return i < DP_CAUSE_COUNT;
}

static bool preset_row(size_t i, listed *l) {
    const preset *r = preset_get(i);
    if (r != NULL)
        *l = (listed){r->name,
                      "",
                      r->note,
                      r->source,
                      {r->znear, isinf(r->zfar) ? r->fov : r->zfar, r->fov},
                      isinf(r->zfar) ? 2 : 3};
    return r != NULL;
}

static bool platform_row(size_t i, listed *l) {
    const platform *r = platform_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    return r != NULL;
}

static bool api(size_t i, listed *l) {
    const bias_api *r = bias_api_get(i);
    if (r != NULL)
        *l = (listed){r->name, r->aliases, r->note, r->source, {0}, 0};
    return r != NULL;
}

static bool rasterizer(size_t i, listed *l) {
    const raster_row *r = raster_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->name, "", r->note, r->source, {r->subpixel_bits}, 1};
    const dp_anchor_row *anchor = dp_anchor_get(r->anchor);
    const double terms[] = {anchor == NULL ? 0 : anchor->plane.value, anchor == NULL ? 0 : anchor->plane.box,
                            anchor == NULL ? 0 : anchor->plane.range, anchor == NULL ? 0 : anchor->plane.origin};
    for (int k = 0; anchor != NULL && k < 4; k++)
        add_number(l, terms[k]);
    return true;
}

static bool encoding(size_t i, listed *l) {
    const pack_row *r = pack_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    if (r->kind != PACK_DEPTH) {
        add_number(l, r->normal.mean);
        add_number(l, r->normal.max);
    }
    if (r->kind != PACK_NORMAL) {
        add_number(l, r->depth.mean);
        add_number(l, r->depth.max);
    }
    return true;
}

static bool effect(size_t i, listed *l) {
    const effect_row *r = effect_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    for (int k = 0; r->parameters[k].name != NULL; k++)
        for (int n = 0; n < 3; n++)
            add_number(l, n == 0 ? r->parameters[k].value : n == 1 ? r->parameters[k].lo : r->parameters[k].hi);
    return true;
}

static bool figure(size_t i, listed *l) {
    const figure_row *r = figure_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->summary, NULL, {0}, 0};
    return r != NULL;
}

static bool synthetic(size_t i, listed *l) {
    const synthetic_row *r = synthetic_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->name, "", r->note, NULL, {0}, 0};
    for (size_t k = 0; k < PARAMETERS_MAX && r->parameters[k].name != NULL; k++)
        add_number(l, r->parameters[k].value);
    return true;
}

/* Half a step, and what binary32 adds; with three digits, rounded up. */
static bool packing_row(size_t i, listed *l) {
    static const double halves[] = {7.81e-06, 7.81e-06, 1.17e-10, 2.33e-10, 2.99e-08, 2.99e-08, 0.00197};
    const struct packing *r = packing_get(i);
    if (r != NULL) {
        *l = (listed){r->name, "", r->note, r->source, {0}, 0};
        add_number(l, halves[i]);
    }
    return r != NULL;
}

static bool product(size_t i, listed *l) {
    static const char *const kinds[] = {"eye",    "radial",        "linear01", "raw",   "position",
                                        "normal", "packed-normal", "pack",     "effect"};
    if (i >= sizeof kinds / sizeof kinds[0])
        return false;
    *l = (listed){kinds[i], "", NULL, NULL, {0}, 0};
    return true;
}

static bool position(size_t i, listed *l) {
    const position_row *r = position_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    return r != NULL;
}

static bool normal(size_t i, listed *l) {
    const normal_row *r = normal_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->note, r->source, {0}, 0};
    return r != NULL;
}

/* The claims of the cases in turn; a formula is shown at far/near 10000. */
static bool method(size_t i, listed *l) {
    const method_row *r = method_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->name, method_family_get(r->family)->name, r->note, r->source, {0}, 0};
    for (size_t k = 0; k < method_family_get(r->family)->case_count; k++) {
        const method_claim *c = &r->claims[k];
        if (!method_speaks(r, k) || isnan(c->worst))
            continue;
        add_number(l, method_claim_at(c, fmin(1e4, c->ratio_hi)));
        if (c->formula != NULL)
            add_number(l, 1e4);
        if (c->ratio_hi < METHOD_RATIO_HI)
            add_number(l, c->ratio_hi);
    }
    return true;
}

static const struct {
    const char *what, *bound;
    bool (*get)(size_t, listed *);
} topics[] = {{"formats", "bound", format},
              {"mappings", "bound", mapping},
              {"models", "bound", model},
              {"arithmetic", "bound", arith},
              {"causes", "bound", cause},
              {"presets", "camera", preset_row},
              {"platforms", "stored", platform_row},
              {"apis", "rule", api},
              {"rasterizers", "arithmetic", rasterizer},
              {"encodings", "bound", encoding},
              {"packings", "bound", packing_row},
              {"products", "methods", product},
              {"effects", "parameters", effect},
              {"figures", "bound", figure},
              {"synthetic", "bound", synthetic},
              {"positions", "bound", position},
              {"normals", "bound", normal},
              {"methods", "bound", method}};
enum { TOPICS = sizeof topics / sizeof topics[0] };

/* ---- Against what is printed ------------------------------------------------------------------------------------- */

static const char *text_in(const json_t *o, const char *key) {
    return json_string_value(json_object_get(o, key));
}

/* The numbers of a claim, those in names ("unorm24", "2^-N") aside. */
static void check_numbers(const char *bound, const listed *l) {
    size_t n = 0;
    for (const char *at = bound != NULL ? bound : ""; *at != '\0' && n < l->count;) {
        char *end;
        at += strspn(at, " ");
        const double number = strtod(at, &end);
        const bool alone =
            end > at && (at == bound || strchr(" =", at[-1]) != NULL) && (*end == '\0' || strchr(" ,;", *end) != NULL);
        if (alone && isdigit((unsigned char)(*at == '-' ? at[1] : *at))) {
            if (fabs(number - l->numbers[n]) > 0.006 * fabs(l->numbers[n]))
                fail_msg("%s: '%s': number %zu is %g, not %g", l->name, bound, n, number, l->numbers[n]);
            n++;
        }
        at = end > at ? end : at + 1;
    }
    if (n != l->count)
        fail_msg("%s: '%s' has %zu numbers, not %zu", l->name, bound != NULL ? bound : "", n, l->count);
}

/* "a b c" and ["a", "b", "c"]. */
static void check_aliases(const json_t *array, const char *aliases) {
    char all[1024] = "";
    size_t i;
    const json_t *name;
    json_array_foreach(array, i, name) {
        if (i > 0)
            strcat(all, " ");
        strcat(all, json_string_value(name));
    }
    assert_string_equal(all, aliases != NULL ? aliases : "");
}

static void check_item(const json_t *o, const listed *l, const char *bound) {
    assert_string_equal(text_in(o, "name"), l->name);
    check_aliases(json_object_get(o, "aliases"), l->aliases);
    if (l->note != NULL)
        assert_string_equal(text_in(o, "note"), l->note);
    assert_true(text_in(o, "note")[0] != '\0');
    const bool none = l->source == NULL || *l->source == '\0';
    assert_true(none ? json_is_null(json_object_get(o, "source"))
                     : text_in(o, "source") != NULL && strcmp(text_in(o, "source"), l->source) == 0);
    if (json_object_get(o, bound) == NULL)
        fail_msg("%s has no %s", l->name, bound);
    check_numbers(text_in(o, bound), l);
}

/* A rasterizer that is measured says where its plane is anchored and what clipping does; a specification does not. */
static void check_rasterizers(const json_t *items) {
    static const char *const clippings[] = {"", "each piece with its own plane", "the plane of the unclipped vertices"};
    for (size_t i = 0; i < raster_count(); i++) {
        const raster_row *r = raster_get(i);
        const char *text = text_in(json_array_get(items, i), "arithmetic");
        assert_int_equal(strncmp(text, "at least ", 9) == 0, r->at_least);
        assert_int_equal(strstr(text, "; d = ") != NULL || strstr(text, "; as llvmpipe") != NULL, r->model != NULL);
        if (r->model == NULL)
            continue;
        assert_int_equal(strstr(text, "depth not snapped") != NULL, r->plane_bits == 0);
        char anchor[64];
        snprintf(anchor, sizeof anchor, "; anchor %s: ", dp_anchor_get(r->anchor)->name);
        assert_non_null(strstr(text, anchor));
        assert_non_null(strstr(text, clippings[r->clipping]));
        assert_non_null(strstr(text, r->operations));
    }
}

/* CSV has the same cells; the text has the same words, whatever its lines. */
static void check_forms(const json_t *items, const char *what, const char *bound) {
    const csv_column columns[] = {
        {"name", "name"}, {"aliases", "aliases"}, {"note", "note"}, {bound, "bound"}, {"source", "source"}};
    values v = values_of("list");
    line_places lines = {0};
    char arguments[64], words[16384] = "", text[16384] = "";
    size_t i, used = 0;
    const json_t *o;
    snprintf(arguments, sizeof arguments, "list %s", what);
    printed p = print_of("%s --full", arguments);
    for (const char *at = p.out; *at != '\0' && used + 1 < sizeof text; at++)
        if (!isspace((unsigned char)*at))
            text[used++] = *at;
    used = 0;
    json_array_foreach(items, i, o) {
        char aliases[1024] = "";
        size_t k;
        const json_t *name;
        json_array_foreach(json_object_get(o, "aliases"), k, name)
            snprintf(aliases + strlen(aliases), sizeof aliases - strlen(aliases), "%s%s", k > 0 ? " " : "",
                     json_string_value(name));
        const char *fields[] = {text_in(o, "name"), text_in(o, "note"), text_in(o, bound), text_in(o, "source"),
                                aliases};
        const char *shown = strcmp(what, "synthetic") == 0 ? "parameters" : bound;
        const char *labels[] = {"", "", shown, "source", "also"};
        const char *const keys[] = {"name", "note", "bound", "source", "aliases"};
        values_under(&v, "%zu.", i);
        for (k = 0; k < 5; k++) {
            const char *field = fields[k] != NULL ? fields[k] : "";
            want_text(&v, keys[k], field);
            used += (size_t)snprintf(words + used, sizeof words - used, "%s", *field != '\0' ? labels[k] : "");
            for (const char *at = field; *at != '\0'; at++)
                if (!isspace((unsigned char)*at))
                    words[used++] = *at;
        }
        place_add(&lines, "", "%zu.", i);
    }
    words[used] = '\0';
    if (strncmp(text, words, used) != 0) {
        size_t same = 0;
        while (text[same] == words[same])
            same++;
        fail_msg("list %s: text has '%.60s', JSON '%.60s'", what, text + same, words + same);
    }
    check_csv(&v, 0, arguments, columns, 5, &lines);
    printed_free(&p);
    values_free(&v);
    places_free(&lines);
}

static void test_topics(void **state) {
    (void)state;
    for (size_t t = 0; t < TOPICS; t++) {
        listed l;
        size_t count = 0;
        printed p = print_of("list %s --json", topics[t].what);
        json_t *root = json_of(p.out), *items = json_object_get(root, "items");
        assert_int_equal(p.status, 0);
        assert_string_equal(text_in(root, "what"), topics[t].what);
        for (; topics[t].get(count, &l); count++)
            check_item(json_array_get(items, count), &l, topics[t].bound);
        assert_int_equal(json_array_size(items), count);
        if (topics[t].get == rasterizer)
            check_rasterizers(items);
        check_forms(items, topics[t].what, topics[t].bound);
        json_decref(root);
        printed_free(&p);
    }
}

/* With --tolerance, a method is marked with the cases for which it is the cheapest that claims enough. */
static void test_choices(void **state) {
    printed p = print_of("list methods --tolerance 1e-6 --json"), csv = print_of("list methods --tolerance 1e-6 --csv");
    json_t *root = json_of(p.out), *items = json_object_get(root, "items");
    size_t marked = 0;
    (void)state;
    for (size_t i = 0; method_get(i) != NULL; i++) {
        const method_row *r = method_get(i);
        const method_family_row *f = method_family_get(r->family);
        const method_wish wish = {1e-6, 1e4, 1e4, .pipeline = (r->domain & METHOD_PIPELINE) != 0};
        char chosen[256] = "", cell[512];
        for (size_t k = 0; k < f->case_count; k++)
            if (method_choose(f, k, &wish) == r)
                snprintf(chosen + strlen(chosen), sizeof chosen - strlen(chosen), "%s%s", *chosen != '\0' ? ", " : "",
                         f->cases[k].name);
        const char *got = text_in(json_array_get(items, i), "chosen");
        assert_string_equal(got != NULL ? got : "", chosen);
        marked += *chosen != '\0' ? 1 : 0;
        snprintf(cell, sizeof cell, strchr(chosen, ',') != NULL ? ",\"%s\"\r\n" : ",%s\r\n", chosen);
        if (*chosen != '\0')
            assert_non_null(strstr(csv.out, cell));
    }
    assert_true(marked >= METHOD_FAMILY_COUNT - 1);
    json_decref(root);
    printed_free(&p);
    printed_free(&csv);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_topics), cmocka_unit_test(test_choices)};
    return run_tap(tests);
}
