/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What solve found, for programs: JSON and CSV. */
#include <math.h>

#include "cli/setups.h"
#include "cli/solve_report.h"
#include "report/csv.h"
#include "report/json.h"

static const char *measure_name(const solve_report *r) {
    return r->kind == MEASURE_ERROR ? "error" : "separation";
}

static double not_a_number(void) {
    return (double)NAN;
}

/* ---- JSON -------------------------------------------------------------------------------------------------------- */

/* What was found about a plane: where it ends, what was tried, and what is known of the values beyond it. */
static void json_plane(json *j, const solve_candidate *c) {
    json_number(j, "until", c->plane.until);
    json_number(j, "steady", c->plane.steady);
    json_integer(j, "tried", c->plane.tried);
    json_integer(j, "passed", c->plane.passed);
    json_bool(j, "certain", c->plane.certain);
    json_number(j, "fails_to", c->plane.fails_to);
}

static void json_lattice(json *j, const solve_report *r, const solve_candidate *c) {
    json_object(j, "lattice");
    json_bool(j, "possible", c->lattice.possible);
    if (c->solved)
        json_number(j, c->unknown == SOLVE_NEAR ? "near" : "far", c->lattice.value);
    if (r->target == SOLVE_FOR_DISTANCE)
        json_number(j, "distance", c->lattice.possible ? c->lattice.value : not_a_number());
    json_number(j, measure_name(r), c->lattice.reached.value);
    json_number(j, "z", c->lattice.reached.z);
    json_end(j);
}

static void json_candidate(json *j, const solve_report *r, const solve_candidate *c) {
    dp_setup setup;
    if (dp_setup_init(&setup, &c->spec) == DP_OK)
        setup_json(j, &setup);
    json_bool(j, "possible", c->possible);
    json_number(j, measure_name(r), c->reached.value);
    json_number(j, "z", c->reached.z);
    json_number(j, "separation_fp32", solve_in_binary32(r, c));
    if (c->solved && c->possible)
        json_plane(j, c);
    if (r->target == SOLVE_FOR_DISTANCE) {
        json_number(j, "distance", c->possible ? c->distance.value : not_a_number());
        json_bool(j, "throughout", c->distance.throughout);
        json_number(j, "fails_from", c->distance.fails);
    }
    json_lattice(j, r, c);
    json_integer(j, "bytes", (uint64_t)c->price.bytes);
    json_string(j, "available", c->price.available);
    json_string(j, "caution", c->price.caution);
    json_string(j, "effort", c->price.effort);
}

void solve_report_json(const solve_report *r, output *out) {
    const solve_candidate *answer = &r->items[0];
    json j = json_start(out, "solve");
    json_string(&j, "for", option_word(OPTION_FOR, r->target));
    json_string(&j, "measure", measure_name(r));
    json_number(&j, "limit", r->limit);
    json_number(&j, "lo", r->lo);
    json_number(&j, "hi", r->hi);
    json_bool(&j, "possible", answer->possible);
    json_object(&j, "answer");
    json_candidate(&j, r, answer);
    json_end(&j);
    json_array(&j, "islands");
    for (int i = 0; i < answer->island_count; i++) {
        json_object(&j, NULL);
        json_number(&j, "lo", r->islands[i].lo);
        json_number(&j, "hi", r->islands[i].hi);
        json_end(&j);
    }
    json_end(&j);
    json_array(&j, "alternatives");
    for (size_t i = 1; i < r->count; i++) {
        json_object(&j, NULL);
        json_candidate(&j, r, &r->items[i]);
        json_end(&j);
    }
    json_end(&j);
    json_finish(&j);
}

/* ---- CSV: the answer, its earlier islands in the lattice, the alternatives --------------------------------------- */

static void csv_candidate(csv *c, const solve_report *r, const solve_candidate *item, const char *role, double from,
                          double to) {
    dp_setup setup;
    dp_spec spec = item->spec;
    const bool island = role[0] == 'i';
    if (island) /* of the lattice */
        spec.model = DP_MODEL_EXACT;
    if (dp_setup_init(&setup, &spec) != DP_OK)
        return;
    csv_string(c, role);
    setup_csv(c, &setup);
    csv_string(c, option_word(OPTION_FOR, r->target));
    csv_string(c, item->possible ? "true" : "false");
    csv_string(c, measure_name(r));
    csv_number(c, r->limit);
    csv_number(c, item->reached.value);
    csv_number(c, item->reached.z);
    csv_number(c, from);
    csv_number(c, to);
    csv_integer(c, (uint64_t)item->price.bytes);
    csv_string(c, item->price.available);
    csv_number(c, item->solved && item->possible && !island ? item->plane.steady : not_a_number());
    csv_number(c, item->lattice.value);
    csv_number(c, item->lattice.reached.value);
    csv_end(c);
}

void solve_report_csv(const solve_report *r, output *out) {
    static const char *const heads[] = {"for",
                                        "possible",
                                        "measure",
                                        "limit [scene]",
                                        "value [scene]",
                                        "z [scene]",
                                        "from [scene]",
                                        "to [scene]",
                                        "bytes",
                                        "available",
                                        "steady [scene]",
                                        "lattice [scene]",
                                        "lattice value [scene]"};
    const bool distance = r->target == SOLVE_FOR_DISTANCE;
    csv c = csv_start(out);
    csv_string(&c, "role");
    setup_csv_head(&c);
    for (size_t i = 0; i < sizeof heads / sizeof heads[0]; i++)
        csv_string(&c, heads[i]);
    csv_end(&c);
    for (size_t i = 0; i < r->count; i++) {
        const solve_candidate *item = &r->items[i];
        const bool solved = item->solved && item->possible;
        const double a = solved ? solve_plane_of(item) : distance && item->possible ? r->lo : not_a_number();
        const double b = solved ? item->plane.until : distance && item->possible ? item->distance.value : a;
        csv_candidate(&c, r, item, i == 0 ? "answer" : "alternative", fmin(a, b), fmax(a, b));
        for (int k = 0; i == 0 && k + 1 < item->island_count; k++)
            csv_candidate(&c, r, item, "island", r->islands[k].lo, r->islands[k].hi);
    }
}
