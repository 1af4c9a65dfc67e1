/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The grammar of requirement files: each text beside the tree that a reader of its definition draws, or its fault. */
#include "core/append.h"
#include "solve/setting.h"
#include "support.h"

enum { DRAWN_SIZE = 1024 };

/* A tree in one notation: i integers, r reals, w words, strings in quotes, each name before "=". */
static void draw(const setting *s, char out[DRAWN_SIZE]) {
    static const char *const opening[] = {[SETTING_GROUP] = "{", [SETTING_ARRAY] = "[", [SETTING_LIST] = "("};
    static const char *const closing[] = {[SETTING_GROUP] = "}", [SETTING_ARRAY] = "]", [SETTING_LIST] = ")"};
    if (s->name != NULL)
        append(out, DRAWN_SIZE, "%s=", s->name);
    if (s->kind == SETTING_INTEGER)
        append(out, DRAWN_SIZE, "i%lld", s->integer);
    else if (s->kind == SETTING_STRING)
        append(out, DRAWN_SIZE, "\"%s\"", s->string);
    else if (s->kind < SETTING_GROUP)
        append(out, DRAWN_SIZE, "%c%.17g", s->kind == SETTING_REAL ? 'r' : 'w', s->number);
    else
        append(out, DRAWN_SIZE, "%s", opening[s->kind]);
    size_t count = 0;
    for (const setting *each = s->first; each != NULL; each = each->next, count++) {
        append(out, DRAWN_SIZE, "%s", count > 0 ? " " : "");
        draw(each, out);
    }
    assert_int_equal(count, s->count);
    if (s->kind >= SETTING_GROUP)
        append(out, DRAWN_SIZE, "%s", closing[s->kind]);
}

static const struct {
    const char *text, *tree;
} good[] = {
    {"", "{}"},
    {" \t\r\n\f\v", "{}"},
    {"a = 1;", "{a=i1}"},
    {"a : 1, b = 2 c = 3", "{a=i1 b=i2 c=i3}"},
    {"*a-b_9* = -7;", "{*a-b_9*=i-7}"},
    {"a = 0x1F; b = 0XfL; c = 3L; d = 4LL; e = +5;", "{a=i31 b=i15 c=i3 d=i4 e=i5}"},
    {"a = 99999999999999999999; b = -99999999999999999999;", "{a=i9223372036854775807 b=i-9223372036854775808}"},
    {"a = .5; b = 5.; c = 1e2; d = -1.5E+1; e = 25e-2; f = +0.125;", "{a=r0.5 b=r5 c=r100 d=r-15 e=r0.25 f=r0.125}"},
    {"a = 1e999;", "{a=rinf}"},
    {"a = true; b = FALSE; c = TrUe;", "{a=w1 b=w0 c=w1}"},
    {"a = \"\"; b = \"x\" \"y\" # z\n \"w\";", "{a=\"\" b=\"xyw\"}"},
    {"a = \"\\\"\\\\\\x41\\x4ag\\q\\xZ\";", "{a=\"\"\\AJg\\q\\xZ\"}"},
    {"a = \"\\a\\b\\f\\n\\r\\t\\v\";", "{a=\"\a\b\f\n\r\t\v\"}"},
    {"a = \"# // /* no comment\";", "{a=\"# // /* no comment\"}"},
    {"# a\n// b = 1;\n/* c = 1;\n */ d = /**/ 2 /* 3 */; #", "{d=i2}"},
    {"a = [1, 2,]; b = [\"x\", \"y\"]; c = [ ]; d = [0.5, 1.];", "{a=[i1 i2] b=[\"x\" \"y\"] c=[] d=[r0.5 r1]}"},
    {"a = (1, .5, \"x\", (2), [3], { b = 4; b2 = 5 }); c = ();", "{a=(i1 r0.5 \"x\" (i2) [i3] {b=i4 b2=i5}) c=()}"},
    {"a = { a = { a = { }; }; };", "{a={a={a={}}}}"},
};

static const struct {
    const char *text;
    int line;
    const char *says;
} bad[] = {
    {"a", 1, "syntax error"},
    {"a =", 1, "syntax error"},
    {"\n= 1;", 2, "syntax error"},
    {"1 = 1;", 1, "syntax error"},
    {"a = b;", 1, "syntax error"},
    {"a = trueish;", 1, "syntax error"},
    {"a = tru;", 1, "syntax error"},
    {"a = inf;", 1, "syntax error"},
    {"a = +inf;", 1, "syntax error"},
    {"a = -nan;", 1, "syntax error"},
    {"a = -0x10;", 1, "syntax error"},
    {"a = 0x1.8p3;", 1, "syntax error"},
    {"a = 1e;", 1, "syntax error"},
    {"a = .;", 1, "syntax error"},
    {"a = - 1;", 1, "syntax error"},
    {"a = 1\n 2;", 2, "syntax error"},
    {"a = 50m;", 1, "syntax error"},
    {"a = 1;; b = 2;", 1, "syntax error"},
    {"a = {", 1, "syntax error"},
    {"a = { b = 1; )", 1, "syntax error"},
    {"a = (1 2);", 1, "syntax error"},
    {"a = (,);", 1, "syntax error"},
    {"a = (1\n\n;", 3, "syntax error"},
    {"}", 1, "syntax error"},
    {"a = \"x\ny;\n", 1, "a string that nothing ends"},
    {"a = \"x\\", 1, "a string that nothing ends"},
    {"a = 1;\n/* b = 2;\n", 2, "a comment that nothing ends"},
    {"a = [1,\n 2.0];", 2, "mismatched element type"},
    {"a = [(1)];", 1, "mismatched element type"},
    {"a = [1, true];", 1, "mismatched element type"},
    {"a = 1;\nb = 2;\nb = 3;\na = 4;", 3, "duplicate"},
    {"g = { a = 1;\n a = 2; };", 2, "duplicate"},
    {"a = 1;\n@include \"x\"", 2, "@include is not allowed"},
};

TEST(each_text_has_its_tree) {
    tally told = {.name = "a text is read as the grammar says"};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        char drawn[DRAWN_SIZE] = "";
        settings s;
        setting_fault fault;
        const bool read = setting_parse(good[i].text, &s, &fault);
        if (read)
            draw(s.root, drawn);
        TALLY(&told, read && strcmp(drawn, good[i].tree) == 0, "%s\n-> %s (expected %s)", good[i].text,
              read ? drawn : fault.text, good[i].tree);
        setting_release(&s);
    }
    tally_end(&told);
}

TEST(each_fault_has_its_line) {
    tally told = {.name = "a fault is told with its line"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        settings s;
        setting_fault fault;
        const bool read = setting_parse(bad[i].text, &s, &fault);
        TALLY(&told, !read && fault.line == bad[i].line && strstr(fault.text, bad[i].says) != NULL,
              "%s\n-> line %d: %s (expected line %d: %s)", bad[i].text, read ? -1 : fault.line, read ? "" : fault.text,
              bad[i].line, bad[i].says);
        setting_release(&s);
    }
    tally_end(&told);
}

/* A setting is on the line of its name, an element on its own. */
TEST(settings_know_their_lines) {
    settings s;
    setting_fault fault;
    assert_true(setting_parse("a\n=\n1; b = (\n/*\n*/ 2, \"x\n\"\n\"y\", {c = 3})", &s, &fault));
    const setting *a = s.root->first, *b = a->next, *two = b->first, *x = two->next, *c = x->next->first;
    assert_int_equal(a->line, 1);
    assert_int_equal(b->line, 3);
    assert_int_equal(two->line, 5);
    assert_int_equal(x->line, 5);
    assert_int_equal(x->next->line, 7);
    assert_int_equal(c->line, 7);
    setting_release(&s);
}

TEST(brackets_go_as_deep_as_the_header_says) {
    for (int more = 0; more < 2; more++) {
        char text[2 * SETTING_DEEPEST + 16] = "a = ";
        const size_t deep = SETTING_DEEPEST + (size_t)more;
        memset(text + 4, '(', deep);
        memset(text + 4 + deep, ')', deep);
        settings s;
        setting_fault fault;
        assert_int_equal(setting_parse(text, &s, &fault), more == 0);
        setting_release(&s);
    }
}
