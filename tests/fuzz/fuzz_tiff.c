/* SPDX-License-Identifier: GPL-3.0-or-later */
/* TIFF as anybody might mangle it: what this program does with what the library says of it. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 4 && (memcmp(data, "II*\0", 4) == 0 || memcmp(data, "MM\0*", 4) == 0))
        use_image(data, size, IMAGE_TIFF);
    return 0;
}
