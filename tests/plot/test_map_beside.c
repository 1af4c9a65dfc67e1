/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An error map beside its product: each file is what it is when it is written alone, in every kind of file, whichever
 * row a kind begins with; and what fails leaves neither.
 */
#include <unistd.h>

#include "support.h"
#include "truth.h"

enum { SIZE_MAX_READ = 1 << 20 };
static const char *const scene[] = {"--synthetic", "sphere", "--size", "97x61", "-F", "unorm24", "-m", "d3d", "-q"};

static size_t contents(const char *name, char *out) {
    FILE *const file = fopen(truth_path(name), "rb");
    assert_non_null(file);
    const size_t size = fread(out, 1, SIZE_MAX_READ, file);
    fclose(file);
    assert_true(size > 100 && size < SIZE_MAX_READ);
    return size;
}

static void assert_same_file(const char *a, const char *b) {
    static char one[SIZE_MAX_READ], other[SIZE_MAX_READ];
    const size_t size = contents(a, one);
    assert_int_equal(contents(b, other), size);
    assert_memory_equal(one, other, size);
}

static command start(const char *what, const char *file) {
    command c = {.count = 0};
    for (size_t i = 0; i < sizeof scene / sizeof scene[0]; i++)
        truth_add(&c, scene[i]);
    truth_add(&c, "--product");
    truth_add(&c, what);
    truth_add(&c, "-o");
    truth_add(&c, truth_path(file));
    return c;
}

static void run(const command *c) {
    assert_int_equal(truth_run(c->arguments, c->count), 0);
}

TEST(files_are_those_written_alone) {
    static const struct {
        const char *what, *both, *product, *map, *alone;
    } cases[] = {
        {"eye", "both.npy", "product.npy", "map.npy", "alone.npy"},
        {"linear01", "both.png", "product.png", "map.npy", "alone.npy"},
        {"raw", "both.npy", "product.npy", "map.png", "alone.png"},
        {"normal:projective", "both.png", "product.png", "map.png", "alone.png"},
        {"position:view", "both.pfm", "product.pfm", "map.npy", "alone.npy"},
        {"position:matrix", "both.npy", "product.npy", "map.pfm", "alone.pfm"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char option[256];
        snprintf(option, sizeof option, "--error-map=%s", truth_path(cases[i].map));
        command c = start(cases[i].what, cases[i].both);
        truth_add(&c, option);
        run(&c);
        c = start(cases[i].what, cases[i].product);
        run(&c);
        c = start(cases[i].what, cases[i].alone);
        truth_add(&c, "--error-map");
        run(&c);
        assert_same_file(cases[i].both, cases[i].product);
        assert_same_file(cases[i].map, cases[i].alone);
        const char *const made[] = {cases[i].both, cases[i].product, cases[i].map, cases[i].alone};
        for (size_t k = 0; k < 4; k++)
            unlink(truth_path(made[k]));
    }
}

TEST(what_fails_leaves_neither) {
    command c = start("eye", "both.npy");
    char option[256];
    snprintf(option, sizeof option, "--error-map=%s/map.npy", truth_path("nowhere"));
    truth_add(&c, option);
    assert_int_equal(truth_run(c.arguments, c.count), 3);
    assert_int_equal(access(truth_path("both.npy"), F_OK), -1);
}

int main(void) {
    return run_listed(truth_folder, truth_folder_end);
}
