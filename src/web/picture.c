/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The flickering picture's door: a command's words make it, each frame is one call. What is said about it is written
 * to stdout, a line for the gap and one for the rest. picture.js is the other side; all calls have the same instance.
 */
#include "raster/picture.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "report/number.h"
#include "web/gpu.h"
#include "web/page.h"

enum { DIGITS = 3 };
enum { PIXELS = DRAW_PICTURE_WIDTH * DRAW_PICTURE_HEIGHT };

static draw_picture picture; /* z is 0: there is none */
static uint32_t *pixels;
static const char *unit;
static draw_picture_count count;

static void let_go(void) {
    if (picture.z > 0.0)
        draw_picture_close(&picture);
    picture = (draw_picture){0};
}

/* Makes the picture of the first camera, mapping and depth, and of the first format that the rasterizer draws. */
static int make(const camera_asked *all) {
    const camera_asked *c = camera_of(all, 0);
    size_t format = 0;
    const raster_row *row = c->raster != NULL ? c->raster : raster_find("llvmpipe");
    while (format + 1 < c->format_count && !raster_draws(row, &c->formats[format]))
        format++;
    dp_spec spec = camera_to_spec(&c->said);
    spec.format = c->formats[format];
    const double z = c->at.count > 0 ? depths_get(&c->at, 0) : (double)NAN;
    const char *wrong = draw_picture_open(&picture, &spec, row, z);
    unit = camera_unit(c);
    return wrong == NULL ? EXIT_FINE : usage_error("%s: %s", row->name, wrong);
}

/* The camera of whatever command takes one. */
static int make_of(const asked_line *line) {
    const camera_asked *all = option_group(line, option_find(line->command, "near"));
    return all != NULL ? make(all) : usage_error("%s has no camera", line->command->name);
}

static int picture_of(int argc, char **words) {
    asked_line line;
    let_go();
    pixels = pixels != NULL ? pixels : malloc(PIXELS * sizeof *pixels);
    int status = argc > 0 ? options_parse(&line, argc, words) : usage_error("too many words");
    if (status == EXIT_FINE)
        status = pixels != NULL ? make_of(&line) : usage_error("no memory for a picture");
    if (argc > 0)
        options_release(&line);
    fflush(NULL);
    return status;
}

/** Makes the picture of the command of `n` words. @return its exit status; EXIT_FINE: there is one */
PAGE_EXPORT("picture_set") int picture_set(int n) {
    char **words;
    const int argc = page_words(n, &words);
    return picture_of(argc, words);
}

/** The gap at a place of the slider, scene units; 0 without a picture. */
PAGE_EXPORT("picture_gap") double picture_gap(double place) {
    return picture.z > 0.0 ? draw_picture_gap(&picture, place) : 0.0;
}

/** The eye depth of the things drawn, scene units: for a second picture of them. */
PAGE_EXPORT("picture_z") double picture_z(void) {
    return picture.z;
}

/** Draws a frame. @return how many pixels are wrong */
PAGE_EXPORT("picture_draw") int picture_draw(double gap, unsigned frame, int marks) {
    if (!(picture.z > 0.0))
        return 0;
    count = draw_picture_frame(&picture, gap, frame, marks != 0, pixels);
    return (int)count.wrong;
}

/** The picture drawn: 640 x 360 pixels of red, green, blue and alpha, row by row from the top. */
PAGE_EXPORT("picture_pixels") const uint32_t *picture_pixels(void) {
    return pixels;
}

/** Whether the guarantee is on the slider, at 0.75. */
PAGE_EXPORT("picture_marked") int picture_marked(void) {
    return picture.z > 0.0 && draw_picture_marked(&picture);
}

/* Rounded up, as the guarantee is, where it is the guarantee. */
static number_text gap_text(double gap) {
    return number_brief(gap == picture.guaranteed ? number_up(gap, DIGITS) : number_of(gap, DIGITS));
}

static void say_guarantee(void) {
    const number_text from = number_in(gap_text(picture.guaranteed), unit);
    if (draw_picture_marked(&picture))
        printf("Nothing flickers from %s on, at any slant: guaranteed.\n", from.text);
    else if (isfinite(picture.guaranteed))
        printf("A separation is guaranteed from %s on, more than there is room for.\n", from.text);
    else
        printf("No separation is guaranteed at this depth.\n");
}

/** Says the gap, and what it does, as the last frame was; `quiet`: none was wrong lately. */
PAGE_EXPORT("picture_say") void picture_say(double gap, int quiet) {
    const double share = 100.0 * (double)count.wrong / fmax((double)count.covered, 1.0);
    char label[SETUP_LABEL_SIZE];
    if (!(picture.z > 0.0))
        return;
    printf("%s\n", number_in(gap_text(gap), unit).text);
    if (gap < picture.guaranteed && quiet != 0)
        printf("No pixel is wrong just now. ");
    else if (gap < picture.guaranteed)
        printf("%s %% of sign, poster and marks shows what is behind. ", number_brief(number_of(share, 2)).text);
    say_guarantee();
    printf("%s, things about %s away, drawn by the model of %s\n", setup_label(&picture.setup, false, label),
           number_in(number_brief(number_of(picture.z, DIGITS)), unit).text, picture.camera.target.row->name);
    fflush(NULL);
}

/* ---- The same by the browser's GPU ------------------------------------------------------------------------------- */

enum { TRIANGLES = 64 };

typedef struct corners {
    uint32_t count, who[TRIANGLES];
    raster_vertex at[TRIANGLES][3];
} corners;

static void take_corners(void *context, const double place[3][3], unsigned who) {
    corners *c = context;
    if (c->count == TRIANGLES)
        return;
    for (int i = 0; i < 3; i++)
        c->at[c->count][i] = draw_clip(&picture.camera, place[i]);
    c->who[c->count++] = who;
}

/* Who is seen takes the place of the model's in the buffer. Characters of the output are the bytes of pixels. */
static int draw_by_gpu(double gap, unsigned frame) {
    static const char *const formats[] = {"unorm16", "unorm24", "fp32"};
    static corners all;
    char text[GPU_TEXT_SIZE];
    gpu_request r = {.what = GPU_PICTURE, .other = picture.camera.pipeline.reversed != 0, .out = pixels};
    size_t differ = 0;
    while (r.format < 3 && strcmp(formats[r.format], picture.setup.spec.format.name) != 0)
        r.format++;
    if (r.format == 3)
        return usage_error("WebGL has no %s", picture.setup.spec.format.name);
    const size_t wrong = draw_picture_frame(&picture, gap, frame, false, NULL).wrong;
    draw_picture_triangles(&picture, gap, frame, take_corners, &all);
    r.count = all.count;
    r.in = all.at;
    r.second = all.who;
    if (!gpu_ask(&r, text))
        return usage_error("%s", text);
    for (size_t i = 0; i < PIXELS; i++) {
        differ += picture.buffer.winner[i] != pixels[i];
        picture.buffer.winner[i] = (uint8_t)pixels[i];
    }
    count = draw_picture_show(&picture, false, pixels);
    for (size_t i = 0; i < sizeof *pixels * PIXELS; i++) {
        const unsigned char byte = ((const unsigned char *)pixels)[i];
        if (byte >= 0x80)
            putchar(0xC0 | byte >> 6);
        putchar(byte >= 0x80 ? 0x80 | (byte & 0x3F) : byte);
    }
    fprintf(stderr, "This GPU, gap %s: %zu of %d pixels differ from the model of %s; %zu are wrong here, %zu there.\n",
            number_in(gap_text(gap), unit).text, differ, PIXELS, picture.camera.target.row->name, count.wrong, wrong);
    return EXIT_FINE;
}

/** A frame by the GPU: the first words are its number and the gap, as a place of the slider; then comes a command.
 * @return exit status; what is said of it is on stderr */
PAGE_EXPORT("seen") int seen_words(int n) {
    char **words;
    if (page_words(n, &words) < 3)
        return EXIT_USAGE;
    const unsigned frame = (unsigned)atoi(words[1]);
    const double place = strtod(words[2], NULL);
    int status = picture_of(n - 1, &words[2]);
    if (status == EXIT_FINE)
        status = draw_by_gpu(draw_picture_gap(&picture, place), frame);
    fflush(NULL);
    return status;
}
