/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file product.h  The kinds of --product: what texture makes of the depths. */
#ifndef CLI_PRODUCT_H
#define CLI_PRODUCT_H

#include "cli/list.h"
#include "cli/option/names.h"
#include "frame/frame.h"

typedef struct product_row {
    const char *name, *note;
    frame_kind kind;
    bool radial;              /**< FRAME_EYE: along the ray */
    bool packed;              /**< the image holds it beside its depths, of which it is not made */
    const name_list *methods; /**< what may follow behind the colon; null: nothing */
    const char *standard;     /**< the method where none follows; null: one must be named */
    size_t place;             /**< of the method's row in `options` */
    const char *by;           /**< how its name begins, which a method ends: "normals by " */
    const char *unit, *unit_of_error;
} product_row;

/** Row `index`, eye depth first; null behind the last. */
const product_row *product_get(size_t index);

#endif
