/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * solve: the missing one of near, far, format, mapping and separation, or how far that holds; and what is possible
 * where that is not.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "report/number.h"
#include "solve/cmd_solve/report.h"
#include "solve/cmd_solve/request.h"

/* ---- What is asked ----------------------------------------------------------------------------------------------- */

static bool has_pipeline(dp_mapping mapping) {
    return dp_mapping_get(mapping)->curve == DP_CURVE_PERSPECTIVE;
}

static bool is_logarithm(dp_mapping mapping) {
    return dp_mapping_get(mapping)->curve == DP_CURVE_LOG;
}

static bool is_given(const solve_request *o, const char *id) {
    return option_given(o->line, id) || (o->camera.matrix.count == MATRIX_ENTRIES && strcmp(id, "format") != 0);
}

/* A preset says all of them: they are known, and may be solved for. */
static bool is_known(const solve_request *o, const char *id) {
    return is_given(o, id) || o->camera.preset_count > 0;
}

/* At a slant there is a guarantee of separations, and only of what is affine on the screen. */
static int check_slanted(const solve_request *o, const solve_report *r) {
    if (!quantity_get(r->kind)->of_surfaces)
        return option_error(solve_measure_name(r), "is that at a point, and conflicts with --viewport");
    if (option_given(o->line, "model") && !o->camera.model_auto && o->camera.model != DP_MODEL_FLOAT)
        return option_error("model", "must be float or auto with --viewport, got '%s', which knows no slant",
                            option_word("model", o->camera.model));
    for (size_t m = 0; m < o->camera.mapping_count; m++)
        if (!has_pipeline(o->camera.mappings[m]))
            return option_error("mapping",
                                "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --viewport, got %s, which is not "
                                "affine on the screen",
                                dp_mapping_get(o->camera.mappings[m])->name);
    return EXIT_FINE;
}

static int check_target(const solve_request *o, solve_report *r) {
    static const char *const givens[] = {"near", "far", "format", "mapping"};
    const bool limited = option_given(o->line, "separation") || option_given(o->line, "error");
    r->kind = option_given(o->line, "error") ? QUANTITY_ERROR : QUANTITY_SEPARATION;
    r->limit = !limited ? (double)NAN : r->kind == QUANTITY_ERROR ? o->error : o->separation;
    r->target = o->target;
    if (r->target == SOLVE_FOR_ANY && !limited)
        r->target = SOLVE_FOR_SEPARATION;
    for (int i = 0; i < 4 && r->target == SOLVE_FOR_ANY; i++)
        if (!is_given(o, givens[i]))
            r->target = (solve_target)(SOLVE_FOR_NEAR + i);
    if (r->target == SOLVE_FOR_ANY)
        return usage_error("solve: nothing is left to solve for: leave out --near, --far, --format, --mapping or "
                           "--separation, or name one with --for");
    if (r->target == SOLVE_FOR_SEPARATION && limited)
        return option_error("for", "solves for separation: leave out --%s", solve_measure_name(r));
    if (r->target == SOLVE_FOR_DISTANCE && option_given(o->line, "at"))
        return option_error("at", "does not apply to --for distance: --range LO:HI says from where");
    if (r->target != SOLVE_FOR_SEPARATION && !limited)
        return option_error("separation", "must be given (or --error), to solve for %s", option_word("for", r->target));
    if ((r->target <= SOLVE_FOR_FAR || r->target == SOLVE_FOR_MAPPING) && o->camera.matrix.count == MATRIX_ENTRIES)
        return option_error("matrix", "says near, far and mapping, and --for %s asks for one of them",
                            option_word("for", r->target));
    if (r->target <= SOLVE_FOR_FAR && option_given(o->line, givens[r->target - SOLVE_FOR_NEAR]))
        return option_error("for", "solves for %s: leave out --%s", option_word("for", r->target),
                            option_word("for", r->target));
    for (size_t m = 0; m < o->camera.mapping_count; m++)
        if (option_given(o->line, "model") && !quantity_has_model(r->kind, o->camera.model, o->camera.mappings[m]))
            return option_error("model", "must be exact or staged for an error of %s, got 'float', which has no cells",
                                dp_mapping_get(o->camera.mappings[m])->name);
    return o->camera.triangles.width > 0 ? check_slanted(o, r) : EXIT_FINE;
}

static int check_depths(const solve_request *o, solve_report *r) {
    const bool range = option_given(o->line, "range");
    if (!range && r->target == SOLVE_FOR_DISTANCE) {
        r->lo = o->camera.znear;
        r->hi = is_known(o, "far") ? o->camera.zfar : (double)HUGE_VAL;
        return EXIT_FINE;
    }
    if (!range && o->camera.at.count == 0)
        return option_error("at", "must be given, or --range LO:HI");
    if (o->camera.at.count > 1)
        return option_error("at", "solve takes one depth, or --range LO:HI, got %zu depths", o->camera.at.count);
    r->lo = range ? o->camera.range_lo : o->camera.at.lo;
    r->hi = range ? o->camera.range_hi : o->camera.at.lo;
    const char *id = range ? "range" : "at";
    const bool free_near = r->target == SOLVE_FOR_NEAR;
    const bool free_far = r->target == SOLVE_FOR_FAR || !is_known(o, "far");
    const double least = free_near ? 1e-12 : o->camera.znear;
    const double most = free_far ? 1e18 : o->camera.zfar;
    if (r->target == SOLVE_FOR_FAR && !(r->hi > 0.0) && o->camera.znear <= 0.0)
        return option_error(id, "must reach depths above 0, to solve for far, got %s", number_full(r->hi).text);
    if (r->lo >= least && r->hi <= most)
        return EXIT_FINE;
    return option_error(id, "depths must lie in [%s, %s] = [%s, %s], got %s", free_near ? "1e-12" : "near",
                        free_far ? "1e18" : "far", number_full(least).text, number_full(most).text,
                        number_full(r->lo >= least ? r->hi : r->lo).text);
}

/* ---- Candidates -------------------------------------------------------------------------------------------------- */

static bool asks_for_choice(solve_target target) {
    return target == SOLVE_FOR_FORMAT || target == SOLVE_FOR_MAPPING;
}

/* The model asked for, or the fullest that there is: what a user can trust. */
static dp_model model_of(const solve_report *r, dp_mapping mapping, bool asked) {
    const solve_request *o = r->o;
    const bool given = option_given(o->line, "model") && !o->camera.model_auto;
    const bool has_fp32 =
        (is_logarithm(mapping) || has_pipeline(mapping)) && quantity_has_model(r->kind, DP_MODEL_FLOAT, mapping);
    if (given && (asked || o->camera.model != DP_MODEL_FLOAT))
        return o->camera.model;
    return has_fp32 ? DP_MODEL_FLOAT : DP_MODEL_STAGED;
}

static dp_status solve_plane(const solve_report *r, solve_candidate *c, solve_unknown unknown) {
    const solve_problem p = {
        .spec = c->spec, .unknown = unknown, .kind = r->kind, .limit = r->limit, .lo = r->lo, .hi = r->hi};
    solve_problem exact = p;
    plane_answer ideal;
    exact.spec.model = DP_MODEL_EXACT;
    exact.spec.triangles.width = 0;
    dp_status status = plane_solve(&p, &c->plane);
    if (status == DP_OK)
        status = plane_solve(&exact, &ideal);
    if (status != DP_OK)
        return status;
    *(unknown == SOLVE_NEAR ? &c->spec.znear : &c->spec.zfar) = c->plane.value;
    c->solved = true;
    c->unknown = unknown;
    c->possible = c->plane.possible;
    c->reached = c->plane.reached;
    c->lattice = (solve_lattice){ideal.possible, ideal.value, ideal.reached};
    c->island = (distance_span){fmin(ideal.value, ideal.until), fmax(ideal.value, ideal.until)};
    return DP_OK;
}

/* Answers with the planes as they are: how far it holds, or whether it does. */
static dp_status answer_as_is(const solve_report *r, const dp_spec *spec, distance_answer *out) {
    dp_setup setup;
    const dp_status status = quantity_setup(spec, &setup);
    if (status != DP_OK)
        return status;
    if (r->target == SOLVE_FOR_DISTANCE)
        return distance_solve(r->kind, &setup, r->lo, r->hi, r->limit, out);
    *out = (distance_answer){.value = (double)NAN, .reached = quantity_over(r->kind, &setup, r->lo, r->hi, r->limit)};
    out->possible = isnan(r->limit) || out->reached.passed;
    return DP_OK;
}

static dp_status evaluate(const solve_report *r, solve_candidate *c) {
    distance_answer ideal = {0};
    dp_spec exact = c->spec;
    exact.model = DP_MODEL_EXACT;
    dp_status status = answer_as_is(r, &c->spec, &c->distance);
    if (status == DP_OK)
        status = answer_as_is(r, &exact, &ideal);
    c->reached = c->distance.reached;
    c->possible = c->distance.possible;
    c->lattice = (solve_lattice){ideal.possible, ideal.value, ideal.reached};
    return status;
}

/* Fills in what is missing. */
static dp_status try_candidate(const solve_report *r, solve_candidate *c) {
    if (r->target == SOLVE_FOR_NEAR)
        return solve_plane(r, c, SOLVE_NEAR);
    if (r->target == SOLVE_FOR_FAR)
        return solve_plane(r, c, SOLVE_FAR);
    return evaluate(r, c);
}

/* Where the planes are given and do not do, the near plane that this format and mapping would need. */
static void try_other_near(const solve_report *r, solve_candidate *c) {
    solve_candidate other = *c;
    if (c->possible || isnan(r->limit) || solve_plane(r, &other, SOLVE_NEAR) != DP_OK || !other.possible)
        return;
    *c = other;
}

static bool listed(const solve_report *r, const dp_spec *spec) {
    for (size_t i = 0; i < r->count; i++)
        if (r->items[i].spec.mapping == spec->mapping && strcmp(r->items[i].spec.format.name, spec->format.name) == 0)
            return true;
    return false;
}

static dp_spec spec_of(const solve_request *o) {
    dp_spec spec = camera_to_spec(&o->camera.said);
    if (!is_known(o, "far"))
        spec.zfar = (double)HUGE_VAL;
    return spec;
}

static int refused(const solve_report *r, const solve_candidate *c, dp_status status) {
    if (status == DP_ERROR_INFINITE && !is_known(r->o, "far"))
        return option_error("far", "must be given: %s has no infinite far",
                            c->spec.ortho ? "an orthographic projection" : dp_mapping_get(c->spec.mapping)->name);
    return setup_refused(&r->o->camera, &c->spec, status);
}

static solve_candidate *add_candidate(solve_report *r, const dp_spec *spec, bool asked) {
    solve_candidate *c = &r->items[r->count++];
    *c = (solve_candidate){.spec = *spec, .asked = asked, .price = cost_of(&spec->format, spec->mapping)};
    return c;
}

static int add_asked(solve_report *r) {
    const solve_request *o = r->o;
    dp_spec spec = spec_of(o);
    for (size_t f = 0; f < o->camera.format_count; f++)
        for (size_t m = 0; m < o->camera.mapping_count; m++) {
            spec.format = o->camera.formats[f];
            spec.mapping = o->camera.mappings[m];
            spec.model = model_of(r, spec.mapping, is_known(o, "mapping"));
            if (setup_kept(&o->camera, &spec.format) != EXIT_FINE)
                return EXIT_USAGE;
            solve_candidate *c = add_candidate(r, &spec, true);
            const dp_status status = try_candidate(r, c);
            if (status != DP_OK)
                return refused(r, c, status);
        }
    return EXIT_FINE;
}

/* Whether there is a guarantee of what is asked about. */
static bool is_covered(const solve_report *r, const dp_spec *spec) {
    const raster_row *raster = r->o->camera.raster;
    if (!profile_stores(&r->o->camera.gpu, &spec->format))
        return false;
    return spec->triangles.width == 0 ||
           (has_pipeline(spec->mapping) && (raster == NULL || raster_bounded(raster, &spec->format)));
}

/* Whether every mapping of a format was asked about. */
static bool leaves_open(const solve_report *r, const dp_format *format) {
    bool asked = false;
    for (size_t f = 0; f < r->o->camera.format_count; f++)
        asked = asked || strcmp(r->o->camera.formats[f].name, format->name) == 0;
    return asked && r->target == SOLVE_FOR_MAPPING && !option_given(r->o->line, "mapping");
}

/*
 * Adds the alternatives: the real depth buffers with the mappings that an engine can choose. Of the logarithms it is
 * the one that was asked about: the others are those of other renderers, and `log` stands for what a shader may write.
 */
static void add_others(solve_report *r) {
    const dp_mapping asked = r->o->camera.mappings[0];
    const dp_mapping mappings[] = {DP_MAPPING_D3D, DP_MAPPING_REVERSED, is_logarithm(asked) ? asked : DP_MAPPING_LOG};
    dp_spec spec = spec_of(r->o);
    for (size_t f = 0; f < dp_format_count(); f++)
        for (size_t m = 0; m < sizeof mappings / sizeof mappings[0] && dp_format_get(f)->buffer; m++) {
            spec.format = dp_format_get(f)->format;
            spec.mapping = mappings[m];
            spec.model = model_of(r, spec.mapping, false);
            if (listed(r, &spec) || !is_covered(r, &spec) || (spec.mapping == DP_MAPPING_D3D && asked == DP_MAPPING_GL))
                continue;
            if (try_candidate(r, add_candidate(r, &spec, leaves_open(r, &spec.format))) != DP_OK)
                r->count--;
        }
}

/* Without a goal there are no alternatives, and at a slant none is logarithmic. */
static int check_log(const solve_report *r) {
    camera_fault fault = {.key = NULL};
    const bool used =
        camera_serves(&r->o->camera.said, CAMERA_LOG_C, &r->items[0].spec, sizeof r->items[0], r->count, &fault);
    return used ? EXIT_FINE : camera_refuse(&fault);
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

static int compare_numbers(double a, double b) {
    return (a > b) - (a < b);
}

/* Alternatives: what is possible, the cheapest first; then what comes nearest. */
static int compare_alternatives(const void *a, const void *b) {
    const solve_candidate *x = a;
    const solve_candidate *y = b;
    if (x->possible != y->possible)
        return x->possible ? -1 : 1;
    if (x->possible && x->solved != y->solved) /* as it is, rather than with another near */
        return x->solved ? 1 : -1;
    const int price = cost_compare(&x->price, &y->price);
    if (x->possible && price != 0)
        return price;
    const int value = compare_numbers(x->reached.value, y->reached.value);
    return value != 0 ? value : price != 0 ? price : x->place < y->place ? -1 : x->place > y->place;
}

/* More room for the plane that was solved for, a larger distance, or a smaller separation. */
static int compare_room(const solve_report *r, const solve_candidate *x, const solve_candidate *y) {
    if (r->target == SOLVE_FOR_SEPARATION)
        return compare_numbers(x->reached.value, y->reached.value);
    if (!x->possible || !y->possible)
        return 0;
    if (r->target == SOLVE_FOR_DISTANCE)
        return compare_numbers(y->distance.value, x->distance.value);
    if (asks_for_choice(r->target))
        return 0;
    return x->unknown == SOLVE_NEAR ? compare_numbers(x->spec.znear, y->spec.znear)
                                    : compare_numbers(y->spec.zfar, x->spec.zfar);
}

/* The answer among what was asked: with a plane left open, the one that leaves it the most room. */
static int compare_answers(const solve_report *r, const solve_candidate *x, const solve_candidate *y) {
    if (x->asked != y->asked)
        return x->asked ? -1 : 1;
    const int room = compare_room(r, x, y);
    return room != 0 ? room : compare_alternatives(x, y);
}

/* Puts the answer first and the rest behind it in order. */
static void arrange(solve_report *r) {
    size_t best = 0;
    for (size_t i = 1; i < r->count; i++)
        if (compare_answers(r, &r->items[i], &r->items[best]) < 0)
            best = i;
    const solve_candidate answer = r->items[best];
    r->items[best] = r->items[0];
    r->items[0] = answer;
    for (size_t i = 1; i < r->count; i++)
        if (asks_for_choice(r->target))
            try_other_near(r, &r->items[i]);
    for (size_t i = 0; i < r->count; i++)
        r->items[i].place = i;
    if (r->count > 1)
        qsort(r->items + 1, r->count - 1, sizeof r->items[0], compare_alternatives);
}

/* The number of each at any slant, where it is of guaranteed separations and nobody gave a viewport. */
static void add_slanted(solve_report *r) {
    for (size_t i = 0; i < r->count; i++) {
        const solve_candidate *c = &r->items[i];
        solve_candidate *s = &r->slanted[i];
        *s = *c;
        s->solved = false;
        s->spec.triangles.width = 0;
        if (quantity_get(r->kind)->of_surfaces && c->spec.model == DP_MODEL_FLOAT &&
            camera_assumed(&r->o->camera.said, &c->spec, &s->spec) &&
            (c->solved ? solve_plane(r, s, c->unknown) : evaluate(r, s)) != DP_OK)
            s->spec.triangles.width = 0;
    }
}

int cmd_solve(void *request) {
    const solve_request *o = request;
    output out;
    solve_candidate items[SOLVE_CANDIDATES_MAX], slanted[SOLVE_CANDIDATES_MAX];
    solve_report r = {.o = o, .items = items, .slanted = slanted};
    if (o->camera.values[0].sought)
        return solve_preset(o);
    if (o->target == SOLVE_FOR_FRUSTA)
        return solve_frusta(o);
    int status = setup_decided(&o->camera);
    if (status == EXIT_FINE)
        status = check_target(o, &r);
    if (status == EXIT_FINE)
        status = check_depths(o, &r);
    if (status == EXIT_FINE)
        status = solve_check_apart(o, r.target);
    if (status == EXIT_FINE)
        status = add_asked(&r);
    if (status != EXIT_FINE)
        return status;
    if (!isnan(r.limit))
        add_others(&r);
    status = check_log(&r);
    if (status != EXIT_FINE)
        return status;
    arrange(&r);
    add_slanted(&r);
    solve_look_beyond(&r);
    status = output_start(&o->out, &o->camera, &out);
    if (status != EXIT_FINE)
        return status;
    solve_report_write(&r, &out);
    status = output_close(&out);
    return status == EXIT_FINE && !items[0].possible ? EXIT_FAILED : status;
}
