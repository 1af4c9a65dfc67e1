/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The door for a depth image that a person drops on the page: what is recognised in it. image.js reads the file. */
#include <stdio.h>
#include <stdlib.h>

#include "texture/recognise.h"
#include "web/page.h"

static image dropped;

const char *image_file_name(image_file file) {
    (void)file;
    return "file";
}

/** Room for so many bytes of samples; null when out of memory. */
PAGE_EXPORT("image_room") void *image_room(size_t size) {
    return dropped.data = malloc(size + 1);
}

/* The sample of a window depth of 1: the largest code, 1 of numbers, and 0 where samples are bits of fp32. */
static double top_of(const dp_recognised *found) {
    const bool bits = found->format.kind == DP_FORMAT_FLOAT;
    return dropped.type >= IMAGE_F16 ? 1 : dropped.type == IMAGE_U8 ? 255 : bits ? 0 : (double)found->format.code_max;
}

/* Whether samples are the format's codes, or its numbers: a quotient by the largest code is off by some of its units.
 */
static bool are_codes(const dp_recognised *found) {
    const bool coarse = found->steps > 0 && found->steps < (double)found->format.code_max;
    return !coarse && (dropped.type < IMAGE_F16 || found->format.kind == DP_FORMAT_FLOAT);
}

/** Writes whether the samples can be window depth, what stands for 1, the format, whether it is reversed (-1: nothing
 * shows it), whether they are its codes, and a line about how that was told. */
PAGE_EXPORT("image") void image_said(int type, unsigned width, unsigned height, unsigned channels) {
    dp_recognised found;
    char why[RECOGNISE_WHY_SIZE];
    dropped = (image){width, height, channels, (image_type)type, .data = dropped.data};
    recognise(&dropped, &found, why);
    printf("%d %.17g %s %d %d\n%s\n", found.depth, top_of(&found), found.format.name, found.reversed, are_codes(&found),
           why);
    fflush(NULL);
}
