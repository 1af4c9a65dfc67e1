/* SPDX-License-Identifier: GPL-3.0-or-later */
/* list: the rows of the tables that the program works from, with what is claimed of each and where it comes from. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/list.h"
#include "cli/options.h"
#include "report/append.h"
#include "report/csv.h"
#include "report/json.h"
#include "report/number.h"
#include "texture/effect.h"
#include "texture/pack.h"

int cmd_list(const options *o);

bool list_format(size_t index, list_item *item) {
    const dp_format_row *row = dp_format_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->format.name, .aliases = row->aliases, .note = row->note, .source = row->source};
    char absolute[NUMBER_SIZE];
    char relative[NUMBER_SIZE];
    number_shortest(row->claim_absolute, absolute);
    number_shortest(row->claim_relative, relative);
    if (row->claim_relative == 0.0)
        snprintf(item->bound, sizeof item->bound, "|value - d| <= %s", absolute);
    else
        snprintf(item->bound, sizeof item->bound, "|value - d| <= %s + %s d", absolute, relative);
    return true;
}

bool list_mapping(size_t index, list_item *item) {
    const dp_mapping_row *row = index < DP_MAPPING_COUNT ? dp_mapping_get((dp_mapping)index) : NULL;
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source};
    return true;
}

bool list_model(size_t index, list_item *item) {
    static const char *const notes[] = {
        [DP_MODEL_EXACT] = "real arithmetic and one rounding into the format: the lattice of codes",
        [DP_MODEL_STAGED] = "NDC depth, then window depth, each rounded once to binary32, then the format",
        [DP_MODEL_FP32] = "every operation in binary32, see 'depthprec list ariths'; not for linear and log",
        "the simplest of the three that is enough at the depths asked about, see --tolerance",
    };
    if (index >= sizeof notes / sizeof notes[0])
        return false;
    const char *name = dp_model_name((dp_model)index);
    *item = (list_item){.name = name != NULL ? name : "auto", .note = notes[index]};
    return true;
}

bool list_rounding(size_t index, list_item *item) {
    *item = (list_item){.name = dp_rounding_name((dp_rounding)index)};
    return item->name != NULL;
}

bool list_arith(size_t index, list_item *item) {
    const dp_arith_row *row = dp_arith_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source};
    return true;
}

bool list_composition(size_t index, list_item *item) {
    const dp_composition_row *row = dp_composition_get((dp_composition)index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note};
    return true;
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
    if (index >= DP_CAUSE_COUNT)
        return false;
    *item = (list_item){.name = dp_cause_name((dp_cause)index), .note = notes[index]};
    return true;
}

bool list_preset(size_t index, list_item *item) {
    const preset *row = preset_get(index);
    char znear[NUMBER_SIZE];
    char zfar[NUMBER_SIZE];
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row};
    number_shortest(row->znear, znear);
    number_shortest(row->zfar, zfar);
    const bool confirmed = row->unconfirmed[0] == '\0';
    snprintf(item->bound, sizeof item->bound, "near %s, far %s, %s, %s, scene in %s; checked %s, %s%s", znear, zfar,
             dp_mapping_get(row->mapping)->name, row->format, row->unit, row->checked,
             confirmed ? "confirmed" : "not confirmed: ", row->unconfirmed);
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
        const effect_parameter *p = &row->parameters[i];
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
} topics[] = {
    {"formats", "depth formats, and what their rounding is held to", list_format},
    {"mappings", "how an eye depth becomes a window depth", list_mapping},
    {"models", "what is modelled of the arithmetic before the buffer", list_model},
    {"ariths", "the variants of binary32 arithmetic", list_arith},
    {"transforms", "how world positions become clip coordinates", list_composition},
    {"causes", "what takes a part of the separation", list_cause},
    {"presets", "cameras as engines set them, for --preset", list_preset},
    {"apis", "what one unit of depth bias is, for bias --api", list_api},
    {"packings", "depth and normals in the channels of a texture, and what their errors are held to", list_packing},
    {"effects", "what texture --effect knows: formulas and parameters", list_effect},
    {"figures", "what plot can draw", list_figure},
    {"scenes", "synthetic depth images, for texture --scene", list_scene},
    {"positions", "ways from window depth to a place, for texture --position", list_position},
    {"normals", "normals from depth, for texture --normal", list_normal},
    {"methods", "ways to a quantity, by family: what each claims, for which set-up and far/near", list_method},
};
enum { TOPIC_COUNT = sizeof topics / sizeof topics[0] };

bool list_topic(size_t index, list_item *item) {
    if (index >= TOPIC_COUNT)
        return false;
    *item = (list_item){.name = topics[index].name, .note = topics[index].note, .row = &topics[index]};
    return true;
}

static const struct topic all_topics = {"topics", "", list_topic};

/* What is listed, and whether with the choices that --tolerance asks for. */
typedef struct listing {
    const options *o;
    const struct topic *topic;
    bool choices;
} listing;

/* For what thing `index` is chosen: "" where nothing is asked. */
static const char *chosen(const listing *l, size_t index, char text[LIST_TEXT_SIZE]) {
    text[0] = '\0';
    if (l->choices)
        list_method_choice(l->o, index, text);
    return text;
}

static const char *text_of(const char *text) {
    return text != NULL ? text : "";
}

/* A line of its own, broken between words before column 96. */
static void put_wrapped(output *out, const char *label, const char *text) {
    enum { LEFT = 14, RIGHT = 96 };
    if (*text == '\0')
        return;
    output_format(out, "  %-*s", LEFT - 2, label);
    int column = LEFT;
    while (*text != '\0') {
        int word = (int)strcspn(text, " ");
        if (column > LEFT && column + 1 + word > RIGHT) {
            output_format(out, "\n%*s", LEFT, "");
            column = LEFT;
        }
        output_format(out, "%s%.*s", column > LEFT ? " " : "", word, text);
        column += word + (column > LEFT);
        text += word + (text[word] == ' ');
    }
    output_char(out, '\n');
}

/* What the topics write into `bound`. */
static const char *bound_label(const char *what) {
    static const char *const labels[][2] = {{"presets", "camera"}, {"apis", "rule"}, {"effects", "parameters"}};
    for (size_t i = 0; i < sizeof labels / sizeof labels[0]; i++)
        if (strcmp(what, labels[i][0]) == 0)
            return labels[i][1];
    return "bound";
}

static void write_text(output *out, const listing *l) {
    const char *what = l->topic->name;
    list_item item;
    char text[LIST_TEXT_SIZE];
    bool brief = l->topic == &all_topics;
    if (brief)
        output_text(out, "depthprec list WHAT, where WHAT is one of\n");
    for (size_t i = 0; l->topic->get(i, &item); i++) {
        if (brief) {
            output_format(out, "  %-12s%s\n", item.name, item.note);
            continue;
        }
        output_format(out, "%s%s\n", i > 0 ? "\n" : "", item.name);
        put_wrapped(out, "", text_of(item.note));
        put_wrapped(out, bound_label(what), item.bound);
        put_wrapped(out, "chosen", chosen(l, i, text));
        put_wrapped(out, "source", text_of(item.source));
        put_wrapped(out, "also", text_of(item.aliases));
    }
    if (strcmp(what, "formats") == 0)
        output_text(out,
                    "\nunormN, floatE.M, floatE.MbB\n"
                    "              formats for teaching: N = 1..32 bits; E = 2..8 exponent bits, M = 1..23 mantissa\n"
                    "              bits, bias B = 1..2^E-1\n"
                    "\ndepth24plus, depth24plus-stencil8\n"
                    "              unorm24 or fp32, as the implementation likes: stands for both\n");
}

static void json_aliases(json *j, const char *aliases) {
    json_array(j, "aliases");
    while (*aliases != '\0') {
        char name[64];
        size_t length = strcspn(aliases, " ");
        snprintf(name, sizeof name, "%.*s", (int)length, aliases);
        json_string(j, NULL, name);
        aliases += length + (aliases[length] == ' ');
    }
    json_end(j);
}

static void write_json(output *out, const listing *l) {
    const char *what = l->topic->name;
    list_item item;
    char text[LIST_TEXT_SIZE];
    json j = json_start(out, "list");
    json_string(&j, "what", what);
    json_array(&j, "items");
    for (size_t i = 0; l->topic->get(i, &item); i++) {
        json_object(&j, NULL);
        json_string(&j, "name", item.name);
        json_aliases(&j, text_of(item.aliases));
        json_string(&j, "note", text_of(item.note));
        json_string(&j, bound_label(what), *item.bound != '\0' ? item.bound : NULL);
        if (l->choices)
            json_string(&j, "chosen", *chosen(l, i, text) != '\0' ? text : NULL);
        json_string(&j, "source", *text_of(item.source) != '\0' ? item.source : NULL);
        json_end(&j);
    }
    json_finish(&j);
}

static void write_csv(output *out, const listing *l) {
    static const char *const heads[] = {"name", "aliases", "note", NULL, "source"};
    list_item item;
    char text[LIST_TEXT_SIZE];
    csv c = csv_start(out);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i] == NULL ? bound_label(l->topic->name) : heads[i]);
    if (l->choices)
        csv_string(&c, "chosen");
    csv_end(&c);
    for (size_t i = 0; l->topic->get(i, &item); i++) {
        csv_string(&c, item.name);
        csv_string(&c, text_of(item.aliases));
        csv_string(&c, text_of(item.note));
        csv_string(&c, item.bound);
        csv_string(&c, text_of(item.source));
        if (l->choices)
            csv_string(&c, chosen(l, i, text));
        csv_end(&c);
    }
}

int cmd_list(const options *o) {
    static void (*const writers[])(output *, const listing *) = {
        [FORM_TEXT] = write_text, [FORM_JSON] = write_json, [FORM_CSV] = write_csv};
    const struct topic *asked = o->operand_row;
    const listing l = {o, asked != NULL ? asked : &all_topics, option_given(o, OPTION_TOLERANCE)};
    if (l.choices && l.topic->get != list_method)
        return option_error(OPTION_TOLERANCE, "has no meaning but in list methods");
    output out;
    int status = output_open(&out, o->output);
    if (status != EXIT_FINE)
        return status;
    writers[o->form](&out, &l);
    return output_close(&out);
}
