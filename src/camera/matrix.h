/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file matrix.h  A projection matrix as people have it: from a file or as they typed it, by rows or by columns,
 * looking along z or -z, for [0, 1] or [-1, 1], with the digits that its entries carry. Or the tangents of a view's
 * four edges, as OpenXR and OpenVR give them, which say the view alone.
 */
#ifndef CAMERA_MATRIX_H
#define CAMERA_MATRIX_H

#include "camera/rules.h"

enum { MATRIX_ENTRIES = 16, MATRIX_TANGENTS = 4, MATRIX_ERROR_SIZE = 256 };

typedef struct camera_matrix {
    size_t count; /**< 16, or 4 of tangents; 0: none was said */
    double m[MATRIX_ENTRIES], least[MATRIX_ENTRIES], most[MATRIX_ENTRIES]; /**< each, and its ends before rounding */
    dp_projection taken;                                                   /**< of tangents the frustum alone */
    dp_planes planes; /**< what near and far may be; equal ends where the entries are exact */
    bool assumed;     /**< another NDC range fits as well */
    bool covered;     /**< camera_matrix_cover() made another view of the one that was said */
} camera_matrix;

/**
 * Reads a file, or the numbers themselves: 16, or four tangents, between white space, commas, semicolons and brackets.
 * "mat4(" before them and an f behind each are left out, # begins a comment.
 * Tangents are those of the left, the right, the upper and the lower edge, of these two the greater is the upper.
 * @return 0; a number of errno where the file cannot be read; or -1 and what is wrong, in ASCII
 */
int camera_matrix_read(camera_matrix *out, const char *said, char error[MATRIX_ERROR_SIZE]);

/** Whether these are numbers, rather than the name of a file. */
bool camera_matrix_is_typed(const char *said);

/**
 * Takes it apart; the fault's key is "matrix" or "mapping".
 * @param asked  the mapping; DP_MAPPING_COUNT: as the matrix shows it
 * @param like   where it shows two: the one with the NDC range of this one; DP_MAPPING_COUNT: then it has to be asked
 * @param oblique  planes that differ from pixel to pixel are taken, too
 */
bool camera_matrix_take(camera_matrix *m, dp_mapping asked, dp_mapping like, bool oblique, camera_fault *fault);

/** The ranges of near and far: its `planes`, or null where its entries are exact, or there are none. */
const dp_planes *camera_matrix_left_open(const camera_matrix *m);

/** The vertical angle, degrees, of a centred view of so many square pixels. */
bool camera_matrix_angle(const camera_matrix *m, int width, int height, double *fov_y, camera_fault *fault);

/** Makes of a view of t->width x t->height pixels the centred one of square pixels that holds it: more pixels, none of
 * them smaller, and the class of triangles that are as slim there. */
bool camera_matrix_cover(camera_matrix *m, dp_triangles *t, camera_fault *fault);

#endif
