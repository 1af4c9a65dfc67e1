/* SPDX-License-Identifier: MIT */
/**
 * @file clones.h  For the rooms above too: loops compiled for several instruction sets, chosen when the program starts.
 *
 * Element-wise loops give the same bits in each, because contraction is off (see the Makefile).
 */
#ifndef CORE_CLONES_H
#define CORE_CLONES_H

#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__ELF__) &&                             \
    !defined(__SANITIZE_ADDRESS__)
#define CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define CLONES
#endif

#endif
