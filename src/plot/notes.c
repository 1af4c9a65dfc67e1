/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/notes.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static bool grow(notes_buffer *b, size_t size) {
    size_t room = 2 * b->room + size + 4096;
    unsigned char *at = realloc(b->at, room);
    if (at == NULL)
        return false;
    b->at = at;
    b->room = room;
    return true;
}

bool notes_append(notes_buffer *b, const void *bytes, size_t size) {
    b->failed = b->failed || (b->room - b->size < size && !grow(b, size));
    if (b->failed)
        return false;
    memcpy(b->at + b->size, bytes, size);
    b->size += size;
    return true;
}

static void text(notes_buffer *b, const char *s) {
    notes_append(b, s, strlen(s));
}

static void escaped(notes_buffer *b, const char *s) {
    for (; *s != '\0'; s++) {
        if (*s == '&')
            text(b, "&amp;");
        else if (*s == '<')
            text(b, "&lt;");
        else if (*s == '>')
            text(b, "&gt;");
        else
            notes_append(b, s, 1);
    }
}

static void element(notes_buffer *b, const char *open, const char *content, const char *close) {
    text(b, open);
    escaped(b, content);
    text(b, close);
}

static bool replace(notes_buffer *b, notes_buffer *whole) {
    if (whole->failed) {
        free(whole->at);
        return false;
    }
    free(b->at);
    *b = *whole;
    return true;
}

bool notes_into_svg(notes_buffer *b, const notes *words) {
    size_t head = 0;
    while (head + 4 < b->size && memcmp(b->at + head, "<svg", 4) != 0)
        head++;
    const unsigned char *close = memchr(b->at + head, '>', b->size - head);
    if (close == NULL)
        return false;
    size_t tag = (size_t)(close - b->at);
    notes_buffer whole = {0};
    notes_append(&whole, b->at, tag);
    text(&whole, " role=\"img\" aria-labelledby=\"title desc\">\n");
    element(&whole, "<title id=\"title\">", words->title, "</title>\n");
    element(&whole, "<desc id=\"desc\">", words->description, "</desc>\n");
    element(&whole, "<metadata>\ncommand: ", words->command, "\n");
    element(&whole, "data: ", words->data, "\n</metadata>");
    notes_append(&whole, close + 1, b->size - tag - 1);
    return replace(b, &whole);
}

/* The CRC of PNG (ISO 3309), bit by bit: a few hundred bytes do not need a table. */
static uint32_t crc(const unsigned char *bytes, size_t size) {
    uint32_t c = 0xFFFFFFFFu;
    for (size_t i = 0; i < size; i++) {
        c ^= bytes[i];
        for (int bit = 0; bit < 8; bit++)
            c = (c & 1) != 0 ? 0xEDB88320u ^ c >> 1 : c >> 1;
    }
    return ~c;
}

static void big_endian(notes_buffer *b, uint32_t v) {
    notes_append(b,
                 (unsigned char[]){(unsigned char)(v >> 24), (unsigned char)(v >> 16), (unsigned char)(v >> 8),
                                   (unsigned char)v},
                 4);
}

static void chunk(notes_buffer *b, const char *keyword, const char *content) {
    /* keyword, null, no compression (two bytes), no language, no translated keyword, then UTF-8 */
    big_endian(b, (uint32_t)(strlen(keyword) + 5 + strlen(content)));
    size_t start = b->size;
    text(b, "iTXt");
    notes_append(b, keyword, strlen(keyword) + 1);
    notes_append(b, "\0\0\0\0", 4);
    text(b, content);
    if (!b->failed)
        big_endian(b, crc(b->at + start, b->size - start));
}

bool notes_into_png(notes_buffer *b, const notes *words) {
    enum { HEAD = 8 + 25 }; /* the signature and the IHDR chunk, always of these sizes */
    if (b->size < HEAD)
        return false;
    notes_buffer whole = {0};
    notes_append(&whole, b->at, HEAD);
    chunk(&whole, "Title", words->title);
    chunk(&whole, "Description", words->description);
    chunk(&whole, "Source", words->command);
    chunk(&whole, "Comment", words->data);
    notes_append(&whole, b->at + HEAD, b->size - HEAD);
    return replace(b, &whole);
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
