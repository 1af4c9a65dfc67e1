/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/written.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "core/elementary.h"
#include "depthprec/depth.h"
#include "judge/listing.h"
#include "shader/constants.h"

enum { NAME_SIZE = 64, VALUE_SIZE = 512, FLOATS_MOST = 16, BODY_SIZE = 2048 };

/* ---- What a shader may be given ---------------------------------------------------------------------------------- */

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

static void fill_zbuffer(const dp_setup *s, double out[FLOATS_MOST]) {
    const zbuffer_params p = shader_constants_of(s).zbuffer;
    const float all[4] = {p.x, p.y, p.z, p.w};
    for (int i = 0; i < 4; i++)
        out[i] = (double)all[i];
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

/* By a word; and the names by which it is guessed, without underscores and in small letters. A row without names is
 * what the one above it is in HLSL, where cameras look along +z. */
typedef struct value_row {
    const char *word;
    unsigned floats;
    const char *numbers; /* a letter each, see number() */
    void (*fill)(const dp_setup *s, double out[FLOATS_MOST]);
    const char *names;
} value_row;

static const value_row rows[] = {
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

/* The row that a name suggests, "camera.near" by its last word. */
static const value_row *guess(const char *name, bool hlsl) {
    const char *member = strrchr(name, '.');
    char key[NAME_SIZE + 2] = " ";
    size_t used = 1;
    for (const char *c = member != NULL ? member + 1 : name; *c != '\0' && used < NAME_SIZE; c++)
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

/* ---- Its values -------------------------------------------------------------------------------------------------- */

typedef struct maker {
    listing s;
    const dp_setup *setup;
    const char *const *defines;
    size_t define_count;
    bool met[32]; /* of the defines */
    written *out;
    char *error;
    char head[8192], body[4096], call[2048]; /* the variables, what fills structures, the function's arguments */
} maker;

static bool fail(maker *m, const char *format, ...) __attribute__((format(printf, 2, 3)));
static bool fail(maker *m, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(m->error, WRITTEN_TEXT_SIZE, format, arguments);
    va_end(arguments);
    return false;
}

/* The word given for a name, else the one that is guessed; null: none. */
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
    char one[WRITTEN_TEXT_SIZE];
    snprintf(one, sizeof one, "%.*s = %s%s", (int)name.length, name.at, word, guessed ? " (guessed)" : "");
    const char *said = strstr(w->defines, one);
    if (said == NULL || (said > w->defines && said[-1] != ' '))
        append(w->defines, sizeof w->defines, "%s%s", w->defines[0] != '\0' ? ", " : "", one);
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
    if (row != NULL && row->fill != NULL)
        row->fill(m->setup, v);
    else if (row == NULL)
        number_of_text(word, &v[0]);
    for (unsigned i = 0; row != NULL && row->numbers != NULL && i < floats; i++)
        v[i] = number(m->setup, row->numbers[i]);
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

static bool is_made(const maker *m, piece name) {
    char text[NAME_SIZE + 8];
    snprintf(text, sizeof text, " %.*s ", (int)name.length, name.at);
    return strstr(m->head, text) != NULL;
}

/* Names in conditions that the file does not define. Unity defines UNITY_REVERSED_Z where depth is reversed; of one
 * that is not known either side may be what is meant. */
static void define_macros(maker *m) {
    static const char *const own[] = {"if", "ifdef", "ifndef", "elif", "defined", NULL};
    const listing *s = &m->s;
    for (size_t k = 0; k < s->count; k++) {
        const char *at = s->items[k].from;
        int open = 0;
        for (piece word; s->items[k].kept && listing_word(&at, s->items[k].to, &word, &open);) {
            const bool unity = piece_is(word, "UNITY_REVERSED_Z");
            bool guessed;
            if (!listing_in_condition(s, word) || !listing_matters(s, &s->items[k]) || word.length >= NAME_SIZE ||
                piece_is_any(word, own) || strncmp(word.at, "GL_", 3) == 0 || is_made(m, word) ||
                listing_declares(s, word))
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

/* A member of a structure that the camera is in. */
static bool make_member(maker *m, piece of, piece member) {
    char whole[2 * NAME_SIZE], made[2 * NAME_SIZE + 8], value[VALUE_SIZE];
    bool guessed;
    snprintf(whole, sizeof whole, "%.*s.%.*s", (int)of.length, of.at, (int)member.length, member.at);
    snprintf(made, sizeof made, " %s = ", whole);
    const piece name = {whole, strlen(whole)};
    if (strstr(m->body, made) != NULL)
        return true;
    const char *word = name.length < NAME_SIZE ? word_for(m, name, &guessed) : NULL;
    if (word == NULL)
        return fail(m, "reads %s, which nothing is known of: --define %s=near|far|z_buffer_params|projection|NUMBER",
                    whole, whole);
    if (!express(m, name, word, guessed, listing_type(&m->s, member, true), value))
        return false;
    append(m->body, sizeof m->body, "   %s%s;\n", made, value);
    return true;
}

static bool make_members(maker *m, piece of, const item *structure) {
    const char *at = structure->from;
    int open = 0;
    for (piece member; listing_member(structure, &at, &open, &member);)
        if (!make_member(m, of, member))
            return false;
    return true;
}

/* Makes the members that are read of a uniform structure; all where it is handed on as a whole. */
static bool make_structure(maker *m, piece name, const item *structure) {
    const listing *s = &m->s;
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        if (!i->kept || listing_item_declares(i, name, true) || listing_item_declares(i, name, false))
            continue;
        for (piece word, member; listing_word(&at, i->to, &word, &open);) {
            if (!piece_same(word, name) || *listing_before(i->from, word.at) == '.')
                continue;
            const bool part = listing_after(at, i->to) == '.' && listing_word(&at, i->to, &member, &open);
            if (part ? !make_member(m, name, member) : !make_members(m, name, structure))
                return false;
        }
    }
    return true;
}

/* A variable for each word that what is kept does not know, and somebody does. */
static bool make_variables(maker *m) {
    const listing *s = &m->s;
    for (size_t k = 0; k < s->count; k++) {
        const item *i = &s->items[k];
        const char *at = i->from;
        int open = 0;
        for (piece word; i->kept && i->kind != ITEM_STRUCTURE && listing_word(&at, i->to, &word, &open);) {
            char value[VALUE_SIZE];
            bool guessed;
            if (word.length >= NAME_SIZE || *listing_before(i->from, word.at) == '.' || listing_in_condition(s, word))
                continue;
            const bool known = listing_item_declares(i, word, true) || is_made(m, word) || listing_declares(s, word);
            const char *text = known ? NULL : word_for(m, word, &guessed);
            const item *structure = known || text != NULL ? NULL : listing_release(&m->s, word);
            if (structure != NULL && !make_structure(m, word, structure))
                return false;
            if (text == NULL)
                continue;
            const piece type = listing_type(s, word, false);
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
    for (piece word; *from != ':' && *from != '=' && listing_word(&from, to, &word, &open);) {
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
    const item *structure = word == NULL ? listing_structure(&m->s, type) : NULL;
    if (structure != NULL) {
        append(m->body, sizeof m->body, "    %.*s %.*s;\n", (int)type.length, type.at, (int)name.length, name.at);
        snprintf(value, sizeof value, "%.*s", (int)name.length, name.at);
        if (!make_members(m, name, structure))
            return false;
    } else if (word == NULL && (*has_depth || !piece_is_any(type, scalar))) {
        return fail(m,
                    "takes %.*s, which nothing is known of: --define %.*s=near|far|z_buffer_params|projection|NUMBER, "
                    "or write a function of one float, a depth",
                    (int)(to - from), from, (int)name.length, name.at);
    }
    if (word == NULL && structure == NULL)
        *has_depth = true;
    else if (word != NULL && !express(m, name, word, guessed, type, value))
        return false;
    append(m->call, sizeof m->call, "%s%s", m->call[0] != '\0' ? ", " : "", value);
    return true;
}

static bool take_function(maker *m, const item *i) {
    static const char *const scalar[] = {"float", "half", NULL};
    const char *at = i->name.at + i->name.length;
    const piece type = listing_word_before(i->from, i->name.at);
    bool has_depth = false;
    if (!piece_is_any(type, scalar))
        return fail(m, "gives %.*s: what is judged gives one float", (int)type.length, type.at);
    at = strchr(at, '(') + 1;
    for (const char *c = at; listing_after(at, i->to) != ')'; c++)
        if (*c == ',' || *c == ')') {
            if (!take_parameter(m, at, c, &has_depth))
                return false;
            at = *c == ',' ? c + 1 : c;
        }
    return has_depth || fail(m, "takes no float that is a depth");
}

/* Writes the body of main. How often it turns stands in the last constant, so that no compiler writes all turns out;
 * many calls a turn, in four sums, so that the loop is little beside them. */
static void write_run(written *out, unsigned turns, char run[BODY_SIZE]) {
    static const char start[] =
        "    float depthprec_d = depthprec_in[depthprec_i];\n"
        "    float depthprec_s0 = 0.0, depthprec_s1 = 0.0, depthprec_s2 = 0.0, depthprec_s3 = 0.0;\n"
        "    for (float depthprec_k = 0.0; depthprec_k < depthprec_v[%d]; depthprec_k += 1.0) {\n";
    run[0] = '\0';
    if (turns == 0) {
        append(run, BODY_SIZE, "    depthprec_out[depthprec_i] = depthprec_call(depthprec_in[depthprec_i]);\n}\n");
        return;
    }
    out->constants[WRITTEN_CONSTANTS - 1] = (float)turns;
    append(run, BODY_SIZE, start, WRITTEN_CONSTANTS - 1);
    for (int k = 0; k < WRITTEN_CALLS; k++)
        append(run, BODY_SIZE, "        depthprec_s%d += depthprec_call(%g * depthprec_d);\n", k % 4, 1 - k / 32.0);
    append(run, BODY_SIZE,
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
        "float depthprec_call(float depthprec_d) {\n%s    return %s(%s);\n}\n"
        "void main() {\n"
        "    uint depthprec_i = gl_GlobalInvocationID.x;\n%s";
    static const char hlsl[] = "[[vk::binding(2, 0)]] RWStructuredBuffer<float> depthprec_v;\n"
                               "%s#line 1\n%s\n"
                               "[[vk::binding(0, 0)]] RWStructuredBuffer<float> depthprec_in;\n"
                               "[[vk::binding(1, 0)]] RWStructuredBuffer<float> depthprec_out;\n"
                               "float depthprec_call(float depthprec_d) {\n%s    return %s(%s);\n}\n"
                               "[numthreads(64, 1, 1)] void main(uint3 depthprec_id : SV_DispatchThreadID) {\n"
                               "    uint depthprec_i = depthprec_id.x;\n%s";
    char run[BODY_SIZE];
    write_run(m->out, turns, run);
    const size_t size = strlen(m->s.text) + sizeof m->head + sizeof m->body + sizeof m->call + NAME_SIZE + sizeof run +
                        sizeof glsl + sizeof hlsl;
    for (const char *c = m->s.text; *c != '\0'; c++)
        m->out->lines += *c == '\n';
    listing_blank_rest(&m->s);
    m->out->text = malloc(size);
    if (m->out->text == NULL)
        return fail(m, "does not fit into memory");
    if (m->s.hlsl)
        snprintf(m->out->text, size, hlsl, m->head, m->s.text, m->body, function, m->call, run);
    else
        snprintf(m->out->text, size, glsl, m->head, m->s.text, m->body, function, m->call, run);
    return true;
}

/* Finds the first function of that name which can be called. */
static bool find_function(maker *m, const char *function) {
    bool found = false, any = false;
    for (size_t k = 0; k < m->s.count && !found; k++) {
        item *i = &m->s.items[k];
        if (i->kind != ITEM_FUNCTION || !piece_is(i->name, function))
            continue;
        any = true;
        m->out->used = 0;
        m->out->defines[0] = m->call[0] = m->body[0] = '\0';
        found = take_function(m, i);
        if (found)
            listing_keep(&m->s, i);
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

const char *written_only(const char *file, bool hlsl, char name[WRITTEN_NAME_SIZE], char error[WRITTEN_TEXT_SIZE]) {
    listing s;
    size_t count = 0;
    const bool good = listing_read(file, hlsl, &s);
    error[0] = '\0';
    append(error, WRITTEN_TEXT_SIZE, "name its function, FILE:FUNCTION; it has");
    for (size_t k = 0; good && k < s.count; k++)
        if (s.items[k].kind == ITEM_FUNCTION) {
            const int length = (int)s.items[k].name.length;
            append(error, WRITTEN_TEXT_SIZE, "%s %.*s", count++ > 0 ? "," : "", length, s.items[k].name.at);
            snprintf(name, WRITTEN_NAME_SIZE, "%.*s", length, s.items[k].name.at);
        }
    listing_free(&s);
    if (count == 0)
        append(error, WRITTEN_TEXT_SIZE, " none");
    return count == 1 ? name : NULL;
}

bool written_make(const char *file, const char *function, bool hlsl, const dp_setup *setup, const char *const *defines,
                  size_t define_count, unsigned turns, written *out, char error[WRITTEN_TEXT_SIZE]) {
    maker m = {.setup = setup, .defines = defines, .define_count = define_count, .out = out, .error = error};
    *out = (written){0};
    bool good = listing_read(file, hlsl, &m.s) ? find_function(&m, function) : fail(&m, "does not fit into memory");
    for (size_t k = 0; k < m.s.count && good; k++)
        if (m.s.items[k].kept && m.s.items[k].kind == ITEM_DIRECTIVE)
            listing_keep(&m.s, &m.s.items[k]);
    if (good)
        define_macros(&m);
    good = good && make_variables(&m);
    for (size_t i = 0; i < define_count && good; i++)
        if (!m.met[i])
            good = fail(&m, "knows nothing by the name of --define %s", defines[i]);
    good = good && write_text(&m, function, turns);
    listing_free(&m.s);
    return good;
}
