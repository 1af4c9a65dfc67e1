/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/moved.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/bits.h"
#include "core/recognise_lattice.h"
#include "texture/image_depths.h"
#include "texture/stereo.h"

enum {
    VALUES = 1 << 16,
    HOLE = 65535,
    BYTE = 255,
    VOTES = 20,     /* values that speak for it, */
    AGAINST = 7,    /* and for each one against it so many more: below one in a million by chance */
    DIFFERENT = 24, /* values that have a divisor by more than chance */
    ONES = 12,      /* values of two remainders of seven */
    BEND = 64       /* of a slope, in a byte, that is no wrap */
};

/* From the data set's own toolbox, depth_rel2depth_abs: focal length times baseline, pixels and metres, and the
 * disparity of 0, whose part of a step is where the levels begin. */
#define NYU_CONSTANT 351.3
#define NYU_FROM     1092.5
#define NYU_PART     0.5
#define TEXT_OF(x)   #x
#define TEXT(x)      TEXT_OF(x)

enum { ROTATED, SWAPPED, HALVES, CUT, SCALED, LOST, NYU };

static const moved_row rows[] = {
    [ROTATED] = {"rotated", "their bits were rotated up by three, as those of SUN3D and SUN RGB-D",
                 "UNIT,rotated, or sun3d,", NULL, 3},
    [SWAPPED] = {"swapped", "their two bytes were swapped, as those of NYU's raw PGM", "UNIT,swapped, or nyu-raw,",
                 NULL, 8},
    [HALVES] = {"halves", "they are the halves of numbers of 32 bits", "UNIT,halves", NULL, 0},
    [CUT] = {"cut", "they end at 255, which many have: what was larger was cut off on the way", NULL, NULL, 0},
    [SCALED] = {"scaled", "they fill 8 bits up to 255: they were scaled to that on the way, and have no unit left",
                NULL, NULL, 0},
    [LOST] = {"lost", "they wrap round at 256: their upper byte was lost on the way", NULL, NULL, 0},
    [NYU] = {"disparity", "their two bytes were swapped, and they are raw disparities of a Kinect", "nyu-raw",
             "inverse:" TEXT(NYU_CONSTANT) "," TEXT(NYU_PART), 8},
};

const moved_row *moved_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

/* Samples are whole numbers of one or two bytes: moved_find() looks at no others. */
static uint32_t sample_at(const image *img, size_t i) {
    const size_t at = i * img->channels;
    return img->type == IMAGE_U16 ? ((const uint16_t *)img->data)[at] : ((const uint8_t *)img->data)[at];
}

static uint32_t apart(uint32_t a, uint32_t b) {
    return a > b ? a - b : b - a;
}

static uint32_t back(uint32_t x, int bits) {
    return (x >> bits | x << (16 - bits)) & (VALUES - 1);
}

/* ---- Neighbours -------------------------------------------------------------------------------------------------- */

static bool is_sample(uint32_t x) {
    return x != 0 && x != HOLE;
}

/* The vote of two neighbours, above 0 for moved bits: where those from above differ, they are near each other once
 * these are above again. */
static int is_rotated(uint32_t a, uint32_t b, int bits) {
    if (!is_sample(a) || !is_sample(b) || ((a ^ b) & ((1U << bits) - 1)) == 0)
        return 0;
    return apart(back(a, bits), back(b, bits)) < apart(a, b) ? 1 : -1;
}

/* A sample and its neighbours, all of them in rows, then all in columns. */
typedef struct three {
    const image *img;
    size_t at, column; /* of the first */
    bool down;
    uint32_t x[3];
} three;

static bool three_next(three *t) {
    const size_t width = t->img->width, height = t->img->height;
    if (!t->down && t->column + 2 >= width) {
        t->at += width - t->column;
        t->column = 0;
    }
    if (!t->down && (width < 3 || t->at >= width * height)) {
        t->down = true;
        t->at = 0;
    }
    if (t->down && t->at + 2 * width >= width * height)
        return false;
    for (size_t i = 0; i < 3; i++)
        t->x[i] = sample_at(t->img, t->at + (t->down ? i * width : i));
    t->at++;
    t->column++;
    return true;
}

/* The votes of a row's pairs, and of the pairs with the row above, for the sample between two of them; `above` has what
 * the pairs before voted. */
static void vote_in_row(const image *img, int bits, size_t y, signed char *above, int32_t *votes) {
    const size_t width = img->width, first = y * width;
    int left = 0;
    for (size_t x = 0; x < width; x++) {
        const uint32_t here = sample_at(img, first + x);
        if (x > 0) {
            const uint32_t before = sample_at(img, first + x - 1);
            const int vote = is_rotated(before, here, bits);
            votes[before] += x > 1 ? left + vote : 0;
            left = vote;
        }
        if (y > 0) {
            const uint32_t before = sample_at(img, first + x - width);
            const int vote = is_rotated(before, here, bits);
            votes[before] += y > 1 ? above[x] + vote : 0;
            above[x] = (signed char)vote;
        }
    }
}

/* Each value has one vote, whatever how many pixels have it. */
static bool is_told(const image *img, int bits) {
    int32_t *votes = calloc(VALUES, sizeof *votes);
    signed char *above = calloc(img->width, sizeof *above);
    long balance = 0;
    for (size_t y = 0; y < img->height && votes != NULL && above != NULL; y++)
        vote_in_row(img, bits, y, above, votes);
    for (size_t v = 0; v < VALUES && votes != NULL; v++)
        balance += votes[v] > 0 ? 1 : votes[v] < 0 ? -AGAINST : 0;
    free(votes);
    free(above);
    return balance >= VOTES;
}

/* Slopes of bytes go on as they were or a whole wrap beside that, at many values, and seldom anywhere in between. */
static bool is_wrapped(const image *img) {
    bool seen[BYTE + 1] = {false};
    size_t wraps = 0, bends = 0, values = 0;
    for (three t = {.img = img}; three_next(&t);) {
        const uint32_t *const x = t.x;
        if (x[0] == 0 || x[1] == 0 || x[2] == 0 || x[0] >= BYTE || x[1] >= BYTE || x[2] >= BYTE)
            continue;
        const uint32_t bend = apart(x[0] + x[2], 2 * x[1]);
        const bool wrap = apart(bend, BYTE + 1) <= BEND / 2;
        wraps += wrap;
        bends += bend > BEND && bend < BYTE - BEND;
        values += wrap && !seen[x[1]];
        seen[x[1]] = seen[x[1]] || wrap;
    }
    return values >= BEND && wraps >= 2 * bends;
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

typedef struct values {
    uint32_t most, divisor;
    size_t different, depths, at_most;
    size_t eighths, ones, others; /* multiples of eight, whose divisor this is; values of one or two more, others */
} values;

static bool count_values(const image *img, values *v) {
    bool *seen = calloc(VALUES, sizeof *seen);
    *v = (values){.most = 0};
    for (size_t i = 0; i < (size_t)img->width * img->height && seen != NULL; i++) {
        const uint32_t x = sample_at(img, i);
        if (x == 0)
            continue;
        v->depths++;
        v->at_most = x > v->most ? 1 : v->at_most + (x == v->most);
        v->most = x > v->most ? x : v->most;
        v->eighths += x % 8 == 0;
        v->divisor = x % 8 == 0 ? (uint32_t)dp_common_divisor(v->divisor, x) : v->divisor;
        v->ones += !seen[x] && (x % 8 == 1 || x % 8 == 2);
        v->others += !seen[x] && x % 8 > 2;
        v->different += !seen[x];
        seen[x] = true;
    }
    free(seen);
    return seen != NULL;
}

/* ---- Halves of numbers ------------------------------------------------------------------------------------------- */

/* Where the lower and the upper half of a number are: in columns or channels beside each other, or in planes one below
 * the other; the lower first, or the upper. */
enum { BESIDE, BELOW, CHANNELS, PLACES };

typedef struct layout {
    int place;
    bool upper_first;
} layout;

static uint32_t number_at(const image *img, const layout *l, size_t i) {
    const uint16_t *const data = img->data;
    const size_t all = (size_t)img->width * img->height, channels = img->channels;
    const size_t first = l->place == BESIDE ? 2 * i * channels : i * channels;
    const size_t other = l->place == BESIDE  ? first + channels
                         : l->place == BELOW ? (i + all / 2) * channels
                                             : first + 1;
    return l->upper_first ? (uint32_t)data[first] << 16 | data[other] : (uint32_t)data[other] << 16 | data[first];
}

static bool has_layout(const image *img, const layout *l) {
    return img->type == IMAGE_U16 && (l->place == CHANNELS ? img->channels == 2
                                      : l->place == BESIDE ? img->channels == 1 && img->width % 2 == 0
                                                           : img->channels == 1 && img->height % 2 == 0);
}

/* Depths in some unit, next to each other nearly alike, whose halves are not. @return the share of them */
static double share_of(const image *img, const layout *l) {
    const size_t count = (size_t)img->width * img->height / (l->place == CHANNELS ? 1 : 2);
    double good = 0, all = 0, last = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t bits = number_at(img, l, i);
        const double x = (double)dp_float32(bits);
        if (bits == 0)
            continue;
        all++;
        good += x >= 1e-3 && x <= 1e5 && fabs(x - last) < 0.125 * x && apart(bits >> 16, bits & 0xFFFF) > 256;
        last = x;
        if (2 * (all - good) > (double)count)
            return 0; /* it cannot be most of them any more */
    }
    return all > DIFFERENT ? good / all : 0;
}

static double best_layout(const image *img, layout *out) {
    double most = 0;
    for (int k = 0; k < 2 * PLACES; k++) {
        const layout l = {k / 2, k % 2 == 1};
        const double share = has_layout(img, &l) ? share_of(img, &l) : 0;
        if (share > most) {
            most = share;
            *out = l;
        }
    }
    return most;
}

static bool join(image *img) {
    layout l;
    if (!(best_layout(img, &l) > 0.5))
        return false;
    img->width /= l.place == BESIDE ? 2 : 1;
    const uint32_t height = img->height / (l.place == BELOW ? 2 : 1);
    uint32_t *joined = malloc((size_t)img->width * height * sizeof *joined);
    image before = *img;
    before.width *= l.place == BESIDE ? 2 : 1;
    for (size_t i = 0; i < (size_t)img->width * height && joined != NULL; i++)
        joined[i] = number_at(&before, &l, i);
    if (joined == NULL)
        return false;
    free(img->data);
    img->data = joined;
    img->height = height;
    img->channels = 1;
    img->type = IMAGE_F32;
    return true;
}

/* ---- Together ---------------------------------------------------------------------------------------------------- */

/* Finds what was lost in 16 bits whose values fit in 8, and in bytes. */
static moved find_bytes(const image *img, const values *v) {
    enum { MOST_USED = 224, MANY = 8 };
    if (v->different >= MOST_USED && is_wrapped(img))
        return (moved){&rows[LOST], true};
    if (v->most != BYTE)
        return (moved){.row = NULL};
    const bool cut = v->at_most * MANY >= v->depths;
    return (moved){&rows[cut ? CUT : SCALED], cut && img->type == IMAGE_U16};
}

moved moved_find(const image *img) {
    values v;
    layout l;
    if (img->type > IMAGE_U16 || !count_values(img, &v) || v.depths == 0)
        return (moved){.row = NULL};
    if (img->type == IMAGE_U8 || v.most <= BYTE)
        return find_bytes(img, &v);
    if (v.different >= DIFFERENT && best_layout(img, &l) >= 0.75)
        return (moved){&rows[HALVES], true};
    for (const moved_row *row = rows; row <= rows + SWAPPED; row++)
        if (is_told(img, row->bits))
            return (moved){row, true};
    /* Multiples of eight, but for depths that did not fit, or whose bits are the lowest. */
    const bool low = v.others == 0 && v.eighths >= v.depths / 2;
    if (v.divisor == 8 && v.different >= DIFFERENT && (low || v.eighths >= v.depths - v.depths / 8))
        return (moved){&rows[ROTATED], low && v.ones >= ONES};
    return (moved){.row = NULL};
}

static bool to_metres(image *img) {
    static const stereo_spec nyu = {.focal = NYU_CONSTANT, .baseline = 1, .offset = NYU_FROM, .step = -1};
    const size_t count = (size_t)img->width * img->height;
    float *metres = malloc(count * sizeof *metres);
    for (size_t i = 0; i < count && metres != NULL; i++) {
        const double z = stereo_depth(&nyu, image_sample(img, i));
        metres[i] = image_sample(img, i) > 0 && z > 0 ? (float)z : 0.0F;
    }
    if (metres == NULL)
        return false;
    free(img->data);
    img->data = metres;
    img->type = IMAGE_F32;
    img->channels = 1;
    return true;
}

bool moved_undo(const moved_row *row, image *img) {
    uint16_t *const data = img->data;
    if (row == &rows[HALVES])
        return join(img);
    if (row->bits == 0 || img->type != IMAGE_U16)
        return false;
    for (size_t i = 0; i < (size_t)img->width * img->height * img->channels; i++)
        data[i] = (uint16_t)back(data[i], row->bits);
    return row->lattice == NULL || to_metres(img);
}
