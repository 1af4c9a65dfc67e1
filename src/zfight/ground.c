/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "zfight/ground.h"

#include <math.h>

#include "core/engine.h"
#include "depthprec/depth.h"
#include "zfight/range.h"

census_request census_of_guarantee(const dp_setup *setup, double lo, double hi) {
    return (census_request){
        .setup = setup, .lo = lo, .hi = hi, .bound = dp_separation, .falls = dp_counts_steps(setup), .calm = 1 << 14};
}

double census_bound_at(const census_request *request, uint32_t rank) {
    return request->bound != NULL ? request->bound(request->setup, (double)dp_ranked32(rank)) : HUGE_VAL;
}

double census_least(const census_request *request, double bound, uint32_t first, uint32_t width) {
    return request->falls ? fmax(bound - width * census_step(first), 0.0) : bound;
}

census_ground census_ground_make(const census_request *request, uint32_t first, uint32_t last) {
    return (census_ground){.request = request, .first = first, .last = last, .near = UINT32_MAX, .far = UINT32_MAX};
}

double census_ground_at(census_ground *g, uint32_t rank) {
    const uint32_t calm = g->request->calm;
    if (calm == 0)
        return 0.0;
    const uint32_t near = g->first + (rank - g->first) / calm * calm;
    if (near < dp_rank32(0.0f) || (near & 0x7FFFFFU) < calm)
        return 0.0;
    if (near == g->near)
        return g->least;
    const uint32_t far = g->last - near < calm ? g->last : near + calm;
    const double at_far = far == g->near ? g->at_near : census_bound_at(g->request, far);
    g->at_near = near == g->far ? g->at_far : census_bound_at(g->request, near);
    g->at_far = at_far;
    g->near = near;
    g->far = far;
    const double least = (g->at_near < at_far ? g->at_near : at_far) * (1.0 - CENSUS_CALM) - 2.0 * census_step(near);
    g->least = census_least(g->request, least > 0.0 ? least : 0.0, near, calm);
    return g->least;
}
