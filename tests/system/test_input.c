/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which files are read: by device and number together, on systems of files that number theirs alike. */
#include "support.h"
#include "system/posix.h"

/* A name is "DEVICE.NUMBER", of a file; of a device that begins with "d". */
static int named(const char *path, struct stat *of) {
    unsigned device, number;
    *of = (struct stat){.st_mode = *path == 'd' ? S_IFCHR : S_IFREG};
    if (sscanf(path + (*path == 'd'), "%u.%u", &device, &number) != 2)
        return -1;
    of->st_dev = device;
    of->st_ino = number;
    return 0;
}

#define stat(path, of)    named(path, of)
#define fstat(stream, of) ((void)(stream), named(opened, of))
#define fopen(path, mode) (opened = (path), (fopen)("/dev/null", mode))
static const char *opened;

#include "system/input.c"

TEST(identities) {
    enum { SIDE = 12 };
    char path[SIDE * SIDE][16];
    bool read[SIDE * SIDE] = {false};
    rng r = rng_make("identities");
    for (int i = 0; i < SIDE * SIDE; i++)
        snprintf(path[i], sizeof path[i], "%d.%d", i / SIDE, i % SIDE);
    for (int round = 0; round < 3; round++) {
        for (int turn = 0; turn < SIDE * SIDE / 2; turn++) {
            const uint64_t one = rng_below(&r, SIDE * SIDE);
            read[one] = true;
            if (turn % 2 == 0)
                input_expect(path[one]);
            else
                input_close(input_open(path[one]));
            for (int i = 0; i < SIDE * SIDE; i++)
                assert_int_equal(input_is_read(path[i]), read[i]);
        }
        input_forget();
        memset(read, 0, sizeof read);
    }
}

/* Files that are not lost by being written to, stdin, and what is not there. */
TEST(never_known) {
    input_expect("d1.2");
    input_close(input_open("d3.4"));
    input_expect("gone");
    assert_false(input_is_read("d1.2") || input_is_read("d3.4") || input_is_read("1.2") || input_is_read("3.4"));
    assert_false(input_is_read("-") || input_is_read("gone"));
}
