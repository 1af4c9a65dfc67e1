/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Units of length: names letter by letter, and conversions held to decimal fractions. The inch is 25.4 mm and the foot
 * 12 inches by the international yard and pound agreement of 1959. */
#include "camera/unit.h"
#include "support.h"

TEST(test_names) {
    static const char *const none[] = {"", "M", "Mm", "kms", "metre", "m2", "m ", " m", "pm", "foot", "inch", "u", "n"};
    for (size_t i = 0; unit_get(i) != NULL; i++) {
        assert_ptr_equal(unit_find(unit_get(i)->name), unit_get(i));
        assert_non_null(strstr(UNIT_NAMES, unit_get(i)->name));
        assert_true(i == 0 || unit_get(i)->nanometres > unit_get(i - 1)->nanometres);
    }
    assert_ptr_equal(unit_find("\302\265m"), unit_find("um"));
    for (size_t i = 0; i < sizeof none / sizeof none[0]; i++)
        assert_null(unit_find(none[i]));
}

TEST(test_conversions) {
    static const struct {
        double value;
        const char *from, *to;
        double expected;
    } cases[] = {
        {10, "cm", "m", 0.1},         {1, "mm", "m", 0.001},  {3, "mm", "m", 0.003}, {0.1, "m", "m", 0.1},
        {1, "km", "cm", 1e5},         {7, "nm", "m", 7e-9},   {0.3, "m", "cm", 30},  {3, "um", "mm", 0.003},
        {1, "in", "cm", 2.54},        {1, "in", "m", 0.0254}, {1, "ft", "in", 12},   {3, "ft", "m", 0.9144},
        {5280, "ft", "km", 1.609344}, {1, "m", "nm", 1e9},    {12, "in", "ft", 1},   {127, "cm", "in", 50},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double got = unit_convert(cases[i].value, unit_find(cases[i].from), unit_find(cases[i].to));
        if (got != cases[i].expected)
            fail_msg("%g %s is %.17g %s, not %.17g", cases[i].value, cases[i].from, cases[i].expected, cases[i].to,
                     got);
    }
}
