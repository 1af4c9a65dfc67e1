/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory in place of the C library's, which is a fiftieth of the page: pieces of powers of two, a list of free ones each. */
#include <stdalign.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { ORDERS = 31, LEAST = 5, PORTION = 1 << 16 /* a page of WebAssembly */ };

typedef struct piece {
    alignas(max_align_t) unsigned order;
    struct piece *next; /* of a free one */
} piece;

static piece *freed[ORDERS];
static char *fresh;
static size_t left;

static piece *cut(unsigned order) {
    const size_t size = (size_t)1 << order, more = (size + PORTION - 1) / PORTION * PORTION;
    char *got = size > left ? sbrk((intptr_t)more) : NULL;
    if (got == (char *)-1)
        return NULL;
    if (got != NULL && got != fresh + left) { /* the stack's end or somebody else's piece lies between */
        fresh = got;
        left = 0;
    }
    left += got != NULL ? more : 0;
    piece *p = (piece *)(void *)fresh;
    fresh += size;
    left -= size;
    return p;
}

static size_t room_of(const piece *p) {
    return ((size_t)1 << p->order) - sizeof *p;
}

/* malloc() by another name: compilers make calloc() of it where its bytes are set to 0. */
static void *take(size_t size) {
    unsigned order = LEAST;
    while (order < ORDERS && ((size_t)1 << order) - sizeof(piece) < size)
        order++;
    piece *p = order < ORDERS ? freed[order] : NULL;
    if (p != NULL)
        freed[order] = p->next;
    else if (order == ORDERS || (p = cut(order)) == NULL)
        return NULL;
    p->order = order;
    return p + 1;
}

void *malloc(size_t size) {
    return take(size);
}

void free(void *of) {
    piece *p = (piece *)of - 1;
    if (of == NULL)
        return;
    p->next = freed[p->order];
    freed[p->order] = p;
}

void *calloc(size_t count, size_t size) {
    size_t all;
    void *p = __builtin_mul_overflow(count, size, &all) ? NULL : take(all);
    return p != NULL ? memset(p, 0, all) : NULL;
}

void *realloc(void *of, size_t size) {
    const size_t room = of != NULL ? room_of((piece *)of - 1) : 0;
    void *p = size <= room ? of : take(size);
    if (p == NULL || p == of)
        return p;
    memcpy(p, of, room);
    free(of);
    return p;
}
