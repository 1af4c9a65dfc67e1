/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file page.h  What the module asks of the page, and what the page may call: see engine.js, the other side. */
#ifndef WEB_PAGE_H
#define WEB_PAGE_H

#ifdef __wasm__
#define PAGE_IMPORT(name) __attribute__((import_module("page"), import_name(name)))
#define PAGE_EXPORT(name) __attribute__((export_name(name)))
#else /* in a test */
#define PAGE_IMPORT(name)
#define PAGE_EXPORT(name)
#endif

/** How far `length` bytes of UTF-8 reach in the page's font, px. */
PAGE_IMPORT("measure") double page_measure(const char *text, int length, double size, int bold);

/** The words that the page has written, the program's name before them. @return how many; 0 where they are too many */
int page_words(int count, char ***words);

#endif
