/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The title of the figure of a texture's product: by its kind, by its method, and by what is known of the truth. */
#include "printed.h"

static const struct {
    const char *options, *of_scene, *of_image; /* titles; null: refused */
    const char *panels;
} products[] = {
    {"--product eye", "Eye depth", "Eye depth", ""},
    {"--product radial", "Distance from the camera", "Distance from the camera", ""},
    {"--product eye --error-map", "Error of eye depth", "Half of each cell of eye depth", ""},
    {"--product linear01", "Eye depth over far", "Eye depth over far", ""},
    {"--product linear01 --error-map", "Error of eye depth over far", "Half of each cell of eye depth over far", ""},
    {"--product raw", "Window depth beside eye depth over far, Linear01Depth",
     "Window depth beside eye depth over far, Linear01Depth", " window depth. eye depth over far."},
    {"--product raw --error-map", "Error of window depth", "Half of each cell of window depth", ""},
    {"--product position:rays", "Positions, method rays", "Positions, method rays",
     " x (world). y (world). z (world)."},
    {"--product position:exact", "Positions, method exact", "Positions, method exact",
     " x (world). y (world). z (world)."},
    {"--product position:rays --error-map", "Error of positions, method rays",
     "Largest possible error of positions, method rays", ""},
    {"--product normal:high", "Normals, method high", "Normals, method high", ""},
    {"--product normal:high --error-map", "Error of normals, method high",
     "Bound of the error on planes of normals, method high", ""},
    {"--product normal:projective --error-map", "Error of normals, method projective",
     "Bound of the error on planes of normals, method projective", ""},
    {"--product effect:fog", "Fog, density 1", "Fog, density 1", ""},
    {"--product effect:fog --error-map", "Largest possible error of fog, density 1",
     "Largest possible error of fog, density 1", ""},
};

static void check_title(tally *t, const char *source, const char *options, const char *title, const char *panels) {
    char expected[512];
    const char *path = scratch_file("figure.svg");
    printed p = print_of("texture %s %s --figure %s", source, options, path);
    TALLY(t, (p.status == 0) == (title != NULL), "%s %s: exit status %d: %s", source, options, p.status, p.errors);
    if (title != NULL && p.status == 0) {
        char *text = text_of_file(path);
        snprintf(expected, sizeof expected, "<title id=\"title\">%s</title>", title);
        TALLY(t, strstr(text, expected) != NULL, "%s %s: not '%s'", source, options, expected);
        snprintf(expected, sizeof expected, "%s</desc>", panels);
        TALLY(t, *panels == '\0' || strstr(text, expected) != NULL, "%s %s: not '%s'", source, options, expected);
        free(text);
    }
    printed_free(&p);
}

TEST(test_names) {
    tally t = {.name = "names"};
    const char *image = scratch_file("image.npy");
    printed p = print_of("texture --synthetic sphere --size 24x16 -F unorm16 -m d3d -o %s", image);
    assert_int_equal(p.status, 0);
    printed_free(&p);
    for (size_t i = 0; i < sizeof products / sizeof products[0]; i++) {
        check_title(&t, "--synthetic sphere --size 24x16", products[i].options, products[i].of_scene,
                    products[i].panels);
        check_title(&t, image, products[i].options, products[i].of_image, products[i].panels);
    }
    tally_end(&t);
}
