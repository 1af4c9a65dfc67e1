/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The command in a module has all files of the program but a few; here is what stands in for those, and for the
 * libraries that are not there: jansson, GSL, libpng, zlib, and a system's threads, processes and devices. What cannot
 * be done is named, and ends the command. Files are the host's, files.js: one that is written is there when the
 * command has ended well.
 */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <gsl/gsl_chebyshev.h>
#include <gsl/gsl_sort.h>
#include <gsl/gsl_sort_float.h>
#include <gsl/gsl_spline.h>
#include <gsl/gsl_statistics_double.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/commands.h"
#include "draw/pixels.h"
#include "image/kind.h"
#include "npm/standin.h"
#include "probe/compute.h"
#include "report/message.h"
#include "report/output.h"
#include "system/dynload.h"
#include "system/input.h"
#include "system/sandbox.h"

#define WAY_OUT "the native program has it"

_Noreturn static void missing(const char *what) {
    message("depthprec: %s not in the npm package: " WAY_OUT, what);
    exit(EXIT_USAGE);
}

int cmd_methods(void *request) {
    (void)request;
    missing("methods, which times this processor, is");
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

/* Relative names are the host's, whose folder it says. */
__attribute__((constructor)) static void go_home(void) {
    const char *folder = getenv("PWD");
    if (folder != NULL)
        (void)!chdir(folder);
}

static int cannot_write(const output *out, int error) {
    message("depthprec: cannot write %s%s%s: %s", out->path != NULL ? "'" : "",
            out->path != NULL ? out->path : "to stdout", out->path != NULL ? "'" : "", strerror(error));
    return EXIT_IO;
}

int output_open(output *out, const char *path) {
    *out = (output){.fd = STDOUT_FILENO};
    if (path == NULL || strcmp(path, "-") == 0)
        return EXIT_FINE;
    out->path = path;
    if (input_is_read(path)) {
        message("depthprec: '%s' is a file that is read, and is not overwritten", path);
        return EXIT_USAGE;
    }
    out->fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    return out->fd >= 0 ? EXIT_FINE : cannot_write(out, errno);
}

/* Nobody turns pages here. */
void output_page(output *out) {
    (void)out;
}

int output_check(const char *path) {
    output out;
    const int status = output_open(&out, path);
    if (status == EXIT_FINE)
        output_abandon(&out);
    return status;
}

/* The host forgets a file that is written and then removed. */
void output_abandon(output *out) {
    if (out->fd != STDOUT_FILENO) {
        unlink(out->path);
        close(out->fd);
    }
}

int output_close(output *out) {
    output_flush(out);
    if (out->fd != STDOUT_FILENO && close(out->fd) != 0 && out->error == 0)
        out->error = errno;
    return out->error == 0 ? EXIT_FINE : cannot_write(out, out->error);
}

bool output_same_file(const char *a, const char *b) {
    struct stat x, y;
    if (stat(a, &x) == 0 && stat(b, &y) == 0)
        return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
    return strcmp(a, b) == 0;
}

static bool no_png(image_source *source, image *out) {
    (void)out;
    return source_fail(source, "PNG is not read in the npm package: save .npy or PFM, or take the native program");
}

static bool no_png_written(image_writer *writer) {
    (void)writer;
    missing("writing PNG is");
}

const image_kind image_kind_png = {.name = "PNG",
                                   .ending = ".png",
                                   .magic = {"\x89PNG\r\n\x1a\n"},
                                   .magic_size = 8,
                                   .types = 1U << IMAGE_U8 | 1U << IMAGE_U16,
                                   .channels = 1U << 1 | 1U << 2 | 1U << 3 | 1U << 4,
                                   .read = no_png,
                                   .begin = no_png_written};

bool pixels_write_png(FILE *out, const pixels *p, const notes *words) {
    (void)out;
    (void)p;
    (void)words;
    missing("writing PNG is");
}

/* ---- Processes, devices --------------------------------------------------------------------------------- */

bool dynload_open(const library *l, dynload_function *functions[], char error[DYNLOAD_ERROR_SIZE]) {
    (void)functions;
    snprintf(error, DYNLOAD_ERROR_SIZE, "%s is not read in the npm package: " WAY_OUT, l->kind);
    return false;
}

sandbox_end sandbox_run(bool (*work)(void *of, FILE *out), void *of, sandbox_limits limits, FILE **made) {
    (void)work;
    (void)of;
    (void)limits;
    (void)made;
    missing("what a GPU or libassimp does is");
}

void sandbox_close(FILE *made) {
    (void)made;
}

/* ---- Libraries --------------------------------------------------------------------------------------------------- */

static int (*order)(const void *a, const void *b, void *context);
static void *order_context;

static int by_order(const void *a, const void *b) {
    return order(a, b, order_context);
}

void qsort_r(void *base, size_t count, size_t size, int (*compare)(const void *, const void *, void *), void *context) {
    order = compare;
    order_context = context;
    qsort(base, count, size, by_order);
}

static int by_size(const void *a, const void *b) {
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

void gsl_sort_float(float *data, size_t stride, size_t n) {
    (void)stride; /* 1 */
    qsort(data, n, sizeof *data, by_size);
}

gsl_error_handler_t *gsl_set_error_handler_off(void) {
    return NULL;
}

/* Functions that refuse in place of a library's. */
#define MISSING(what, result, name, ...)                                                                               \
    result name(__VA_ARGS__) {                                                                                         \
        missing(what);                                                                                                 \
    }
#pragma clang diagnostic ignored "-Wunused-parameter"

#define GPU "a GPU is"
MISSING(GPU, bool, shot_vulkan, const char *wanted, shot_plan *plan, shot_machine *machine)
MISSING(GPU, bool, shot_opengl, shot_plan *plan, shot_machine *machine)
MISSING(GPU, bool, shot_compute, const char *wanted, const compute_run *run, size_t runs, shot_machine *machine,
        FILE *out)
MISSING(GPU, bool, compute_look, compute_run *run, char error[COMPUTE_ERROR_SIZE])
MISSING(GPU, bool, compute_compile, const char *text, bool hlsl, compute_run *run, unsigned *line,
        char error[COMPUTE_ERROR_SIZE])

#define TIMED "a way that is timed is"
MISSING(TIMED, void, gsl_sort, double *data, size_t stride, size_t n)
MISSING(TIMED, double, gsl_stats_median_from_sorted_data, const double data[], size_t stride, size_t n)
MISSING(TIMED, double, gsl_stats_quantile_from_sorted_data, const double data[], size_t stride, size_t n, double f)
MISSING(TIMED, double, gsl_spline_eval, const gsl_spline *s, double x, gsl_interp_accel *a)
MISSING(TIMED, gsl_spline *, gsl_spline_alloc, const gsl_interp_type *type, size_t n)
MISSING(TIMED, int, gsl_spline_init, gsl_spline *s, const double x[], const double y[], size_t n)
MISSING(TIMED, void, gsl_spline_free, gsl_spline *s)
MISSING(TIMED, gsl_interp_accel *, gsl_interp_accel_alloc, void)
MISSING(TIMED, void, gsl_interp_accel_free, gsl_interp_accel *a)
MISSING(TIMED, double, gsl_cheb_eval, const gsl_cheb_series *s, double x)
MISSING(TIMED, gsl_cheb_series *, gsl_cheb_alloc, size_t n)
MISSING(TIMED, int, gsl_cheb_init, gsl_cheb_series *s, const gsl_function *f, double a, double b)
MISSING(TIMED, void, gsl_cheb_free, gsl_cheb_series *s)
const gsl_interp_type *gsl_interp_cspline;

#define JSON "JSON, as in glTF and in the profile of a GPU, is"
MISSING(JSON, json_t *, json_loadb, const char *bytes, size_t size, size_t flags, json_error_t *error)
MISSING(JSON, json_t *, json_loadf, FILE *in, size_t flags, json_error_t *error)
MISSING(JSON, json_t *, json_object_get, const json_t *of, const char *key)
MISSING(JSON, json_t *, json_array_get, const json_t *of, size_t index)
MISSING(JSON, size_t, json_array_size, const json_t *of)
MISSING(JSON, const char *, json_string_value, const json_t *of)
MISSING(JSON, json_int_t, json_integer_value, const json_t *of)
MISSING(JSON, double, json_number_value, const json_t *of)
void json_delete(json_t *of) {}
