/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The door for profiles of GPUs: the visitor's, measured once for all that is shown of it, or one that a link carries.
 */
#include <stdio.h>

#include "cli/option/option.h"
#include "probe/brief.h"
#include "probe/cmd_probe/known.h"
#include "probe/cmd_probe/report.h"
#include "web/gpu.h"
#include "web/page.h"

static void end_word(void) {
    putchar('\0');
    fflush(stdout);
}

static int say_report(const probe_result *r, output_form form) {
    output out;
    int status = output_open(&out, NULL);
    if (status == EXIT_FINE) {
        probe_report(r, &out, form);
        status = output_close(&out);
    }
    end_word();
    return status;
}

static void say_known(const probe_result *r) {
    static known_comparison one; /* too large for a stack */
    for (size_t i = 0; known_compare(i, r, &one); i++) {
        printf("%s%c%zu%c%zu%c", one.name, 0, one.compared, 0, one.differ, 0);
        for (size_t k = 0; k < one.differ; k++)
            printf("%s%c%s%c%s%c", one.difference[k].finding, 0, one.difference[k].expected, 0, one.difference[k].got,
                   0);
    }
    fflush(stdout);
}

/**
 * Measures the GPU, or reads the profile that is the only word. Prints, each ended by 0: the report of probe, its JSON,
 * the profile as a link carries it; then of each known GPU its name, how many findings both have, how many differ, and
 * of each of those its subject, what that GPU gives and what this one does. @return exit status
 */
PAGE_EXPORT("profile") int profile_words(int count) {
    static probe_result r; /* too large for a stack */
    char text[BRIEF_SIZE], error[SHOT_ERROR_SIZE], **words;
    const int argc = page_words(count, &words);
    const bool good = argc == 2 ? brief_read(words[1], gpu_formats, &r, error) : probe_run(NULL, 0, &r, error);
    int status = good ? say_report(&r, FORM_TEXT) : usage_error("%s", error);
    if (status == EXIT_FINE)
        status = say_report(&r, FORM_JSON);
    if (status == EXIT_FINE) {
        brief_write(&r, text);
        printf("%s", text);
        end_word();
        say_known(&r);
    }
    probe_free(&r);
    return status;
}
