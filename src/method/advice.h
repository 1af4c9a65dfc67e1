/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file advice.h  Which of the measured methods of a family to use, and what the next one would gain: of those that
 * answer the family's question for the lattice; what the binary32 pipeline is asked is another question.
 */
#ifndef METHOD_ADVICE_H
#define METHOD_ADVICE_H

#include "method/bench.h"
#include "method/stability.h"

/** The fastest on the front that has its fourth digit (STABILITY_LOST), or of codes is off by a step at most; where
 *  none has, the most exact on the front. Null: none is on it. */
const bench_result *advice_use(const method_family_row *family, const bench_result *results, size_t count);

/** Measures the cases of a family in turn, up to the first in which a method is on the front, which is `which`; where
 *  none is, the last is. @return how many results there are; 0: out of memory, or the planes are none of the family's
 */
size_t advice_case(const method_family_row *family, double znear, double zfar, size_t *which, bench_result *results);

/** The fastest on the front that has at most half its error; null: there is none. */
const bench_result *advice_next(const method_family_row *family, const bench_result *results, size_t count,
                                const bench_result *use);

#endif
