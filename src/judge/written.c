/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/written.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "depthprec/depth.h"
#include "shader/constants.h"

enum { NAME_SIZE = 64, VALUE_SIZE = 512, FLOATS_MOST = 16, BODY_SIZE = 2048 };

/* ---- What a shader may be given ---------------------------------------------------------------------------------- */

typedef double matrix[4][4]; /* by rows, for column vectors */

static void fill_near(const dp_setup *s, double out[FLOATS_MOST]) {
    out[0] = s->spec.znear;
}

static void fill_far(const dp_setup *s, double out[FLOATS_MOST]) {
    out[0] = s->spec.zfar;
}

static void fill_near_far(const dp_setup *s, double out[FLOATS_MOST]) {
    out[0] = s->spec.znear;
    out[1] = s->spec.zfar;
}

static void fill_zbuffer(const dp_setup *s, double out[FLOATS_MOST]) {
    const zbuffer_params p = shader_constants_of(s).zbuffer;
    const float all[4] = {p.x, p.y, p.z, p.w};
    for (int i = 0; i < 4; i++)
        out[i] = (double)all[i];
}

static void fill_projection_params(const dp_setup *s, double out[FLOATS_MOST]) {
    const double all[4] = {1, s->spec.znear, s->spec.zfar, 1 / s->spec.zfar};
    memcpy(out, all, sizeof all);
}

/* Unreal's: z = x d + y + 1/(z d - w). */
static void fill_device_z(const dp_setup *s, double out[FLOATS_MOST]) {
    const double z0 = dp_eye(s, 0, 1), z1 = dp_eye(s, 1, 0);
    const double ortho[4] = {z1 - z0, z0 + 1, 0, 1}, perspective[4] = {0, 0, 1 / z1 - 1 / z0, -1 / z0};
    memcpy(out, s->spec.ortho ? ortho : perspective, sizeof ortho);
}

/* NDC depth is c0 + c1/z, orthographic c0 + c1 z. `toward`: of view z, -1 where the camera looks along -z. */
static void projection(const dp_setup *s, double toward, bool inverse, double out[FLOATS_MOST]) {
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

static void fill_projection(const dp_setup *s, double out[FLOATS_MOST]) {
    projection(s, -1, false, out);
}

static void fill_projection_lh(const dp_setup *s, double out[FLOATS_MOST]) {
    projection(s, 1, false, out);
}

static void fill_inverse(const dp_setup *s, double out[FLOATS_MOST]) {
    projection(s, -1, true, out);
}

static void fill_inverse_lh(const dp_setup *s, double out[FLOATS_MOST]) {
    projection(s, 1, true, out);
}

/* By a word; and the names by which it is guessed, without underscores and in small letters. Of matrices the row below
 * is for HLSL, where cameras look along +z. */
typedef struct value_row {
    const char *word;
    unsigned floats;
    void (*fill)(const dp_setup *s, double out[FLOATS_MOST]);
    const char *names;
} value_row;

static const value_row rows[] = {
    {"near", 1, fill_near,
     " near znear nearz cameranear unear nearplane nearclip nearclipplane ucameranear uznear unearplane nearplanez n "
     "zn "},
    {"far", 1, fill_far,
     " far zfar farz camerafar ufar farplane farclip farclipplane ucamerafar uzfar ufarplane farplanez f zf "},
    {"near_far", 2, fill_near_far, " nearfar znearfar cameranearfar unearfar cameraplanes clipplanes "},
    {"z_buffer_params", 4, fill_zbuffer, " zbufferparams zbufferparam "},
    {"projection_params", 4, fill_projection_params, " projectionparams "},
    {"inv_device_z", 4, fill_device_z, " invdeviceztoworldztransform viewinvdeviceztoworldztransform "},
    {"projection", 16, fill_projection,
     " projection projectionmatrix uprojection uprojectionmatrix proj projmatrix projmat cameraprojection "
     "unitymatrixp glstatematrixprojection "},
    {"projection_lh", 16, fill_projection_lh, ""},
    {"inverse_projection", 16, fill_inverse,
     " inverseprojection inverseprojectionmatrix projectioninverse projectionmatrixinverse invprojection invproj "
     "invprojectionmatrix cameraprojectionmatrixinverse unitycamerainvprojection "},
    {"inverse_projection_lh", 16, fill_inverse_lh, ""},
};
enum { ROWS = sizeof rows / sizeof rows[0] };

static const value_row *row_of(const char *word) {
    for (size_t i = 0; i < ROWS; i++)
        if (strcmp(rows[i].word, word) == 0)
            return &rows[i];
    return NULL;
}

static bool number_of_text(const char *text, double *out) {
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*out);
}

bool written_define_known(const char *define) {
    const char *value = strchr(define, '=');
    double unused;
    return value != NULL && value != define && value - define < NAME_SIZE &&
           (row_of(value + 1) != NULL || number_of_text(value + 1, &unused));
}

static const value_row *guess(const char *name, bool hlsl) {
    char key[NAME_SIZE + 2] = " ";
    size_t used = 1;
    for (const char *c = name; *c != '\0' && used < NAME_SIZE; c++)
        if (*c != '_')
            key[used++] = (char)tolower((unsigned char)*c);
    key[used++] = ' ';
    key[used] = '\0';
    const bool unity = strncmp(key, " unity", 6) == 0 || strncmp(key, " gl", 3) == 0;
    for (size_t i = 0; i < ROWS; i++)
        if (strstr(rows[i].names, key) != NULL)
            return &rows[i + (rows[i].floats == 16 && hlsl && !unity)];
    return NULL;
}

/* ---- Words of a text --------------------------------------------------------------------------------------------- */

typedef struct piece {
    const char *at;
    size_t length;
} piece;

static bool in_word(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

static bool is(piece p, const char *text) {
    return p.length == strlen(text) && memcmp(p.at, text, p.length) == 0;
}

static bool is_any(piece p, const char *const list[]) {
    for (; *list != NULL; list++)
        if (is(p, *list))
            return true;
    return false;
}

/* The next word from *at on, and how many brackets more are open there; numbers are none. */
static bool next_word(const char **at, const char *end, piece *out, int *open) {
    const char *c = *at;
    for (; c < end; c++) {
        *open += (*c == '(' || *c == '{' || *c == '[') - (*c == ')' || *c == '}' || *c == ']');
        if (!in_word(*c))
            continue;
        const char *from = c;
        while (c < end && (in_word(*c) || (isdigit((unsigned char)*from) && *c == '.')))
            c++;
        if (isdigit((unsigned char)*from)) {
            c--;
            continue;
        }
        *out = (piece){from, (size_t)(c - from)};
        *at = c;
        return true;
    }
    *at = end;
    return false;
}

/* What stands before, blanks apart: its last character. */
static const char *before(const char *from, const char *at) {
    static const char nothing[] = "";
    do
        at--;
    while (at >= from && isspace((unsigned char)*at));
    return at >= from ? at : nothing;
}

static char after(const char *at, const char *end) {
    while (at < end && isspace((unsigned char)*at))
        at++;
    return at < end ? *at : '\0';
}

static piece word_before(const char *from, const char *at) {
    const char *last = before(from, at), *first = last;
    if (!in_word(*last))
        return (piece){"", 0};
    while (first > from && in_word(first[-1]))
        first--;
    return (piece){first, (size_t)(last + 1 - first)};
}

/* ---- What stands in a file --------------------------------------------------------------------------------------- */

typedef enum item_kind {
    ITEM_CODE,
    ITEM_FUNCTION,
    ITEM_DIRECTIVE,
    ITEM_NONE /* uniforms, and what goes in and out */
} item_kind;

typedef struct item {
    const char *from, *to;
    item_kind kind;
    piece name; /* of a function */
    bool kept;
} item;

typedef struct source {
    char *text; /* the file without remarks */
    bool hlsl;
    item *items;
    size_t count;
} source;

static void blank(char *from, const char *to) {
    for (; from < to; from++)
        if (*from != '\n' && *from != '\r')
            *from = ' ';
}

static void blank_remarks(char *text) {
    for (char *c = text; *c != '\0'; c++) {
        const bool line = c[0] == '/' && c[1] == '/', block = c[0] == '/' && c[1] == '*';
        const char *end = line ? strchr(c, '\n') : block ? strstr(c + 2, "*/") : NULL;
        if (!line && !block)
            continue;
        end = end == NULL ? c + strlen(c) : end + (block ? 2 : 0);
        blank(c, end);
    }
}

static const char *directive_end(const char *c) {
    while (*c != '\0' && *c != '\n') {
        const bool goes_on = c[0] == '\\' && (c[1] == '\n' || (c[1] == '\r' && c[2] == '\n'));
        c += goes_on ? (c[1] == '\r' ? 3 : 2) : 1;
    }
    return c;
}

/* Where a declaration or function ends that begins at c. */
static const char *item_end(const char *c, item *out) {
    static const char *const with_end[] = {"struct", "uniform", "layout", "buffer", NULL};
    int open = 0;
    bool value = false;
    piece first = {c, 0};
    while (in_word(c[first.length]))
        first.length++;
    const bool ends = is_any(first, with_end);
    for (; *c != '\0'; c++) {
        open += (*c == '(' || *c == '{' || *c == '[') - (*c == ')' || *c == '}' || *c == ']');
        value = value || (open == 0 && *c == '=');
        if (open == 1 && *c == '(' && out->name.length == 0 && !value && !ends)
            out->name = word_before(out->from, c);
        if (open == 1 && *c == '{' && out->name.length > 0 && !value)
            out->kind = ITEM_FUNCTION;
        if (open == 0 && (*c == ';' || (*c == '}' && !ends && !value)))
            return c + 1;
    }
    return c;
}

/* HLSL's variables without a value are uniforms, too. */
static item_kind kind_of(const source *s, const item *i) {
    static const char *const apart[] = {"uniform", "cbuffer", "tbuffer", "ConstantBuffer", "varying",   "attribute",
                                        "in",      "out",     "buffer",  "layout",         "precision", NULL};
    static const char *const left[] = {"version", "include", "pragma", NULL};
    const char *at = i->from;
    int open = 0;
    piece word;
    if (i->kind == ITEM_FUNCTION)
        return ITEM_FUNCTION;
    for (int k = 0; next_word(&at, i->to, &word, &open) && (open == 0 || k == 0); k++)
        if (is_any(word, i->kind == ITEM_DIRECTIVE ? left : apart))
            return ITEM_NONE;
    const bool plain = memchr(i->from, '=', (size_t)(i->to - i->from)) == NULL &&
                       memchr(i->from, '{', (size_t)(i->to - i->from)) == NULL && i->name.length == 0;
    return i->kind == ITEM_CODE && s->hlsl && plain ? ITEM_NONE : i->kind;
}

static bool take_apart(source *s) {
    size_t room = 0;
    for (const char *c = s->text; *c != '\0';) {
        if (isspace((unsigned char)*c)) {
            c++;
            continue;
        }
        if (s->count == room) {
            room = 2 * room + 64;
            item *more = realloc(s->items, room * sizeof *more);
            if (more == NULL)
                return false;
            s->items = more;
        }
        item *i = &s->items[s->count++];
        *i = (item){.from = c, .kind = *c == '#' ? ITEM_DIRECTIVE : ITEM_CODE};
        i->to = *c == '#' ? directive_end(c) : item_end(c, i);
        i->kind = kind_of(s, i);
        i->kept = i->kind == ITEM_DIRECTIVE;
        c = i->to;
    }
    return true;
}

/* Is it declared there, to be known to others? Inside: to be known there alone, as a parameter is. */
static bool declares(const item *i, piece name, bool inside) {
    static const char *const none[] = {"return", "else", "do", "case", NULL};
    const char *at = i->from;
    int open = 0;
    if (i->kind == ITEM_FUNCTION && !inside)
        return i->name.length == name.length && memcmp(i->name.at, name.at, name.length) == 0;
    for (piece word; next_word(&at, i->to, &word, &open);) {
        if (word.length != name.length || memcmp(word.at, name.at, name.length) != 0)
            continue;
        const piece prior = word_before(i->from, word.at);
        const char last = *before(i->from, word.at);
        if (i->kind == ITEM_DIRECTIVE   ? is(prior, "define")
            : in_word(after(at, i->to)) ? false
            : inside                    ? prior.length > 0 && !is_any(prior, none)
                                        : open == 0 && (prior.length > 0 || last == ',' || last == ']' || last == '}'))
            return true;
    }
    return false;
}

/* With whatever it needs, and what that needs. */
static void keep(source *s, item *i) {
    const char *at = i->from;
    int open = 0;
    i->kept = true;
    for (piece word; next_word(&at, i->to, &word, &open);)
        for (size_t k = 0; k < s->count; k++)
            if (!s->items[k].kept && s->items[k].kind != ITEM_NONE && declares(&s->items[k], word, false))
                keep(s, &s->items[k]);
}

/* ---- Its values -------------------------------------------------------------------------------------------------- */

typedef struct maker {
    source s;
    const dp_setup *setup;
    const char *const *defines;
    size_t define_count;
    bool met[32]; /* of the defines */
    written *out;
    char *error;
    char head[8192], call[2048]; /* the variables, and the function's arguments */
} maker;

static bool fail(maker *m, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool fail(maker *m, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->error, WRITTEN_TEXT_SIZE, format, arguments);
    va_end(arguments);
    return false;
}

/* What was given for a name, else what is guessed; null: nothing. */
static const char *word_for(maker *m, piece name, bool *guessed) {
    char text[NAME_SIZE];
    snprintf(text, sizeof text, "%.*s", (int)name.length, name.at);
    *guessed = false;
    for (size_t i = 0; i < m->define_count; i++)
        if (strncmp(m->defines[i], text, strlen(text)) == 0 && m->defines[i][strlen(text)] == '=') {
            m->met[i] = true;
            return m->defines[i] + strlen(text) + 1;
        }
    const value_row *row = guess(text, m->s.hlsl);
    *guessed = true;
    return row != NULL ? row->word : NULL;
}

static void say_define(written *w, piece name, const char *word, bool guessed) {
    append(w->defines, sizeof w->defines, "%s%.*s = %s%s", w->defines[0] != '\0' ? ", " : "", (int)name.length, name.at,
           word, guessed ? " (guessed)" : "");
}

/* The expression of a value, of a type where one is known: "float4(depthprec_v[3], ...)". */
static bool express(maker *m, piece name, const char *word, bool guessed, piece type, char out[VALUE_SIZE]) {
    static const char *const types[2][3] = {{"vec2", "vec4", "mat4"}, {"float2", "float4", "float4x4"}};
    const value_row *row = row_of(word);
    const unsigned floats = row != NULL ? row->floats : 1;
    double v[FLOATS_MOST] = {0};
    written *w = m->out;
    char text[NAME_SIZE];
    if (w->used + floats >= WRITTEN_CONSTANTS)
        return fail(m, "has more than %d numbers of a camera", WRITTEN_CONSTANTS - 1);
    w->camera = w->camera || row != NULL;
    if (row != NULL)
        row->fill(m->setup, v);
    else
        number_of_text(word, &v[0]);
    snprintf(text, sizeof text, "%.*s", (int)type.length, type.at);
    if (floats > 1)
        snprintf(text, sizeof text, "%s", types[m->s.hlsl][floats == 2 ? 0 : floats == 4 ? 1 : 2]);
    snprintf(out, VALUE_SIZE, "%s(", text[0] != '\0' ? text : "float");
    for (unsigned i = 0; i < floats; i++) {
        const unsigned at = floats == 16 && !m->s.hlsl ? i % 4 * 4 + i / 4 : i; /* GLSL takes columns */
        append(out, VALUE_SIZE, "%sdepthprec_v[%zu]", i > 0 ? ", " : "", w->used);
        w->constants[w->used++] = (float)v[at];
    }
    append(out, VALUE_SIZE, ")");
    say_define(w, name, word, guessed);
    return true;
}

/* The type with which a uniform is declared. */
static piece type_of(const source *s, piece name) {
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        if (i->kind == ITEM_NONE)
            for (piece word; next_word(&at, i->to, &word, &open);)
                if (word.length == name.length && memcmp(word.at, name.at, name.length) == 0)
                    return word_before(i->from, word.at);
    }
    return (piece){"", 0};
}

static bool is_declared(const source *s, piece name) {
    for (size_t k = 0; k < s->count; k++)
        if (s->items[k].kind != ITEM_NONE && declares(&s->items[k], name, false))
            return true;
    return false;
}

static bool is_made(const maker *m, piece name) {
    char text[NAME_SIZE + 8];
    snprintf(text, sizeof text, " %.*s ", (int)name.length, name.at);
    return strstr(m->head, text) != NULL;
}

/* Does the word stand in a line such as #if? */
static bool in_condition(const source *s, piece word) {
    static const char *const all[] = {"if", "ifdef", "ifndef", "elif", NULL};
    const char *from = word.at;
    int open = 0;
    piece first;
    while (from > s->text && from[-1] != '\n')
        from--;
    return after(from, word.at) == '#' && next_word(&from, word.at + word.length, &first, &open) && is_any(first, all);
}

/* Names in conditions that the file does not define. Unity defines UNITY_REVERSED_Z where depth is reversed; of one
 * that is not known either side may be what is meant. */
static void define_macros(maker *m) {
    static const char *const own[] = {"if", "ifdef", "ifndef", "elif", "defined", NULL};
    const source *s = &m->s;
    for (size_t k = 0; k < s->count; k++) {
        const char *at = s->items[k].from;
        int open = 0;
        for (piece word; s->items[k].kept && next_word(&at, s->items[k].to, &word, &open);) {
            const bool unity = is(word, "UNITY_REVERSED_Z");
            bool guessed;
            if (!in_condition(s, word) || word.length >= NAME_SIZE || is_any(word, own) ||
                strncmp(word.at, "GL_", 3) == 0 || is_made(m, word) || is_declared(s, word))
                continue;
            const char *given = word_for(m, word, &guessed);
            const bool defined = guessed ? unity && m->setup->reversed != 0 : strcmp(given, "0") != 0;
            if (guessed && !unity)
                snprintf(m->out->open, sizeof m->out->open, "%.*s", (int)word.length, word.at);
            if (defined)
                append(m->head, sizeof m->head, "#define %.*s %s\n", (int)word.length, word.at, guessed ? "1" : given);
            if (defined || !guessed)
                say_define(m->out, word, guessed ? "1" : given, guessed);
        }
    }
}

/* A variable for each word that what is kept does not know, and somebody does. */
static bool make_variables(maker *m) {
    const source *s = &m->s;
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        for (piece word; i->kept && next_word(&at, i->to, &word, &open);) {
            char value[VALUE_SIZE];
            bool guessed;
            if (word.length >= NAME_SIZE || *before(i->from, word.at) == '.' || in_condition(s, word))
                continue;
            const bool known = declares(i, word, true) || is_made(m, word) || is_declared(s, word);
            const char *text = known ? NULL : word_for(m, word, &guessed);
            if (text == NULL)
                continue;
            const piece type = type_of(s, word);
            if (!express(m, word, text, guessed, type, value))
                return false;
            append(m->head, sizeof m->head, "%s%.*s %.*s = %s;\n", s->hlsl ? "static " : "", (int)strcspn(value, "("),
                   value, (int)word.length, word.at, value);
        }
    }
    return true;
}

/* ---- The function ------------------------------------------------------------------------------------------------ */

/* "const in float depth": its type and name. */
static void read_parameter(const char *from, const char *to, piece *type, piece *name) {
    int open = 0;
    *type = *name = (piece){"", 0};
    for (piece word; *from != ':' && *from != '=' && next_word(&from, to, &word, &open);) {
        *type = *name;
        *name = word;
        from += from < to && isspace((unsigned char)*from) ? strspn(from, " \t\r\n") : 0;
    }
}

static bool take_parameter(maker *m, const char *from, const char *to, bool *has_depth) {
    static const char *const scalar[] = {"float", "half", NULL};
    char value[VALUE_SIZE] = "depthprec_d";
    piece type, name;
    bool guessed;
    from += strspn(from, " \t\r\n");
    read_parameter(from, to, &type, &name);
    const char *word = name.length > 0 && name.length < NAME_SIZE ? word_for(m, name, &guessed) : NULL;
    if (word == NULL && (*has_depth || !is_any(type, scalar)))
        return fail(m,
                    "takes %.*s, which nothing is known of: --define %.*s=near|far|z_buffer_params|projection|NUMBER, "
                    "or write a function of one float, a depth",
                    (int)(to - from), from, (int)name.length, name.at);
    if (word == NULL)
        *has_depth = true;
    else if (!express(m, name, word, guessed, type, value))
        return false;
    append(m->call, sizeof m->call, "%s%s", m->call[0] != '\0' ? ", " : "", value);
    return true;
}

static bool take_function(maker *m, const item *i) {
    static const char *const scalar[] = {"float", "half", NULL};
    const char *at = i->name.at + i->name.length;
    const piece type = word_before(i->from, i->name.at);
    bool has_depth = false;
    if (!is_any(type, scalar))
        return fail(m, "gives %.*s: what is judged gives one float", (int)type.length, type.at);
    at = strchr(at, '(') + 1;
    for (const char *c = at; after(at, i->to) != ')'; c++)
        if (*c == ',' || *c == ')') {
            if (!take_parameter(m, at, c, &has_depth))
                return false;
            at = *c == ',' ? c + 1 : c;
        }
    return has_depth || fail(m, "takes no float that is a depth");
}

/* What main does. How often it turns stands in the last constant, so that no compiler writes all turns out; many calls
 * a turn, in four sums, so that the loop is little beside them. */
static void write_body(written *out, unsigned turns, char body[BODY_SIZE]) {
    static const char start[] =
        "    float depthprec_d = depthprec_in[depthprec_i];\n"
        "    float depthprec_s0 = 0.0, depthprec_s1 = 0.0, depthprec_s2 = 0.0, depthprec_s3 = 0.0;\n"
        "    for (float depthprec_k = 0.0; depthprec_k < depthprec_v[%d]; depthprec_k += 1.0) {\n";
    body[0] = '\0';
    if (turns == 0) {
        append(body, BODY_SIZE, "    depthprec_out[depthprec_i] = depthprec_call(depthprec_in[depthprec_i]);\n}\n");
        return;
    }
    out->constants[WRITTEN_CONSTANTS - 1] = (float)turns;
    append(body, BODY_SIZE, start, WRITTEN_CONSTANTS - 1);
    for (int k = 0; k < WRITTEN_CALLS; k++)
        append(body, BODY_SIZE, "        depthprec_s%d += depthprec_call(%g * depthprec_d);\n", k % 4, 1 - k / 32.0);
    append(body, BODY_SIZE,
           "        depthprec_d *= 0.999;\n    }\n"
           "    depthprec_out[depthprec_i] = depthprec_s0 + depthprec_s1 + depthprec_s2 + depthprec_s3;\n}\n");
}

static bool write_text(maker *m, const char *function, unsigned turns) {
    static const char glsl[] =
        "#version 460\n"
        "layout(std430, set = 0, binding = 2) readonly buffer depthprec_2 { float depthprec_v[]; };\n"
        "%s#line 1\n%s\n"
        "layout(local_size_x = 64) in;\n"
        "layout(std430, set = 0, binding = 0) readonly buffer depthprec_0 { float depthprec_in[]; };\n"
        "layout(std430, set = 0, binding = 1) writeonly buffer depthprec_1 { float depthprec_out[]; };\n"
        "float depthprec_call(float depthprec_d) { return %s(%s); }\n"
        "void main() {\n"
        "    uint depthprec_i = gl_GlobalInvocationID.x;\n%s";
    static const char hlsl[] = "[[vk::binding(2, 0)]] RWStructuredBuffer<float> depthprec_v;\n"
                               "%s#line 1\n%s\n"
                               "[[vk::binding(0, 0)]] RWStructuredBuffer<float> depthprec_in;\n"
                               "[[vk::binding(1, 0)]] RWStructuredBuffer<float> depthprec_out;\n"
                               "float depthprec_call(float depthprec_d) { return %s(%s); }\n"
                               "[numthreads(64, 1, 1)] void main(uint3 depthprec_id : SV_DispatchThreadID) {\n"
                               "    uint depthprec_i = depthprec_id.x;\n%s";
    char body[BODY_SIZE];
    write_body(m->out, turns, body);
    const size_t size =
        strlen(m->s.text) + sizeof m->head + sizeof m->call + NAME_SIZE + sizeof body + sizeof glsl + sizeof hlsl;
    for (const char *c = m->s.text; *c != '\0'; c++)
        m->out->lines += *c == '\n';
    for (size_t k = 0; k < m->s.count; k++)
        if (!m->s.items[k].kept)
            blank(m->s.text + (m->s.items[k].from - m->s.text), m->s.items[k].to);
    m->out->text = malloc(size);
    if (m->out->text == NULL)
        return fail(m, "does not fit into memory");
    if (m->s.hlsl)
        snprintf(m->out->text, size, hlsl, m->head, m->s.text, function, m->call, body);
    else
        snprintf(m->out->text, size, glsl, m->head, m->s.text, function, m->call, body);
    return true;
}

/* Of several functions of the name the first that can be called. */
static bool find_function(maker *m, const char *function) {
    bool found = false, any = false;
    for (size_t k = 0; k < m->s.count && !found; k++) {
        item *i = &m->s.items[k];
        if (i->kind != ITEM_FUNCTION || !is(i->name, function))
            continue;
        any = true;
        m->out->used = 0;
        m->out->defines[0] = m->call[0] = '\0';
        found = take_function(m, i);
        if (found)
            keep(&m->s, i);
    }
    if (found || any)
        return found;
    fail(m, "is no function of the file, which has");
    for (size_t k = 0; k < m->s.count; k++)
        if (m->s.items[k].kind == ITEM_FUNCTION)
            append(m->error, WRITTEN_TEXT_SIZE, "%s %.*s", any ? "," : "", (int)m->s.items[k].name.length,
                   m->s.items[k].name.at),
                any = true;
    if (!any)
        append(m->error, WRITTEN_TEXT_SIZE, " none");
    return false;
}

bool written_make(const char *file, const char *function, bool hlsl, const dp_setup *setup, const char *const *defines,
                  size_t define_count, unsigned turns, written *out, char error[WRITTEN_TEXT_SIZE]) {
    maker m = {.s = {.text = strdup(file), .hlsl = hlsl},
               .setup = setup,
               .defines = defines,
               .define_count = define_count,
               .out = out,
               .error = error};
    *out = (written){0};
    if (m.s.text != NULL)
        blank_remarks(m.s.text);
    bool good =
        m.s.text != NULL && take_apart(&m.s) ? find_function(&m, function) : fail(&m, "does not fit into memory");
    for (size_t k = 0; k < m.s.count && good; k++)
        if (m.s.items[k].kept && m.s.items[k].kind == ITEM_DIRECTIVE)
            keep(&m.s, &m.s.items[k]);
    if (good)
        define_macros(&m);
    good = good && make_variables(&m);
    for (size_t i = 0; i < define_count && good; i++)
        if (!m.met[i])
            good = fail(&m, "knows nothing by the name of --define %s", defines[i]);
    good = good && write_text(&m, function, turns);
    free(m.s.items);
    free(m.s.text);
    return good;
}
