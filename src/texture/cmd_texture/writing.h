/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file writing.h  For the files of texture alone: an image on its way into an output. */
#ifndef TEXTURE_CMD_TEXTURE_WRITING_H
#define TEXTURE_CMD_TEXTURE_WRITING_H

#include "cli/progress.h"
#include "texture/cmd_texture/texture.h"
#include "texture/compose.h"

enum { GREYS = 65535 };

/** The step of eye depths that --as rounded to multiples of one, which samples of 16 bits then count; else 0. */
double writing_step(const frame_product *made);

/** An image on its way into an output, under whose name it appears when it is complete. */
typedef struct writing {
    output out;
    FILE *stream;
    image_writer *writer;
    image_file file;
    uint32_t channels;
    size_t row_values, made_values; /* in a row: samples of the file, and numbers of the product */
    compose on;                     /* a picture, or none */
    const texture_source *source;
    void *row;            /* room for a row of the file's samples */
    double lo, hi, scale; /* of the 16 bits of a PNG */
    bool units;           /* eye depths, multiples of lo */
    bool directions;      /* normals in it: -1 to 1, and of none 0 in all three */
    bool down;            /* their y */
    bool upwards;         /* an error must not come back smaller, */
    double more;          /* and has to hold for the product in 16 bits, which is rounded, too */
    image_type type;      /* depth images: */
    uint32_t *codes;
    progress bar;
    uint64_t done;
    bool levels; /* the error of an effect, and its pixels: all, and those more than one level off */
    uint64_t pixels, beyond;
} writing;

/** Opens the output and makes room. @return an exit status, after one line on stderr */
int writing_open(const texture_request *o, writing *w, const char *path, const texture_source *s, image_type type,
                 uint32_t channels);

/** The header, with what a file says of itself; null: nothing. */
bool writing_begin(writing *w, const char *note);

/** PFM wants its rows from the bottom. */
bool writing_bottom_up(const writing *w);

/** Writes rows of a product: a frame_take. */
bool writing_take(void *context, uint32_t row, uint32_t count, const float *values);

/** Files appear only when all of them are there. @return an exit status, after one line on stderr */
int writing_close(writing *w, int count, bool good);

/** A sample means offset + scale x sample. */
typedef struct meaning {
    const char *file, *product, *unit, *type, *axes;
    uint32_t channels;
    double offset, scale;
    const struct meaning *error_map; /**< of the error map beside it; null: there is none */
} meaning;

meaning writing_meaning(const texture_request *o, const texture_product *p, const writing *w);

/** For the file itself. Eye depths are read back by it. */
void writing_note(const writing *w, const texture_product *p, const meaning *m, char note[IMAGE_NOTE_SIZE]);

/** Says the meaning of the file's numbers: JSON on stdout; or, of a PNG, a line on stderr. @return an exit status */
int writing_say(const texture_request *o, const texture_product *p, const writing *w, meaning *m);

#endif
