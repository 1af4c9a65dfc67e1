/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "system/input.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "system/posix.h"

typedef struct identity {
    uint64_t device, number;
} identity;

static identity *known; /* for as long as the program runs */
static size_t known_count, known_room;

static bool is_stdin(const char *path) {
    return strcmp(path, "-") == 0;
}

static bool knows(const struct stat *of) {
    for (size_t i = 0; i < known_count; i++)
        if (known[i].device == of->st_dev && known[i].number == of->st_ino)
            return true;
    return false;
}

/* A device or a pipe is not lost by being written to. */
static bool remember(const struct stat *of) {
    if (!S_ISREG(of->st_mode) || knows(of))
        return true;
    if (known_count == known_room) {
        const size_t room = known_room > 0 ? 2 * known_room : 16;
        identity *more = realloc(known, room * sizeof *more);
        if (more == NULL)
            return false;
        known = more;
        known_room = room;
    }
    known[known_count++] = (identity){of->st_dev, of->st_ino};
    return true;
}

FILE *input_open(const char *path) {
    struct stat of;
    FILE *in = is_stdin(path) ? stdin : fopen(path, "rb");
    if (in == NULL || fstat(fileno(in), &of) != 0 || remember(&of))
        return in;
    input_close(in);
    errno = ENOMEM;
    return NULL;
}

void input_close(FILE *in) {
    const int reason = errno;
    if (in != NULL && in != stdin)
        fclose(in);
    errno = reason;
}

void input_forget(void) {
    known_count = 0;
}

void input_expect(const char *path) {
    struct stat of;
    if ((is_stdin(path) ? fstat(fileno(stdin), &of) : stat(path, &of)) == 0)
        (void)remember(&of); /* without memory input_open() says so */
}

bool input_is_read(const char *path) {
    struct stat of;
    return !is_stdin(path) && stat(path, &of) == 0 && knows(&of);
}
