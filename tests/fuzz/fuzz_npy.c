/* SPDX-License-Identifier: GPL-3.0-or-later */
/* .npy as anybody might mangle it. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 6 && memcmp(data, "\x93NUMPY", 6) == 0)
        use_image(data, size, IMAGE_NPY);
    return 0;
}
