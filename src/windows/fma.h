/* SPDX-License-Identifier: MIT */
/** @file fma.h  What stands in for the instruction where a processor lacks it; declared for its test. */
#ifndef WINDOWS_FMA_H
#define WINDOWS_FMA_H

double windows_fma(double x, double y, double z);
float windows_fmaf(float x, float y, float z);

#endif
