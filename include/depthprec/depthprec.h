/* SPDX-License-Identifier: MIT */
/**
 * @file depthprec.h  The depthprec library: exact precision of depth buffers.
 *
 *     dp_format format[2];                          // two, because depth24plus may be either of two
 *     dp_spec spec = dp_spec_default();             // near 0.1, far 1000, d3d, fp32
 *     if (dp_format_parse("unorm24", format) > 0)
 *         spec.format = format[0];
 *     dp_setup setup;
 *     dp_sample sample;
 *     if (dp_setup_init(&setup, &spec) == DP_OK && dp_sample_at(&setup, 10.0, &sample) == DP_OK)
 *         ... sample.code is 16611104, sample.interval is 5.96e-05
 *
 * The library needs the C library and libm only, allocates nothing, keeps no state and is safe to call from any
 * thread. It relies on IEEE 754 double arithmetic in round-to-nearest mode, without contraction or -ffast-math.
 */
#ifndef DEPTHPREC_DEPTHPREC_H
#define DEPTHPREC_DEPTHPREC_H

#include "depthprec/arith.h"
#include "depthprec/batch.h"
#include "depthprec/bounds.h"
#include "depthprec/budget.h"
#include "depthprec/depth.h"
#include "depthprec/format.h"
#include "depthprec/mapping.h"
#include "depthprec/pipeline.h"
#include "depthprec/projection.h"
#include "depthprec/recognise.h"
#include "depthprec/setup.h"
#include "depthprec/status.h"
#include "depthprec/triangles.h"
#include "depthprec/vertices.h"

#define DP_VERSION_MAJOR 0
#define DP_VERSION_MINOR 2
#define DP_VERSION_PATCH 0
#define DP_VERSION       "0.2.0"

DP_BEGIN

/** The version of the library that is linked, as DP_VERSION of the headers it was built with. */
DP_API const char *dp_version(void);

DP_END
#endif
