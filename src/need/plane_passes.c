/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "need/plane.h"

bool plane_fails_at_ends(const solve_problem *p, const dp_setup *setup) {
    return p->lo < p->hi && p->kind == MEASURE_SEPARATION &&
           (dp_separation(setup, p->hi) > p->limit || dp_separation(setup, p->lo) > p->limit);
}

bool plane_passes(const solve_problem *p, double value) {
    dp_setup setup;
    return solve_setup(p, value, &setup) == DP_OK && !plane_fails_at_ends(p, &setup) &&
           judge(p->kind, &setup, p->lo, p->hi, p->limit).passed;
}
