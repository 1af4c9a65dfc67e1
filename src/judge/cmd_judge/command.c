/* SPDX-License-Identifier: GPL-3.0-or-later */
/* judge: what a function of somebody's computes, told from pairs of what went in and what came out, or run for them. */
#include <math.h>
#include <string.h>

#include "camera/cmd/setups.h"
#include "judge/cmd_judge/request.h"
#include "judge/cmd_judge/shader.h"
#include "judge/judge.h"
#include "report/number.h"

enum { SHORT = 3, ENOUGH = 6 };

/* A candidate, in words. */
typedef struct named {
    const char *computes, *formula, *called, *from;
    double factor;
    const char *trap, *right; /* of a formula that is known to be wrong */
    const char *source;
    setup_fields fields;
} named;

typedef struct report {
    const judge_request *o;
    judge_pairs pairs;
    judgement found;
    const char *verdict, *precision;
    named is;
    uint64_t count, nan_count;
    shader code; /* where one is run */
    const char *function, *device, *defines;
} report;

/* The name that people give the output with such a projection. */
static const char *called(const judge_candidate *c) {
    const dp_setup *s = &c->setup;
    const char *own = c->output->called[s->spec.ortho                      ? JUDGE_ORTHO
                                        : s->curve == DP_CURVE_PERSPECTIVE ? JUDGE_PERSPECTIVE
                                                                           : JUDGE_SHADER_DEPTH];
    return own != NULL ? own : c->output->called[JUDGE_PERSPECTIVE];
}

static void name(const judge_request *o, const judge_candidate *c, named *out) {
    *out = (named){.computes = c->output->name,
                   .formula = c->trap != NULL ? c->trap->note : c->output->formula,
                   .called = called(c),
                   .from = c->input->name,
                   .factor = c->factor,
                   .trap = c->trap != NULL ? c->trap->name : NULL,
                   .right = c->trap != NULL ? c->trap->right : NULL,
                   .source = c->trap != NULL ? c->trap->source : c->output->source,
                   .fields = setup_fields_asked(&c->setup, &o->camera)};
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

/* Says the losses; a value stored in bytes is a share of 1, whose error counts as it is. */
static void say_losses(page *p, const report *r) {
    const judgement *j = &r->found;
    char off[NUMBER_SIZE + 32] = "";
    if (j->off == 0) {
        page_note(p, "loses", "nothing: the values are exact");
        return;
    }
    if (j->precision >= JUDGE_BYTES && j->precision < JUDGE_QUICK)
        snprintf(off, sizeof off, ", and %s of full scale", number_brief(number_up(j->off, SHORT)).text);
    if (isnan(j->at))
        page_note(p, "loses", "%s where it must be 0: %s", number_brief(number_up(j->off, SHORT)).text, r->precision);
    else
        page_note(p, "loses", "%s of the value at most, at %s%s: %s", number_brief(number_up(j->error, SHORT)).text,
                  number_full(j->at).text, off, r->precision);
    if (!isnan(j->intervals))
        page_note(p, "buffer", "up to %s z-fighting intervals of %s, at z = %s",
                  number_brief(number_up(j->intervals, SHORT)).text, j->found.setup.spec.format.name,
                  camera_length(&r->o->camera, j->z, ENOUGH).text);
}

static void say_all(page *p, void *item) {
    const report *r = item;
    const judgement *j = &r->found;
    char text[SETUP_LABEL_SIZE];
    if (j->named)
        shader_say(r->o, &j->found, text);
    page_title(p, "%s%s%s", r->verdict, j->because != NULL || j->named ? ": " : "",
               j->because != NULL ? j->because : text);
    if (j->because != NULL && j->named)
        page_note(p, "fits", "%s", text);
    if (j->named) {
        page_note(p, "formula", "%s", r->is.formula);
        page_note(p, r->is.trap != NULL ? "right is" : "called", "%s", r->is.trap != NULL ? r->is.right : r->is.called);
        say_losses(p, r);
    }
    for (size_t i = 0; i < j->same_count; i++) {
        shader_say(r->o, &j->same[i], text);
        page_note(p, "the same", "%s%s%s", text, j->same[i].trap != NULL ? "; right: " : "",
                  j->same[i].trap != NULL ? j->same[i].trap->right : "");
    }
    if (j->also) {
        shader_say(r->o, &j->other, text);
        page_note(p, "fits, too", "%s; at %s they part", text, number_full(j->decides).text);
    }
    if (j->strays > 0)
        page_note(p, "strays", "%s of %s values, the first at %s", number_full((double)j->strays).text,
                  number_full((double)r->count).text, number_full(j->stray).text);
    if (r->device != NULL) {
        page_note(p, "run on", "%s, with %s depths%s", r->device, number_full((double)r->code.count).text,
                  r->code.too_long ? ", since more do not come to an end in time" : "");
        page_note(p, "given", "%s", r->defines[0] != '\0' ? r->defines : "nothing of a camera");
    }
    if (r->nan_count > 0)
        page_note(p, "left out", "%s of %s values, which are no numbers, the first at %s",
                  number_full((double)r->nan_count).text, number_full((double)(r->count + r->nan_count)).text,
                  number_full(r->pairs.nan_at).text);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static const column named_columns[] = {{FIELD(named, computes, "computes", "")},   {FIELD(named, from, "from", "")},
                                       {FIELD(named, formula, "formula", "")},     {FIELD(named, called, "called", "")},
                                       {FIELD(named, factor, "factor", "")},       {FIELD(named, trap, "trap", "")},
                                       {FIELD(named, right, "right", "")},         {FIELD(named, source, "source", "")},
                                       {PART(named, fields, NULL, setup_columns)}, {.kind = COLUMN_END}};

static void *found_of(void *of, size_t i) {
    report *r = of;
    const judgement *j = &r->found;
    if (!j->named || i > j->same_count + j->also)
        return NULL;
    name(r->o, i == 0 ? &j->found : i <= j->same_count ? &j->same[i - 1] : &j->other, &r->is);
    return &r->is;
}

static const column columns[] = {{FIELD(report, verdict, "verdict", "")},
                                 {FIELD(report, found.because, "because", "")},
                                 {FIELD(report, precision, "precision", "")},
                                 {FIELD(report, found.error, "error", "1")},
                                 {FIELD(report, found.at, "at", "")},
                                 {FIELD(report, found.off, "off", "")},
                                 {FIELD(report, found.intervals, "intervals", "")},
                                 {FIELD(report, found.z, "intervals_z", "scene")},
                                 {FIELD(report, found.decides, "decides", "")},
                                 {FIELD(report, count, "pairs", "")},
                                 {FIELD(report, nan_count, "left_out", "")},
                                 {FIELD(report, found.strays, "strays", "")},
                                 {FIELD(report, found.stray, "stray", "")},
                                 {FIELD(report, function, "function", "")},
                                 {FIELD(report, device, "device", "")},
                                 {FIELD(report, defines, "defines", "")},
                                 {LIST("fits", named_columns, found_of), .only = AS_JSON | AS_CSV},
                                 {.kind = COLUMN_END}};

/* ---- What to ask ------------------------------------------------------------------------------------------------- */

typedef struct asked {
    double depth;
    unsigned count;
} asked;

static void *next_depth(void *of, size_t i) {
    asked *a = of;
    a->depth = i < a->count ? shader_asked((unsigned)i, a->count) : 0;
    return i < a->count ? a : NULL;
}

static void write_depths(output *out, output_form form, unsigned count) {
    static const column each[] = {{FIELD(asked, depth, "depth", "")}, {.kind = COLUMN_END}};
    static const column all[] = {{LIST("depths", each, next_depth)}, {.kind = COLUMN_END}};
    asked a = {.count = count};
    if (form == FORM_JSON) {
        report_write(&(report_spec){"judge", all, &a, .label = 0}, out, form);
        return;
    }
    output_text(out, "depth\n");
    for (size_t i = 0; next_depth(&a, i) != NULL; i++) {
        output_text(out, number_of(a.depth, 9).text);
        output_char(out, '\n');
    }
}

/* ---- A shader ---------------------------------------------------------------------------------------------------- */

static int judge_shader(report *r, const setups *all, judge_open open) {
    judgement *j = &r->found;
    int status = shader_judge(&r->code, all->items, all->count, open, &r->pairs, j);
    r->count = r->pairs.count;
    if (status == EXIT_FINE && j->named) {
        status = shader_all(&r->code, &r->pairs, j);
        r->count = r->code.count - r->pairs.nan_count;
    }
    if (j->strays > 0) {
        j->verdict = JUDGE_UNKNOWN;
        j->because = "what fits many depths does not fit all";
    }
    r->function = r->o->line->operands[0];
    r->device = r->code.device;
    r->defines = r->code.defines;
    return status;
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

static int read_pairs(const judge_request *o, judge_pairs *pairs) {
    char error[PAIRS_ERROR_SIZE];
    const int status = judge_pairs_read(o->judge.pairs, pairs, error);
    if (status > 0) {
        usage_error("%s: %s", o->judge.pairs, strerror(status));
        return EXIT_IO;
    }
    return status < 0 ? usage_error("%s: %s", o->judge.pairs, error) : EXIT_FINE;
}

static int run(report *r, const setups *all, output *out) {
    const judge_request *o = r->o;
    const bool near = option_given(o->line, "near"), far = option_given(o->line, "far");
    const judge_open open = camera_says_planes(&o->camera.said)
                                ? JUDGE_OPEN_NONE
                                : (near ? 0 : JUDGE_OPEN_NEAR) | (far ? 0 : JUDGE_OPEN_FAR);
    int status = EXIT_FINE;
    if (o->judge.pairs == NULL) {
        status = judge_shader(r, all, open);
    } else {
        judge_function(&r->pairs, all->items, all->count, open, &r->found);
        r->count = r->pairs.count;
    }
    if (status != EXIT_FINE) {
        output_abandon(out);
        return status;
    }
    r->nan_count = r->pairs.nan_count;
    r->verdict = judge_verdict_name(r->found.verdict);
    r->precision = r->found.named ? judge_precision_name(r->found.precision) : NULL;
    if (r->found.named)
        name(o, &r->found.found, &r->is);
    report_write(&(report_spec){"judge", columns, r, .label = 10, .head = say_all}, out, o->out.form);
    return output_close(out);
}

int cmd_judge(void *request) {
    const judge_request *o = request;
    output out;
    setups all = {0};
    report r = {.o = o};
    const bool for_depths = o->judge.depths > 0, shaded = o->line->operand_count > 0;
    if ((o->judge.pairs != NULL) + for_depths + shaded != 1)
        return usage_error("judge needs FILE:FUNCTION, or --pairs FILE, or --pairs-for N, which prints depths to ask a "
                           "function for");
    if (!for_depths && o->camera.format_count > 1)
        return option_error("format", "must be one format, got %zu", o->camera.format_count);
    int status = for_depths ? EXIT_FINE : setups_make(&o->camera, &all);
    if (status == EXIT_FINE && o->judge.pairs != NULL)
        status = read_pairs(o, &r.pairs);
    if (status == EXIT_FINE && shaded)
        status = shader_open(o, &all.items[0], o->line->operands[0], false, &r.code);
    if (status == EXIT_FINE)
        status = output_start(&o->out, &o->camera, &out);
    if (status == EXIT_FINE && for_depths) {
        write_depths(&out, o->out.form, o->judge.depths);
        status = output_close(&out);
    } else if (status == EXIT_FINE) {
        status = run(&r, &all, &out);
    }
    shader_close(&r.code);
    judge_pairs_free(&r.pairs);
    setups_release(&all);
    return status;
}
