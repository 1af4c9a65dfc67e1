/* SPDX-License-Identifier: GPL-3.0-or-later */
/* texture: a depth image, or a synthetic scene in its place. */
#include <stdlib.h>

#include "cli/texture_report.h"
#include "cli/texture_source.h"

int cmd_texture(const options *o);

int cmd_texture(const options *o) {
    texture_source *source = calloc(1, sizeof *source);
    if (source == NULL)
        return usage_error("texture: no memory");
    int status = texture_source_open(o, source);
    if (status == EXIT_FINE)
        status = texture_report_write(o, source);
    texture_source_close(source);
    free(source);
    return status;
}
