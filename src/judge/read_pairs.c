/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/pairs.h"

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "system/input.h"
#include "texture/image_depths.h"

enum { LINE_SIZE = 512, HAND_DIGITS = 4 };

/* The digits of a column: the most that are significant, and the most behind the point. */
typedef struct digits_seen {
    int significant, decimals;
} digits_seen;

typedef struct reader {
    judge_pairs *out;
    size_t room, line;
    digits_seen in, value;
    char *error;
} reader;

/* ---- Digits ------------------------------------------------------------------------------------------------------ */

static void see_digits(const char *text, const char *end, digits_seen *seen) {
    int significant = 0, decimals = 0;
    bool point = false;
    for (; text < end && *text != 'e' && *text != 'E'; text++) {
        point = point || *text == '.';
        if (*text < '0' || *text > '9')
            continue;
        significant += significant > 0 || *text != '0';
        decimals += point;
    }
    const int exponent = text < end ? (int)strtol(text + 1, NULL, 10) : 0;
    seen->significant = significant > seen->significant ? significant : seen->significant;
    seen->decimals = decimals - exponent > seen->decimals ? decimals - exponent : seen->decimals;
}

/* Half a unit of the last digit, printed by %g or by %f. Few digits were typed and are what was meant. */
static judge_digits rounded_by(const digits_seen *seen, bool typed) {
    if (typed && seen->significant <= HAND_DIGITS)
        return (judge_digits){0};
    return (judge_digits){0.5 * dp_pow(10, -seen->decimals), 5 * dp_pow(10, -seen->significant)};
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static bool add(reader *r, double in, double out) {
    judge_pairs *p = r->out;
    if (isnan(in) || isnan(out)) {
        if (p->nan_count++ == 0)
            p->nan_at = in;
        return true;
    }
    if (p->count == r->room) {
        r->room = r->room == 0 ? 1024 : 2 * r->room;
        judge_pair *more = r->room > PAIRS_MOST ? NULL : realloc(p->pairs, r->room * sizeof *more);
        if (more == NULL) {
            snprintf(r->error, PAIRS_ERROR_SIZE, "has more than %d pairs, or they do not fit into memory", PAIRS_MOST);
            return false;
        }
        p->pairs = more;
    }
    p->pairs[p->count++] = (judge_pair){in, out};
    return true;
}

static const char *number(const char *at, double *out, digits_seen *seen) {
    char *end;
    at += strspn(at, " \t\"");
    *out = strtod(at, &end);
    if (end == at)
        return NULL;
    if (isfinite(*out))
        see_digits(at, end, seen);
    return end + strspn(end, " \t\",;\r\n");
}

static bool take_line(reader *r, const char *text) {
    double in, out;
    r->line++;
    text += r->line == 1 && strncmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    if (text[strspn(text, " \t\r\n")] == '\0' || text[strspn(text, " \t")] == '#')
        return true;
    digits_seen in_seen = r->in, out_seen = r->value;
    const char *rest = number(text, &in, &in_seen);
    rest = rest != NULL ? number(rest, &out, &out_seen) : NULL;
    if (rest == NULL && r->out->count == 0 && r->out->nan_count == 0)
        return true; /* a title */
    if (rest == NULL || *rest != '\0') {
        snprintf(r->error, PAIRS_ERROR_SIZE, "line %zu must be two numbers, what went in and what came out", r->line);
        return false;
    }
    r->in = in_seen;
    r->value = out_seen;
    return add(r, in, out);
}

static int read_text(const char *path, reader *r) {
    char line[LINE_SIZE];
    errno = 0;
    FILE *in = input_open(path);
    if (in == NULL)
        return errno;
    bool fine = true;
    while (fine && fgets(line, sizeof line, in) != NULL)
        fine = take_line(r, line);
    const int status = !fine ? -1 : ferror(in) ? errno : 0;
    input_close(in);
    return status;
}

static int read_npy(const char *path, reader *r) {
    image img;
    image_error error;
    if (!image_read(path, &img, &error)) {
        snprintf(r->error, PAIRS_ERROR_SIZE, "%s", error.text);
        return error.unreadable != 0 ? error.unreadable : -1;
    }
    const bool columns = img.width == 2, rows = img.height == 2;
    const size_t count = columns ? img.height : img.width;
    bool fine = img.channels == 1 && (columns || rows);
    if (!fine)
        snprintf(r->error, PAIRS_ERROR_SIZE, "must have two columns, or two rows, got %u x %u", img.height, img.width);
    for (size_t i = 0; i < count && fine; i++)
        fine = add(r, image_sample(&img, columns ? 2 * i : i), image_sample(&img, columns ? 2 * i + 1 : count + i));
    image_free(&img);
    return fine ? 0 : -1;
}

int judge_pairs_read(const char *path, judge_pairs *out, char error[PAIRS_ERROR_SIZE]) {
    const size_t length = strlen(path);
    *out = (judge_pairs){.nan_at = (double)NAN};
    reader r = {.out = out, .error = error};
    const bool npy = length > 4 && strcmp(path + length - 4, ".npy") == 0;
    const int status = npy ? read_npy(path, &r) : read_text(path, &r);
    if (status != 0) {
        judge_pairs_free(out);
        return status;
    }
    if (!npy) {
        out->in_digits = rounded_by(&r.in, true);
        out->out_digits = rounded_by(&r.value, false);
    }
    judge_pairs_look(out);
    return 0;
}
