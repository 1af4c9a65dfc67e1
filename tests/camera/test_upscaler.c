/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Constants that upscalers ship, by hand, and as they are listed. */
#include "camera/upscaler.h"
#include "printed.h"

static const double pi = 3.14159265358979323846;

/* By the horizontal angle, in long double. */
static double shipped_by_hand(size_t i, double hfov, int width, int height) {
    const long double half = tanl((long double)hfov * pi / 360);
    const long double high = half * height / width, corner = sqrtl(1 + half * half + high * high);
    const long double w = width, h = height;
    return (double)(1.37e-5L * (i == 0 ? half * w / 2 : corner * sqrtl(w * w + h * h)));
}

TEST(test_shipped) {
    static const struct {
        double hfov;
        int width, height;
    } views[] = {{90, 1920, 1080}, {60, 3840, 2160}, {120, 1280, 1024}, {1, 100, 300}, {45, 640, 640}};
    for (size_t i = 0; i < sizeof views / sizeof views[0]; i++)
        for (size_t k = 0; k < UPSCALER_ROWS; k++) {
            const upscaler_view v = {views[i].width, views[i].height,
                                     2 * atan(tan(views[i].hfov * pi / 360) * views[i].height / views[i].width) * 180 /
                                         pi};
            assert_relative(upscaler_get(k)->share(&v),
                            shipped_by_hand(k, views[i].hfov, views[i].width, views[i].height), 1e-12);
        }
    assert_null(upscaler_get(UPSCALER_ROWS));
    /* 1.3 % and 4.6 % of z at 1080p and 90 degrees */
    assert_scene(shipped_by_hand(0, 90, 1920, 1080), 0.013, 0.0005);
    assert_scene(shipped_by_hand(1, 90, 1920, 1080), 0.046, 0.0005);
    /* some 2300 and 8000 times what the vertex grid takes edge-on, by depthprec(7) */
    const double grid = 2 * sqrt(2) * (2 * tan(pi / 4) / 1920) / 512;
    assert_relative(grid, 5.75e-6, 1e-3);
    assert_scene(shipped_by_hand(0, 90, 1920, 1080) / grid, 2300, 50);
    assert_scene(shipped_by_hand(1, 90, 1920, 1080) / grid, 8000, 50 + 100);
}

TEST(test_listed) {
    printed p = print_of("list upscalers");
    const char *at = p.out;
    for (size_t k = 0; k < UPSCALER_ROWS; k++) {
        double percent;
        at = strstr(at, upscaler_get(k)->name);
        assert_non_null(at);
        assert_non_null(strstr(at, upscaler_get(k)->note));
        at = strstr(at, "share ");
        assert_non_null(at);
        assert_int_equal(sscanf(at, "share %lf %% of z", &percent), 1);
        assert_relative(percent, 100 * shipped_by_hand(k, 360 / pi * atan(tan(pi / 6) * 16 / 9), 1920, 1080), 5e-3);
    }
    printed_free(&p);
}
