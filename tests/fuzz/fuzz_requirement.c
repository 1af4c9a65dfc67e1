/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Requirement files as anybody might mangle them. What is refused says why on one line; what is accepted holds nothing
 * that the header does not promise, and every verdict on it is sound.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "solve/check.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(int truth) {
    if (!truth)
        abort();
}

static bool count_nothing(void *context, const dp_setup *setup, double lo, double hi, bool sample, double *share,
                          double *z) {
    (void)context, (void)setup, (void)sample;
    demand(lo < hi && isfinite(hi));
    *share = 0.5;
    *z = lo;
    return true;
}

static void use(const need_file *file) {
    demand(file->count >= 1 && file->camera_count >= 1);
    for (size_t i = 0; i < file->count; i++) {
        const need *n = &file->needs[i];
        demand(n->camera < file->camera_count && n->name[0] != '\0' && n->line >= 1);
        demand(isfinite(n->limit) && n->limit >= 0.0 && n->lo <= n->hi && isfinite(n->lo));
        const dp_spec *spec = &file->cameras[n->camera].setups[0].spec;
        demand(spec->znear <= n->lo && n->hi <= spec->zfar);
    }
    const size_t count = check_count(file);
    check_verdict *verdicts = calloc(count, sizeof *verdicts);
    if (verdicts == NULL || count > 256) {
        free(verdicts);
        return;
    }
    const check_request request = {file, count_nothing, NULL};
    demand(check_all(&request, verdicts) >= 0);
    for (size_t i = 0; i < count; i++)
        demand(verdicts[i].value >= 0.0 && (verdicts[i].value <= verdicts[i].asked->limit) == verdicts[i].passed);
    free(verdicts);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    need_file file;
    need_error error;
    if (text == NULL)
        return 0;
    memcpy(text, data, size);
    text[size] = '\0';
    if (need_parse("fuzz", text, size, &file, &error)) {
        use(&file);
        need_release(&file);
    } else {
        demand(error.text[0] != '\0' && strchr(error.text, '\n') == NULL && error.line >= 0);
    }
    free(text);
    return 0;
}
