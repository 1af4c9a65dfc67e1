/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The page in place of draw/canvas.c: the same drawing as SVG text, without cairo. Letters stay text in the page's own
 * font, whose widths the page measures. Coordinates are written to a hundredth of a px.
 */
#include "draw/canvas.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw/pixels.h"
#include "web/page.h"

#define FONT_FAMILY "DejaVu Sans, Verdana, sans-serif"

struct canvas {
    FILE *stream; /* into the bytes */
    canvas_bytes bytes;
    notes words;
    bool path; /* an attribute d="... is open */
    bool moved;
    bool lost; /* memory ran out */
    int clips;
};

const char *canvas_lacks(canvas_format format) {
    return format == CANVAS_SVG
               ? NULL
               : "must be svg, because this program was built without cairo: rsvg-convert makes others of it";
}

canvas *canvas_new(canvas_format format, int width, int height, const notes *words) {
    canvas *c = format == CANVAS_SVG ? calloc(1, sizeof *c) : NULL;
    FILE *stream = c != NULL ? open_memstream(&c->bytes.at, &c->bytes.size) : NULL;
    if (stream == NULL) {
        free(c);
        return NULL;
    }
    c->stream = stream;
    c->words = *words;
    fprintf(stream,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
            "font-family=\"" FONT_FAMILY "\" stroke-linejoin=\"round\">\n",
            width, height, width, height);
    return c;
}

bool canvas_finish(canvas *c, canvas_bytes *out) {
    fputs("</svg>\n", c->stream);
    bool good = (ferror(c->stream) | fclose(c->stream)) == 0 && !c->lost;
    *out = (canvas_bytes){NULL, 0};
    FILE *whole = good ? open_memstream(&out->at, &out->size) : NULL;
    good = whole != NULL;
    if (good) {
        notes_write_svg(whole, c->bytes.at, c->bytes.size, &c->words);
        good = (ferror(whole) | fclose(whole)) == 0;
    }
    free(c->bytes.at);
    free(c);
    return good;
}

/* "12.5", "-3", "0.07": a coordinate within reach, to a hundredth. */
static void put(canvas *c, double v) {
    const double reached = isnan(v) ? 0 : fmin(fmax(v, -CANVAS_REACH), CANVAS_REACH);
    const long hundredths = lrint(100 * reached), whole = labs(hundredths) / 100, rest = labs(hundredths) % 100;
    char text[32];
    int length = snprintf(text, sizeof text, "%s%ld", hundredths < 0 ? "-" : "", whole);
    if (rest > 0)
        length += snprintf(text + length, sizeof text - (size_t)length, rest % 10 == 0 ? ".%ld" : ".%02ld",
                           rest % 10 == 0 ? rest / 10 : rest);
    fwrite(text, 1, (size_t)length, c->stream);
}

static void attribute(canvas *c, const char *name, double v) {
    fprintf(c->stream, " %s=\"", name);
    put(c, v);
    fputc('"', c->stream);
}

static void put_area(canvas *c, canvas_rect area) {
    attribute(c, "x", area.x);
    attribute(c, "y", area.y);
    attribute(c, "width", area.w);
    attribute(c, "height", area.h);
}

static void paint(canvas *c, const char *name, canvas_colour colour) {
    fprintf(c->stream, " %s=\"#%02lx%02lx%02lx\"", name, lrint(255 * colour.r), lrint(255 * colour.g),
            lrint(255 * colour.b));
    if (colour.a < 1)
        fprintf(c->stream, " %s-opacity=\"%.3g\"", name, colour.a);
}

static void stroke(canvas *c, const canvas_pen *pen) {
    paint(c, "stroke", pen->colour);
    attribute(c, "stroke-width", pen->width);
    for (int i = 0; i < pen->dash_count; i++) {
        fputs(i == 0 ? " stroke-dasharray=\"" : " ", c->stream);
        put(c, pen->dash[i]);
    }
    fputs(pen->dash_count > 0 ? "\"" : "", c->stream);
}

static void begin_path(canvas *c) {
    if (!c->path)
        fputs("<path d=\"", c->stream);
    c->path = true;
}

void canvas_path_to(canvas *c, double x, double y) {
    begin_path(c);
    fputc(c->moved ? 'L' : 'M', c->stream);
    c->moved = true;
    put(c, x);
    fputc(' ', c->stream);
    put(c, y);
}

void canvas_path_break(canvas *c) {
    c->moved = false;
}

void canvas_path_end(canvas *c, const canvas_pen *pen) {
    begin_path(c);
    fputs("\" fill=\"none\"", c->stream);
    stroke(c, pen);
    fputs("/>\n", c->stream);
    c->path = c->moved = false;
}

void canvas_path_fill(canvas *c, canvas_colour colour) {
    begin_path(c);
    fputs("Z\"", c->stream);
    paint(c, "fill", colour);
    fputs("/>\n", c->stream);
    c->path = c->moved = false;
}

void canvas_fill(canvas *c, canvas_rect area, canvas_colour colour) {
    fputs("<rect", c->stream);
    put_area(c, area);
    paint(c, "fill", colour);
    fputs("/>\n", c->stream);
}

void canvas_disc(canvas *c, double x, double y, double radius, canvas_colour fill, const canvas_pen *rim) {
    fputs("<circle", c->stream);
    attribute(c, "cx", x);
    attribute(c, "cy", y);
    attribute(c, "r", radius);
    paint(c, "fill", fill);
    stroke(c, rim);
    fputs("/>\n", c->stream);
}

double canvas_text_width(canvas *c, const char *text, const canvas_font *font) {
    (void)c;
    return page_measure(text, (int)strlen(text), font->size, font->bold);
}

void canvas_text(canvas *c, double x, double y, const char *text, const canvas_font *font, canvas_align align) {
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    if (*text == '\0')
        return;
    fputs("<text", c->stream);
    attribute(c, "x", x);
    attribute(c, "y", y);
    attribute(c, "font-size", font->size);
    fprintf(c->stream, "%s%s", font->bold ? " font-weight=\"bold\"" : "", anchors[align]);
    paint(c, "fill", font->colour);
    if (font->halo.a > 0) {
        stroke(c, &(canvas_pen){.colour = font->halo, .width = font->size / 4});
        fputs(" paint-order=\"stroke\"", c->stream);
    }
    fputc('>', c->stream);
    notes_write_escaped(c->stream, text);
    fputs("</text>\n", c->stream);
}

/* ---- Images: a PNG whose pixels are not compressed, in base64 ---------------------------------------------------- */

enum { PNG_HEAD = 8 + 25 + 8, PNG_TAIL = 4 + 4 + 12, ROW_HEAD = 5 + 1, ADLER = 65521 };

static uint8_t *put32(uint8_t *to, uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8)
        *to++ = (uint8_t)(v >> shift);
    return to;
}

static uint8_t *put_bytes(uint8_t *to, const char *bytes, size_t size) {
    memcpy(to, bytes, size);
    return to + size;
}

/* The sum behind a chunk, of its name and content. */
static uint8_t *put_sum(uint8_t *to, const uint8_t *name) {
    uint32_t sum = ~0U;
    for (const uint8_t *at = name; at < to; at++) {
        sum ^= *at;
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ (sum & 1 ? 0xEDB88320 : 0);
    }
    return put32(to, ~sum);
}

/* Each row is a block of deflate's that is stored: the filter "none", then red, green, blue and alpha. */
static uint8_t *put_rows(uint8_t *to, int columns, int rows, const uint32_t *at) {
    const uint32_t size = 1 + 4 * (uint32_t)columns;
    uint32_t a = 1, b = 0;
    for (int row = 0; row < rows; row++) {
        const uint8_t head[ROW_HEAD] = {row + 1 == rows, (uint8_t)size, (uint8_t)(size >> 8), (uint8_t)~size,
                                        (uint8_t)(~size >> 8)};
        const uint8_t *begin = to + ROW_HEAD - 1;
        to = put_bytes(to, (const char *)head, sizeof head);
        for (int column = 0; column < columns; column++, at++)
            to = put32(to, *at << 8 | *at >> 24);
        for (; begin < to; begin++)
            b = (b + (a = (a + *begin) % ADLER)) % ADLER;
    }
    return put32(to, b << 16 | a);
}

static size_t write_png(uint8_t *png, int columns, int rows, const uint32_t *at) {
    const size_t size = 2 + (size_t)rows * (ROW_HEAD + 4 * (size_t)columns) + 4;
    uint8_t *to = put_bytes(png, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16), *name = to - 4;
    to = put32(put32(to, (uint32_t)columns), (uint32_t)rows);
    to = put_sum(put_bytes(to, "\x08\x06\0\0\0", 5), name);
    name = put32(to, (uint32_t)size);
    to = put_rows(put_bytes(name, "IDAT\x78\x01", 6), columns, rows, at);
    to = put_sum(to, name);
    return (size_t)(put_bytes(to, "\0\0\0\0IEND\xAE\x42\x60\x82", 12) - png);
}

static void put_base64(FILE *stream, const uint8_t *at, size_t size) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t three = 0;
        for (size_t k = i; k < i + 3; k++)
            three = three << 8 | (k < size ? at[k] : 0);
        for (size_t k = 0; k < 4; k++)
            fputc(i + k <= size ? digits[three >> (18 - 6 * k) & 63] : '=', stream);
    }
}

void canvas_image(canvas *c, canvas_rect area, int columns, int rows, uint32_t *at) {
    uint8_t *png = malloc(PNG_HEAD + PNG_TAIL + 2 + (size_t)rows * (ROW_HEAD + 4 * (size_t)columns));
    c->lost |= png == NULL;
    if (png == NULL)
        return;
    fputs("<image preserveAspectRatio=\"none\"", c->stream);
    put_area(c, area);
    fputs(" href=\"data:image/png;base64,", c->stream);
    put_base64(c->stream, png, write_png(png, columns, rows, at));
    fputs("\"/>\n", c->stream);
    free(png);
}

void canvas_clip(canvas *c, canvas_rect area) {
    c->clips++;
    fprintf(c->stream, "<clipPath id=\"clip%d\">", c->clips);
    fputs("<rect", c->stream);
    put_area(c, area);
    fprintf(c->stream, "/></clipPath>\n<g clip-path=\"url(#clip%d)\">\n", c->clips);
}

void canvas_unclip(canvas *c) {
    fputs("</g>\n", c->stream);
}
