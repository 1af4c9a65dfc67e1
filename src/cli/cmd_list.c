/* SPDX-License-Identifier: GPL-3.0-or-later */
/* list: the rows of the tables that the program works from, with what is claimed of each and where it comes from. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "cli/options.h"
#include "report/append.h"
#include "report/number.h"
#include "report/report.h"
#include "texture/effect.h"
#include "texture/pack.h"

bool list_format(size_t index, list_item *item) {
    const dp_format_row *row = dp_format_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->format.name, .aliases = row->aliases, .note = row->note, .source = row->source};
    append(item->bound, sizeof item->bound, "|value - d| <= %s", number_full(row->claim_absolute).text);
    if (row->claim_relative > 0.0)
        append(item->bound, sizeof item->bound, " + %s d", number_full(row->claim_relative).text);
    return true;
}

bool list_mapping(size_t index, list_item *item) {
    const dp_mapping_row *row = index < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)index) : NULL;
    return row != NULL &&
           list_fill(item,
                     (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source});
}

bool list_model(size_t index, list_item *item) {
    static const char *const notes[] = {
        [DP_MODEL_EXACT] = "real arithmetic and one rounding into the format: the lattice of codes",
        [DP_MODEL_STAGED] = "NDC depth, then window depth, each rounded once to binary32, then the format",
        [DP_MODEL_FP32] = "every operation in binary32, see 'depthprec list ariths'; not for linear and log",
        "the simplest of the three that is enough at the depths asked about, see --tolerance",
    };
    const char *name = dp_model_name((dp_model)index);
    return index < sizeof notes / sizeof notes[0] &&
           list_fill(item, (list_item){.name = name != NULL ? name : "auto", .note = notes[index]});
}

bool list_rounding(size_t index, list_item *item) {
    *item = (list_item){.name = dp_rounding_name((dp_rounding)index)};
    return item->name != NULL;
}

bool list_arith(size_t index, list_item *item) {
    const dp_arith_row *row = dp_arith_get(index);
    return row != NULL && list_fill(item, (list_item){.name = row->name, .note = row->note, .source = row->source});
}

bool list_composition(size_t index, list_item *item) {
    const dp_composition_row *row = dp_composition_get((dp_composition)index);
    return row != NULL && list_fill(item, (list_item){.name = row->name, .note = row->note});
}

static bool list_cause(size_t index, list_item *item) {
    static const char *const notes[DP_CAUSE_COUNT] = {
        [DP_CAUSE_EYE] = "rounding the eye depth itself to binary32: surfaces lie anywhere",
        [DP_CAUSE_COMPOSITION] = "world positions through view and projection, with --world and --composition",
        [DP_CAUSE_PROJECTION] = "A z + B in binary32, and the remap if there is one",
        [DP_CAUSE_NDC] = "the divide and the viewport",
        [DP_CAUSE_INTERPOLATION] = "across a triangle, as given with --interpolation",
        [DP_CAUSE_FORMAT] = "the step of the format and the conversion into it",
        [DP_CAUSE_LINEARIZATION] = "reading eye depth back in a binary32 shader, with --linearize",
    };
    return index < DP_CAUSE_COUNT &&
           list_fill(item, (list_item){.name = dp_cause_name((dp_cause)index), .note = notes[index]});
}

bool list_preset(size_t index, list_item *item) {
    const preset *row = preset_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row};
    const bool confirmed = row->unconfirmed[0] == '\0';
    snprintf(item->bound, sizeof item->bound, "near %s, far %s, %s, %s, scene in %s; checked %s, %s%s",
             number_full(row->znear).text, number_full(row->zfar).text, dp_mapping_get(row->mapping)->name, row->format,
             row->unit, row->checked, confirmed ? "confirmed" : "not confirmed: ", row->unconfirmed);
    return true;
}

bool list_api(size_t index, list_item *item) {
    static const char *const rules[] = {
        [BIAS_ONE] = "1",
        [BIAS_CODE] = "1/(2^N - 1) as binary32",
        [BIAS_POWER] = "2^-N",
        [BIAS_BOUND] = "at most 2 x 2^-N",
        [BIAS_FREE] = "the implementation's choice",
        [BIAS_EXPONENT] = "2^(e - 23), e of the greatest depth",
        [BIAS_MANTISSA] = "2^-24",
    };
    const bias_api *row = bias_api_get(index);
    if (row == NULL)
        return false;
    *item =
        (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source, .row = row};
    snprintf(item->bound, sizeof item->bound, "unorm: r = %s; fp32: r = %s", rules[row->unorm], rules[row->real]);
    return true;
}

static bool list_packing(size_t index, list_item *item) {
    const pack_row *row = pack_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source};
    if (row->kind != PACK_DEPTH)
        append(item->bound, sizeof item->bound, "angle: mean %g, at most %g degrees%s", row->normal.mean,
               row->normal.max, row->kind == PACK_DEPTH_NORMAL ? "; " : "");
    if (row->kind != PACK_NORMAL)
        append(item->bound, sizeof item->bound, "depth: mean %g, at most %g of far", row->depth.mean, row->depth.max);
    return true;
}

bool list_effect(size_t index, list_item *item) {
    const effect_row *row = effect_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row};
    for (int i = 0; row->parameters[i].name != NULL; i++) {
        const texture_parameter *p = &row->parameters[i];
        append(item->bound, sizeof item->bound, "%s%s %g [%s]", i > 0 ? ", " : "", p->name, p->value, p->unit);
        if (i == row->wanted)
            append(item->bound, sizeof item->bound, " (%s usable)", row->smallest ? "smallest" : "largest");
    }
    return true;
}

/* What can be listed. */
static const struct topic {
    const char *name, *note;
    list_get get;
    const char *bound; /* what a thing's bound is called */
} topics[] = {
    {"formats", "depth formats, and what their rounding is held to", list_format, "bound"},
    {"mappings", "how an eye depth becomes a window depth", list_mapping, "bound"},
    {"models", "what is modelled of the arithmetic before the buffer", list_model, "bound"},
    {"ariths", "the variants of binary32 arithmetic", list_arith, "bound"},
    {"transforms", "how world positions become clip coordinates", list_composition, "bound"},
    {"causes", "what takes a part of the separation", list_cause, "bound"},
    {"presets", "cameras as engines set them, for --preset", list_preset, "camera"},
    {"apis", "what one unit of depth bias is, for bias --api", list_api, "rule"},
    {"packings", "depth and normals in the channels of a texture, and what their errors are held to", list_packing,
     "bound"},
    {"effects", "what texture --effect knows: formulas and parameters", list_effect, "parameters"},
    {"figures", "what plot can draw", list_figure, "bound"},
    {"scenes", "synthetic depth images, for texture --scene", list_scene, "bound"},
    {"positions", "ways from window depth to a place, for texture --position", list_position, "bound"},
    {"normals", "normals from depth, for texture --normal", list_normal, "bound"},
    {"methods", "ways to a quantity, by family: what each claims, for which set-up and far/near", list_method, "bound"},
};
enum { TOPIC_COUNT = sizeof topics / sizeof topics[0] };

bool list_topic(size_t index, list_item *item) {
    const struct topic *row = &topics[index];
    return index < TOPIC_COUNT && list_fill(item, (list_item){.name = row->name, .note = row->note, .row = row});
}

static const struct topic all_topics = {"topics", "", list_topic, "bound"};

/* What is listed, and the thing at hand. */
typedef struct listing {
    const options *o;
    const struct topic *topic;
    const char *what;
    list_item item;
    char chosen[LIST_TEXT_SIZE]; /* with --tolerance: for what the thing is chosen, "" for nothing */
} listing;

static void *next_item(void *of, size_t i) {
    listing *l = of;
    list_item *item = &l->item;
    if (!l->topic->get(i, item))
        return NULL;
    if (item->source != NULL && *item->source == '\0')
        item->source = NULL;
    if (option_given(l->o, OPTION_TOLERANCE))
        list_method_choice(l->o, i, l->chosen);
    return l;
}

static void say_topics(page *p, void *of) {
    (void)of;
    output_text(p->out, "depthprec list WHAT, where WHAT is one of\n");
    for (size_t i = 0; i < TOPIC_COUNT; i++)
        page_note(p, topics[i].name, "%s", topics[i].note);
}

static void say_item(page *p, void *of) {
    const listing *l = of;
    const list_item *item = &l->item;
    page_title(p, "%s", item->name);
    page_wrapped(p, "", item->note);
    page_wrapped(p, l->topic->bound, item->bound);
    page_wrapped(p, "chosen", l->chosen);
    page_wrapped(p, "source", item->source);
    page_wrapped(p, "also", item->aliases);
}

static void say_other_formats(page *p, void *of) {
    (void)of;
    output_text(p->out,
                "\nunormN, floatE.M, floatE.MbB\n"
                "              formats for teaching: N = 1..32 bits; E = 2..8 exponent bits, M = 1..23 mantissa\n"
                "              bits, bias B = 1..2^E-1\n"
                "\ndepth24plus, depth24plus-stencil8\n"
                "              unorm24 or fp32, as the implementation likes: stands for both\n");
}

enum { WITH_CHOICES = 1 };

static void write_list(listing *l, output *out) {
    const column items[] = {{FIELD(listing, item.name, "name", "")},
                            {FIELD(listing, item.aliases, "aliases", ""), .names = true},
                            {FIELD(listing, item.note, "note", "")},
                            {FIELD(listing, item.bound, l->topic->bound, "")},
                            {FIELD(listing, chosen, "chosen", ""), .only = AS_JSON, .when = WITH_CHOICES},
                            {FIELD(listing, item.source, "source", "")},
                            {FIELD(listing, chosen, "chosen", ""), .only = AS_CSV, .when = WITH_CHOICES},
                            {.kind = COLUMN_END}};
    const column columns[] = {{FIELD(listing, what, "what", ""), .only = AS_JSON},
                              {LIST("items", items, next_item), .head = say_item},
                              {.kind = COLUMN_END}};
    const bool topics_alone = l->topic == &all_topics && l->o->form == FORM_TEXT;
    report_write(&(report_spec){"list", topics_alone ? columns + 2 : columns, l,
                                .when = option_given(l->o, OPTION_TOLERANCE) ? WITH_CHOICES : 0, .label = 12,
                                .head = topics_alone ? say_topics : NULL,
                                .notes = l->topic->get == list_format ? say_other_formats : NULL},
                 out, l->o->form);
}

int cmd_list(const options *o) {
    const struct topic *asked = o->operand_row;
    listing l = {.o = o, .topic = asked != NULL ? asked : &all_topics};
    if (option_given(o, OPTION_TOLERANCE) && l.topic->get != list_method)
        return option_error(OPTION_TOLERANCE, "has no meaning but in list methods");
    output out;
    int status = output_open(&out, o->output);
    if (status != EXIT_FINE)
        return status;
    l.what = l.topic->name;
    write_list(&l, &out);
    return output_close(&out);
}
