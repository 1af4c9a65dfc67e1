/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/profile.h"

#include <string.h>

#include "core/append.h"

bool profile_stores(const profile *p, const dp_format *format) {
    bool found = p->measured[0] == '\0';
    for (size_t i = 0; i < p->stored_count && !found; i++)
        found = strcmp(p->stored[i].name, format->name) == 0;
    return found;
}

const char *profile_formats(const profile *p, char out[PROFILE_FORMATS_SIZE]) {
    snprintf(out, PROFILE_FORMATS_SIZE, "%s", p->stored_count == 0 ? "nothing" : p->stored[0].name);
    for (size_t i = 1; i < p->stored_count; i++)
        append(out, PROFILE_FORMATS_SIZE, "%s%s", i + 1 < p->stored_count ? ", " : " or ", p->stored[i].name);
    return out;
}
