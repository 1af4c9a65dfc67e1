/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The findings of `scene` as JSON and CSV have them. */
#include "scene/cmd_scene/request.h"
#include "scene/cmd_scene/scene.h"

enum { LABEL = 4 };

static void *next_finding(void *of, size_t i) {
    scene *s = of;
    return i < s->found.findings ? &s->findings[i] : NULL;
}

static const column named_columns[] = {{FIELD(scene_named, node, "node", "")},
                                       {FIELD(scene_named, mesh, "mesh", "")},
                                       {FIELD(scene_named, material, "material", "")},
                                       {.kind = COLUMN_END}};

static const column place_columns[] = {{FIELD(scene_place, x, "x", "scene")},
                                       {FIELD(scene_place, y, "y", "scene")},
                                       {FIELD(scene_place, z, "z", "scene")},
                                       {.kind = COLUMN_END}};

static const column bias_columns[] = {{FIELD(scene_bias, api, "api", "")},
                                      {FIELD(scene_bias, units, "units", "")},
                                      {FIELD(scene_bias, factor, "factor", "")},
                                      {.kind = COLUMN_END}};

/* Conditions. */
enum { FROM_EYES = 1, REQUIRED = 2, FACING = 4, TIMED = 8 };

static const column model_columns[] = {{FIELD(scene_simpler, model, "model", "")},
                                       {FIELD(scene_simpler, surfaces.text, "surfaces", "")},
                                       {FIELD(scene_simpler, fights, "fights", "")},
                                       {FIELD(scene_simpler, differs, "differs", "")},
                                       {FIELD(scene_simpler, seconds, "seconds", "s"), .when = TIMED},
                                       {.kind = COLUMN_END}};

static const column decided_columns[] = {{FIELD(scene_simpler, model, "model", "")},
                                         {FIELD(scene_simpler, surfaces.text, "surfaces", "")},
                                         {FIELD(scene_simpler, seconds, "seconds", "s")},
                                         {.kind = COLUMN_END}};

static void *next_model(void *of, size_t i) {
    scene *s = of;
    return i < s->model_count ? &s->models[i] : NULL;
}

static const column eyes_columns[] = {
    {FIELD(scene_eyes, camera, "camera", "")},         {FIELD(scene_eyes, path, "path", "")},
    {FIELD(scene_eyes, places, "places", "")},         {PART(scene_eyes, from, "from", place_columns)},
    {PART(scene_eyes, ahead, "ahead", place_columns)}, {.kind = COLUMN_END}};

static const column finding_columns[] = {
    {PART(scene_finding, a, "a", named_columns), .only = AS_JSON},
    {PART(scene_finding, b, "b", named_columns), .only = AS_JSON},
    {FIELD(scene_finding, a.node, "a_node", ""), .only = AS_CSV},
    {FIELD(scene_finding, a.mesh, "a_mesh", ""), .only = AS_CSV},
    {FIELD(scene_finding, a.material, "a_material", ""), .only = AS_CSV},
    {FIELD(scene_finding, b.node, "b_node", ""), .only = AS_CSV},
    {FIELD(scene_finding, b.mesh, "b_mesh", ""), .only = AS_CSV},
    {FIELD(scene_finding, b.material, "b_material", ""), .only = AS_CSV},
    {FIELD(scene_finding, gap_min, "gap_min", "scene")},
    {FIELD(scene_finding, gap_max, "gap_max", "scene")},
    {FIELD(scene_finding, area, "area", "scene^2")},
    {PART(scene_finding, place, "place", place_columns)},
    {FIELD(scene_finding, pairs, "pairs", "")},
    {FIELD(scene_finding, verdict.certain_to, "certain_to", "scene")},
    {FIELD(scene_finding, verdict.ties_from, "ties_from", "scene")},
    {FIELD(scene_finding, verdict.lift, "lift", "scene")},
    {FIELD(scene_finding, fights, "fights", "")},
    {FIELD(scene_finding, sight.seen_from, "seen_from", "scene"), .when = FROM_EYES},
    {FIELD(scene_finding, sight.seen_to, "seen_to", "scene"), .when = FROM_EYES},
    {FIELD(scene_finding, sight.fights_from, "fights_from", "scene"), .when = FROM_EYES},
    {FIELD(scene_finding, sight.covered, "covered", ""), .when = FROM_EYES},
    {FIELD(scene_finding, line, "line", ""), .when = FROM_EYES},
    {FIELD(scene_finding, wrong_pixels, "wrong_pixels", ""), .optional = true},
    {.kind = COLUMN_END}};

static const column left_columns[] = {
    {FIELD(scene, left_out[FINDER_FACING], "facing", "")}, {FIELD(scene, left_out[FINDER_BLENDED], "blended", "")},
    {FIELD(scene, left_out[FINDER_THIN], "thin", "")},     {FIELD(scene, left_out[FINDER_HIDDEN], "hidden", "")},
    {FIELD(scene, degenerate, "degenerate", "")},          {.kind = COLUMN_END}};

static const column render_columns[] = {{FIELD(scene_rendered, file, "file", "")},
                                        {FIELD(scene_rendered, raster, "raster", "")},
                                        {FIELD(scene_rendered, width, "width", "pixels")},
                                        {FIELD(scene_rendered, height, "height", "pixels")},
                                        {FIELD(scene_rendered, fov_y, "fov", "degrees")},
                                        {PART(scene_rendered, eye, "eye", place_columns)},
                                        {PART(scene_rendered, ahead, "ahead", place_columns)},
                                        {FIELD(scene_rendered, wrong_pixels, "wrong_pixels", "")},
                                        {FIELD(scene_rendered, wrong_found, "wrong_found", "")},
                                        {.kind = COLUMN_END}};

static const column columns[] = {
    {FIELD(scene, file, "file", ""), .only = AS_JSON},
    {PART(scene, fields, "setup", setup_columns), .only = AS_JSON},
    {PART(scene, triangles, "triangles", slant_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {FIELD(scene, triangle_count, "model_triangles", ""), .only = AS_JSON},
    {FIELD(scene, surface_count, "model_surfaces", ""), .only = AS_JSON},
    {FIELD(scene, extent, "extent", "scene"), .only = AS_JSON},
    {FIELD(scene, transforms, "transforms", ""), .only = AS_JSON},
    {FIELD(scene, gap, "gap", "scene"), .only = AS_JSON},
    {FIELD(scene, angle, "angle", "degrees"), .only = AS_JSON},
    {FIELD(scene, within, "within", "scene"), .only = AS_JSON},
    {PART(scene, eyes, "eyes", eyes_columns), .only = AS_JSON, .when = FROM_EYES},
    {FIELD(scene, passed, "passed", ""), .only = AS_JSON, .when = REQUIRED},
    {FIELD(scene, found.cut, "cut", ""), .only = AS_JSON},
    {PART(scene, bias, "bias", bias_columns), .only = AS_JSON},
    {GROUP("left_out", left_columns), .only = AS_JSON},
    {PART(scene, decided, "decided", decided_columns), .only = AS_JSON, .when = TIMED},
    {LIST("models", model_columns, next_model), .only = AS_JSON},
    {PART(scene, assumed, "any_slant", model_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {PART(scene, view, "assumed", slant_view_columns), .only = AS_JSON, .when = FACING},
    {PART(scene, picture, "render", render_columns), .only = AS_JSON, .pointed = true, .optional = true},
    {LIST("findings", finding_columns, next_finding), .only = AS_JSON | AS_CSV},
    {.kind = COLUMN_END}};

static void count(scene *s) {
    s->triangle_count = s->model.triangles;
    s->surface_count = s->model.surfaces;
    s->picture = s->o.scene.render != NULL ? &s->rendered : NULL;
    s->degenerate = s->found.degenerate;
    for (int k = 0; k < FINDER_FILTERS; k++)
        s->left_out[k] = s->found.left_out[k];
}

report_spec scene_report(scene *s) {
    count(s);
    const unsigned when = (s->eyes.count > 0 ? FROM_EYES : 0U) | (s->required ? REQUIRED : 0U) |
                          (s->assumed != NULL ? FACING : 0U) | (s->o.out.full ? TIMED : 0U);
    return (report_spec){
        "scene", columns, s, when, .label = LABEL, .head = scene_say_head, .notes = scene_say_notes, .verdict = true};
}
