/* SPDX-License-Identifier: GPL-3.0-or-later */
/* PFM and PGM as anybody might mangle them. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 2 && data[0] == 'P' && (data[1] == 'f' || data[1] == 'F'))
        use_image(data, size, IMAGE_PFM);
    if (size >= 2 && data[0] == 'P' && data[1] == '5')
        use_image(data, size, IMAGE_PGM);
    return 0;
}
