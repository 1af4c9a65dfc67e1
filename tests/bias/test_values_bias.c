/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that bias prints, in both forms: what a bias does, and how much of one is needed. */
#include "bias/cmd_bias/call.h"
#include "bias/verdict.h"
#include "named.h"
#include "printed.h"

enum { DEPTHS = 6 };

static const char *const lines[] = {
    "bias --api vulkan -n 0.3 -f 1000 -F unorm24,fp32 -m d3d,reversed --unit cm --units=-7 --factor=0.75 "
    "--clamp=-1e-6 --slope 0.02 --at 0.3,1.7,55,321.5,900,1000",
    "bias --api gl -n 0.1 -f inf -F unorm16,fp32 -m reversed --rounding zero --units=3.25 --clamp=2e-5 "
    "--at 0.1,3,40,555,7e3,9e4",
    "bias --api d3d9 -n 1 -f 200 -F unorm24 -m log,linear --log-c 3 --units=-2.5e-6 --factor=-1.5 --slope 0.5 "
    "--at 1,2,30,90,150,199",
    "bias --api d3d11 -n 2 -f 60 -F fp32 -m d3d --ortho --units=4000 --at 2,3,7,20,45,60",
    "bias --api d3d11 -n 2 -f 60 -F fp32 -m reversed --ortho --units=4000 --slope 0.5 --at 3,5,7,20,45,60",
    /* Why it is not enough: the exponent, the sign, the clamp, the separation. */
    "bias --api vulkan-exact -n 1 -f 100 -F fp32 -m reversed --units=0.75 --slope 1e-9 --at 2,3,7,20,45,60",
    "bias --api vulkan-exact -n 1 -f 100 -F fp32 -m d3d --units=90 --factor=1 --slope 0.001 --at 2,3,7,20,45,60",
    "bias --api metal -n 1 -f 100 -F fp32 -m d3d --units=-90 --clamp=-1e-8 --slope 1e-7 --at 2,3,7,20,45,60",
    "bias --api d3d12 -n 1 -f 100 -F unorm24 -m reversed --units=90 --factor=1 --slope 0.001 --separation 0.01 "
    "--at 2,3,7,20,45,60",
    /* How much of one is needed. */
    "bias --api d3d11 -n 0.3 -f 1000 -F unorm24,fp32 -m d3d,reversed --factor=-0.25 --slope 0.02 --separation 0.01 "
    "--range 0.4:700 --at 0.3,1.7,55,321.5,900,1000",
    "bias --api gl -n 0.3 -f 1000 -F unorm16 -m gl,reversed --separation 0.125 --range 0.3:800 "
    "--at 0.3,1.7,55,321.5,900,1000",
    "bias --api vulkan-unorm -n 0.1 -f inf -F unorm24,fp32 -m reversed --slope 0.001 --range 0.2:5000 "
    "--at 0.1,3,40,555,7e3,9e4",
    "bias --api vulkan-float -n 1 -f 200 -F unorm24 -m log --log-c 3 --separation 3 --range 2:150 "
    "--at 1,2,30,90,150,199",
    /* Of drivers that take the greater exponent, coplanar and apart. */
    "bias --api vulkan -n 0.1 -f inf -F fp32 -m reversed --separation 0.001 --range 1:10 --at 1,2,3,5,8,10",
    "bias --api gl -n 0.1 -f 1000 -F fp32 -m reversed --slope 1e-4 --separation 0.01 --range 1:10 --at 1,2,3,5,8,10",
    /* Where a bias is enough: up to short of the far plane, whose depth is 0; and from beyond the near plane. */
    "bias --api metal -n 0.1 -f 1000 -F fp32 -m reversed --slope 0.01 --separation 0.02 --range 0.1:1000 "
    "--at 0.3,1,3,20,45,60",
    "bias --api d3d11 -n 0.1 -f 1000 -F fp32 -m d3d --slope 0.01 --separation 1e-5 --range 0.1:900 "
    "--at 0.3,1,3,20,45,60",
    /* The worth of a unit falls with z, so the far end decides. */
    "bias --api d3d11 -n 2 -f 60 -F fp32 -m reversed --ortho --slope 1e-5 --separation 0.001 --range 3:58 "
    "--at 2,3,7,20,45,60",
};

typedef struct bias_case {
    const bias_api *api;
    bool inverse; /* no units are given */
    double units, factor, clamp, slope, gap, range[2], z[DEPTHS];
} bias_case;

static bias_case case_of(const char *line) {
    bias_case c = {.api = bias_api_find(word_behind(line, "--api")),
                   .inverse = !is_given(line, "--units"),
                   .units = number_behind(line, "--units", NAN),
                   .factor = number_behind(line, "--factor", 0),
                   .clamp = number_behind(line, "--clamp", 0),
                   .slope = number_behind(line, "--slope", 0),
                   .gap = number_behind(line, "--separation", 0)};
    numbers_behind(line, "--range", c.range, 2);
    assert_int_equal(numbers_behind(line, "--at", c.z, DEPTHS), DEPTHS);
    return c;
}

/* The sign that brings a layer nearer; no bias where none is enough, and no -0. */
static double signed_units(const dp_setup *setup, double units) {
    return isinf(units) ? NAN : units > 0 && !setup->reversed ? -units : units;
}

static bias_goal goal_of(const bias_case *c, const dp_setup *setup, double gap) {
    return (bias_goal){
        .api = c->api, .factor = setup->reversed ? c->factor : -c->factor, .slope = c->slope, .gap = gap};
}

static void want_forward(values *v, const bias_case *c, const dp_setup *setup, double z) {
    const bias_state s = {c->api, c->units, c->factor, c->clamp};
    const bias_unit r = bias_unit_at(s.api, &setup->spec.format, dp_window(setup, z));
    const double o = bias_offset(&s, r.least, bias_window_slope(setup, z, c->slope)), d = dp_window(setup, z) + o;
    const bias_effect e = bias_at(setup, &s, c->slope, z);
    const bool limited = d < 0 || d > 1;
    const uint32_t code = dp_code(setup, z);
    want(v, "bias=%f depth=%f code=%u", o, fmin(fmax(d, 0), 1), code);
    want(v, "code_moved=%u", o == 0 ? code : dp_format_encode(&setup->spec.format, setup->spec.rounding, d));
    want(v, "z_moved=%f",
         limited ? ((d > 0.5) != (setup->reversed != 0) ? setup->spec.zfar : setup->spec.znear) : e.to);
    want(v, "shift=%f limited=%d", e.shift, limited);
}

static void want_inverse(values *v, const bias_case *c, const dp_setup *setup, double z) {
    const bias_state one = {c->api, setup->reversed ? 1 : -1, 0, 0};
    const bias_effect e = bias_at(setup, &one, c->slope, z);
    const bias_goal apart = goal_of(c, setup, 0), gap = goal_of(c, setup, c->gap);
    want(v, "one_unit=%f", e.limited ? NAN : fabs(e.shift));
    want(v, "units_apart=%f", signed_units(setup, bias_needed(setup, &apart, z)));
    want(v, c->gap > 0 ? "units_gap=%f" : "~units_gap=%f", signed_units(setup, bias_needed(setup, &gap, z)));
}

static double shift_with(const bias_case *c, const dp_setup *setup, double units, double z) {
    const bias_state s = {c->api, units, c->factor, 0};
    return isnan(units) ? NAN : bias_at(setup, &s, c->slope, z).shift;
}

/* With the exponent n + 1, which GL and Vulkan leave open: what half the worth of a unit needs. */
static double with_next(const bias_case *c, const dp_setup *setup, double gap, double lo) {
    const bias_goal goal = goal_of(c, setup, gap);
    bias_api next = *goal.api;
    double z;
    if (setup->spec.format.kind != DP_FORMAT_FLOAT || next.real != BIAS_EXPONENT || strchr("gv", next.name[0]) == NULL)
        return NAN;
    next.exponent = BIAS_EXPONENT_NEXT;
    const bias_goal other = {.api = &next, .factor = goal.factor, .slope = goal.slope, .gap = goal.gap};
    return signed_units(setup, bias_needed_over(setup, &other, lo, c->range[1], &z));
}

static void want_range(values *v, const bias_case *c, const dp_setup *setup) {
    const bias_goal apart = goal_of(c, setup, 0), gap = goal_of(c, setup, c->gap);
    const double lo = c->range[0], hi = c->range[1], gap_lo = fmax(lo, setup->spec.znear + c->gap);
    double apart_z, gap_z, from, to;
    const double alone = signed_units(setup, bias_needed_over(setup, &apart, lo, hi, &apart_z));
    const double with_gap = signed_units(setup, bias_needed_over(setup, &gap, gap_lo, hi, &gap_z));
    bias_enough_over(setup, &apart, INFINITY, lo, hi, &from, &to);
    want(v, "lo=%f hi=%f units_apart=%f units_apart_z=%f", lo, hi, alone, apart_z);
    want(v, "apart_from=%f apart_to=%f units_apart_next=%f", from, to, with_next(c, setup, 0, lo));
    if (c->gap > 0) {
        bias_enough_over(setup, &gap, INFINITY, gap_lo, hi, &from, &to);
        want(v, "units_gap_next=%f gap_lo=%f", with_next(c, setup, c->gap, gap_lo), gap_lo);
        want(v, "units_gap=%f units_gap_z=%f gap_from=%f gap_to=%f", with_gap, gap_z, from, to);
    }
    const double shift_hi = shift_with(c, setup, c->gap > 0 ? with_gap : alone, hi);
    want(v, "shift_lo=%f", shift_with(c, setup, c->gap > 0 ? with_gap : alone, c->gap > 0 ? gap_lo : lo));
    want(v, "shift_hi=%f ~nearer=%f", shift_hi, fabs(shift_hi));
}

static void want_judged(values *v, const bias_api *api, const bias_verdict *b, bool lost) {
    static const char *const answers[] = {"not proven", "enough", "not enough"};
    want(v, "answer=%s lo=%f hi=%f from=%f to=%f z=%f code=%f", answers[b->answer], b->lo, b->hi, b->from, b->to, b->z,
         b->code);
    want(v, "units=%f factor=%f", lost ? NAN : b->units, lost ? NAN : b->factor);
    want_text(v, "call", lost || isnan(b->units) ? NULL : bias_call(api, b->units, b->factor).text);
    want(v, "code_moved=%f short_of_gap=%d enough_next=%d enough_turned=%d", b->moved, b->short_of_gap, b->next,
         b->turned);
    want(v, "enough_unclamped=%d", b->clamped);
}

/* The verdict on a bias that is given, facing and at its slope, and how far it goes. A fragment shader's depth has no
 * bias. */
static void want_verdict(values *v, const bias_case *c, const dp_setup *setup, size_t i) {
    const bool lost = setup->spec.mapping == DP_MAPPING_LOG || setup->spec.mapping == DP_MAPPING_LINEAR;
    const bias_state s = lost ? (bias_state){.api = c->api} : (bias_state){c->api, c->units, c->factor, c->clamp};
    const double lo = c->z[0], hi = c->z[DEPTHS - 1];
    const bias_goal facing = {.api = c->api, .gap = c->gap}, sloped = {.api = c->api, .slope = c->slope, .gap = c->gap};
    const bias_verdict flat = bias_judge(setup, &s, &facing, lo, hi), steep = bias_judge(setup, &s, &sloped, lo, hi);
    const bias_push push = bias_push_over(setup, &s, lo, hi);
    const bias_state least = {c->api, c->slope > 0 ? steep.units : flat.units, 0, 0};
    values_under(v, "setups[%zu].facing.", i);
    want_judged(v, c->api, &flat, lost);
    values_under(v, "setups[%zu].sloped.", i);
    if (c->slope > 0)
        want_judged(v, c->api, &steep, lost);
    values_under(v, "setups[%zu].push.", i);
    want(v, "shift=%f z=%f degrees=%f", push.shift, push.z, NAN);
    want(v, "least=%f", lost || isnan(least.units) ? NAN : -bias_at(setup, &least, 0, push.z).shift);
}

static void want_bias(values *v, const bias_case *c, const dp_setup *setup, size_t i) {
    values_under(v, "setups[%zu].", i);
    want_setup(v, setup);
    for (int k = 0; k < DEPTHS; k++) {
        const bias_unit r = bias_unit_at(c->api, &setup->spec.format, dp_window(setup, c->z[k]));
        values_under(v, "setups[%zu].rows[%d].", i, k);
        want(v, "z=%f r=%f r_most=%f slope=%f", c->z[k], r.least, r.most, bias_window_slope(setup, c->z[k], c->slope));
        (c->inverse ? want_inverse : want_forward)(v, c, setup, c->z[k]);
    }
    values_under(v, "setups[%zu].range.", i);
    if (c->inverse)
        want_range(v, c, setup);
    else
        want_verdict(v, c, setup, i);
}

/* The slope and the gap only where they are asked about. */
static void check_text(values *v, const bias_case *c, const char *line) {
    char columns[256];
    snprintf(columns, sizeof columns, "z:9, r:6, %s%s%s", c->slope > 0 ? "slope:6, " : "",
             c->inverse ? "one_unit:6, units_apart:9" : "bias:6, code:10, code_moved:10, z_moved:10, shift:6",
             c->inverse && c->gap > 0 ? ", units_gap:9" : "");
    char *text = output_of(0, line, "--full");
    for (char *held = text; (held = strstr(held, "  clamped to a plane")) != NULL;) /* words behind the numbers */
        memset(held, ' ', strlen("  clamped to a plane"));
    check_table(v, text, "setups[].rows[]", columns);
    const bool reversed = strcmp(value_at(v, "setups[0].mapping")->text, "reversed") == 0;
    values_under(v, "setups[0].range.");
    if (c->inverse)
        check_line(v, text, "resolved  ",
                   !isnan(value_at(v, "setups[0].range.units_apart")->number)
                       ? "units_apart:9, lo:9, hi:9, units_apart_z:9"
                   : reversed ? "apart_to:9, hi:9"
                              : "apart_from:9, lo:9");
    if (c->inverse && c->gap > 0 && isnan(value_at(v, "setups[0].range.units_gap")->number)) {
        check_line(v, text, "separated  ", reversed ? "gap_to:9, hi:9" : "gap_from:9, gap_lo:9");
    } else if (c->inverse && c->gap > 0) {
        check_line(v, text, "separated  ", "units_gap:9, gap_lo:9, hi:9, units_gap_z:9");
        check_line(v, text, "the same units bring", "nearer:6, hi:6");
    }
    free(text);
}

/* The subject of a sentence: a verdict, or a row. */
static bool any_is(const values *v, const char *field) {
    for (size_t i = 0; i < v->count; i++) {
        const size_t before = strlen(v->items[i].path) - strlen(field);
        if (before < PATH_SIZE && strcmp(v->items[i].path + before, field) == 0 && v->items[i].number > 0)
            return true;
    }
    return false;
}

/* The verdicts end before what was asked about does, at its beginning or at its end. */
static bool any_ends(const values *v, const char *field, double asked) {
    for (size_t i = 0; i < v->count; i++) {
        const char *part = strstr(v->items[i].path, "facing.");
        part = part != NULL ? part : strstr(v->items[i].path, "sloped.");
        if (part != NULL && strcmp(part + 7, field) == 0 && fabs(v->items[i].number - asked) > 1e-6 * fabs(asked))
            return true;
    }
    return false;
}

/* Sentences are said where a field says the same, and nowhere else. */
static void check_sentences(values *v, const bias_case *c, const char *line, unsigned seen[2]) {
    values_tell(v, 0, line);
    const bool near = any_ends(v, "lo", c->z[0]), far = any_ends(v, "hi", c->z[DEPTHS - 1]);
    const struct {
        const char *said;
        bool holds;
    } rows[] = {{"a biased depth beyond a plane is clamped to it", any_is(v, "limited")},
                {"it has the wrong sign", any_is(v, "enough_turned")},
                {"enough where drivers take the exponent n + 1", any_is(v, "enough_next")},
                {"the clamp holds it", any_is(v, "enough_unclamped")},
                {"nearer by less than the separation", any_is(v, "short_of_gap")},
                {"next to the planes none is certain", near || far},
                {"pushes up to", any_is(v, "push.shift")}};
    for (unsigned i = 0; i < sizeof rows / sizeof rows[0] && !c->inverse; i++) {
        if ((strstr(v->told, rows[i].said) != NULL) != rows[i].holds)
            fail_msg("'%s' is %ssaid:\n%s", rows[i].said, rows[i].holds ? "not " : "", v->told);
        seen[rows[i].holds] |= 1U << i;
    }
    seen[1] |= near != far ? near ? 0x100U : 0x200U : 0;
}

TEST(each_number) {
    unsigned seen[2] = {0}; /* sentences that are not said, and that are; each end alone */
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        const bias_case c = case_of(lines[i]);
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        want(&v, "api=%s units=%f factor=%f clamp=%f", c.api->name, c.units, c.factor, c.clamp);
        want(&v, "slope=%f gap=%f", c.slope, c.inverse || c.gap > 0 ? c.gap : NAN);
        const size_t n = setups_of(lines[i], DP_MODEL_EXACT, setups);
        for (size_t k = 0; k < n; k++)
            want_bias(&v, &c, &setups[k], k);
        check_forms(&v, 0, lines[i], "setups[].rows[]",
                    SETUP_CSV "api = /api, z [scene], r, r_most, slope [per pixel], ?bias, ?depth, ?code, ?code_moved, "
                              "?z_moved [scene], ?shift [scene], ?one_unit [scene], ?units_apart, ?units_gap");
        check_text(&v, &c, lines[i]);
        check_sentences(&v, &c, lines[i], seen);
        values_free(&v);
    }
    assert_true(seen[0] == 0x7F && (seen[1] & 0x27F) == 0x27F); /* 0x200: the far end alone */
}

/* A browser changes units before they arrive: by this, times what fp32 makes of one at a depth of 0.01: 2^(-7 - 23). */
TEST(platforms) {
    static const struct {
        const char *platform, *units;
        double times;
    } cases_of[] = {
        {"webgl-d3d", "1.5", 1},    {"webgl-d3d", "-2.75", -2}, {"webgl-d3d", "0.5", 0}, {"webgl-metal", "1.5", 1.5},
        {"webgl-gl", "3", 1.5},     {"webgl-gl", "-5", -2.5},   {"gl", "3", 3},          {"gl", "0.5", 0.5},
        {"webgl-vulkan", "3", 3},   {"vulkan", "3.25", 3.25},   {"safari", "3", 3},      {"metal", "-1.25", -1.25},
        {"firefox-vulkan", "7", 7}, {"chrome-d3d", "-2", -2},
    };
    for (size_t i = 0; i < sizeof cases_of / sizeof cases_of[0]; i++) {
        json_t *root = json_printed(0, "bias --platform %s -F fp32 -m reversed -n 0.1 -f inf --at 10 --units=%s",
                                    cases_of[i].platform, cases_of[i].units);
        const double bias = number_at(root, "setups[0].rows[0].bias");
        if (bias != ldexp(cases_of[i].times, -30))
            fail_msg("%s, %s units: %g steps", cases_of[i].platform, cases_of[i].units, ldexp(bias, 30));
        json_decref(root);
    }
}

/* A question at a depth is answered for it: the units of its row, which bring the layer nearer by the gap, are what
 * is to be written. One unit is 2^-24 of window depth, f/(f - n) (1 - n/z) with near 0.1 and far 1000. */
TEST(one_answer) {
    for (double z = 0.5; z < 1000; z *= 1.7)
        for (double gap = 1e-3; gap < z / 4; gap *= 7) {
            char line[128], call[64];
            snprintf(line, sizeof line, "bias --api gl -F d24 -m gl --separation %.17g --at %.17g", gap, z);
            json_t *root = json_printed(0, "%s", line);
            const double units = number_at(root, "setups[0].rows[0].units_gap");
            const double window = 1000 / 999.9 * 0.1 * gap / ((z - gap) * z);
            assert_true(-units >= ldexp(window, 24) * (1 - 1e-9) && -units <= ldexp(window, 24) * (1 + 1e-9) + 1);
            assert_true(number_at(root, "setups[0].range.units_gap") == units);
            assert_true(number_at(root, "setups[0].range.lo") == z && number_at(root, "setups[0].range.hi") == z);
            snprintf(call, sizeof call, "glPolygonOffset(0, %.0f)", units);
            check_says(0, call, "%s", line);
            json_decref(root);
        }
}

/* What is nearer has a smaller window depth, or in a reversed one a greater. */
TEST(nearer_by_its_sign) {
    static const struct {
        const char *mapping, *sign, *says;
    } rows[] = {{"d3d", "-", "a negative bias brings a layer nearer"},
                {"gl", "-", "a negative bias brings a layer nearer"},
                {"d3d", "", "a negative bias brings a layer nearer"},
                {"reversed", "", "a positive bias brings a layer nearer"},
                {"gl-reversed", "-", "a positive bias brings a layer nearer"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_says(0, rows[i].says, "bias --api d3d11 --units %s2 -F fp32 --at 10 -m %s", rows[i].sign,
                   rows[i].mapping);
}

/* What the list of interfaces says of one unit of a 24-bit target is what a bias is computed with. */
TEST(units_as_listed) {
    static const struct {
        const char *rule;
        double r, most;
    } told[] = {{"1;", 1, 1},
                {"1/(2^N - 1) as binary32;", 0x1.000002p-24, 0x1.000002p-24}, /* 2^-24 (1 + 2^-24 + ...) in 24 digits */
                {"2^-N;", 0x1p-24, 0x1p-24},
                {"at most 2 x 2^-N;", 0x1p-24, 0x1p-23},
                {"the implementation's choice;", 0x1p-24, (double)NAN}};
    json_t *list = json_printed(0, "list apis");
    json_t *items = json_object_get(list, "items");
    size_t seen[5] = {0};
    for (size_t i = 0; i < json_array_size(items); i++) {
        json_t *const item = json_array_get(items, i);
        const char *const rule = text_at(item, "rule") + strlen("unorm: r = ");
        json_t *root = json_printed(0, "bias --api %s -F d24 -m d3d --at 10", text_at(item, "name"));
        for (size_t k = 0; k < 5; k++)
            if (strncmp(rule, told[k].rule, strlen(told[k].rule)) == 0) {
                const double most = number_at(root, "setups[0].rows[0].r_most");
                assert_true(number_at(root, "setups[0].rows[0].r") == told[k].r);
                assert_true(isnan(told[k].most) ? isnan(most) : most == told[k].most);
                seen[k]++;
                break;
            } else {
                assert_true(k < 4);
            }
        json_decref(root);
    }
    assert_true(seen[0] > 0 && seen[1] > 0 && seen[2] > 0);
    json_decref(list);
}

LIST_TEST(check_apart)
