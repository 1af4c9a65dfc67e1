/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "probe/judge.h"

void probe_judge(probe_result *r) {
    judge_points(r);
    judge_triangles(r);
    judge_bias(r);
}
