/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The stored codes judge hypotheses: each predicts every pixel, and its hits are counted. */
#ifndef PROBE_JUDGE_H
#define PROBE_JUDGE_H

#include "probe/hypotheses.h"

typedef struct guess {
    const char *words;
    uint64_t hits;
} guess;

enum { JUDGE_NONE = -1 };

/* So many hypotheses of a key from that one on, none of them hit yet. */
void judge_words(guess *all, probe_key key, size_t first, size_t count);

/* The finding of hypotheses that were counted over so many cases. Returns the place of the one that is sure, or
 * JUDGE_NONE. */
int judge_guesses(probe_result *r, probe_key key, const char *format, const guess *all, size_t count, uint64_t cases);

/* A finding that is no choice between hypotheses. */
probe_finding *judge_say(probe_result *r, probe_key key, const char *format, probe_certainty sure, const char *words,
                         ...) __attribute__((format(printf, 5, 6)));

/* Clip z from 0 to w of a vertex: of one from -w to w what translators to other APIs make of it in the vertex shader.
 */
float judge_clip(const shot *s, const float vertex[4]);

/* The shot, where it was drawn; else null. */
const shot *judge_shot(const probe_result *r, plan_shot kind, shot_format format);

/* judge_points.c: sets r->arith. judge_triangles.c: sets r->raster. judge_bias.c */
void judge_points(probe_result *r);
void judge_triangles(probe_result *r);
void judge_bias(probe_result *r);

/* Fills in the findings from the codes of the plan. */
void probe_judge(probe_result *r);

#endif
