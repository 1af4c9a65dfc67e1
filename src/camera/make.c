/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "camera/make.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "camera/depth_range.h"
#include "core/append.h"
#include "core/engine.h"

const char *const camera_keys[CAMERA_KEYS + 1] = {
    "preset", "matrix",      "near",     "far", "mapping", "format", "ortho",    "rounding", "model",    "arith",
    "log_c",  "depth_range", "viewport", "fov", "hfov",    "raster", "subpixel", "slant",    "triangle", NULL};

static bool said(const camera_said *c, camera_key key) {
    return c->words[key] != NULL;
}

/* The camera of its preset. */
static bool make_preset(const camera_said *c, preset_camera *out, camera_fault *fault) {
    char error[PRESET_ERROR_SIZE];
    return preset_make(c->presets[0], &c->values[0], out, error) || camera_fails(fault, "preset", "%s", error);
}

bool camera_canvas(camera_said *c, camera_fault *fault) {
    for (size_t i = 0; i < c->preset_count && said(c, CAMERA_VIEWPORT) && c->triangles.width > 0; i++) {
        const int height = preset_parameter_of(c->presets[i], "height");
        double *given = height >= 0 ? &c->values[i].given[height] : NULL;
        if (given != NULL && !isnan(*given) && *given != c->triangles.height)
            return camera_fails(fault, "preset", "has height=%.15g, and @viewport %d: leave one of them out", *given,
                                c->triangles.height);
        if (given != NULL)
            *given = c->triangles.height;
    }
    return true;
}

bool camera_angle(const camera_said *c, double given, int width, int height, double *fov_y, camera_fault *fault) {
    *fov_y = given;
    if (c->matrix.count > 0)
        return camera_matrix_angle(&c->matrix, width, height, fov_y, fault);
    if (said(c, CAMERA_HFOV))
        return camera_vertical(c->fov_x, width, height, fov_y, fault);
    if (said(c, CAMERA_FOV) || c->preset_count != 1)
        return true;
    preset_camera camera;
    if (!make_preset(c, &camera, fault))
        return false;
    *fov_y = preset_fov_y(c->presets[0], camera.fov, width, height);
    return true;
}

bool camera_viewed(camera_said *c, camera_fault *fault) {
    static const camera_key beside[] = {CAMERA_FOV,      CAMERA_HFOV,  CAMERA_RASTER,
                                        CAMERA_SUBPIXEL, CAMERA_SLANT, CAMERA_TRIANGLE};
    enum { OF_PICTURES = 3 }; /* the first of them that a picture does not take, too */
    dp_triangles *t = &c->triangles;
    const bool slanted = t->width > 0;
    const bool measured = c->use.measured && c->gpu.measured[0] != '\0'; /* of r, at any slant */
    for (size_t i = c->use.pictured ? OF_PICTURES : 0;
         i < sizeof beside / sizeof beside[0] && !slanted && !c->use.angled; i++)
        if (said(c, beside[i]) && !(beside[i] == CAMERA_RASTER && measured))
            return camera_fails(fault, camera_keys[beside[i]], "needs @viewport: surfaces face the camera");
    if (c->matrix.count == MATRIX_TANGENTS && !slanted && !c->use.angled)
        return camera_fails(fault, "matrix", "of four tangents needs @viewport: surfaces face the camera");
    if (!slanted)
        return true;
    if (c->ortho)
        return camera_fails(fault, c->use.drawn ? "rasterize" : "viewport",
                            "conflicts with @ortho, which no slant is bounded in");
    if (said(c, CAMERA_FOV) && said(c, CAMERA_HFOV))
        return camera_fails(fault, "hfov", "conflicts with @fov");
    if (c->matrix.count > 0 && !c->use.drawn)
        return camera_matrix_cover(&c->matrix, t, fault);
    return camera_angle(c, t->fov_y, t->width, t->height, &t->fov_y, fault);
}

bool camera_grid(camera_said *c, camera_fault *fault) {
    const raster_row *raster = c->raster;
    const int asked = said(c, CAMERA_SUBPIXEL) ? c->triangles.subpixel : 0;
    if (raster == NULL)
        return true;
    if (asked > 0 && !raster->at_least)
        return camera_fails(fault, "subpixel", "does not apply: %s has its own grid", raster->name);
    if (asked > 0 && asked < raster->plane_bits)
        return camera_fails(fault, "subpixel", "must be at least %d with the rasterizer %s, got %d", raster->plane_bits,
                            raster->name, asked);
    raster_describe(raster, &c->triangles);
    if (asked > 0)
        c->triangles.subpixel = asked;
    return true;
}

/* With a viewport: the rasterizer of that name, where none was said. */
static void bring_raster(camera_said *c, const char *name) {
    if (c->triangles.width == 0 || c->use.drawn || said(c, CAMERA_RASTER) || said(c, CAMERA_SUBPIXEL))
        return;
    c->raster = raster_find(name);
    raster_describe(c->raster, &c->triangles);
}

/* three.js has one word for the logarithms of two renderers. */
static void take_logarithm(camera_said *c, const preset *p) {
    static const char word[] = "logarithmicDepthBuffer";
    const char *given = said(c, CAMERA_MAPPING) && strcmp(p->api, "webgpu") == 0 ? c->words[CAMERA_MAPPING] : "";
    while (*given != '\0' && strncasecmp(given, word, sizeof word - 1) != 0)
        given++;
    for (size_t i = 0; i < c->mapping_count && *given != '\0'; i++)
        if (c->mappings[i] == DP_MAPPING_THREE_WEBGL)
            c->mappings[i] = DP_MAPPING_THREE_WEBGPU;
}

static void bring_mapping(camera_said *c, dp_mapping mapping) {
    c->mappings[0] = mapping;
    c->mapping_count = 1;
}

bool camera_take_matrix(camera_said *c, dp_mapping like, bool oblique, camera_fault *fault) {
    const bool given = said(c, CAMERA_MAPPING);
    const dp_mapping_row *row = dp_mapping_get(c->mappings[0]);
    if (given && (c->mapping_count != 1 || row->curve != DP_CURVE_PERSPECTIVE))
        return camera_fails(fault, "mapping", "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with @matrix, got %s",
                            c->mapping_count > 1 ? "several" : row->name);
    if (!camera_matrix_take(&c->matrix, given ? c->mappings[0] : DP_MAPPING_COUNT, like, oblique, fault))
        return false;
    const dp_projection *p = &c->matrix.taken;
    c->znear = p->znear;
    c->zfar = p->zfar;
    c->ortho = p->ortho != 0;
    bring_mapping(c, p->mapping);
    return true;
}

/* A matrix says all but the format, four tangents the view alone. */
static bool check_matrix(camera_said *c, camera_fault *fault) {
    static const camera_key in_vain[] = {CAMERA_ORTHO, CAMERA_FOV, CAMERA_HFOV, CAMERA_NEAR, CAMERA_FAR, CAMERA_PRESET};
    enum { OF_VIEW = 3 };
    const size_t count = c->matrix.count == 0                 ? 0
                         : c->matrix.count == MATRIX_TANGENTS ? OF_VIEW
                                                              : sizeof in_vain / sizeof in_vain[0];
    for (size_t i = 0; i < count; i++)
        if (said(c, in_vain[i]))
            return camera_fails(fault, "matrix", "conflicts with @%s", camera_keys[in_vain[i]]);
    if (c->matrix.count != MATRIX_ENTRIES || c->use.imaged)
        return true;
    const dp_mapping range = c->platform == NULL                   ? DP_MAPPING_COUNT
                             : strcmp(c->platform->api, "gl") == 0 ? DP_MAPPING_GL
                                                                   : DP_MAPPING_D3D;
    return camera_take_matrix(c, c->mapping_brought ? c->mappings[0] : range, false, fault);
}

static bool take_preset(camera_said *c, const preset *p, const unit_row *unit, camera_fault *fault) {
    double znear, zfar, log_c;
    preset_camera camera;
    if ((said(c, CAMERA_FOV) || said(c, CAMERA_HFOV)) && preset_parameter_of(p, "fov") >= 0)
        return camera_fails(fault, said(c, CAMERA_FOV) ? "fov" : "hfov",
                            "would leave the planes of %s as they are: say it to the @preset, as in %s:fov=40", p->name,
                            p->name);
    if (!make_preset(c, &camera, fault))
        return false;
    preset_planes(p, &camera, unit, &znear, &zfar, &log_c);
    if (!said(c, CAMERA_NEAR))
        c->znear = znear;
    if (!said(c, CAMERA_FAR))
        c->zfar = zfar;
    if (!said(c, CAMERA_LOG_C))
        c->log_c = log_c;
    if (!said(c, CAMERA_FORMAT))
        c->format_count = dp_format_parse(p->format, c->formats);
    if (!said(c, CAMERA_MAPPING))
        bring_mapping(c, p->mapping);
    take_logarithm(c, p);
    bring_raster(c, p->raster);
    return true;
}

/* A platform says what is stored: a preset's format and rasterizer give way to it, its mapping stays. */
static void take_platform(camera_said *c, const platform *p) {
    const char *stored = platform_stores(p, c->words[CAMERA_FORMAT]);
    if (!said(c, CAMERA_FORMAT) || stored != NULL)
        c->format_count = dp_format_parse(stored != NULL ? stored : p->stored, c->formats);
    if (!said(c, CAMERA_MAPPING) && !camera_says_planes(c))
        bring_mapping(c, strcmp(p->api, "gl") == 0 ? DP_MAPPING_GL : DP_MAPPING_D3D);
    bool remapped = false;
    for (size_t i = 0; i < c->mapping_count && p->remap != PLATFORM_REMAPS_NOT; i++)
        remapped = remapped || dp_mapping_get(c->mappings[i])->ndc_signed;
    if (!said(c, CAMERA_ARITH) && remapped)
        dp_arith_parse("ieee-remap", &c->arith);
    bring_raster(c, p->raster);
}

/* The arithmetic of a known rasterizer, with the remap of the platform. */
static bool take_arith(camera_said *c, camera_fault *fault) {
    const bool known = c->raster != NULL && c->raster->model != NULL, remapped = dp_arith_get(c->arith)->remap;
    if (said(c, CAMERA_ARITH))
        return true;
    if (c->raster_profiled && !c->has_raster_arith && c->triangles.width > 0)
        return camera_fails(fault, "arith", "must be given: the profile of @raster names none that is known");
    if (c->has_raster_arith && dp_arith_get(c->raster_arith)->remap == remapped)
        c->arith = c->raster_arith;
    else if (known && !raster_arith(c->raster, remapped, &c->arith))
        return camera_fails(fault, "raster",
                            "%s was not measured with [-1, 1] remapped in the vertex shader, as on %s: name its "
                            "arithmetic with @arith",
                            c->raster->name, c->platform != NULL ? c->platform->name : "the platform");
    return true;
}

int camera_profile(camera_said *c, const char *path, camera_key key, char name[PROFILE_NAME_SIZE],
                   char error[PROFILE_ERROR_SIZE]) {
    char arith[PROFILE_NAME_SIZE], none[PROFILE_ERROR_SIZE];
    const int status = profile_add(&c->gpu, path, camera_keys[key], name, error);
    if (status != 0)
        return status;
    if (key == CAMERA_RASTER) {
        c->raster_profiled = true;
        c->has_raster_arith =
            profile_add(&c->gpu, path, "arith", arith, none) == 0 && dp_arith_parse(arith, &c->raster_arith) == DP_OK;
    }
    return 0;
}

/* A colour target's depth is compared with a buffer's, and stands for none. */
static bool check_rg(const camera_said *c, camera_fault *fault) {
    for (size_t i = 0; i < c->format_count; i++) {
        const bool rg = dp_format_is_rg(&c->formats[i]);
        if (rg && !c->use.compared)
            return camera_fails(fault, "format",
                                "rg is no depth buffer: table and figures of set-ups show it, and texture has it as a "
                                "packing");
        if (rg && c->rounding != DP_ROUND_NEAREST)
            return camera_fails(fault, "rounding", "must be nearest with rg, got %s", dp_rounding_name(c->rounding));
    }
    return true;
}

/* An orthographic camera may begin at its place or behind it. */
static bool check_near(double znear, bool ortho, camera_fault *fault) {
    const double size = ortho && znear < 0.0 ? -znear : znear;
    return (ortho && znear == 0.0) || (size >= CAMERA_NEAR_LEAST && size <= CAMERA_NEAR_MOST) ||
           camera_fails(fault, "near", "must be %sa number from 1e-12 to 1e12 scene units%s, got '%.15g'",
                        ortho ? "0, or " : "", ortho ? " or its negative" : "", znear);
}

/* Keeps formats that the GPUs of the profiles store; one that was named has to be among them. */
static bool keep_stored(camera_said *c, camera_fault *fault) {
    const bool any = said(c, CAMERA_FORMAT) ? strcmp(c->words[CAMERA_FORMAT], "all") == 0
                                            : c->preset_count == 0 && c->platform == NULL;
    size_t kept = 0;
    for (size_t i = 0; i < c->format_count; i++) {
        if (profile_stores(&c->gpu, &c->formats[i]))
            c->formats[kept++] = c->formats[i];
        else if (!any || (i + 1 == c->format_count && kept == 0))
            return camera_keeps(c, &c->formats[i], fault);
    }
    c->format_count = kept;
    return true;
}

/* Where the command itself says what needs a viewport, the angle alone. */
static bool take_view(camera_said *c, camera_fault *fault) {
    dp_triangles *t = &c->triangles;
    if (!c->use.mapped)
        return camera_viewed(c, fault);
    return t->width == 0 || camera_angle(c, t->fov_y, t->width, t->height, &t->fov_y, fault);
}

bool camera_make(camera_said *c, const unit_row *unit, camera_fault *fault) {
    if (c->model == DP_MODEL_COUNT) {
        c->model_auto = true;
        c->model = DP_MODEL_EXACT;
    }
    if (!check_matrix(c, fault) || !check_rg(c, fault) ||
        !camera_range_takes(camera_said_api(c), c->depth_range, fault) || !camera_canvas(c, fault) ||
        !take_view(c, fault) || !camera_grid(c, fault))
        return false;
    if (c->preset_count == 1 && !take_preset(c, c->presets[0], unit, fault))
        return false;
    if (c->platform != NULL)
        take_platform(c, c->platform);
    return take_arith(c, fault) && (c->preset_count > 1 || keep_stored(c, fault)) &&
           check_near(c->znear, c->ortho, fault);
}

bool camera_keeps(const camera_said *c, const dp_format *format, camera_fault *fault) {
    char names[PROFILE_FORMATS_SIZE];
    if (!profile_stores(&c->gpu, format))
        return camera_fails(fault, "format", "must be %s with a profile of a GPU that stores no other depth, got %s",
                            profile_formats(&c->gpu, names), format->name);
    return c->raster == NULL || raster_bounded(c->raster, format) ||
           camera_fails(fault, "raster",
                        "%s steps the codes of %s from pixel to pixel, which has no bound: name other formats",
                        c->raster->name, format->name);
}

dp_spec camera_to_spec(const camera_said *c) {
    return (dp_spec){.znear = c->znear,
                     .zfar = c->zfar,
                     .ortho = c->ortho,
                     .mapping = c->mappings[0],
                     .format = c->formats[0],
                     .rounding = c->rounding,
                     .model = c->model,
                     .arith = c->arith,
                     .log_c = c->log_c,
                     .depth_range = {c->depth_range[0], c->depth_range[1]},
                     .triangles = c->triangles};
}

/* A viewport as high as the canvas from which its preset computes its planes, where it does. */
static void take_canvas(const camera_said *c, dp_triangles *t) {
    const int i = c->preset_count == 1 ? preset_parameter_of(c->presets[0], "height") : -1;
    const double given = i >= 0 ? c->values[0].given[i] : (double)NAN,
                 high = i >= 0 && isnan(given) ? c->presets[0]->function->parameters[i].standard : given;
    if (!(high >= 1.0 && high <= CAMERA_SIDE_MOST / 2.0))
        return;
    t->width = (int)round(high * t->width / t->height);
    t->height = (int)high;
}

bool camera_assumed(const camera_said *c, const dp_spec *spec, dp_spec *out) {
    camera_said assumed = *c;
    camera_fault fault = {.key = NULL};
    dp_triangles *t = &assumed.triangles;
    if (spec->triangles.width > 0 || dp_mapping_get(spec->mapping)->curve != DP_CURVE_PERSPECTIVE)
        return false;
    *t = dp_triangles_default();
    take_canvas(c, t);
    if (!camera_viewed(&assumed, &fault))
        return false;
    if (c->preset_count == 1)
        bring_raster(&assumed, c->presets[0]->raster);
    if (c->platform != NULL)
        bring_raster(&assumed, c->platform->raster);
    if (!take_arith(&assumed, &fault) || (assumed.raster != NULL && !raster_bounded(assumed.raster, &spec->format)))
        return false;
    *out = *spec;
    out->triangles = *t;
    out->arith = assumed.arith;
    return true;
}

bool camera_has(const dp_spec *spec, camera_key key) {
    const dp_mapping_row *row = dp_mapping_get(spec->mapping);
    return key == CAMERA_LOG_C ? row->curve == DP_CURVE_LOG && !row->log_over_near
                               : row->curve != DP_CURVE_LINEAR || spec->ortho;
}

bool camera_serves(const camera_said *c, camera_key key, const dp_spec *first, size_t stride, size_t count,
                   camera_fault *fault) {
    char names[256] = "";
    bool used = !said(c, key) || (key == CAMERA_ARITH && profile_is_file(c->words[key]));
    for (size_t i = 0; i < count && !used; i++)
        used = camera_has((const dp_spec *)((const char *)first + i * stride), key);
    if (!used && key == CAMERA_ARITH)
        return camera_fails(fault, "arith", "has no effect with linear alone, whose depth a shader writes");
    for (dp_spec spec = {.mapping = 0}; spec.mapping < DP_MAPPING_COUNT && !used; spec.mapping++)
        if (camera_has(&spec, key))
            append(names, sizeof names, "%s%s", names[0] != '\0' ? ", " : "", dp_mapping_get(spec.mapping)->name);
    return used || camera_fails(fault, "log_c", "needs one of the mappings with a constant C: %s", names);
}
