/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The page in place of plot/canvas.c: the same drawing as SVG text, without cairo. Letters stay text in the page's own
 * font, whose widths the page measures. Coordinates are written to a hundredth of a px.
 */
#include "plot/canvas.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plot/pixels.h"
#include "web/page.h"

#define FONT_FAMILY "DejaVu Sans, Verdana, sans-serif"

struct canvas {
    FILE *stream; /* into the bytes */
    canvas_bytes bytes;
    notes words;
    bool path; /* an attribute d="... is open */
    bool moved;
    int clips;
};

bool canvas_writes(canvas_format format) {
    return format == CANVAS_SVG;
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
    bool good = (ferror(c->stream) | fclose(c->stream)) == 0;
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

void canvas_path_segment(canvas *c, double x0, double y0, double x1, double y1) {
    canvas_path_break(c);
    canvas_path_to(c, x0, y0);
    canvas_path_to(c, x1, y1);
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
    attribute(c, "x", area.x);
    attribute(c, "y", area.y);
    attribute(c, "width", area.w);
    attribute(c, "height", area.h);
    paint(c, "fill", colour);
    fputs("/>\n", c->stream);
}

static void outline(canvas *c, const canvas_point *points, size_t count) {
    for (size_t i = 0; i < count; i++)
        canvas_path_to(c, points[i].x, points[i].y);
}

void canvas_polygon(canvas *c, const canvas_point *points, size_t count, canvas_colour colour) {
    outline(c, points, count);
    canvas_path_fill(c, colour);
}

void canvas_line(canvas *c, const canvas_point *points, size_t count, const canvas_pen *pen) {
    outline(c, points, count);
    canvas_path_end(c, pen);
}

void canvas_segment(canvas *c, double x0, double y0, double x1, double y1, const canvas_pen *pen) {
    canvas_line(c, (canvas_point[]){{x0, y0}, {x1, y1}}, 2, pen);
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

/* As runs of one colour in a row: maps have large areas of it. */
void canvas_image(canvas *c, canvas_rect area, int columns, int rows, uint32_t *at) {
    const double w = area.w / columns, h = area.h / rows;
    fputs("<g shape-rendering=\"crispEdges\">\n", c->stream);
    for (int row = 0; row < rows; row++)
        for (int from = 0, to; from < columns; from = to) {
            const uint32_t *line = at + (ptrdiff_t)row * columns;
            for (to = from + 1; to < columns && line[to] == line[from];)
                to++;
            if (line[from] >> 24 == 0)
                continue;
            fputs("<rect", c->stream);
            attribute(c, "x", area.x + w * from);
            attribute(c, "y", area.y + h * row);
            attribute(c, "width", w * (to - from));
            attribute(c, "height", h);
            fprintf(c->stream, " fill=\"#%06lx\"/>\n", (unsigned long)line[from] & 0xFFFFFF);
        }
    fputs("</g>\n", c->stream);
}

void canvas_clip(canvas *c, canvas_rect area) {
    c->clips++;
    fprintf(c->stream, "<clipPath id=\"clip%d\">", c->clips);
    fputs("<rect", c->stream);
    attribute(c, "x", area.x);
    attribute(c, "y", area.y);
    attribute(c, "width", area.w);
    attribute(c, "height", area.h);
    fprintf(c->stream, "/></clipPath>\n<g clip-path=\"url(#clip%d)\">\n", c->clips);
}

void canvas_unclip(canvas *c) {
    fputs("</g>\n", c->stream);
}
