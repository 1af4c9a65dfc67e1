/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/notes.h"

#include <string.h>

static void escaped(FILE *out, const char *s) {
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
    escaped(out, content);
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
    element(out, "data: ", words->data, "\n</metadata>");
    fwrite(svg + tag + 1, 1, size - tag - 1, out);
}

/* Length of the valid UTF-8 character at s (no overlong forms, no surrogates), 0 when there is none. */
static size_t character(const unsigned char *s) {
    if (s[0] >= 0x20 && s[0] < 0x7F)
        return 1;
    size_t length = s[0] >= 0xC2 && s[0] < 0xE0   ? 2
                    : s[0] >= 0xE0 && s[0] < 0xF0 ? 3
                    : s[0] >= 0xF0 && s[0] < 0xF5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    if (length == 2 && s[0] == 0xC2 && s[1] < 0xA0)
        return 0; /* control characters */
    if ((s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF0 && s[1] < 0x90) ||
        (s[0] == 0xF4 && s[1] > 0x8F))
        return 0;
    return length;
}

char *notes_clean(char *out, size_t size, const char *s) {
    size_t used = 0;
    while (*s != '\0') {
        size_t length = character((const unsigned char *)s);
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
