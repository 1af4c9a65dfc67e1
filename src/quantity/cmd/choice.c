/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd/choice.h"

#include <math.h>
#include <stdio.h>

#include "quantity/cmd/resolved.h"
#include "report/number.h"

/* The fullest model that the set-up has: what the others are measured by. */
static int fullest(const dp_choice *choice) {
    return isnan(choice->share[DP_MODEL_FLOAT]) ? DP_MODEL_STAGED : DP_MODEL_FLOAT;
}

/* The first that neglects no more than is allowed. */
static dp_model simplest(const dp_choice *choice, double tolerance) {
    int m = DP_MODEL_EXACT;
    while (m < fullest(choice) && choice->share[m] > tolerance)
        m++;
    return (dp_model)m;
}

choosing choosing_start(const dp_setup *setup, double tolerance) {
    return (choosing){.setup = setup,
                      .tolerance = tolerance,
                      .exact = resolved_in(setup, DP_MODEL_EXACT),
                      .full = dp_setup_guaranteed(setup)};
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
    dp_spec spec = setup->spec;
    if (!c->model_auto)
        return;
    spec.model = choose_at(setup, c->tolerance, at).choice.model;
    dp_setup_init(setup, &spec); /* the choice is among the models that the set-up has */
}

/* "makes this 3.03 times worse at z = 316.228"; what is less than double is said in percent. */
static void effect(double share, number_text depth, bool at_most, char *out, size_t size) {
    const char *most = at_most ? "at most " : "";
    if (isinf(share))
        snprintf(out, size, "leaves nothing resolved at z = %s", depth.text);
    else if (share >= 1.0)
        snprintf(out, size, "makes this %s%s times worse at z = %s", most, number_of(share + 1.0, 3).text, depth.text);
    else
        snprintf(out, size, "makes this %s%s %% worse at z = %s", most, number_of(100.0 * share, 3).text, depth.text);
}

static choice_words shader_sentence(const choosing *c, const char *unit) {
    const bool enough = c->shader_share <= c->tolerance;
    char what[sizeof(choice_words) / 2];
    choice_words out;
    effect(c->shader_share, number_in(number_of(c->shader_z, 6), unit), enough, what, sizeof what);
    snprintf(out.text, sizeof out.text, "the arithmetic of the shader %s: %s", what,
             enough ? "the lattice suffices" : "'depthprec budget' shows the causes");
    return out;
}

choice_words choice_sentence(const choosing *c, const char *unit) {
    if (c->full.shader)
        return shader_sentence(c, unit);
    const dp_choice *choice = &c->choice;
    const bool arithmetic = fullest(choice) == DP_MODEL_FLOAT;
    const double share = choice->share[DP_MODEL_EXACT];
    char subject[64] = "rounding to binary32";
    char what[sizeof(choice_words) / 2];
    choice_words out;
    if (arithmetic)
        snprintf(subject, sizeof subject, c->setup->spec.arith != 0 ? "float arithmetic (%s)" : "float arithmetic",
                 dp_arith_get(c->setup->spec.arith)->name);
    effect(share, number_in(number_of(choice->share_z[DP_MODEL_EXACT], 6), unit), choice->model == DP_MODEL_EXACT, what,
           sizeof what);
    snprintf(out.text, sizeof out.text, "%s %s: %s", subject, share > 0.0 ? what : "adds nothing",
             choice->model == DP_MODEL_EXACT    ? "the lattice suffices"
             : choice->model == DP_MODEL_STAGED ? "--model staged captures this"
                                                : "--model float is needed");
    return out;
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
    out->staged = fullest(&c->choice) > DP_MODEL_STAGED ? &out->staged_share : NULL;
    out->shader = c->full.shader ? &out->shader_share : NULL;
}
