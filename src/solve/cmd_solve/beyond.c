/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Depths beyond the distance that solve finds: where surfaces are seen to fight, and where it holds again. */
#include <float.h>
#include <math.h>

#include "core/bits.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"
#include "zfight/census.h"

/* The first stretch is short, since most fights are near, and each that follows is twice as long. */
enum { FIRST_STRETCH = 1 << 14, DEPTHS_MOST = 1 << 24, AGAIN_SHOWN = 3 };

int solve_check_apart(const solve_request *o, solve_target target) {
    const bool known = option_given(o->line, "far") || camera_says_planes(&o->camera.said);
    const double near = target == SOLVE_FOR_NEAR ? 0.0 : o->camera.znear;
    const double most = target == SOLVE_FOR_FAR || !known ? HUGE_VAL : o->camera.zfar - near;
    if (!option_given(o->line, "separation") || o->separation <= most)
        return EXIT_FINE;
    return option_error("separation", "must be at most %s, all that lies between near and far, got %s",
                        camera_length(&o->camera, most, 0).text, camera_length(&o->camera, o->separation, 0).text);
}

static double depth_behind(double z, uint32_t count, double hi) {
    return fmin((double)dp_ranked32(dp_rank32((float)z) + count), hi); /* behind infinity NaN, which counts as hi */
}

/* Surfaces that far apart, the nearer one at each binary32 depth; before `from` it is certain that none fight. */
static solve_fight find_fight(const dp_setup *setup, double from, double hi, double apart) {
    solve_fight out = {(double)NAN, (double)NAN};
    double z = from;
    uint32_t stretch = FIRST_STRETCH;
    for (uint64_t done = 0; done < DEPTHS_MOST && z + apart <= hi && isnan(out.first); done += stretch, stretch *= 2) {
        census_result found;
        const double end = depth_behind(z, stretch, hi);
        const census_sample_request request = {
            .common = {.setup = setup, .lo = z, .hi = fmin(hi, (double)FLT_MAX)}, .most = stretch, .gap = apart};
        if (census_sample(&request, &found) != CENSUS_DONE)
            break;
        out = (solve_fight){found.all.first, fmin(end, hi - apart)};
        z = end;
    }
    return out;
}

void solve_look_beyond(solve_report *r) {
    const solve_candidate *c = &r->items[0];
    dp_setup setup;
    r->fight = (solve_fight){(double)NAN, (double)NAN};
    if (r->target != SOLVE_FOR_DISTANCE || quantity_setup(&c->spec, &setup) != DP_OK)
        return;
    const double from = c->possible ? c->distance.value : r->lo;
    if (setup.spec.model == DP_MODEL_FLOAT && setup.spec.triangles.width == 0) /* the census knows depths at a point */
        r->fight = find_fight(&setup, from, r->hi, r->limit);
    if (!c->distance.throughout && r->kind == QUANTITY_SEPARATION)
        r->again_count = distance_again(&setup, from, r->hi, r->limit, r->again, SOLVE_AGAIN_MAX);
}

void solve_say_beyond(page *p, const solve_report *r) {
    for (size_t i = 0; i < r->again_count && i < AGAIN_SHOWN; i++)
        page_note(p, i == 0 ? "holds again" : "", "from z = %s to %s",
                  number_in(number_up(r->again[i].lo, SOLVE_DIGITS), camera_unit(&r->o->camera)).text,
                  number_in(number_down(r->again[i].hi, SOLVE_DIGITS), camera_unit(&r->o->camera)).text);
    if (r->again_count > AGAIN_SHOWN)
        page_note(p, "", "and farther; --json lists %zu ranges", r->again_count);
}
