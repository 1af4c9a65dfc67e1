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
#include "system/dynload.h"
#include "system/pages.h"

/* Points per px in a PDF: CSS has 96 px to the inch, PDF 72 points. */
#define POINTS_PER_PX 0.75
#define FONT_FAMILY   "DejaVu Sans"

/* The functions of the library that are called. It is opened when a figure is drawn: with it come a dozen others, whose
 * loading a table would wait for in vain. */
#define FUNCTIONS(X)                                                                                                   \
    X(cairo_arc)                                                                                                       \
    X(cairo_clip)                                                                                                      \
    X(cairo_close_path)                                                                                                \
    X(cairo_create)                                                                                                    \
    X(cairo_destroy)                                                                                                   \
    X(cairo_fill)                                                                                                      \
    X(cairo_fill_preserve)                                                                                             \
    X(cairo_get_source)                                                                                                \
    X(cairo_image_surface_create)                                                                                      \
    X(cairo_image_surface_create_for_data)                                                                             \
    X(cairo_image_surface_get_data)                                                                                    \
    X(cairo_image_surface_get_height)                                                                                  \
    X(cairo_image_surface_get_stride)                                                                                  \
    X(cairo_image_surface_get_width)                                                                                   \
    X(cairo_line_to)                                                                                                   \
    X(cairo_move_to)                                                                                                   \
    X(cairo_new_path)                                                                                                  \
    X(cairo_new_sub_path)                                                                                              \
    X(cairo_pattern_set_extend)                                                                                        \
    X(cairo_pattern_set_filter)                                                                                        \
    X(cairo_pdf_surface_create_for_stream)                                                                             \
    X(cairo_pdf_surface_set_metadata)                                                                                  \
    X(cairo_rectangle)                                                                                                 \
    X(cairo_restore)                                                                                                   \
    X(cairo_save)                                                                                                      \
    X(cairo_scale)                                                                                                     \
    X(cairo_select_font_face)                                                                                          \
    X(cairo_set_dash)                                                                                                  \
    X(cairo_set_font_size)                                                                                             \
    X(cairo_set_line_join)                                                                                             \
    X(cairo_set_line_width)                                                                                            \
    X(cairo_set_source_rgba)                                                                                           \
    X(cairo_set_source_surface)                                                                                        \
    X(cairo_show_text)                                                                                                 \
    X(cairo_status)                                                                                                    \
    X(cairo_stroke)                                                                                                    \
    X(cairo_surface_destroy)                                                                                           \
    X(cairo_surface_finish)                                                                                            \
    X(cairo_surface_flush)                                                                                             \
    X(cairo_surface_set_mime_data)                                                                                     \
    X(cairo_surface_status)                                                                                            \
    X(cairo_svg_surface_create_for_stream)                                                                             \
    X(cairo_svg_surface_set_document_unit)                                                                             \
    X(cairo_text_extents)                                                                                              \
    X(cairo_text_path)                                                                                                 \
    X(cairo_translate)
DYNLOAD_FUNCTIONS(FUNCTIONS)

static const library cairo = {"a figure", {"libcairo.so.2", "libcairo-2.dll", NULL}, "libcairo2", symbols};
static functions call;

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
    call.cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, date);
    call.cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, words->title);
    call.cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_SUBJECT, words->description);
    call.cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, words->command);
    call.cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_KEYWORDS, words->data);
}

const char *canvas_lacks(canvas_format format) {
    static char error[DYNLOAD_ERROR_SIZE];
    static bool open;
    (void)format;
    open = open || dynload_open(&cairo, call.all, error);
    return open ? NULL : error;
}

canvas *canvas_new(canvas_format format, int width, int height, const notes *words) {
    canvas *c = canvas_lacks(format) == NULL ? calloc(1, sizeof *c) : NULL;
    FILE *stream = c != NULL ? open_memstream(&c->bytes.at, &c->bytes.size) : NULL;
    if (stream == NULL) {
        free(c);
        return NULL;
    }
    c->stream = stream;
    c->format = format;
    c->words = *words;
    if (format == CANVAS_SVG) {
        c->surface = call.cairo_svg_surface_create_for_stream(append, c->stream, width, height);
        call.cairo_svg_surface_set_document_unit(c->surface, CAIRO_SVG_UNIT_PX);
    } else if (format == CANVAS_PDF) {
        c->surface =
            call.cairo_pdf_surface_create_for_stream(append, c->stream, width * POINTS_PER_PX, height * POINTS_PER_PX);
        pdf_metadata(c->surface, words);
    } else {
        c->surface = call.cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
        pages_large(call.cairo_image_surface_get_data(c->surface),
                    (size_t)call.cairo_image_surface_get_stride(c->surface) * (size_t)height);
    }
    c->cr = call.cairo_create(c->surface);
    if (format == CANVAS_PDF)
        call.cairo_scale(c->cr, POINTS_PER_PX, POINTS_PER_PX);
    call.cairo_set_line_join(c->cr, CAIRO_LINE_JOIN_ROUND);
    return c;
}

static bool write_png(canvas *c) {
    call.cairo_surface_flush(c->surface);
    const pixels p = {.at = (const uint32_t *)(const void *)call.cairo_image_surface_get_data(c->surface),
                      .stride = (size_t)call.cairo_image_surface_get_stride(c->surface) / sizeof(uint32_t),
                      .width = call.cairo_image_surface_get_width(c->surface),
                      .height = call.cairo_image_surface_get_height(c->surface)};
    return pixels_write_png(c->stream, &p, &c->words);
}

bool canvas_finish(canvas *c, canvas_bytes *out) {
    cairo_status_t drawn = call.cairo_status(c->cr);
    call.cairo_destroy(c->cr);
    if (drawn == CAIRO_STATUS_SUCCESS && c->format == CANVAS_PNG && !write_png(c))
        drawn = CAIRO_STATUS_WRITE_ERROR;
    call.cairo_surface_finish(c->surface);
    if (drawn == CAIRO_STATUS_SUCCESS)
        drawn = call.cairo_surface_status(c->surface);
    call.cairo_surface_destroy(c->surface);
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
    call.cairo_set_source_rgba(c->cr, colour.r, colour.g, colour.b, colour.a);
}

void canvas_path_to(canvas *c, double x, double y) {
    call.cairo_line_to(c->cr, reach(x), reach(y));
}

void canvas_path_break(canvas *c) {
    call.cairo_new_sub_path(c->cr);
}

void canvas_path_end(canvas *c, const canvas_pen *pen) {
    use_colour(c, pen->colour);
    call.cairo_set_line_width(c->cr, pen->width);
    call.cairo_set_dash(c->cr, pen->dash, pen->dash_count, 0);
    call.cairo_stroke(c->cr);
}

void canvas_path_fill(canvas *c, canvas_colour colour) {
    call.cairo_close_path(c->cr);
    use_colour(c, colour);
    call.cairo_fill(c->cr);
}

void canvas_fill(canvas *c, canvas_rect area, canvas_colour colour) {
    use_colour(c, colour);
    call.cairo_rectangle(c->cr, reach(area.x), reach(area.y), reach(area.w), reach(area.h));
    call.cairo_fill(c->cr);
}

void canvas_disc(canvas *c, double x, double y, double radius, canvas_colour fill, const canvas_pen *rim) {
    call.cairo_arc(c->cr, reach(x), reach(y), radius, 0, 8 * dp_atan(1));
    use_colour(c, fill);
    call.cairo_fill_preserve(c->cr);
    canvas_path_end(c, rim);
}

static void use_font(canvas *c, const canvas_font *font) {
    call.cairo_select_font_face(c->cr, FONT_FAMILY, CAIRO_FONT_SLANT_NORMAL,
                                font->bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    call.cairo_set_font_size(c->cr, font->size);
}

double canvas_text_width(canvas *c, const char *text, const canvas_font *font) {
    cairo_text_extents_t extents;
    use_font(c, font);
    call.cairo_text_extents(c->cr, text, &extents);
    return extents.x_advance;
}

void canvas_text(canvas *c, double x, double y, const char *text, const canvas_font *font, canvas_align align) {
    if (*text == '\0')
        return;
    double back = canvas_text_width(c, text, font) * (double)align / 2;
    call.cairo_save(c->cr);
    call.cairo_translate(c->cr, reach(x), reach(y));
    if (font->halo.a > 0) {
        call.cairo_move_to(c->cr, -back, 0);
        call.cairo_text_path(c->cr, text);
        canvas_path_end(c, &(canvas_pen){.colour = font->halo, .width = font->size / 4});
    }
    use_colour(c, font->colour);
    call.cairo_move_to(c->cr, -back, 0);
    call.cairo_show_text(c->cr, text);
    call.cairo_restore(c->cr);
    call.cairo_new_path(c->cr);
}

/* An SVG holds the picture as PNG: cairo takes one that is there. */
static void attach_png(cairo_surface_t *image, const pixels *p) {
    char *bytes = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&bytes, &size);
    const bool good = stream != NULL && pixels_write_png(stream, p, NULL);
    if (stream != NULL && fclose(stream) == 0 && good &&
        call.cairo_surface_set_mime_data(image, CAIRO_MIME_TYPE_PNG, (const unsigned char *)bytes, size, free, bytes) ==
            CAIRO_STATUS_SUCCESS)
        return;
    free(bytes); /* then cairo writes its own */
}

void canvas_image(canvas *c, canvas_rect area, int columns, int rows, uint32_t *at) {
    pixels p = {.at = at, .stride = (size_t)columns, .width = columns, .height = rows};
    for (size_t i = 0; i < (size_t)columns * (size_t)rows && !p.holes; i++)
        p.holes = at[i] >> 24 == 0;
    cairo_surface_t *image = call.cairo_image_surface_create_for_data(
        (unsigned char *)at, p.holes ? CAIRO_FORMAT_ARGB32 : CAIRO_FORMAT_RGB24, columns, rows, 4 * columns);
    if (c->format == CANVAS_SVG)
        attach_png(image, &p);
    call.cairo_save(c->cr);
    call.cairo_translate(c->cr, area.x, area.y);
    call.cairo_scale(c->cr, area.w / columns, area.h / rows);
    call.cairo_set_source_surface(c->cr, image, 0, 0);
    call.cairo_pattern_set_filter(call.cairo_get_source(c->cr), CAIRO_FILTER_NEAREST);
    call.cairo_pattern_set_extend(call.cairo_get_source(c->cr), CAIRO_EXTEND_PAD);
    call.cairo_rectangle(c->cr, 0, 0, columns, rows);
    call.cairo_fill(c->cr);
    call.cairo_restore(c->cr);
    call.cairo_surface_finish(image); /* who still needs the pixels copies them now */
    call.cairo_surface_destroy(image);
}

void canvas_clip(canvas *c, canvas_rect area) {
    call.cairo_save(c->cr);
    call.cairo_rectangle(c->cr, area.x, area.y, area.w, area.h);
    call.cairo_clip(c->cr);
}

void canvas_unclip(canvas *c) {
    call.cairo_restore(c->cr);
}
