/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The output of list: every row of every table with its own note, source, spellings and numbers, in all three forms. */
#include <ctype.h>

#include "bias/bias.h"
#include "camera/platform.h"
#include "camera/presets.h"
#include "cli/option/option.h"
#include "method/choose.h"
#include "plot/figure.h"
#include "printed.h"
#include "raster/raster.h"
#include "shader/effect.h"
#include "shader/normal.h"
#include "shader/pack.h"
#include "shader/packing.h"
#include "shader/position.h"
#include "shadow/engine.h"
#include "texture/synthetic.h"

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

/* The row of a table that has the usual columns: from where it begins to where its numbers are added. */
#define ROW(type, row, also)                                                                                           \
    const type *r = (row);                                                                                             \
    if (r == NULL)                                                                                                     \
        return false;                                                                                                  \
    *l = (listed){r->name, also, r->note, r->source, {0}, 0};

/* A topic whose rows have no numbers. */
#define PLAIN(topic, type, row, also)                                                                                  \
    static bool topic(size_t i, listed *l) {                                                                           \
        ROW(type, row, also)                                                                                           \
        return true;                                                                                                   \
    }

PLAIN(mapping, dp_mapping_row, i < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)i) : NULL, r->aliases)
PLAIN(arith, dp_arith_row, dp_arith_get(i), "")
PLAIN(platform_row, platform, platform_get(i), "")
PLAIN(api, bias_api, bias_api_get(i), r->aliases)
PLAIN(position, position_row, position_get(i), "")
PLAIN(normal, normal_row, normal_get(i), "")

static bool format(size_t i, listed *l) {
    const dp_format_row *r = dp_format_get(i);
    if (r == NULL)
        return false;
    *l = (listed){r->format.name, r->aliases, r->note, r->source, {r->claim_absolute, r->claim_relative}, 2};
    l->count = r->claim_relative > 0 ? 2 : 1;
    return true;
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

static bool figure(size_t i, listed *l) {
    const figure_row *r = figure_get(i);
    if (r != NULL)
        *l = (listed){r->name, "", r->note, NULL, {0}, 0};
    return r != NULL;
}

static bool preset_row(size_t i, listed *l) {
    ROW(preset, preset_get(i), r->aliases)
    for (int k = 0; r->function != NULL && k < PRESET_PARAMETERS && r->function->parameters[k].name != NULL; k++) {
        add_number(l, r->function->parameters[k].least);
        add_number(l, r->function->parameters[k].most);
        if (!isnan(r->function->parameters[k].standard))
            add_number(l, r->function->parameters[k].standard);
    }
    if (r->function == NULL)
        add_number(l, r->znear);
    if (isfinite(r->zfar))
        add_number(l, r->zfar);
    add_number(l, r->fov);
    return true;
}

static bool engine(size_t i, listed *l) {
    ROW(shadow_engine, shadow_engine_get(i), r->aliases)
    if (r->instead[0] != '\0')
        return true;
    for (int k = 0; k < 3; k++) /* of each kind of light, where it is not that of the one before */
        if (k == 0 || r->bias_in[k] != r->bias_in[k - 1] || r->bias_scale[k] != r->bias_scale[k - 1])
            add_number(l, r->bias_scale[k]);
    for (int k = 0; k < 3 && r->normal != NULL; k++)
        if (k == 0 || r->normal_in[k] != r->normal_in[k - 1] || r->normal_scale[k] != r->normal_scale[k - 1])
            add_number(l, r->normal_scale[k]);
    for (int kind = 0; kind < 3; kind++)
        for (int which = 0; which < 2; which++)
            add_number(l, r->standard[kind][which]);
    return true;
}

static bool rasterizer(size_t i, listed *l) {
    ROW(raster_row, raster_get(i), "")
    const dp_anchor_row *anchor = dp_anchor_get(r->anchor);
    add_number(l, r->subpixel_bits);
    if (anchor == NULL)
        return true;
    add_number(l, anchor->plane.value);
    add_number(l, anchor->plane.box);
    add_number(l, anchor->plane.range);
    add_number(l, anchor->plane.origin);
    return true;
}

static bool encoding(size_t i, listed *l) {
    ROW(pack_row, pack_get(i), "")
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
    ROW(effect_row, effect_get(i), r->aliases)
    for (int k = 0; r->parameters[k].name != NULL; k++) {
        if (strncmp(r->parameters[k].name, "reference", 9) != 0) /* which has no default */
            add_number(l, r->parameters[k].value);
        add_number(l, r->parameters[k].lo);
        add_number(l, r->parameters[k].hi);
    }
    for (int k = 0; k < 4 && r->mix <= EFFECT_SPARES; k++)
        add_number(l, r->tint[k]);
    if (r->mix <= EFFECT_SPARES)
        add_number(l, r->mix == EFFECT_TINTS);
    return true;
}

/* Those of every effect in turn. */
static bool parameter(size_t i, listed *l) {
    const effect_row *row;
    for (size_t e = 0; (row = effect_get(e)) != NULL; e++)
        for (int k = 0; row->parameters[k].name != NULL; k++) {
            const texture_parameter *p = &row->parameters[k];
            if (i-- > 0)
                continue;
            *l = (listed){p->name, p->alias, p->note, NULL, {0}, 0};
            if (strncmp(p->name, "reference", 9) != 0)
                add_number(l, p->value);
            add_number(l, p->lo);
            add_number(l, p->hi);
            return true;
        }
    return false;
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

/* Depths are off by half a step, and what binary32 adds; normals by degrees; with three digits, rounded up. */
static bool packing_row(size_t i, listed *l) {
    static const double halves[] = {7.81e-06, 0,        0,        7.81e-06, 1.17e-10,
                                    2.33e-10, 2.99e-08, 2.99e-08, 5.97e-08, 0.00197};
    static const double angles[] = {1.13, 0.391, 0.109};
    ROW(struct packing, packing_get(i), r->aliases)
    if (halves[i] > 0)
        add_number(l, halves[i]);
    if (i < sizeof angles / sizeof angles[0])
        add_number(l, angles[i]);
    return true;
}

static bool product(size_t i, listed *l) {
    static const char *const kinds[] = {"eye",    "radial",        "linear01", "raw",   "position",
                                        "normal", "packed-normal", "pack",     "effect"};
    if (i >= sizeof kinds / sizeof kinds[0])
        return false;
    *l = (listed){kinds[i], "", NULL, NULL, {0}, 0};
    return true;
}

/* The claims of the cases in turn; a formula is shown at far/near 10000. */
static bool method(size_t i, listed *l) {
    ROW(method_row, method_get(i), method_family_get(r->family)->name)
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
              {"engines", "rule", engine},
              {"rasterizers", "arithmetic", rasterizer},
              {"encodings", "bound", encoding},
              {"packings", "bound", packing_row},
              {"products", "methods", product},
              {"effects", "parameters", effect},
              {"parameters", "range", parameter},
              {"figures", "bound", figure},
              {"synthetic", "bound", synthetic},
              {"positions", "bound", position},
              {"normals", "bound", normal},
              {"methods", "bound", method}};
enum { TOPICS = sizeof topics / sizeof topics[0] };

/* ---- Against what is printed ------------------------------------------------------------------------------------- */

/* The numbers of a claim, those in names ("unorm24", "2^-N") aside. */
static void check_numbers(const char *bound, const listed *l) {
    size_t n = 0;
    for (const char *at = bound != NULL ? bound : ""; *at != '\0' && n < l->count;) {
        char *end;
        at += strspn(at, " ");
        const double number = strtod(at, &end);
        const bool alone =
            end > at && (at == bound || strchr(" =,", at[-1]) != NULL) && (*end == '\0' || strchr(" ,;", *end) != NULL);
        if (alone && isdigit((unsigned char)(*at == '-' ? at[1] : *at))) {
            if (fabs(number - l->numbers[n]) > 0.0101 * fabs(l->numbers[n]))
                fail_msg("%s: '%s': number %zu is %g, not %g", l->name, bound, n, number, l->numbers[n]);
            n++;
        }
        at = end > at ? end : at + 1;
    }
    if (n != l->count)
        fail_msg("%s: '%s' has %zu numbers, not %zu", l->name, bound != NULL ? bound : "", n, l->count);
}

/* "a b c" of ["a", "b", "c"]. */
static const char *aliases_of(const json_t *item) {
    static char all[1024];
    const json_t *names = node_at(item, "aliases");
    all[0] = '\0';
    for (size_t i = 0; i < json_array_size(names); i++)
        snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s", i > 0 ? " " : "", text_at(names, "[%zu]", i));
    return all;
}

static void check_item(const json_t *o, const listed *l, const char *bound) {
    const char *source = text_at(o, "source");
    assert_string_equal(text_at(o, "name"), l->name);
    assert_string_equal(aliases_of(o), l->aliases != NULL ? l->aliases : "");
    if (l->note != NULL)
        assert_string_equal(text_at(o, "note"), l->note);
    assert_true(text_at(o, "note")[0] != '\0');
    if (l->source == NULL || *l->source == '\0')
        assert_null(source);
    else
        assert_string_equal(source, l->source);
    check_numbers(text_at(o, "%s", bound), l);
}

/* A rasterizer that is measured says where its plane is anchored and what clipping does; a specification does not. */
static void check_rasterizers(const json_t *items) {
    static const char *const clippings[] = {"", "each piece with its own plane", "the plane of the unclipped vertices"};
    for (size_t i = 0; i < raster_table.count; i++) {
        const raster_row *r = raster_get(i);
        const char *text = text_at(items, "[%zu].arithmetic", i);
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

/* A text but for its blanks, at the end of another. */
static void append(char out[16384], const char *text) {
    size_t used = strlen(out);
    for (; *text != '\0' && used + 1 < 16384; text++)
        if (!isspace((unsigned char)*text))
            out[used++] = *text;
    out[used] = '\0';
}

/* CSV has the same cells; the text has the same words, whatever its lines. */
static void check_forms_of(const json_t *items, const char *what, const char *bound) {
    const char *shown = strcmp(what, "synthetic") == 0 ? "parameters" : bound;
    const struct {
        const char *field, *label;
    } parts[] = {{"name", ""}, {"note", ""}, {bound, shown}, {"source", "source"}, {"aliases", "also"}};
    values v = values_of("list");
    char line[64], columns[128], words[16384] = "", text[16384] = "";
    snprintf(line, sizeof line, "list %s", what);
    snprintf(columns, sizeof columns, "name, aliases, note, %s, source", bound);
    char *printed_text = output_of(0, line, "--full");
    append(text, printed_text);
    for (size_t i = 0; i < json_array_size(items); i++) {
        values_under(&v, "items[%zu].", i);
        for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
            const json_t *item = json_array_get(items, i);
            const char *field = k == 4 ? aliases_of(item) : text_at(item, "%s", parts[k].field);
            want_text(&v, parts[k].field, field != NULL ? field : "");
            append(words, field != NULL && *field != '\0' ? parts[k].label : "");
            append(words, field != NULL ? field : "");
        }
    }
    if (strncmp(text, words, strlen(words)) != 0) {
        size_t same = 0;
        while (text[same] == words[same])
            same++;
        fail_msg("list %s: text has '%.60s', JSON '%.60s'", what, text + same, words + same);
    }
    line_places lines = places_of(&v, "items[]");
    check_csv(&v, 0, line, columns, &lines);
    places_free(&lines);
    values_free(&v);
    free(printed_text);
}

TEST(topics_are_their_tables) {
    for (size_t t = 0; t < TOPICS; t++) {
        listed l;
        size_t count = 0;
        json_t *root = json_printed(0, "list %s", topics[t].what), *items = node_at(root, "items");
        assert_string_equal(text_at(root, "what"), topics[t].what);
        for (; topics[t].get(count, &l); count++)
            check_item(json_array_get(items, count), &l, topics[t].bound);
        assert_int_equal(json_array_size(items), count);
        if (topics[t].get == rasterizer)
            check_rasterizers(items);
        check_forms_of(items, topics[t].what, topics[t].bound);
        json_decref(root);
    }
}

/* With --tolerance, a method is marked with the cases for which it is the cheapest that claims enough. */
TEST(choices) {
    json_t *root = json_printed(0, "list methods --tolerance 1e-6");
    char *csv = output_of(0, "list methods --tolerance 1e-6", "--csv");
    size_t marked = 0;
    for (size_t i = 0; method_get(i) != NULL; i++) {
        const method_row *r = method_get(i);
        const method_family_row *f = method_family_get(r->family);
        const method_wish wish = {1e-6, 1e4, 1e4, .pipeline = (r->domain & METHOD_PIPELINE) != 0};
        char chosen[256] = "", cell[512];
        for (size_t k = 0; k < f->case_count; k++)
            if (method_choose(f, k, &wish) == r)
                snprintf(chosen + strlen(chosen), sizeof chosen - strlen(chosen), "%s%s", *chosen != '\0' ? ", " : "",
                         f->cases[k].name);
        const char *got = text_at(root, "items[%zu].chosen", i);
        assert_string_equal(got != NULL ? got : "", chosen);
        marked += *chosen != '\0' ? 1 : 0;
        snprintf(cell, sizeof cell, strchr(chosen, ',') != NULL ? ",\"%s\"\r\n" : ",%s\r\n", chosen);
        if (*chosen != '\0')
            assert_non_null(strstr(csv, cell));
    }
    assert_true(marked >= METHOD_FAMILY_COUNT - 1);
    json_decref(root);
    free(csv);
}

/* The key of a splat, as viewers compute it, is the code that the command of that word prints. */
TEST(sort_keys) {
    printed word = print_of("help splat");
    const char *said = strstr(word.out, "table ");
    assert_non_null(said);
    const int length = (int)strcspn(said, "\n");
    rng r = rng_make("sort keys");
    char line[512];
    size_t keys = 0;
    for (int i = 0; i < 40; i++) {
        const double z = rng_uniform(&r, 0.5, 100);
        const long double key = ((long double)z - 0.5L) * 65535 / (100 - 0.5L);
        if (key - floorl(key) < 1e-6L || key - floorl(key) > 1 - 1e-6L)
            continue;
        snprintf(line, sizeof line, "%.*s --at %.17g", length, said, z);
        json_t *root = json_printed(0, "%s", line);
        assert_true(number_at(root, "setups[0].rows[0].code") == (double)floorl(key));
        json_decref(root);
        keys++;
    }
    assert_true(keys > 30);
    printed_free(&word);
}

/* ---- Completions ------------------------------------------------------------------------------------------------- */

/* The line of a script that begins so, cut off at its end; null: none. One of a static string. */
static const char *line_of(const char *script, const char *begins) {
    static char line[8192];
    const char *at = script;
    while (at != NULL && strncmp(at + strspn(at, " "), begins, strlen(begins)) != 0) {
        at = strchr(at, '\n');
        at += at != NULL;
    }
    if (at != NULL)
        snprintf(line, sizeof line, "%.*s", (int)strcspn(at, "\n"), at + strspn(at, " "));
    return at != NULL ? line : NULL;
}

/* The options of all commands by their rows, each with its letter, its words, and the commands that take it. */
static void check_completed(const char *shell, const option_row *row, const char *script) {
    char begins[2048], text[OPTION_TEXT_SIZE], words[NAMES_SIZE] = "";
    const bool fish = strcmp(shell, "fish") == 0, argument = *option_argument(row, text) != '\0';
    const char letter[] = {row->letter, '\0'};
    snprintf(begins, sizeof begins,
             fish ? "complete -c depthprec -n '__fish_seen_subcommand_from" : "--%s%s%s) offered='", row->name,
             *letter != '\0' ? "|-" : "", letter);
    if (row->names != NULL)
        names_join(row->names, " ", " ", words);
    for (size_t i = 0; command_get(i) != NULL; i++) {
        const command_row *v = command_get(i);
        const bool takes = option_used(v, ~0U, option_find(v, row->name)).row != NULL;
        char of[64], option[64];
        if (fish && takes)
            snprintf(begins + strlen(begins), sizeof begins - strlen(begins), " %s", v->name);
        if (fish)
            continue;
        snprintf(of, sizeof of, "%s) offered='", v->name);
        snprintf(option, sizeof option, " --%s", row->name);
        const char *line = line_of(script, of), *found = line != NULL ? strstr(line, option) : NULL;
        while (found != NULL && strchr(" '", found[strlen(option)]) == NULL)
            found = strstr(found + 1, option);
        if ((found != NULL) != takes)
            fail_msg("%s: %s and --%s: %s", shell, v->name, row->name, line);
    }
    if (fish)
        snprintf(begins + strlen(begins), sizeof begins - strlen(begins), "' -l %s%s%s%s%s", row->name,
                 *letter != '\0' ? " -s " : "", letter, argument ? " -r" : "", row->names != NULL ? " -fa '" : "");
    const char *line = fish || argument ? line_of(script, begins) : NULL;
    if ((fish || argument) && (line == NULL || strncmp(line + strlen(begins), words, strlen(words)) != 0))
        fail_msg("%s: no '%s%s'", shell, begins, words);
}

/* What bash offers behind words that were typed. */
TEST(bash_completes) {
    static const struct {
        const char *words, *offered; /* the last word is the one that is typed */
    } rows[] = {{"depthprec plot --theme ''", "light dark print"},
                {"depthprec plot --theme da", "dark"},
                {"depthprec check --report ''", "text json junit"},
                {"depthprec completions ''", "bash zsh fish --help --version"},
                {"depthprec com", "completions"},
                {"depthprec table --tol", "--tolerance"},
                {"depthprec bias --remedy n", "ndc normal near"}};
    if (system("command -v bash >/dev/null") != 0)
        skip();
    const char *path = scratch_file("completions");
    FILE *out = fopen(path, "w");
    printed script = print_of("completions bash");
    assert_true(out != NULL && script.status == 0);
    fprintf(out, "%s\ntry() { COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1)); _depthprec; echo \"${COMPREPLY[*]}\"; }\n",
            script.out);
    printed_free(&script);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        fprintf(out, "try %s\n", rows[i].words);
    fclose(out);
    char line[512], got[512];
    snprintf(line, sizeof line, "bash '%s'", path);
    FILE *in = popen(line, "r");
    assert_non_null(in);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_non_null(fgets(got, sizeof got, in));
        got[strcspn(got, "\n")] = '\0';
        if (strcmp(got, rows[i].offered) != 0)
            fail_msg("%s: %s, and not %s", rows[i].words, got, rows[i].offered);
    }
    pclose(in);
}

/* Without a topic all topics are listed, in each form. */
TEST(topics_alone) {
    json_t *root = json_printed(0, "list");
    const json_t *items = node_at(root, "items");
    printed text = print_of("list"), csv = print_of("list --csv");
    const char *at = strchr(csv.out, '\n');
    for (size_t i = 0; i < json_array_size(items); i++) {
        char begins[64], line[64];
        snprintf(begins, sizeof begins, "\n%s,", text_at(items, "[%zu].name", i));
        snprintf(line, sizeof line, "\n  %s ", text_at(items, "[%zu].name", i));
        if (at == NULL || strncmp(at, begins, strlen(begins)) != 0 || strstr(text.out, line) == NULL)
            fail_msg("%s is missing", begins + 1);
        at = strchr(at + 1, '\n');
    }
    assert_true(json_array_size(items) > 30 && at != NULL && at[1] == '\0');
    printed_free(&text);
    printed_free(&csv);
    json_decref(root);
}

/* Words are asked for however they are put together. */
TEST(words_apart) {
    static const char *const words[][5] = {
        {"reversed z", "reversed-z", "reversed_z", "ReversedZ", NULL},
        {"z fighting", "z-fighting", "Z_fighting", "zfighting", NULL},
        {"polygon offset", "polygon-offset", "polygon_offset", "PolygonOffset", NULL}};
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++) {
        printed first = print_of("help '%s'", words[i][0]);
        assert_true(first.status == 0 && strlen(first.out) > 80);
        for (size_t k = 1; words[i][k] != NULL; k++) {
            printed p = print_of("help %s", words[i][k]);
            if (p.status != 0 || strcmp(p.out, first.out) != 0)
                fail_msg("help %s: %s%s", words[i][k], p.out, p.errors);
            printed_free(&p);
        }
        printed_free(&first);
    }
}

/* A link is for the figures that the page's own list has, and for no other; but for its staircase, which is another. */
TEST(figures_of_the_page) {
    char *script = text_of_file("src/web/state.js"), *from = strstr(script, "export const FIGURES = {");
    assert_non_null(from);
    from += strlen("export const FIGURES =");
    *strchr(from, '}') = '\0';
    size_t there = 0;
    for (size_t i = 0; figure_get(i) != NULL; i++) {
        char key[64];
        snprintf(key, sizeof key, " %s: \"", figure_get(i)->name);
        const bool has = strstr(from, key) != NULL && strcmp(figure_get(i)->name, "staircase") != 0;
        printed p = print_of("plot %s --link", figure_get(i)->name);
        if ((p.status == 0) != has || (has && strncmp(p.out, "depthprec.html#plot%20", 22) != 0))
            fail_msg("%s: %s%s", figure_get(i)->name, p.out, p.errors);
        printed_free(&p);
        there += has;
    }
    size_t keys = 0;
    for (const char *c = from; (c = strstr(c, ": \"")) != NULL; c += 3)
        keys++;
    assert_int_equal(there + 1, keys);
    free(script);
}

TEST(completions) {
    static const char *const shells[] = {"bash", "zsh", "fish"};
    const option_row *all[OPTIONS_MAX + 1];
    options_all(all);
    for (size_t i = 0; i < sizeof shells / sizeof shells[0]; i++) {
        printed p = print_of("completions %s", shells[i]);
        for (size_t k = 0; all[k] != NULL; k++)
            if (k == 0 || strcmp(all[k]->name, all[k - 1]->name) != 0)
                check_completed(shells[i], all[k], p.out);
        printed_free(&p);
    }
}
