/* SPDX-License-Identifier: GPL-3.0-or-later */
/* depthprec.1 has every row of the option table: its letter, argument, limits and default. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/option_rows.h"
#include "support.h"

enum { PAGE_SIZE = 1 << 17 };

/* The letters and digits of a text, lower case: what is left of an argument without brackets and macros. */
static void letters_of(const char *text, char out[256]) {
    size_t used = 0;
    for (; *text != '\0' && used < 255; text++)
        if ((*text >= 'A' && *text <= 'Z') || (*text >= 'a' && *text <= 'z') || (*text >= '0' && *text <= '9'))
            out[used++] = (char)(*text | 0x20);
    out[used] = '\0';
}

/* Takes the macros out of an item: "Fl n , Fl -near Ar Z" is "-n, --near Z". */
static void item_of(const char *line, size_t length, char out[256]) {
    char text[256];
    snprintf(text, sizeof text, "%.*s", (int)length, line);
    out[0] = '\0';
    for (char *word = strtok(text, " "); word != NULL; word = strtok(NULL, " ")) {
        static const char *const macros[] = {"Ar", "Cm", "Ns", "Op", "Oo", "Oc"};
        bool macro = false;
        for (size_t i = 0; i < sizeof macros / sizeof macros[0]; i++)
            macro = macro || strcmp(word, macros[i]) == 0;
        if (!macro)
            snprintf(out + strlen(out), 256 - strlen(out), "%s%s", strcmp(word, "Fl") == 0 ? "" : word,
                     strcmp(word, "Fl") == 0 ? "-" : " ");
    }
}

/* Of the page's items for an option: the argument, one behind the other, and all that is said of it. */
static bool described(const char *page, const option_row *row, char argument[256], char said[4096]) {
    char begin[64], item[256];
    argument[0] = said[0] = '\0';
    if (row->letter != 0)
        snprintf(begin, sizeof begin, "-%c , --%s ", row->letter, row->name);
    else
        snprintf(begin, sizeof begin, "--%s ", row->name);
    for (const char *line = strstr(page, "\n.Sh OPTIONS"); line != NULL && strncmp(line, "\n.Sh FORMATS", 12) != 0;
         line = strchr(line + 1, '\n')) {
        if (strncmp(line, "\n.It Fl ", 8) != 0)
            continue;
        item_of(line + 5, strcspn(line + 5, "\n"), item);
        if (strncmp(item, begin, strlen(begin)) != 0)
            continue;
        if (strstr(argument, item + strlen(begin)) == NULL)
            snprintf(argument + strlen(argument), 256 - strlen(argument), "%s", item + strlen(begin));
        const char *text = strchr(line + 1, '\n');
        while (strncmp(text, "\n.It", 4) != 0 && strncmp(text, "\n.El", 4) != 0) {
            text += text[1] == '.' ? strcspn(text, " ") : 1; /* macros have a blank behind them */
            snprintf(said + strlen(said), 4096 - strlen(said), "%.*s ", (int)strcspn(text, "\n"), text);
            text = strchr(text, '\n');
        }
    }
    return said[0] != '\0';
}

static void check_described(tally *t, const char *page, const option_row *row) {
    char argument[256], said[4096], text[OPTION_TEXT_SIZE], ours[256], theirs[256];
    if (!described(page, row, argument, said)) {
        TALLY(t, false, "--%s is not in the page", row->name);
        return;
    }
    letters_of(option_argument(row, text), ours);
    letters_of(argument, theirs);
    TALLY(t, strcmp(ours, theirs) == 0, "--%s: %s, in the page %s", row->name, text, argument);
    TALLY(t, row->least >= row->most || strstr(said, option_limits(row, text)) != NULL, "--%s: %s, in the page: %s",
          row->name, text, said);
    TALLY(t, row->standard == NULL || (strstr(said, "efault") != NULL && strstr(said, row->standard) != NULL),
          "--%s: default %s, in the page: %s", row->name, row->standard, said);
}

static void test_page(void **state) {
    char *page = calloc(1, PAGE_SIZE);
    FILE *f = fopen("man/depthprec.1", "r");
    tally t = {.name = "page"};
    (void)state;
    assert_true(page != NULL && f != NULL);
    assert_true(fread(page, 1, PAGE_SIZE - 1, f) < PAGE_SIZE - 1);
    fclose(f);
    for (int id = 0; id < OPTION_COUNT; id++)
        check_described(&t, page, &option_rows[id]);
    free(page);
    tally_end(&t);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_page)};
    return run_tap(tests);
}
