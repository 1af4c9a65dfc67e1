/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "draw/notes.h"

#include <string.h>

#include "core/append.h"

void notes_write_escaped(FILE *out, const char *s) {
    for (; *s != '\0'; s++) {
        if (*s == '&')
            fputs("&amp;", out);
        else if (*s == '<')
            fputs("&lt;", out);
        else if (*s == '>')
            fputs("&gt;", out);
        else
            fputc(*s, out);
    }
}

static void element(FILE *out, const char *open, const char *content, const char *close) {
    fputs(open, out);
    notes_write_escaped(out, content);
    fputs(close, out);
}

void notes_write_svg(FILE *out, const char *svg, size_t size, const notes *words) {
    size_t tag = 0; /* to the end of <svg ...> */
    while (tag + 4 < size && memcmp(svg + tag, "<svg", 4) != 0)
        tag++;
    while (tag < size && svg[tag] != '>')
        tag++;
    fwrite(svg, 1, tag, out);
    fputs(" role=\"img\" aria-labelledby=\"title desc\">\n", out);
    element(out, "<title id=\"title\">", words->title, "</title>\n");
    element(out, "<desc id=\"desc\">", words->description, "</desc>\n");
    element(out, "<metadata>\ncommand: ", words->command, "\n");
    element(out, "data: ", words->data, "\n");
    element(out, *words->axes != '\0' ? "axes: " : "", words->axes, "</metadata>");
    fwrite(svg + tag + 1, 1, size - tag - 1, out);
}

char *notes_clean(char *out, size_t size, const char *s) {
    size_t used = 0;
    while (*s != '\0') {
        size_t length = text_character(s);
        size_t room = length > 0 ? length : 1;
        if (used + room >= size)
            break;
        memcpy(out + used, length > 0 ? s : "?", room);
        used += room;
        s += room;
    }
    out[used] = '\0';
    return out;
}
