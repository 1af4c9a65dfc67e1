/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Which of several channels is depth, the same for every kind of file. A depth that programs write as grey has the same
 * in red, green and blue; a photograph, a map of places or of normals has not.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "image/image.h"
#include "image/kind.h"

static bool fail(image_error *error, const char *format, ...) __attribute__((format(printf, 2, 3)));

static bool fail(image_error *error, const char *format, ...) {
    va_list list;
    error->unreadable = 0;
    va_start(list, format);
    vsnprintf(error->text, sizeof error->text, format, list);
    va_end(list);
    return false;
}

/* Channels without names go by their order; of a PNG, two are grey and alpha. */
static const char *letters(const image *img) {
    return img->file == IMAGE_PNG && img->channels == 2 ? "YA" : "RGBA";
}

/* The first colour that differs from red; null where all three are the same, or are not there. */
static const char *find_unlike(const image *img) {
    static const char *const colours[] = {"R", "G", "B"};
    const size_t size = image_type_size(img->type), count = (size_t)img->width * img->height;
    const char *at = img->data;
    for (size_t i = 0; img->channels >= 3 && i < count; i++, at += img->channels * size)
        for (size_t k = 1; k < sizeof colours / sizeof colours[0]; k++)
            if (memcmp(at, at + k * size, size) != 0)
                return colours[k];
    return NULL;
}

/* Keeps one channel alone. */
static void take(image *img, size_t channel) {
    const size_t size = image_type_size(img->type), count = (size_t)img->width * img->height;
    char *samples = img->data;
    for (size_t i = 0; i < count; i++)
        memmove(samples + i * size, samples + (i * img->channels + channel) * size, size);
    img->channels = 1;
}

/* Channels without names: the one that is asked for is read, else the first. */
static bool find_channel(image *img, const char *asked, image_error *error) {
    const char *known = letters(img);
    const bool several = img->channels > 1 && img->file != IMAGE_RAW; /* a stencil is none */
    const char *found = asked == NULL ? known : strlen(asked) == 1 ? strchr(known, *asked) : NULL;
    const size_t read = found != NULL ? (size_t)(found - known) : IMAGE_CHANNELS_MAX;
    char names[IMAGE_NAMES_SIZE] = "";
    for (size_t k = 0; several && k < img->channels; k++)
        if (read >= img->channels || k != read)
            append(names, sizeof names, "%s%c", names[0] != '\0' ? ", " : "", known[k]);
    if (asked != NULL && (!several || read >= img->channels))
        return fail(error, "%s: has no channel %.40s, but %s", image_file_name(img->file), asked,
                    several ? names : "one without a name");
    if (several) {
        snprintf(img->channel, sizeof img->channel, "%c", known[read]);
        memcpy(img->others, names, sizeof names);
    }
    if (asked != NULL)
        take(img, read);
    return true;
}

bool image_choose(image *img, const char *asked, image_error *error) {
    const char *unlike = img->unlike;
    if (img->channel[0] == '\0') {
        if (!find_channel(img, asked, error))
            return false;
        unlike = find_unlike(img);
    }
    return asked != NULL || unlike == NULL ||
           fail(error,
                "%s: its channels R and %s differ, so it is a colour picture and no depth: --channel %s reads one of "
                "them all the same%s",
                image_file_name(img->file), unlike, img->channel,
                img->type == IMAGE_U8 ? "; --packing NAME, a depth that several hold together" : "");
}
