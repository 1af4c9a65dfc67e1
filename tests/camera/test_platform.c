/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The formats that browsers store for a page that asks for 24 bits, against what their sources say. */
#include "depthprec/depthprec.h"
#include "named.h"
#include "printed.h"
#include "raster/raster.h"
#include "support.h"

enum { D24 = 1, F32 = 2, EITHER = 3 };

/* The formats behind a name, as a set. */
static int stored(const char *name) {
    dp_format formats[2];
    int set = 0;
    const size_t count = dp_format_parse(name, formats);
    assert_true(count >= 1);
    for (size_t i = 0; i < count; i++)
        set |= formats[i].kind == DP_FORMAT_UNORM ? D24 : F32;
    return set;
}

TEST(test_published) {
    static const struct {
        const char *name;
        int depth, stencil;
        platform_remap remap;
    } published[] = {
        {"chrome-d3d", F32, EITHER, PLATFORM_REMAPS_NOT},
        {"chrome-vulkan", F32, EITHER, PLATFORM_REMAPS_NOT},
        {"chrome-metal", F32, F32, PLATFORM_REMAPS_NOT},
        {"chrome-gl", F32, F32, PLATFORM_SPREADS},
        {"firefox-d3d", D24, D24, PLATFORM_REMAPS_NOT},
        {"firefox-vulkan", EITHER, EITHER, PLATFORM_REMAPS_NOT},
        {"firefox-metal", EITHER, EITHER, PLATFORM_REMAPS_NOT},
        {"firefox-gl", D24, D24, PLATFORM_SPREADS},
        {"safari", F32, F32, PLATFORM_REMAPS_NOT},
        {"webgl-d3d", D24, D24, PLATFORM_REMAPS},
        {"webgl-metal", F32, EITHER, PLATFORM_REMAPS},
        {"webgl-vulkan", EITHER, EITHER, PLATFORM_MAY_REMAP},
        {"webgl-gl", D24, D24, PLATFORM_REMAPS_NOT},
        {"vulkan", EITHER, EITHER, PLATFORM_REMAPS_NOT},
        {"d3d11", D24, D24, PLATFORM_REMAPS_NOT},
        {"d3d12", D24, D24, PLATFORM_REMAPS_NOT},
        {"metal", EITHER, EITHER, PLATFORM_REMAPS_NOT},
        {"gl", D24, D24, PLATFORM_REMAPS_NOT},
    };
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        const platform *row = platform_find(published[i].name);
        assert_non_null(row);
        assert_int_equal(stored(row->stored), published[i].depth);
        assert_int_equal(stored(row->stencil), published[i].stencil);
        assert_int_equal(row->remap, published[i].remap);
    }
    assert_null(platform_get(sizeof published / sizeof published[0]));
}

/*
 * The same of 24 bits: one code on D3D and Metal, as binary32; Vulkan's choice up to two of 2^-24, which ANGLE may
 * double; GL's without a bound, 2^-24 taken, which Dawn and ANGLE halve.
 */
TEST(test_bias_of_codes) {
    static const double code = 0x1.000002p-24, power = 0x1p-24;
    static const struct {
        const char *name;
        double least, most;
    } published[] = {
        {"chrome-d3d", code, code},          {"firefox-d3d", code, code},       {"safari", code, code},
        {"chrome-vulkan", power, 2 * power}, {"vulkan", power, 2 * power},      {"webgl-vulkan", power, 4 * power},
        {"chrome-gl", power / 2, INFINITY},  {"webgl-gl", power / 2, INFINITY}, {"gl", power, INFINITY},
        {"webgl-d3d", code, code},           {"webgl-metal", code, code},       {"firefox-gl", power, INFINITY},
    };
    dp_format unorm24[2];
    assert_int_equal(dp_format_parse("unorm24", unorm24), 1);
    for (size_t i = 0; i < sizeof published / sizeof published[0]; i++) {
        const platform *row = platform_find(published[i].name);
        const bias_api here = platform_bias(row, bias_api_find(row->api));
        const bias_unit unit = bias_unit_at(&here, &unorm24[0], 0.3);
        if (unit.least != published[i].least || unit.most != published[i].most)
            fail_msg("%s: r from %a to %a", row->name, unit.least, unit.most);
    }
}

/*
 * What arrives of a bias. r of 0.3 in a float buffer: 2^(n - 23) by the WebGPU CTS and on D3D; GL and Vulkan leave n or
 * n + 1 open (vk-gl-cts issue 4169). Dawn halves on desktop GL, ANGLE on GL; ANGLE doubles for some Vulkan devices, and
 * cuts fractions on D3D11; wgpu's GL drops the clamp.
 */
TEST(test_bias) {
    static const double n = 0x1p-25;
    static const struct {
        const char *name;
        double least, most;
        bool cuts, clamps;
    } published[] = {
        {"chrome-d3d", n, n, false, true},    {"chrome-vulkan", n, 2 * n, false, true},
        {"chrome-metal", n, n, false, true},  {"chrome-gl", n / 2, n, false, true},
        {"firefox-d3d", n, n, false, true},   {"firefox-vulkan", n, 2 * n, false, true},
        {"firefox-metal", n, n, false, true}, {"firefox-gl", n, 2 * n, false, false},
        {"safari", n, n, false, true},        {"webgl-d3d", n, n, true, true},
        {"webgl-metal", n, n, false, true},   {"webgl-vulkan", n, 4 * n, false, true},
        {"webgl-gl", n / 2, n, false, true},  {"vulkan", n, 2 * n, false, true},
        {"d3d12", n, n, false, true},         {"metal", n, n, false, true},
        {"d3d11", n, n, false, true},         {"gl", n, 2 * n, false, true},
    };
    dp_format fp32[2];
    size_t i;
    assert_int_equal(dp_format_parse("fp32", fp32), 1);
    for (i = 0; i < sizeof published / sizeof published[0]; i++) {
        const platform *row = platform_find(published[i].name);
        const bias_api *api = bias_api_find(row->api);
        const bias_api here = platform_bias(row, api), other = platform_bias(row, bias_api_find("d3d9"));
        const bias_unit unit = bias_unit_at(&here, &fp32[0], 0.3);
        assert_true(unit.least == published[i].least && unit.most == published[i].most);
        assert_int_equal(row->cuts, published[i].cuts);
        assert_int_equal(here.whole, api->whole || published[i].cuts);
        assert_int_equal(here.clamps, published[i].clamps);
        const bool gl = strncmp(row->name, "webgl", 5) == 0 || strcmp(row->name, "gl") == 0;
        assert_true(gl == (strcmp(row->api, "gl") == 0));
        assert_non_null(bias_api_find(row->below));
        const bias_api *d3d9 = bias_api_find("d3d9"); /* another API is not the platform's */
        assert_true(other.whole == d3d9->whole && other.clamps == d3d9->clamps && other.exponent == d3d9->exponent &&
                    other.guaranteed == d3d9->guaranteed && other.scale_least == d3d9->scale_least &&
                    other.scale_most == d3d9->scale_most && strcmp(other.name, d3d9->name) == 0);
        assert_int_equal(row->bias[0] != '\0', row->cuts || row->drops_clamp || row->scale_least > 0);
    }
    assert_null(platform_get(i));
}

/* Code is in the language of the API's shaders, whatever formats a browser may store; by hand, as those APIs have it.
 */
TEST(test_language) {
    static const struct {
        const char *camera, *language;
    } rows[] = {{"--platform chrome-d3d", "wgsl"}, {"--platform firefox-vulkan", "wgsl"}, {"--platform safari", "wgsl"},
                {"--platform webgl-d3d", "glsl"},  {"--platform webgl-vulkan", "glsl"},   {"--platform d3d11", "hlsl"},
                {"--platform d3d12", "hlsl"},      {"--platform vulkan", "glsl"},         {"--platform metal", "msl"},
                {"--preset unity", "hlsl"},        {"--preset unreal", "hlsl"},           {"--preset bevy", "wgsl"},
                {"--preset three-webgpu", "wgsl"}, {"--preset godot-forward", "glsl"},    {"", "glsl"},
                {"--platform gl", "glsl"},         {"--preset unity-gl", "hlsl"}};
    static const char *const parts[] = {"linearize", "projection", "position --fov 60", "encode -F unorm24"};
    tally t = {.name = "languages of cameras"};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (size_t k = 0; k < sizeof parts / sizeof parts[0]; k++) {
            char line[128];
            snprintf(line, sizeof line, "code --what %s %s", parts[k], rows[i].camera);
            char *chosen = output_of(0, line, "");
            snprintf(line + strlen(line), sizeof line - strlen(line), " --language %s", rows[i].language);
            char *same = output_of(0, line, "");
            TALLY(&t, strcmp(chosen, same) == 0, "%s: %.60s", line, chosen);
            free(chosen);
            free(same);
        }
    tally_end(&t);
}

TEST(test_rows) {
    for (size_t i = 0; platform_get(i) != NULL; i++) {
        const platform *row = platform_get(i);
        assert_true(platform_find(row->name) == row); /* no name twice */
        assert_non_null(raster_find(row->raster));
        assert_true(row->asks[0] != '\0' && row->note[0] != '\0' && row->source[0] != '\0');
        assert_true(strspn(row->newest, "0123456789-") == 7 && row->newest[4] == '-');
        /* what was read in 2026-11 is old from 2025-11 on backwards */
        assert_int_equal(strstr(row->newest, "over a year old") != NULL, strncmp(row->newest, "2025-11", 7) < 0);
    }
}

/* What depth24plus is: each platform is named once, behind the format that --platform makes of it, or as open. */
TEST(what_depth24plus_is) {
    static const char *const names[] = {"depth24plus", "depth24plus-stencil8"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        size_t named = 0;
        char begin[64];
        printed p = print_of("table -F %s -m d3d --at 10", names[k]);
        assert_int_equal(p.status, 0);
        printed_unfold(p.out);
        snprintf(begin, sizeof begin, "%s is ", names[k]);
        const char *text = strstr(p.out, begin), *either = text != NULL ? strstr(text, "either in ") : NULL;
        assert_true(text != NULL && either != NULL && strstr(text, ": --platform takes one.") != NULL);
        for (size_t i = 0; platform_get(i) != NULL; i++) {
            const char *name = platform_get(i)->name, *stored = platform_stores(platform_get(i), names[k]);
            const char *at = strstr(text, name);
            if (stored == NULL)
                continue;
            const bool open = strncmp(stored, "depth24plus", strlen("depth24plus")) == 0;
            const char *fp32 = strstr(text, "fp32 in "), *unorm24 = strstr(text, "unorm24 in ");
            const char *from = open ? either : strcmp(stored, "fp32") == 0 ? fp32 : unorm24;
            const char *end = from == fp32 && unorm24 > fp32 ? unorm24
                              : from != either               ? either
                                                             : strstr(text, ": --platform");
            if (!(at != NULL && from != NULL && at > from && at < end))
                fail_msg("%s: %s is %s, in: %.400s", names[k], name, stored, text);
            named++;
        }
        assert_true(named > 5);
        printed_free(&p);
    }
}
