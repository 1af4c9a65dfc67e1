/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every value that solve prints. The planes that it found are taken from its JSON and put to the test: there the
 * measure is what is printed beside them, they pass, and beyond them nothing does. Text and CSV say the same.
 */
#include <ctype.h>

#include <time.h>

#include "camera/cost.h"
#include "printed.h"
#include "solve/distance.h"
#include "solve/plane.h"

typedef struct solve_case {
    const char *arguments, *target;
    quantity_kind kind;
    double limit; /* NaN: what is reached is asked */
    double lo, hi;
    bool possible;
    double znear, zfar; /* as given; NaN where they are asked for */
    const char *model;
} solve_case;

static const solve_case cases[] = {
    {"-F unorm24,fp32 -m d3d,reversed -f 10000 --separation 0.01 --at 5000", "near", QUANTITY_SEPARATION, 0.01, 5000,
     5000, true, NAN, 10000, "exact"},
    {"-n 0.1 -F unorm16 -m d3d --for far --error 0.024 --at 17.77", "far", QUANTITY_ERROR, 0.024, 17.77, 17.77, true,
     0.1, NAN, "exact"},
    {"-n 0.1 -F unorm24 -m d3d --for far --error 0.07451 --at 500", "far", QUANTITY_ERROR, 0.07451, 500, 500, true, 0.1,
     NAN, "staged"},
    {"--for far -n 0.1 -F fp16 -m log --log-c 2.5 --error 0.0036 --range 2:5", "far", QUANTITY_ERROR, 0.0036, 2, 5,
     true, 0.1, NAN, "exact"},
    {"-F fp16 -m reversed -f 1000 --error 0.01 --range 1:100", "near", QUANTITY_ERROR, 0.01, 1, 100, false, NAN, 1000,
     "exact"},
    {"-F fp16 -m reversed -f 4000 --rounding even --separation 0.5 --range 10:700", "near", QUANTITY_SEPARATION, 0.5,
     10, 700, true, NAN, 4000, "exact"},
    {"-F fp32 -m reversed -f 1e6 --separation 0.0004 --at 5000", "near", QUANTITY_SEPARATION, 0.0004, 5000, 5000, true,
     NAN, 1e6, "exact"},
    {"-n 0.1 -f 4000 -F unorm16 --separation 0.001 --at 100", "mapping", QUANTITY_SEPARATION, 0.001, 100, 100, false,
     0.1, 4000, "exact"},
    {"-n 0.1 -f 4000 --separation 0.001 --range 0.1:100", "format", QUANTITY_SEPARATION, 0.001, 0.1, 100, true, 0.1,
     4000, "exact"},
    {"-n 0.1 -f 1000 -F unorm24,fp32 -m d3d,reversed --rounding zero --range 3:50", "separation", QUANTITY_SEPARATION,
     NAN, 3, 50, true, 0.1, 1000, "exact"},
    {"-F unorm24,fp32 -m d3d,reversed -f 10000 --separation 0.013 --range 20:4000", "near", QUANTITY_SEPARATION, 0.013,
     20, 4000, true, NAN, 10000, "float"},
    {"-F unorm24 -m reversed -f 10000 --separation 0.013 --at 4000", "near", QUANTITY_SEPARATION, 0.013, 4000, 4000,
     true, NAN, 10000, "float"},
    {"-F fp32 -m d3d -f 10000 --separation 0.013 --at 4000", "near", QUANTITY_SEPARATION, 0.013, 4000, 4000, true, NAN,
     10000, "float"},
    {"--for far -n 0.25 -F unorm24 -m gl --separation 0.5 --at 700", "far", QUANTITY_SEPARATION, 0.5, 700, 700, true,
     0.25, NAN, "float"},
    {"-F unorm24 -m d3d -f 2000 --error 0.01 --range 1:300", "near", QUANTITY_ERROR, 0.01, 1, 300, true, NAN, 2000,
     "staged"},
    {"--for distance -n 0.1 -f 1000 -F unorm24,fp32 -m d3d,gl --separation 0.01", "distance", QUANTITY_SEPARATION, 0.01,
     0.1, 1000, true, 0.1, 1000, "float"},
    {"--for distance -n 0.1 -f 1000 -F unorm24 -m d3d --separation 0.01 --range 0.2:121.4", "distance",
     QUANTITY_SEPARATION, 0.01, 0.2, 121.4, true, 0.1, 1000, "float"},
    {"--for distance -n 0.1 -f 2e5 -F fp32 -m reversed --separation 0.01", "distance", QUANTITY_SEPARATION, 0.01, 0.1,
     2e5, true, 0.1, 2e5, "float"},
    {"--for distance -n 0.1 -f 1000 -F fp16 -m reversed --separation 0.01", "distance", QUANTITY_SEPARATION, 0.01, 0.1,
     1000, true, 0.1, 1000, "exact"},
    {"--for distance -n 0.1 -f 1000 -F fp32 -m reversed --separation 0.01 --range 0.5:1000", "distance",
     QUANTITY_SEPARATION, 0.01, 0.5, 1000, true, 0.1, 1000, "exact"},
    {"--for distance -n 0.1 -f 1000 -F unorm24 -m log --separation 0.001", "distance", QUANTITY_SEPARATION, 0.001, 0.1,
     1000, true, 0.1, 1000, "float"},
    {"--for near -f 1e7 -F unorm24 -m three-webgpu --separation 1 --at 1e5", "near", QUANTITY_SEPARATION, 1, 1e5, 1e5,
     true, NAN, 1e7, "float"},
    {"--for near -f 1e4 -F unorm24 -m d3d --separation 0.0001 --at 5000", "near", QUANTITY_SEPARATION, 0.0001, 5000,
     5000, false, NAN, 1e4, "float"},
    {"--for distance -n 0.1 -f 1000 -F fp16 -m d3d --error 0.02 --range 0.2:900", "distance", QUANTITY_ERROR, 0.02, 0.2,
     900, true, 0.1, 1000, "exact"},
};

static json_t *root; /* what the run at hand printed */

/* ---- What is said of a candidate --------------------------------------------------------------------------------- */

static dp_setup setup_of(const json_t *o) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    dp_setup setup;
    spec.znear = number_at(o, "near");
    spec.zfar = isnan(number_at(o, "far")) ? INFINITY : number_at(o, "far");
    assert_int_equal(dp_format_parse(text_at(o, "format"), format), 1);
    spec.format = format[0];
    assert_int_equal(dp_mapping_parse(text_at(o, "mapping"), &spec.mapping), DP_OK);
    for (int r = 0; dp_rounding_name((dp_rounding)r) != NULL; r++)
        if (strcmp(dp_rounding_name((dp_rounding)r), text_at(o, "rounding")) == 0)
            spec.rounding = (dp_rounding)r;
    for (int m = 0; m < DP_MODEL_COUNT; m++)
        if (strcmp(dp_model_name((dp_model)m), text_at(o, "model")) == 0)
            spec.model = (dp_model)m;
    spec.log_c = node_at(o, "log_c") != NULL ? number_at(o, "log_c") : 1;
    assert_int_equal(quantity_setup(&spec, &setup), DP_OK);
    return setup;
}

/* The spec that a set-up was made from: of a logarithmic depth it has the model that its codes have. */
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
    if (spec.znear > c->lo || spec.zfar < c->hi || quantity_setup(&spec, &other) != DP_OK)
        return INFINITY;
    return quantity_over(c->kind, &other, c->lo, c->hi, NAN).value;
}

/* Both ends pass; outward of each nothing does, unless it is as far as a plane can go. */
static void check_island(const solve_case *c, const dp_setup *setup, bool near_asked, double lo, double hi) {
    const double outward = 1e-7;
    assert_true(lo <= hi);
    assert_true(with_plane(c, setup, near_asked, lo) <= c->limit && with_plane(c, setup, near_asked, hi) <= c->limit);
    if (c->kind == QUANTITY_ERROR) /* which may pass again where it is aligned otherwise */
        return;
    if (lo > 1e-12 && (near_asked || lo > c->hi))
        assert_true(with_plane(c, setup, near_asked, lo * (1 - outward)) > c->limit);
    if (near_asked ? hi < c->lo : hi < 1e18)
        assert_true(with_plane(c, setup, near_asked, hi * (1 + outward)) > c->limit);
}

static double in_binary32(const solve_case *c, const dp_setup *setup, double z) {
    dp_budget b;
    return c->kind == QUANTITY_SEPARATION && dp_budget_at(setup, z, NULL, &b) == DP_OK ? b.separation : NAN;
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
    return quantity_get(c->kind)->name;
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
    return quantity_setup(&spec, &other) == DP_OK && quantity_over(c->kind, &other, c->lo, c->hi, c->limit).passed;
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
    const plane_answer p = solve_again(c, setup);
    assert_false(p.possible);
    want(v, "until=%f proven=%d certain=%d", NAN, p.certain, p.certain);
}

static void want_plane(values *v, const solve_case *c, const dp_setup *setup, double plane) {
    const plane_answer p = solve_again(c, setup);
    want(v, "until=%f proven=%d certain=%d", p.until, true, p.certain);
    want(v, "~from=%f ~to=%f", fmin(plane, p.until), fmax(plane, p.until));
    assert_true(p.possible && p.value == plane);
    check_plane(c, setup, plane, &p);
    if (setup->spec.model == DP_MODEL_EXACT && c->kind == QUANTITY_SEPARATION)
        check_island(c, setup, near_is_asked(c), fmin(plane, p.until), fmax(plane, p.until));
}

/* Up to here it holds, just beyond it does not. */
static distance_answer want_distance(values *v, const solve_case *c, const dp_setup *setup, bool whole) {
    distance_answer d;
    assert_int_equal(distance_solve(c->kind, setup, c->lo, c->hi, c->limit, &d), DP_OK);
    want_number(v, "distance", d.possible ? d.value : NAN);
    if (d.possible)
        assert_true(quantity_over(c->kind, setup, c->lo, d.value, c->limit).passed &&
                    (!d.throughout || d.value == c->hi));
    if (!d.throughout)
        assert_true(d.fails > d.value && !quantity_over(c->kind, setup, c->lo, d.fails, c->limit).passed);
    if (whole)
        want(v, "throughout=%d fails_from=%f", d.throughout, d.fails);
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

/* Fights beyond the distance: 2^14 depths are looked at, then twice as many, and so on until some fight. */
static void want_beyond(values *v, const solve_case *c, const dp_setup *setup) {
    distance_span again[32];
    distance_answer d;
    double first = NAN, end = NAN;
    assert_int_equal(distance_solve(c->kind, setup, c->lo, c->hi, c->limit, &d), DP_OK);
    const double from = d.possible ? d.value : c->lo;
    if (setup->spec.model == DP_MODEL_FLOAT && from + c->limit <= c->hi) {
        first = first_fight(setup, from, c->hi - c->limit, c->limit);
        end = from;
        for (uint32_t depths = 1 << 14; end < c->hi && !(end >= first); depths *= 2)
            for (uint32_t k = 0; k < depths && end < c->hi; k++)
                end = fmin((double)nextafterf((float)end, INFINITY), c->hi);
        end = fmin(end, c->hi - c->limit);
    }
    values_under(v, "fight.");
    want(v, "first=%f searched_to=%f", first, end);
    const size_t count =
        c->kind == QUANTITY_SEPARATION && !d.throughout ? distance_again(setup, from, c->hi, c->limit, again, 32) : 0;
    for (size_t i = 0; i < count; i++) {
        values_under(v, "again[%zu].", i);
        want(v, "lo=%f hi=%f", again[i].lo, again[i].hi);
    }
}

/* The need of real arithmetic: the same question in the model exact. */
static void want_lattice(values *v, const solve_case *c, const dp_setup *setup, bool solved) {
    const dp_setup exact = setup_in(setup, DP_MODEL_EXACT);
    quantity_worst reached;
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
        reached = quantity_over(c->kind, &exact, c->lo, c->hi, c->limit);
        want_bool(v, "possible", isnan(c->limit) || reached.passed);
    }
    want_number(v, measure_of(c), reached.value);
    want(v, "z=%f ~plane=%f ~value=%f", reached.z, value, reached.value);
}

/* Whether it is told what is at any slant, in a view that nobody gave: of guarantees of what is affine on the screen.
 */
static bool is_assumed(const solve_case *c, const dp_setup *setup) {
    return c->kind == QUANTITY_SEPARATION && setup->spec.model == DP_MODEL_FLOAT && !setup->spec.ortho &&
           dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_PERSPECTIVE;
}

static dp_setup at_any_slant(const dp_setup *setup) {
    dp_spec spec = setup->spec;
    dp_setup out;
    spec.triangles = dp_triangles_default();
    assert_int_equal(quantity_setup(&spec, &out), DP_OK);
    return out;
}

/* The same question of surfaces at any slant, which asks for no less. */
static void want_slanted(values *v, const solve_case *c, const dp_setup *setup, const char *under, bool solved) {
    const dp_setup any = at_any_slant(setup);
    quantity_worst reached;
    values_under(v, "%.60sany_slant.", under);
    want(v, "width=%u height=%u fov=%f subpixel=%u", 1920, 1080, 60.0, 8);
    if (is_distance(c)) {
        const distance_answer d = want_distance(v, c, &any, false);
        reached = d.reached;
        want_derived(v, "plane", d.possible ? d.value : NAN);
    } else if (solved) {
        const plane_answer p = solve_again(c, &any);
        const bool near = near_is_asked(c);
        want_bool(v, "possible", p.possible);
        want_number(v, near ? "near" : "far", p.possible ? p.value : NAN);
        want(v, "~plane=%f ~from=%f ~to=%f", p.possible ? p.value : NAN, fmin(p.value, p.until),
             fmax(p.value, p.until));
        reached = p.reached;
        assert_true(!p.possible || (passes_at(c, &any, p.value) && passes_at(c, setup, p.value)));
    } else {
        reached = quantity_over(c->kind, &any, c->lo, c->hi, c->limit);
        want_bool(v, "possible", isnan(c->limit) || reached.passed);
        want_derived(v, "plane", reached.passed ? setup->spec.znear : NAN);
    }
    want_number(v, "separation", reached.value);
    if (!is_distance(c))
        want_number(v, "z", reached.z);
}

static void want_candidate(values *v, const solve_case *c, const json_t *o, const char *under) {
    const dp_setup setup = setup_of(o);
    const cost price = cost_of(&setup.spec.format, setup.spec.mapping);
    const double plane = near_is_asked(c) ? setup.spec.znear : setup.spec.zfar;
    quantity_worst worst = quantity_over(c->kind, &setup, c->lo, c->hi, c->limit);
    bool passes = isnan(c->limit) || worst.passed;
    values_under(v, "%s", under);
    want_setup(v, &(dp_setup){.spec = spec_of(&setup)});
    if (is_distance(c)) {
        const distance_answer d = want_distance(v, c, &setup, true);
        worst = d.reached;
        passes = d.possible;
        want(v, "~from=%f ~to=%f ~plane=%f", passes ? c->lo : NAN, passes ? d.value : NAN, passes ? d.value : NAN);
    } else {
        want_bool(v, "possible", passes);
        want_derived(v, "plane", passes ? plane : NAN);
    }
    want_number(v, measure_of(c), worst.value);
    want(v, "z=%f guaranteed=%f ~value=%f", worst.z, in_binary32(c, &setup, worst.z), worst.value);
    const bool solved = !is_distance(c) && !isnan(c->limit) && is_solved(c, &setup);
    if (solved && passes)
        want_plane(v, c, &setup, plane);
    else if (!is_distance(c)) {
        if (solved && (isnan(c->znear) || isnan(c->zfar)))
            want_no_plane(v, c, &setup);
        want(v, "~from=%f ~to=%f", NAN, NAN);
    }
    values_under(v, "%s", under);
    want_lattice(v, c, &setup, solved);
    if (is_assumed(c, &setup))
        want_slanted(v, c, &setup, under, solved);
    values_under(v, "%s", under);
    want(v, "bytes=%u available=%s caution=%s effort=%s ~role=%s", (unsigned)price.bytes, price.available,
         price.caution, price.effort, strcmp(under, "answer.") == 0 ? "answer" : "alternative");
}

/* Cheapest first: what passes as it is, what passes with another near, the rest. */
static int class_of(const solve_case *c, const json_t *o) {
    const dp_setup setup = setup_of(o);
    const bool asked = isnan(c->znear) || isnan(c->zfar);
    return !flag_at(o, "possible") ? 2 : !asked && is_solved(c, &setup) ? 1 : 0;
}

static void check_order(const solve_case *c, const json_t *alternatives) {
    for (size_t i = 1; i < json_array_size(alternatives); i++) {
        const json_t *a = json_array_get(alternatives, i - 1), *b = json_array_get(alternatives, i);
        const dp_setup x = setup_of(a), y = setup_of(b);
        const cost p = cost_of(&x.spec.format, x.spec.mapping), q = cost_of(&y.spec.format, y.spec.mapping);
        assert_true(class_of(c, a) <= class_of(c, b));
        if (class_of(c, a) == class_of(c, b) && class_of(c, a) < 2)
            assert_true(cost_compare(&p, &q) <= 0);
    }
}

static void want_solve(values *v, const solve_case *c) {
    const json_t *answer = node_at(root, "answer"), *islands = node_at(root, "islands");
    const json_t *others = node_at(root, "alternatives");
    const dp_setup own = setup_of(answer), setup = setup_in(&own, DP_MODEL_EXACT);
    char under[PATH_SIZE];
    assert_string_equal(text_at(answer, "model"), c->model);
    want(v, "for=%s measure=%s limit=%f lo=%f hi=%f", c->target, measure_of(c), c->limit, c->lo, c->hi);
    want(v, "possible=%d", c->possible);
    want_candidate(v, c, answer, "answer.");
    if (is_distance(c))
        want_beyond(v, c, &own);
    for (size_t i = 0; i < json_array_size(islands); i++) {
        const double lo = number_at(islands, "[%zu].lo", i), end = number_at(islands, "[%zu].hi", i);
        const double hi = isnan(end) ? INFINITY : end;
        values_under(v, "islands[%zu].", i);
        want(v, "lo=%f hi=%f", lo, hi);
        check_island(c, &setup, near_is_asked(c), lo, hi);
        assert_true(i == 0);
        if (c->possible && own.spec.model == DP_MODEL_EXACT)
            assert_true(value_at(v, "answer.from")->number == lo && value_at(v, "answer.to")->number == hi);
    }
    for (size_t i = 0; i < json_array_size(others); i++) {
        snprintf(under, sizeof under, "alternatives[%zu].", i);
        want_candidate(v, c, json_array_get(others, i), under);
    }
    check_order(c, others);
}

/* An answer with the planes that were given is called the cheapest that does where no alternative with them that does
 * costs less. */
TEST(the_cheapest_is_called_so) {
    rng r = rng_make(__func__);
    tally t = {.name = "cheapest"};
    int seen[2] = {0};
    for (uint64_t n = test_cases(12, 40, 400); n > 0; n--) {
        char line[160];
        const char *target = rng_below(&r, 2) == 0 ? "format" : "mapping";
        const double limit = rng_log(&r, 1e-5, 1), at = rng_log(&r, 1, 1000);
        snprintf(line, sizeof line, "solve -n 0.1 -f 4000 --for %s --separation %.3g --at %.3g", target, limit, at);
        printed p = print_of("%s", line);
        json_t *told = json_printed(p.status, "%s", line);
        const json_t *others = json_object_get(told, "alternatives");
        const dp_setup answer = setup_of(json_object_get(told, "answer"));
        const cost price = cost_of(&answer.spec.format, answer.spec.mapping);
        bool cheapest = flag_at(told, "possible") && json_array_size(others) > 0;
        for (size_t i = 0; i < json_array_size(others); i++) {
            const json_t *other = json_array_get(others, i);
            const dp_setup x = setup_of(other);
            const cost its = cost_of(&x.spec.format, x.spec.mapping);
            const bool as_given = x.spec.znear == 0.1 && x.spec.zfar == 4000;
            cheapest = cheapest && !(flag_at(other, "possible") && as_given && cost_compare(&its, &price) < 0);
        }
        const char *word = strstr(p.out, "cheapest"), *list = strstr(p.out, "Alternatives, cheapest first");
        const bool said = word != NULL && (list == NULL || word < list);
        seen[said]++;
        TALLY(&t, said == cheapest, "%s: %d, and not %d: %.80s", line, said, cheapest, p.out);
        json_decref(told);
        printed_free(&p);
    }
    assert_true(seen[0] > 0 && seen[1] > 0);
    tally_end(&t);
}

/* ---- CSV and text ------------------------------------------------------------------------------------------------ */

static void check_lines(const values *v, int status, const char *arguments) {
    line_places lines = {0};
    place_add(&lines, "", "answer.");
    for (size_t i = 0; i < json_array_size(node_at(root, "alternatives")); i++)
        place_add(&lines, "", "alternatives[%zu].", i);
    check_csv(v, status, arguments,
              "role, " SETUP_CSV "for = /for, possible = ^possible, measure = /measure, limit [scene] = /limit, "
              "value [scene] = ^value, z [scene] = ^z, from [scene], to [scene], bytes = ^bytes, "
              "available = ^available, lattice [scene] = ^lattice.plane, "
              "lattice value [scene] = ^lattice.value",
              &lines);
    places_free(&lines);
}

/* The set-up under the prefix. */
static dp_setup setup_again(const values *v) {
    return setup_of(node_at(root, "%.*s", (int)strlen(v->prefix) - 1, v->prefix));
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

/* Some of the answers are at any slant, too; then all are of one model. */
static bool tells_slants(void) {
    bool any = node_at(root, "answer.any_slant") != NULL;
    for (size_t i = 0; i < json_array_size(node_at(root, "alternatives")); i++)
        any = any || node_at(root, "alternatives[%zu].any_slant", i) != NULL;
    return any;
}

/* Its plane, the lattice's and what it reaches; "none" is no number. */
static void check_text_alternative(values *v, const solve_case *c, const char *text, const char *under) {
    const bool reached = isnan(c->limit),
               by_value = strcmp(c->target, "format") == 0 || strcmp(c->target, "mapping") == 0;
    const json_t *o = node_at(root, "%.*s", (int)strlen(under) - 1, under);
    const bool slants = tells_slants();
    const char *fields[] = {reached ? "value" : "plane", reached ? "any_slant.separation" : "any_slant.plane",
                            reached || by_value ? "lattice.value" : "lattice.plane", "value", "bytes"};
    char path[PATH_SIZE], label[128], columns[256] = "";
    const bool ideal = by_value || reached || flag_at(o, "lattice.possible");
    snprintf(label, sizeof label, slants ? "%-9.40s %-12.40s" : "%-9.40s %-12.40s %-6.20s ", text_at(o, "format"),
             text_at(o, "mapping"), text_at(o, "model"));
    values_under(v, "%s", under);
    snprintf(path, sizeof path, "%.60splane", under);
    if (node_at(o, "until") != NULL && !isnan(value_at(v, path)->number)) { /* there where a plane was solved for */
        want_shown(v, c, "shown", value_at(v, path)->number, number_shown(text, label, 0));
        fields[0] = "shown";
    }
    snprintf(path, sizeof path, "%.60sany_slant.plane", under);
    if (slants && !reached && value_find(v, path) != NULL && !isnan(value_at(v, path)->number) && !is_distance(c) &&
        node_at(o, "until") != NULL) {
        const dp_setup own = setup_again(v), any = at_any_slant(&own);
        const double shown = number_shown(text, label, 1), plane = value_at(v, path)->number;
        assert_true((shown == plane || fabs(shown / plane - 1) < 9e-5) && passes_at(c, &any, shown));
        want_derived(v, "shown_slanted", shown);
        fields[1] = "shown_slanted";
    }
    for (size_t i = 0; i < (reached ? 3 : 5); i++) {
        snprintf(path, sizeof path, "%.60s%s", under, fields[i]);
        const wanted *one = value_find(v, path);
        if ((i != 1 || slants) && one != NULL && !isnan(one->number) && (i != 2 || ideal))
            snprintf(columns + strlen(columns), sizeof columns - strlen(columns), "%s%s:6", *columns ? ", " : "",
                     fields[i]);
    }
    check_line(v, text, label, columns);
}

/* All of it in one sentence: what is guaranteed, what is seen, what the lattice has. */
static void check_text_distance(values *v, const solve_case *c, const char *text) {
    const bool seen = isfinite(number_at(root, "fight.first"));
    char label[64], columns[256] = "answer.near:6, answer.far:6, limit:6, lo:6, answer.plane:6";
    if (node_at(root, "answer.any_slant") != NULL && isfinite(number_at(root, "answer.any_slant.distance")))
        strcat(columns, ", answer.any_slant.plane:6");
    if (isfinite(number_at(root, "fight.searched_to")))
        strcat(columns, seen ? ", fight.first:6" : ", fight.searched_to:6");
    if (strcmp(text_at(root, "answer.model"), "exact") != 0)
        strcat(columns, ", answer.lattice.plane:6");
    snprintf(label, sizeof label, "%.20s %.20s,", text_at(root, "answer.format"), text_at(root, "answer.mapping"));
    char *const sentence = strndup(text, strcspn(text, "\n") - 1); /* without its full stop */
    values_under(v, "%s", "");
    check_line(v, sentence, label, columns);
    free(sentence);
    assert_true((strstr(text, "first found to z-fight at z") != NULL) == seen);
    assert_true((strstr(text, "holds again") != NULL) == (value_find(v, "again[0].lo") != NULL));
    if (value_find(v, "again[0].lo") != NULL) {
        double lo, hi; /* rounded into what holds */
        check_line(v, text, "holds again", "again[0].lo:6, again[0].hi:6");
        assert_int_equal(sscanf(strstr(text, "holds again"), "holds again from z = %lf%*[ a-z]%lf", &lo, &hi), 2);
        assert_true(lo >= number_at(root, "again[0].lo") && hi <= number_at(root, "again[0].hi"));
    }
    assert_true((strstr(text, "  assumed  ") != NULL) == (strstr(c->arguments, "-f ") == NULL));
}

/* Whether so many digits are all that a number has. */
static bool has_digits(double x, int digits) {
    char text[32];
    snprintf(text, sizeof text, "%.*g", digits, x);
    return strtod(text, NULL) == x;
}

/* Which values pass: in the lattice all between the ends do, of which some have six digits. */
static void check_text_passing(values *v, const solve_case *c, const char *text) {
    if (strcmp(c->model, "exact") == 0)
        assert_true(has_digits(number_shown(text, "passes ", 0), 6) && has_digits(number_shown(text, "passes ", 1), 6));
    values_under(v, "answer.");
    want_shown(v, c, "shown_from", value_at(v, "answer.from")->number, number_shown(text, "passes ", 0));
    want_shown(v, c, "shown_to", value_at(v, "answer.to")->number, number_shown(text, "passes ", 1));
    check_line(v, text, "passes ", "shown_from:6, shown_to:6");
}

/* "at z = 4000", or "from z = 20 to 4000 ft". */
static void check_where(const solve_case *c, const char *text) {
    const char *at = strstr(text, " at z = "), *from = strstr(text, " from z = ");
    double lo = NAN, hi = NAN;
    if (c->lo < c->hi)
        assert_true(from != NULL && sscanf(from, " from z = %lf%*[a-z ]%lf", &lo, &hi) == 2 && lo == c->lo &&
                    hi == c->hi);
    else
        assert_true(from == NULL && at != NULL && sscanf(at, " at z = %lf", &lo) == 1 && lo == c->lo);
}

static size_t unsure[2]; /* far planes and near ones that are not certain */

/* On which side of a plane that is not the last for certain others may do, beyond all that pass. */
static void check_suffices(const values *v, bool near) {
    const bool certain = flag_at(root, "answer.certain");
    unsure[near] += !certain;
    assert_true((strstr(v->told, "a smaller one may suffice") != NULL) == (near && !certain));
    assert_true((strstr(v->told, "a larger one may suffice") != NULL) == (!near && !certain));
}

static void check_text(values *v, const solve_case *c, const char *arguments) {
    const bool in_float = strcmp(text_at(root, "answer.model"), "float") == 0;
    char label[128], under[PATH_SIZE];
    char *text = output_of(!c->possible, arguments, "--full");
    snprintf(label, sizeof label, "%-14s ", measure_of(c));
    values_under(v, "%s", "");
    check_line(v, text, label, isnan(c->limit) ? "answer.value:6, answer.z:6" : "answer.value:6, answer.z:6, limit:6");
    if (is_distance(c))
        check_text_distance(v, c, text);
    else if (!isnan(c->limit))
        check_where(c, text);
    if (isfinite(number_at(root, "answer.guaranteed")) && !in_float && !is_distance(c))
        check_line(v, text, "guaranteed", "answer.guaranteed:6");
    if (isnan(c->znear) || isnan(c->zfar)) {
        snprintf(label, sizeof label, "%-14s ", c->target);
        values_under(v, "answer.");
        if (c->possible) {
            check_line(v, text, label, "plane:15");
            check_suffices(v, isnan(c->znear));
            check_text_passing(v, c, text);
        }
        if (in_float && value_at(v, "answer.lattice.possible")->number != 0)
            check_line(v, text, "lattice", "lattice.plane:6");
    }
    for (size_t i = 0; i < json_array_size(node_at(root, "alternatives")); i++) {
        snprintf(under, sizeof under, "alternatives[%zu].", i);
        check_text_alternative(v, c, text, under);
    }
    free(text);
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const solve_case *c = &cases[i];
        char line[512];
        const bool fullest = strcmp(c->model, "float") == 0; /* which is that of an answer unless asked otherwise */
        snprintf(line, sizeof line, "solve %s%s %s%s", fullest ? "" : "--model ", fullest ? "" : c->model, c->arguments,
                 i % 2 == 0 ? " --unit ft" : "");
        values v = values_of(line);
        char *text = output_of(!c->possible, line, "--json");
        root = json_of(text);
        want_solve(&v, c);
        values_tell(&v, !c->possible, line);
        check_json_text(&v, text);
        check_lines(&v, !c->possible, line);
        check_text(&v, c, line);
        json_decref(root);
        free(text);
        values_free(&v);
    }
    assert_true(unsure[0] > 0 && unsure[1] > 0);
}

/* One format and no mapping: the answer is the only one that does it, a logarithm; the library says which do. */
TEST(logarithm_answers) {
    static const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_GL, DP_MAPPING_REVERSED, DP_MAPPING_LOG};
    for (size_t i = 0; i < 4; i++) {
        dp_setup setup = SETUP("unorm24", .zfar = 1e6, .mapping = mappings[i]);
        setup = dp_setup_guaranteed(&setup);
        assert_int_equal(dp_separation(&setup, 500) <= 0.01, mappings[i] == DP_MAPPING_LOG);
    }
    printed p = print_of("solve --for mapping -n 0.1 -f 1e6 -F d24 --separation 0.01 --at 500");
    assert_int_equal(p.status, 0);
    assert_true(strncmp(p.out, "unorm24 log, near 0.1, far 1000000 resolves 0.01 ", 47) == 0);
    printed_free(&p);
}

/* Of near, far, format and mapping the first that the line does not give, whether a preset says it or nobody. */
TEST(what_is_solved_for) {
    static const char *const names[] = {"near", "far", "format", "mapping"};
    static const char *const options[] = {"--near 0.5", "--far 5000", "--format d24", "--mapping d3d"};
    static const char *const presets[] = {"", "--preset three", "--preset unity",
                                          "--preset maplibre:height=800,zoom=14"};
    for (size_t p = 0; p < sizeof presets / sizeof presets[0]; p++)
        for (unsigned given = 0; given < 16; given++) {
            int first = 0;
            while (first < 4 && (given >> first & 1U) != 0)
                first++;
            char line[256] = "";
            for (int i = 0; i < 4; i++)
                if ((given >> i & 1U) != 0)
                    snprintf(line + strlen(line), sizeof line - strlen(line), " %s", options[i]);
            json_t *all = json_printed(-1, "solve %s%s --separation 1 --at 900", presets[p], line);
            const char *found = json_string_value(node_at(all, "for"));
            if (first < 4 ? found == NULL || strcmp(found, names[first]) != 0 : found != NULL)
                fail_msg("solve %s%s: for %s, not %s", presets[p], line, found, first < 4 ? names[first] : "nothing");
            json_decref(all);
        }
    check_says(2, "nothing is left to solve for", "solve --preset three %s %s %s %s --separation 1 --at 900",
               options[0], options[1], options[2], options[3]);
}

/* The column of what is solved for is called so, in whatever command line; of a separation it is none. */
TEST(heads) {
    static const struct {
        const char *line, *head;
    } rows[] = {{"--for near -f 1000 --separation 0.1 --at 50", "  least near  "},
                {"--for far -n 0.1 --separation 0.1 --at 50", "  largest far  "},
                {"--for format -n 0.1 -f 1000 --separation 0.1 --at 50", "  near  "},
                {"--for mapping -n 0.1 -f 1000 --separation 0.1 --at 50", "  near  "},
                {"--for distance -n 0.1 -f 1000 --separation 0.1", "  distance  "},
                {"--for separation -F all -n 0.1 -f 1000 --at 50", "  separation  "}};
    enum { ROWS = sizeof rows / sizeof rows[0] };
    for (size_t i = 0; i < ROWS; i++) {
        printed p = print_of("solve %s", rows[i].line);
        const char *heads = strstr(p.out, "\n  format ");
        assert_true(p.status <= 1 && heads != NULL);
        char line[128];
        snprintf(line, sizeof line, "%.*s", (int)strcspn(heads + 1, "\n"), heads + 1);
        for (size_t k = 0; k + 1 < ROWS; k++) /* each has a separation */
            if ((strstr(line, rows[k].head) != NULL) != (strcmp(rows[k].head, rows[i].head) == 0))
                fail_msg("solve %s: '%s' in '%s'", rows[i].line, rows[k].head, line);
        printed_free(&p);
    }
}

/* Why the guarantee is not in binary32, said of what it is: an error has cells, a mapping may have no pipeline. */
TEST(why_another_model) {
    static const char *const rows[][3] = {
        {"--error 0.01 -m d3d", "model float has no cells, so no error", "does not cover this mapping"},
        {"--separation 0.01 -m linear", "model float does not cover this mapping", "so no error"},
        {"--separation 0.01 -m d3d", "float: guaranteed in binary32 arithmetic, ieee", "so no error"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("solve --for near -f 1000 --at 100 -F d24 %s", rows[i][0]);
        char *flat = p.out;
        for (const char *at = p.out; *at != '\0'; at++) /* on one line, with one blank between words */
            if (!isspace((unsigned char)*at) || (flat > p.out && flat[-1] != ' '))
                *flat++ = isspace((unsigned char)*at) ? ' ' : *at;
        *flat = '\0';
        if (strstr(p.out, rows[i][1]) == NULL || strstr(p.out, rows[i][2]) != NULL)
            fail_msg("%s: %s", rows[i][0], p.out);
        printed_free(&p);
    }
}

/* What is wanted is told as it was typed, and what is reached in that unit: a twelfth of a metre is 0.0833 m. */
TEST(typed_lengths) {
    static const char *const lines[][2] = {
        {"solve --for distance --separation 0.5mm -n 5cm -f 2km -F d24 -m d3d",
         "separation of 0.5 mm facing the camera is guaranteed"},
        {"solve --for distance --separation 0.5mm -n 5cm -f 2km -F d24 -m d3d", " mm at z = "},
        {"solve --for distance --separation 0.5mm -n 5cm -f 2km -F d24 -m d3d", "near 5 cm, far 2 km:"},
        {"solve --for near --separation 0.01mm --at 2km -F d24 -m d3d", "resolves 0.01 mm"},
        {"solve --for near --separation 0.01mm --at 2km -F d24 -m d3d", "at z = 2 km, wanted 0.01 mm"},
        {"bias --separation 0.25mm --at 3km -f 9km -F d24 -m d3d", "units at z = 3 km"},
        {"bias --separation 0.25mm --at 3km -f 9km -F d24 -m d3d --api gl,metal", "0.25 mm nearer at z = 3 km:"},
        {"bias --separation 0.25mm --at 3km -f 9km -F d24 -m d3d", " mm at z = 3 km"},
        {"zfight --separation 0.02mm --range 1m:1.5m -F d24 -m d3d",
         "Surfaces 0.02 mm apart never z-fight from 1 m to 1.5 m"},
        {"world --separation 3mm --from-origin 2km --at 10m", "3 mm apart"},
    };
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        printed p = print_of("%s", lines[i][0]);
        char *flat = calloc(1, strlen(p.out) + 1), *to = flat;
        for (const char *at = p.out; *at != '\0'; at++)
            if (*at != '\n' && (*at != ' ' || at[1] != ' '))
                *to++ = *at;
            else if (*at == '\n' && at[1] == ' ')
                *to++ = ' ', at += strspn(at + 1, " ");
        if (strstr(flat, lines[i][1]) == NULL)
            fail_msg("%s: no \"%s\":\n%s", lines[i][0], lines[i][1], p.out);
        free(flat);
        printed_free(&p);
    }
    /* The same number as without units. */
    printed typed = print_of("solve --for near --separation 0.01mm --at 2km -F d24 -m d3d");
    printed bare = print_of("solve --for near --separation 1e-5 --at 2000 -F d24 -m d3d --unit m");
    double in_mm, in_m;
    assert_int_equal(sscanf(strstr(typed.out, "\n  separation ") + 14, "%lf mm", &in_mm), 1);
    assert_int_equal(sscanf(strstr(bare.out, "\n  separation ") + 14, "%lf m", &in_m), 1);
    assert_relative(in_mm, 1000 * in_m, 1e-5);
    printed_free(&typed);
    printed_free(&bare);
}

LIST_TEST(check_apart)

/* Up to where it is guaranteed and up to where nothing was found, the first never farther; no depth before near. */
TEST(no_contradiction) {
    static const double apart[] = {950, 850, 831, 800, 700, 100, 1};
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++) {
        const char *line = "solve --for distance -n 0.1 -f 1000 -F fp16 -m d3d";
        json_t *all = json_printed(0, "%s --separation %g", line, apart[i]);
        const double reached = number_at(all, "answer.distance"), seen = number_at(all, "fight.searched_to"),
                     first = number_at(all, "fight.first");
        assert_true(reached >= 0.1);
        assert_true(isnan(seen) == (reached + apart[i] > 1000)); /* a pair is left to look at, or none is */
        assert_true(isnan(seen) || seen >= reached);
        assert_true(isnan(first) || first >= reached);
        printed p = print_of("%s --separation %g --full", line, apart[i]);
        assert_null(strstr(p.out, "z = -"));
        assert_int_equal(strstr(p.out, "nothing up to z = 1000 lies that far behind it") != NULL, isnan(seen));
        printed_free(&p);
        json_decref(all);
    }
    static const refused_row rows[] = {
        {"--for distance -n 0.1 -f 1000 --separation 2000", "--separation: must be at most 999.9, all", 2},
        {"--for format -n 0.1 -f 1000 --separation 2000 --at 5", "--separation: must be at most 999.9, all", 2},
        {"--for mapping -n 0.1 -f 1000 -F d24 --separation 2000 --at 5", "--separation: must be at most 999.9", 2},
        {"--for near -f 1000 --separation 2000 --at 5", "--separation: must be at most 1000, all", 2},
        {"--for frusta -n 0.1 -f 1000 -F d24 -m d3d --separation 2000", "--separation: must be at most 999.9", 2},
        {"--for distance --ortho -n -5 -f 5 --separation 10.5", "--separation: must be at most 10, all", 2}};
    CHECK_REFUSED("solve", rows);
}

/* Next to 0 an octave holds as many depths as anywhere: few of them are looked at, from before 0 too. */
TEST(soon_beside_0) {
    static const char *const cameras[] = {"-n -1 -f 1e-6 --separation 1e-9", "-n -1 -f 1e6 --separation 0.1"};
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++) {
        const time_t start = time(NULL);
        json_t *all = json_printed(-1, "solve --for distance --ortho -F fp32 -m reversed %s", cameras[i]);
        assert_true(time(NULL) - start < 15); /* minutes before; some two now, longer sanitized */
        const double seen = number_at(all, "fight.searched_to"), first = number_at(all, "fight.first");
        assert_true(isnan(first) || first <= seen);
        json_decref(all);
    }
}

/* Which of lattice and arithmetic asks for frusta: n f/(n - (f - n)/65535) - f = 1.54798; a step of binary32 at 1e7
 * is 1. */
TEST(why_frusta) {
    static const struct {
        const char *line, *said;
        int status;
    } rows[] = {{"-n 0.1 -f 100 -F d16 -m d3d --separation 1", "forbids one frustum: it resolves 1.54798 at", 0},
                {"-n 0.1 -f 1e4 -F d16 -m d3d --separation 1", "forbids one frustum: it resolves nothing at", 0},
                {"-n 0.1 -f 1e3 -F d24 -m d3d --separation 0.6", "the lattice alone would allow one frustum", 0},
                {"-n 0.1 -f 1e7 -F d24 -m d3d --separation 1", "the lattice alone allows it from near", 1},
                {"-n 0.1 -f 100 -F d16 -m d3d --separation 1e-9", "the lattice alone forbids it, before", 1},
                {"-n 0.1 -f 1e4 -F fp32 -m reversed --separation 0.01", "!why", 0}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_says(rows[i].status, rows[i].said, "solve --for frusta %s", rows[i].line);
}

/* How few there must be is told where that is more than one, and not where so few are enough. */
TEST(at_least) {
    static const char *const separations[] = {"1", "0.05", "0.012", "0.006", "0.0051", "0.005"};
    int told = 0, silent = 0;
    for (size_t i = 0; i < sizeof separations / sizeof separations[0]; i++) {
        char line[128];
        snprintf(line, sizeof line, "solve --for frusta -n 0.1 -f 1e4 -F %s -m %s --separation %s",
                 i % 2 == 0 ? "d24" : "fp32", i % 3 == 0 ? "gl" : "d3d", separations[i]);
        json_t *all = json_printed(-1, "%s", line);
        const double count = number_at(all, "count"), least = number_at(all, "at_least");
        const bool possible = flag_at(all, "possible"), more = possible && count > least;
        printed p = print_of("%s", line);
        char want[64];
        snprintf(want, sizeof want, "%g frusta, whatever the arithmetic", least);
        assert_int_equal(strstr(p.out, "  at least ") != NULL, more && least > 1);
        assert_int_equal(strstr(p.out, want) != NULL, more && least > 1);
        assert_int_equal(strstr(p.out, " cannot; ") != NULL, possible && count == least && count > 1);
        told += more && least > 1;
        silent += more && least == 1;
        printed_free(&p);
        json_decref(all);
    }
    print_message("# %d told, %d not\n", told, silent);
    assert_true(told > 0 && silent > 0);
}

/* A plane that nobody gave is named; one that is given, a preset's or solved for is not. */
TEST(assumed_planes) {
#define NEARS "solve --for near --separation 1cm --at 100m -F d24 "
    check_says(0, "assumed        far inf: not given", NEARS "-m d3d");
    check_says(0, "!assumed", NEARS "-m d3d -f 1000");
    check_says(0, "!assumed", NEARS "--preset unity");
    check_says(0, "!assumed", "solve --for far --separation 1cm --at 10 -F d24 -m d3d -n 0.5");
    check_says(0, "assumed        near 0.1 m: not given", "solve --for far --separation 1cm --at 10 -F d24 -m d3d");
#undef NEARS
}

/* Of several set-ups that are asked about the answer is the one that leaves most room. */
TEST(most_room) {
    static const struct {
        const char *line, *field;
        int sign; /* of what is better */
    } rows[] = {{"solve --for near -f 10km --at 500m", "near", -1},
                {"solve --for distance -n 0.5 -f 10km", "distance", 1}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        json_t *all = json_printed(-1, "%s --separation 1cm -F d24,fp32 -m d3d,reversed", rows[i].line), *one;
        const double best = number_at(all, "answer.%s", rows[i].field);
        size_t k, seen = 0;
        json_array_foreach(node_at(all, "alternatives"), k, one) {
            const char *mapping = text_at(one, "mapping"), *format = text_at(one, "format");
            if ((strcmp(mapping, "d3d") != 0 && strcmp(mapping, "reversed") != 0) || strcmp(format, "unorm16") == 0 ||
                !json_is_number(node_at(one, "%s", rows[i].field)))
                continue;
            seen++;
            if (rows[i].sign * (number_at(one, "%s", rows[i].field) - best) > 0)
                fail_msg("%s: %s %s leaves more than %g", rows[i].line, format, mapping, best);
        }
        assert_true(seen >= 1 || isinf(best));
        json_decref(all);
    }
}

/* A matrix says the planes: nothing is assumed of them. */
TEST(planes_of_a_matrix_are_given) {
    check_says(0, "assumed        near 0.1, far inf: not given", "solve --for distance --separation 0.01");
    printed p = print_of("solve --matrix 1,0,0,0,0,1.78,0,0,0,0,1.0001,-0.10001,0,0,1,0 -m d3d --for distance "
                         "--separation 0.01");
    assert_int_equal(p.status, 0);
    assert_true(strstr(p.out, "near 0.1, far 1000.1") != NULL && strstr(p.out, "assumed") == NULL);
    printed_free(&p);
}
