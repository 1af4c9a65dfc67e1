/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Real rasterizers: every stored code and every clip decision, from the row of arithmetic that claims to be theirs. */
#include "depthprec/depthprec.h"
#include "support.h"

enum { COLUMNS = 8, FIRST_COLUMN = 6, POINTS = 128 };

/* One target at a time: its set-up, a pipeline per column, and what has been seen. */
typedef struct target {
    dp_setup setup;
    dp_pipeline pipeline[COLUMNS];
    dp_pipeline strange[4]; /* rows that are not these rasterizers' */
    char name[COLUMNS][32];
    int columns;
    tally codes, clips, ideal, order, range;
    double widest;        /* range of codes, in steps of 2^-24 of d or in codes, whichever is coarser */
    double reach[POINTS]; /* of each point, nearest first: behind it everything is stored behind it */
    float z[POINTS];
    int64_t key[COLUMNS][POINTS]; /* grows with distance; -1 where clipped */
    int points;
    unsigned long drawn, clipped, strange_codes[4];
    unsigned targets;
} target;

static const char *const strangers[4] = {"ieee", "fused", "reciprocal", "product"};

static const char *arith_of(const char *column) {
    if (strstr(column, "softpipe") != NULL)
        return "softpipe";
    return strstr(column, "_rmp") != NULL ? "mesa-remap" : "mesa";
}

static dp_pipeline pipeline_of(dp_spec spec, const char *arith) {
    dp_setup setup;
    dp_pipeline pipeline;
    assert_int_equal(dp_arith_parse(arith, &spec.arith), DP_OK);
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_pipeline_init(&pipeline, &setup), DP_OK);
    return pipeline;
}

static void begin_target(target *t, const vector_row *row) {
    dp_spec spec = dp_spec_default();
    dp_format format[2];
    spec.znear = vector_number(row, 1);
    spec.zfar = vector_number(row, 2);
    spec.ortho = strcmp(vector_text(row, 3), "orthographic") == 0;
    assert_int_equal(dp_mapping_parse(vector_text(row, 4), &spec.mapping), DP_OK);
    assert_int_equal(dp_format_parse(vector_text(row, 5), format), 1);
    spec.format = format[0];
    assert_int_equal(dp_setup_init(&t->setup, &spec), DP_OK);
    t->columns = row->count - FIRST_COLUMN;
    assert_in_range(t->columns, 1, COLUMNS);
    for (int i = 0; i < t->columns; i++) {
        snprintf(t->name[i], sizeof t->name[i], "%s", vector_text(row, FIRST_COLUMN + i));
        t->pipeline[i] = pipeline_of(spec, arith_of(t->name[i]));
    }
    for (int i = 0; i < 4; i++)
        t->strange[i] = pipeline_of(spec, strangers[i]);
    t->targets++;
    t->points = 0;
}

/* The guaranteed separation of any arithmetic at all: the greatest. */
static double resolved_up_to(const target *t, float z) {
    dp_spec spec = t->setup.spec;
    double greatest = 0.0;
    spec.model = DP_MODEL_FLOAT;
    for (spec.arith = 0; spec.arith < dp_arith_count(); spec.arith++) {
        dp_setup setup;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        greatest = fmax(greatest, dp_separation(&setup, (double)z));
    }
    return (double)z + greatest;
}

/* The codes that the error bound allows at z, whatever the arithmetic. */
static void range_of(target *t, float z, uint32_t *lowest, uint32_t *highest) {
    dp_spec spec = t->setup.spec;
    *lowest = UINT32_MAX;
    *highest = 0;
    for (spec.arith = 0; spec.arith < dp_arith_count(); spec.arith++) {
        dp_setup setup;
        uint32_t low, high;
        assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        assert_int_equal(dp_code_range(&setup, (double)z, &low, &high), DP_OK);
        *lowest = low < *lowest ? low : *lowest;
        *highest = high > *highest ? high : *highest;
    }
    const dp_format *format = &spec.format;
    const double width = dp_format_value(format, *highest) - dp_format_value(format, *lowest);
    const double step = format->kind == DP_FORMAT_UNORM ? 1.0 / (double)format->code_max : 0x1p-24;
    t->widest = fmax(t->widest, width / step);
}

/* Every point behind the reach of an earlier one must be stored behind it. The points of a target come in order. */
static void judge_order(target *t, const vector_row *row) {
    const int n = t->points;
    for (int i = 0; i < t->columns; i++)
        for (int k = 0; k < n && t->key[i][n] >= 0; k++)
            if (t->key[i][k] >= 0 && (double)t->z[n] >= t->reach[k])
                TALLY(&t->order, t->key[i][n] > t->key[i][k], "line %d, %s: z %.9g is not behind %.9g", row->line,
                      t->name[i], (double)t->z[n], (double)t->z[k]);
}

/*
 * The most that the arithmetic may do to a code, as measured over the whole data: one code of 16 bits, three of 24 (a
 * truncated product loses another), 4 x 2^-24 of the window depth.
 */
static int near_ideal(const target *t, float z, uint32_t code, int truncated) {
    const uint32_t ideal = dp_code(&t->setup, (double)z);
    const dp_format *format = &t->setup.spec.format;
    if (format->kind == DP_FORMAT_FLOAT)
        return fabs(dp_format_value(format, code) - dp_format_value(format, ideal)) <= 4.0 * 0x1p-24;
    const int64_t off = (int64_t)code - (int64_t)ideal;
    return llabs(off) <= (format->bits == 16 ? 1 : 3) + truncated;
}

static void visit(const vector_row *row, void *context) {
    target *t = context;
    if (strcmp(vector_text(row, 0), "camera") == 0) {
        begin_target(t, row);
        return;
    }
    const uint32_t bits = (uint32_t)strtoul(vector_text(row, 0), NULL, 16);
    float z;
    memcpy(&z, &bits, sizeof z);
    const char *text = vector_text(row, 1);
    const int n = t->points;
    assert_in_range(n, 0, POINTS - 1);
    assert_true(n == 0 || z > t->z[n - 1]);
    t->z[n] = z;
    /* The guarantee is about [near, far]; rounding draws some points just outside it. */
    const int inside = (double)z >= t->setup.spec.znear && (double)z <= t->setup.spec.zfar;
    t->reach[n] = inside ? resolved_up_to(t, z) : HUGE_VAL;
    uint32_t lowest = 0;
    uint32_t highest = 0;
    if (inside)
        range_of(t, z, &lowest, &highest);
    for (int i = 0; i < t->columns; i++) {
        if (row->count > 2 && strcmp(vector_text(row, 1 + i), "=") != 0)
            text = vector_text(row, 1 + i);
        const dp_pipeline *p = &t->pipeline[i];
        const int stored = *text != '-';
        TALLY(&t->clips, dp_pipeline_drawn(p, z) == stored, "line %d, %s: z %.9g", row->line, t->name[i], (double)z);
        t->drawn += stored != 0;
        t->clipped += stored == 0;
        t->key[i][n] = -1;
        if (!stored)
            continue;
        const uint32_t code = (uint32_t)strtoul(text, NULL, 16);
        const uint32_t got = dp_pipeline_code(p, z);
        t->key[i][n] = t->setup.reversed ? (int64_t)t->setup.spec.format.code_max - (int64_t)code : (int64_t)code;
        TALLY(&t->codes, got == code, "line %d, %s: z %.9g stored %x, computed %x", row->line, t->name[i], (double)z,
              (unsigned)code, (unsigned)got);
        if (inside)
            TALLY(&t->range, code >= lowest && code <= highest, "line %d, %s: z %.9g stored %x, allowed %x..%x",
                  row->line, t->name[i], (double)z, (unsigned)code, (unsigned)lowest, (unsigned)highest);
        TALLY(&t->ideal, near_ideal(t, z, code, p->arith->conversion == DP_CONVERT_PRODUCT_ZERO),
              "line %d, %s: z %.9g stored %x, ideal %x", row->line, t->name[i], (double)z, (unsigned)code,
              (unsigned)dp_code(&t->setup, (double)z));
        for (int k = 0; k < 4; k++)
            t->strange_codes[k] += dp_pipeline_code(&t->strange[k], z) != code;
    }
    if (inside)
        judge_order(t, row);
    t->points++;
}

static target *seen(void) {
    static target t = {.codes = {.name = "stored codes"},
                       .clips = {.name = "clip decisions"},
                       .ideal = {.name = "against the ideal"},
                       .order = {.name = "guaranteed order"},
                       .range = {.name = "guaranteed range"}};
    if (t.targets == 0)
        vectors_read("rasterizers.txt", visit, &t);
    return &t;
}

TEST(every_code) {
    const target *t = seen();
    printf("# %u targets, %lu codes, %lu clipped\n", t->targets, t->drawn, t->clipped);
    assert_int_equal(t->targets, 117);
    tally_end(&t->codes);
}

TEST(every_clip_decision) {
    const target *t = seen();
    assert_true(t->clipped > 500);
    tally_end(&t->clips);
}

TEST(close_to_ideal) {
    tally_end(&seen()->ideal);
}

TEST(guaranteed_order) {
    const target *t = seen();
    printf("# %llu pairs of points beyond the guaranteed separation\n", (unsigned long long)t->order.cases);
    tally_end(&t->order);
}

/* The bound holds whatever the row, and is not wide: a few steps of binary32 below 1, or of the format. */
TEST(guaranteed_range) {
    const target *t = seen();
    printf("# allowed codes span at most %.2f steps of 2^-24, or of the format\n", t->widest);
    tally_end(&t->range);
    assert_true(t->widest < 16.0);
}

/* The points tell the kinds of arithmetic apart: each other row misses codes. */
TEST(rows_differ) {
    const target *t = seen();
    for (int i = 0; i < 4; i++) {
        printf("# %s would miss %lu\n", strangers[i], t->strange_codes[i]);
        assert_true(t->strange_codes[i] > 1000);
    }
}
