/* SPDX-License-Identifier: MIT */
/* Window depths that were read back: their codes, and from these eye depths and cells, a block at a time. */
#include <string.h>

#include "depthprec/batch.h"

enum { BLOCK = 1024, OUTPUTS = 3 };

static size_t size_of(dp_real real) {
    return real == DP_REAL_FLOAT ? sizeof(float) : sizeof(double);
}

/* Whether one of a block is no number: loops that become vectors. */
static int has_none(dp_real real, const unsigned char *from, size_t count) {
    float narrow[BLOCK];
    double wide[BLOCK];
    int any = 0;
    memcpy(real == DP_REAL_FLOAT ? (void *)narrow : (void *)wide, from, count * size_of(real));
    if (real == DP_REAL_FLOAT)
        for (size_t i = 0; i < count; i++)
            any |= narrow[i] != narrow[i];
    else
        for (size_t i = 0; i < count; i++)
            any |= wide[i] != wide[i];
    return any;
}

/* NaN stays NaN: the code it was given says nothing. */
static void keep_none(dp_real real, const unsigned char *from, unsigned char *to, size_t count) {
    const size_t size = size_of(real);
    for (size_t i = 0; i < count; i++)
        if (has_none(real, from + i * size, 1))
            memcpy(to + i * size, from + i * size, size);
}

dp_status dp_batch_windows(const dp_setup *setup, dp_real real, const void *windows, void *eye, void *lo, void *hi,
                           size_t count) {
    static const dp_task tasks[OUTPUTS] = {DP_TASK_EYE, DP_TASK_LO, DP_TASK_HI};
    void *const outputs[OUTPUTS] = {eye, lo, hi};
    dp_batch encode, decode[OUTPUTS];
    uint32_t codes[BLOCK];
    if (setup == NULL || (count > 0 && windows == NULL))
        return DP_ERROR_NULL;
    if ((unsigned)real >= DP_REAL_COUNT)
        return DP_ERROR_BATCH;
    dp_setup nearest = *setup;
    nearest.spec.rounding = DP_ROUND_NEAREST;
    dp_status status = dp_batch_init(&encode, &nearest, DP_TASK_ENCODE, real, DP_WORD_32, dp_path_best());
    for (int k = 0; k < OUTPUTS && status == DP_OK; k++)
        status = dp_batch_init(&decode[k], setup, tasks[k], real, DP_WORD_32, dp_path_best());
    const size_t size = size_of(real);
    for (size_t done = 0; done < count && status == DP_OK; done += BLOCK) {
        const size_t some = count - done < BLOCK ? count - done : BLOCK;
        const unsigned char *from = (const unsigned char *)windows + done * size;
        dp_batch_run(&encode, from, codes, some);
        const int any = has_none(real, from, some);
        for (int k = 0; k < OUTPUTS; k++) {
            unsigned char *const to = outputs[k] == NULL ? NULL : (unsigned char *)outputs[k] + done * size;
            if (to == NULL)
                continue;
            dp_batch_run(&decode[k], codes, to, some);
            if (any)
                keep_none(real, from, to, some);
        }
    }
    return status;
}
