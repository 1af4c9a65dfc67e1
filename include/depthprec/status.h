/* SPDX-License-Identifier: MIT */
/** @file status.h  What can go wrong at the door of the library, and how functions are exported. */
#ifndef DEPTHPREC_STATUS_H
#define DEPTHPREC_STATUS_H

#if defined(__GNUC__)
#define DP_API __attribute__((visibility("default")))
#else
#define DP_API
#endif

#ifdef __cplusplus
#define DP_BEGIN extern "C" {
#define DP_END   }
#else
#define DP_BEGIN
#define DP_END
#endif

DP_BEGIN

/** Everything is checked when a set-up is made and when a range or depth enters; after that nothing can fail. */
typedef enum dp_status {
    DP_OK = 0,
    DP_ERROR_NULL,       /**< a pointer that must not be null is null */
    DP_ERROR_NEAR,       /**< near is not in [1e-12, 1e12] */
    DP_ERROR_FAR,        /**< far is neither in (near, 1e18] nor what setup.h allows, nor infinite */
    DP_ERROR_PLANES,     /**< far is not beyond near by at least 1e-6 of near */
    DP_ERROR_INFINITE,   /**< an infinite far with a mapping or projection that needs a finite one */
    DP_ERROR_ORTHO,      /**< an orthographic projection with a mapping that has none */
    DP_ERROR_LOG_C,      /**< the constant of the logarithmic mapping is not in [1e-12, 1e12] */
    DP_ERROR_FORMAT,     /**< not a depth format: unknown name, bits out of range, or rg where it has no place */
    DP_ERROR_MAPPING,    /**< not a mapping */
    DP_ERROR_ROUNDING,   /**< not a rounding mode */
    DP_ERROR_MODEL,      /**< not a model, or one that this set-up does not have */
    DP_ERROR_ARITH,      /**< not an arithmetic */
    DP_ERROR_DEPTH,      /**< an eye depth outside [near, far], or not a number */
    DP_ERROR_RANGE,      /**< a range that is empty, reversed, or leaves [near, far] */
    DP_ERROR_BINARY32,   /**< an eye depth that binary32 rounds to infinity, in the model float */
    DP_ERROR_BATCH,      /**< not a task, element type or path, or a path that is not available */
    DP_ERROR_ORTHO_NEAR, /**< near of an orthographic projection is neither 0 nor from 1e-12 to 1e12 in magnitude */
    DP_ERROR_ORTHO_FAR,  /**< its far is not greater than near, or neither 0 nor from 1e-12 to 1e18 in magnitude */
    DP_ERROR_TRIANGLES,  /**< triangles out of range, or under an orthographic projection */
    DP_ERROR_MATRIX,     /**< not a projection matrix, or not one of the mapping asked for */
    DP_ERROR_CONVENTION, /**< a matrix that more than one convention fits: the mapping or the layout has to be said */
    DP_ERROR_WINDOW,     /**< a depth range that is none, or where a shader writes depth */
    DP_STATUS_COUNT
} dp_status;

/**
 * One sentence without a full stop that says what is allowed, for example
 * "near must be from 1e-12 to 1e12". The string is static. Any value is accepted.
 */
DP_API const char *dp_status_text(dp_status status);

DP_END
#endif
