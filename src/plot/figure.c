/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What figures share: styles of set-ups, ranges, panels. */
#include <math.h>
#include <string.h>

#include "plot/figure.h"

/* Which of the different formats (or mappings) set-up i has, counted in the order in which they appear. */
static int rank(const figure_request *r, size_t i, bool mapping, int *kinds) {
    size_t first[CHART_SERIES];
    int count = 0, found = 0;
    for (size_t k = 0; k < r->count && count < CHART_SERIES; k++) {
        int same = -1;
        for (int j = 0; j < count; j++) {
            const dp_spec *a = &r->setups[first[j]].spec, *b = &r->setups[k].spec;
            if (mapping ? a->mapping == b->mapping : strcmp(a->format.name, b->format.name) == 0)
                same = j;
        }
        if (same < 0)
            first[same = count++] = k;
        if (k == i)
            found = same;
    }
    *kinds = count;
    return found;
}

chart_style figure_style(const figure_request *request, size_t i) {
    int formats, mappings;
    int format = rank(request, i, false, &formats), mapping = rank(request, i, true, &mappings);
    if (formats > 1 && mappings > 1)
        return (chart_style){format, mapping, format, false};
    return (chart_style){(int)i, (int)i, (int)i, false};
}

void figure_range(const figure_request *request, double *lo, double *hi) {
    const dp_spec *spec = &request->setups[0].spec;
    *lo = isnan(request->lo) ? spec->znear : request->lo;
    *hi = isnan(request->hi) ? spec->zfar : request->hi;
    if (isinf(*hi))
        *hi = fmax(spec->znear * 1e6, *lo * 1e3);
}

chart_panel *figure_panel(const figure_request *request, chart *out, chart_axis y) {
    chart_panel *panel = chart_add_panel(out);
    if (panel == NULL)
        return NULL;
    panel->x = (chart_axis){.scale = CHART_LOG, .label = "eye depth z", .key = "z", .unit = "scene units"};
    figure_range(request, &panel->x.lo, &panel->x.hi);
    panel->y = y;
    return panel;
}
