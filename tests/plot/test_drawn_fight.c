/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fight as drawn: what each pixel shows against the wall, its stripes and the decal as places on a plane, which the
 * test finds by itself; the gap against the library; how much is wrong, counted in the picture. */
#include "depthprec/depthprec.h"
#include "drawn.h"
#include "drawn_map.h"
#include "raster/raster.h"
#include "support.h"

static const double pi = 3.14159265358979323846;

typedef struct fight_case {
    const char *arguments, *subtitle;
    const char *format, *arith, *raster, *unit;
    dp_mapping mapping;
    double zfar, at, slant, azimuth;
    int width, height, columns, rows; /* of the view, and of what is shown */
    const drawn_theme *look;
} fight_case;

static const fight_case cases[] = {
    {"",
     "unorm24 d3d, near 0.1, far 1000, perspective, nearest, float mesa, at depth 10; llvmpipe at 1920 x 1080, field "
     "of "
     "view 60\u00b0, slant 60\u00b0",
     "unorm24", "mesa", "llvmpipe", "", DP_MAPPING_D3D, 1000, 10, 60, 45, 1920, 1080, 120, 90, &drawn_light},
    {"-F fp32 -m reversed -f inf --at 5000 --raster swiftshader --unit m --slant 70,-120 --theme dark",
     "fp32 reversed, near 0.1, far inf, perspective, nearest, float mesa, at depth 5000, lengths in m; swiftshader at "
     "1920 x 1080, field of view 60\u00b0, slant 70\u00b0",
     "fp32", "mesa", "swiftshader", " m", DP_MAPPING_REVERSED, INFINITY, 5000, 70, -120, 1920, 1080, 120, 90,
     &drawn_dark},
    {"-F unorm16 -m gl --at 20 --viewport 301x80 --slant 20,90",
     "unorm16 gl, near 0.1, far 1000, perspective, nearest, float mesa-remap, at depth 20; llvmpipe at 301 x 80, field "
     "of view 60\u00b0, slant 20\u00b0",
     "unorm16", "mesa-remap", "llvmpipe", "", DP_MAPPING_GL, 1000, 20, 20, 90, 301, 80, 120, 40, &drawn_light},
};

typedef struct vector {
    double x, y, z;
} vector;

static double dot(vector a, vector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static vector normal_of(const fight_case *c) {
    const double slant = c->slant * pi / 180, azimuth = c->azimuth * pi / 180;
    return (vector){sin(slant) * cos(azimuth), sin(slant) * sin(azimuth), cos(slant)};
}

/* Where the ray of a place of the view, pixels from its upper left corner, meets the wall. */
static vector seen(const fight_case *c, double column, double row) {
    const double half = tan(pi / 6);
    const vector ray = {half * (2 * column - c->width) / c->height, half * (1 - 2 * row / c->height), 1};
    const vector n = normal_of(c);
    const double z = c->at * n.z / dot(n, ray);
    return (vector){ray.x * z, ray.y * z, z};
}

static double guaranteed(const fight_case *c, double z) {
    dp_spec spec = dp_spec_default();
    dp_format formats[2];
    dp_setup setup;
    dp_budget b;
    assert_int_equal(dp_format_parse(c->format, formats), 1);
    assert_int_equal(dp_arith_parse(c->arith, &spec.arith), DP_OK);
    spec.format = formats[0];
    spec.mapping = c->mapping;
    spec.zfar = c->zfar;
    spec.triangles = dp_triangles_default();
    raster_describe(raster_find(c->raster), &spec.triangles);
    spec.triangles.width = c->width;
    spec.triangles.height = c->height;
    spec.triangles.slant_lo = spec.triangles.slant_hi = c->slant;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_budget_at(&setup, z, NULL, &b), DP_OK);
    return b.separation;
}

static uint32_t colour_of(const drawn *d, const char *name) {
    const drawn_entry *e = drawn_legend(d, name);
    assert_non_null(e->area);
    return 0xFF000000u | svg_rgb(e->area->fill);
}

/* The heading says, "GAP, SHARE of the guarantee: PERCENT % wrong", without a share that is 1: they are powers of
 * two. */
static double gap_of(const fight_case *c, const drawn_panel *p, double *share) {
    const int left = (c->width - c->columns) / 2, low = (c->height - c->rows) / 2;
    double least = 0;
    for (int corner = 0; corner < 4; corner++)
        least = fmax(least, guaranteed(c, seen(c, left + (corner & 1) * c->columns, low + (corner >> 1) * c->rows).z));
    *share = exp2(rint(log2(strtod(p->heading, NULL) / least)));
    return *share * least;
}

/* Every pixel of the decal is known in unorm16, but where a code ends: it is wrong where both have one. */
static bool is_wrong(const fight_case *c, double z, double gap, bool *known) {
    const double distance = c->at * normal_of(c).z, n = 0.1;
    const double depths[2] = {z, z * (distance - gap) / distance};
    double code[2];
    *known = strcmp(c->format, "unorm16") == 0;
    for (int k = 0; k < 2; k++) {
        const double exact = 65535 * (1 - n / depths[k]) / (1 - n / c->zfar);
        code[k] = floor(exact + 0.5);
        *known = *known && fabs(exact - code[k]) < 0.45;
    }
    return code[0] == code[1];
}

/* Counts in one panel the pixels of the decal, and those of them that show the wall. */
static void check_pixels(const fight_case *c, const drawn *d, const drawn_panel *p, double gap, int *covered,
                         int *wrong) {
    const int left = (c->width - c->columns) / 2, low = (c->height - c->rows) / 2;
    const int top = c->height - low - c->rows;
    const uint32_t wall[2] = {colour_of(d, "wall"), colour_of(d, "its stripes")};
    const uint32_t decal = colour_of(d, "decal in front of it");
    const double azimuth = c->azimuth * pi / 180;
    const vector across = {-sin(azimuth), cos(azimuth), 0};
    const double radius = 0.6 * c->rows * c->at * 2 * tan(pi / 6) / c->height;
    const svg_mark *image = drawn_map_image(d, p);
    tally t = {.name = c->arguments};
    assert_true(image->columns == 4 * c->columns && image->rows == 4 * c->rows);
    for (int y = 0; y < c->rows; y++)
        for (int x = 0; x < c->columns; x++) {
            const double column = left + x + 0.5, row = top + y + 0.5;
            const vector at = seen(c, column, row), off = {at.x, at.y, at.z - c->at};
            const double away = sqrt(dot(off, off)) / radius, stripe = dot(off, across) / radius * 4;
            const bool inside = away < 1, either = fabs(away - 1) < 1e-4;
            const svg_point place = {drawn_px(&p->x, column), drawn_px(&p->y, row), false};
            const uint32_t got = drawn_map_pixel(image, place);
            const bool is_wall = got == wall[0] || got == wall[1];
            bool known;
            const bool hidden = is_wrong(c, at.z, gap, &known);
            if (fabs(stripe - rint(stripe)) > 1e-3 && is_wall)
                TALLY(&t, got == wall[(int)floor(stripe) & 1], "%g, %g: stripe %g is %06x", column, row, stripe, got);
            if (known && inside && !either)
                TALLY(&t, is_wall == hidden, "%g, %g: shows %06x", column, row, got);
            TALLY(&t, is_wall || (got == decal && (inside || either)), "%g, %g shows %06x", column, row, got);
            *covered += inside;
            *wrong += inside && is_wall;
        }
    tally_end(&t);
}

TEST(test_fight) {
    static const char *const legend[] = {"wall", "its stripes", "decal in front of it"};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const fight_case *c = &cases[i];
        drawn *d = drawn_run(c->look, "plot fight %s", c->arguments);
        assert_string_equal(d->title, "Z-fighting of a wall and a decal, as rasterized");
        assert_string_equal(d->subtitle, c->subtitle);
        drawn_legend_is(d, 3, legend);
        assert_int_equal(d->panel_count, 2);
        assert_null(d->bar);
        for (int k = 0; k < 2; k++) {
            const drawn_panel *p = &d->panels[k];
            int covered = 0, wrong = 0;
            double share;
            char part[32];
            char want[SVG_TEXT];
            const double gap = gap_of(c, p, &share);
            check_pixels(c, d, p, gap, &covered, &wrong);
            const double percent = 100.0 * wrong / covered;
            snprintf(part, sizeof part, "%.3g of ", share);
            snprintf(want, sizeof want, "%.3g%s, %sthe guarantee: %.2g %% wrong", gap, c->unit, k == 1 ? "" : part,
                     percent);
            assert_string_equal(p->heading, want);
            assert_true(k == 1 ? share == 1 && wrong == 0 : share <= 0.5 && percent >= 10);
        }
        drawn_close(d);
    }
}

/* The numbers are those of the picture: 0 wall, 1 stripe, 2 decal. */
TEST(test_numbers) {
    static const char *const names[] = {"wall", "its stripes", "decal in front of it"};
    drawn *d = drawn_run(&drawn_light, "plot fight");
    char *csv = drawn_output("plot fight --csv");
    int lines = 0;
    char *line = strtok(csv, "\r\n");
    assert_string_equal(line, "panel,series,column [px],row [px],shown");
    for (line = strtok(NULL, "\r\n"); line != NULL; line = strtok(NULL, "\r\n"), lines++) {
        const drawn_panel *p = &d->panels[lines / (120 * 90)];
        const char *rest = strstr(line, ",map,");
        double column, row;
        int shown;
        assert_non_null(rest);
        assert_int_equal(sscanf(rest, ",map,%lf,%lf,%d", &column, &row, &shown), 3);
        assert_in_range(shown, 0, 2);
        const svg_point place = {drawn_px(&p->x, column), drawn_px(&p->y, row), false};
        assert_int_equal(drawn_map_pixel(drawn_map_image(d, p), place), colour_of(d, names[shown]));
    }
    assert_int_equal(lines, 2 * 120 * 90);
    free(csv);
    drawn_close(d);
}
