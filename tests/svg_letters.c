/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "svg_letters.h"

#include <cairo-svg.h>
#include <cairo.h>

#include "support.h"

/* Beyond ASCII: what figures write. */
static const char *const others[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074", "\u2075",
                                     "\u2076", "\u2077", "\u2078", "\u2079", "\u207b", "\u00b7",
                                     "\u2212", "\u2026", "\u00b0", "\u00d7", "\u00fc", "\u03b1"};
enum { OTHERS = sizeof others / sizeof others[0], ASCII = '~' - '!' + 1, EACH = ASCII + OTHERS };

/* For the leak sanitizer: what fontconfig read stays in memory until the program ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:libfontconfig\n";
}

typedef struct bytes {
    char *at;
    size_t size, read;
} bytes;

static cairo_status_t append(void *closure, const unsigned char *data, unsigned int size) {
    bytes *b = closure;
    char *at = realloc(b->at, b->size + size + 1);
    if (at == NULL)
        return CAIRO_STATUS_NO_MEMORY;
    b->at = at;
    memcpy(b->at + b->size, data, size);
    b->size += size;
    b->at[b->size] = '\0';
    return CAIRO_STATUS_SUCCESS;
}

static const char *letter(int i, char out[8]) {
    if (i < ASCII)
        snprintf(out, 8, "%c", '!' + i);
    else
        snprintf(out, 8, "%s", others[i - ASCII]);
    return out;
}

/* A page with each letter once, in order. */
static bytes draw_all(const svg_font *fonts, size_t count) {
    bytes b = {NULL, 0, 0};
    cairo_surface_t *surface = cairo_svg_surface_create_for_stream(append, &b, 100, 100);
    cairo_t *cr = cairo_create(surface);
    char text[8];
    for (size_t f = 0; f < count; f++) {
        cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                               fonts[f].bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(cr, fonts[f].size);
        for (int i = 0; i < EACH; i++) {
            cairo_move_to(cr, 10, 50);
            cairo_show_text(cr, letter(i, text));
        }
    }
    cairo_destroy(cr);
    cairo_surface_finish(surface);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    cairo_surface_destroy(surface);
    assert_non_null(b.at);
    return b;
}

/* The outline behind the next `<use xlink:href="#ID"`; moves *at on. */
static char *next_outline(const char *page, const char **at) {
    static const char use[] = "<use xlink:href=\"#", path[] = " d=\"";
    char id[80];
    *at = strstr(*at, use);
    if (*at == NULL)
        return NULL;
    *at += sizeof use - 1;
    snprintf(id, sizeof id, "id=\"%.*s\"", (int)strcspn(*at, "\""), *at);
    const char *symbol = strstr(page, id), *d = symbol != NULL ? strstr(symbol, path) : NULL;
    assert_non_null(d);
    d += sizeof path - 1;
    return strndup(d, strcspn(d, "\""));
}

const svg_letters *svg_letters_of(const svg_font *fonts, size_t count) {
    static svg_letters all;
    static svg_font known[8];
    static size_t known_count;
    if (count == known_count && memcmp(known, fonts, count * sizeof *fonts) == 0)
        return &all;
    assert_true(count <= sizeof known / sizeof known[0] && count * EACH <= SVG_LETTERS);
    for (size_t i = 0; i < all.count; i++)
        free(all.letters[i].outline);
    all.count = 0;
    bytes page = draw_all(fonts, count);
    const char *at = page.at;
    for (size_t f = 0; f < count; f++)
        for (int i = 0; i < EACH; i++) {
            svg_letter *l = &all.letters[all.count++];
            letter(i, l->text);
            l->font = fonts[f];
            l->outline = next_outline(page.at, &at);
            if (l->outline == NULL || l->outline[0] == '\0')
                fail_msg("the font has no letter '%s'", l->text);
        }
    free(page.at);
    memcpy(known, fonts, count * sizeof *fonts);
    known_count = count;
    return &all;
}

const svg_letter *svg_letter_find(const svg_letters *l, const char *outline) {
    for (size_t i = 0; i < l->count; i++)
        if (strcmp(l->letters[i].outline, outline) == 0)
            return &l->letters[i];
    return NULL;
}

/* ---- Images ------------------------------------------------------------------------------------------------------ */

static bytes base64(const char *text) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    bytes b = {calloc(strlen(text) + 4, 1), 0, 0};
    unsigned bits = 0, held = 0;
    assert_non_null(b.at);
    for (; *text != '\0' && *text != '='; text++) {
        const char *digit = strchr(digits, *text);
        if (digit == NULL)
            continue;
        bits = bits << 6 | (unsigned)(digit - digits);
        held += 6;
        if (held >= 8)
            b.at[b.size++] = (char)(bits >> (held -= 8));
    }
    return b;
}

static cairo_status_t supply(void *closure, unsigned char *out, unsigned int size) {
    bytes *b = closure;
    if (size > b->size - b->read)
        return CAIRO_STATUS_READ_ERROR;
    memcpy(out, b->at + b->read, size);
    b->read += size;
    return CAIRO_STATUS_SUCCESS;
}

uint32_t *svg_pixels(const char *data, int *columns, int *rows) {
    const char *comma = strchr(data, ',');
    assert_non_null(comma);
    bytes png = base64(comma + 1);
    cairo_surface_t *image = cairo_image_surface_create_from_png_stream(supply, &png);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    const bool opaque = cairo_image_surface_get_format(image) == CAIRO_FORMAT_RGB24;
    *columns = cairo_image_surface_get_width(image);
    *rows = cairo_image_surface_get_height(image);
    uint32_t *out = calloc((size_t)*columns * (size_t)*rows, sizeof *out);
    assert_non_null(out);
    for (int y = 0; y < *rows; y++) {
        const unsigned char *line =
            cairo_image_surface_get_data(image) + (ptrdiff_t)y * cairo_image_surface_get_stride(image);
        for (int x = 0; x < *columns; x++) {
            uint32_t *pixel = &out[(size_t)y * (size_t)*columns + (size_t)x];
            memcpy(pixel, line + (size_t)x * sizeof *pixel, sizeof *pixel);
            *pixel |= opaque ? 0xFF000000u : 0;
        }
    }
    cairo_surface_destroy(image);
    free(png.at);
    return out;
}
