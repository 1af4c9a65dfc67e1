/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Maps of cameras, as drawn, against the library: colours through the colour bar, contours, hatch, the camera. */
#include "drawn.h"
#include "drawn_map.h"
#include "drawn_truth.h"
#include "support.h"

typedef struct map_case {
    const char *formats, *mappings, *arguments;
    double zfar;
    double lo, hi; /* the depths asked about: one where equal, all between the planes where NaN */
    const drawn_theme *look;
} map_case;

static int borders; /* at which lines were seen to end */

/* The value of the map for one camera; NaN where it does not see what is asked about, or is none. */
static double true_value(const dp_setup *like, const map_case *q, double znear, double zfar) {
    dp_spec spec = like->spec;
    dp_setup setup;
    dp_worst worst;
    dp_sample sample;
    spec.znear = znear;
    spec.zfar = zfar;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return NAN;
    if (q->lo == q->hi)
        return dp_sample_at(&setup, q->lo, &sample) == DP_OK ? sample.interval : NAN;
    const double lo = isnan(q->lo) ? znear : q->lo, hi = isnan(q->hi) ? zfar : q->hi;
    return dp_worst_over(&setup, lo, hi, &worst) == DP_OK ? worst.interval : NAN;
}

/* The least and the greatest value within some px of a place; false beside a hole. */
static bool around(const drawn_panel *p, const dp_setup *like, const map_case *q, svg_point place, double px,
                   double *lo, double *hi) {
    *lo = INFINITY;
    *hi = -INFINITY;
    for (int i = 0; i < 25; i++) {
        const double x = place.x + px * (i % 5 - 2) / 2, y = place.y + px * (i / 5 - 2) / 2;
        const double v = true_value(like, q, drawn_at(&p->x, x), drawn_at(&p->y, y));
        if (isnan(v))
            return false;
        *lo = fmin(*lo, v);
        *hi = fmax(*hi, v);
    }
    return true;
}

/* Each field has the colour that the bar gives its value. */
static void check_fields(const drawn *d, const drawn_panel *p, const svg_mark *image, const dp_setup *like,
                         const map_case *q, bool *holes) {
    rng r = rng_make("fields");
    int seen = 0;
    for (int n = 0; n < 400; n++) {
        const svg_point place = drawn_map_place(image, (int)rng_below(&r, (uint64_t)image->columns),
                                                (int)rng_below(&r, (uint64_t)image->rows));
        const uint32_t pixel = drawn_map_pixel(image, place);
        double lo, hi;
        const bool whole = around(p, like, q, place, 1.5, &lo, &hi);
        if (isnan(true_value(like, q, drawn_at(&p->x, place.x), drawn_at(&p->y, place.y)))) {
            double edge;
            *holes = true;
            if (!around(p, like, q, place, 1, &edge, &edge) && pixel >> 24 != 0) /* at the rim of a hole */
                assert_true(around(p, like, q, (svg_point){place.x - 2, place.y - 2, false}, 0, &edge, &edge) ||
                            around(p, like, q, (svg_point){place.x + 2, place.y + 2, false}, 0, &edge, &edge) ||
                            around(p, like, q, (svg_point){place.x - 2, place.y + 2, false}, 0, &edge, &edge) ||
                            around(p, like, q, (svg_point){place.x + 2, place.y - 2, false}, 0, &edge, &edge));
            continue;
        }
        if (!whole)
            continue;
        assert_int_equal(pixel >> 24, 255);
        const double bar = drawn_bar_px(d, pixel);
        if (bar > drawn_px(&d->value, lo) + 2 || bar < drawn_px(&d->value, hi) - 2)
            fail_msg("near %.4g, far %.4g is shown as %.4g, should be %.4g to %.4g", drawn_at(&p->x, place.x),
                     drawn_at(&p->y, place.y), drawn_at(&d->value, bar), lo, hi);
        seen++;
    }
    assert_true(seen > 150);
}

/* ---- Contours ---------------------------------------------------------------------------------------------------- */

/* Which label of the bar a line of the map stands for: the only one whose value all its corners may have; -1 where
 * every corner lies at a hole. */
static int level_of(const drawn *d, const drawn_panel *p, const svg_mark *m, const dp_setup *like, const map_case *q) {
    bool fits[DRAWN_LABELS];
    int level = -1, judged = 0, sharp = 0;
    for (int k = 0; k < d->value.labels; k++)
        fits[k] = true;
    for (size_t i = 0; i < m->count; i += 1 + m->count / 40) {
        double lo, hi;
        if (!around(p, like, q, m->points[i], 6, &lo, &hi))
            continue;
        judged++;
        for (int k = 0; k < d->value.labels; k++) {
            const double value = drawn_number(d->value.at[k]->text);
            fits[k] = fits[k] && lo <= value && value <= hi;
        }
        around(p, like, q, m->points[i], 1.2, &lo, &hi);
        for (int k = 0; k < d->value.labels; k++) {
            const double value = drawn_number(d->value.at[k]->text);
            sharp += lo <= value && value <= hi;
        }
    }
    /* Values of fixed-point formats change evenly, and the line is where they are. */
    if (like->spec.format.kind == DP_FORMAT_UNORM && sharp < 0.9 * judged)
        fail_msg("only %d of %d corners of a line have its value", sharp, judged);
    for (int k = 0; k < d->value.labels && judged > 0; k++)
        if (fits[k]) {
            assert_int_equal(level, -1);
            level = k;
        }
    if (level < 0 && judged > 0)
        fail_msg("a line of %zu corners on the map follows no labelled value", m->count);
    return level;
}

/* Does the map reach well to both sides of a value? */
static bool is_crossed(const drawn *d, const svg_mark *image, double level_px) {
    bool above = false, below = false;
    for (int i = 0; i < image->columns * image->rows; i += 7) {
        if (image->pixels[i] >> 24 == 0)
            continue;
        const double px = drawn_bar_px(d, image->pixels[i]);
        above = above || px < level_px - 6;
        below = below || px > level_px + 6;
    }
    return above && below;
}

/* A line goes on to the outermost row and column where their fields lie on either side of its value: to the middle of
 * one of them. */
static void check_ends(const drawn *d, const svg_mark *line, const svg_mark *image, double level_px) {
    const double dx = (image->box.x1 - image->box.x0) / image->columns,
                 dy = (image->box.y1 - image->box.y0) / image->rows;
    for (int side = 0; side < 4; side++) { /* top, bottom, left, right */
        const int count = side < 2 ? image->columns : image->rows,
                  far = side < 2 ? image->rows - 1 : image->columns - 1;
        bool above = false, below = false, holes = false;
        for (int i = 0; i < count; i++) {
            const int across = side % 2 != 0 ? far : 0;
            const uint32_t pixel = image->pixels[side < 2 ? across * image->columns + i : i * image->columns + across];
            const double px = pixel >> 24 != 0 ? drawn_bar_px(d, pixel) : level_px;
            holes = holes || pixel >> 24 == 0;
            above = above || px < level_px - 6;
            below = below || px > level_px + 6;
        }
        if (holes || !above || !below)
            continue;
        double nearest = INFINITY;
        for (size_t i = 0; i < line->count; i++) {
            const svg_point p = line->points[i];
            nearest = fmin(nearest, side == 0   ? (p.y - image->box.y0) / dy
                                    : side == 1 ? (image->box.y1 - p.y) / dy
                                    : side == 2 ? (p.x - image->box.x0) / dx
                                                : (image->box.x1 - p.x) / dx);
        }
        if (fabs(nearest - 0.5) > 0.3)
            fail_msg("a line ends %g fields before side %d", nearest, side);
        borders++;
    }
}

/* Lines at the labelled values, white on the dark half and black on the light; each is named once, on the line. */
static void check_contours(const drawn *d, const drawn_panel *p, const svg_mark *image, const dp_setup *like,
                           const map_case *q) {
    bool drawn_level[DRAWN_LABELS] = {false};
    int names = 0, lines = 0, missing = 0, skipped = 0;
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        const uint32_t rgb = svg_rgb(m->stroke);
        if (m->kind != SVG_PATH || m->used != DRAWN_NEW || m->curved || m->fill.a > 0 || m->stroke.a >= 1 ||
            (rgb != 0 && rgb != 0xFFFFFF) || m->count < 2 || !svg_inside(m->box, p->frame, 6))
            continue;
        const int level = level_of(d, p, m, like, q);
        if (level < 0) {
            skipped++;
            continue;
        }
        const double height = d->bar->box.y1 - d->bar->box.y0;
        const double share = (d->bar->box.y1 - d->value.px[level]) / height;
        assert_false(drawn_level[level]);
        drawn_level[level] = true;
        check_ends(d, m, image, d->value.px[level]);
        if (fabs(share - 0.6) > 0.01)
            assert_int_equal(rgb, share < 0.6 ? 0xFFFFFF : 0);
        lines++;
    }
    for (int k = 0; k < d->value.labels; k++) {
        /* Small panels have a line at every second label of the bar. */
        missing = drawn_level[k] || !is_crossed(d, image, d->value.px[k]) ? 0 : missing + 1;
        if (missing > (d->panel_count > 1) + skipped)
            fail_msg("no line at %s in '%s'", d->value.at[k]->text, p->heading);
        const svg_mark *words = drawn_words(d, p->frame, d->value.at[k]->text);
        double lo, hi;
        if (words == NULL)
            continue;
        const svg_point middle = {svg_middle_x(words->box), words->at.y - 0.36 * words->size, false};
        assert_int_equal(svg_rgb(words->fill), 0);
        if (around(p, like, q, middle, 5, &lo, &hi))
            assert_true(lo <= drawn_number(words->text) && drawn_number(words->text) <= hi);
        else
            assert_true(skipped > 0);
        assert_true(drawn_level[k] || skipped > 0);
        assert_true(words > d->svg->marks && words[-1].curved && svg_rgb(words[-1].stroke) == 0xFFFFFF);
        names++;
    }
    assert_true(lines >= 2 && names >= 2 && names <= lines + skipped);
}

/* ---- The camera and the holes ------------------------------------------------------------------------------------ */

static void check_camera(const drawn *d, const drawn_panel *p, const dp_setup *setup) {
    drawn_marker all[16];
    const bool infinite = isinf(setup->spec.zfar);
    assert_int_equal(drawn_markers(d, p, all, 16), 1);
    assert_int_equal(all[0].shape, DRAWN_DISC);
    assert_int_equal(all[0].inside, d->theme->text);
    assert_int_equal(all[0].rim, d->theme->background);
    assert_px(all[0].x, drawn_px(&p->x, setup->spec.znear), 1.2);
    assert_px(all[0].y, infinite ? p->frame.y0 : drawn_px(&p->y, setup->spec.zfar), 1.2);
    assert_true(drawn_alike(&all[0], &d->entries[0].marker)); /* the legend says what it is */
}

/* Slanted lines on their own ground below the colours. */
static bool is_hatched(const drawn *d, const drawn_panel *p, const svg_mark *image) {
    bool ground = false, lines = false;
    for (const svg_mark *m = d->svg->marks; m < image; m++) {
        ground = ground || (m->kind == SVG_PATH && m->fill.a == 1 && svg_rgb(m->fill) == d->theme->empty &&
                            svg_inside(p->frame, m->box, 1) && svg_inside(m->box, p->frame, 1));
        lines = lines || (m->kind == SVG_PATH && m->stroke.a > 0 && m->stroke.a < 1 && m->count > 20 &&
                          svg_rgb(m->stroke) == d->theme->frame && m->points[0].x < m->points[1].x &&
                          m->points[0].y > m->points[1].y && svg_inside(p->frame, m->box, 1));
    }
    return ground && lines;
}

/* ---- Whole figures ----------------------------------------------------------------------------------------------- */

static void check_words(const drawn *d, const map_case *q, const cameras *c) {
    char subtitle[192], camera[80], shown[512] = "";
    snprintf(camera, sizeof camera, "camera asked about: near 0.1, far %g", q->zfar);
    snprintf(subtitle, sizeof subtitle, "%s%snear 0.1, far %g, perspective, nearest, exact (lattice of codes)%s",
             c->count == 1 ? c->names[0] : "", c->count == 1 ? ", " : "", q->zfar,
             isnan(q->lo)     ? ""
             : q->lo == q->hi ? ", at depth 100. Hatched: does not see that depth"
                              : ", depths 1 to 100. Hatched: does not see those depths");
    if (isinf(q->zfar))
        strcat(subtitle, ". Hatched: far is not behind near");
    assert_string_equal(d->subtitle, subtitle);
    assert_string_equal(d->title, q->lo != q->hi ? "Worst z-fighting interval for each near and far plane"
                                                 : "Z-fighting interval at depth 100 for each near and far plane");
    assert_string_equal(d->x_caption->text, "near plane (scene units)");
    assert_string_equal(d->y_caption->text, "far plane (scene units)");
    assert_string_equal(d->right_caption->text, q->lo != q->hi ? "worst z-fighting interval (scene units)"
                                                               : "z-fighting interval (scene units)");
    for (size_t i = 0; i < c->count; i++)
        snprintf(shown + strlen(shown), sizeof shown - strlen(shown), "%s%s%s Shown: camera.", c->count > 1 ? " " : "",
                 c->count > 1 ? c->names[i] : "", c->count > 1 ? "." : "");
    drawn_description_is(d, shown);
    drawn_legend_is(d, 1, (const char *const[]){camera});
}

static void check_figure(const map_case *q) {
    cameras c = cameras_of(drawn_camera(0.1, q->zfar), q->formats, q->mappings);
    drawn *d =
        drawn_run(q->look, "plot map -n 0.1 -f %g -F %s -m %s %s", q->zfar, q->formats, q->mappings, q->arguments);
    check_words(d, q, &c);
    assert_int_equal(d->panel_count, c.count);
    drawn_bar_is_viridis(d);
    assert_true(d->value.log);
    for (size_t i = 0; i < c.count; i++) {
        const drawn_panel *p = &d->panels[i];
        const svg_mark *image = drawn_map_image(d, p);
        bool holes = false;
        assert_string_equal(p->heading, c.count > 1 ? c.names[i] : "");
        assert_true(p->x.log && p->y.log);
        assert_px(drawn_px(&p->x, 0.001), p->frame.x0, 1.5);
        assert_px(drawn_px(&p->x, 10), p->frame.x1, 1.5);
        assert_px(drawn_px(&p->y, isinf(q->zfar) ? 1 : 10), p->frame.y1, 1.5);
        assert_px(drawn_px(&p->y, isinf(q->zfar) ? 1e6 : 1e5), p->frame.y0, 1.5);
        check_fields(d, p, image, &c.setups[i], q, &holes);
        check_contours(d, p, image, &c.setups[i], q);
        check_camera(d, p, &c.setups[i]);
        assert_int_equal(is_hatched(d, p, image), holes);
        assert_int_equal(holes, !isnan(q->lo) || isinf(q->zfar));
    }
    drawn_bar_is_used(d);
    drawn_close(d);
}

TEST(colours_are_values) {
    static const map_case cases[] = {
        {"unorm24,fp32", "d3d,reversed", "", 1000, NAN, NAN, &drawn_light},
        {"unorm24", "d3d", "--at 100", 1000, 100, 100, &drawn_light},
        {"unorm24", "d3d", "--at 100 --tolerance 1%", 1000, 100, 100, &drawn_light},
        {"unorm24", "reversed", "--range 1:100", 1000, 1, 100, &drawn_light},
        {"fp32", "reversed", "--theme dark", INFINITY, NAN, NAN, &drawn_dark},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check_figure(&cases[i]);
    assert_true(borders >= 8);
}
