/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/profile.h"

#include <string.h>

#include "core/append.h"

bool profile_stores(const profile *p, const dp_format *format) {
    bool found = p->measured[0] == '\0';
    for (size_t i = 0; i < p->stored_count && !found; i++)
        found = strcmp(p->stored[i].format.name, format->name) == 0;
    return found;
}

const char *profile_formats(const profile *p, char out[PROFILE_FORMATS_SIZE]) {
    snprintf(out, PROFILE_FORMATS_SIZE, "%s", p->stored_count == 0 ? "nothing" : p->stored[0].format.name);
    for (size_t i = 1; i < p->stored_count; i++)
        append(out, PROFILE_FORMATS_SIZE, "%s%s", i + 1 < p->stored_count ? ", " : " or ", p->stored[i].format.name);
    return out;
}

const profile_format *profile_biased(const profile *p, const platform *by, const bias_api *api,
                                     const dp_format *format) {
    const char *below = by != NULL && strcmp(by->api, api->name) == 0 ? by->below : api->name;
    for (size_t i = 0; p->api != NULL && strcmp(p->api, below) == 0 && i < p->stored_count; i++)
        if (strcmp(p->stored[i].format.name, format->name) == 0 && p->stored[i].least > 0.0)
            return &p->stored[i];
    return NULL;
}

bias_api profile_bias(const profile *p, const platform *by, const bias_api *api, const dp_format *format) {
    const profile_format *of = profile_biased(p, by, api, format);
    bias_api out = platform_bias(by, api);
    if (of == NULL)
        return out;
    const bool scaled = out.scale_least > 0.0;
    out.unorm = BIAS_POWER;
    out.real = BIAS_EXPONENT;
    out.exponent = BIAS_EXPONENT_N;
    out.guaranteed = false; /* what polygons with the same vertices keep apart was not measured */
    out.scale_least = of->least * (scaled ? out.scale_least : 1.0);
    out.scale_most = of->most * (scaled ? out.scale_most : 1.0);
    return out;
}
