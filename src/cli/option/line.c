/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options given on a line, and memory for what they are read into. */
#include <stdlib.h>
#include <string.h>

#include "cli/option/option.h"

const char *option_text(const asked_line *line, const char *name) {
    for (size_t i = 0; i < line->given_count; i++)
        if (strcmp(line->given[i].name, name) == 0)
            return line->given[i].text;
    return NULL;
}

void option_give(asked_line *line, const char *name, const char *text) {
    size_t i = 0;
    while (i < line->given_count && strcmp(line->given[i].name, name) != 0)
        i++;
    if (i == OPTIONS_GIVEN_MAX)
        return;
    line->given[i].name = name;
    line->given[i].text = text;
    line->given_count += i == line->given_count;
}

/* In front of each piece is the piece before it. */
void *asked_allocate(asked_line *line, size_t size) {
    union piece {
        union piece *before;
        double aligned;
    } *piece = calloc(1, sizeof *piece + size);
    if (piece == NULL)
        return NULL;
    piece->before = line->kept;
    line->kept = piece;
    return piece + 1;
}

void options_release(asked_line *line) {
    while (line->kept != NULL) {
        void *const piece = line->kept;
        memcpy(&line->kept, piece, sizeof line->kept);
        free(piece);
    }
    line->request = NULL;
}
