/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "core/append.h"
#include "probe/judge.h"

const char *probe_certainty_name(probe_certainty certainty) {
    static const char *const names[PROBE_CERTAINTIES] = {"sure", "open", "no row", "measured"};
    return certainty < PROBE_CERTAINTIES ? names[certainty] : "";
}

const char *probe_format_name(shot_format format) {
    static const char *const names[SHOT_FORMATS] = {"d16", "d24", "d32f"};
    return names[format];
}

float judge_clip(const shot *s, const float vertex[4]) {
    return s->ndc_signed ? (vertex[2] + vertex[3]) * 0.5F : vertex[2];
}

const shot *judge_shot(const probe_result *r, plan_shot kind, shot_format format) {
    const shot *s = plan_find(&r->plan, kind, format);
    return s != NULL && s->drawn ? s : NULL;
}

probe_finding *judge_say(probe_result *r, probe_key key, const char *format, probe_certainty sure, const char *words,
                         ...) {
    static probe_finding beyond; /* never: tests draw all there is */
    probe_finding *f = r->count < PROBE_FINDINGS_MAX ? &r->finding[r->count++] : &beyond;
    va_list arguments;
    *f = (probe_finding){.key = probe_key_name(key), .format = format, .sure = sure, .value = (double)NAN};
    va_start(arguments, words);
    vsnprintf(f->words, sizeof f->words, words, arguments);
    va_end(arguments);
    return f;
}

void judge_words(guess *all, probe_key key, size_t first, size_t count) {
    for (size_t i = 0; i < count; i++)
        all[i] = (guess){probe_hypothesis(key, first + i), 0};
}

int judge_guesses(probe_result *r, probe_key key, const char *format, const guess *all, size_t count, uint64_t cases) {
    size_t best = 0, next = count, perfect = 0;
    for (size_t i = 0; i < count; i++) {
        perfect += all[i].hits == cases;
        if (all[i].hits > all[best].hits)
            best = i;
    }
    for (size_t i = 0; i < count; i++)
        if (i != best && (next == count || all[i].hits > all[next].hits))
            next = i;
    const probe_certainty sure = cases == 0 || perfect == 0 ? PROBE_NO_ROW : perfect == 1 ? PROBE_SURE : PROBE_OPEN;
    probe_finding *f =
        judge_say(r, key, format, sure, "%s%s", sure == PROBE_NO_ROW ? PROBE_NEAREST : "", all[best].words);
    for (size_t i = best + 1; sure == PROBE_OPEN && i < count; i++)
        if (all[i].hits == cases)
            append(f->words, sizeof f->words, PROBE_OR "%s", all[i].words);
    f->cases = cases;
    f->hits = all[best].hits;
    f->next = next < count ? all[next].words : NULL;
    f->next_hits = next < count ? all[next].hits : 0;
    return sure == PROBE_SURE ? (int)best : JUDGE_NONE;
}
