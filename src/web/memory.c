/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Memory in place of the C library's, which is a fiftieth of the page: pieces of powers of two, freed ones in lists. */
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
