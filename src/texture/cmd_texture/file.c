/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The file of an image: which channel is read, what it says of itself, in which unit, or how it is packed. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/engine.h"
#include "report/message.h"
#include "report/number.h"
#include "texture/cmd_texture/request.h"
#include "texture/cmd_texture/texture.h"
#include "texture/units.h"

bool texture_is_window(const texture_request *o) {
    return o->image.metric == 0 && (o->image.packing == NULL || !o->image.packing->linear);
}

int texture_window_check(const texture_request *o) {
    static const char *const window[] = {"format", "mapping", "log-c", "product", "sky"};
    const bool raw = o->image.product != NULL && o->image.product->kind == FRAME_RAW;
    for (size_t i = 0; !texture_is_window(o) && i < sizeof window / sizeof window[0]; i++)
        if (option_given(o->line, window[i]) && (o->image.metric > 0 || !option_is(window[i], "sky")) &&
            (raw || !option_is(window[i], "product")))
            return option_error(window[i], "%sdoes not apply with --%s%s, which is not window depth",
                                option_is(window[i], "product") ? "raw " : "",
                                o->image.stereo.focal > 0 ? "stereo"
                                : o->image.metric > 0     ? "metric"
                                                          : "packing ",
                                o->image.metric > 0 ? "" : o->image.packing->name);
    return EXIT_FINE;
}

/* Warns of colours by which a program that obeys them changes the samples. */
static void warn_of_colours(const texture_request *o, const texture_source *s) {
    static const char *const names[] = {"an sRGB", "a gAMA", "an iCCP"};
    for (size_t i = 0; i < sizeof names / sizeof names[0] && !o->out.quiet; i++)
        if ((s->picture.colours >> i & 1U) != 0)
            message("depthprec: %s: has %s chunk: a program that applies it changes packed depths; ignored here",
                    s->path, names[i]);
    if (s->unpacked.premultiplied && !o->out.quiet)
        message("depthprec: %s: no channel is above alpha: if they were premultiplied, the depths are wrong", s->path);
}

/* Chooses the channel that is read, where several do not hold a depth together. */
static int choose_channel(const texture_request *o, texture_source *s) {
    image_error error;
    if (o->image.packing != NULL && o->image.channel == NULL)
        return EXIT_FINE;
    if (!image_choose(&s->picture, o->image.channel, &error))
        return usage_error("%s: %s", s->path, error.text);
    if (s->picture.others[0] != '\0' && o->image.channel == NULL && !o->out.quiet)
        message("depthprec: %s: channel %s is read, the others are %s; --channel NAME reads another", s->path,
                s->picture.channel, s->picture.others);
    return EXIT_FINE;
}

/* ---- What a file of ours says of itself -------------------------------------------------------------------------- */

/* Warns of lossy compression: nobody knows what it changed, so no error has it. */
static void warn_of_compression(const texture_request *o, const texture_source *s) {
    if (s->picture.lossy != NULL && !o->out.quiet)
        message("depthprec: %s: its compression, %s, may have changed the depths, which no error here counts; save it "
                "without loss",
                s->path, s->picture.lossy);
}

/* Whether the command line says what the samples are. */
static bool is_asked(const texture_request *o) {
    return option_given(o->line, "packing") || option_given(o->line, "metric") || option_given(o->line, "stereo") ||
           option_given(o->line, "format");
}

/* Whether a word of the note is an option that nothing on the command line stands against. */
static bool is_open(const texture_request *o, const char *id) {
    const bool of_samples = option_is(id, "packing") || option_is(id, "metric");
    const bool of_lattice = option_given(o->line, "packing") || option_given(o->line, "format");
    return !option_given(o->line, id) && !(of_samples                 ? is_asked(o)
                                           : option_is(id, "lattice") ? of_lattice
                                                                      : camera_says_planes(&o->camera.said));
}

/* Words of the form NAME=VALUE: a product, and options that are read as those of the command line are. */
static int take_note(texture_request *o, texture_source *s) {
    static const char *const known[] = {"packing", "metric", "lattice", "near", "far", "ortho", "mapping"};
    char *rest = NULL;
    const bool asked = is_asked(o);
    bool open[sizeof known / sizeof known[0]];
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        open[i] = is_open(o, known[i]);
    snprintf(s->note, sizeof s->note, "%s", s->picture.note);
    for (char *word = strtok_r(s->note, " ", &rest); word != NULL; word = strtok_r(NULL, " ", &rest)) {
        char *value = strchr(word, '=');
        if (value != NULL)
            *value++ = '\0';
        if (value != NULL && strcmp(word, "product") == 0 && strcmp(value, "depth") != 0 && !asked)
            return usage_error(
                "%s: holds %s, as depthprec wrote them, and no depth; --format NAME%s reads it all the same", s->path,
                value, s->picture.channels > 2 ? " with --channel R" : "");
        for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
            if (!open[i] || strcmp(word, known[i]) != 0 || (value == NULL) != (option_is(known[i], "ortho")))
                continue;
            const int status = option_set(o->line, known[i], value);
            if (status != EXIT_FINE)
                return status;
            option_give(o->line, known[i], "");
            s->noted = s->noted || option_is(known[i], "mapping");
            if (option_is(known[i], "metric"))
                s->metric_from = s->picture.file == IMAGE_ROS && s->type == IMAGE_U16 ? ORIGIN_ASSUMED : ORIGIN_FOUND;
        }
    }
    return EXIT_FINE;
}

/* ---- The image --------------------------------------------------------------------------------------------------- */

/* The depths of a packed texture; what else is known of them is the packing's. */
static int unpack(const texture_request *o, texture_source *s) {
    const packing *p = o->image.packing;
    const bool zero = option_given(o->line, "rounding") && o->camera.rounding == DP_ROUND_ZERO;
    dp_format formats[2];
    if (p->steps == 0 && (o->image.product == NULL || !o->image.product->packed))
        return option_error("packing", "%s holds normals and no depth: --product packed-normal writes them", p->name);
    if (!packing_convert(p, zero, &s->picture, &s->unpacked))
        return usage_error("%s: %s", s->path, s->unpacked.wrong);
    warn_of_colours(o, s);
    s->unpacked.zeros = packing_unwrap(p, &s->picture, o->image.sky != 0 ? 1.0f : NAN);
    if (p->steps == 0)
        s->found = (dp_recognised){.depth = true};
    else
        recognise(&s->picture, &s->found, s->why);
    dp_format_parse(p->format, formats);
    s->found.format = formats[0];
    s->found.certain = true;
    s->found.steps = 0;
    const char *towards = p->linear || p->steps == 0 ? NULL : recognise_towards(&s->found);
    const grain *g = &s->unpacked.grain;
    const bool steps = g->kind == GRAIN_STEPS;
    snprintf(s->why, sizeof s->why, "packing %s, %s, in %s%s%s%s%s", p->name,
             p->linear ? "eye depth over far" : "window depth", steps ? "steps of 1/" : "numbers of ",
             number_of(steps ? g->steps : g->bits, 10).text, steps ? "" : " bits", towards != NULL ? "; " : "",
             towards != NULL ? towards : "");
    return EXIT_FINE;
}

/* Whether anything says that the samples are window depth, or of which camera. */
static bool is_said(const texture_request *o) {
    static const char *const window[] = {"near",   "far",    "mapping",  "log-c", "ortho",
                                         "matrix", "preset", "platform", "sky",   "rounding"};
    bool said = is_asked(o) || o->image.metric > 0 || o->image.packing != NULL;
    for (size_t i = 0; i < sizeof window / sizeof window[0]; i++)
        said = said || option_given(o->line, window[i]);
    return said || o->image.pack != NULL || (o->image.product != NULL && o->image.product->kind == FRAME_RAW);
}

/* Metric depth where nothing is said and the samples can be nothing else. */
static int guess(texture_request *o, texture_source *s) {
    const char *why = NULL, *unit = is_said(o) ? NULL : units_guess(&s->picture, &why);
    int status = EXIT_FINE;
    if (unit != NULL) {
        status = option_set(o->line, "metric", unit);
        option_give(o->line, "metric", "");
        s->metric_from = ORIGIN_ASSUMED;
    }
    if (o->image.metric > 0 && s->metric_from == ORIGIN_ASSUMED && !o->out.quiet)
        fprintf(stderr, "depthprec: %s: --metric %s is assumed%s%s\n", s->path, unit != NULL ? unit : "mm",
                why != NULL ? ": " : "", why != NULL ? why : "");
    return status;
}

static int read_stereo(const texture_request *o, texture_source *s) {
    const char *wrong = stereo_convert(&s->picture, &o->image.stereo, &s->metric);
    return wrong == NULL ? EXIT_FINE : usage_error("%s: no disparity: %s", s->path, wrong);
}

/* Undoes a move of bits that the user named; says one that the samples show. */
static int move_bits(texture_request *o, texture_source *s) {
    const moved_row *said = o->image.metric > 0 ? o->image.moved : NULL;
    if (said != NULL && !moved_undo(said, &s->picture))
        return usage_error("%s: --metric %s needs samples of 16 bits that were moved so, got %s", s->path,
                           option_text(o->line, "metric"), image_type_name(s->type));
    if (said != NULL && said->lattice != NULL && o->image.lattice == NULL) {
        o->image.lattice = said->lattice;
        option_give(o->line, "lattice", "");
    }
    if (said != NULL || o->image.packing != NULL || o->image.stereo.focal > 0)
        return EXIT_FINE;
    s->moved = moved_find(&s->picture);
    const moved_row *row = s->moved.row;
    if (row == NULL || o->out.quiet || (o->image.metric == 0 && !s->moved.certain))
        return EXIT_FINE;
    message("depthprec: %s: its samples may be no depths: %s%s%s%s%s", s->path,
            s->moved.certain ? "" : "it may be that ", row->note, row->reading != NULL ? "; --metric " : "",
            row->reading != NULL ? row->reading : "", row->reading != NULL ? " reads them" : "");
    return EXIT_FINE;
}

static int read_metric(const texture_request *o, texture_source *s) {
    sensor given;
    int status = texture_lattice(o->camera.lengths.unit, "lattice", o->image.lattice, &given);
    if (status != EXIT_FINE)
        return status;
    if (given.row != NULL && option_text(o->line, "lattice")[0] == '\0')
        sensor_scale(&given, o->image.metric); /* a note's is of samples, whatever unit these have */
    const double zfar = option_given(o->line, "far") ? o->camera.zfar : (double)INFINITY;
    const char *wrong =
        metric_convert(&s->picture, o->image.metric, zfar, given.row != NULL ? &given : NULL, &s->metric);
    if (wrong != NULL)
        return usage_error("%s: no metric depth: %s", s->path, wrong);
    if (s->moved.row != NULL) /* levels of samples that may be no depths */
        s->metric.sensor.found = s->metric.seen.found = false;
    texture_lattice_warn(o, s);
    return EXIT_FINE;
}

/* Where the depths lie shows a direction in the range 0 to 1 alone. */
static void leave_direction(texture_source *s) {
    const char *towards = recognise_towards(&s->found);
    char *at = towards != NULL ? strstr(s->why, towards) : NULL;
    if (at != NULL && at > s->why + 1)
        at[-2] = '\0'; /* "; " before it */
    s->found.reversed = -1;
    s->found.direction = 0;
}

int texture_image_read(texture_request *o, texture_source *s) {
    image_error error;
    s->path = o->line->operands[0];
    image_asked asked = {.channel = o->image.channel};
    if (option_given(o->line, "size")) {
        asked.width = o->image.size[0];
        asked.height = o->image.size[1];
    }
    if (!image_read_as(s->path, &asked, &s->picture, &error)) {
        usage_error("%s: %s", s->path, error.text);
        return error.unreadable ? EXIT_IO : EXIT_USAGE;
    }
    if (asked.width > 0 && s->picture.file != IMAGE_RAW)
        return option_error("size", "is for --synthetic and raw files: %s has its own", s->path);
    if (s->picture.size_assumed && !o->out.quiet)
        message("depthprec: %s: %u x %u pixels are assumed, by its length; --size sets them", s->path, s->picture.width,
                s->picture.height);
    s->type = s->picture.type;
    s->channels = s->picture.channels;
    warn_of_compression(o, s);
    int status = take_note(o, s);
    if (status == EXIT_FINE)
        status = choose_channel(o, s);
    if (status == EXIT_FINE)
        status = move_bits(o, s);
    if (status == EXIT_FINE)
        status = guess(o, s);
    if (status == EXIT_FINE)
        status = texture_window_check(o);
    if (status == EXIT_FINE && s->picture.most > 0 && o->image.metric == 0 &&
        o->camera.formats[0].code_max != s->picture.most)
        return usage_error("%s: its samples are shares of %u: --metric UNIT reads them as lengths, --format NAME as "
                           "the codes of a format that ends there",
                           s->path, s->picture.most);
    if (status != EXIT_FINE || o->image.packing != NULL)
        return status != EXIT_FINE ? status : unpack(o, s);
    if (o->image.metric > 0)
        return o->image.stereo.focal > 0 ? read_stereo(o, s) : read_metric(o, s);
    recognise(&s->picture, &s->found, s->why);
    if (dp_range_moves(o->camera.depth_range))
        leave_direction(s);
    return EXIT_FINE;
}
