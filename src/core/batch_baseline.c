/* SPDX-License-Identifier: MIT */
/* The kernels for the processor that the library is compiled for. */
#include <math.h>

#define TARGET
#define FUSED 0
#define TABLE dp_batch_baseline
#include "core/batch_loops.h"
