/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a figure of a depth image holds for each of its fields: how much more a process needs for a figure of twice the
 * width. The figure itself is 4 bytes a pixel of it.
 */
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "image/image.h"
#include "printed.h"

enum { WIDTH = 2400, HEIGHT = 1350 };

static const char *make_image(void) {
    static char path[512];
    static uint32_t row[WIDTH];
    snprintf(path, sizeof path, "%s", scratch_file("in.npy"));
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    image_writer *w = image_writer_open(file, IMAGE_NPY, IMAGE_U32, WIDTH, HEIGHT, 1, NULL);
    assert_non_null(w);
    for (uint32_t y = 0; y < HEIGHT; y++) {
        for (uint32_t x = 0; x < WIDTH; x++)
            row[x] = 16600000 + x + y % 97;
        image_writer_rows(w, row, 1);
    }
    assert_true(image_writer_close(w) && fclose(file) == 0);
    return path;
}

/* The most bytes that the program held. */
static double memory_of(const char *path, int width) {
    struct rusage used;
    int status;
    const char *program = getenv("DEPTHPREC");
    const char *figure = scratch_file("figure.png");
    char size[16];
    snprintf(size, sizeof size, "%d", width);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        execl(program, "depthprec", "texture", path, "-n", "0.1", "-f", "1000", "-F", "unorm24", "-m", "d3d", "-q",
              "--threads", "1", "--figure", figure, "--figure-size", size, (char *)NULL);
        _exit(127);
    }
    assert_int_equal(wait4(child, &status, 0, &used), child);
    assert_int_equal(status, 0);
    return 1024.0 * (double)used.ru_maxrss;
}

TEST(bytes_a_field) {
#ifdef __SANITIZE_ADDRESS__
    skip(); /* it keeps what is freed */
#endif
    if (getenv("DEPTHPREC") == NULL)
        skip();
    const char *path = make_image();
    const double more = memory_of(path, WIDTH) - memory_of(path, WIDTH / 2);
    const double fields = 0.75 * WIDTH * HEIGHT;
    printf("# %.1f bytes a field more\n", more / fields);
    assert_true(more < 16 * fields);
}
