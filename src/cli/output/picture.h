/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file picture.h  Pictures beside a report, as PNG. */
#ifndef CLI_OUTPUT_PICTURE_H
#define CLI_OUTPUT_PICTURE_H

#include <stdint.h>

/** Writes pixels 0xAARRGGBB, row by row from the top. Null pixels: there was no memory. @return an exit status */
int picture_write(const char *path, const uint32_t *pixel, int width, int height);

#endif
