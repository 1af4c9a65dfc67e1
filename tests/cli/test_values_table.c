/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every value that table prints, against the library. */
#include "method/choose.h"
#include "named.h"
#include "printed.h"

enum { DEPTHS = 6 };

static const char *const lines[] = {
    "table -n 0.3 -f 1000 -F unorm16,fp32 -m d3d,log --rounding zero --log-c 2 --unit km --range 0.5:700 "
    "--at 0.3,1.7,55,321.5,900,1000",
    "table -n 0.1 -f inf -F unorm24,fp16 -m reversed,d3d --rounding even --at 0.1,3,4e4,1e6,1e7,3e9",
    "table -n 0.7 -f 5000.1 -F unorm24,fp32 -m gl,reversed --model float --arith fused-reciprocal --range 1:4000 "
    "--at 0.7,2,20,333,2500,5000",
    "table -n 0.1 -f inf -F fp32 -m reversed --model float --at 0.1,2,20,333,2500,5e6",
    "table -n 1 -f 50 -F unorm16 -m d3d,linear --model staged --range 1:50 --at 1,2,3,4,5,50",
    "table -n 2 -f 90 -F unorm24 -m reversed,gl --ortho --range 3:80 --at 2,3,5,7,60,90",
    "table -n 0.1 -f 1000 -F unorm16,unorm24,fp32 -m d3d,reversed,log --unit cm --range 0.2:900 --model auto "
    "--tolerance 0.2 --at 0.1,0.5,3,20,100,900",
    "table -n 0.1 -f 1000 -F unorm24 -m d3d --range 0.2:900 --tolerance 1e-6 --at 0.5,1,2,5,10,900",
    "table -n 0.1 -f 1000 -F unorm24,fp32 -m d3d --range 0.2:900 --tolerance 0.01 --at 0.5,1,2,5,10,1000",
};

static void want_worst(values *v, const dp_setup *setup, double lo, double hi) {
    dp_worst w;
    assert_int_equal(dp_worst_over(setup, lo, hi, &w), DP_OK);
    if (isnan(w.error)) {
        want_text(v, "worst", NULL);
        return;
    }
    values_under(v, "%.60sworst.", v->prefix);
    want(v, "lo=%f hi=%f error=%f error_z=%f error_code=%u", lo, hi, w.error, w.error_z, w.error_code);
    const uint32_t ends[2] = {dp_code(setup, lo), dp_code(setup, hi)};
    want(v, "codes=%f", 1.0 + (ends[0] < ends[1] ? ends[1] - ends[0] : ends[0] - ends[1]));
    want(v, "interval=%f interval_lo=%f interval_hi=%f", w.interval, w.interval_lo, w.interval_hi);
    want(v, "interval_code=%u blind_from=%f", w.interval_code, w.blind_from);
}

/* The guarantee of the set-up, whatever the rows are in: of linear it is a lattice. */
static void want_separation(values *v, const dp_setup *setup, double lo, double hi) {
    dp_separation_worst w;
    const dp_setup full = dp_setup_guaranteed(setup);
    assert_int_equal(dp_separation_over(&full, lo, hi, 0, &w), DP_OK);
    assert_true(w.lo == lo && w.hi == hi && w.z >= lo && w.z <= hi);
    assert_true(w.separation == dp_separation(&full, w.z) && w.separation <= w.bound);
    values_under(v, "%.60sworst_separation.", v->prefix);
    want(v, "model=%s lo=%f hi=%f", setup->spec.mapping == DP_MAPPING_LINEAR ? "staged" : "float", lo, hi);
    want(v, "bound=%f separation=%f z=%f", w.bound, w.separation, w.z);
}

static double in_binary32(const dp_setup *setup, double z) {
    dp_budget b;
    return dp_budget_at(setup, z, NULL, &b) == DP_OK ? b.separation : NAN;
}

/* The interval by the method that --tolerance takes, or of the exact cell; none where it would end beyond far. */
static double interval_of(const method_row *row, const dp_setup *setup, double z) {
    const dp_cell cell = dp_cell_of(setup, dp_code(setup, z));
    const method_inputs in = {.count = 1, .z = &z};
    double width = cell.width;
    if (row != NULL && (row->domain & METHOD_PIPELINE) != 0 && z + dp_separation(setup, z) > setup->spec.zfar)
        return NAN;
    if (row != NULL)
        row->run(&(method_call){row, setup, NULL, &in, &(method_outputs){.value = &width}});
    return width;
}

static void want_row(values *v, const dp_setup *setup, const method_row *method, double z) {
    const uint32_t code = dp_code(setup, z);
    const dp_cell cell = dp_cell_of(setup, code);
    const dp_setup exact = setup_in(setup, DP_MODEL_EXACT);
    const dp_setup staged = setup_in(setup, DP_MODEL_STAGED); /* of linear, which has no arithmetic */
    const double computed = in_binary32(setup, z);
    want(v, "z=%f code=%u depth=%f z_stored=%f", z, code, dp_window(setup, z), dp_stored(setup, code));
    want(v, "error=%f cell_lo=%f cell_hi=%f", dp_error(setup, code, z), cell.lo, cell.hi);
    want(v, "interval=%f separation=%f", interval_of(method, setup, z), dp_separation(setup, z));
    want(v, "lattice=%f", dp_separation(&exact, z));
    const double guaranteed = isnan(computed) ? dp_separation(&staged, z) : computed;
    want(v, "guaranteed=%f", guaranteed);
    want_bool(v, "certain", isfinite(guaranteed) && (long double)z + guaranteed <= setup->spec.zfar);
}

/* The method that --tolerance takes for a set-up: the cheapest claim for these planes, in the pipeline or on its
 * lattice. */
static const method_row *method_of(const dp_setup *setup, double tolerance, bool cut, double *claim,
                                   const char **name) {
    const method_family_row *family = method_family_find("interval");
    const double ratio = setup->spec.zfar / setup->spec.znear;
    const bool pipeline = setup->spec.model == DP_MODEL_FLOAT;
    const method_wish wish = {.tolerance = tolerance,
                              .ratio_lo = ratio,
                              .ratio_hi = ratio,
                              .cut_cells = !pipeline && cut,
                              .pipeline = pipeline};
    const method_row *row = NULL;
    for (size_t i = 0; i < family->case_count && setup->spec.model != DP_MODEL_STAGED; i++)
        if (strcmp(family->cases[i].format, setup->spec.format.name) == 0 &&
            family->cases[i].mapping == setup->spec.mapping) {
            row = method_choose(family, i, &wish);
            *claim = row != NULL ? method_claim_over(&row->claims[i], ratio, ratio) : *claim;
        }
    *name = row != NULL ? row->name : pipeline ? NULL : "cell";
    if (row == NULL)
        *claim = pipeline ? NAN : 0;
    return row;
}

static bool holds(const dp_setup *full, double z, double limit) {
    dp_separation_worst w;
    assert_int_equal(dp_separation_over(full, full->spec.znear, z, limit, &w), DP_OK);
    return w.bound <= limit;
}

/* Up to there it is guaranteed, and 1 % farther it is not; NaN: not at near. */
static void check_reach(const dp_setup *full, double limit, double up_to) {
    const double znear = full->spec.znear, zfar = full->spec.zfar;
    if (isnan(up_to)) {
        assert_true(dp_separation(full, znear) > limit);
        return;
    }
    assert_true(up_to >= znear && up_to <= zfar && holds(full, up_to, limit));
    assert_true(up_to == zfar || !holds(full, fmin(1.011 * up_to, zfar), limit));
}

/* How far a millimetre, a centimetre and ten of them go: facing the camera, and at any slant of 1920x1080. */
static void want_reach(values *v, const char *line, const dp_setup *setup, size_t i) {
    const double metre = strstr(line, "--unit km") != NULL ? 1e-3 : strstr(line, "--unit cm") != NULL ? 100 : 1;
    const bool drawn = !setup->spec.ortho && dp_mapping_get(setup->spec.mapping)->curve == DP_CURVE_PERSPECTIVE;
    const dp_setup facing = dp_setup_guaranteed(setup);
    dp_spec spec = setup->spec;
    dp_setup any;
    if (drawn)
        spec.triangles = dp_triangles_default();
    assert_int_equal(dp_setup_init(&any, &spec), DP_OK);
    any = dp_setup_guaranteed(&any);
    json_t *root = json_printed(0, "%s", line);
    for (int k = 0; k < 3; k++) {
        const char *const under = "setups[%zu].resolved[%d].%s";
        const double limit = number_at(root, under, i, k, "separation"), to = number_at(root, under, i, k, "facing_to"),
                     slanted_to = number_at(root, under, i, k, "slanted_to");
        assert_relative(limit, pow(10, k - 3) * metre, 1e-12);
        check_reach(&facing, limit, to);
        if (drawn)
            check_reach(&any, limit, slanted_to);
        assert_true(drawn ? !(slanted_to > to) : isnan(slanted_to));
        values_under(v, "setups[%zu].resolved[%d].", i, k);
        want(v, "separation=%f facing_to=%f slanted_to=%f", limit, to, slanted_to);
    }
    values_under(v, "setups[%zu].assumed.", i);
    if (drawn)
        want(v, "width=%u height=%u fov=%f subpixel=%u", 1920, 1080, 60.0, 8);
    json_decref(root);
}

static void want_table(values *v, const char *line, dp_setup *setup, size_t i) {
    const double tolerance = number_behind(line, "--tolerance", 0.05);
    const method_row *method = NULL;
    double claim = NAN, range[2] = {setup->spec.znear, setup->spec.zfar}, z[DEPTHS];
    const char *name;
    char under[PATH_SIZE];
    numbers_behind(line, "--at", z, DEPTHS);
    numbers_behind(line, "--range", range, 2);
    if (strstr(line, "--model auto") != NULL) {
        dp_choice choice;
        assert_int_equal(dp_model_choose(setup, z, DEPTHS, tolerance, &choice), DP_OK);
        *setup = setup_in(setup, choice.model);
    }
    snprintf(under, sizeof under, "setups[%zu].", i);
    values_under(v, "%s", under);
    want_setup(v, setup);
    if (is_given(line, "--tolerance")) {
        const bool cut = z[0] == setup->spec.znear || z[DEPTHS - 1] == setup->spec.zfar; /* cells that a plane cuts */
        method = method_of(setup, tolerance, cut, &claim, &name);
        want(v, "method=%s claim=%f", name, claim);
    }
    for (int k = 0; k < DEPTHS; k++) {
        values_under(v, "%srows[%d].", under, k);
        want_row(v, setup, method, z[k]);
    }
    want_reach(v, line, setup, i);
    values_under(v, "%s", under);
    want_worst(v, setup, range[0], range[1]);
    values_under(v, "%s", under);
    if (isfinite(range[1]))
        want_separation(v, setup, range[0], range[1]);
    dp_pipeline p;
    values_under(v, "%s", under);
    if (setup->spec.model == DP_MODEL_FLOAT && dp_pipeline_init(&p, setup) == DP_OK) {
        float znear, zfar;
        dp_pipeline_planes(&p, &znear, &zfar);
        want(v, "near_effective=%f far_effective=%f", (double)znear, (double)zfar);
    }
    strcat(under, "auto.");
    want_choice(v, under, setup, z, DEPTHS, tolerance);
}

static void check_text(const values *v, const char *line) {
    static const char *const forms[][2] = {
        {"", "z:8, code:10, depth:7, error:5, interval:5, lattice:5, guaranteed:5"},
        {"--full", "z:8, code:10, depth:7, z_stored:9, error:5, interval:5, lattice:5, guaranteed:5, "
                   "cell_lo:9, cell_hi:9"}};
    for (size_t i = 0; i < sizeof forms / sizeof forms[0]; i++) {
        char *text = output_of(0, line, forms[i][0]);
        check_table(v, text, "setups[].rows[]", forms[i][1]);
        free(text);
    }
}

TEST(each_number) {
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) {
        values v = values_of(lines[i]);
        dp_setup setups[SETUPS_MAX];
        const size_t n = setups_of(lines[i], DP_MODEL_EXACT, setups);
        for (size_t k = 0; k < n; k++)
            want_table(&v, lines[i], &setups[k], k);
        check_forms(&v, 0, lines[i], "setups[].rows[]",
                    SETUP_CSV "?arith = ^arith, z [scene], code, depth, z_stored [scene], error [scene], "
                              "cell_lo [scene], cell_hi [scene], interval [scene], separation [scene], "
                              "guaranteed [scene], certain, ?method = ^method");
        check_text(&v, lines[i]);
        values_free(&v);
    }
}

/* The lines below a table, where they are spelt out. */
TEST(lines_below) {
    const char *exact = "table -n 2 -f 90 -F unorm16 -m reversed --ortho --range 3:80"; /* at different depths */
    const char *drawn = "table -n 0.7 -f 5000 -F unorm24 -m gl --model float -q";
    dp_setup setup[SETUPS_MAX];
    setups_of(exact, DP_MODEL_EXACT, setup);
    values v = values_of(exact);
    want_worst(&v, setup, 3, 80);
    char *text = output_of(0, exact, "");
    check_line(&v, text, "worst error", "error:6, error_z:6, error_code:6");
    check_line(&v, text, "worst interval", "interval:6, interval_lo:6, interval_hi:6, interval_code:6");
    values_free(&v);
    free(text);
    dp_pipeline pipeline;
    float znear, zfar;
    setups_of(drawn, DP_MODEL_EXACT, setup);
    assert_int_equal(dp_pipeline_init(&pipeline, setup), DP_OK);
    dp_pipeline_planes(&pipeline, &znear, &zfar);
    v = values_of(drawn);
    want(&v, "near_effective=%f far_effective=%f", (double)znear, (double)zfar);
    text = output_of(0, drawn, "");
    check_line(&v, text, "clip range", "near_effective:9, far_effective:9");
    values_free(&v);
    free(text);
}

/* "the arithmetic of the shader makes the guarantee 7.44 times the lattice at z = 1e+06": 3 digits. */
TEST(line_of_the_shader) {
    static const char *const formats[] = {"unorm24", "unorm12"};
    static const char words[] = "the arithmetic of the shader makes the guarantee ";
    const double depths[] = {2, 1e6, 3e8};
    for (int i = 0; i < 2; i++) {
        const dp_setup setup = SETUP(formats[i], .znear = 1, .zfar = 1e9, .mapping = DP_MAPPING_LOG);
        double worst = 0, z = 0, said, where;
        char end[64];
        for (int k = 0; k < 3; k++) {
            const double times = in_binary32(&setup, depths[k]) / dp_separation(&setup, depths[k]);
            z = times > worst ? depths[k] : z;
            worst = fmax(worst, times);
        }
        printed p = print_of("table --full -m log -n 1 -f 1e9 --at 2,1e6,3e8 -F %s", formats[i]);
        const char *at = strstr(p.out, words);
        const bool enough = worst <= 1.05;
        assert_non_null(at);
        assert_int_equal(enough, i == 1);
        assert_int_equal(sscanf(at + strlen(words),
                                enough ? "at most %lf %% more than the lattice at z = %lf: %63[^\n]"
                                       : "%lf times the lattice at z = %lf: %63[^\n]",
                                &said, &where, end),
                         3);
        assert_relative(said, enough ? 100 * (worst - 1) : worst, 0.005);
        assert_relative(where, z, 1e-5);
        assert_string_equal(end, enough ? "the lattice suffices" : "'depthprec budget' shows the causes");
        printed_free(&p);
    }
}

/* ---- The comparison ---------------------------------------------------------------------------------------------- */

enum { LIMITS = 3 };

/* A row: its name, its set-up, and what one of its scene units is in those of the comparison. */
typedef struct compared_row {
    const char *name, *format;
    double znear, zfar;
    dp_mapping mapping;
    double unit;
} compared_row;

/* Rounded up to two digits, and up to which depth, rounded down to three: it holds there, and no farther than it says.
 */
static void check_row(tally *t, const char *text, const compared_row *r, const double *z, size_t count,
                      const double limits[LIMITS]) {
    const dp_setup setup =
        SETUP(r->format, .znear = r->znear, .zfar = r->zfar, .mapping = r->mapping, .model = DP_MODEL_FLOAT);
    const char *at = strstr(text, r->name);
    dp_separation_worst worst;
    assert_non_null(at);
    at += strlen(r->name);
    for (size_t i = 0; i < count; i++) {
        const double shown = strtod(at, (char **)&at), truth = dp_separation(&setup, z[i] / r->unit) * r->unit;
        TALLY(t, shown >= truth * (1 - 1e-12) && shown <= truth * 1.1, "%s at %g: %g, not %g", r->name, z[i], shown,
              truth);
    }
    for (int i = 0; i < LIMITS; i++) {
        const double shown = strtod(at, (char **)&at) / r->unit, limit = limits[i] / r->unit;
        assert_int_equal(dp_separation_over(&setup, r->znear, shown, 0, &worst), DP_OK);
        TALLY(t, worst.separation <= limit * (1 + 1e-12), "%s: %g apart up to %g", r->name, limits[i], shown);
        if (shown >= r->zfar)
            continue;
        assert_int_equal(dp_separation_over(&setup, r->znear, fmin(shown * 1.011, r->zfar), 0, &worst), DP_OK);
        TALLY(t, worst.bound > limit, "%s: %g apart beyond %g, too", r->name, limits[i], shown);
    }
}

TEST(comparison) {
    static const struct {
        const char *arguments, *head;
        double z[2], limits[LIMITS];
        compared_row rows[2];
    } cases[] = {
        {"-n 0.1 -f 1000 -F fp32,d24 -m gl --at 10,500",
         "  0.001   0.01    0.1  B",
         {10, 500},
         {0.001, 0.01, 0.1},
         {{"fp32 gl", "fp32", 0.1, 1000, DP_MAPPING_GL, 1}, {"unorm24 gl", "unorm24", 0.1, 1000, DP_MAPPING_GL, 1}}},
        {"--unit cm -n 10 -f 1km -F fp32,d24 -m d3d --at 5m,700m",
         "   1 mm   1 cm  10 cm  B",
         {500, 70000},
         {0.1, 1, 10},
         {{"fp32 d3d", "fp32", 10, 1e5, DP_MAPPING_D3D, 1}, {"unorm24 d3d", "unorm24", 10, 1e5, DP_MAPPING_D3D, 1}}},
        {"--preset unity,unreal --at 100m,700m",
         "   1 mm   1 cm  10 cm  B",
         {100, 700},
         {0.001, 0.01, 0.1},
         {{"unity fp32 reversed", "fp32", 0.3, 1000, DP_MAPPING_REVERSED, 1},
          {"unreal fp32 reversed", "fp32", 10, INFINITY, DP_MAPPING_REVERSED, 0.01}}},
        {"--preset unreal,unity -n 2 -F d24 -f 30000 --at 3,3000",
         "   1 mm   1 cm  10 cm  B",
         {3, 3000},
         {0.1, 1, 10},
         {{"unity unorm24 reversed", "unorm24", 0.02, 300, DP_MAPPING_REVERSED, 100},
          {"unreal unorm24 reversed", "unorm24", 2, 30000, DP_MAPPING_REVERSED, 1}}},
    };
    tally t = {.name = "comparison"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        printed p = print_of("table %s", cases[i].arguments);
        TALLY(&t, p.status == 0 && strstr(p.out, cases[i].head) != NULL, "%s: %s", cases[i].arguments, p.errors);
        for (int k = 0; k < 2; k++)
            check_row(&t, p.out, &cases[i].rows[k], cases[i].z, 2, cases[i].limits);
        printed_free(&p);
    }
    tally_end(&t);
}

/* Each in its own unit, where the unit is not chosen. */
TEST(presets) {
    static const struct {
        const char *options, *unit;
        double znear, z, range_lo;
    } cases[] = {{"", "cm", 10, 10000, 500}, {" --unit ft", "ft", 0.1 / 0.3048, 100 / 0.3048, 5 / 0.3048}};
    for (size_t i = 0; i < 2; i++) {
        json_t *root = json_printed(0, "table --preset unity,unreal --at 100m --range 5m:50m%s", cases[i].options);
        assert_int_equal(json_array_size(node_at(root, "setups")), 2);
        assert_string_equal(text_at(root, "setups[1].preset"), "unreal");
        assert_string_equal(text_at(root, "setups[1].unit"), cases[i].unit);
        assert_relative(number_at(root, "setups[1].near"), cases[i].znear, 1e-15);
        assert_relative(number_at(root, "setups[1].rows[0].z"), cases[i].z, 1e-15);
        assert_relative(number_at(root, "setups[1].worst.lo"), cases[i].range_lo, 1e-15);
        json_decref(root);
        printed p = print_of("table --preset unity,unreal --at 100m --csv%s", cases[i].options);
        char ending[32];
        snprintf(ending, sizeof ending, ",unreal,%s\r\n", cases[i].unit);
        assert_non_null(strstr(p.out, ",preset,unit\r\n"));
        assert_string_equal(p.out + strlen(p.out) - strlen(ending), ending);
        printed_free(&p);
    }
}

LIST_TEST(check_apart)

/* A lattice has levels from some depth above 0 on, and says how far apart they are from the least such depth. */
TEST(lattice_depths) {
    static const refused_row rows[] = {
        {"--lattice kinect1 --at 0", "--at: must be above 0 with --lattice, got 0", 2},
        {"--lattice even:.1 --at 0,1", "--at: must be above 0 with --lattice, got 0", 2}};
    CHECK_REFUSED("table", rows);
    check_says(0, "step", "table --lattice even:.1 --at 1e-6,1");
}

/* The field of that name of a line of CSV, counted from 0 below the head; "" where no field has the name. */
static void csv_field(const char *csv, const char *name, int line, char out[64]) {
    const size_t length = strlen(name);
    int column = 0;
    const char *at = csv;
    out[0] = '\0';
    while (strncmp(at, name, length) != 0 || strchr(", \r", at[length]) == NULL) {
        at += strcspn(at, ",\r");
        if (*at++ == '\r')
            return;
        column++;
    }
    for (at = csv; line >= 0; line--, at++)
        assert_non_null(at = strchr(at, '\n'));
    for (; column > 0; column--)
        at += strcspn(at, ",") + 1;
    snprintf(out, 64, "%.*s", (int)strcspn(at, ",\r"), at);
}

/* A line of CSV says of which of several presets or depth ranges it is, in which unit, and of one alone nothing. */
TEST(lines_of_several) {
    static const char *const commands[] = {"table",          "table --full",     "table --at 20", "table --depth 0.05",
                                           "table --code 7", "table --constants"};
    static const struct {
        const char *options;
        int count;
    } several[] = {{"--preset unity,unreal", 2},
                   {"--preset unreal,babylon,unity --unit ft", 3},
                   {"-f 900 -F d24 -m d3d --depth-range 0:.1,.1:1", 2},
                   {"-F d16 -m gl --depth-range .1:1,0:.5,0:1", 3},
                   {"--preset unity", 1},
                   {"-F d24 -m d3d --depth-range 0:.5", 1}};
    tally t = {.name = "lines of CSV"};
    for (size_t c = 0; c < sizeof commands / sizeof commands[0]; c++)
        for (size_t s = 0; s < sizeof several / sizeof several[0]; s++) {
            const char *const line = commands[c], *const options = several[s].options;
            const bool ranges = strstr(options, "range") != NULL, more = several[s].count > 1;
            char field[64];
            if (ranges && strstr(line, "constants") != NULL)
                continue; /* refused */
            json_t *root = json_printed(0, "%s %s", line, options);
            printed p = print_of("%s %s --csv", line, options);
            int count = -1;
            for (const char *at = p.out; (at = strchr(at, '\n')) != NULL; at++)
                count++;
            assert_int_equal(json_array_size(node_at(root, "setups")), several[s].count);
            for (int k = 0; k < count; k++) {
                const json_t *setup = node_at(root, "setups[%d]", k * several[s].count / count);
                csv_field(p.out, "preset", k, field);
                TALLY(&t, strcmp(field, more && !ranges ? text_at(setup, "preset") : "") == 0, "%s %s: preset %s", line,
                      options, field);
                csv_field(p.out, "unit", k, field);
                TALLY(&t, strcmp(field, more && !ranges ? text_at(setup, "unit") : "") == 0, "%s %s: unit %s", line,
                      options, field);
                csv_field(p.out, "depth_range_lo", k, field);
                const bool part = node_at(setup, "depth_range") != NULL; /* of 0 to 1 nothing is said */
                TALLY(&t,
                      more && ranges ? atof(field) == (part ? number_at(setup, "depth_range.lo") : 0.0)
                                     : field[0] == '\0',
                      "%s %s: depth_range_lo %s", line, options, field);
                csv_field(p.out, "depth_range_hi", k, field);
                TALLY(&t,
                      more && ranges ? atof(field) == (part ? number_at(setup, "depth_range.hi") : 1.0)
                                     : field[0] == '\0',
                      "%s %s: depth_range_hi %s", line, options, field);
            }
            printed_free(&p);
            json_decref(root);
        }
    tally_end(&t);
}

/* What is said of a depth that a shader computes is said of no other. */
TEST(shaders_are_told) {
    check_says(0, "guaranteed for every log2", "table -m log -F d24 --range 1:5");
    check_says(0, "!every log2", "table -m d3d,reversed,gl,gl-reversed,linear -F d24,fp32 --range 1:5 --at 2,3");
}

/* Two ranges that share codes: each with its own ends, of which window depths from 0.5 to 0.6 are both's. */
TEST(ranges_that_share_codes) {
    json_t *root = json_printed(0, "table --depth-range 0:0.6,0.5:1 --json -F d16 --at 1 -m d3d");
    const json_t *pair = node_at(root, "shared[0]");
    assert_int_equal(json_array_size(node_at(root, "shared")), 1);
    assert_true(number_at(pair, "first.lo") == 0 && number_at(pair, "first.hi") == 0.6);
    assert_true(number_at(pair, "second.lo") == 0.5 && number_at(pair, "second.hi") == 1);
    assert_true(number_at(pair, "first.z_hi") == 1000 && number_at(pair, "second.z_lo") == 0.1);
    assert_true(number_at(pair, "code_from") == 32768 && number_at(pair, "code_to") == 39321);
    assert_true(number_at(pair, "codes") == 39321 - 32768 + 1);
    json_decref(root);
}
