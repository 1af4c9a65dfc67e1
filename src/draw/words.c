/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/words.h"

#include <stdio.h>
#include <string.h>

#define ELLIPSIS "\u2026"

/* Shortens a line from its end, whole UTF-8 characters at a time, until it fits with an ellipsis. */
static void cut(const pencil *p, char line[WORDS_TEXT], const canvas_font *font, double width) {
    size_t length = strlen(line);
    if (length > WORDS_TEXT - sizeof ELLIPSIS)
        length = WORDS_TEXT - sizeof ELLIPSIS;
    do {
        while (length > 0 && (line[length] & 0xC0) == 0x80)
            length--;
        while (length > 0 && line[length - 1] == ' ')
            length--;
        memcpy(line + length, ELLIPSIS, sizeof ELLIPSIS);
    } while (length > 0 && canvas_text_width(p->c, line, font) > width && length-- > 0);
}

words words_break(const pencil *p, const char *text, const canvas_font *font, double width, size_t max_lines) {
    words w = {0};
    for (text += strspn(text, " "); *text != '\0' && w.count < max_lines; text += strspn(text, " ")) {
        char *line = w.lines[w.count++];
        /* One word at least; the last line takes what is left. */
        size_t fits = w.count < max_lines ? strcspn(text, " ") : strlen(text);
        for (size_t end = fits; text[end] != '\0';) {
            end += 1 + strcspn(text + end + 1, " ");
            snprintf(line, WORDS_TEXT, "%.*s", (int)end, text);
            if (canvas_text_width(p->c, line, font) > width)
                break;
            fits = end;
        }
        snprintf(line, WORDS_TEXT, "%.*s", (int)fits, text);
        if (canvas_text_width(p->c, line, font) > width)
            cut(p, line, font, width);
        text += fits;
    }
    return w;
}

double words_height(const canvas_font *font) {
    return 1.35 * font->size;
}

double words_draw(const pencil *p, const words *w, const canvas_font *font, double x, double y) {
    for (size_t i = 0; i < w->count; i++) {
        canvas_text(p->c, x, y + font->size, w->lines[i], font, CANVAS_LEFT);
        y += words_height(font);
    }
    return y;
}
