/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that solve prints. The planes that it found are taken from its JSON and put to the test: there the
 * measure is what is printed beside them, they pass, and beyond them nothing does. Text and CSV say the same.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "api/cost.h"
#include "printed.h"
#include "requirement/distance.h"
#include "requirement/plane.h"

typedef struct solve_case {
    const char *arguments, *target;
    measure_kind kind;
    double limit; /* NaN: what is reached is asked */
    double lo, hi;
    bool possible;
    double znear, zfar; /* as given; NaN where they are asked for */
    const char *model;
} solve_case;

static const solve_case cases[] = {
    {"-F unorm24,fp32 -m d3d,reversed -f 10000 --separation 0.01 --at 5000", "near", MEASURE_SEPARATION, 0.01, 5000,
     5000, true, NAN, 10000, "exact"},
    {"-n 0.1 -F unorm16 -m d3d --for far --error 0.024 --at 17.77", "far", MEASURE_ERROR, 0.024, 17.77, 17.77, true,
     0.1, NAN, "exact"},
    {"--for far -n 0.1 -F fp16 -m log --log-c 2.5 --error 0.0036 --range 2:5", "far", MEASURE_ERROR, 0.0036, 2, 5, true,
     0.1, NAN, "exact"},
    {"-F fp16 -m reversed -f 1000 --error 0.01 --range 1:100", "near", MEASURE_ERROR, 0.01, 1, 100, false, NAN, 1000,
     "exact"},
    {"-F fp16 -m reversed -f 4000 --rounding even --separation 0.5 --range 10:700", "near", MEASURE_SEPARATION, 0.5, 10,
     700, true, NAN, 4000, "exact"},
    {"-n 0.1 -f 4000 -F unorm16 --separation 0.001 --at 100", "mapping", MEASURE_SEPARATION, 0.001, 100, 100, false,
     0.1, 4000, "exact"},
    {"-n 0.1 -f 4000 --separation 0.001 --range 0.1:100", "format", MEASURE_SEPARATION, 0.001, 0.1, 100, true, 0.1,
     4000, "exact"},
    {"-n 0.1 -f 1000 -F unorm24,fp32 -m d3d,reversed --rounding zero --range 3:50", "separation", MEASURE_SEPARATION,
     NAN, 3, 50, true, 0.1, 1000, "exact"},
    {"-F unorm24,fp32 -m d3d,reversed -f 10000 --separation 0.013 --range 20:4000", "near", MEASURE_SEPARATION, 0.013,
     20, 4000, true, NAN, 10000, "float"},
    {"-F unorm24 -m reversed -f 10000 --separation 0.013 --at 4000", "near", MEASURE_SEPARATION, 0.013, 4000, 4000,
     true, NAN, 10000, "float"},
    {"-F fp32 -m d3d -f 10000 --separation 0.013 --at 4000", "near", MEASURE_SEPARATION, 0.013, 4000, 4000, true, NAN,
     10000, "float"},
    {"--for far -n 0.25 -F unorm24 -m gl --separation 0.5 --at 700", "far", MEASURE_SEPARATION, 0.5, 700, 700, true,
     0.25, NAN, "float"},
    {"-F unorm24 -m d3d -f 2000 --error 0.01 --range 1:300", "near", MEASURE_ERROR, 0.01, 1, 300, true, NAN, 2000,
     "staged"},
    {"--for distance -n 0.1 -f 1000 -F unorm24,fp32 -m d3d,gl --separation 0.01", "distance", MEASURE_SEPARATION, 0.01,
     0.1, 1000, true, 0.1, 1000, "float"},
    {"--for distance -n 0.1 -f 1000 -F unorm24 -m d3d --separation 0.01 --range 0.2:121.4", "distance",
     MEASURE_SEPARATION, 0.01, 0.2, 121.4, true, 0.1, 1000, "float"},
    {"--for distance -n 0.1 -f 2e5 -F fp32 -m reversed --separation 0.01", "distance", MEASURE_SEPARATION, 0.01, 0.1,
     2e5, true, 0.1, 2e5, "float"},
    {"--for distance -n 0.1 -f 1000 -F fp16 -m reversed --separation 0.01", "distance", MEASURE_SEPARATION, 0.01, 0.1,
     1000, true, 0.1, 1000, "exact"},
    {"--for distance -n 0.1 -f 1000 -F fp32 -m reversed --separation 0.01 --range 0.5:1000", "distance",
     MEASURE_SEPARATION, 0.01, 0.5, 1000, true, 0.1, 1000, "exact"},
    {"--for distance -n 0.1 -f 1000 -F unorm24 -m log --separation 0.001", "distance", MEASURE_SEPARATION, 0.001, 0.1,
     1000, true, 0.1, 1000, "float"},
    {"--for near -f 1e7 -F unorm24 -m three-webgpu --separation 1 --at 1e5", "near", MEASURE_SEPARATION, 1, 1e5, 1e5,
     true, NAN, 1e7, "float"},
    {"--for near -f 1e4 -F unorm24 -m d3d --separation 0.0001 --at 5000", "near", MEASURE_SEPARATION, 0.0001, 5000,
     5000, false, NAN, 1e4, "float"},
    {"--for distance -n 0.1 -f 1000 -F fp16 -m d3d --error 0.02 --range 0.2:900", "distance", MEASURE_ERROR, 0.02, 0.2,
     900, true, 0.1, 1000, "exact"},
};

static json_t *root; /* what the run at hand printed */

/* ---- What is said of a candidate --------------------------------------------------------------------------------- */

static double number_in(const json_t *o, const char *key) {
    const json_t *j = json_object_get(o, key);
    return json_is_number(j) ? json_number_value(j) : NAN;
}

static const char *text_in(const json_t *o, const char *key) {
    const char *text = json_string_value(json_object_get(o, key));
    assert_non_null(text);
    return text;
}

static dp_setup setup_in(const json_t *o) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    spec.znear = number_in(o, "near");
    spec.zfar = json_is_null(json_object_get(o, "far")) ? INFINITY : number_in(o, "far");
    assert_int_equal(dp_format_parse(text_in(o, "format"), format), 1);
    spec.format = format[0];
    assert_int_equal(dp_mapping_parse(text_in(o, "mapping"), &spec.mapping), DP_OK);
    for (int r = 0; dp_rounding_name((dp_rounding)r) != NULL; r++)
        if (strcmp(dp_rounding_name((dp_rounding)r), text_in(o, "rounding")) == 0)
            spec.rounding = (dp_rounding)r;
    for (int m = 0; m < DP_MODEL_COUNT; m++)
        if (strcmp(dp_model_name((dp_model)m), text_in(o, "model")) == 0)
            spec.model = (dp_model)m;
    spec.log_c = json_is_number(json_object_get(o, "log_c")) ? number_in(o, "log_c") : 1;
    assert_int_equal(judge_setup(&spec, &setup), DP_OK);
    return setup;
}

/* What a set-up was made from: of a logarithmic depth it has the model that its codes have. */
static dp_spec spec_of(const dp_setup *setup) {
    dp_spec spec = setup->spec;
    if (setup->shader)
        spec.model = DP_MODEL_FLOAT;
    return spec;
}

/* The measure with another plane in place of the one that was solved for; INFINITY where that cannot be. */
static double with_plane(const solve_case *c, const dp_setup *setup, bool near_asked, double plane) {
    dp_spec spec = spec_of(setup);
    dp_setup other;
    *(near_asked ? &spec.znear : &spec.zfar) = plane;
    if (spec.znear > c->lo || spec.zfar < c->hi || judge_setup(&spec, &other) != DP_OK)
        return INFINITY;
    return judge(c->kind, &other, c->lo, c->hi, NAN).value;
}

/* Both ends pass; outward of each nothing does, unless it is as far as a plane can go. */
static void check_island(const solve_case *c, const dp_setup *setup, bool near_asked, double lo, double hi) {
    const double outward = 1e-7;
    assert_true(lo <= hi);
    assert_true(with_plane(c, setup, near_asked, lo) <= c->limit && with_plane(c, setup, near_asked, hi) <= c->limit);
    if (c->kind == MEASURE_ERROR) /* which may pass again where it is aligned otherwise */
        return;
    if (lo > 1e-12 && (near_asked || lo > c->hi))
        assert_true(with_plane(c, setup, near_asked, lo * (1 - outward)) > c->limit);
    if (near_asked ? hi < c->lo : hi < 1e18)
        assert_true(with_plane(c, setup, near_asked, hi * (1 + outward)) > c->limit);
}

static double in_binary32(const solve_case *c, const dp_setup *setup, double z) {
    dp_budget b;
    return c->kind == MEASURE_SEPARATION && dp_budget_at(setup, z, NULL, &b) == DP_OK ? b.separation : NAN;
}

/* Was a plane solved for? By default it is the target; among alternatives it may be another near plane. */
static bool is_solved(const solve_case *c, const dp_setup *setup) {
    return isnan(c->znear) || isnan(c->zfar) || setup->spec.znear != c->znear;
}

static bool near_is_asked(const solve_case *c) {
    return strcmp(c->target, "far") != 0;
}

static bool is_distance(const solve_case *c) {
    return strcmp(c->target, "distance") == 0;
}

static const char *measure_of(const solve_case *c) {
    return c->kind == MEASURE_ERROR ? "error" : "separation";
}

static dp_setup in_model(const dp_setup *setup, dp_model model) {
    dp_setup other;
    dp_spec spec = setup->spec;
    spec.model = model;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    return other;
}

static plane_answer solve_again(const solve_case *c, const dp_setup *setup) {
    plane_answer out;
    const solve_problem p = {.spec = spec_of(setup),
                             .unknown = near_is_asked(c) ? SOLVE_NEAR : SOLVE_FAR,
                             .kind = c->kind,
                             .limit = c->limit,
                             .lo = c->lo,
                             .hi = c->hi};
    assert_int_equal(plane_solve(&p, &out), DP_OK);
    return out;
}

static bool passes_at(const solve_case *c, const dp_setup *setup, double plane) {
    dp_spec spec = spec_of(setup);
    dp_setup other;
    *(near_is_asked(c) ? &spec.znear : &spec.zfar) = plane;
    return judge_setup(&spec, &other) == DP_OK && judge(c->kind, &other, c->lo, c->hi, c->limit).passed;
}

/* Its own ends pass, as does all between them, planes of few bits among them. */
static void check_plane(const solve_case *c, const dp_setup *setup, double plane, const plane_answer *p) {
    assert_true(passes_at(c, setup, plane) && passes_at(c, setup, p->until));
    for (int i = 0; i < 2000 && isfinite(plane) && isfinite(p->until); i++) {
        const double x = plane * pow(p->until / plane, i / 1999.0), grid = ldexp(1.0, ilogb(x) - i % 16);
        const double tried[] = {x, rint(x / grid) * grid};
        for (int k = 0; k < 2; k++)
            if (tried[k] >= fmin(plane, p->until) && tried[k] <= fmax(plane, p->until) && (k == 0 || c->lo == c->hi))
                assert_true(passes_at(c, setup, tried[k]));
    }
}

/* None was found, for certain or not. */
static void want_no_plane(values *v, const solve_case *c, const dp_setup *setup) {
    static const char *const numbers[] = {"until", "first", "tried", "passed", "fails_to"};
    const plane_answer p = solve_again(c, setup);
    assert_false(p.possible);
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++)
        want_number(v, numbers[i], NAN);
    want_bool(v, "proven", p.certain);
    want_bool(v, "certain", p.certain);
}

static void want_plane(values *v, const solve_case *c, const dp_setup *setup, double plane) {
    const plane_answer p = solve_again(c, setup);
    want_number(v, "until", p.until);
    want_number(v, "first", plane);
    want_bool(v, "proven", true);
    want_number(v, "tried", NAN);
    want_number(v, "passed", NAN);
    want_bool(v, "certain", p.certain);
    want_number(v, "fails_to", NAN);
    want_derived(v, "from", fmin(plane, p.until));
    want_derived(v, "to", fmax(plane, p.until));
    assert_true(p.possible && p.value == plane);
    check_plane(c, setup, plane, &p);
    if (setup->spec.model == DP_MODEL_EXACT && c->kind == MEASURE_SEPARATION)
        check_island(c, setup, near_is_asked(c), fmin(plane, p.until), fmax(plane, p.until));
}

/* Up to here it holds, just beyond it does not. */
static distance_answer want_distance(values *v, const solve_case *c, const dp_setup *setup, bool whole) {
    distance_answer d;
    assert_int_equal(distance_solve(c->kind, setup, c->lo, c->hi, c->limit, &d), DP_OK);
    want_number(v, "distance", d.possible ? d.value : NAN);
    if (d.possible)
        assert_true(judge(c->kind, setup, c->lo, d.value, c->limit).passed && (!d.throughout || d.value == c->hi));
    if (!d.throughout)
        assert_true(d.fails > d.value && !judge(c->kind, setup, c->lo, d.fails, c->limit).passed);
    if (whole) {
        want_bool(v, "throughout", d.throughout);
        want_number(v, "fails_from", d.fails);
    }
    want_bool(v, "possible", d.possible);
    return d;
}

/* The nearest surfaces that far apart, one at each binary32 depth, that are stored as one code or the wrong way. */
static double first_fight(const dp_setup *setup, double from, double to, double apart) {
    dp_pipeline p;
    assert_int_equal(dp_pipeline_init(&p, setup), DP_OK);
    float z = (float)from;
    for (z = (double)z < from ? nextafterf(z, INFINITY) : z; (double)z <= to; z = nextafterf(z, INFINITY)) {
        const uint32_t front = dp_pipeline_code(&p, z), back = dp_pipeline_code(&p, (float)((double)z + apart));
        if (setup->reversed ? back >= front : back <= front)
            return (double)z;
    }
    return NAN;
}

/* What lies beyond the distance: 2^14 depths are looked at, then twice as many, and so on until some fight. */
static void want_beyond(values *v, const solve_case *c, const dp_setup *setup) {
    distance_span again[32];
    distance_answer d;
    double first = NAN, end = NAN;
    assert_int_equal(distance_solve(c->kind, setup, c->lo, c->hi, c->limit, &d), DP_OK);
    const double from = d.possible ? d.value : c->lo;
    if (setup->spec.model == DP_MODEL_FLOAT && from < c->hi) {
        first = first_fight(setup, from, c->hi - c->limit, c->limit);
        end = from;
        for (uint32_t depths = 1 << 14; end < c->hi && !(end >= first); depths *= 2)
            for (uint32_t k = 0; k < depths && end < c->hi; k++)
                end = fmin((double)nextafterf((float)end, INFINITY), c->hi);
        end = fmin(end, c->hi - c->limit);
    }
    values_under(v, "fight.");
    want_number(v, "first", first);
    want_number(v, "searched_to", end);
    const size_t count =
        c->kind == MEASURE_SEPARATION && !d.throughout ? distance_again(setup, from, c->hi, c->limit, again, 32) : 0;
    for (size_t i = 0; i < count; i++) {
        values_under(v, "again[%zu].", i);
        want_number(v, "lo", again[i].lo);
        want_number(v, "hi", again[i].hi);
    }
}

/* What real arithmetic would need: the same question in the model exact. */
static void want_lattice(values *v, const solve_case *c, const dp_setup *setup, bool solved) {
    const dp_setup exact = in_model(setup, DP_MODEL_EXACT);
    judgement reached;
    double value = NAN;
    values_under(v, "%.60slattice.", v->prefix);
    if (is_distance(c)) {
        const distance_answer d = want_distance(v, c, &exact, false);
        reached = d.reached;
        value = d.possible ? d.value : NAN;
    } else if (solved) {
        const plane_answer p = solve_again(c, &exact);
        want_bool(v, "possible", p.possible);
        want_number(v, near_is_asked(c) ? "near" : "far", value = p.value);
        reached = p.reached;
    } else {
        reached = judge(c->kind, &exact, c->lo, c->hi, c->limit);
        want_bool(v, "possible", isnan(c->limit) || reached.passed);
    }
    want_number(v, measure_of(c), reached.value);
    want_number(v, "z", reached.z);
    want_derived(v, "plane", value);
    want_derived(v, "value", reached.value);
}

static void want_candidate(values *v, const solve_case *c, const json_t *o, const char *under) {
    const dp_setup setup = setup_in(o);
    const cost price = cost_of(&setup.spec.format, setup.spec.mapping);
    const double plane = near_is_asked(c) ? setup.spec.znear : setup.spec.zfar;
    judgement worst = judge(c->kind, &setup, c->lo, c->hi, c->limit);
    bool passes = isnan(c->limit) || worst.passed;
    values_under(v, "%s", under);
    want_setup(v, &(dp_setup){.spec = spec_of(&setup)});
    if (is_distance(c)) {
        const distance_answer d = want_distance(v, c, &setup, true);
        worst = d.reached;
        passes = d.possible;
        want_derived(v, "from", passes ? c->lo : NAN);
        want_derived(v, "to", passes ? d.value : NAN);
        want_derived(v, "plane", passes ? d.value : NAN);
    } else {
        want_bool(v, "possible", passes);
        want_derived(v, "plane", passes ? plane : NAN);
    }
    want_number(v, measure_of(c), worst.value);
    want_number(v, "z", worst.z);
    want_number(v, "guaranteed", in_binary32(c, &setup, worst.z));
    const bool solved = !is_distance(c) && !isnan(c->limit) && is_solved(c, &setup);
    if (solved && passes)
        want_plane(v, c, &setup, plane);
    else if (!is_distance(c)) {
        if (solved && (isnan(c->znear) || isnan(c->zfar)))
            want_no_plane(v, c, &setup);
        want_derived(v, "from", NAN);
        want_derived(v, "to", NAN);
    }
    values_under(v, "%s", under);
    want_lattice(v, c, &setup, solved);
    values_under(v, "%s", under);
    want_count(v, "bytes", (uint64_t)price.bytes);
    want_text(v, "available", price.available);
    want_text(v, "caution", price.caution);
    want_text(v, "effort", price.effort);
    want_derived(v, "value", worst.value);
}

/* Cheapest first: what passes as it is, what passes with another near, the rest. */
static int class_of(const solve_case *c, const json_t *o) {
    const dp_setup setup = setup_in(o);
    const bool asked = isnan(c->znear) || isnan(c->zfar);
    return !json_is_true(json_object_get(o, "possible")) ? 2 : !asked && is_solved(c, &setup) ? 1 : 0;
}

static void check_order(const solve_case *c, const json_t *alternatives) {
    for (size_t i = 1; i < json_array_size(alternatives); i++) {
        const json_t *a = json_array_get(alternatives, i - 1), *b = json_array_get(alternatives, i);
        const dp_setup x = setup_in(a), y = setup_in(b);
        const cost p = cost_of(&x.spec.format, x.spec.mapping), q = cost_of(&y.spec.format, y.spec.mapping);
        assert_true(class_of(c, a) <= class_of(c, b));
        if (class_of(c, a) == class_of(c, b) && class_of(c, a) < 2)
            assert_true(cost_compare(&p, &q) <= 0);
    }
}

static void want_solve(values *v, const solve_case *c, line_places *lines) {
    const json_t *answer = json_object_get(root, "answer"), *islands = json_object_get(root, "islands");
    const json_t *others = json_object_get(root, "alternatives");
    const dp_setup own = setup_in(answer), setup = in_model(&own, DP_MODEL_EXACT);
    char under[PATH_SIZE];
    assert_string_equal(text_in(answer, "model"), c->model);
    want_text(v, "for", c->target);
    want_text(v, "measure", measure_of(c));
    want_number(v, "limit", c->limit);
    want_number(v, "lo", c->lo);
    want_number(v, "hi", c->hi);
    want_bool(v, "possible", c->possible);
    want_candidate(v, c, answer, "answer.");
    if (is_distance(c))
        want_beyond(v, c, &own);
    place_add(lines, "", "answer.");
    for (size_t i = 0; i < json_array_size(islands); i++) {
        const double lo = number_in(json_array_get(islands, i), "lo"), hi = number_in(json_array_get(islands, i), "hi");
        values_under(v, "islands[%zu].", i);
        want_number(v, "lo", lo);
        want_number(v, "hi", isnan(hi) ? INFINITY : hi);
        check_island(c, &setup, near_is_asked(c), lo, isnan(hi) ? INFINITY : hi);
        assert_true(i == 0);
        if (c->possible && own.spec.model == DP_MODEL_EXACT)
            assert_true(value_at(v, "answer.from")->number == lo &&
                        value_at(v, "answer.to")->number == (isnan(hi) ? INFINITY : hi));
    }
    for (size_t i = 0; i < json_array_size(others); i++) {
        snprintf(under, sizeof under, "alternatives[%zu].", i);
        want_candidate(v, c, json_array_get(others, i), under);
        place_add(lines, "", "%s", under);
    }
    check_order(c, others);
}

/* ---- CSV and text ------------------------------------------------------------------------------------------------ */

static void check_lines(values *v, int status, const char *arguments, line_places *lines) {
    static const csv_column columns[] = {{"role", "role"},
                                         SETUP_COLUMNS,
                                         {"for", "/for"},
                                         {"possible", "^possible"},
                                         {"measure", "/measure"},
                                         {"limit [scene]", "/limit"},
                                         {"value [scene]", "^value"},
                                         {"z [scene]", "^z"},
                                         {"from [scene]", "from"},
                                         {"to [scene]", "to"},
                                         {"bytes", "^bytes"},
                                         {"available", "^available"},
                                         {"first [scene]", "?first"},
                                         {"lattice [scene]", "^lattice.plane"},
                                         {"lattice value [scene]", "^lattice.value"}};
    for (size_t i = 0; i < lines->count; i++) {
        values_under(v, "%s", lines->items[i].inner);
        wanted role = {.kind = VALUE_TEXT, .derived = true};
        want_derived(v, "role", 0);
        role = v->items[v->count - 1];
        role.kind = VALUE_TEXT;
        snprintf(role.text, sizeof role.text, "%s", i == 0 ? "answer" : "alternative");
        v->items[v->count - 1] = role;
    }
    check_csv(v, status, arguments, columns, sizeof columns / sizeof columns[0], lines);
}

/* The set-up under the prefix. */
static dp_setup setup_again(const values *v) {
    size_t i;
    return setup_in(sscanf(v->prefix, "alternatives[%zu]", &i) == 1
                        ? json_array_get(json_object_get(root, "alternatives"), i)
                        : json_object_get(root, "answer"));
}

/* The number behind so many others in the line of a label. */
static double number_shown(const char *text, const char *label, int others) {
    const char *at = text;
    while (*at != '\0' && strncmp(at + strspn(at, " "), label, strlen(label)) != 0)
        at += strcspn(at, "\n") + (at[strcspn(at, "\n")] == '\n');
    assert_true(*at != '\0');
    for (at += strspn(at, " ") + strlen(label); *at != '\n' && *at != '\0';) {
        const size_t length = strcspn(at, " ,:;\n");
        char *end;
        const double number = strtod(at, &end);
        if (length > 0 && end == at + length && others-- == 0)
            return number;
        at += length + strspn(at + length, " ,:;");
    }
    fail_msg("too few numbers behind '%s'", label);
    return NAN;
}

/* A plane is shown with six digits or more that pass when they are typed in: it may be 8 units inwards. */
static void want_shown(values *v, const solve_case *c, const char *name, double plane, double shown) {
    char at[PATH_SIZE];
    const double from = value_at(v, (snprintf(at, PATH_SIZE, "%.60sfrom", v->prefix), at))->number;
    const double to = value_at(v, (snprintf(at, PATH_SIZE, "%.60sto", v->prefix), at))->number;
    const dp_setup setup = setup_again(v);
    assert_true(shown == plane || (shown >= from && shown <= to && fabs(shown / plane - 1) < 9e-5));
    assert_true(passes_at(c, &setup, shown));
    want_derived(v, name, shown);
}

/* Its plane, the lattice's and what it reaches; "none" is no number. */
static void check_text_alternative(values *v, const solve_case *c, const char *text, const char *under) {
    const bool reached = isnan(c->limit),
               by_value = strcmp(c->target, "format") == 0 || strcmp(c->target, "mapping") == 0;
    const char *fields[] = {reached ? "value" : "plane", reached || by_value ? "lattice.value" : "lattice.plane",
                            "value", "bytes"};
    char at[4][PATH_SIZE], label[128];
    const char *paths[5] = {0};
    snprintf(at[0], PATH_SIZE, "%.60sformat", under);
    snprintf(at[1], PATH_SIZE, "%.60smapping", under);
    snprintf(at[2], PATH_SIZE, "%.60smodel", under);
    const char *model = value_at(v, at[2])->text;
    snprintf(label, sizeof label, "%-9.40s %-12.40s %-6.20s ", value_at(v, at[0])->text, value_at(v, at[1])->text,
             model);
    snprintf(at[3], PATH_SIZE, "%.60slattice.possible", under);
    const bool ideal = value_at(v, at[3])->number != 0 || by_value || reached;
    values_under(v, "%s", under);
    snprintf(at[0], PATH_SIZE, "%.60sfails_to", under); /* there where a plane was solved for */
    if (value_find(v, at[0]) != NULL &&
        !isnan(value_at(v, (snprintf(at[1], PATH_SIZE, "%.60splane", under), at[1]))->number)) {
        snprintf(at[0], PATH_SIZE, "%.60splane", under);
        want_shown(v, c, "shown", value_at(v, at[0])->number, number_shown(text, label, 0));
        fields[0] = "shown";
    }
    for (size_t i = 0, n = 0; i < (reached ? 2 : 4); i++) {
        snprintf(at[n], PATH_SIZE, "%.60s%s", under, fields[i]);
        if (isnan(value_at(v, at[n])->number) || (i == 1 && !ideal))
            continue;
        paths[n] = at[n];
        n++;
    }
    check_text_numbers(v, text, label, 6, paths);
}

/* All of it in one sentence: what is guaranteed, what is seen, what the lattice has. */
static void check_text_distance(values *v, const solve_case *c, const char *text) {
    static const char *const again[] = {"again[0].lo", "again[0].hi", NULL};
    const bool seen = isfinite(value_at(v, "fight.first")->number);
    const char *paths[9] = {"answer.near", "answer.far", "limit", "lo", "answer.plane"};
    char label[64];
    size_t count = 5;
    if (isfinite(value_at(v, "fight.searched_to")->number))
        paths[count++] = seen ? "fight.first" : "fight.searched_to";
    if (strcmp(value_at(v, "answer.model")->text, "exact") != 0)
        paths[count++] = "answer.lattice.plane";
    snprintf(label, sizeof label, "%.20s %.20s,", value_at(v, "answer.format")->text,
             value_at(v, "answer.mapping")->text);
    char *const sentence = strndup(text, strcspn(text, "\n") - 1); /* without its full stop */
    check_text_numbers(v, sentence, label, 6, paths);
    free(sentence);
    assert_true((strstr(text, "first seen to fight at z") != NULL) == seen);
    assert_true((strstr(text, "holds again") != NULL) == (value_find(v, "again[0].lo") != NULL));
    if (value_find(v, "again[0].lo") != NULL)
        check_text_numbers(v, text, "holds again", 6, again);
    assert_true((strstr(text, "  assumed  ") != NULL) == (strstr(c->arguments, "-f ") == NULL));
}

/* Which values pass. */
static void check_text_passing(values *v, const solve_case *c, const char *text) {
    static const char *const every[] = {"answer.shown_from", "answer.shown_to", NULL};
    values_under(v, "answer.");
    want_shown(v, c, "shown_from", value_at(v, "answer.from")->number, number_shown(text, "passes ", 0));
    want_shown(v, c, "shown_to", value_at(v, "answer.to")->number, number_shown(text, "passes ", 1));
    check_text_numbers(v, text, "passes ", 6, every);
}

static void check_text(values *v, const solve_case *c, const char *arguments, const line_places *lines) {
    const char *const worst[] = {"answer.value", "answer.z", isnan(c->limit) ? NULL : "limit", NULL};
    static const char *const plane[] = {"answer.plane", NULL};
    static const char *const ideal[] = {"answer.lattice.plane", NULL};
    static const char *const certain[] = {"answer.guaranteed", NULL};
    const bool in_float = strcmp(value_at(v, "answer.model")->text, "float") == 0;
    char label[128];
    printed p = print_of("%s --full", arguments);
    assert_int_equal(p.status, !c->possible);
    snprintf(label, sizeof label, "%-14s ", measure_of(c));
    check_text_numbers(v, p.out, label, 6, worst);
    if (is_distance(c))
        check_text_distance(v, c, p.out);
    if (isfinite(value_at(v, "answer.guaranteed")->number) && !in_float && !is_distance(c))
        check_text_numbers(v, p.out, "guaranteed", 6, certain);
    if (isnan(c->znear) || isnan(c->zfar)) {
        snprintf(label, sizeof label, "%-14s ", c->target);
        if (c->possible) {
            check_text_numbers(v, p.out, label, 15, plane);
            check_text_passing(v, c, p.out);
        }
        if (in_float && value_at(v, "answer.lattice.possible")->number != 0)
            check_text_numbers(v, p.out, "in the lattice", 6, ideal);
    }
    for (size_t i = 0; i < lines->count; i++)
        if (strncmp(lines->items[i].inner, "alternatives", 12) == 0)
            check_text_alternative(v, c, p.out, lines->items[i].inner);
    printed_free(&p);
}

static void test_solve(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const solve_case *c = &cases[i];
        char arguments[512];
        line_places lines = {0};
        values v = values_of("solve");
        v.unit = i % 2 == 0 ? "ft" : NULL;
        const bool fullest = strcmp(c->model, "float") == 0; /* which is that of an answer unless asked otherwise */
        snprintf(arguments, sizeof arguments, "solve %s%s %s%s", fullest ? "" : "--model ", fullest ? "" : c->model,
                 c->arguments, i % 2 == 0 ? " --unit ft" : "");
        printed p = print_of("%s --json", arguments);
        assert_int_equal(p.status, !c->possible);
        root = json_of(p.out);
        want_solve(&v, c, &lines);
        check_json_text(&v, p.out);
        check_lines(&v, !c->possible, arguments, &lines);
        check_text(&v, c, arguments, &lines);
        json_decref(root);
        printed_free(&p);
        values_free(&v);
        places_free(&lines);
    }
}

/* One format and no mapping: the answer is the only one that does it, a logarithm; the library says which do. */
static void test_logarithm_answers(void **state) {
    (void)state;
    for (dp_mapping m = 0; m < DP_MAPPING_COUNT; m++) {
        if (m != DP_MAPPING_D3D && m != DP_MAPPING_GL && m != DP_MAPPING_REVERSED && m != DP_MAPPING_LOG)
            continue;
        dp_spec spec = dp_spec_default();
        dp_setup setup;
        spec.zfar = 1e6;
        spec.mapping = m;
        dp_format both[2];
        assert_int_equal(dp_format_parse("unorm24", both), 1);
        spec.format = both[0];
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        setup = dp_setup_guaranteed(&setup);
        assert_int_equal(dp_separation(&setup, 500) <= 0.01, m == DP_MAPPING_LOG);
    }
    printed p = print_of("solve --for mapping -n 0.1 -f 1e6 -F d24 --separation 0.01 --at 500");
    assert_int_equal(p.status, 0);
    assert_true(strncmp(p.out, "unorm24 log, near 0.1, far 1000000 tells surfaces 0.01 apart", 60) == 0);
    printed_free(&p);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_solve), cmocka_unit_test(test_logarithm_answers),
                                       cmocka_unit_test(check_apart)};
    return run_tap(tests);
}
