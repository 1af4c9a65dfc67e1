/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd/choice.h"

#include <math.h>
#include <stdio.h>

#include "core/engine.h"
#include "report/sentence.h"

/* The fullest model that the set-up has: what the others are measured by. */
static int fullest(const dp_choice *choice) {
    return isnan(choice->share[DP_MODEL_FLOAT]) ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
}

/* The first that neglects no more than is allowed. */
static dp_model simplest(const dp_choice *choice, double tolerance) {
    int m = DP_MODEL_EXACT;
    while (m < fullest(choice) && !(choice->share[m] <= tolerance)) /* NaN: the set-up has it not */
        m++;
    return (dp_model)m;
}

choosing choosing_start(const dp_setup *setup, double tolerance) {
    choosing c = {.setup = setup, .tolerance = tolerance, .full = dp_setup_guaranteed(setup)};
    dp_setup_in(setup, DP_MODEL_EXACT, &c.exact); /* which all mappings have */
    return c;
}

/* A shader is no model: it has no codes. */
static void add_shader(choosing *c, double z) {
    const double share = dp_separation(&c->full, z) / dp_separation(&c->exact, z) - 1.0;
    if (share > c->shader_share) {
        c->shader_share = share;
        c->shader_z = z;
    }
}

/* The worst of what the blocks say. */
void choosing_finish(choosing *c) {
    dp_choice block;
    if (c->waiting == 0 || dp_model_choose(c->setup, c->z, c->waiting, c->tolerance, &block) != DP_OK)
        return;
    c->waiting = 0;
    if (!c->begun)
        c->choice = block;
    c->begun = true;
    for (int m = 0; m < DP_MODEL_COUNT; m++)
        if (block.share[m] > c->choice.share[m]) {
            c->choice.share[m] = block.share[m];
            c->choice.share_z[m] = block.share_z[m];
        }
    c->choice.model = simplest(&c->choice, c->tolerance);
}

void choosing_add(choosing *c, double z) {
    c->z[c->waiting++] = z;
    if (c->full.shader)
        add_shader(c, z);
    if (c->waiting == CHOICE_BLOCK)
        choosing_finish(c);
}

choosing choose_at(const dp_setup *setup, double tolerance, const depths *at) {
    choosing c = choosing_start(setup, tolerance);
    for (size_t i = 0; i < at->count; i++)
        choosing_add(&c, depths_get(at, i));
    choosing_finish(&c);
    return c;
}

void setup_choose(const camera_asked *c, const depths *at, dp_setup *setup) {
    if (c->model_auto) /* the choice is among the models that the set-up has */
        dp_setup_in(setup, choose_at(setup, c->tolerance, at).choice.model, setup);
}

static const column share_columns[] = {
    {FIELD(choice_share, share, "share", "")}, {FIELD(choice_share, z, "z", "scene")}, {.kind = COLUMN_END}};

/* The models that are simpler than the fullest. */
static const column neglected_columns[] = {
    {PART(choice_fields, exact, "exact", share_columns)},
    {PART(choice_fields, staged, "staged", share_columns), .pointed = true, .optional = true},
    {.kind = COLUMN_END}};

const column choice_columns[] = {
    {FIELD(choice_fields, model, "model", "")},
    {PART(choice_fields, of_model, NULL, share_columns)},
    {FIELD(choice_fields, tolerance, "tolerance", "")},
    {GROUP("neglected", neglected_columns)},
    {PART(choice_fields, shader, "shader", share_columns), .pointed = true, .optional = true},
    {.kind = COLUMN_END}};

static choice_share share_of(const dp_choice *choice, int model) {
    const double share = choice->share[model];
    return (choice_share){share, share > 0.0 ? choice->share_z[model] : (double)NAN};
}

void choice_fields_of(const choosing *c, choice_fields *out) {
    *out = (choice_fields){.model = dp_model_name(c->choice.model),
                           .of_model = share_of(&c->choice, (int)c->choice.model),
                           .tolerance = c->tolerance,
                           .exact = share_of(&c->choice, DP_MODEL_EXACT),
                           .staged_share = share_of(&c->choice, DP_MODEL_STAGED),
                           .shader_share = {c->shader_share, c->shader_share > 0.0 ? c->shader_z : (double)NAN}};
    const bool staged = fullest(&c->choice) > DP_MODEL_STAGED && !isnan(c->choice.share[DP_MODEL_STAGED]);
    out->staged = staged ? &out->staged_share : NULL;
    out->shader = c->full.shader ? &out->shader_share : NULL;
}

/* ---- In a sentence ----------------------------------------------------------------------------------------------- */

/* The worst that the simplest model leaves out, and what follows. */
typedef struct told {
    const char *before, *subject, *arith, *most, *verdict;
    double times, percent, z;
} told;

static const column told_columns[] = {{FIELD(told, before, "before", "")},
                                      {FIELD(told, subject, "subject", "")},
                                      {FIELD(told, arith, "arith", "")},
                                      {FIELD(told, most, "most", "")},
                                      {FIELD(told, verdict, "verdict", "")},
                                      {FIELD(told, times, "times", ""), .digits = 3, .upward = true},
                                      {FIELD(told, percent, "percent", ""), .digits = 3, .upward = true},
                                      {FIELD(told, z, "z", "scene"), .digits = 6},
                                      {.kind = COLUMN_END}};

enum { ADDS_NOTHING = 1, LEAVES_NOTHING = 2, MUCH = 4 };

static const sentence told_words[] = {
    LINE("{before}{subject}{arith} adds nothing: {verdict}", ADDS_NOTHING),
    ELSE("{before}{subject}{arith} leaves nothing resolved at z = {z}: {verdict}", LEAVES_NOTHING),
    ELSE("{before}{subject}{arith} makes the guarantee {most}{times} times the lattice at z = {z}: {verdict}", MUCH),
    ELSE("{before}{subject}{arith} makes the guarantee {most}{percent} % more than the lattice at z = {z}: {verdict}",
         0),
    SENTENCE_END};

void choice_say(page *p, const choosing *c, const char *before) {
    static const char *const verdicts[DP_MODEL_COUNT] = {"the lattice suffices", "--model staged captures this",
                                                         "--model float is needed"};
    const bool shader = c->full.shader, arithmetic = fullest(&c->choice) == DP_MODEL_FLOAT && !shader;
    const double share = shader ? c->shader_share : c->choice.share[DP_MODEL_EXACT];
    const bool enough = shader ? share <= c->tolerance : c->choice.model == DP_MODEL_EXACT;
    char arith[64] = "";
    if (arithmetic && c->setup->spec.arith != 0)
        snprintf(arith, sizeof arith, " (%s)", dp_arith_get(c->setup->spec.arith)->name);
    told t = {before,
              shader       ? "the arithmetic of the shader"
              : arithmetic ? "float arithmetic"
                           : "rounding to binary32",
              arith,
              enough ? "at most " : "",
              shader && !enough ? "'depthprec budget' shows the causes" : verdicts[enough ? 0 : c->choice.model],
              share + 1.0,
              100.0 * share,
              shader ? c->shader_z : c->choice.share_z[DP_MODEL_EXACT]};
    page_say(p, told_words, told_columns, &t,
             (share > 0.0 || shader ? 0 : ADDS_NOTHING) | (isinf(share) ? LEAVES_NOTHING : 0) |
                 (share >= 0.01 ? MUCH : 0));
}
