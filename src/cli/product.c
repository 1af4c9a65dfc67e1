/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/product.h"

#include <math.h>
#include <stddef.h>

#include "cli/texture/request.h"
#include "core/append.h"
#include "report/number.h"

/* ---- Methods ---------------------------------------------------------------------------------------------------- */

/* Its default, its unit and its range. */
static void append_parameter(list_item *item, const char *before, const char *name, const texture_parameter *p) {
    append(item->bound, sizeof item->bound, "%s%s", before, name);
    if (!isnan(p->value))
        append(item->bound, sizeof item->bound, " %g", p->value);
    append(item->bound, sizeof item->bound, " [%s], %g to %g", p->unit, p->lo, p->hi);
}

bool list_effect(size_t index, list_item *item) {
    static const struct {
        unsigned bit;
        const char *name;
    } needs[] = {{EFFECT_POSITION, "the position"},
                 {EFFECT_LAST_FRAME, "last frame's camera"},
                 {EFFECT_SECOND_DEPTH, "a second depth"},
                 {EFFECT_NORMALS, "normals"}};
    const effect_row *row = effect_get(index);
    if (row == NULL)
        return false;
    *item =
        (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source, .row = row};
    for (int i = 0; row->parameters[i].name != NULL; i++) {
        const texture_parameter *p = &row->parameters[i];
        append_parameter(item, i > 0 ? "; " : "", p->name, p);
        if (i == row->wanted)
            append(item->bound, sizeof item->bound, " (%s usable)", row->smallest ? "smallest" : "largest");
    }
    if (row->mix <= EFFECT_SPARES)
        append(item->bound, sizeof item->bound, "; tint %g,%g,%g,%g where it is %d", row->tint[0], row->tint[1],
               row->tint[2], row->tint[3], row->mix == EFFECT_TINTS);
    for (size_t i = 0, count = 0; i < sizeof needs / sizeof needs[0]; i++)
        if ((row->needs & needs[i].bit) != 0)
            append(item->bound, sizeof item->bound, "%s%s", count++ == 0 ? "; needs " : ", ", needs[i].name);
    return true;
}

/* Of each effect, so names come again. */
bool list_parameter(size_t index, list_item *item) {
    const effect_row *row;
    for (size_t k = 0; (row = effect_get(k)) != NULL; k++)
        for (const texture_parameter *p = row->parameters; p->name != NULL; p++)
            if (index-- == 0) {
                *item = (list_item){.name = p->name, .aliases = p->alias, .note = p->note, .row = p};
                append_parameter(item, "of ", row->name, p);
                return true;
            }
    return false;
}

bool list_position(size_t index, list_item *item) {
    const position_row *row = position_get(index);
    return row != NULL &&
           list_fill(item, (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row});
}

bool list_normal(size_t index, list_item *item) {
    const normal_row *row = normal_get(index);
    return row != NULL &&
           list_fill(item, (list_item){.name = row->name, .note = row->note, .source = row->source, .row = row});
}

bool list_packing(size_t index, list_item *item) {
    const packing *row = packing_get(index);
    if (row == NULL)
        return false;
    const pack_row *encoded = packing_normals(row);
    *item =
        (list_item){.name = row->name, .aliases = row->aliases, .note = row->note, .source = row->source, .row = row};
    if (row->steps > 0)
        append(item->bound, sizeof item->bound, "depth: at most %s%s", number_up(0.5 / row->steps + row->off, 3).text,
               row->linear ? " of far" : "");
    if (encoded != NULL)
        append(item->bound, sizeof item->bound, "%snormal: at most %s degrees%s", row->steps > 0 ? "; " : "",
               number_up(encoded->normal.max, 3).text, encoded->sphere ? "" : " where it faces the camera");
    return true;
}

/* ---- Kinds ---------------------------------------------------------------------------------------------------- */

static const name_list positions = {.words = (const char *const[]){"exact", NULL}, .get = list_position};
static const name_list normals = {.get = list_normal};
static const name_list packings = {.get = list_packing};
static const name_list effects = {.get = list_effect};

#define METHOD(among, field, usual) .methods = &(among), .place = offsetof(texture_asked, field), .standard = (usual)

static const product_row rows[] = {
    {"eye", "eye depth", FRAME_EYE, .by = "eye depth", .unit = "scene units", .unit_of_error = "scene units"},
    {"radial", "distance from the camera", FRAME_EYE, .radial = true, .by = "distance from the camera",
     .unit = "scene units", .unit_of_error = "scene units"},
    {"linear01", "eye depth over far, as Unity's Linear01Depth", FRAME_LINEAR01, .by = "eye depth over far", .unit = "",
     .unit_of_error = ""},
    {"raw", "window depth, of sky too", FRAME_RAW, .by = "window depth", .unit = "", .unit_of_error = ""},
    {"position", "world positions, by default exact: the truth", FRAME_POSITION, METHOD(positions, position, "exact"),
     .by = "positions by ", .unit = "scene units", .unit_of_error = "scene units"},
    {"normal", "normals, by default projective", FRAME_NORMAL, METHOD(normals, normal, "projective"),
     .by = "normals by ", .unit = "", .unit_of_error = "degrees"},
    {"packed-normal", "the normals that --packing depth-normals or camera-normals holds, in view space", FRAME_NORMAL,
     .packed = true, .by = "", .unit = "", .unit_of_error = ""},
    {"pack", "the depths in several channels of 8 bits, a PNG or NPY, as --packing reads them back", FRAME_EYE,
     METHOD(packings, pack, NULL), .by = "", .unit = "", .unit_of_error = ""},
    {"effect", "an effect that reads depth; without an image, the usable values of its parameter", FRAME_EFFECT,
     METHOD(effects, effect, NULL), .by = "", .unit = "", .unit_of_error = "levels of 1/255"},
};

const product_row *product_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

bool list_product(size_t index, list_item *item) {
    const product_row *row = product_get(index);
    if (row == NULL)
        return false;
    *item = (list_item){.name = row->name, .note = row->note, .row = row};
    if (row->methods != NULL) {
        char text[NAMES_SIZE];
        append(item->bound, sizeof item->bound, "%s", names_join(row->methods, ", ", ", ", text));
    }
    return true;
}
