/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Bits that were moved on the way into a file: each way is named, of depths on each lattice under each rounding, and
 * what can be moved back comes back as it was; of depths that were not moved nothing is said for certain.
 */
#include "support.h"
#include "texture/moved.h"

enum { W = 128, H = 96, N = W * H, BOXES = 12 };

/* ---- Depths ------------------------------------------------------------------------------------------------------ */

typedef enum lattice { NONE, INVERSE, EVEN, LATTICES } lattice;

static const char *const lattice_names[] = {"no lattice", "even in 1/z", "even in z"};
static const double first_steps[] = {0, 0.001, 0.001076};
enum { FIRSTS = sizeof first_steps / sizeof first_steps[0] };

static double level_of(lattice l, double z) {
    return l == INVERSE ? 1 / (0.00292 * rint(1 / (0.00292 * z))) : l == EVEN ? 0.0137 * rint(z / 0.0137) : z;
}

/* A room with boxes in it, whole millimetres, some without a depth. */
static void room(rng *r, lattice l, double first, double far, uint16_t *mm) {
    static double z[N];
    const double lean = rng_uniform(r, 0.5, 0.9), wave = rng_uniform(r, 0.02, 0.1);
    for (int i = 0; i < N; i++)
        z[i] = far * (1 - lean * (i / W) / H) * (1 - 0.1 * (i % W) / W) + wave * sin(0.1 * (i % W));
    for (int k = 0; k < BOXES; k++) {
        const int x0 = (int)rng_below(r, W - 24), y0 = (int)rng_below(r, H - 24);
        const double by = rng_uniform(r, 0.5, 0.95);
        for (int y = y0; y < y0 + 20; y++)
            for (int x = x0; x < x0 + 20; x++)
                z[y * W + x] *= by;
    }
    for (int i = 0; i < N; i++) {
        const double at = level_of(l, z[i] * (1 + 0.0005 * rng_uniform(r, -1, 1)));
        const double whole = rint((first > 0 ? first * rint(at / first) : at) * 1000);
        mm[i] = rng_below(r, 30) == 0 ? 0 : (uint16_t)fmin(fmax(whole, 0), UINT16_MAX);
    }
}

/* ---- What becomes of them ---------------------------------------------------------------------------------------- */

typedef struct way {
    const char *name, *found; /* found: null where nothing may be certain */
    bool whole;               /* comes back */
} way;

static const way ways[] = {
    {"as they are", NULL, false}, {"rotated", "rotated", true},       {"swapped", "swapped", true},
    {"cut at 255", "cut", false}, {"scaled to 255", "scaled", false}, {"upper byte lost", "lost", false},
};
enum { WAYS = sizeof ways / sizeof ways[0] };

static uint16_t moved_by(size_t kind, uint16_t v, uint16_t most) {
    switch (kind) {
    case 1:
        return (uint16_t)(v * 8 + v / 8192); /* r = v << 3 | v >> 13 */
    case 2:
        return (uint16_t)(v % 256 * 256 + v / 256);
    case 3:
        return v < 255 ? v : 255;
    case 4:
        return (uint16_t)rint(255.0 * v / most);
    case 5:
        return v % 256;
    default:
        return v;
    }
}

static image image_of(const uint16_t *mm) {
    image img = {.width = W, .height = H, .channels = 1, .type = IMAGE_U16, .data = malloc(N * sizeof *mm)};
    memcpy(img.data, mm, N * sizeof *mm);
    return img;
}

static void one(tally *t, rng *r, size_t kind, lattice l, double first, int *named) {
    static uint16_t mm[N], samples[N];
    uint16_t most = 0;
    const double far = kind == 3 ? rng_uniform(r, 0.4, 1) : rng_uniform(r, 4, 14);
    room(r, l, first, far, mm);
    for (int i = 0; i < N; i++)
        most = mm[i] > most ? mm[i] : most;
    for (int i = 0; i < N; i++)
        samples[i] = moved_by(kind, mm[i], most);
    image img = image_of(samples);
    const moved m = moved_find(&img);
    const char *name = m.row != NULL ? m.row->name : "nothing";
    const bool certain = m.row != NULL && m.certain;
    /* Without a depth beyond 8.191 m rotated samples are multiples of eight, and may be just that. */
    const bool right = ways[kind].found != NULL && strcmp(name, ways[kind].found) == 0;
    *named += right;
    TALLY(t, ways[kind].found == NULL || kind == 5 ? right || !certain : right && (certain || kind != 2),
          "%s, of %s, first rounded to %g, up to %u: found %s", ways[kind].name, lattice_names[l], first, most, name);
    if (ways[kind].whole && m.row != NULL)
        TALLY(t, moved_undo(m.row, &img) && memcmp(img.data, mm, sizeof mm) == 0, "%s: not as before", ways[kind].name);
    image_free(&img);
}

TEST(moved_bits_are_named_and_moved_back) {
    const uint64_t rounds = test_cases(2, 10, 400);
    tally t = {.name = "moved"};
    int lost = 0;
    rng r = rng_make("moved");
    for (size_t kind = 0; kind < WAYS; kind++)
        for (lattice l = NONE; l < LATTICES; l++)
            for (size_t k = 0; k < FIRSTS; k++) {
                int named = 0;
                for (uint64_t i = 0; i < rounds; i++)
                    one(&t, &r, kind, l, first_steps[k], &named);
                print_message("# %s, of %s, first %g: %d of %d images named\n", ways[kind].name, lattice_names[l],
                              first_steps[k], named, (int)rounds);
                lost += kind == 5 && l != INVERSE ? named : 0;
            }
    tally_end(&t);
    assert_true(lost * 2 > 2 * (int)(FIRSTS * rounds)); /* by slopes: not of levels that are far apart */
}

/* Metres of 32 bits, as halves: in columns, one below the other, or in two channels, the lower first or the upper. */
TEST(halves_of_numbers_are_joined) {
    static uint16_t mm[N], samples[2 * N];
    rng r = rng_make("halves");
    for (int place = 0; place < 3; place++)
        for (int upper = 0; upper < 2; upper++) {
            uint32_t bits[N];
            room(&r, NONE, 0, 6, mm);
            for (int i = 0; i < N; i++) {
                const float z = (float)(mm[i] * 0.001 * 1.0000123);
                memcpy(&bits[i], &z, sizeof z);
                const uint16_t low = bits[i] & 0xFFFF, high = (uint16_t)(bits[i] >> 16);
                const int first = place == 1 ? i : 2 * i, second = place == 1 ? i + N : 2 * i + 1;
                samples[first] = upper == 1 ? high : low;
                samples[second] = upper == 1 ? low : high;
            }
            image img = {.width = place == 0 ? 2 * W : W, .height = place == 1 ? 2 * H : H, .type = IMAGE_U16};
            img.channels = place == 2 ? 2 : 1;
            img.data = malloc(sizeof samples);
            memcpy(img.data, samples, sizeof samples);
            const moved m = moved_find(&img);
            assert_true(m.row != NULL && m.certain);
            assert_string_equal(m.row->name, "halves");
            assert_true(moved_undo(m.row, &img));
            assert_true(img.width == W && img.height == H && img.channels == 1 && img.type == IMAGE_F32);
            assert_memory_equal(img.data, bits, sizeof bits);
            image_free(&img);
        }
}

/* Nothing is certain of noise, of few values and of what is no depth. */
TEST(nothing_is_certain_where_nothing_was_moved) {
    const uint64_t rounds = test_cases(8, 60, 3000);
    static uint16_t samples[N];
    tally t = {.name = "not moved"};
    rng r = rng_make("not moved");
    for (uint64_t i = 0; i < rounds; i++) {
        uint16_t few[64];
        const size_t count = 2 + rng_below(&r, 62), step = 1 + rng_below(&r, 600);
        for (size_t k = 0; k < count; k++)
            few[k] = (uint16_t)rng_below(&r, 65536);
        for (int k = 0; k < N; k++)
            samples[k] = i % 4 == 0   ? (uint16_t)rng_below(&r, 65536)
                         : i % 4 == 1 ? few[rng_below(&r, count)]
                         : i % 4 == 2 ? (uint16_t)(step * ((uint64_t)(k % W + k / W) % (65535 / step)))
                                      : few[(size_t)(k % W) * count / W];
        image img = image_of(samples);
        const moved m = moved_find(&img);
        TALLY(&t, m.row == NULL || !m.certain, "kind %d, %d values, step %d: found %s", (int)(i % 4), (int)count,
              (int)step, m.row->name);
        image_free(&img);
    }
    tally_end(&t);
}
