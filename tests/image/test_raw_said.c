/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command's words about pixels without a header; what it makes of their bytes: test_image_raw. */
#include "printed.h"

/* A file that has a header has its own size, and one without says that its size is assumed. */
TEST(what_is_said) {
    static const char pixels[640 * 480 * 4];
    char path[512];
    snprintf(path, sizeof path, "%s", scratch_file("said.raw"));
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(pixels, 1, sizeof pixels, out), sizeof pixels);
    assert_int_equal(fclose(out), 0);
    printed p = print_of("texture %s -m d3d", path);
    assert_int_equal(p.status, 0);
    assert_non_null(strstr(p.errors, "640 x 480 pixels are assumed, by its length; --size sets them"));
    assert_non_null(strstr(p.out, "640 x 480 pixels, raw of u4"));
    printed_free(&p);
    p = print_of("texture %s -m d3d --size 480x640", path);
    assert_int_equal(p.status, 0);
    assert_null(strstr(p.errors, "assumed"));
    assert_non_null(strstr(p.out, "480 x 640 pixels, raw of u4"));
    printed_free(&p);
    check_says(2, "raw: has no channel Z, but one without a name", "texture %s -m d3d --channel Z", path);
    snprintf(path, sizeof path, "%s", scratch_file("own.npy"));
    p = print_of("texture --synthetic plane --size 8x8 -o %s", path);
    printed_free(&p);
    check_says(2, "--size: is for --synthetic and raw files", "texture %s --size 8x8", path);
}
