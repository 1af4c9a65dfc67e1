/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/unit.h"

#include <math.h>
#include <string.h>

static const unit_row rows[] = {
    {"nm", NULL, NULL, NULL, 1.0}, {"um", "\302\265m", NULL, NULL, 1e3}, {"mm", NULL, NULL, NULL, 1e6},
    {"cm", NULL, NULL, NULL, 1e7}, {"in", NULL, NULL, NULL, 25.4e6},     {"ft", NULL, NULL, NULL, 304.8e6},
    {"m", NULL, NULL, NULL, 1e9},  {"km", NULL, NULL, NULL, 1e12},
};

NAMED_TABLE(unit, rows);

const unit_row *unit_find(const char *name) {
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        if (strcmp(rows[i].name, name) == 0 || (rows[i].aliases != NULL && strcmp(rows[i].aliases, name) == 0))
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
