/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge/written.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/append.h"
#include "judge/given.h"
#include "judge/listing.h"

enum { VALUE_SIZE = 512, BODY_SIZE = 2048 };

static bool number_of_text(const char *text, double *out) {
    char *end;
    *out = strtod(text, &end);
    return end != text && *end == '\0' && isfinite(*out);
}

bool written_define_known(const char *define) {
    const char *value = strchr(define, '=');
    double unused;
    return value != NULL && value != define && value - define < GIVEN_NAME_SIZE &&
           (given_find(value + 1) != NULL || number_of_text(value + 1, &unused));
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
    char text[GIVEN_NAME_SIZE];
    snprintf(text, sizeof text, "%.*s", (int)name.length, name.at);
    *guessed = false;
    for (size_t i = 0; i < m->define_count; i++)
        if (strncmp(m->defines[i], text, strlen(text)) == 0 && m->defines[i][strlen(text)] == '=') {
            m->met[i] = true;
            return m->defines[i] + strlen(text) + 1;
        }
    const given_row *row = given_guess(text, m->s.hlsl);
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
    const given_row *row = given_find(word);
    const unsigned floats = row != NULL ? row->floats : 1;
    double v[GIVEN_FLOATS] = {0};
    written *w = m->out;
    char text[GIVEN_NAME_SIZE];
    if (w->used + floats >= WRITTEN_CONSTANTS)
        return fail(m, "has more than %d numbers of a camera", WRITTEN_CONSTANTS - 1);
    w->camera = w->camera || row != NULL;
    if (row != NULL)
        given_fill(row, m->setup, v);
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

static bool is_made(const maker *m, piece name) {
    char text[GIVEN_NAME_SIZE + 8];
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
            if (!listing_in_condition(s, word) || !listing_matters(s, &s->items[k]) || word.length >= GIVEN_NAME_SIZE ||
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
    char whole[2 * GIVEN_NAME_SIZE], made[2 * GIVEN_NAME_SIZE + 8], value[VALUE_SIZE];
    bool guessed;
    snprintf(whole, sizeof whole, "%.*s.%.*s", (int)of.length, of.at, (int)member.length, member.at);
    snprintf(made, sizeof made, " %s = ", whole);
    const piece name = {whole, strlen(whole)};
    if (strstr(m->body, made) != NULL)
        return true;
    const char *word = name.length < GIVEN_NAME_SIZE ? word_for(m, name, &guessed) : NULL;
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
            if (word.length >= GIVEN_NAME_SIZE || *listing_before(i->from, word.at) == '.' ||
                listing_in_condition(s, word))
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
    const char *word = name.length > 0 && name.length < GIVEN_NAME_SIZE ? word_for(m, name, &guessed) : NULL;
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
    const size_t size = strlen(m->s.text) + sizeof m->head + sizeof m->body + sizeof m->call + GIVEN_NAME_SIZE +
                        sizeof run + sizeof glsl + sizeof hlsl;
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
        append(error, WRITTEN_TEXT_SIZE, " none; values of one are for --pairs");
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
