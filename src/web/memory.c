/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * In place of the C library's, which is large: memory, in pieces of powers of two, freed ones in lists; copies, each
 * one instruction; what is looked for in texts; and the one fault that a file may have here.
 */
#include <stdalign.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ORDERS = 31, LEAST = 5, PORTION = 1 << 18 };

typedef struct piece {
    alignas(max_align_t) unsigned order;
    struct piece *next; /* of a freed one */
} piece;

static piece *freed[ORDERS];
static char *fresh;
static size_t left;

static size_t room_of(unsigned order) {
    return ((size_t)1 << order) - sizeof(piece);
}

/* malloc() by another name: compilers make calloc() of it where its bytes are set to 0. */
static void *take(size_t size) {
    unsigned order = LEAST;
    while (order < ORDERS && room_of(order) < size)
        order++;
    piece *p = order < ORDERS ? freed[order] : NULL;
    if (p != NULL) {
        freed[order] = p->next;
        return p + 1;
    }
    const size_t whole = (size_t)1 << order, more = (whole + PORTION - 1) / PORTION * PORTION;
    if (whole > left && order < ORDERS && (fresh = sbrk((intptr_t)more)) != (char *)-1)
        left = more;
    if (whole > left || order == ORDERS)
        return NULL;
    p = (piece *)(void *)fresh;
    p->order = order;
    fresh += whole;
    left -= whole;
    return p + 1;
}

void *malloc(size_t size) {
    return take(size);
}

void free(void *of) {
    if (of == NULL)
        return;
    piece *p = (piece *)of - 1;
    p->next = freed[p->order];
    freed[p->order] = p;
}

void *calloc(size_t count, size_t size) {
    size_t all;
    void *p = __builtin_mul_overflow(count, size, &all) ? NULL : take(all);
    return p != NULL ? memset(p, 0, all) : NULL;
}

void *realloc(void *of, size_t size) {
    const size_t room = of != NULL ? room_of(((piece *)of - 1)->order) : 0;
    void *p = size <= room ? of : take(size);
    if (p == NULL || p == of)
        return p;
    memcpy(p, of, room);
    free(of);
    return p;
}

void *memcpy(void *restrict to, const void *restrict from, size_t size) {
    return __builtin_memcpy(to, from, size);
}

void *memset(void *to, int byte, size_t size) {
    return __builtin_memset(to, byte, size);
}

char *strstr(const char *text, const char *part) {
    const size_t length = strlen(part);
    while (*text != '\0' && strncmp(text, part, length) != 0)
        text++;
    return strncmp(text, part, length) == 0 ? (char *)(uintptr_t)text : NULL;
}

char *strerror(int error) {
    static char text[] = "No such file or directory"; /* as input_open() has it */
    (void)error;
    return text;
}
