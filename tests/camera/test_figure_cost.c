/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of what set-ups cost: bytes and early tests by a table of the test's own, separations as the guarantee is.
 */
#include "core/engine.h"
#include "drawn.h"
#include "printed.h"
#include "support.h"

/* The formats that APIs have: Vulkan's D16, X8_D24 and D32; of binary16 no depth buffer, and the fragment shader of
 * linear and logarithmic depth writes it. */
static const struct {
    const char *format, *bytes;
    bool buffer;
} formats[] = {
    {"fp16", "2 bytes", false}, {"unorm16", "2 bytes", true}, {"unorm24", "4 bytes", true}, {"fp32", "4 bytes", true}};
static const struct {
    const char *mapping;
    bool early, ortho, infinite;
} mappings[] = {{"d3d", true, true, true},         {"gl", true, true, true},        {"reversed", true, true, true},
                {"gl-reversed", true, true, true}, {"linear", false, false, false}, {"log", false, false, false}};
enum { FORMATS = sizeof formats / sizeof formats[0], MAPPINGS = sizeof mappings / sizeof mappings[0] };

/* Of four surfaces in each of their 24 orders, those that are nearer than all before them; as it is shown, upwards. */
static double shaded_early(void) {
    int runs = 0, orders = 0;
    for (int code = 0; code < 256; code++) {
        const int at[] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6};
        if ((1 << at[0] | 1 << at[1] | 1 << at[2] | 1 << at[3]) != 15)
            continue;
        orders++;
        for (int k = 0, nearest = 4; k < 4; k++)
            if (at[k] < nearest) {
                nearest = at[k];
                runs++;
            }
    }
    return ceil(10.0 * runs / orders) / 10;
}

/* The point of a set-up, and the series that it is in. */
static const json_t *point_of(const json_t *root, const char *label, const char **series_name) {
    const json_t *series, *point;
    size_t s, i;
    json_array_foreach(node_at(root, "panels[0].series"), s, series) json_array_foreach(
        json_object_get(series, "points"), i, point) if (strcmp(text_at(point, "label"), label) == 0) {
        *series_name = text_at(series, "name");
        return point;
    }
    return NULL;
}

static void check(const char *options, double at, dp_spec spec, bool infinite) {
    json_t *root = json_printed(0, "plot cost %s", options);
    size_t count = 0;
    double least = 0; /* by row, from the top */
    for (size_t f = 0; f < FORMATS; f++)
        for (size_t m = 0; m < MAPPINGS; m++) {
            char label[64], want[128];
            const char *series = NULL;
            const json_t *point;
            dp_format format[2];
            dp_setup setup;
            if ((spec.ortho && !mappings[m].ortho) || (infinite && !mappings[m].infinite))
                continue;
            snprintf(label, sizeof label, "%s %s", formats[f].format, mappings[m].mapping);
            point = point_of(root, label, &series);
            assert_non_null(point);
            snprintf(want, sizeof want, "%s, %s", formats[f].bytes,
                     !formats[f].buffer  ? "colour targets only"
                     : mappings[m].early ? "early z"
                                         : "no early z");
            if (formats[f].buffer)
                snprintf(want + strlen(want), sizeof want - strlen(want), ": shades %g of 4",
                         mappings[m].early ? shaded_early() : 4.0);
            assert_string_equal(series, want);
            assert_int_equal(dp_format_parse(formats[f].format, format), 1);
            spec.format = format[0];
            assert_int_equal(dp_mapping_parse(mappings[m].mapping, &spec.mapping), DP_OK);
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
            setup = dp_setup_guaranteed(&setup);
            double separation = dp_separation(&setup, at);
            if (!infinite && !dp_is_certain(&setup, at, separation))
                separation = (double)INFINITY;
            const json_t *is = json_object_get(point, "separation");
            if (isinf(separation))
                assert_false(json_is_number(is));
            else
                assert_true(json_number_value(is) == separation);
            count++;
        }
    /* each row above another gives less */
    for (size_t row = count; row-- > 0;) {
        const json_t *series, *point;
        size_t s, i;
        json_array_foreach(node_at(root, "panels[0].series"), s, series) json_array_foreach(
            json_object_get(series, "points"), i, point) if (number_at(point, "row") == (double)row + 0.5 &&
                                                             json_is_number(json_object_get(point, "separation"))) {
            assert_true(number_at(point, "separation") >= least);
            least = number_at(point, "separation");
            count--;
        }
    }
    assert_true(least > 0 && count < FORMATS * MAPPINGS);
    json_decref(root);
}

TEST(costs_and_separations) {
    const dp_spec usual = SETUP("fp32", .znear = 0.1, .zfar = 1000).spec;
    dp_spec spec = usual;
    check("", 100, spec, false);
    check("--at 3", 3, spec, false);
    check("--at 995", 995, spec, false); /* of 16 bits nothing up to far is certain */
    spec.ortho = true;
    check("--ortho --at 7", 7, spec, false);
    spec = usual;
    spec.zfar = (double)INFINITY;
    check("-f inf", 1e4, spec, true);
}

/* The names from the top, the closest first. */
static void check_names(const char *setups, const char *const *names, size_t count) {
    static const svg_font fonts[] = {{17, true}, {13, true}, {13, false}, {12, false}};
    char line[128];
    snprintf(line, sizeof line, "plot cost %s --at 100 --figure-size 800x500 -o -", setups);
    char *bytes = drawn_output("%s", line);
    svg *page = svg_read(bytes, strlen(bytes), fonts, sizeof fonts / sizeof fonts[0]);
    double above = 0;
    for (size_t i = 0; i < count; i++) {
        const svg_mark *name = NULL;
        for (size_t k = 0; k < page->count; k++)
            if (page->marks[k].kind == SVG_WORDS && strcmp(page->marks[k].text, names[i]) == 0)
                name = &page->marks[k];
        assert_non_null(name);
        assert_true(svg_middle_y(name->box) > above);
        above = svg_middle_y(name->box);
    }
    assert_true((strstr(page->description, "No early z: the fragment shader writes depth") != NULL) ==
                (strstr(setups, "log") != NULL));
    svg_free(page);
    free(bytes);
}

/* A set-up that costs no more and gives less than all beside it is marked, and nothing else; what an option names is
 * shown. */
TEST(front_and_names) {
    check_names("-F d16,d32f -m reversed,log",
                (const char *const[]){"* fp32 reversed", "fp32 log", "* unorm16 log", "* unorm16 reversed"}, 4);
    check_names("-F d24 -m d3d,gl", (const char *const[]){"* unorm24 d3d", "unorm24 gl"}, 2); /* which cost the same */
    json_t *root = json_printed(0, "plot cost --preset bevy");
    assert_int_equal(json_array_size(node_at(root, "panels[0].series[0].points")), 1);
    json_decref(root);
    printed p = print_of("plot cost --at 1000 --csv");
    assert_int_equal(p.status, 2);
    assert_non_null(strstr(p.errors, "--at: must be a depth in front of the far plane"));
    printed_free(&p);
}
