/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "image/channel.h"

#include <string.h>
#include <strings.h>

size_t channel_last(const char *name) {
    const char *dot = strrchr(name, '.');
    return dot != NULL ? (size_t)(dot - name) + 1 : 0;
}

/* The layer of the one number of a pixel, "ViewLayer.Depth.V"; grey has all colours, of which red is read. */
static bool is_layer(const char *name, const char *wanted) {
    static const char *const numbers[] = {"V", "R", "Y", "X"};
    const size_t last = channel_last(name), size = strlen(wanted);
    const bool layer = last > size && strncasecmp(name + last - 1 - size, wanted, size) == 0 &&
                       (last == size + 1 || name[last - 2 - size] == '.');
    for (size_t i = 0; layer && i < sizeof numbers / sizeof numbers[0]; i++)
        if (strcasecmp(name + last, numbers[i]) == 0)
            return true;
    return false;
}

bool channel_is(const char *name, const char *wanted, channel_likeness how) {
    if (how == CHANNEL_LAYER)
        return is_layer(name, wanted);
    if (how == CHANNEL_LAST)
        return channel_last(name) > 0 && strcasecmp(name + channel_last(name), wanted) == 0;
    return (how == CHANNEL_SAME ? strcmp(name, wanted) : strcasecmp(name, wanted)) == 0;
}

bool channel_of_depth(const char *name) {
    static const char *const names[] = {"Z", "depth"};
    bool depth = false;
    for (size_t i = 0; i < 2; i++)
        depth = depth || channel_is(name, names[i], CHANNEL_CASE) || channel_is(name, names[i], CHANNEL_LAST) ||
                is_layer(name, names[i]);
    return depth;
}

bool channel_is_colour(const char *channel) {
    static const char *const colours[] = {"R", "G", "B", "Y", "RY", "BY"};
    for (size_t i = 0; i < sizeof colours / sizeof colours[0]; i++)
        if (strcasecmp(channel + channel_last(channel), colours[i]) == 0)
            return true;
    return false;
}
