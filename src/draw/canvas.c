/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <time.h>

#include "core/elementary.h"
#include "draw/pixels.h"

/* Points per px in a PDF: CSS has 96 px to the inch, PDF 72 points. */
#define POINTS_PER_PX 0.75
#define FONT_FAMILY   "DejaVu Sans"

struct canvas {
    cairo_surface_t *surface;
    cairo_t *cr;
    canvas_format format;
    FILE *stream; /* into the bytes */
    canvas_bytes bytes;
    notes words;
};

static cairo_status_t append(void *closure, const unsigned char *data, unsigned int size) {
    return fwrite(data, 1, size, closure) == size ? CAIRO_STATUS_SUCCESS : CAIRO_STATUS_WRITE_ERROR;
}

canvas_format canvas_format_of(const char *path) {
    static const char *const endings[CANVAS_FORMAT_COUNT] = {".svg", ".pdf", ".png"};
    size_t length = strlen(path);
    for (int i = 0; i < CANVAS_FORMAT_COUNT; i++)
        if (length > 4 && strcasecmp(path + length - 4, endings[i]) == 0)
            return (canvas_format)i;
    return CANVAS_FORMAT_COUNT;
}

/* cairo would stamp the hour of the run. The empty date leaves the entry out; SOURCE_DATE_EPOCH puts its own in. */
static void pdf_metadata(cairo_surface_t *surface, const notes *words) {
    char date[32] = "";
    const char *epoch = getenv("SOURCE_DATE_EPOCH");
    if (epoch != NULL && *epoch != '\0') {
        char *end;
        time_t seconds = (time_t)strtoll(epoch, &end, 10);
        struct tm utc;
        if (*end == '\0' && gmtime_r(&seconds, &utc) != NULL)
            strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &utc);
    }
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, date);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, words->title);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT, words->description);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, words->command);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_KEYWORDS, words->data);
}

bool canvas_writes(canvas_format format) {
    return format < CANVAS_FORMAT_COUNT;
}

canvas *canvas_new(canvas_format format, int width, int height, const notes *words) {
    canvas *c = calloc(1, sizeof *c);
    FILE *stream = c != NULL ? open_memstream(&c->bytes.at, &c->bytes.size) : NULL;
    if (stream == NULL) {
        free(c);
        return NULL;
    }
    c->stream = stream;
    c->format = format;
    c->words = *words;
    if (format == CANVAS_SVG) {
        c->surface = cairo_svg_surface_create_for_stream(append, c->stream, width, height);
        cairo_svg_surface_set_document_unit(c->surface, CAIRO_SVG_UNIT_PX);
    } else if (format == CANVAS_PDF) {
        c->surface =
            cairo_pdf_surface_create_for_stream(append, c->stream, width * POINTS_PER_PX, height * POINTS_PER_PX);
        pdf_metadata(c->surface, words);
    } else {
        c->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
    }
    c->cr = cairo_create(c->surface);
    if (format == CANVAS_PDF)
        cairo_scale(c->cr, POINTS_PER_PX, POINTS_PER_PX);
    cairo_set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
    return c;
}

static bool write_png(canvas *c) {
    cairo_surface_flush(c->surface);
    const pixels p = {.at = (const uint32_t *)(const void *)cairo_image_surface_get_data(c->surface),
                      .stride = (size_t)cairo_image_surface_get_stride(c->surface) / sizeof(uint32_t),
                      .width = cairo_image_surface_get_width(c->surface),
                      .height = cairo_image_surface_get_height(c->surface)};
    return pixels_write_png(c->stream, &p, &c->words);
}

bool canvas_finish(canvas *c, canvas_bytes *out) {
    cairo_status_t drawn = cairo_status(c->cr);
    cairo_destroy(c->cr);
    if (drawn == CAIRO_STATUS_SUCCESS && c->format == CANVAS_PNG && !write_png(c))
        drawn = CAIRO_STATUS_WRITE_ERROR;
    cairo_surface_finish(c->surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = cairo_surface_status(c->surface);
    cairo_surface_destroy(c->surface);
    bool good = fclose(c->stream) == 0 && drawn == CAIRO_STATUS_SUCCESS;
    *out = good ? c->bytes : (canvas_bytes){NULL, 0};
    if (good && c->format == CANVAS_SVG) {
        FILE *whole = open_memstream(&out->at, &out->size);
        good = whole != NULL;
        if (good) {
            notes_write_svg(whole, c->bytes.at, c->bytes.size, &c->words);
            good = (ferror(whole) | fclose(whole)) == 0;
        }
    }
    if (c->bytes.at != out->at)
        free(c->bytes.at);
    free(c);
    return good;
}

static double reach(double v) {
    return isnan(v) ? 0 : fmin(fmax(v, -CANVAS_REACH), CANVAS_REACH);
}

static void use_colour(canvas *c, canvas_colour colour) {
    cairo_set_source_rgba(c->cr, colour.r, colour.g, colour.b, colour.a);
}

void canvas_path_to(canvas *c, double x, double y) {
    cairo_line_to(c->cr, reach(x), reach(y));
}

void canvas_path_break(canvas *c) {
    cairo_new_sub_path(c->cr);
}

void canvas_path_segment(canvas *c, double x0, double y0, double x1, double y1) {
    canvas_path_break(c);
    canvas_path_to(c, x0, y0);
    canvas_path_to(c, x1, y1);
}

void canvas_path_end(canvas *c, const canvas_pen *pen) {
    use_colour(c, pen->colour);
    cairo_set_line_width(c->cr, pen->width);
    cairo_set_dash(c->cr, pen->dash, pen->dash_count, 0);
    cairo_stroke(c->cr);
}

void canvas_path_fill(canvas *c, canvas_colour colour) {
    cairo_close_path(c->cr);
    use_colour(c, colour);
    cairo_fill(c->cr);
}

static void outline(canvas *c, const canvas_point *points, size_t count) {
    for (size_t i = 0; i < count; i++)
        canvas_path_to(c, points[i].x, points[i].y);
}

void canvas_fill(canvas *c, canvas_rect area, canvas_colour colour) {
    use_colour(c, colour);
    cairo_rectangle(c->cr, reach(area.x), reach(area.y), reach(area.w), reach(area.h));
    cairo_fill(c->cr);
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
    cairo_arc(c->cr, reach(x), reach(y), radius, 0, 8 * dp_atan(1));
    use_colour(c, fill);
    cairo_fill_preserve(c->cr);
    canvas_path_end(c, rim);
}

static void use_font(canvas *c, const canvas_font *font) {
    cairo_select_font_face(c->cr, FONT_FAMILY, CAIRO_FONT_SLANT_NORMAL,
                           font->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c->cr, font->size);
}

double canvas_text_width(canvas *c, const char *text, const canvas_font *font) {
    cairo_text_extents_t extents;
    use_font(c, font);
    cairo_text_extents(c->cr, text, &extents);
    return extents.x_advance;
}

void canvas_text(canvas *c, double x, double y, const char *text, const canvas_font *font, canvas_align align) {
    if (*text == '\0')
        return;
    double back = canvas_text_width(c, text, font) * (double)align / 2;
    cairo_save(c->cr);
    cairo_translate(c->cr, reach(x), reach(y));
    if (font->halo.a > 0) {
        cairo_move_to(c->cr, -back, 0);
        cairo_text_path(c->cr, text);
        canvas_path_end(c, &(canvas_pen){.colour = font->halo, .width = font->size / 4});
    }
    use_colour(c, font->colour);
    cairo_move_to(c->cr, -back, 0);
    cairo_show_text(c->cr, text);
    cairo_restore(c->cr);
    cairo_new_path(c->cr);
}

/* An SVG holds the picture as PNG: cairo takes one that is there. */
static void attach_png(cairo_surface_t *image, const pixels *p) {
    char *bytes = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&bytes, &size);
    const bool good = stream != NULL && pixels_write_png(stream, p, NULL);
    if (stream != NULL && fclose(stream) == 0 && good &&
        cairo_surface_set_mime_data(image, CAIRO_MIME_TYPE_PNG, (const unsigned char *)bytes, size, free, bytes) ==
            CAIRO_STATUS_SUCCESS)
        return;
    free(bytes); /* then cairo writes its own */
}

void canvas_image(canvas *c, canvas_rect area, int columns, int rows, uint32_t *at) {
    pixels p = {.at = at, .stride = (size_t)columns, .width = columns, .height = rows};
    for (size_t i = 0; i < (size_t)columns * (size_t)rows && !p.holes; i++)
        p.holes = at[i] >> 24 == 0;
    cairo_surface_t *image = cairo_image_surface_create_for_data(
        (unsigned char *)at, p.holes ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
    if (c->format == CANVAS_SVG)
        attach_png(image, &p);
    cairo_save(c->cr);
    cairo_translate(c->cr, area.x, area.y);
    cairo_scale(c->cr, area.w / columns, area.h / rows);
    cairo_set_source_surface(c->cr, image, 0, 0);
    cairo_pattern_set_filter(cairo_get_source(c->cr), CAIRO_FILTER_NEAREST);
    cairo_pattern_set_extend(cairo_get_source(c->cr), CAIRO_EXTEND_PAD);
    cairo_rectangle(c->cr, 0, 0, columns, rows);
    cairo_fill(c->cr);
    cairo_restore(c->cr);
    cairo_surface_finish(image); /* who still needs the pixels copies them now */
    cairo_surface_destroy(image);
}

void canvas_clip(canvas *c, canvas_rect area) {
    cairo_save(c->cr);
    cairo_rectangle(c->cr, area.x, area.y, area.w, area.h);
    cairo_clip(c->cr);
}

void canvas_unclip(canvas *c) {
    cairo_restore(c->cr);
}
