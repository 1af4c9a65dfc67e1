/* SPDX-License-Identifier: GPL-3.0-or-later */
/* DDS as anybody might mangle it. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 4 && memcmp(data, "DDS ", 4) == 0)
        use_image(data, size, IMAGE_DDS);
    return 0;
}
