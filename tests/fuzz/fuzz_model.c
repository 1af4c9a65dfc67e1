/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models as anybody might mangle them, glTF, or OBJ where the first byte is odd: read whole or refused. */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "model/model.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(int truth) {
    if (!truth)
        abort();
}

static void use(const model *m) {
    for (size_t i = 0; i < m->vertices; i++)
        for (int k = 0; k < 3; k++)
            demand(isfinite(m->position[i][k]));
    for (size_t i = 0; i < m->triangles; i++) {
        demand(m->of[i] < m->surfaces);
        for (int k = 0; k < 3; k++)
            demand(m->triangle[i][k] < m->vertices);
    }
    for (size_t i = 0; i < m->surfaces; i++)
        demand(m->surface[i].node != NULL && m->surface[i].mesh != NULL && m->surface[i].material != NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    model m;
    model_error error;
    if (size == 0)
        return 0;
    const model_asked asked = {.transforms = (data[0] & 2) != 0 ? MODEL_BINARY32 : MODEL_EXACT};
    if (model_parse(data + 1, size - 1, (data[0] & 1) != 0, NULL, &asked, &m, &error)) {
        demand(m.triangles > 0);
        use(&m);
        model_free(&m);
    } else {
        demand(error.text[0] != '\0');
    }
    return 0;
}
