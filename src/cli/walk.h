/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file walk.h  A report of depths, one after the other, in each set-up: what such commands share.
 *
 *     typedef struct table { walk walk; row row; } table;        // the walk stands first
 *     int status = walk_start(&t.walk, o);                       // set-ups and depths
 *     walk_write(&t.walk, &spec, status);                        // its lists ask walk_setup() and walk_depth()
 */
#ifndef CLI_WALK_H
#define CLI_WALK_H

#include "cli/progress.h"
#include "cli/setups.h"

typedef struct walk {
    const options *o;
    setups all;
    options here; /**< those of the set-up at hand, see options_of() */
    depths at;    /**< of the set-up at hand, before there is one of the first */
    output out;
    progress progress;
    uint64_t done;
    const dp_setup *setup; /**< the one at hand */
    setup_fields fields;
} walk;

/** Resolves set-ups and depths. @return an exit status, after one line on stderr */
int walk_start(walk *w, const options *o);

/**
 * Writes the report where `status` is EXIT_FINE, says on stderr what binary32 clipping loses, and frees what
 * walk_start() made in any case.
 * @return an exit status
 */
int walk_write(walk *w, const report_spec *spec, int status);

/** Goes to set-up i. @return false behind the last */
bool walk_setup(walk *w, size_t i);

/** Goes to depth i, each in turn. @return false behind the last, and where nothing more can be written */
bool walk_depth(walk *w, size_t i, double *z);

/** What text says above a set-up: for reports whose item begins with its walk. */
void walk_title(page *p, void *item);

#endif
