/* SPDX-License-Identifier: GPL-3.0-or-later */
/* OpenEXR as anybody might mangle it: what this program does with what the library says of it. */
#include "image_input.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (size >= 4 && memcmp(data, "\x76\x2f\x31\x01", 4) == 0)
        use_image(data, size, IMAGE_EXR);
    return 0;
}
