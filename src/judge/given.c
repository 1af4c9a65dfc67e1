/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/given.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "depthprec/depth.h"
#include "shader/constants.h"

typedef double matrix[4][4]; /* by rows, for column vectors */

/* Near, far, its inverse, orthographic; what CesiumJS has of logarithms (UniformState.js); a half; a digit. */
static double number(const dp_setup *s, char what) {
    const double n = s->spec.znear, f = s->spec.zfar;
    switch (what) {
    case 'n':
        return n;
    case 'f':
        return f;
    case 'i':
        return 1 / f;
    case 'o':
        return s->spec.ortho;
    case 'p':
        return f - n + 1;
    case 'l':
        return dp_log2(f - n + 1);
    case 'r':
        return 1 / dp_log2(f - n + 1);
    case 'h':
        return 0.5;
    default:
        return what - '0';
    }
}

static void fill_zbuffer(const dp_setup *s, double out[GIVEN_FLOATS]) {
    const zbuffer_params p = shader_constants_of(s).zbuffer;
    const float all[4] = {p.x, p.y, p.z, p.w};
    for (int i = 0; i < 4; i++)
        out[i] = (double)all[i];
}

/* Unreal's: z = x d + y + 1/(z d - w). */
static void fill_device_z(const dp_setup *s, double out[GIVEN_FLOATS]) {
    const double z0 = dp_eye(s, 0, 1), z1 = dp_eye(s, 1, 0);
    const double ortho[4] = {z1 - z0, z0 + 1, 0, 1}, perspective[4] = {0, 0, 1 / z1 - 1 / z0, -1 / z0};
    memcpy(out, s->spec.ortho ? ortho : perspective, sizeof ortho);
}

/* NDC depth is c0 + c1/z, orthographic c0 + c1 z. `toward`: of view z, -1 where the camera looks along -z. */
static void projection(const dp_setup *s, double toward, bool inverse, double out[GIVEN_FLOATS]) {
    const double n = s->spec.znear, z = isinf(s->spec.zfar) ? 2 * n : s->spec.zfar;
    const double scale = dp_mapping_get(s->spec.mapping)->ndc_signed ? 2 : 1;
    const double near = scale * dp_window(s, n) - (scale - 1), other = scale * dp_window(s, z) - (scale - 1);
    const double c1 = (other - near) / (s->spec.ortho ? z - n : 1 / z - 1 / n);
    const double c0 = near - (s->spec.ortho ? c1 * n : c1 / n);
    matrix m = {{1}, {0, 1}};
    if (s->spec.ortho) {
        m[2][2] = inverse ? toward / c1 : toward * c1;
        m[2][3] = inverse ? -toward * c0 / c1 : c0;
        m[3][3] = 1;
    } else {
        m[2][2] = inverse ? 0 : toward * c0;
        m[2][3] = inverse ? toward : c1;
        m[3][2] = inverse ? 1 / c1 : toward;
        m[3][3] = inverse ? -c0 / c1 : 0;
    }
    memcpy(out, m, sizeof m);
}

static void fill_projection(const dp_setup *s, double out[GIVEN_FLOATS]) {
    projection(s, -1, false, out);
}

static void fill_projection_lh(const dp_setup *s, double out[GIVEN_FLOATS]) {
    projection(s, 1, false, out);
}

static void fill_inverse(const dp_setup *s, double out[GIVEN_FLOATS]) {
    projection(s, -1, true, out);
}

static void fill_inverse_lh(const dp_setup *s, double out[GIVEN_FLOATS]) {
    projection(s, 1, true, out);
}

static const given_row rows[] = {
    {"near", 1, "n", NULL,
     " near znear nearz cameranear unear nearplane nearclip nearclipplane ucameranear uznear unearplane nearplanez n "
     "zn camnear virtualcameranear cameranearclip "},
    {"far", 1, "f", NULL,
     " far zfar farz camerafar ufar farplane farclip farclipplane ucamerafar uzfar ufarplane farplanez f zf camfar "
     "virtualcamerafar camerafarclip "},
    {"near_far", 2, "nf", NULL,
     " nearfar znearfar cameranearfar unearfar unearfarplanes nearfarplanes cameraplanes clipplanes "
     "czmcurrentfrustum "},
    {"z_buffer_params", 4, NULL, fill_zbuffer, " zbufferparams zbufferparam "},
    {"projection_params", 4, "1nfi", NULL, " projectionparams "},
    {"camera_params", 4, "ifno", NULL, " cameraparams "},
    {"inv_device_z", 4, NULL, fill_device_z, " invdeviceztoworldztransform viewinvdeviceztoworldztransform "},
    {"projection", 16, NULL, fill_projection,
     " projection projectionmatrix uprojection uprojectionmatrix proj projmatrix projmat cameraprojection "
     "cameraprojectionmatrix matrixprojection unitymatrixp glstatematrixprojection czmprojection "},
    {"projection_lh", 16, NULL, fill_projection_lh, ""},
    {"inverse_projection", 16, NULL, fill_inverse,
     " inverseprojection inverseprojectionmatrix projectioninverse projectionmatrixinverse invprojection invproj "
     "invprojectionmatrix cameraprojectionmatrixinverse camerainverseprojectionmatrix unitycamerainvprojection "
     "czminverseprojection "},
    {"inverse_projection_lh", 16, NULL, fill_inverse_lh, ""},
    {"log2_far_from_near", 1, "l", NULL, " czmlog2fardepthfromnearplusone "},
    {"far_from_near", 1, "p", NULL, " czmfardepthfromnearplusone "},
    {"one_over_log2_far_from_near", 1, "r", NULL, " czmoneoverlog2fardepthfromnearplusone "},
    {"viewport", 4, "0011", NULL, " czmviewport "},
    {"viewport_matrix", 16, "h00h0h0h00hh0001", NULL, " czmviewporttransformation "},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

const given_row *given_find(const char *word) {
    for (size_t i = 0; i < ROWS; i++)
        if (strcmp(rows[i].word, word) == 0)
            return &rows[i];
    return NULL;
}

const given_row *given_guess(const char *name, bool hlsl) {
    const char *member = strrchr(name, '.');
    char key[GIVEN_NAME_SIZE + 2] = " ";
    size_t used = 1;
    for (const char *c = member != NULL ? member + 1 : name; *c != '\0' && used < GIVEN_NAME_SIZE; c++)
        if (*c != '_')
            key[used++] = (char)tolower((unsigned char)*c);
    key[used++] = ' ';
    key[used] = '\0';
    const bool unity = strncmp(key, " unity", 6) == 0 || strncmp(key, " gl", 3) == 0;
    for (size_t i = 0; i < ROWS; i++)
        if (strstr(rows[i].names, key) != NULL)
            return &rows[i + (i + 1 < ROWS && rows[i + 1].names[0] == '\0' && hlsl && !unity)];
    return NULL;
}

void given_fill(const given_row *row, const dp_setup *s, double out[GIVEN_FLOATS]) {
    if (row->fill != NULL)
        row->fill(s, out);
    for (unsigned i = 0; row->numbers != NULL && i < row->floats; i++)
        out[i] = number(s, row->numbers[i]);
}
