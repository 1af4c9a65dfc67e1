/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The effects, a row each. */
#include "shader/effect_rows.h"

#define DEPTH_TEXTURE "shaders on Unity's _CameraDepthTexture"

#define SLOPE                                                                                                          \
    {                                                                                                                  \
        "slope", "a plane's change of eye depth from one of the two pixels to the other", "scene", 0, 1e12, 0.1,       \
            .use = PARAMETER_TABLE                                                                                     \
    }
#define SAMPLE_DISTANCE                                                                                                \
    {                                                                                                                  \
        "sample-distance", "from the pixel to each of the four that are looked at, on both axes", "pixels", 1, 4, 1,   \
            .whole = true, .use = PARAMETER_IMAGE                                                                      \
    }

#define SAMPLES                                                                                                        \
    {                                                                                                                  \
        "samples", "on a picture: pixels on the way, a vector apart", "1", 1, 64, 3,                                   \
            .whole = true, .use = PARAMETER_IMAGE, .alias = "numSamples"                                               \
    }
#define REFERENCE(note)                                                                                                \
    { "reference", note, "scene", 0, 1e18, (double)NAN, .use = PARAMETER_IMAGE }
#define REFERENCE01(name)                                                                                              \
    {                                                                                                                  \
        "reference01", "in place of reference: the same over far, as Linear01Depth", "eye01", 0, 1, (double)NAN,       \
            .use = PARAMETER_IMAGE, .alias = name                                                                      \
    }

/* clang-format off */
static const effect_row rows[] = {
    {.name = "intersection", .aliases = "IntersectionHighlight _IntersectionWidth",
     .note = "saturate(|eye - scene|/half-width)",
     .parameters = {
         {"half-width", "distance from the surface over which the highlight fades, half of _IntersectionWidth", "scene",
          1e-12, 1e12, 0.1, .whole = false},
         REFERENCE("eye depth of the surface")},
     .smallest = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the surface", .given = true,
     .source = DEPTH_TEXTURE "; Lorach 2007, Soft particles",
     .kind = EFFECT_FADE, .apart = eye_apart, .output = intersection, .shader = intersection_shader,
     .mix = EFFECT_SPARES, .surface = true, .tint = {1, 1, 1, 1}},
    {.name = "force-field", .aliases = "ForceField",
     .note = "max(rim, (1 - (scene - eye)) power), rim = 1 - facing rim-power",
     .parameters = {
         [FORCE_POWER] = {"power", "how fast the glow falls behind the surface", "1/scene", 1e-12, 1e12, 1,
                          .alias = "_IntersectionPower"},
         [FORCE_RIM] = {"rim-power", "what a surface that faces the camera lacks of the glow of its rim", "1", 0, 1e12,
                        1, .use = PARAMETER_IMAGE, .alias = "_RimPower"},
         [FORCE_FACING] = {"facing", "cosine between the surface's normal and the view: 1 head-on, 0 at the rim", "1",
                           0, 1, 1, .use = PARAMETER_IMAGE},
         REFERENCE("eye depth of the surface")},
     .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the surface", .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_GAIN, .apart = eye_apart, .output = force_field, .shader = force_field_shader,
     .surface = true, .tint = {0.25, 0.5, 1, 1}},
    {.name = "fog", .aliases = "_FogColor", .note = "saturate(eye01 density)",
     .parameters = {
         {"density", "how thick the fog is at the far plane", "1", 1e-12, 1e12, 1, .alias = "_FogDensity"}},
     .eye01 = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_CLAMPED, .quantity = fog_depth, .output = fog, .shader = fog_shader,
     .tint = {0.5, 0.5, 0.5, 1}},
    {.name = "radial-fog", .note = "saturate(distance/far density), the distance from the camera",
     .parameters = {
         {"density", "how thick the fog is a distance of far away", "1", 1e-12, 1e12, 1, .alias = "_FogDensity"}},
     .eye01 = true, .needs = EFFECT_POSITION,
     .source = "Unity's Global Fog with radial distance; distance fog along the view ray",
     .kind = EFFECT_CLAMPED, .quantity = fog_distance, .output = radial_fog, .shader = radial_fog_shader,
     .tint = {0.5, 0.5, 0.5, 1}},
    {.name = "scan-line", .aliases = "ScanLine _CurValue _LineWidth", .note = "saturate(|cur - eye01|/half-width)",
     .parameters = {
         {"half-width", "depth over which the line fades, of far, half of _LineWidth", "eye01", 1e-15, 1, 0.01,
          .whole = false},
         REFERENCE("eye depth of the line"), REFERENCE01("_CurValue")},
     .smallest = true, .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the depth cur of the line",
     .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_FADE, .apart = eye01_apart, .output = scan_line, .shader = scan_line_shader,
     .mix = EFFECT_SPARES, .tint = {1, 1, 1, 1}},
    {.name = "water-line", .aliases = "WaterLine WaterFlooded _WaterColor",
     .note = "world y < level; with a band, saturate((level - y)/band)",
     .parameters = {
         [WATER_BAND] = {"band", "height over which the edge is softened, 0 for a hard one", "scene", 0, 1e12, 0,
                         .whole = false},
         [WATER_LEVEL] = {"level", "world height of the water", "scene", -1e12, 1e12, 0, .use = PARAMETER_IMAGE,
                          .alias = "_WaterHeight"}},
     .wanted = WATER_BAND, .smallest = true, .needs = EFFECT_POSITION, .reference = "the level of the water",
     .source = DEPTH_TEXTURE,
     .kind = EFFECT_FADE, .apart = height_apart, .output = water_line, .shader = water_line_shader,
     .tint = {0, 0.25, 0.5, 0.5}},
    {.name = "height-fog", .aliases = "HeightFog VerticalFog",
     .note = "saturate((y - start)/(end - start) density), y the world height",
     .parameters = {
         [HEIGHT_DENSITY] = {"density", "the value at the height end", "1", 1e-12, 1e12, 1, .alias = "_FogDensity"},
         [HEIGHT_START] = {"start", "world height where the value is 0", "scene", -1e12, 1e12, 0, .alias = "_StartY"},
         [HEIGHT_END] = {"end", "world height where it is density", "scene", -1e12, 1e12, -100, .alias = "_EndY"}},
     .wanted = HEIGHT_DENSITY, .needs = EFFECT_POSITION, .source = DEPTH_TEXTURE,
     .kind = EFFECT_CLAMPED, .quantity = height_share, .output = height_fog, .shader = height_fog_shader,
     .mix = EFFECT_SPARES, .tint = {0.5, 0.5, 0.5, 1}},
    {.name = "edge", .aliases = "EdgeDetection",
     .note = "|s1 - s4| > threshold, |s2 - s3| > threshold: Roberts' diagonals of eye01",
     .parameters = {
         [EDGE_THRESHOLD] = {"threshold", "difference of two pixels that makes an edge, of far", "eye01", 0, 1, 0.001,
                             .alias = "_EdgeThreshold"},
         SLOPE, SAMPLE_DISTANCE},
     .smallest = true, .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the first pixel's place in its cell",
     .source = DEPTH_TEXTURE "; Roberts 1963",
     .kind = EFFECT_STEP, .taps = EFFECT_DIAGONALS, .critical = edge_critical, .output = edge, .shader = edge_shader,
     .tint = {0, 0, 0, 1}},
    {.name = "outline",
     .note = "|n1 - n4| normal-sensitivity >= 0.1, x and y of packed normals, or |s1 - s4| depth-sensitivity >= 0.1 "
             "s1; likewise 2 and 3",
     .parameters = {
         [OUTLINE_DEPTH] = {"depth-sensitivity", "of differences of depth, over depth", "1", 1e-12, 1e12, 1,
                            .whole = false},
         [OUTLINE_NORMAL] = {"normal-sensitivity", "of differences of normals", "1", 0, 1e12, 1,
                             .use = PARAMETER_IMAGE},
         SLOPE, SAMPLE_DISTANCE},
     .eye01 = true, .needs = EFFECT_SECOND_DEPTH | EFFECT_NORMALS, .reference = "the first pixel's place in its cell",
     .source = "shaders on Unity's _CameraDepthNormalsTexture, after CheckSame of EdgeDetectNormals.shader; "
               "Roberts 1963",
     .kind = EFFECT_STEP, .taps = EFFECT_DIAGONALS, .critical = outline_critical, .output = outline,
     .shader = outline_shader,
     .tint = {0, 0, 0, 1}},
    {.name = "motion-blur", .aliases = "MotionBlur",
     .note = "|current - last NDC|/2 strength: the world position, seen by last frame's camera",
     .parameters = {{"strength", "blur in pictures, of the way since last frame", "1", 1e-12, 1e12, 1, .whole = false},
                    SAMPLES},
     .needs = EFFECT_POSITION | EFFECT_LAST_FRAME, .source = DEPTH_TEXTURE "; Rosado 2007, GPU Gems 3, chapter 27",
     .kind = EFFECT_GAIN, .apart = velocity_apart, .output = velocity, .shader = velocity_shader,
     .vector = velocity_vector, .exact_vector = velocity_exact,
     .mix = EFFECT_SMEARS},
    {.name = "motion-vector", .aliases = "velocity _CameraMotionVectorsTexture",
     .note = "(current - last NDC)/2 strength: to the right, up, and its length, in pictures",
     .parameters = {{"strength", "multiple of the way since last frame", "1", 1e-12, 1e12, 1, .whole = false}, SAMPLES},
     .needs = EFFECT_POSITION | EFFECT_LAST_FRAME, .source = DEPTH_TEXTURE "; Rosado 2007, GPU Gems 3, chapter 27",
     .kind = EFFECT_GAIN, .apart = velocity_apart, .output = velocity, .shader = velocity_shader,
     .vector = velocity_vector, .exact_vector = velocity_exact, .wide = true,
     .mix = EFFECT_SMEARS},
    {.name = "depth-of-field", .aliases = "DepthOfField _FocusDistance", .note = "saturate(|eye01 - focus| level)",
     .parameters = {
         {"level", "how fast the picture blurs away from the focus", "1", 1e-12, 1e15, 10, .alias = "_FocusLevel"},
         {"blur", "on a picture: from one of the nine pixels of the blur to the next", "pixels", 0, 64, 1,
          .use = PARAMETER_IMAGE, .alias = "_BlurLevel"},
         REFERENCE("eye depth of the focus"), REFERENCE01("_FocusDistance")},
     .eye01 = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the focus", .given = true, .source = DEPTH_TEXTURE,
     .kind = EFFECT_GAIN, .apart = eye01_apart, .output = depth_of_field, .shader = depth_of_field_shader,
     .mix = EFFECT_BLURS},
    {.name = "soft-particles", .note = "saturate((scene - particle)/fade-distance)",
     .parameters = {
         {"fade-distance", "way from a surface over which a particle fades in", "scene", 1e-12, 1e12, 1,
          .whole = false},
         REFERENCE("eye depth of the particle")},
     .smallest = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the particle", .given = true,
     .source = "Lorach 2007, Soft particles; Unity's Particles/Standard shaders, _SoftParticleFadeParams",
     .kind = EFFECT_FADE, .apart = eye_apart, .output = soft_particles, .shader = soft_particles_shader,
     .tint = {1, 1, 1, 0.5}},
    {.name = "decal",
     .note = "inside the box: |p| <= 1/2, p = decal's matrix world; with a feather, saturate(way to a face/feather)",
     .parameters = {
         [DECAL_FEATHER] = {"feather", "way from a face over which the decal fades in, 0 for a hard cut", "scene", 0,
                            1e12, 0, .whole = false},
         [DECAL_YAW] = {"yaw", "the box's turn to the right", "degrees", -360, 360, 0, .whole = false},
         [DECAL_X] = {"x", "middle of the box, world", "scene", -1e12, 1e12, 0, .use = PARAMETER_IMAGE},
         [DECAL_Y] = {"y", "middle of the box, world", "scene", -1e12, 1e12, 0, .use = PARAMETER_IMAGE},
         [DECAL_Z] = {"z", "middle of the box, world", "scene", -1e12, 1e12, 10, .use = PARAMETER_IMAGE},
         [DECAL_WIDTH] = {"width", "of the box", "scene", 1e-9, 1e12, 1, .use = PARAMETER_IMAGE},
         [DECAL_HEIGHT] = {"height", "of the box", "scene", 1e-9, 1e12, 1, .use = PARAMETER_IMAGE},
         [DECAL_DEPTH] = {"depth", "of the box", "scene", 1e-9, 1e12, 1, .use = PARAMETER_IMAGE}},
     .wanted = DECAL_FEATHER, .smallest = true, .needs = EFFECT_POSITION, .reference = "a face of the box",
     .source = "Persson, Volume decals, GPU Pro 2, 2011; URP's DBuffer and screen-space decals",
     .kind = EFFECT_FADE, .apart = decal_apart, .quantity = decal_inside, .most = decal_most,
     .output = decal, .shader = decal_shader,
     .tint = {1, 0, 0, 1}},
    {.name = "ambient-occlusion",
     .note = "bias < z - z_sample < radius: what hides a part of the sky, checked for range; of four samples",
     .parameters = {
         [OCCLUSION_BIAS] = {"bias", "how much nearer a sample must be", "scene", 0, 1e12, 0.01, .whole = false},
         [OCCLUSION_RADIUS] = {"radius", "range: what is farther away hides nothing", "scene", 1e-12, 1e12, 0.5,
                               .whole = false},
         SLOPE, SAMPLE_DISTANCE},
     .wanted = OCCLUSION_BIAS, .ceiling = OCCLUSION_RADIUS, .smallest = true, .needs = EFFECT_SECOND_DEPTH,
     .reference = "the sample's place in its cell",
     .source = "Mittring 2007, Finding next gen: CryEngine 2; range checks as in LearnOpenGL, SSAO",
     .kind = EFFECT_STEP, .taps = EFFECT_AROUND, .quiet = true, .critical = occlusion_critical, .output = occlusion,
     .shader = occlusion_shader,
     .tint = {0, 0, 0, 1}},
    {.name = "contact-shadow", .note = "0 <= ray - scene < thickness: a ray that has gone under a surface is stopped",
     .parameters = {
         [CONTACT_THICKNESS] = {"thickness", "how thick surfaces are taken to be", "scene", 0, 1e12, 0.1,
                                .whole = false},
         [CONTACT_STEP] = {"step", "what the ray gains in eye depth from one sample to the next", "scene", 0, 1e12,
                           0.05, .use = PARAMETER_TABLE},
         SLOPE, REFERENCE("eye depth of the ray")},
     .wanted = CONTACT_THICKNESS, .smallest = true, .needs = EFFECT_SECOND_DEPTH,
     .reference = "the eye depth of the ray", .given = true,
     .source = "screen-space shadows: McGuire and Mara 2014, Efficient GPU screen-space ray tracing",
     .kind = EFFECT_STEP, .critical = contact_critical, .output = contact_shadow, .shader = contact_shadow_shader,
     .tint = {0, 0, 0, 1}},
    {.name = "shadow", .note = "lit where computed - bias <= stored: a shadow map's comparison",
     .parameters = {
         [SHADOW_BIAS] = {"bias", "what the computed depth is brought nearer by", "scene", 0, 1e12, 0.01,
                          .whole = false},
         [SHADOW_SLOPE] = {"slope", "a plane's change of depth over a texel", "scene", 0, 1e12, 0,
                           .use = PARAMETER_TABLE},
         REFERENCE("eye depth that is computed")},
     .wanted = SHADOW_BIAS, .smallest = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the computed depth",
     .given = true, .source = "Williams 1978, Casting curved shadows on curved surfaces",
     .kind = EFFECT_STEP, .alone = true, .quiet = true, .critical = shadow_critical, .output = shadow_lit,
     .shader = shadow_lit_shader,
     .mix = EFFECT_SPARES, .tint = {0, 0, 0, 1}},
    {.name = "water-depth", .note = "1 - exp(-density (scene - surface) along the view ray)",
     .parameters = {
         {"density", "how fast the water hides what is in it", "1/scene", 1e-12, 1e12, 0.5, .whole = false},
         {"refraction", "pixels to the right where the scene is looked at, if that is under water", "pixels", -64, 64,
          0, .whole = true, .use = PARAMETER_IMAGE},
         REFERENCE("eye depth of the surface")},
     .needs = EFFECT_POSITION | EFFECT_SECOND_DEPTH, .reference = "the eye depth of the surface", .given = true,
     .source = "the law of Beer and Lambert; water shaders on the depth texture, as Boat Attack's",
     .kind = EFFECT_DECAY, .apart = along_ray, .output = water_depth, .shader = water_depth_shader,
     .tint = {0, 0.25, 0.5, 1}},
    {.name = "thickness", .aliases = "translucency",
     .note = "saturate((back - front)/scale), both stored: how thick it is what light shines through",
     .parameters = {
         {"scale", "thickness that lets nothing through", "scene", 1e-12, 1e12, 1, .whole = false},
         [THICKNESS_BEHIND] = {"thickness", "from the front to the back", "scene", 0, 1e12, 0.1,
                               .use = PARAMETER_TABLE},
         REFERENCE("eye depth of the front, exactly")},
     .smallest = true, .behind = THICKNESS_BEHIND, .needs = EFFECT_SECOND_DEPTH, .reference = "either depth",
     .given = true, .source = DEPTH_TEXTURE "; Barre-Brisebois and Bouchard 2011, translucency by thickness",
     .kind = EFFECT_FADE, .apart = eye_apart, .output = soft_particles, .shader = soft_particles_shader,
     .tint = {0, 0, 0, 1}},
    {.name = "ray-march", .note = "saturate((scene - ray)/step): how much of its next step is in front of the surface",
     .parameters = {
         {"step", "what the ray gains in eye depth from one sample to the next", "scene", 1e-12, 1e12, 0.1,
          .whole = false},
         REFERENCE("eye depth of the ray")},
     .smallest = true, .needs = EFFECT_SECOND_DEPTH, .reference = "the eye depth of the ray", .given = true,
     .source = "McGuire and Mara 2014, Efficient GPU screen-space ray tracing",
     .kind = EFFECT_FADE, .apart = eye_apart, .output = soft_particles, .shader = soft_particles_shader,
     .tint = {1, 1, 1, 1}},
};
/* clang-format on */

NAMED_TABLE(effect, rows);

double effect_reference(const effect_row *row, const double *parameters, double zfar) {
    const int at = parameter_find(row->parameters, "reference"), share = parameter_find(row->parameters, "reference01");
    return at >= 0 && !isnan(parameters[at]) ? parameters[at] : share >= 0 ? parameters[share] * zfar : (double)NAN;
}

bool effect_applies(const effect_row *row, const dp_setup *setup) {
    return !row->eye01 || !isinf(setup->spec.zfar);
}
