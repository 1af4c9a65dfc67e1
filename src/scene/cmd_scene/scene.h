/* SPDX-License-Identifier: GPL-3.0-or-later */
/** @file scene.h  State that the parts of the command `scene` share: what was asked, found and judged. */
#ifndef SCENE_CMD_SCENE_SCENE_H
#define SCENE_CMD_SCENE_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "camera/cmd/setups.h"
#include "camera/cmd/slant.h"
#include "model/model.h"
#include "report/report.h"
#include "scene/cmd_scene/request.h"
#include "scene/eye.h"
#include "scene/find.h"
#include "scene/judge.h"
#include "scene/sight.h"

/* A surface as a report names it; null where the file has no name. */
typedef struct scene_named {
    const char *node, *mesh, *material;
} scene_named;

typedef struct scene_place {
    double x, y, z;
} scene_place;

typedef struct scene_finding {
    const finder_finding *of;
    scene_named a, b;
    double gap_min, gap_max, area;
    scene_place place;
    scene_verdict verdict;
    uint64_t pairs;
    scene_sight sight;   /* from the worst of the eyes */
    double line;         /* of the file of eyes, else NaN */
    bool fights;         /* nearer than --within asks */
    double wrong_pixels; /* of --render, else NaN */
} scene_finding;

/* The picture that --render drew. */
typedef struct scene_rendered {
    const char *file, *raster;
    int width, height;
    double fov_y;
    scene_place eye, ahead;
    uint64_t wrong_pixels, wrong_found; /* those of findings */
} scene_rendered;

/* The bias for one of two surfaces; NaN where none is enough. */
typedef struct scene_bias {
    const char *api;
    double units, factor;
} scene_bias;

/* Another model's findings: how many may fight, and how many of them otherwise than was decided. */
typedef struct scene_simpler {
    const char *model;
    surfaces_text surfaces;
    uint64_t fights, differs;
    double seconds; /* with --full: it takes to compare all findings, the least of several turns; else NaN */
} scene_simpler;

/* The eyes from which a model is judged. */
typedef struct scene_eyes {
    scene_eye *eye; /* in the order of the file */
    size_t count;   /* 0: from every place */
    const char *camera, *path;
    uint64_t places;
    scene_place from, ahead; /* of one eye; NaN of several */
} scene_eyes;

typedef struct scene {
    scene_request o; /* with what stands for options that were not given */
    dp_setup setup;
    setup_fields fields;
    slant_fields slant;
    const slant_fields *triangles; /* null: surfaces face the camera */
    model model;
    scene_eyes eyes; /* known when the model has been read */
    finder_found found;
    scene_finding *findings;
    const char *file, *unit, *transforms;
    scene_bias bias;
    scene_simpler decided;                /* the model that decided, compared as the simpler ones are */
    scene_simpler models[DP_MODEL_COUNT]; /* the simpler ones, the simplest first */
    size_t model_count;
    scene_simpler
        slanted; /* where surfaces face the camera: those at any slant, in this view; more may be near enough */
    dp_triangles view;
    const scene_simpler *assumed; /* null where they do not, or nothing is guaranteed at a slant */
    scene_rendered rendered;
    const scene_rendered *picture; /* null without --render */
    double gap, angle, within, extent;
    uint64_t triangle_count, surface_count, finding_count, left_out[FINDER_FILTERS], degenerate;
    bool required, passed; /* nothing fights nearer than --within; asked only with it */
} scene;

/** Takes what was asked of the model in a file. @return EXIT_FINE, or EXIT_USAGE after one line on stderr */
int scene_begin(scene *s, const scene_request *given, const char *file);

/** Reads, searches and judges it; `out` is for an interrupt to abandon. @return EXIT_FINE, or another after one line */
int scene_look(scene *s, output *out);

/** Frees what was read and found. */
void scene_end(scene *s);

/** How many of the findings can fight up to `within`, from an eye where it sees them; they come first. */
size_t scene_fighting(const scene *s);

/** Whether --eye, --look, --path and --camera go together. @return EXIT_FINE, or EXIT_USAGE after one line */
int scene_eyes_check(const scene_request *o);

/**
 * Takes the eyes that they ask for, and of a camera of the model its planes and field of view where they were not
 * given; to be freed. @return EXIT_FINE, or another after one line
 */
int scene_eyes_take(scene *s);

/** Judges the findings from them. @return EXIT_FINE, also where it was interrupted, or EXIT_USAGE after one line */
int scene_eyes_judge(scene *s);

/** Unasked, a model is judged up to so many times its extent: there it is a tenth of the picture's height. */
#define SCENE_FAR_AWAY 10.0

/** Finds the bias of --api that brings one of two coplanar surfaces before the other up to `within`. */
void scene_bias_take(scene *s);

/** Finds what simpler models would have decided. */
void scene_models_take(scene *s);

/** The two surfaces, "'wall' (brick) and 'sign' (tin)". @return out */
char *scene_surfaces(const scene_finding *f, char *out, size_t size);

/** How far they are certain, how far apart, where, and what mends it, as text has it, in one line. @return out */
char *scene_message(const scene *s, const scene_finding *f, char *out, size_t size);

/** Writes the findings as JUnit XML: those fail that fight nearer than --within. */
void scene_junit(const scene *s, output *out);

/** Writes the file of --emit-need. @return EXIT_FINE, or EXIT_IO after one line */
int scene_need(scene *s);

/** Text says these before the findings that data have, and then of them; the item is the scene. */
void scene_say_head(page *p, void *of);
void scene_say_notes(page *p, void *of);

/** The report: head and notes of the text, columns of JSON and CSV. */
report_spec scene_report(scene *s);

/** Whether --render can be done; where it was not given, too. @return EXIT_FINE, or EXIT_USAGE after one line */
int scene_render_check(scene *s);

/** Draws the model into the file of --render, and counts. @return EXIT_FINE, also where it was interrupted */
int scene_render(scene *s);

#endif
