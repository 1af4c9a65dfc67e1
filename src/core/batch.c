/* SPDX-License-Identifier: MIT */
/* Arrays by blocks: a kernel does a block, and what it leaves in doubt is done by the scalar functions. */
#include "depthprec/batch.h"

#include <math.h>
#include <string.h>
/* Compiled with -DDP_BASELINE the library has the baseline alone, as on processors without vectors of their own. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(DP_BASELINE)
#define ASK_PROCESSOR
#include <cpuid.h>
#endif

#include "core/batch_plan.h"
#include "core/bits.h"
#include "core/guarantee.h"
#include "depthprec/depth.h"

enum { BLOCK = 1024, PATCH = 16, LINE = 64 };

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static int always(void) {
    return 1;
}

#ifdef ASK_PROCESSOR
/* The compiler's own table costs nothing; asking the processor costs tens of microseconds in a virtual
 * machine. But not every compiler has a name for F16C. */
static int has_f16c(void) {
#ifdef __clang__
    unsigned a, b, c, d;
    return __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C) != 0;
#else
    return __builtin_cpu_supports("f16c") != 0;
#endif
}

static int has_avx2(void) {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && has_f16c();
}

static int has_avx512(void) {
    return has_avx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
#else
static int has_avx2(void) {
    return 0;
}

static int has_avx512(void) {
    return 0;
}
#endif

static const struct {
    const char *name;
    int (*available)(void);
    dp_batch_kernel *const *table;
} paths[DP_PATH_COUNT] = {
    [DP_PATH_BASELINE] = {"baseline", always, dp_batch_baseline},
    [DP_PATH_AVX2] = {"avx2", has_avx2, dp_batch_avx2},
    [DP_PATH_AVX512] = {"avx512", has_avx512, dp_batch_avx512},
};

const char *dp_path_name(dp_path path) {
    return (unsigned)path < DP_PATH_COUNT ? paths[path].name : NULL;
}

int dp_path_available(dp_path path) {
    return (unsigned)path < DP_PATH_COUNT && paths[path].available();
}

dp_path dp_path_best(void) {
    unsigned best = DP_PATH_COUNT - 1;
    while (!paths[best].available())
        best--;
    return (dp_path)best;
}

/* ---- Making -------------------------------------------------------------------------------------------------------*/

dp_status dp_batch_init(dp_batch *batch, const dp_setup *setup, dp_task task, dp_real real, dp_word word,
                        dp_path path) {
    if (batch == NULL || setup == NULL)
        return DP_ERROR_NULL;
    if ((unsigned)task >= DP_TASK_COUNT || (unsigned)real >= DP_REAL_COUNT || (unsigned)word >= DP_WORD_COUNT ||
        !dp_path_available(path))
        return DP_ERROR_BATCH;
    if (word == DP_WORD_16 && setup->spec.format.bits > 16)
        return DP_ERROR_FORMAT;
    const size_t real_size = real == DP_REAL_FLOAT ? sizeof(float) : sizeof(double);
    const size_t word_size = word == DP_WORD_16 ? sizeof(uint16_t) : sizeof(uint32_t);
    *batch = (dp_batch){.setup = *setup,
                        .task = task,
                        .real = real,
                        .word = word,
                        .path = path,
                        .in_size = dp_task_reads_code(task) ? word_size : real_size,
                        .out_size = dp_task_writes_code(task) ? word_size : real_size};
    dp_batch_plan(batch, paths[path].table);
    return DP_OK;
}

/* ---- Running ------------------------------------------------------------------------------------------------------*/

static double read_real(const dp_batch *b, const unsigned char *at) {
    float narrow;
    double wide;
    if (b->real == DP_REAL_FLOAT) {
        memcpy(&narrow, at, sizeof narrow);
        return (double)narrow;
    }
    memcpy(&wide, at, sizeof wide);
    return wide;
}

static void write_real(const dp_batch *b, unsigned char *at, double wide) {
    const float narrow = (float)wide;
    if (b->real == DP_REAL_FLOAT)
        memcpy(at, &narrow, sizeof narrow);
    else
        memcpy(at, &wide, sizeof wide);
}

static uint32_t read_code(const dp_batch *b, const unsigned char *at) {
    uint16_t narrow;
    uint32_t wide;
    if (b->word == DP_WORD_16) {
        memcpy(&narrow, at, sizeof narrow);
        wide = narrow;
    } else {
        memcpy(&wide, at, sizeof wide);
    }
    return wide < b->setup.spec.format.code_max ? wide : b->setup.spec.format.code_max;
}

static void write_code(const dp_batch *b, unsigned char *at, uint32_t wide) {
    const uint16_t narrow = (uint16_t)wide;
    if (b->word == DP_WORD_16)
        memcpy(at, &narrow, sizeof narrow);
    else
        memcpy(at, &wide, sizeof wide);
}

/* Whether a depth is one of the camera's; a float next to a plane is that plane, rounded. */
static int enter(const dp_batch *b, double *z) {
    const dp_spec *s = &b->setup.spec;
    const int narrow = b->real == DP_REAL_FLOAT;
    if (narrow && *z < s->znear && *z == (double)dp_float_down(s->znear))
        *z = s->znear;
    if (narrow && *z > s->zfar && *z == (double)dp_float_up(s->zfar))
        *z = s->zfar;
    return *z >= s->znear && *z <= s->zfar;
}

/* The number of a task whose result is no code, at an eye depth. */
static double number_at(const dp_batch *b, double z) {
    const dp_setup *s = &b->setup;
    if (!enter(b, &z))
        return (double)NAN;
    return b->task == DP_TASK_WINDOW ? dp_window(s, z) : dp_cell_of(s, dp_code(s, z)).width;
}

/* Outward, where a bound becomes a float. */
static double outward(const dp_batch *b, double wide) {
    if (b->real != DP_REAL_FLOAT || isnan(wide))
        return wide;
    return (double)(b->task == DP_TASK_LO ? dp_float_down(wide) : dp_float_up(wide));
}

/* All at once, because many together take less; NaN beyond the planes. Other tasks do without its stack. */
static __attribute__((noinline)) void run_separations(const dp_batch *b, const unsigned char *from, unsigned char *to,
                                                      size_t count) {
    const dp_guarantee guarantee = dp_guarantee_make(&b->setup);
    const dp_stretches *kept = dp_batch_read(b)->kept;
    dp_stretches stretches;
    double z[BLOCK], found[BLOCK];
    unsigned char inside[BLOCK];
    stretches.count = 0;
    if (kept == NULL && count >= DP_STRETCHES_PAY)
        dp_stretches_find(&stretches, &guarantee);
    for (size_t some = BLOCK; count > 0; count -= some, from += some * b->in_size, to += some * b->out_size) {
        some = count < BLOCK ? count : BLOCK;
        for (size_t i = 0; i < some; i++) {
            z[i] = read_real(b, from + i * b->in_size);
            inside[i] = (unsigned char)enter(b, &z[i]);
            if (!inside[i])
                z[i] = b->setup.spec.znear;
        }
        dp_guarantee_many(&guarantee, kept != NULL ? kept : &stretches, z, found, some);
        for (size_t i = 0; i < some; i++)
            write_real(b, to + i * b->out_size, outward(b, inside[i] ? found[i] : (double)NAN));
    }
}

/* One by one. */
static void run_plain(const dp_batch *b, const unsigned char *from, unsigned char *to, size_t count) {
    const dp_spec *spec = &b->setup.spec;
    for (size_t i = 0; i < count; i++, from += b->in_size, to += b->out_size)
        switch (b->task) {
        case DP_TASK_CODE:
            write_code(b, to, dp_code(&b->setup, read_real(b, from)));
            break;
        case DP_TASK_ENCODE:
            write_code(b, to, dp_format_encode(&spec->format, spec->rounding, read_real(b, from)));
            break;
        case DP_TASK_EYE:
            write_real(b, to, dp_stored(&b->setup, read_code(b, from)));
            break;
        case DP_TASK_WIDTH:
            write_real(b, to, dp_cell_of(&b->setup, read_code(b, from)).width);
            break;
        case DP_TASK_DECODE:
            write_real(b, to, dp_format_value(&spec->format, read_code(b, from)));
            break;
        case DP_TASK_LO:
            write_real(b, to, outward(b, dp_cell_of(&b->setup, read_code(b, from)).lo));
            break;
        case DP_TASK_HI:
            write_real(b, to, outward(b, dp_cell_of(&b->setup, read_code(b, from)).hi));
            break;
        case DP_TASK_SEPARATION:
        case DP_TASK_WINDOW:
        case DP_TASK_INTERVAL:
        default:
            write_real(b, to, number_at(b, read_real(b, from)));
        }
}

/* One kernel call, with conversions around a general one; at most BLOCK elements. */
static int32_t run_kernel(const dp_batch *b, const void *from, void *to, size_t count) {
    dp_batch_kernel *const *const kernel = paths[b->path].table;
    if (dp_batch_read(b)->direct)
        return kernel[dp_batch_read(b)->kernel](b, from, to, count);
    double wide[BLOCK];
    uint32_t codes[BLOCK];
    const int narrow_real = b->real == DP_REAL_FLOAT;
    const int narrow_code = b->word == DP_WORD_16;
    if (dp_task_reads_code(b->task)) {
        if (narrow_code)
            kernel[DP_KERNEL_WIDEN_CODE](b, from, codes, count);
        kernel[dp_batch_read(b)->kernel](b, narrow_code ? codes : from, narrow_real ? wide : to, count);
        if (narrow_real)
            kernel[b->task == DP_TASK_LO   ? DP_KERNEL_NARROW_DOWN
                   : b->task == DP_TASK_HI ? DP_KERNEL_NARROW_UP
                                           : DP_KERNEL_NARROW_REAL](b, wide, to, count);
        return INT32_MAX;
    }
    if (narrow_real)
        kernel[DP_KERNEL_WIDEN_REAL](b, from, wide, count);
    const int32_t least =
        kernel[dp_batch_read(b)->kernel](b, narrow_real ? wide : from, narrow_code ? codes : to, count);
    if (narrow_code)
        kernel[DP_KERNEL_NARROW_CODE](b, codes, to, count);
    return least;
}

/* A block in doubt: again in small pieces, so that few elements are done one by one. */
static void run_patches(const dp_batch *b, const unsigned char *from, unsigned char *to, size_t count) {
    for (size_t i = 0; i < count; i += PATCH) {
        const size_t some = count - i < PATCH ? count - i : PATCH;
        if (run_kernel(b, from + i * b->in_size, to + i * b->out_size, some) < dp_batch_read(b)->doubt)
            run_plain(b, from + i * b->in_size, to + i * b->out_size, some);
    }
}

/* The first elements, up to where what is written starts a cache line: then no store of a vector straddles two. */
static size_t lead(const dp_batch *b, const void *out, size_t count) {
    const size_t bytes = (LINE - (uintptr_t)out % LINE) % LINE;
    const size_t some = bytes % b->out_size == 0 ? bytes / b->out_size : 0;
    return some < count ? some : 0;
}

_Static_assert(sizeof(dp_stretches) <= DP_BATCH_KEEP, "DP_BATCH_KEEP is too small");

void dp_batch_keep(dp_batch *batch, void *memory) {
    const dp_guarantee guarantee = dp_guarantee_make(&batch->setup);
    if (batch->task != DP_TASK_SEPARATION)
        return;
    dp_stretches_find(memory, &guarantee);
    dp_batch_write(batch)->kept = memory;
}

void dp_batch_run(const dp_batch *batch, const void *in, void *out, size_t count) {
    const unsigned char *from = in;
    unsigned char *to = out;
    if (batch->task == DP_TASK_SEPARATION) {
        run_separations(batch, from, to, count);
        return;
    }
    double saved[BLOCK]; /* in place, what is read must outlive what is written */
    size_t some = lead(batch, out, count);
    if (some == 0)
        some = BLOCK;
    for (size_t left = count; left > 0; some = BLOCK) {
        if (some > left)
            some = left;
        const unsigned char *source = from;
        if (in == out) {
            memcpy(saved, from, some * batch->in_size);
            source = (const unsigned char *)saved;
        }
        if (dp_batch_read(batch)->kernel == DP_KERNEL_NONE)
            run_plain(batch, source, to, some);
        else if (run_kernel(batch, source, to, some) < dp_batch_read(batch)->doubt)
            run_patches(batch, source, to, some);
        left -= some;
        from += some * batch->in_size;
        to += some * batch->out_size;
    }
}
