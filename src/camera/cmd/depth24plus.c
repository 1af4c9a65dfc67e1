/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/cmd/depth24plus.h"

#include <string.h>
#include <strings.h>

#include "core/append.h"

static const char open_name[] = "depth24plus", with_stencil[] = "depth24plus-stencil8";

/* "chrome-d3d, safari and firefox-d3d": those that store that format. */
static void name_all(const char *given, const char *format, char *out, size_t size) {
    const char *names[64];
    size_t count = 0;
    for (size_t i = 0; platform_get(i) != NULL && count < sizeof names / sizeof *names; i++) {
        const char *stored = platform_stores(platform_get(i), given);
        if (stored != NULL && strcmp(stored, format) == 0)
            names[count++] = platform_get(i)->name;
    }
    for (size_t i = 0; i < count; i++)
        append(out, size, "%s%s", i == 0 ? "" : i + 1 == count ? " and " : ", ", names[i]);
}

void depth24plus_say(page *p, const camera_asked *c) {
    static const struct {
        const char *stored, *said;
    } formats[] = {
        {"fp32", "fp32 in"}, {"unorm24", "unorm24 in"}, {with_stencil, "either in"}, {open_name, "either in"}};
    const char *given = option_text(c->line, "format");
    if (given == NULL || c->platform != NULL || strncasecmp(given, open_name, strlen(open_name)) != 0)
        return;
    char text[512] = "";
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        char names[256] = "";
        name_all(given, formats[i].stored, names, sizeof names);
        if (names[0] != '\0')
            append(text, sizeof text, "%s %s %s", text[0] == '\0' ? "" : ",", formats[i].said, names);
    }
    if (text[0] != '\0')
        page_text(p, "%s is%s: --platform takes one.", given, text);
}
