/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What solve finds with --viewport: for each unknown the answer against the library's guarantee of slanted triangles,
 * at the answer and where it is said to end; the options spelled out here by hand.
 */
#include "printed.h"

#define VIEW "--viewport 1280x720 --fov 55 --subpixel 6 --slant 10:80 --triangle-class depth=1.5,pixels=300,slim=8"

static const dp_triangles view = {1280, 720, 55, 6, {0, 0, 0, 0}, 10, 80, 1.5, 300, 8}; /* anchored at a vertex */

typedef struct solve_case {
    const char *arguments, *target;
    double limit, lo, hi; /* the limit NaN: what is reached is asked */
    int status;
} solve_case;

static const solve_case cases[] = {
    {"--for near -F unorm24 -m d3d,reversed -f 5000 --separation 0.05 --at 300", "near", 0.05, 300, 300, 0},
    {"--for near -F unorm24 -m d3d -f 5000 --separation 0.4 --range 20:300", "near", 0.4, 20, 300, 0},
    {"--for near -F fp32 -m reversed -f inf --separation 0.001 --at 300", "near", 0.001, 300, 300, 1},
    {"--for far -n 0.2 -F unorm24 -m gl-reversed --separation 0.02 --at 40", "far", 0.02, 40, 40, 0},
    {"--for format -n 0.2 -f 900 --separation 0.01 --at 90", "format", 0.01, 90, 90, 0},
    {"--for mapping -n 0.2 -f 900 -F fp32 --separation 0.01 --range 3:90", "mapping", 0.01, 3, 90, 0},
    {"-n 0.2 -f 900 -F unorm24,fp32 -m d3d,reversed --range 3:90", "separation", NAN, 3, 90, 0},
    {"--for distance -n 0.2 -f 9000 -F unorm24,fp32 -m d3d,reversed --separation 0.01", "distance", 0.01, 0.2, 9000, 0},
};

/* Null is no number, and means that there is no end. */
static double at(const json_t *object, const char *key) {
    const double number = number_at(object, "%s", key);
    return isnan(number) ? INFINITY : number;
}

/* The set-up of a candidate, with the view or facing; with another plane where `plane` is not NaN. */
static dp_setup setup_of(const json_t *o, bool slanted, const char *unknown, double plane) {
    dp_spec spec = {.znear = at(o, "near"), .zfar = at(o, "far"), .model = DP_MODEL_FLOAT};
    if (!isnan(plane))
        *(strcmp(unknown, "far") == 0 ? &spec.zfar : &spec.znear) = plane;
    assert_int_equal(dp_mapping_parse(text_at(o, "mapping"), &spec.mapping), DP_OK);
    assert_string_equal(text_at(o, "model"), "float");
    if (slanted) {
        spec.triangles = view;
        spec.triangles.plane = dp_anchor_get(DP_ANCHOR_VERTEX)->plane;
    }
    return setup_with(text_at(o, "format"), spec);
}

/* The largest separation of some depths from lo to hi, both ends among them. */
static double largest(const dp_setup *setup, double lo, double hi) {
    double most = 0.0;
    for (int i = 0; i <= 200; i++)
        most = fmax(most, dp_separation(setup, i == 200 ? hi : fmin(lo * pow(hi / lo, i / 200.0), hi)));
    return most;
}

/* Beyond a plane of which that is certain, no other passes. */
static void check_plane(const solve_case *c, const json_t *answer) {
    const double plane = number_at(answer, "%s", c->target), outward = strcmp(c->target, "near") == 0 ? -1e-8 : 1e-8;
    const dp_setup setup = setup_of(answer, true, c->target, NAN);
    assert_true(largest(&setup, c->lo, c->hi) <= c->limit);
    for (int i = 1; i <= 8 && flag_at(answer, "certain") && isfinite(plane); i++) {
        const dp_setup beyond = setup_of(answer, true, c->target, plane * (1 + i * outward));
        assert_true(largest(&beyond, c->lo, c->hi) > c->limit);
    }
}

static void check_distance(const solve_case *c, const json_t *root) {
    const json_t *answer = node_at(root, "answer");
    const dp_setup setup = setup_of(answer, true, "", NAN);
    assert_true(largest(&setup, c->lo, at(answer, "distance")) <= c->limit);
    assert_true(dp_separation(&setup, at(answer, "fails_from")) > c->limit);
    assert_true(isinf(at(root, "fight.first")) && isinf(at(root, "fight.searched_to")));
}

/* Both guarantees, at the depth that is worst; in what is said to be possible that at any slant is short enough. */
static void check_candidate(const solve_case *c, const json_t *o) {
    const dp_setup slanted = setup_of(o, true, "", NAN), facing = setup_of(o, false, "", NAN);
    const bool distance = strcmp(c->target, "distance") == 0, possible = flag_at(o, "possible");
    const double z = at(o, "z"), worst = at(o, "separation");
    assert_true(at(o, "guarantee_slanted") == dp_separation(&slanted, z));
    assert_true(at(o, "guarantee_facing") == dp_separation(&facing, z));
    assert_true(at(o, "guaranteed") == at(o, "guarantee_facing"));
    assert_true(worst >= at(o, "guarantee_slanted"));
    if (!distance && !isnan(c->limit))
        assert_true(possible == (worst <= c->limit));
    if (!distance)
        assert_true(worst * (1 + 1e-12) >= largest(&slanted, c->lo, c->hi) &&
                    worst <= 1.01 * largest(&slanted, c->lo, c->hi));
}

/* The last number of a line of text that begins with `label`. */
static double after(const char *text, const char *label) {
    const char *found = strstr(text, label);
    assert_non_null(found);
    return strtod(found + strlen(label), NULL);
}

static void check_text(const solve_case *c, const json_t *answer) {
    printed p = print_of("solve %s " VIEW, c->arguments);
    const double facing = after(p.out, "\n  facing "), want = at(answer, "guarantee_facing");
    assert_int_equal(p.status, c->status);
    assert_true(facing >= want && facing <= want * (1 + 1e-5));
    assert_non_null(strstr(p.out, ", at 10 to 80"));
    assert_non_null(strstr(p.out, "\n  viewport 1280x720, fov 55, 6 subpixel bits, slant 10 to 80 degrees, ieee\n"));
    const char *note = strstr(p.out, "\n  separation "), *slant = strstr(p.out, "10 to 80");
    if (slant == NULL || slant > note)
        slant = strstr(p.out, "10 to\n  80");
    if (slant == NULL || slant > note)
        slant = strstr(p.out, "10\n  to 80");
    assert_true(slant != NULL && slant < note && strstr(p.out, "any slant") == NULL);
    printed_free(&p);
}

/* The last two columns of the first line are the answer's. */
static void check_lines(const solve_case *c, const json_t *answer) {
    static const char names[] = ",guarantee_facing [scene],guarantee_slanted [scene]";
    printed p = print_of("solve %s " VIEW " --csv", c->arguments);
    char *line = strchr(p.out, '\n') + 1;
    assert_non_null(strstr(p.out, names));
    assert_true(strstr(p.out, names) < line);
    *strchr(line, '\n') = '\0';
    char *comma = strrchr(line, ',');
    assert_true(strtod(comma + 1, NULL) == at(answer, "guarantee_slanted"));
    *comma = '\0';
    assert_true(strtod(strrchr(line, ',') + 1, NULL) == at(answer, "guarantee_facing"));
    printed_free(&p);
}

TEST(answers) {
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const solve_case *c = &cases[i];
        json_t *root = json_printed(c->status, "solve %s " VIEW, c->arguments);
        const json_t *answer = node_at(root, "answer"), *others = node_at(root, "alternatives");
        assert_true(flag_at(root, "possible") == (c->status == 0) && at(root, "triangles.width") == 1280);
        assert_true(at(root, "triangles.slant_lo") == 10 && at(root, "triangles.slim") == 8);
        check_candidate(c, answer);
        for (size_t k = 0; k < json_array_size(others); k++)
            check_candidate(c, json_array_get(others, k));
        if ((strcmp(c->target, "near") == 0 || strcmp(c->target, "far") == 0) && c->status == 0)
            check_plane(c, answer);
        if (strcmp(c->target, "distance") == 0)
            check_distance(c, root);
        check_text(c, answer);
        check_lines(c, answer);
        json_decref(root);
    }
}

TEST(refusals) {
    static const refused_row rows[] = {
        {"-F fp32 -m d3d -f inf --error 0.01 --at 9 " VIEW, "--error: is that at a point", 2},
        {"-F fp32 -m d3d -f inf --separation 0.01 --at 9 --model exact " VIEW,
         "--model: must be float or auto with --viewport", 2},
        {"-F fp32 -m d3d -f inf --separation 0.01 --at 9 --model staged " VIEW, "--model: must be float or auto", 2},
        {"-F fp32 -m reversed,log -f inf --separation 0.01 --at 9 " VIEW,
         "--mapping: must be one of d3d, gl, reversed, gl-rev", 2},
        {"-F fp32 -m linear -f 99 --separation 0.01 --at 9 " VIEW, "--mapping: must be one of d3d", 2},
        {"-F unorm16 -m d3d -f 99 --separation 1 --at 9 --viewport 64x64 --raster softpipe",
         "--raster: softpipe steps the codes of unorm16", 2},
    };
    static const char line[] =
        "solve -F fp32 -m d3d -f 99 --separation 1 --at 9 --viewport 64x64 --raster softpipe --json";
    CHECK_REFUSED("solve", rows);
    check_says_all(0, line, SAID("!unorm16", "unorm24"));
}
