/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * EXR in every compression that the library on this machine writes, scanlines and tiles, halves, floats and whole
 * numbers: to the bit where nothing is lost, else it is said by name.
 */
#include "exr_made.h"
#include "printed.h"

enum { ACROSS = 61, DOWN = 37, ALL = ACROSS * DOWN };

/* Which types a compression changes: those of Imf::Compression's documentation. */
static const struct {
    const char *name;
    bool half, real;
} compressions[] = {{"none", false, false}, {"RLE", false, false},  {"ZIPS", false, false}, {"ZIP", false, false},
                    {"PIZ", false, false},  {"PXR24", false, true}, {"B44", true, false},   {"B44A", true, false},
                    {"DWAA", true, true},   {"DWAB", true, true}};
enum { COMPRESSIONS = sizeof compressions / sizeof compressions[0] };

/* Depths of a noisy plane, which no transform finds simple. */
static void draw(rng *r, image_type type, void *out) {
    for (size_t i = 0; i < ALL; i++) {
        const float real = (float)rng_uniform(r, 0.5, 0.75);
        if (type == IMAGE_U32)
            ((uint32_t *)out)[i] = (uint32_t)rng_below(r, 1 << 24);
        else if (type == IMAGE_F16)
            ((uint16_t *)out)[i] = (uint16_t)(0x3800 + rng_below(r, 0x200)); /* from 0.5 to 0.75, too */
        else
            ((float *)out)[i] = real;
    }
}

static size_t changed(const image *img, const void *samples) {
    const size_t size = image_type_size(img->type);
    size_t count = 0;
    for (size_t i = 0; i < ALL; i++)
        count += memcmp((const char *)img->data + i * size, (const char *)samples + i * size, size) != 0;
    return count;
}

static const image_type types[] = {IMAGE_U32, IMAGE_F16, IMAGE_F32};

TEST(in_every_compression) {
    static unsigned char samples[4 * ALL];
    rng r = rng_make("compressed EXR");
    uint64_t exact = 0, lossy = 0;
    for (int k = 0; k < COMPRESSIONS * 6; k++) {
        const int how = k / 6, tile = k % 2 * 16;
        const image_type type = types[k / 2 % 3];
        const exr_made of = {how, type, "R", tile, ACROSS, DOWN, samples};
        const bool changes = type == IMAGE_F16 ? compressions[how].half : type == IMAGE_F32 && compressions[how].real;
        image img;
        image_error error;
        draw(&r, type, samples);
        const char *path = scratch_file("made.exr");
        const char *wrong = exr_make(path, &of);
        if (wrong != NULL) {
            print_message("# skipped: %s of %s, %s\n", compressions[how].name, image_type_name(type), wrong);
            continue;
        }
        if (!image_read(path, &img, &error))
            fail_msg("%s of %s: %s", compressions[how].name, image_type_name(type), error.text);
        assert_int_equal(img.type, type);
        assert_true(img.width == ACROSS && img.height == DOWN && img.channels == 1);
        const size_t off = changed(&img, samples);
        if (changes) {
            assert_non_null(img.lossy);
            assert_string_equal(img.lossy, compressions[how].name);
            assert_true(off > ALL / 4);
            lossy++;
        } else {
            if (img.lossy != NULL || off > 0)
                fail_msg("%s of %s, tiles of %d: %zu samples changed, said to be by %s", compressions[how].name,
                         image_type_name(type), tile, off, img.lossy != NULL ? img.lossy : "none");
            exact++;
        }
        image_free(&img);
    }
    if (exact + lossy == 0)
        skip();
    print_message("# %llu files exact, %llu changed\n", (unsigned long long)exact, (unsigned long long)lossy);
    assert_true(exact >= 30 && lossy >= 6);
}

/* DWA, which some versions of the library neither write nor read: the error says what helps; or, read, which channels
 * it changes. */
TEST(made_by_dwa) {
    static const struct {
        const char *channel, *lossy;
        image_type type;
    } rows[] = {
        {"R", "DWAA", IMAGE_F16}, {"depth.R", "DWAA", IMAGE_F32}, {"Z", NULL, IMAGE_F32}, {"R", NULL, IMAGE_U32}};
    static unsigned char samples[4 * ALL];
    rng r = rng_make("DWA");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const exr_made of = {3, rows[i].type, rows[i].channel, 0, ACROSS, DOWN, samples};
        char command[1024];
        image img;
        image_error error;
        draw(&r, rows[i].type, samples);
        const char *folder = scratch_file("in.exr");
        if (exr_make(folder, &of) != NULL)
            skip();
        *strrchr(folder, '/') = '\0';
        snprintf(command, sizeof command, "cd '%s' && exrmaketiled -z dwaa in.exr dwa.exr >dwa.log 2>&1", folder);
        if (system(command) != 0) {
            print_message("# skipped: what exrmaketiled writes\n");
            skip();
        }
        if (!image_read(scratch_file("dwa.exr"), &img, &error)) {
            assert_non_null(strstr(error.text, "does not read its compression: save it with ZIP or PIZ"));
            continue;
        }
        assert_true((img.lossy == NULL) == (rows[i].lossy == NULL));
        assert_true(img.lossy == NULL || strcmp(img.lossy, rows[i].lossy) == 0);
        assert_true((changed(&img, samples) == 0) == (rows[i].lossy == NULL));
        image_free(&img);
    }
}

/* The program says it, on stderr and in what it reports. */
TEST(said_by_name) {
    static float samples[ALL];
    const exr_made lossy = {5, IMAGE_F32, "Z", 0, ACROSS, DOWN, samples},
                   exact = {3, IMAGE_F32, "Z", 0, ACROSS, DOWN, samples};
    rng r = rng_make("lossy");
    draw(&r, IMAGE_F32, samples);
    const char *path = scratch_file("lossy.exr");
    if (exr_make(path, &lossy) != NULL)
        skip();
    printed p = print_of("texture %s -F fp32 -m d3d", path);
    assert_int_equal(p.status, 0);
    assert_non_null(
        strstr(p.errors, "its compression, PXR24, may have changed the depths, which no error here counts"));
    assert_non_null(strstr(p.out, "compression   PXR24, which may have changed the depths"));
    printed_free(&p);
    p = print_of("texture %s -F fp32 -m d3d -q --json", path);
    assert_string_equal(p.errors, "");
    assert_non_null(strstr(p.out, "\"lossy\":\"PXR24\""));
    printed_free(&p);
    p = print_of("texture %s -F fp32 -m d3d --product eye -o %s.npy", path, path);
    assert_non_null(strstr(p.errors, "PXR24"));
    printed_free(&p);
    assert_null(exr_make(path, &exact));
    p = print_of("texture %s -F fp32 -m d3d", path);
    assert_null(strstr(p.errors, "compression"));
    assert_null(strstr(p.out, "compression"));
    printed_free(&p);
    check_says(-1, "\"lossy\":null", "texture %s -F fp32 -m d3d --json", path);
}
