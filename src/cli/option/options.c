/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/option/options.h"

#include <ctype.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "cli/option/uses.h"
#include "core/append.h"
#include "report/number.h"
#include "system/input.h"

const char *option_written(const options *o, option_id id) {
    const option_row *row = &option_rows[id];
    if (row->parse == parse_error_map)
        return o->image.error_file;
    return row->parse == parse_written ? *(const char *const *)((const char *)o + row->place) : NULL;
}

/* What the rows say; what a command has of its own follows when its options are read. */
static void set_defaults(options *o) {
    option_forget_choosers();
    *o = (options){.wanted.target = SOLVE_FOR_ANY,
                   .camera.triangles = dp_triangles_default(),
                   .camera.azimuth = (double)NAN,
                   .shadow.curvature = (double)NAN,
                   .view.spec.half_height = 5.0,
                   .parts = ~0U};
    for (int id = 0; id < OPTION_COUNT; id++)
        if (option_rows[id].standard != NULL)
            option_rows[id].parse(o, &option_rows[id], option_rows[id].standard);
}

static int parse_use(options *o, const option_use *use, const char *argument) {
    const option_row *row = &option_rows[use->id];
    return (use->own->parse != NULL ? use->own->parse : row->parse)(o, row, argument);
}

static void set_own_defaults(options *o) {
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_use *use = option_used(o->command, o->parts, (option_id)id);
        if (use != NULL && use->own->standard != NULL && !option_given(o, (option_id)id))
            parse_use(o, use, use->own->standard);
    }
}

void options_release(options *o) {
    free(o->each);
    o->each = NULL;
    free(o->camera.at.list);
    free(o->wanted.looked_up.list);
    free(o->image.pixels.list);
    free(o->world.distances.list);
    o->camera.at.list = o->wanted.looked_up.list = o->image.pixels.list = o->world.distances.list = NULL;
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

static bool takes_argument(const option_row *row) {
    return row->argument != NULL || row->names != NULL;
}

static void make_getopt_arrays(const char *mode, char *letters, struct option *longs) {
    while (*mode != '\0')
        *letters++ = *mode++;
    *letters++ = ':'; /* a missing argument is told apart from an unknown option */
    for (int id = 0; id < OPTION_COUNT; id++) {
        const option_row *row = &option_rows[id];
        const int has = takes_argument(row) ? required_argument : optional_argument; /* where it may: read_option() */
        *longs++ = (struct option){row->name, has, NULL, getopt_value(id)};
        if (row->letter != 0) {
            *letters++ = row->letter;
            if (takes_argument(row))
                *letters++ = ':';
        }
    }
    *letters = '\0';
    *longs = (struct option){NULL, 0, NULL, 0};
}

/* getopt has refused: say what and why, with the nearest option that the command takes. */
static int unknown_option(const options *o, int refused, const char *argument) {
    if (refused != 0)
        return usage_error("unknown option '-%c'; 'depthprec help %s' lists its options", refused, o->command->name);
    const int length = (int)strcspn(argument, "=");
    const char *taken[OPTION_COUNT + 1], *begun[OPTION_COUNT + 1];
    size_t taken_count = 0, begun_count = 0;
    for (int id = 0; id < OPTION_COUNT; id++) {
        const char *name = option_rows[id].name;
        if (length > 2 && strncmp(name, argument + 2, (size_t)length - 2) == 0)
            begun[begun_count++] = name;
        if (option_used(o->command, ~0U, (option_id)id) != NULL)
            taken[taken_count++] = name;
    }
    begun[begun_count] = taken[taken_count] = NULL;
    char text[NAMES_SIZE], given[64] = "";
    const name_list all = {.words = begun_count > 1 ? begun : taken};
    if (begun_count > 1)
        return usage_error("option '%.*s' could be --%s", length, argument, names_join(&all, ", --", " or --", text));
    append(given, sizeof given, "%.*s", length > 2 ? length - 2 : 0, argument + (length > 2 ? 2 : 0));
    dp_mapping mapping;
    if (dp_mapping_parse(given, &mapping) == DP_OK)
        return usage_error("unknown option '%.*s'; did you mean '--mapping %s'?", length, argument, given);
    if (*names_nearest(&all, "--", given, text) != '\0')
        return usage_error("unknown option '%.*s'%s", length, argument, text);
    return usage_error("unknown option '%.*s'; 'depthprec help %s' lists its options", length, argument,
                       o->command->name);
}

static int wrong_command(const options *o, option_id id) {
    const option_row *row = &option_rows[id];
    char takers[OPTION_TEXT_SIZE];
    return option_error(id, "is not an option of %s, but of %s%s", o->command->name, command_takers((int)id, takers),
                        row->instead != NULL ? row->instead : "");
}

int check_operand(const command_row *v, const char *what, const name_list *n, const char *given, list_item *found) {
    char text[NAMES_SIZE];
    if (names_find(n, given, NULL, found))
        return EXIT_FINE;
    return usage_error("%s: %.*s %s", v->name, (int)strcspn(what, " "), what, names_refuse(n, given, text));
}

/* What a word may be meant to be that has no place here: a command; of two lengths near and far. @return out */
static const char *nearest_word(char **words, int count, char out[NAMES_SIZE]) {
    if (count < 2 || !isdigit((unsigned char)*words[0]) ||
        !(isdigit((unsigned char)*words[1]) || strcmp(words[1], "inf") == 0))
        return names_nearest(&(name_list){.get = list_command}, "", words[0], out);
    out[0] = '\0';
    append(out, NAMES_SIZE, "; did you mean '-n %s -f %s'?", words[0], words[1]);
    return out;
}

static int check_operands(options *o) {
    const command_row *v = o->command;
    list_item item = {0};
    char text[NAMES_SIZE] = "";
    if (o->operand_count > v->operand_max)
        return usage_error("unexpected argument '%s'%s", o->operands[v->operand_max],
                           nearest_word(o->operands + v->operand_max, o->operand_count - v->operand_max, text));
    if (o->operand_count < v->operand_min)
        return usage_error("%s: needs %s%s%s", v->name, v->operand, v->names != NULL ? ": " : "",
                           v->names != NULL ? names_join(v->names, ", ", " or ", text) : "");
    const bool open = v->id == CMD_LIST || v->id == CMD_HELP; /* whose words are anything's */
    int status = EXIT_FINE;
    if (open && o->operand_count > 0)
        names_find(v->names, o->operands[0], NULL, &item);
    else if (v->names != NULL && o->operand_count > 0)
        status = check_operand(v, v->operand, v->names, o->operands[0], &item);
    o->operand_row = item.row;
    return status;
}

/* What lengths mean must be known before they are read. */
static bool is_early(int id) {
    return id == OPTION_UNIT || id == OPTION_PRESET;
}

static int read_option(options *o, option_id id, const char *argument) {
    const option_row *row = &option_rows[id];
    const option_use *use = option_used(o->command, ~0U, id);
    if (use == NULL)
        return wrong_command(o, id);
    if (argument != NULL && !takes_argument(row) && option_use_optional(use) == NULL)
        return option_error(id, "takes no argument, got '%s'", argument);
    if (o->given[id] != NULL && (takes_argument(row) || argument != NULL) && !row->repeats)
        return option_error(id, "must not be given twice, got '%s' too", argument);
    o->given[id] = argument != NULL ? argument : "";
    return parse_use(o, use, argument);
}

static int needs_argument(const options *o, option_id id) {
    const option_use *use = option_used(o->command, ~0U, id);
    char text[OPTION_TEXT_SIZE];
    return option_error(id, "needs an argument, %s",
                        use != NULL ? option_use_argument(use, text) : option_argument(&option_rows[id], text));
}

static int ask_for_help(options *o, option_id id, const command_row *asked) {
    o->given[id] = "";
    o->operand_row = asked;
    o->version = id == OPTION_VERSION;
    o->command = command_find("help");
    return EXIT_FINE;
}

/*
 * Those that are early, or the others; what is wrong with the line is told with the others. argv[0] is the program, or
 * the command in its place.
 */
static int read_words(options *o, int argc, char **argv, const command_row *asked, bool early) {
    char letters[2 * OPTION_COUNT + 2];
    struct option longs[OPTION_COUNT + 1];
    make_getopt_arrays("", letters, longs);
    optind = 0; /* start anew, also when an earlier call stopped half-way */
    for (int value; (value = getopt_long(argc, argv, letters, longs, NULL)) != -1;) {
        const int id = id_of_value(value == ':' ? optopt : value);
        /* An argument that is missing behind a word: musl's getopt returns the option itself, without one. */
        const bool lacks = value == ':' || (value != '?' && takes_argument(&option_rows[id]) && optarg == NULL);
        const bool ends = value == '?' || lacks || id == OPTION_HELP || id == OPTION_VERSION;
        if (early && ends)
            return EXIT_FINE;
        if (value == '?')
            return unknown_option(o, optopt, argv[optind > 1 ? optind - 1 : 1]);
        if (lacks)
            return needs_argument(o, (option_id)id);
        if (ends)
            return ask_for_help(o, (option_id)id, asked);
        const int status = is_early(id) == early ? read_option(o, (option_id)id, optarg) : EXIT_FINE;
        if (status != EXIT_FINE)
            return status;
    }
    o->operands = argv + optind;
    o->operand_count = argc - optind;
    return EXIT_FINE;
}

/* getopt puts words into another order, and C libraries differ in when: of a line that ends half-way, too. So the pass
 * for the early ones has words of its own. */
static int read_options(options *o, int argc, char **argv, const command_row *asked, bool early) {
    char **words = early ? malloc(((size_t)argc + 1) * sizeof *words) : argv;
    if (words == NULL)
        return usage_error("no memory for %d words", argc);
    if (early)
        memcpy(words, argv, ((size_t)argc + 1) * sizeof *words);
    const int status = read_words(o, argc, words, asked, early);
    if (early)
        free(words);
    return status;
}

/* Puts the command before all options where the first word that belongs to no option is one. */
static void put_command_first(int argc, char **argv) {
    char letters[2 * OPTION_COUNT + 3];
    struct option longs[OPTION_COUNT + 1];
    int value;
    make_getopt_arrays("-", letters, longs); /* words come in order, as arguments of an option 1 */
    opterr = 0;
    optind = 0;
    do
        value = getopt_long(argc, argv, letters, longs, NULL);
    while (value != -1 && value != '?' && value != ':' && value != 1);
    if (value != 1 || command_find(argv[optind - 1]) == NULL)
        return;
    char *const word = argv[optind - 1];
    memmove(argv + 2, argv + 1, (size_t)(optind - 2) * sizeof *argv);
    argv[1] = word;
}

int options_parse(options *o, int argc, char **argv) {
    input_forget();
    set_defaults(o);
    o->argv = argv;
    o->command = command_find("table");
    if (argc < 1)
        return usage_error("no program name was given");
    put_command_first(argc, argv);
    const bool named = argc > 1 && argv[1][0] != '-';
    char text[NAMES_SIZE];
    if (named)
        o->command = command_find(argv[1]);
    if (o->command == NULL) {
        nearest_word(argv + 1, argc - 1, text);
        return usage_error("unknown command '%s'%s", argv[1],
                           *text != '\0' ? text : "; 'depthprec --help' lists the commands");
    }
    const command_row *const asked = named ? o->command : NULL;
    int status = read_options(o, argc - named, argv + named, asked, true);
    for (size_t i = 0; i < o->camera.preset_count && o->camera.unit == NULL; i++)
        o->camera.unit = unit_find(o->camera.presets[i]->unit);
    if (status == EXIT_FINE)
        status = read_options(o, argc - named, argv + named, asked, false);
    if (status != EXIT_FINE || option_given(o, OPTION_HELP) || option_given(o, OPTION_VERSION))
        return status;
    status = check_operands(o);
    if (status != EXIT_FINE)
        return status;
    o->parts = option_parts(o);
    set_own_defaults(o);
    status = option_check_parts(o, o->command);
    return status == EXIT_FINE ? options_complete(o) : status;
}

/* The ending of a file that holds a picture or a model, which no text is written into; null of others. */
static const char *ending_of_picture(const char *path) {
    static const char *const endings[] = {".svg", ".pdf", ".png", ".pfm", ".npy", ".exr", ".glb"};
    const size_t length = strlen(path);
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (length > 4 && strcasecmp(path + length - 4, endings[i]) == 0)
            return endings[i];
    return NULL;
}

int options_open(const options *o, output *out) {
    const char *ending = o->out.file != NULL ? ending_of_picture(o->out.file) : NULL;
    if (ending != NULL)
        return option_error(OPTION_OUTPUT, "must not end in %s where no picture is written, got '%s'", ending,
                            o->out.file);
    const int status = output_open(out, o->out.file);
    out->width = o->out.full ? OUTPUT_UNLIMITED : 0;
    out->colour = (output_colour)o->out.colour;
    out->measured = o->camera.gpu.measured[0] != '\0' ? o->camera.gpu.measured : NULL;
    return status;
}
