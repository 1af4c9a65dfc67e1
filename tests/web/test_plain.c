/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A program without cairo: how wide its words are, by cairo; which files are figures. */
#include <cairo.h>

#include "support.h"

#include "web/plain.c"

/* Widths as cairo has them without hinting, which depends on the screen. */
static double by_cairo(cairo_t *cr, const char *text, double size, int bold) {
    cairo_text_extents_t extents;
    cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
    cairo_text_extents(cr, text, &extents);
    return extents.x_advance;
}

TEST(test_widths) {
    tally t = {.name = "widths"};
    rng r = rng_make("widths");
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
    cairo_t *cr = cairo_create(surface);
    cairo_font_options_t *plain = cairo_font_options_create();
    cairo_font_options_set_hint_metrics(plain, CAIRO_HINT_METRICS_OFF);
    cairo_font_options_set_hint_style(plain, CAIRO_HINT_STYLE_NONE);
    cairo_set_font_options(cr, plain);
    for (int k = 0; k < 500; k++) {
        char text[64];
        const int bold = k % 2, length = k < 190 ? 1 : 1 + (int)rng_below(&r, 60);
        const double size = rng_uniform(&r, 6, 40);
        for (int i = 0; i < length; i++)
            text[i] = (char)(k < 190 ? FIRST + k / 2 : FIRST + (int)rng_below(&r, LAST - FIRST + 1));
        text[length] = '\0';
        const double got = page_measure(text, length, size, bold), want = by_cairo(cr, text, size, bold);
        /* half a thousandth of the size a letter, and what kerning takes */
        TALLY(&t, fabs(got - want) <= size * length * (length > 1 ? 0.012 : 0.001), "'%s', %g px, bold %d: %g, not %g",
              text, size, bold, got, want);
    }
    /* a letter of two or three bytes is one */
    TALLY(&t, page_measure("\xC3\x97", 2, 10, 0) == page_measure("\xE2\x88\x92", 3, 10, 0), "letters beyond ASCII");
    cairo_font_options_destroy(plain);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    tally_end(&t);
}

TEST(test_files) {
    assert_int_equal(canvas_format_of("a.svg"), CANVAS_SVG);
    assert_int_equal(canvas_format_of("A.PDF"), CANVAS_PDF);
    assert_int_equal(canvas_format_of("a/b.png"), CANVAS_PNG);
    assert_int_equal(canvas_format_of(".svg"), CANVAS_FORMAT_COUNT);
    assert_int_equal(canvas_format_of("a.svgz"), CANVAS_FORMAT_COUNT);
}
