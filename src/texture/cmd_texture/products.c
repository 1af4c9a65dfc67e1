/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/cmd_texture/products.h"
#include "cli/list.h"

#include <math.h>
#include <stddef.h>

#include "core/append.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"

/* ---- Methods ---------------------------------------------------------------------------------------------------- */

/* Its default, its unit and its range. */
static void append_parameter(list_item *item, const char *before, const char *name, const texture_parameter *p) {
    append(item->bound, sizeof item->bound, "%s%s", before, name);
    if (!isnan(p->value))
        append(item->bound, sizeof item->bound, " %g", p->value);
    append(item->bound, sizeof item->bound, " [%s], %g to %g", p->unit, p->lo, p->hi);
}

void effect_tell(const void *of, list_item *item) {
    static const struct {
        unsigned bit;
        const char *name;
    } needs[] = {{EFFECT_POSITION, "the position"},
                 {EFFECT_LAST_FRAME, "last frame's camera"},
                 {EFFECT_SECOND_DEPTH, "a second depth"},
                 {EFFECT_NORMALS, "normals"}};
    const effect_row *row = of;
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
}

/* The parameters of every effect in turn, so that names come again. */
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

void packing_tell(const void *of, list_item *item) {
    const packing *row = of;
    const pack_row *encoded = packing_normals(row);
    if (row->steps > 0)
        append(item->bound, sizeof item->bound, "depth: at most %s%s", number_up(0.5 / row->steps + row->off, 3).text,
               row->linear ? " of far" : "");
    if (encoded != NULL)
        append(item->bound, sizeof item->bound, "%snormal: at most %s degrees%s", row->steps > 0 ? "; " : "",
               number_up(encoded->normal.max, 3).text, encoded->sphere ? "" : " where it faces the camera");
}

/* ---- Kinds ---------------------------------------------------------------------------------------------------- */

static const name_list positions = {.words = (const char *const[]){"exact", NULL}, .rows = &position_table};
static const name_list normals = {.rows = &normal_table};
static const name_list packings = {.rows = &packing_table};
static const name_list effects = {.rows = &effect_table};

#define METHOD(among, field, usual) .methods = &(among), .place = offsetof(texture_asked, field), .standard = (usual)

static const product_row rows[] = {
    {"eye", NULL, "eye depth", NULL, FRAME_EYE, .by = "eye depth", .unit = "scene units",
     .unit_of_error = "scene units"},
    {"radial", NULL, "distance from the camera", NULL, FRAME_EYE, .radial = true, .by = "distance from the camera",
     .unit = "scene units", .unit_of_error = "scene units"},
    {"linear01", NULL, "eye depth over far, as Unity's Linear01Depth", NULL, FRAME_LINEAR01, .by = "eye depth over far",
     .unit = "", .unit_of_error = ""},
    {"raw", NULL, "window depth, of sky too", NULL, FRAME_RAW, .by = "window depth", .unit = "", .unit_of_error = ""},
    {"position", NULL, "world positions, by default exact: the truth", NULL, FRAME_POSITION,
     METHOD(positions, position, "exact"), .by = "positions by ", .unit = "scene units",
     .unit_of_error = "scene units"},
    {"normal", NULL, "normals, by default projective", NULL, FRAME_NORMAL, METHOD(normals, normal, "projective"),
     .by = "normals by ", .unit = "", .unit_of_error = "degrees"},
    {"packed-normal", NULL, "the normals that --packing depth-normals or camera-normals holds, in view space", NULL,
     FRAME_NORMAL, .packed = true, .by = "", .unit = "", .unit_of_error = ""},
    {"pack", NULL, "the depths in several channels of 8 bits, a PNG or NPY, as --packing reads them back", NULL,
     FRAME_EYE, METHOD(packings, pack, NULL), .by = "", .unit = "", .unit_of_error = ""},
    {"effect", NULL, "an effect that reads depth; without an image, the usable values of its parameter", NULL,
     FRAME_EFFECT, METHOD(effects, effect, NULL), .by = "", .unit = "", .unit_of_error = "levels of 1/255"},
};

NAMED_TABLE(product, rows);

void product_tell(const void *of, list_item *item) {
    const product_row *row = of;
    if (row->methods != NULL) {
        char text[NAMES_SIZE];
        append(item->bound, sizeof item->bound, "%s", names_join(row->methods, ", ", ", ", text));
    }
}
