/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The page's canvas draws what cairo draws: whole figures through it, turned into pixels by librsvg, against the
 * program's PNG of the same command. The letters are measured by cairo here, so that both lay out the same page.
 */
#include <cairo.h>
#include <unistd.h>

#include "cli/option/option.h"
#include "draw/canvas.h"
#include "support.h"
#include "web/page.h"

/* In this program instead of draw/canvas.c; where it writes is remembered. */
#define canvas_text page_canvas_text
#include "web/canvas.c"
#undef canvas_text

enum { WORDS_MAX = 512 };
static canvas_rect written[WORDS_MAX];
static size_t written_count;

void canvas_text(canvas *c, double x, double y, const char *text, const canvas_font *font, canvas_align align) {
    const double width = canvas_text_width(c, text, font);
    assert_true(written_count < WORDS_MAX);
    written[written_count++] =
        (canvas_rect){x - width * (double)align / 2 - 2, y - font->size, width * 1.03 + 4, font->size * 1.3};
    page_canvas_text(c, x, y, text, font, align);
}

canvas_format canvas_format_of(const char *path) {
    (void)path;
    return CANVAS_FORMAT_COUNT;
}

double page_measure(const char *text, int length, double size, int bold) {
    char copy[1024];
    cairo_text_extents_t extents;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, 1, 1);
    cairo_t *cr = cairo_create(surface);
    snprintf(copy, sizeof copy, "%.*s", length, text);
    cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
    cairo_text_extents(cr, copy, &extents);
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return extents.x_advance;
}

static const char *const figures[] = {
    "plot interval -n 0.1 -f 1000 -F d24,fp32 -m d3d,reversed",
    "plot interval -n 0.1 -f 1000 -F fp32 -m reversed --model float --viewport 1920x1080 --theme dark",
    "plot error -n 0.1 -f 1000 -F d16 -m gl --figure-size 400x300",
    "plot distribution -n 1 -f 10 -F unorm4 -m d3d",
    "plot share -F d24 -m d3d,gl",
    "plot budget -F fp32 -m reversed --theme dark",
    "plot map -F d16,fp32 -m d3d --figure-size 600x400",
    "plot shadow -f 150",
};

static void run(const char *format, const char *a, const char *b) {
    char line[1024];
    snprintf(line, sizeof line, format, a, b);
    if (system(line) != 0)
        fail_msg("%s", line);
}

/* The figure through the page's canvas, into a file. */
static void draw_here(const char *command, const char *path) {
    char line[512], *words[32] = {"depthprec"}, *rest = line;
    int count = 1;
    snprintf(line, sizeof line, "%s --type svg -o %s", command, path);
    for (char *word; (word = strsep(&rest, " ")) != NULL;)
        words[count++] = word;
    asked_line o;
    assert_int_equal(options_parse(&o, count, words), EXIT_FINE);
    assert_int_equal(cmd_plot(o.request), EXIT_FINE);
    options_release(&o);
}

static double channel(cairo_surface_t *s, int x, int y, int shift) {
    const unsigned char *line = cairo_image_surface_get_data(s) + (ptrdiff_t)y * cairo_image_surface_get_stride(s);
    uint32_t pixel;
    memcpy(&pixel, line + 4 * x, sizeof pixel);
    return pixel >> shift & 255;
}

enum { SIDE = 4 };

static bool is_written(int x, int y) {
    for (size_t i = 0; i < written_count; i++)
        if (x + SIDE > written[i].x && x < written[i].x + written[i].w && y + SIDE > written[i].y &&
            y < written[i].y + written[i].h)
            return true;
    return false;
}

/* Letters are hinted in their own way: what counts is how much ink there is. Else the colour of 4x4 px. */
typedef struct difference {
    double ink;    /* share */
    double colour; /* of 255, and where */
    int x, y;
} difference;

static difference compare(cairo_surface_t *a, cairo_surface_t *b) {
    difference out = {0};
    double ink_a = 0, ink_b = 0;
    for (int y = 0; y + SIDE <= cairo_image_surface_get_height(a); y += SIDE)
        for (int x = 0; x + SIDE <= cairo_image_surface_get_width(a); x += SIDE)
            for (int shift = 0; shift < 24; shift += 8) {
                double of_a = 0, of_b = 0;
                for (int i = 0; i < SIDE * SIDE; i++) {
                    of_a += channel(a, x + i % SIDE, y + i / SIDE, shift);
                    of_b += channel(b, x + i % SIDE, y + i / SIDE, shift);
                }
                const double colour = fabs(of_a - of_b) / (SIDE * SIDE);
                if (is_written(x, y)) {
                    ink_a += fabs(of_a - SIDE * SIDE * channel(a, 0, 0, shift));
                    ink_b += fabs(of_b - SIDE * SIDE * channel(b, 0, 0, shift));
                } else if (colour > out.colour) {
                    out = (difference){out.ink, colour, x, y};
                }
            }
    assert_true(ink_b > 0);
    out.ink = fabs(ink_a / ink_b - 1);
    return out;
}

TEST(test_figures) {
    char folder[] = "/tmp/canvas.XXXXXX", svg[64], png[64], cairos[64];
    assert_non_null(mkdtemp(folder));
    snprintf(svg, sizeof svg, "%s/a.svg", folder);
    snprintf(png, sizeof png, "%s/a.png", folder);
    snprintf(cairos, sizeof cairos, "%s/b.png", folder);
    for (size_t i = 0; i < sizeof figures / sizeof *figures; i++) {
        written_count = 0;
        draw_here(figures[i], svg);
        run("rsvg-convert -o %s %s", png, svg);
        run("${DEPTHPREC:-build/depthprec} %s -o %s", figures[i], cairos);
        cairo_surface_t *a = cairo_image_surface_create_from_png(png);
        cairo_surface_t *b = cairo_image_surface_create_from_png(cairos);
        assert_int_equal(cairo_surface_status(a), CAIRO_STATUS_SUCCESS);
        assert_int_equal(cairo_image_surface_get_width(a), cairo_image_surface_get_width(b));
        assert_int_equal(cairo_image_surface_get_height(a), cairo_image_surface_get_height(b));
        const difference d = compare(a, b);
        if (!(d.colour < 12 && d.ink < 0.04))
            fail_msg("%s: %g of 255 at %d, %d; ink of letters %g", figures[i], d.colour, d.x, d.y, d.ink);
        cairo_surface_destroy(a);
        cairo_surface_destroy(b);
    }
    run("rm -r %s%s", folder, "");
}
