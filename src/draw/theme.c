/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/theme.h"

#define RGBA(hex, a)                                                                                                   \
    { ((hex) >> 16 & 255) / 255.0, ((hex) >> 8 & 255) / 255.0, ((hex)&255) / 255.0, a }
#define RGB(hex) RGBA(hex, 1.0)

/* Okabe and Ito 2008, "Color Universal Design". */
#define BLACK          RGB(0x000000)
#define ORANGE         RGB(0xE69F00)
#define SKY_BLUE       RGB(0x56B4E9)
#define BLUISH_GREEN   RGB(0x009E73)
#define YELLOW         RGB(0xF0E442)
#define BLUE           RGB(0x0072B2)
#define VERMILION      RGB(0xD55E00)
#define REDDISH_PURPLE RGB(0xCC79A7)

static const theme themes[] = {
    {"light",
     RGB(0xFFFFFF),
     RGB(0x1A1D21),
     RGB(0x4F5660),
     RGB(0x7A828C),
     RGB(0xE4E7EB),
     RGB(0xEDEFF2),
     2.0,
     {BLUE, VERMILION, BLUISH_GREEN, REDDISH_PURPLE, ORANGE, SKY_BLUE, BLACK, YELLOW}},
    {"dark",
     RGB(0x14171C),
     RGB(0xECEFF3),
     RGB(0xAEB6C0),
     RGB(0x7C8591),
     RGB(0x2A3038),
     RGB(0x22272E),
     2.0,
     {SKY_BLUE, ORANGE, BLUISH_GREEN, REDDISH_PURPLE, YELLOW, VERMILION, RGB(0xF5F5F5), BLUE}},
    {"print",
     RGB(0xFFFFFF),
     RGB(0x000000),
     RGB(0x000000),
     RGB(0x000000),
     RGB(0xD0D0D0),
     RGB(0xE8E8E8),
     1.8,
     {BLACK, VERMILION, BLUE, BLUISH_GREEN, REDDISH_PURPLE, ORANGE, SKY_BLUE, YELLOW}},
};

static const struct {
    int count;
    double dash[CANVAS_DASHES]; /* in line widths */
} strokes[THEME_STROKES] = {
    {0, {0}}, {2, {4, 2.2}}, {2, {1.2, 1.8}}, {4, {5, 2, 1.2, 2}}, {2, {1.2, 4.5}}, {2, {8, 3}},
};

/* viridis (van der Walt and Smith 2015) at eleven equal steps; straight lines between them stay within 2/255. */
const canvas_colour theme_viridis_steps[THEME_VIRIDIS_STEPS] = {
    RGB(0x440154), RGB(0x482576), RGB(0x414487), RGB(0x35608D), RGB(0x2A788E), RGB(0x21908C),
    RGB(0x22A884), RGB(0x43BF71), RGB(0x7AD151), RGB(0xBBDF27), RGB(0xFDE725),
};

/* Outlines in units of the marker's radius; the disc is row 0 and has none. */
static const struct {
    size_t count;
    canvas_point at[10];
} markers[THEME_MARKERS] = {
    {0, {{0, 0}}},
    {4, {{-.9, -.9}, {.9, -.9}, {.9, .9}, {-.9, .9}}},
    {4, {{0, -1.3}, {1.3, 0}, {0, 1.3}, {-1.3, 0}}},
    {3, {{0, -1.25}, {1.2, .9}, {-1.2, .9}}},
    {3, {{0, 1.25}, {1.2, -.9}, {-1.2, -.9}}},
    {6, {{-1.2, 0}, {-.6, -1.05}, {.6, -1.05}, {1.2, 0}, {.6, 1.05}, {-.6, 1.05}}},
};

const theme *theme_get(size_t index) {
    return index < sizeof themes / sizeof *themes ? &themes[index] : NULL;
}

canvas_colour theme_colour(const theme *t, int colour) {
    return colour < 0 ? t->text : t->curves[colour % THEME_COLOURS];
}

canvas_pen theme_pen(const theme *t, int colour, int stroke, double scale) {
    canvas_pen pen = {.colour = theme_colour(t, colour), .width = t->line_width * scale};
    pen.dash_count = strokes[stroke % THEME_STROKES].count;
    for (int i = 0; i < pen.dash_count; i++)
        pen.dash[i] = strokes[stroke % THEME_STROKES].dash[i] * pen.width;
    return pen;
}

void theme_marker(canvas *c, const theme *t, double x, double y, int marker, int colour, bool hollow, double scale) {
    double radius = (hollow ? 3.2 : 3.6) * scale;
    size_t count = markers[marker % THEME_MARKERS].count;
    canvas_colour own = theme_colour(t, colour);
    canvas_colour fill = hollow ? t->background : own;
    canvas_pen rim = {.colour = hollow ? own : t->background, .width = 1.4 * scale};
    if (count == 0) {
        canvas_disc(c, x, y, radius, fill, &rim);
        return;
    }
    canvas_point at[11];
    for (size_t i = 0; i <= count; i++) {
        const canvas_point *p = &markers[marker % THEME_MARKERS].at[i % count];
        at[i] = (canvas_point){x + radius * p->x, y + radius * p->y};
    }
    canvas_polygon(c, at, count, fill);
    canvas_line(c, at, count + 1, &rim);
}
