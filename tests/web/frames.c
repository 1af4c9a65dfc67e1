/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Frames of the flickering picture as digests, a line for each rasterizer and none, format and mapping: with the rooms
 * raster and draw as WebAssembly they are the same as here, bit for bit. See web.sh.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/bits.h"
#include "raster/picture.h"

static uint32_t pixels[DRAW_PICTURE_WIDTH * DRAW_PICTURE_HEIGHT];

/* By bytes: colours are bytes on every machine. */
static uint64_t digest_of(uint64_t sum) {
    const uint8_t *byte = (const uint8_t *)pixels;
    for (size_t i = 0; i < sizeof pixels; i += 4)
        sum = dp_mixed64(sum ^ ((uint64_t)byte[i] << 16 | (uint64_t)byte[i + 1] << 8 | byte[i + 2]));
    return sum;
}

static void show(draw_picture *p, const char *name) {
    static const double shares[] = {0.0, 0.003, 0.05, 1.0, 3.0};
    uint64_t sum = 0;
    size_t wrong = 0;
    for (size_t i = 0; i < sizeof shares / sizeof shares[0]; i++) {
        const double asked = isfinite(p->guaranteed) ? p->guaranteed : 0.1;
        const double gap = fmin(shares[i] * asked, draw_picture_widest(p));
        wrong += draw_picture_frame(p, gap, 97U * (unsigned)i + 5U, i == 2, pixels).wrong;
        sum = digest_of(sum);
    }
    printf("%s: from %a, %lu wrong, %016llx\n", name, p->guaranteed, (unsigned long)wrong, (unsigned long long)sum);
}

int main(void) {
    static const char *const rasters[] = {"llvmpipe", "lavapipe", "softpipe", "swiftshader", "none"};
    static const char *const formats[] = {"fp32", "unorm24", "unorm16", "fp16"};
    for (int i = 0; i < 20; i++)
        for (dp_mapping m = DP_MAPPING_D3D; m < DP_MAPPING_COUNT; m++) {
            dp_spec spec = dp_spec_default();
            dp_format found[2];
            draw_picture p;
            char name[80];
            dp_format_parse(formats[i % 4], found);
            spec.format = found[0];
            spec.mapping = m;
            snprintf(name, sizeof name, "%s %s %s", rasters[i / 4], formats[i % 4], dp_mapping_get(m)->name);
            if (draw_picture_open(&p, &spec, raster_find(rasters[i / 4]), 100.0) != NULL)
                continue;
            show(&p, name);
            draw_picture_close(&p);
        }
    return 0;
}
