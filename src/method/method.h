/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file method.h  Ways to get one quantity, a row each: what a way costs, what it promises, and where.
 *
 * A family is a quantity and its exact reference; a method is one way to that quantity. A method's claim is a worst
 * error for each of the family's cases (a format and a mapping) and the span of far/near in which it holds. Claims are
 * data: choose.h, the commands and the tests read the same cell, and a test fails when the measured error exceeds the
 * claim, when it stays far below it, and when the claim does not break beyond the span.
 */
#ifndef METHOD_METHOD_H
#define METHOD_METHOD_H

#include "core/bits.h"
#include "depthprec/depthprec.h"
#include "shader/decode.h"
#include "shader/normal.h"
#include "shader/position.h"

typedef enum method_family {
    METHOD_INTERVAL = 0, /**< eye depth -> z-fighting interval */
    METHOD_LINEARIZE,    /**< window depth -> eye depth */
    METHOD_ENCODE,       /**< window depth -> code */
    METHOD_WORST,        /**< range of depths -> worst interval */
    METHOD_POSITION,     /**< window depth of a pixel -> place */
    METHOD_NORMAL,       /**< eye depths around a pixel -> normal */
    METHOD_FAMILY_COUNT
} method_family;

enum {
    METHOD_CASES = 4,
    METHOD_STRIP = 64, /**< normal: pixels of a strip, and the eye depths of it with all that is looked at around it */
    METHOD_STRIP_LINE = METHOD_STRIP + 2 * NORMAL_REACH,
    METHOD_STRIP_EYES = METHOD_STRIP_LINE * (2 * NORMAL_REACH + 1)
};

/** The far/near that claims and walks speak of. */
#define METHOD_RATIO_LO 10.0
#define METHOD_RATIO_HI 1e12

/** A measured worst error below this share of its claim makes the claim too modest, unless the claim is already no more
 *  than the 20 roundings of double counted for a width. */
#define METHOD_MODEST   0.25
#define METHOD_ROUNDING (20 * 0x1p-53)

/** The worst error for far/near in [ratio_lo, ratio_hi]. No span, ratio_hi 0: the method does not speak of the case;
 *  a worst of NaN: it does, and claims nothing. A claim up to METHOD_RATIO_HI covers an infinite far plane where
 *  METHOD_INFINITE is set. Each is derived in depthprec(7), "Methods". A formula falls, or rises, or falls and then
 *  rises, so that its worst over a span is at an end of the span; it may be INFINITY.
 */
typedef struct method_claim {
    double worst; /**< in the family's measure; times formula(far/near, a, b) where there is one */
    double ratio_lo, ratio_hi;
    double (*formula)(double ratio, double a, double b); /**< null: the same throughout */
    double a, b;                                         /**< what the formula says they are */
} method_claim;

/* clang-format off */
#define FULL(worst)          {(worst), METHOD_RATIO_LO, METHOD_RATIO_HI, NULL, 0, 0}
#define UP_TO(worst, ratio)  {(worst), METHOD_RATIO_LO, (ratio), NULL, 0, 0}
#define FORMULA(f, a, b)     {1, METHOD_RATIO_LO, METHOD_RATIO_HI, (f), (a), (b)}
#define FORMULA_TO(ratio, f, a, b) {1, METHOD_RATIO_LO, (ratio), (f), (a), (b)}
#define NOWHERE              {0, 0, 0, NULL, 0, 0}
#define UNCLAIMED            {(double)__builtin_nanf(""), METHOD_RATIO_LO, METHOD_RATIO_HI, NULL, 0, 0}
/* clang-format on */

/** Where else a claim holds, or does not. */
enum {
    METHOD_INFINITE = 1 << 0, /**< an infinite far plane too */
    METHOD_ORTHO = 1 << 1,    /**< an orthographic projection too */
    METHOD_WHOLE = 1 << 2,    /**< only for cells that no plane cuts */
    METHOD_PIPELINE = 1 << 3, /**< judged by the binary32 pipeline, not by the lattice */
    METHOD_ABOVE = 1 << 4,    /**< one-sided: never below the reference, or the error is INFINITY */
    METHOD_BELOW = 1 << 5,    /**< one-sided: never above it */
    METHOD_HALF = 1 << 6,     /**< only for what binary16 can hold: distances from 2^-13 to 32752 */
    METHOD_FLAT = 1 << 7,     /**< an orthographic projection alone; METHOD_ORTHO is set, too */
};

/** Cameras besides those of the walk over far/near that stability takes to a family. */
enum {
    METHOD_BESIDE_ORTHO = 1 << 0,   /**< an orthographic one; of linearize, for what was written for perspective */
    METHOD_BESIDE_OBLIQUE = 1 << 1, /**< one with an oblique near plane, whose window depths are taken for another's */
    METHOD_BESIDE_LOG = 1 << 2,     /**< one with logarithmic depth, likewise */
};

/** The inputs of a family's methods: the arrays that the family uses, `count` long. */
typedef struct method_inputs {
    size_t count;
    double *z;            /**< interval: eye depths; worst: the near ends of the ranges */
    double *hi;           /**< worst: the far ends */
    float *d;             /**< linearize, encode, position: window depths in [0, 1] */
    double *place;        /**< position: the exact places as seen from the camera, world axes, three numbers each */
    float *eye;           /**< normal: METHOD_STRIP_EYES for each strip, line by line */
    const dp_setup *seen; /**< linearize: whose window depths these are; null: those of the call's own set-up */
    double tilt; /**< linearize: of an oblique near plane, else 0: the middle of the picture has d = (1 - n/z)/(1 - n/f
                    + tilt), see trap_row perspective-of-oblique */
} method_inputs;

/** Their outputs. */
typedef struct method_outputs {
    double *value;   /**< interval, worst, and linearize of a row that has `own`: scene units */
    float *eye;      /**< linearize: scene units */
    uint32_t *code;  /**< encode */
    float *place[3]; /**< position: world coordinates; normal: unit vectors */
} method_outputs;

typedef struct method_row method_row;

/** A method at work on a set-up. */
typedef struct method_call {
    const method_row *row;
    const dp_setup *setup;
    const void *state; /**< what the row's open() gave */
    const method_inputs *in;
    const method_outputs *out;
} method_call;

typedef void method_run(const method_call *call);

struct method_row {
    method_family family;
    const char *name;
    const char *note;
    method_claim claims[METHOD_CASES];
    unsigned domain;        /**< METHOD_... bits */
    double cost;            /**< ns an element, about, on one core of 2023; what choose.h goes by */
    const char *cost_class; /**< what the cost grows with: "1", "depths", "codes" */
    size_t limit;           /**< most inputs that are worth the time; 0 for no limit */
    const char *source;
    method_run *run;
    /** Prepares a set-up; null when there is nothing to prepare. @return null when out of memory */
    void *(*open)(const dp_setup *setup);
    void (*close)(void *state);
    /**
     * The code timed in place of run: the processor's instruction where run is a model of it, because of an
     * instruction that promises an error, not bits, each maker has another. It keeps the row's claims. Null: run.
     */
    method_run *timed;
    bool (*available)(void);         /**< null: on every processor */
    const struct bound_steps *bound; /**< its operations: of linearize what is proven for the camera at hand comes from
                                      them; null: it has no text */
    /** The row of the room `shader` that is measured, if it is one. */
    const decode_row *decode;
    const position_row *position;
    const normal_row *normal;
    /** The state of a method that runs on a device, else null. It gives out->value, and out->eye is NaN where there is
     * nothing to measure; its time is `cost`, and what is proven of it `known`, NaN where they are not known. */
    void *own;
    double known;
    double spread; /**< of that time, as bench_times has it */
    double asked;  /**< of a function of somebody's: the error from which on it fails; else 0 */
    /** Null, or told which set-ups run is called for next, with so many inputs: many at once take less time. */
    void (*expect)(const method_row *row, const dp_setup *setups, size_t count, size_t inputs);
    bool behind; /**< others are faster and more exact for every far/near: text shows it only where all are asked for */
    /** Null, or in a word what its error is of where it is not of roundings: "table". See stability.h. */
    const char *coarse;
};

/** How far an answer is off. */
typedef struct method_error {
    double absolute; /**< scene units; window depth for encode */
    double relative; /**< of the reference */
    double ulp;      /**< units in the last place of the answer's type; steps of the format for encode */
} method_error;

typedef struct method_case {
    const char *name; /**< "unorm24 d3d" */
    const char *format;
    dp_mapping mapping;
    bool gl; /**< NDC of [-1, 1] is the same to it: what it is given is depth that has left it behind */
} method_case;

typedef struct method_family_row {
    const char *name;    /**< "linearize" */
    const char *summary; /**< what goes in and what comes out */
    const char *measure; /**< what claims count: "relative error", "steps of the format" */
    bool steps;          /**< that measure is the error's `ulp`, else its `relative` */
    bool windows;        /**< what is shown of an input is its window depth, else its eye depth */
    bool magnitudes;     /**< stability walks over window depths, not over far/near, which do not matter */
    unsigned besides;    /**< METHOD_BESIDE_... bits */
    method_case cases[METHOD_CASES];
    size_t case_count;
    size_t inputs;  /**< how many are timed */
    size_t walked;  /**< how many stability takes, for each set-up */
    int per_decade; /**< set-ups of stability in each decade of far/near */
    const size_t *method_count;
    const method_row *methods;
    /** Writes inputs: those of the stress list first, then seeded ones. */
    void (*fill)(const dp_setup *setup, method_inputs *in);
    /** The error of answer i of a call; false where the method's domain leaves that input out. */
    bool (*judge)(const method_call *call, size_t i, method_error *error);
    /** The limit of all methods: run() of one that does nothing but move the same bytes. */
    method_run *limit;
} method_family_row;

/** The families; null beyond the last. */
const method_family_row *method_family_get(size_t index);

/** All methods of all families in turn; null beyond the last. */
const method_row *method_get(size_t index);

/** Does the method speak of the family's case `which`? */
static inline bool method_speaks(const method_row *row, size_t which) {
    return row->claims[which].ratio_hi > 0;
}

/** A claim at one far/near; NaN where nothing is claimed. */
static inline double method_claim_at(const method_claim *claim, double ratio) {
    return claim->formula != NULL ? claim->worst * claim->formula(ratio, claim->a, claim->b) : claim->worst;
}

/** Its worst for far/near from lo to hi. */
static inline double method_claim_over(const method_claim *claim, double lo, double hi) {
    const double a = method_claim_at(claim, lo), b = method_claim_at(claim, hi);
    return a > b ? a : b;
}

/** Is it for the projection of a set-up? */
static inline bool method_suits(const method_row *row, const dp_setup *setup) {
    return setup->spec.ortho ? (row->domain & METHOD_ORTHO) != 0 : (row->domain & METHOD_FLAT) == 0;
}

/** Can this processor run it? */
static inline bool method_available(const method_row *row) {
    return row->available == NULL || row->available();
}

/** A set-up of a family's case. @return what dp_setup_init() says */
dp_status method_setup(const method_family_row *family, size_t which, double znear, double zfar, bool ortho,
                       dp_setup *out);

/** Why a method is not among those of case `which` at a set-up, "of other formats or mappings"; null: it is. */
const char *method_lacks(const method_row *row, size_t which, const dp_setup *setup);

/** Once, before any method runs: GSL must report errors and not end the program. */
void method_start(void);

/** Room for inputs and outputs of a family. @return false when out of memory; nothing is then held */
bool method_arrays(size_t count, method_inputs *in, method_outputs *out);
void method_arrays_free(method_inputs *in, method_outputs *out);

/** The stress inputs and then seeded ones: eye depths, and window depths. */
void method_depths(const dp_setup *setup, method_inputs *in);
void method_windows(const dp_setup *setup, method_inputs *in);

/** How far depths go in which an infinite far plane is left out: that many times near. */
#define METHOD_INFINITE_FAR 1e6

/** Number i of a seeded sequence, in [0, 1): the same everywhere and always. */
double method_unit(uint64_t seed, uint64_t i);

/** 1/x where x has the relative error (a far/near + b) DP_UNIT, and what products of roundings add to it: what is
 *  left where f cancels against d (f - n). INFINITY where nothing is left. */
double method_cancelled(double ratio, double a, double b);
/** Where half of the divisor may be error, and the claims on binary32 arithmetic have grown to 1. */
#define METHOD_CANCELLED       (0x1p24 / 6)
#define METHOD_CANCELLED_FUSED (0x1p24 / 4)

/** Loops that move the bytes of a family's inputs and outputs: z to value, z and hi to value, d to eye, d to code, d to
 *  places, eye to places. */
method_run limit_depths, limit_ranges, limit_windows, limit_codes, limit_places, limit_eyes;

extern const method_family_row interval_family, linearize_family, encode_family, worst_family, position_family,
    normal_family;

#endif
