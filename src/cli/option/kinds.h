/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file kinds.h  How rows name their kind and the field of GROUP_TYPE, the struct that their table fills. A field of
 * another type than its kind reads does not compile. Whole numbers and flags have several widths.
 *
 *     #define GROUP_TYPE probe_asked
 *     static const option_row rows[] = {{"keep", 0, "FILE", "write a CSV", FILE_WRITTEN(keep)}, END};
 */
#ifndef CLI_OPTION_KINDS_H
#define CLI_OPTION_KINDS_H

#include "cli/option/option.h"

#define INTO(type, field) .place = offsetof(GROUP_TYPE, field) + 0 * sizeof(1 ? &((GROUP_TYPE *)0)->field : (type *)0)
#define SIZED(field)      .place = offsetof(GROUP_TYPE, field), .size = sizeof((GROUP_TYPE *)0)->field

#define FLAG(field)                  .parse = parse_flag, SIZED(field)
#define TEXT(field)                  .parse = parse_text, INTO(const char *, field)
#define SOME_TEXT(field)             .parse = parse_some, INTO(const char *, field)
#define FILE_READ(field)             .parse = parse_read, INTO(const char *, field)
#define FILE_WRITTEN(field)          .parse = parse_written, .written = true, INTO(const char *, field)
#define LIMITS(lo, hi, of)           .least = (lo), .most = (hi), .unit = (of)
#define POSITIVE(field)              .parse = parse_length, INTO(double, field)
#define LENGTH(field, ...)           POSITIVE(field), LIMITS(__VA_ARGS__)
#define NUMBER(field, ...)           .parse = parse_number, INTO(double, field), LIMITS(__VA_ARGS__)
#define SHARE(field)                 .parse = parse_share, INTO(double, field)
#define ORIGIN(field)                .parse = parse_origin, INTO(double, field[0])
#define SIZE(field)                  .parse = parse_size, INTO(uint32_t, field[0])
#define WHOLE(field, ...)            .parse = parse_whole, SIZED(field), LIMITS(__VA_ARGS__)
#define SEVERAL(kind, field, lo, hi) .parse = (kind), INTO(depths, field), LIMITS(lo, hi, NULL)
#define WORD(field, among)           .parse = parse_word, SIZED(field), .names = &(among)
#define ROW(field, among)            .parse = parse_row, SIZED(field), .names = &(among)

#endif
