/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "api/unit.h"

#include <math.h>
#include <string.h>

static const unit_row rows[] = {{"nm", "", 1.0},    {"um", "\302\265m", 1e3}, {"mm", "", 1e6}, {"cm", "", 1e7},
                                {"in", "", 25.4e6}, {"ft", "", 304.8e6},      {"m", "", 1e9},  {"km", "", 1e12}};

const unit_row *unit_get(size_t index) {
    return index < sizeof rows / sizeof rows[0] ? &rows[index] : NULL;
}

const unit_row *unit_find(const char *name) {
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].name, name) == 0 || (*name != '\0' && strcmp(rows[i].alias, name) == 0))
            return &rows[i];
    return NULL;
}

static double divisor(double a, double b) {
    while (b > 0.0) {
        const double rest = fmod(a, b);
        a = b;
        b = rest;
    }
    return a;
}

double unit_convert(double value, const unit_row *from, const unit_row *to) {
    if (from == NULL || to == NULL)
        return value;
    const double common = divisor(from->nanometres, to->nanometres);
    return value * (from->nanometres / common) / (to->nanometres / common);
}
