/* SPDX-License-Identifier: GPL-3.0-or-later */
/* scene: the fights of a house whose fights are known, what only looks like one, and the house that is mended. */

#include <png.h>

#include "printed.h"

#define CAMERA "-n 0.05 -F d24 -m d3d --viewport 960x540 --fov 20.7 --within 60"
#define HOUSE  "tests/models/house.gltf"
#define LIFTED "tests/models/house-lifted.gltf"

/* By the rows of house.sh: which node lies on which, how far above it, and how much of it. */
static const struct {
    const char *below, *above, *lifted; /* the last: null where another row's does it */
    double gap, area;                   /* m, m^2 */
} fights[] = {
    {"terrain street", "garden west", "garden west", 0.001, 40 * 1},
    {"terrain street", "garden east", "garden east", 0.001, 40 * 1},
    {"terrain street", "road", "road", 0.002, 80 * 6},
    {"terrain street", "marking", NULL, 0.003, 80 * 0.3},
    {"road", "marking", "marking", 0.001, 80 * 0.3},
    {"slab", "parquet", "parquet", 0.002, 11 * 7},
    {"front wall", "door", "door", 0, 1 * 2},
    {"front wall", "shutters", "shutters", 0.0015, 4 * 0.5 * 1.25},
    {"front wall", "poster", "poster", 0.001, 1 * 1.4},
    {"front wall", "frame", "frame", 0.002, 1.2 * 0.9},
    {"front wall", "picture", NULL, 0.003, 0.8 * 1.2 * 0.8 * 0.9},
    {"frame", "picture", "picture", 0.001, 0.8 * 1.2 * 0.8 * 0.9},
    {"roof front", "solar", "solar", 0.0015, 0.4 * 13 * 0.5 * 6},
    {"terrace", "tiles", "tiles", 0.001, 5.5 * 3},
    {"terrace", "railing", "railing", 0, 5 * 0.1 * 0.1},
    {"wing body", "wing poster", "wing poster", 0.00125, 1.5 * 1},
    {"fence", "ivy", "ivy", 0.001, 0.5 * 6 * 0.9 * 1.2},
};
enum { FIGHTS = sizeof fights / sizeof fights[0] };

/* Surfaces as near that fight nowhere, with the filter that knows it; null: two that only meet at an edge. */
static const struct {
    const char *filter, *a, *b;
} harmless[] = {
    {"facing", "skirt west", "skirt east"}, /* back to back */
    {"facing", "slab", "front wall"},       /* stands on it */
    {"facing", "chimney", "chimney cap"},   /* lies on it */
    {"facing", "railing", "handrail"},      /* lies on all of them, flush with their fronts */
    {"facing", "wing body", "wing roof"},   /* lies on it, mirrored */
    {"blended", "front wall", "windows"},   /* glass */
    {"hidden", "beam", "conduit"},          /* flush, within the pillar */
    {NULL, "garden west", "garden east"},   {NULL, "west wall", "west gable"},
};
enum { HARMLESS = sizeof harmless / sizeof harmless[0] };

static json_t *judged(const char *path, const char *options, int status) {
    return json_printed(status, "scene %s " CAMERA " %s", path, options);
}

/* The one finding of two nodes, in the order of the file; null where there is none. */
static const json_t *finding_of(const json_t *root, const char *a, const char *b) {
    const json_t *list = node_at(root, "findings"), *found = NULL;
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *f = json_array_get(list, i);
        if (strcmp(text_at(f, "a.node"), a) != 0 || strcmp(text_at(f, "b.node"), b) != 0)
            continue;
        assert_null(found);
        found = f;
    }
    return found;
}

/* The output of the script: as `name`, in the folder of this run. */
static const char *make_house(const char *name, const char *lifts) {
    const char *path = scratch_file(name);
    char line[4096];
    snprintf(line, sizeof line, "sh tests/models/house.sh %s >%s", lifts, path);
    assert_int_equal(system(line), 0);
    return path;
}

/* A model that is read everywhere else is the one that the script makes; RECORD=1 writes it. */
static void same_text(const char *path, const char *made) {
    char line[1024];
    snprintf(line, sizeof line, "%s %s %s", getenv("RECORD") != NULL ? "cp" : "cmp", made, path);
    assert_int_equal(system(line), 0);
}

TEST(made) {
    same_text(HOUSE, make_house("made.gltf", ""));
    assert_int_not_equal(system("sh tests/models/house.sh chimney=1 >/dev/null 2>&1"), 0);
    assert_int_not_equal(system("sh tests/models/house.sh dor=1 >/dev/null 2>&1"), 0);
}

/* Just these, with their gaps and areas, however the transforms are rounded: in binary32 to a few of its steps. */
TEST(known) {
    static const struct {
        const char *options;
        double step; /* of the extent */
    } rows[] = {{"", 1e-12}, {"--threads 1", 1e-12}, {"--transforms binary32", 0x1p-22}};
    for (size_t r = 0; r < sizeof rows / sizeof rows[0]; r++) {
        json_t *root = judged(HOUSE, rows[r].options, 1);
        const double extent = number_at(root, "extent"), off = rows[r].step * extent;
        assert_int_equal(json_array_size(node_at(root, "findings")), FIGHTS);
        assert_true(extent > 80 && extent < 120); /* of the terrain, mostly */
        for (size_t i = 0; i < FIGHTS; i++) {
            const json_t *f = finding_of(root, fights[i].below, fights[i].above);
            if (f == NULL)
                fail_msg("%s: '%s' and '%s' are not found", rows[r].options, fights[i].below, fights[i].above);
            assert_scene(number_at(f, "gap_min"), fights[i].gap, off);
            assert_scene(number_at(f, "gap_max"), fights[i].gap, off);
            assert_scene(number_at(f, "area"), fights[i].area, off * extent);
            assert_true(json_is_true(node_at(f, "fights")));
        }
        json_decref(root);
    }
}

/* Harmless pairs are there, within the gap, and left out by the filter that is meant. */
TEST(left_out) {
    for (size_t i = 0; i < HARMLESS; i++) {
        char options[64] = "";
        if (harmless[i].filter != NULL)
            snprintf(options, sizeof options, "--also %s", harmless[i].filter);
        json_t *root = judged(HOUSE, options, 1);
        const json_t *f = finding_of(root, harmless[i].a, harmless[i].b);
        if ((f != NULL) != (harmless[i].filter != NULL))
            fail_msg("'%s' and '%s' with '%s'", harmless[i].a, harmless[i].b, options);
        json_decref(root);
    }
    static const char *const also[] = {"", "facing", "blended", "hidden"}; /* each is counted but where it is off */
    for (size_t i = 0; i < sizeof also / sizeof also[0]; i++) {
        json_t *root = json_printed(-1, "scene " HOUSE " -F d24 -m d3d%s%s", i > 0 ? " --also " : "", also[i]);
        for (size_t k = 1; k < sizeof also / sizeof also[0]; k++)
            assert_int_equal(number_at(root, "left_out.%s", also[k]) > 0, i != k);
        assert_true(number_at(root, "left_out.thin") > 0 && number_at(root, "left_out.degenerate") == 0);
        json_decref(root);
    }
}

/* The lifts that are said, rounded up to tenths of a millimetre, as arguments of the script. */
static void lifts_of(const json_t *root, char *out, size_t size) {
    size_t used = 0;
    for (size_t i = 0; i < FIGHTS; i++) {
        const json_t *f = finding_of(root, fights[i].below, fights[i].above);
        assert_non_null(f);
        if (fights[i].lifted == NULL)
            continue;
        used += (size_t)snprintf(out + used, size - used, " '%s=%.4f'", fights[i].lifted,
                                 ceil(number_at(f, "lift") * 1e4) / 1e4);
        assert_true(used < size);
    }
}

/* Moved as far as is said nothing is found that near, and what is found farther off passes; by less it fights. */
TEST(mended) {
    char lifts[2048];
    json_t *root = judged(HOUSE, "", 1);
    const double need = number_at(finding_of(root, "front wall", "door"), "lift");
    lifts_of(root, lifts, sizeof lifts);
    json_decref(root);
    same_text(LIFTED, make_house("lifted.gltf", lifts));
    root = judged(LIFTED, "", 0);
    assert_int_equal(json_array_size(node_at(root, "findings")), 0);
    assert_true(json_is_true(node_at(root, "passed")));
    json_decref(root);
    root = judged(LIFTED, "--separation 0.06", 0);
    for (size_t i = 0; i < FIGHTS; i++) {
        const json_t *f = finding_of(root, fights[i].below, fights[i].above);
        if (fights[i].lifted == NULL)
            continue;
        assert_non_null(f);
        assert_true(number_at(f, "gap_min") >= need && number_at(f, "gap_max") < need + 1.1e-4);
        assert_true(json_is_false(node_at(f, "fights")) && number_at(f, "certain_to") >= 60);
    }
    json_decref(root);
    strcat(lifts, " tiles=0.044"); /* the last one counts */
    root = judged(make_house("less.gltf", lifts), "", 1);
    assert_int_equal(json_array_size(node_at(root, "findings")), 1);
    assert_non_null(finding_of(root, "terrace", "tiles"));
    json_decref(root);
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static unsigned char *read_png(const char *path, size_t *pixels, size_t *red) {
    png_image head = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&head, path));
    head.format = PNG_FORMAT_RGB;
    unsigned char *rgb = malloc(PNG_IMAGE_SIZE(head));
    assert_true(rgb != NULL && png_image_finish_read(&head, NULL, rgb, 0, NULL));
    *pixels = (size_t)head.width * head.height;
    *red = 0;
    for (size_t i = 0; i < *pixels; i++)
        *red += rgb[3 * i] == 255 && rgb[3 * i + 1] == 0 && rgb[3 * i + 2] == 0;
    return rgb;
}

/* Draws a picture of the gallery by its recipe: the same pixels. What it says of those that are wrong. */
static json_t *drawn(const char *name) {
    const char *made = scratch_file("drawn.png");
    char *recipes = text_of_file("plots/recipes"), kept[64], line[64];
    snprintf(line, sizeof line, "\n%s ", name);
    char *arguments = strstr(recipes, line);
    assert_non_null(arguments);
    arguments = strstr(arguments, "render ");
    assert_non_null(arguments);
    arguments += strlen("render ");
    arguments[strcspn(arguments, "\n")] = '\0';
    snprintf(kept, sizeof kept, "plots/%s.png", name);
    json_t *root = json_printed(0, "scene %s --render %s", arguments, made);
    size_t pixels, red, as_many, as_red;
    unsigned char *want = read_png(kept, &pixels, &red), *got = read_png(made, &as_many, &as_red);
    assert_true(pixels == as_many && memcmp(want, got, 3 * pixels) == 0);
    assert_true(number_at(root, "render.wrong_pixels") == (double)red);
    free(want);
    free(got);
    free(recipes);
    return root;
}

/* Before, each fight is wrong in some pixels, but that behind the walls; after, none is. The camera is the file's. */
TEST(pictures) {
    json_t *root = drawn("house");
    const double before = number_at(root, "render.wrong_pixels");
    assert_true(number_at(root, "render.eye.x") == -20 && number_at(root, "render.eye.y") == 17 &&
                number_at(root, "render.eye.z") == 50);
    assert_relative(number_at(root, "render.fov"), 0.36 * 180 / 3.14159265358979324, 1e-12);
    for (size_t i = 0; i < FIGHTS; i++) {
        const double wrong = number_at(finding_of(root, fights[i].below, fights[i].above), "wrong_pixels");
        const bool behind = strcmp(fights[i].above, "parquet") == 0;
        if (fights[i].lifted != NULL && (wrong > 0) == behind)
            fail_msg("'%s' and '%s': %g pixels", fights[i].below, fights[i].above, wrong);
    }
    json_decref(root);
    root = drawn("house-lifted");
    assert_true(before > 10000 && number_at(root, "render.wrong_pixels") == 0);
    json_decref(root);
}

/* The same from an eye: by `share` of what it asks for, which of a surface over two others is the most of both. */
static int status_from_street(double share) {
    json_t *root = json_printed(1, "scene " HOUSE " -F d24 -m d3d --camera street --within 60");
    char lifts[2048];
    size_t used = 0;
    for (size_t i = 0; i < FIGHTS; i++) {
        double lift = 0;
        for (size_t k = 0; k < FIGHTS; k++)
            if (strcmp(fights[k].above, fights[i].above) == 0)
                lift = fmax(lift, number_at(finding_of(root, fights[k].below, fights[k].above), "lift"));
        used += (size_t)snprintf(lifts + used, sizeof lifts - used, " '%s=%.6f'", fights[i].above, share * lift);
        assert_true(used < sizeof lifts);
    }
    json_decref(root);
    printed p = print_of("scene %s -F d24 -m d3d --camera street --within 60", make_house("street.gltf", lifts));
    const int status = p.status;
    printed_free(&p);
    return status;
}

/* A moved model is seen from elsewhere, by some thousandths. */
TEST(mended_from_street) {
    assert_int_equal(status_from_street(1.01), 0);
    assert_int_equal(status_from_street(0.9), 1);
}

/* From an eye that is farther off than the model is large, what is not said reaches as far as the eye sees: each lift
 * is for the farthest place. */
TEST(far_off) {
    json_t *root = json_printed(-1, "scene " HOUSE " -F d24 -m d3d --eye 0,50,400 --look 0,0,0");
    const json_t *list = node_at(root, "findings");
    const double within = number_at(root, "within");
    size_t fighting = 0;
    assert_true(within > 400 && within < 450); /* the terrain ends at z = -21 */
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *f = json_array_get(list, i);
        if (!json_is_number(node_at(f, "fights_from")))
            continue;
        fighting++;
        assert_true(number_at(f, "seen_to") <= within && number_at(f, "lift") > 0);
    }
    assert_true(fighting > FIGHTS);
    json_decref(root);
}

/* In words: the rounding of the transforms makes no gap where there is none, nor two of one. */
TEST(in_words) {
    printed p = print_of("scene " HOUSE " -n 0.05 -F d24 -m d3d --viewport 960x540 --fov 23 --within 60 --unit m");
    const char *door = strstr(p.out, "'front wall' (plaster) and 'door' (oak)");
    const char *poster = strstr(p.out, "'front wall' (plaster) and 'poster' (paper)");
    assert_non_null(door);
    assert_non_null(poster);
    const char *one_plane = strstr(door, "coplanar\n"), *gap = strstr(poster, "; 0.001 m apart\n");
    assert_true(one_plane != NULL && one_plane < strstr(door, "area"));
    assert_true(gap != NULL && gap < strstr(poster, "area"));
    printed_free(&p);
}
