/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file output.h  Where a command writes, in which form, and how much it says. */
#ifndef CLI_OUTPUT_OUTPUT_H
#define CLI_OUTPUT_OUTPUT_H

#include "camera/cmd/camera.h"
#include "cli/option/option.h"
#include "report/output.h"

/** Values of --report. */
typedef enum report_form { REPORT_TEXT = 0, REPORT_JSON, REPORT_JUNIT } report_form;

typedef struct output_asked {
    const char *link; /**< where the page is that the link opens; null when none is asked for */
    report_form report;
    output_form form;
    const char *file; /**< the argument of -o; null when not given. "-" is stdout: see output_start() */
    bool quiet, full;
    unsigned colour; /**< --color: an output_colour */
    int threads;     /**< 0 when not given: as many as there are cores */
} output_asked;

extern const option_table output_options;

/** The options that a report takes. */
extern const option_use output_written[];

/** For what takes long before output_start(): whether that would open its file, which stays as it is. @return as it */
int output_ready(const output_asked *o);

/** Opens what --output names, which is no picture's, for text, JSON or CSV, as wide as --full makes it, as --color
 * wants it dressed; the camera, which may be null, says whose measurements they are. @return EXIT_FINE, or EXIT_USAGE
 * or EXIT_IO after one line on stderr */
int output_start(const output_asked *o, const camera_asked *camera, output *out);

/** The beginning of a request about a camera. */
#define CAMERA_REQUEST                                                                                                 \
    asked_line *line;                                                                                                  \
    camera_asked camera;                                                                                               \
    output_asked out

/** The places of its tables. */
#define CAMERA_PLACES(request)                                                                                         \
    PLACE(request, camera, camera_options), PLACE(request, camera, range_options),                                     \
        PLACE(request, camera, view_options), PLACE(request, out, output_options)

/** camera_complete() of such a request that says no more of its camera. */
int camera_request_complete(void *request);

#endif
