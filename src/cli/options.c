/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/options.h"

#include <getopt.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/help.h"
#include "cli/option_rows.h"
#include "cli/suggest.h"
#include "texture/frame.h"

const char *option_name(option_id id) {
    return option_rows[id].name;
}

/* One line whatever the arguments hold: control characters would break it, and a long argument would bury it. */
static int print_error(const char *option, const char *format, va_list arguments) {
    char line[1024];
    size_t start = (size_t)snprintf(line, sizeof line, "depthprec: %s%s%s", option ? "--" : "", option ? option : "",
                                    option ? ": " : "");
    vsnprintf(line + start, sizeof line - start, format, arguments);
    for (char *c = line; *c != '\0'; c++)
        if ((unsigned char)*c < 0x20 || *c == 0x7f)
            *c = '?';
    fprintf(stderr, "%s\n", line);
    return EXIT_USAGE;
}

int option_error(option_id id, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int status = print_error(option_name(id), format, arguments);
    va_end(arguments);
    return status;
}

int usage_error(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int status = print_error(NULL, format, arguments);
    va_end(arguments);
    return status;
}

static void set_defaults(options *o) {
    *o = (options){.znear = 0.1,
                   .zfar = 1000.0,
                   .tolerance = 0.05,
                   .log_c = 1.0,
                   .mapping_count = 2,
                   .camera = {.width = 640, .height = 360, .fov_y = 60, .half_height = 5},
                   .sky = FRAME_SKY};
    o->mappings[0] = DP_MAPPING_D3D;
    o->mappings[1] = DP_MAPPING_REVERSED;
    for (size_t i = 0; i < dp_format_count(); i++)
        o->formats[o->format_count++] = dp_format_get(i)->format;
}

void options_release(options *o) {
    free(o->at.list);
    o->at.list = NULL;
}

/* getopt's names for an option: its letter, or a number that no letter has. */
enum { LONG_ONLY = 256 };

static int getopt_value(int id) {
    return option_rows[id].letter != 0 ? option_rows[id].letter : LONG_ONLY + id;
}

static int id_of_value(int value) {
    for (int id = 0; id < OPTION_COUNT; id++)
        if (getopt_value(id) == value)
            return id;
    return OPTION_COUNT;
}

static void make_getopt_arrays(char *letters, struct option *longs) {
    *letters++ = ':'; /* a missing argument is told apart from an unknown option */
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        *longs++ =
            (struct option){row->name, row->argument != NULL ? required_argument : no_argument, NULL, getopt_value(id)};
        if (row->letter != 0) {
            *letters++ = row->letter;
            if (row->argument != NULL)
                *letters++ = ':';
        }
    }
    *letters = '\0';
    *longs = (struct option){NULL, 0, NULL, 0};
}

/* getopt has refused: say what and why, with the nearest option that the command takes. */
static int unknown_option(const options *o, int refused, const char *argument) {
    if (refused != 0 && id_of_value(refused) < OPTION_COUNT)
        return option_error((option_id)id_of_value(refused), "takes no argument, got '%s'", argument);
    if (refused != 0)
        return usage_error("unknown option '-%c'; 'depthprec help %s' lists what there is", refused, o->verb->name);
    size_t length = strcspn(argument, "=");
    const char *first = NULL;
    char given[SUGGEST_NAME_MAX + 1];
    snprintf(given, sizeof given, "%.*s", length > 2 ? (int)length - 2 : 0, argument + (length > 2 ? 2 : 0));
    suggestion s = suggest_start(given);
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        if (length > 2 && strncmp(row->name, given, strlen(given)) == 0 && strlen(given) == length - 2) {
            if (first != NULL)
                return usage_error("option '%.*s' could be --%s or --%s", (int)length, argument, first, row->name);
            first = row->name;
        }
        if ((row->commands & o->verb->bit) != 0)
            suggest_offer(&s, row->name);
    }
    char text[SUGGEST_TEXT_SIZE];
    if (*suggest_text(&s, "--", text) != '\0')
        return usage_error("unknown option '%.*s'%s", (int)length, argument, text);
    return usage_error("unknown option '%.*s'; 'depthprec help %s' lists what there is", (int)length, argument,
                       o->verb->name);
}

static int wrong_command(const options *o, option_id id) {
    char takers[128] = "";
    for (size_t i = 0; i < verb_count; i++)
        if ((option_rows[id].commands & verb_rows[i].bit) != 0) {
            strcat(takers, takers[0] != '\0' ? ", " : "");
            strcat(takers, verb_rows[i].name);
        }
    return option_error(id, "is not an option of %s, but of %s", o->verb->name, takers);
}

static int check_operands(const options *o) {
    const verb *v = o->verb;
    if (o->operand_count > v->operand_max) {
        const char *extra = o->operands[v->operand_max];
        return usage_error("unexpected argument '%s'%s", extra,
                           verb_find(extra) != NULL ? ": the command comes before its options" : "");
    }
    if (o->operand_count < v->operand_min)
        return usage_error("%s: needs %s%s%s", v->name, v->operand, v->operand_hint != NULL ? ": " : "",
                           v->operand_hint != NULL ? v->operand_hint : "");
    return -1;
}

/* A preset gives what the user did not. */
static void fill_from_preset(options *o) {
    const preset *p = o->preset;
    if (p == NULL)
        return;
    if (!option_given(o, OPTION_NEAR))
        o->znear = p->znear;
    if (!option_given(o, OPTION_FAR))
        o->zfar = p->zfar;
    if (!option_given(o, OPTION_FORMAT)) {
        dp_format formats[2];
        o->format_count = preset_formats(p, formats);
        memcpy(o->formats, formats, o->format_count * sizeof formats[0]);
    }
    if (!option_given(o, OPTION_MAPPING)) {
        o->mapping_count = 1;
        o->mappings[0] = p->mapping;
    }
}

/* argv[0] of what is left is the program, or the command in its place. */
static int read_options(options *o, int argc, char **argv, const verb *asked) {
    char letters[2 * OPTION_COUNT + 2];
    struct option longs[OPTION_COUNT + 1];
    make_getopt_arrays(letters, longs);
    opterr = 0;
    optind = 0; /* start anew, also when an earlier call stopped half-way */
    for (;;) {
        int value = getopt_long(argc, argv, letters, longs, NULL);
        if (value == -1)
            break;
        if (value == '?')
            return unknown_option(o, optopt, argv[optind > 1 ? optind - 1 : 1]);
        int id = id_of_value(value == ':' ? optopt : value);
        if (value == ':')
            return option_error((option_id)id, "needs an argument, %s", option_rows[id].argument);
        if (id == OPTION_HELP)
            return options_help(asked);
        if (id == OPTION_VERSION)
            return options_version();
        if ((option_rows[id].commands & o->verb->bit) == 0)
            return wrong_command(o, (option_id)id);
        int status = option_rows[id].parse(o, optarg);
        if (status != EXIT_FINE)
            return status;
        o->given |= (uint64_t)1 << id;
    }
    fill_from_preset(o);
    o->operands = argv + optind;
    o->operand_count = argc - optind;
    return check_operands(o);
}

int options_parse(options *o, int argc, char **argv) {
    set_defaults(o);
    o->argv = argv;
    o->verb = verb_find("table");
    if (argc < 1)
        return usage_error("no program name was given");
    if (argc < 2 || argv[1][0] == '-')
        return read_options(o, argc, argv, NULL);
    o->verb = verb_find(argv[1]);
    if (o->verb != NULL)
        return read_options(o, argc - 1, argv + 1, o->verb);
    suggestion s = suggest_start(argv[1]);
    char text[SUGGEST_TEXT_SIZE];
    for (size_t i = 0; i < verb_count; i++)
        suggest_offer(&s, verb_rows[i].name);
    suggest_text(&s, "", text);
    return usage_error("unknown command '%s'%s", argv[1], text[0] != '\0' ? text : "; 'depthprec --help' lists them");
}
