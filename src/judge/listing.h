/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file listing.h  The text of a shader file taken apart: what it declares, and what of it a function needs. */
#ifndef JUDGE_LISTING_H
#define JUDGE_LISTING_H

#include <stdbool.h>
#include <stddef.h>

typedef struct piece {
    const char *at;
    size_t length;
} piece;

bool piece_is(piece p, const char *text);
bool piece_same(piece a, piece b);
/** One of a list that ends with null. */
bool piece_is_any(piece p, const char *const list[]);

typedef enum item_kind {
    ITEM_CODE,
    ITEM_FUNCTION,
    ITEM_STRUCTURE,
    ITEM_DIRECTIVE,
    ITEM_NONE /**< uniforms, and what goes in and out */
} item_kind;

typedef struct item {
    const char *from, *to;
    item_kind kind;
    piece name; /**< of a function */
    bool kept;
} item;

typedef struct listing {
    char *text; /**< the file without remarks */
    bool hlsl;
    item *items;
    size_t count;
} listing;

/** @return false where it does not fit into memory; listing_free() either way */
bool listing_read(const char *file, bool hlsl, listing *out);
void listing_free(listing *s);

/** Keeps an item with whatever it needs, and what that needs. */
void listing_keep(listing *s, item *i);
/** Blanks what is not kept; lines stay. */
void listing_blank_rest(listing *s);

/** The next word from *at on, and how many brackets more are open there; numbers are none. */
bool listing_word(const char **at, const char *end, piece *out, int *open);
/** The text before a place and the character behind it, blanks skipped; "" and '\0': nothing. */
const char *listing_before(const char *from, const char *at);
char listing_after(const char *at, const char *end);
piece listing_word_before(const char *from, const char *at);

/** Is it declared there, to be known to others? Inside: to be known there alone, as a parameter is. */
bool listing_item_declares(const item *i, piece name, bool inside);
/** Whether the file declares a name, but for uniforms. */
bool listing_declares(const listing *s, piece name);
/** The type with which a uniform, or a member of a structure, is declared; of length 0 where none is found. */
piece listing_type(const listing *s, piece name, bool member);
/** Does the word stand in a line such as #if? */
bool listing_in_condition(const listing *s, piece word);
/** Is something between an item and the #endif of its #if that a kept one needs? Of other items it is. */
bool listing_matters(const listing *s, const item *condition);

/** The structure of that name; null: there is none. */
const item *listing_structure(const listing *s, piece name);
/** The next member from *at on, which begins at the structure; *open at 0. */
bool listing_member(const item *structure, const char **at, int *open, piece *out);
/** Makes a variable of a uniform that is a structure or a named block. @return what has its members; null: it is none
 */
const item *listing_release(listing *s, piece name);

#endif
