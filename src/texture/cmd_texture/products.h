/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file products.h  The kinds of --product: what texture makes of the depths. */
#ifndef TEXTURE_CMD_TEXTURE_PRODUCTS_H
#define TEXTURE_CMD_TEXTURE_PRODUCTS_H

#include "cli/list.h"
#include "cli/option/names.h"
#include "texture/frame.h"

typedef struct product_row {
    NAMED_FIELDS;
    frame_kind kind;
    bool radial;              /**< FRAME_EYE: along the ray */
    bool packed;              /**< the image holds it beside its depths, of which it is not made */
    const name_list *methods; /**< what may follow behind the colon; null: nothing */
    const char *standard;     /**< the method where none follows; null: one must be named */
    size_t place;             /**< of the method's row in `options` */
    const char *by;           /**< how its name begins, which a method ends: "normals by " */
    const char *unit, *unit_of_error;
} product_row;

/** The rows, eye depth first. */
NAMED_ROWS(product_row, product);

/** Write what is claimed of a row, as name_list has it: methods of a product, parameters and needs of an effect, errors
 * of a packing. */
void product_tell(const void *of, list_item *item);
void effect_tell(const void *of, list_item *item);
void packing_tell(const void *of, list_item *item);

#endif
