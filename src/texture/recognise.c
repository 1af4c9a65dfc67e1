/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "texture/recognise.h"

#include <stdlib.h>

#include "core/append.h"
#include "texture/image_depths.h"
#include "texture/units.h"

/* Numbers outside [0, 1] are described; of integers only their count is said. */
static void say_outside(const image *img, const dp_recognised *r, char *why) {
    char units[UNITS_TEXT_SIZE];
    append(why, RECOGNISE_WHY_SIZE, "no window depth: %zu of %zu samples are not in [0, 1]", r->invalid, r->samples);
    if (img->type >= IMAGE_F16)
        append(why, RECOGNISE_WHY_SIZE, ", finite ones go from %.6g to %.6g%s%s", r->least, r->greatest,
               r->metric                                            ? ": metric depth? "
               : r->least < 0 && r->least >= -1 && r->greatest <= 1 ? ": OpenGL's NDC?"
                                                                    : "",
               r->metric ? units_say(img, units) : "");
}

static void say_lattice(const dp_recognised *r, char *why) {
    const char *more = r->distinct >= DP_RECOGNISE_DISTINCT ? "more than " : "";
    append(why, RECOGNISE_WHY_SIZE, "%s%zu different numbers lie on the lattice of %s", more, r->distinct,
           r->format.name);
    if (!r->proved && 2 * r->expected >= (double)r->distinct)
        append(why, RECOGNISE_WHY_SIZE, ": inconclusive, random values would fit as well");
    else
        append(why, RECOGNISE_WHY_SIZE, ", of random ones %.3g would%s", r->expected,
               r->proved ? "" : ": too few to tell");
}

static void say_off(const dp_recognised *r, char *why) {
    append(why, RECOGNISE_WHY_SIZE,
           "%s%zu of %zu samples are off the lattice of %s, which fits best of the coarser ones",
           r->reason == DP_REASON_DOUBLES ? "finer than fp32: " : "", r->off, r->samples, r->closest);
}

/* Where there is something behind it, the largest sample stands between. */
static const struct sentence {
    const char *first, *rest;
} sentences[DP_REASON_COUNT] = {
    [DP_REASON_EMPTY] = {"no window depth: no sample is finite", NULL},
    [DP_REASON_STENCIL_LOW] =
        {"all low bytes are equal: if they are stencil below 24 bits of depth, shift right by 8 first", NULL},
    [DP_REASON_STENCIL_HIGH] =
        {"all high bytes are equal: if they are stencil above 24 bits of depth, take & 0xFFFFFF first", NULL},
    [DP_REASON_LARGE] = {"whole numbers up to ", " are codes of no named format: bits of fp32 end at 1065353216"},
    [DP_REASON_BYTES] = {"shares of 255, fewer than any depth format has", NULL},
    [DP_REASON_WIDENED] = {"16 bits that repeat 8, fewer than any depth format has", NULL},
    [DP_REASON_WORDS] = {"codes of unorm16 up to ",
                         ", fp16 has none above 15360; a finer buffer has lost all but 16 bits"},
    [DP_REASON_WORDS_LOW] = {"codes up to ", ""},
    [DP_REASON_LONGS_16] = {"codes up to ", ", of unorm16"},
    [DP_REASON_LONGS_24] = {"codes of unorm24 up to ", ""},
    [DP_REASON_LONGS_32] = {"bits of fp32, none above those of 1", NULL},
    [DP_REASON_HALVES] = {"numbers of fp16, or rounded to it", NULL},
};

static void say(const image *img, const dp_recognised *r, char *why) {
    const struct sentence *s = &sentences[r->reason];
    append(why, RECOGNISE_WHY_SIZE, "%s", s->first != NULL ? s->first : "");
    if (s->rest != NULL)
        append(why, RECOGNISE_WHY_SIZE, "%.0f%s", r->greatest, s->rest);
    if (r->reason == DP_REASON_OUTSIDE)
        say_outside(img, r, why);
    else if (r->reason == DP_REASON_GIVEN)
        append(why, RECOGNISE_WHY_SIZE, "%s, as the %s names it", r->format.name, image_file_name(img->file));
    else if (r->reason == DP_REASON_BYTES && img->channels > 1)
        append(why, RECOGNISE_WHY_SIZE, " (depth packed into channels: --packing unpacks it)");
    else if (r->reason == DP_REASON_WORDS_LOW)
        append(why, RECOGNISE_WHY_SIZE, "%s, of unorm16 or of fp16",
               r->greatest == 15360 ? ", which is 1 in fp16" : "");
    else if (r->reason == DP_REASON_LONGS_16 && r->greatest < 65535)
        append(why, RECOGNISE_WHY_SIZE, " or of unorm24");
    else if (r->reason == DP_REASON_LATTICE)
        say_lattice(r, why);
    else if (r->reason >= DP_REASON_SINGLES)
        say_off(r, why);
}

const char *recognise_towards(const dp_recognised *r) {
    /* By [mass + 1][sky + 1], where both do not agree. */
    static const char *const words[3][3] = {
        {"neither sky nor mass shows a direction", "sky at 1: likely not reversed", "sky at 0: likely reversed"},
        {"most are above 3/4: likely not reversed", "most are above 3/4, sky at 1: likely not reversed",
         "near 1 but sky at 0: no direction"},
        {"most are below 1/4: likely reversed", "near 0 but sky at 1: no direction",
         "most are below 1/4, sky at 0: likely reversed"}};
    if (!r->depth)
        return NULL;
    if (r->at_zero + r->at_one + r->invalid == r->samples)
        return "nothing drawn shows a direction";
    if (r->direction)
        return r->reversed ? "most are below 1/4, sky at 0: reversed" : "most are above 3/4, sky at 1: not reversed";
    return words[r->mass + 1][r->sky + 1];
}

void recognise(const image *img, dp_recognised *out, char why[RECOGNISE_WHY_SIZE]) {
    const dp_image channel = image_channel(img);
    uint64_t *slots = malloc(DP_RECOGNISE_SLOTS * sizeof *slots); /* without memory nothing is counted */
    dp_format known[2];
    if (img->says != NULL)
        dp_format_parse(img->says, known);
    dp_recognise(&channel, img->says != NULL ? known : NULL, slots, out);
    free(slots);
    why[0] = '\0';
    say(img, out, why);
    if (out->steps > 0 && img->type != IMAGE_U8)
        append(why, RECOGNISE_WHY_SIZE, "; all are multiples of 1/%.9g%s", out->steps,
               out->steps_certain ? "" : ", inconclusive");
    if (out->depth)
        append(why, RECOGNISE_WHY_SIZE, "; %s", recognise_towards(out));
}
