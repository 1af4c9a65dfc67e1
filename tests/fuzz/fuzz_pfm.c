/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PFM as anybody might mangle it. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 2 && data[0] == 'P' && (data[1] == 'f' || data[1] == 'F'))
        use_image(data, size, IMAGE_PFM);
    return 0;
}
