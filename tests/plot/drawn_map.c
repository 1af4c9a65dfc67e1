/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "drawn_map.h"

#include "support.h"

const svg_mark *drawn_map_image(const drawn *d, const drawn_panel *p) {
    const svg_mark *found = NULL;
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_IMAGE || m->columns == 1 || !svg_inside(m->box, p->frame, 1))
            continue;
        assert_null(found);
        found = m;
    }
    assert_non_null(found);
    assert_true(svg_inside(p->frame, found->box, 1));
    return found;
}

svg_point drawn_map_place(const svg_mark *image, int column, int row) {
    const svg_box b = image->box;
    return (svg_point){b.x0 + (b.x1 - b.x0) * (column + 0.5) / image->columns,
                       b.y0 + (b.y1 - b.y0) * (row + 0.5) / image->rows, false};
}

uint32_t drawn_map_pixel(const svg_mark *image, svg_point place) {
    const svg_box b = image->box;
    const int column = (int)floor((place.x - b.x0) / (b.x1 - b.x0) * image->columns);
    const int row = (int)floor((place.y - b.y0) / (b.y1 - b.y0) * image->rows);
    assert_true(column >= 0 && column < image->columns && row >= 0 && row < image->rows);
    return image->pixels[(size_t)row * (size_t)image->columns + (size_t)column];
}

uint32_t drawn_map_shown(const drawn *d, const drawn_panel *p, svg_point place) {
    uint32_t found = 0;
    for (size_t i = 1; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (place.x < m->box.x0 || place.x > m->box.x1 || place.y < m->box.y0 || place.y > m->box.y1 ||
            !svg_inside(m->box, p->frame, 2))
            continue;
        if (m->kind == SVG_IMAGE)
            found = drawn_map_pixel(m, place);
        else if (m->kind == SVG_PATH && m->fill.a == 1 && svg_rgb(m->fill) != d->theme->empty &&
                 svg_rgb(m->fill) != d->theme->background) /* a hollow mark */
            found = 0xFF000000u | svg_rgb(m->fill);
    }
    return found;
}

static int distance(uint32_t a, uint32_t b) {
    int sum = 0;
    for (int shift = 0; shift <= 16; shift += 8)
        sum += abs((int)(a >> shift & 255) - (int)(b >> shift & 255));
    return sum;
}

double drawn_bar_px(const drawn *d, uint32_t pixel) {
    const svg_mark *bar = d->bar;
    int best = 0;
    assert_non_null(bar);
    for (int row = 1; row < bar->rows; row++)
        if (distance(bar->pixels[row], pixel) < distance(bar->pixels[best], pixel))
            best = row;
    if (distance(bar->pixels[best], pixel) > 6)
        fail_msg("the colour %06x is not on the bar", pixel & 0xFFFFFF);
    return bar->box.y0 + (bar->box.y1 - bar->box.y0) * (best + 0.5) / bar->rows;
}

static double lightness(uint32_t pixel) {
    return 0.2126 * (pixel >> 16 & 255) + 0.7152 * (pixel >> 8 & 255) + 0.0722 * (pixel & 255);
}

void drawn_bar_is_viridis(const drawn *d) {
    const svg_mark *bar = d->bar;
    assert_non_null(bar);
    assert_true(distance(bar->pixels[0], 0xFDE725) < 6 && distance(bar->pixels[bar->rows - 1], 0x440154) < 6);
    assert_true(distance(bar->pixels[bar->rows / 2], 0x21908C) < 6);
    for (int row = 1; row < bar->rows; row++)
        assert_true(lightness(bar->pixels[row]) <= lightness(bar->pixels[row - 1]) + 0.5); /* of 255 */
}

void drawn_bar_is_grey(const drawn *d) {
    const svg_mark *bar = d->bar;
    assert_non_null(bar);
    for (int row = 0; row < bar->rows; row++) {
        const int level = (int)lrint(255 * (1 - (row + 0.5) / bar->rows));
        assert_true(distance(bar->pixels[row], (uint32_t)level * 0x10101U) <= 6);
    }
}

void drawn_bar_is_used(const drawn *d) {
    bool low = false, high = false;
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_IMAGE || m == d->bar)
            continue;
        for (int k = 0; k < m->columns * m->rows; k++) {
            high = high || (m->pixels[k] >> 24 == 255 && distance(m->pixels[k], d->bar->pixels[0]) < 6);
            low = low || (m->pixels[k] >> 24 == 255 && distance(m->pixels[k], d->bar->pixels[d->bar->rows - 1]) < 6);
        }
    }
    assert_true(low && high);
}
