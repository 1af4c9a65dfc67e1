/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file estimate.h  The reciprocal that processors estimate, as a model that is the same on every machine.
 *
 * RCPPS promises an error, not bits: makers fill its table differently. What is compared, drawn or claimed comes from
 * this model, whose worst error is the promised one; only times come from the processor.
 */
#ifndef METHOD_ESTIMATE_H
#define METHOD_ESTIMATE_H

/** The relative error that RCPPS promises on every processor: Intel SDM vol. 2 and AMD APM vol. 4, RCPPS. */
#define ESTIMATE_WORST (1.5 * 0x1p-12)

/**
 * 1/x from a table of 2^11 entries of 12 bits: the reciprocal of the middle of each 2048th of a binade, rounded.
 * An x at the end of its 2048th is y 2^-12 away from the entry's, the entry half a step, 2^-13, from the reciprocal
 * y in [1/2, 1]: y 2^-12 + 2^-13/y, at most ESTIMATE_WORST and that only at the ends of a binade.
 * As the instruction has it: a subnormal x counts as 0, a subnormal result becomes 0, 1/0 is infinity.
 */
float estimate_reciprocal(float x);

#endif
