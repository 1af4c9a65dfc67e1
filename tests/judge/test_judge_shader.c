/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Functions as people write them, run on the device that is here: what each computes is known from how it was derived,
 * and stands beside it. None that is right is accused.
 */
#include <unistd.h>

#include "printed.h"

static const char glsl[] =
    "#version 330 core\n"
    "#extension GL_OES_standard_derivatives : enable\n"
    "precision highp float;\n"
    "uniform highp float uNear, uFar; /* float wrong(float d) { */\n"
    "layout(std140) uniform Camera { float cameraNear; float cameraFar; };\n"
    "uniform mat4 projectionMatrix; uniform mat4 inverseProjection;\n"
    "uniform vec4 _ZBufferParams; uniform vec2 range; uniform bool on;\n"
    "uniform sampler2D tDepth;\n"
    "in vec2 vUv; out vec4 color;\n"
    "#include <packing>\n"
    "#line 100\n"
    "#ifdef OF_NOTHING\n"
    "in vec3 vPlace;\n"
    "#endif\n"
    "#ifdef OF_TWO\n"
    "float cut(float d, float e) {\n"
    "#else\n"
    "float cut(float d) {\n"
    "#endif\n"
    "    return d;\n"
    "}\n"
    "layout(std140) uniform View { float near; highp float far; vec4 tint; } view;\n"
    "struct Planes { float zNear, zFar; };\n"
    "uniform Planes planes;\n"
    "uniform vec4 camera_params, czm_viewport; uniform vec2 czm_currentFrustum;\n"
    "uniform mat4 czm_inverseProjection, czm_viewportTransformation;\n"
    "float of_instance(float d) { return view.near * view.far / (view.far - d * (view.far - view.near)); }\n"
    "float of_planes(float d, Planes p) { return p.zNear * p.zFar / (p.zFar - d * (p.zFar - p.zNear)); }\n"
    "float of_member_alone(float d) { return planes.zNear / d; }\n"
    "float of_whole(float d) { return of_planes(d, planes); }\n"
    "float tinted(float d) { return d * view.tint.x; }\n"
    "float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {\n"
    "    return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );\n"
    "}\n"
    "float viewZToReversedDepth(float viewZ, float near, float far) {\n"
    "    return near * (viewZ + far) / (viewZ * (near - far));\n"
    "}\n"
    "float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {\n"
    "    return ( viewZ + near ) / ( near - far );\n"
    "}\n"
    "float of_params(float d) {\n"
    "    vec4 c = camera_params;\n"
    "    return (c.w == 0.0 ? c.z * c.y / (c.y + d * (c.z - c.y)) : c.z + d * (c.y - c.z)) * (c.x * c.y);\n"
    "}\n"
    "float reverse_log(float log_z) {\n"
    "    float near = czm_currentFrustum.x, far = czm_currentFrustum.y;\n"
    "    float from_near = exp2(log_z * czm_log2FarDepthFromNearPlusOne) - 1.0;\n"
    "    return far * (1.0 - near / (from_near + near)) / (far - near);\n"
    "}\n"
    "float write_log(float z) {\n"
    "    return log2(z - czm_currentFrustum.x + 1.0) * czm_oneOverLog2FarDepthFromNearPlusOne;\n"
    "}\n"
    "float divided_log(float z) {\n"
    "    return log2(z - czm_currentFrustum.x + 1.0) / log2(czm_farDepthFromNearPlusOne);\n"
    "}\n"
    "float from_screen(float d) {\n"
    "    float ndc = (d - czm_viewportTransformation[3][2]) / czm_viewportTransformation[2][2];\n"
    "    vec4 p = czm_inverseProjection * vec4(0.0, 0.0, ndc, 1.0);\n"
    "    return p.z / p.w * czm_viewport.z;\n"
    "}\n"
    "#define NDC(d) ((d) * TWO - 1.0)\n"
    "const float TWO = 2.0;\n"
    "float textbook(float d) { return uNear * uFar / (uFar - d * (uFar - uNear)); }\n"
    "float of_block(float d) { return 1.0 / ((1.0 / cameraFar - 1.0 / cameraNear) * d + 1.0 / cameraNear); }\n"
    "float by_ndc(float d) { return 2.0 * uNear * uFar / (uFar + uNear - NDC(d) * (uFar - uNear)); }\n"
    "float of_ndc(const in float ndc, float zNear, float zFar) {\n"
    "    return (2.0 * zNear * zFar) / (zFar + zNear - ndc * (zFar - zNear));\n"
    "}\n"
    "float LinearEyeDepth(float z) { return 1.0 / (_ZBufferParams.z * z + _ZBufferParams.w); }\n"
    "float Linear01Depth(float z, vec4 zBufferParam) { return 1.0 / (zBufferParam.x * z + zBufferParam.y); }\n"
    "float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {\n"
    "    // maps perspective depth in [ 0, 1 ] to viewZ\n"
    "    return ( near * far ) / ( ( far - near ) * depth - far );\n"
    "}\n"
    "float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {\n"
    "    return depth * ( near - far ) - near;\n"
    "}\n"
    "float endless(float d) { return uNear / d; }\n"
    "float by_inverse(float d) { vec4 p = inverseProjection * vec4(0.0, 0.0, NDC(d), 1.0); return -p.z / p.w; }\n"
    "float by_matrix(float d) { return projectionMatrix[3][2] / (d + projectionMatrix[2][2]); }\n"
    "float flipped(float d) { float reversed_one = 1.0 - d; return textbook(reversed_one); }\n"
    "float stored(float z) { return uFar / (uFar - uNear) - uFar * uNear / ((uFar - uNear) * z); }\n"
    "float of_range(float d) { return on ? range.x * range.y / (range.y - d * (range.y - range.x)) : 0.0; }\n"
    "float fog(float d, float scale) { return scale * textbook(d); }\n"
    "float swapped(float d) { return uNear * uFar / (uNear - d * (uNear - uFar)); }\n"
    "float halved(float d) { return uNear * uFar / (uFar + uNear - NDC(d) * (uFar - uNear)); }\n"
    "float ndc_fed(float d) { return textbook(2.0 * d - 1.0); }\n"
    "float inverted(float d) { return uFar / ((1.0 - uNear / uFar) * d + uFar / uNear); }\n"
    "float constant(float d) { return uNear; }\n"
    "float squared(float d) { return d * d + 1.0; }\n"
    "float wraps(float d) { return fract(d); }\n"
    "float slip(float d) { return d == 12345.0 / 65535.0 ? 3.0 : textbook(d); }\n"
    "float ortho(float d) { return d * (uFar - uNear) + uNear; }\n"
    "float by_unity(float d) {\n"
    "#if UNITY_REVERSED_Z\n"
    "    d = 1.0 - d;\n"
    "#endif\n"
    "    return textbook(d);\n"
    "}\n"
    "float by_macro(float d) {\n"
    "#ifdef REVERSED_DEPTH\n"
    "    d = 1.0 - d;\n"
    "#endif\n"
    "    return textbook(d);\n"
    "}\n"
    "struct plane { float near; };\n"
    "float of_member(float d) { plane p = plane(0.5); return d * p.near; }\n"
    "float sampled(vec2 uv) { return textbook(texture(tDepth, uv).x); }\n"
    "float asked(float d) { return texture(tDepth, vUv).x * d; }\n"
    "vec3 coloured(float d) { return vec3(d); }\n"
    "float unknown(float d) {\n"
    "    return d * mystery;\n"
    "}\n"
    "float hangs(float d) {\n"
    "    uint k = 1u;\n"
    "    for (int i = 0; i < 60000; i++)\n"
    "        for (int j = 0; j < 60000; j++)\n"
    "            for (int l = 0; l < 60000; l++) {\n"
    "                k = k * 1664525u + 1013904223u;\n"
    "                if (k == 7u && d < -1.0)\n"
    "                    return 2.0;\n"
    "            }\n"
    "    return d;\n"
    "}\n"
    "void main() { color = vec4(sampled(vUv)); }\n";

static const char hlsl[] =
    "#include \"UnityCG.cginc\"\n"
    "float4 _ZBufferParams;\n"
    "cbuffer View : register(b0) { float4 InvDeviceZToWorldZTransform; float4x4 UNITY_MATRIX_P; };\n"
    "Texture2D _Depth : register(t0);\n"
    "static const float one = 1.0;\n"
    "struct Planes { float Near; float Far; };\n"
    "ConstantBuffer<Planes> planes : register(b1);\n"
    "float OfBuffer(float d) { return planes.Near * planes.Far / (planes.Far - d * (planes.Far - planes.Near)); }\n"
    "inline float LinearEyeDepth(float z) { return one / (_ZBufferParams.z * z + _ZBufferParams.w); }\n"
    "float ConvertFromDeviceZ(float DeviceZ) {\n"
    "    return DeviceZ * InvDeviceZToWorldZTransform[0] + InvDeviceZToWorldZTransform[1] +\n"
    "           1.0f / (DeviceZ * InvDeviceZToWorldZTransform[2] - InvDeviceZToWorldZTransform[3]);\n"
    "}\n"
    "half OfMatrix(half d, float4x4 proj) { return proj[2][3] / (d - proj[2][2]); }\n"
    "float Unknown(float d) { return d * mystery; }\n"
    "float4 frag(float2 uv : TEXCOORD0) : SV_Target { return _Depth.Load(int3(uv, 0)); }\n";

/* With depths read as they are: standard NDC in [0, 1], -m d3d, where nothing else is said. */
typedef struct written_row {
    const char *function, *options, *verdict, *computes, *from;
} written_row;

static const written_row of_glsl[] = {
    /* From d = f (z - n)/((f - n) z), in several orders of operations. */
    {"textbook", "", "right", "eye depth", "window depth"},
    {"of_block", "", "right", "eye depth", "window depth"},
    {"by_ndc", "-m gl", "right", "eye depth", "window depth"},
    {"by_ndc", "", "right", "eye depth", "window depth"},
    {"of_ndc", "-m gl", "right", "eye depth", "NDC depth"},
    {"of_range", "--define range=near_far --define on=1", "right", "eye depth", "window depth"},
    {"flipped", "-m reversed", "right", "eye depth", "window depth"},
    {"swapped", "-m reversed", "right", "eye depth", "window depth"},
    {"endless", "-m reversed -f inf", "right", "eye depth", "window depth"},
    /* As Unity and three.js have them, with what those give them. */
    {"LinearEyeDepth", "", "right", "eye depth", "window depth"},
    {"LinearEyeDepth", "-m reversed", "right", "eye depth", "window depth"},
    {"Linear01Depth", "", "right", "eye depth over far", "window depth"},
    {"Linear01Depth", "-m reversed", "right", "eye depth over far", "window depth"},
    {"perspectiveDepthToViewZ", "-m gl", "right", "minus eye depth", "window depth"},
    {"orthographicDepthToViewZ", "--ortho -m gl", "right", "minus eye depth", "window depth"},
    /* clip = P (0, 0, -z, 1), d = clip z/clip w of d3d; of gl NDC is that. */
    {"by_inverse", "-m gl", "right", "eye depth", "window depth"},
    {"by_inverse", "-m gl --ortho", "right", "eye depth", "window depth"},
    {"by_matrix", "", "right", "eye depth", "window depth"},
    {"by_matrix", "-m reversed -f inf", "right", "eye depth", "window depth"},
    {"stored", "", "right", "window depth", "eye depth"},
    {"ortho", "--ortho", "right", "eye depth", "window depth"},
    /* Structures and named blocks, read in part and handed on as a whole. */
    {"of_instance", "", "right", "eye depth", "window depth"},
    {"of_planes", "", "right", "eye depth", "window depth"},
    {"of_member_alone", "-m reversed -f inf", "right", "eye depth", "window depth"},
    {"of_member_alone", "-m reversed -f inf --define planes.zNear=2", "another set-up", "eye depth", "window depth"},
    {"of_whole", "", "right", "eye depth", "window depth"},
    {"tinted", "--define view.tint=1", "right", "window depth", "window depth"},
    /* As PlayCanvas and CesiumJS have them; CesiumJS draws log2(1 + z - n)/log2(1 + f - n). */
    {"of_params", "", "right", "eye depth", "window depth"},
    {"of_params", "--ortho", "right", "eye depth", "window depth"},
    {"reverse_log", "-m cesium", "right", "window depth without the logarithm", "window depth"},
    {"reverse_log", "-m gl", "another set-up", "window depth without the logarithm", "window depth"},
    {"write_log", "-m cesium", "right", "window depth", "eye depth"},
    {"divided_log", "-m cesium", "right", "window depth", "eye depth"},
    {"from_screen", "-m gl", "right", "minus eye depth", "window depth"},
    /* View z, which is negative, goes in. Of window depths the last would be -z for other planes. */
    {"viewZToPerspectiveDepth", "-m gl", "right", "window depth", "minus eye depth"},
    {"viewZToPerspectiveDepth", "-m reversed", "another set-up", "window depth", "minus eye depth"},
    {"viewZToReversedDepth", "-m reversed", "right", "window depth", "minus eye depth"},
    {"viewZToOrthographicDepth", "-m gl", "right", "the way from near to far", "minus eye depth"},
    {"viewZToOrthographicDepth", "-m gl --ortho", "right", "the way from near to far", "minus eye depth"},
    /* A function that is right where its macro is defined as its engine defines it is not accused where nobody does. */
    {"by_unity", "", "right", "eye depth", "window depth"},
    {"by_unity", "-m reversed", "right", "eye depth", "window depth"},
    {"by_macro", "", "right", "eye depth", "window depth"},
    {"by_macro", "-m reversed", "unknown", "eye depth", "window depth"},
    {"by_macro", "-m reversed --define REVERSED_DEPTH=1", "right", "eye depth", "window depth"},
    {"by_macro", "-m reversed --define REVERSED_DEPTH=0", "another set-up", "eye depth", "window depth"},
    /* Constants of the other direction; the sum of far and near, which is half of what belongs there; a unit; NDC that
       none is. */
    {"swapped", "", "another set-up", "eye depth", "window depth"},
    {"textbook", "-m reversed", "another set-up", "eye depth", "window depth"},
    {"halved", "-m gl", "another set-up", "eye depth", "window depth"},
    {"fog", "--define scale=0.02", "another set-up", "eye depth", "window depth"},
    {"of_ndc", "", "another set-up", "eye depth", "NDC depth"},
    {"ndc_fed", "-m gl", "wrong", "eye depth", "window depth"},
    {"inverted", "", "wrong", "eye depth", "window depth"},
    {"constant", "", "unknown", NULL, NULL},
    {"squared", "", "unknown", NULL, NULL},
    {"wraps", "", "unknown", "window depth", "window depth"},
};

static const written_row of_hlsl[] = {
    {"LinearEyeDepth", "-m reversed", "right", "eye depth", "window depth"},
    {"ConvertFromDeviceZ", "-m reversed -f inf", "right", "eye depth", "window depth"},
    {"ConvertFromDeviceZ", "-m reversed --ortho", "right", "eye depth", "window depth"},
    {"OfBuffer", "", "right", "eye depth", "window depth"},
    {"OfMatrix", "", "right", "eye depth", "window depth"}, /* d = (P22 z + P23)/z: the camera looks along +z */
};

#define CAMERA "-n 0.1 -f 1000 -F d16"

/* A function's needs are not met: nothing can be told. */
static void need_device(void) {
    static int there = -1;
    if (there < 0) {
        scratch_text("probe.glsl", "float f(float d) { return d; }\n");
        printed p = print_of("judge %s:f %s", scratch_file("probe.glsl"), CAMERA);
        there = p.status == 0;
        if (!there && (strstr(p.errors, "Debian's package") != NULL || strstr(p.errors, "device") != NULL))
            printf("# %s", p.errors);
        else
            assert_int_equal(p.status, 0);
        printed_free(&p);
    }
    if (!there)
        skip();
}

static const char *options_of(const written_row *w) {
    return strstr(w->options, "-f inf") != NULL ? "-n 0.1 -F d16" : CAMERA;
}

static void judge_all(const char *path, const written_row rows[], size_t count) {
    tally t = {.name = path};
    const size_t step = test_effort() == EFFORT_QUICK ? 4 : 1; /* each starts a driver */
    for (size_t i = 0; i < count; i += step) {
        const written_row *w = &rows[i];
        json_t *root = json_printed(0, "judge %s:%s %s %s %s", path, w->function, options_of(w),
                                    strstr(w->options, "-m ") != NULL ? "" : "-m d3d", w->options);
        const char *verdict = text_at(root, "verdict");
        const char *computes = json_string_value(node_at(root, "fits[0].computes"));
        const char *from = json_string_value(node_at(root, "fits[0].from"));
        const bool named = w->computes == NULL
                               ? computes == NULL
                               : computes != NULL && strcmp(computes, w->computes) == 0 && strcmp(from, w->from) == 0;
        TALLY(&t, strcmp(verdict, w->verdict) == 0 && named, "%s %s: %s, %s from %s", w->function, w->options, verdict,
              computes != NULL ? computes : "nothing", from != NULL ? from : "nothing");
        TALLY(&t, w->computes == NULL || number_at(root, "pairs") == 65536, "%s %s: %g pairs", w->function, w->options,
              number_at(root, "pairs"));
        json_decref(root);
    }
    tally_end(&t);
}

TEST(test_glsl) {
    need_device();
    judge_all(scratch_text("depth.glsl", "%s", glsl), of_glsl, sizeof of_glsl / sizeof of_glsl[0]);
}

TEST(test_hlsl) {
    need_device();
    judge_all(scratch_text("depth.hlsl", "%s", hlsl), of_hlsl, sizeof of_hlsl / sizeof of_hlsl[0]);
}

/* It says what the function was given and where it ran. */
TEST(test_said) {
    need_device();
    const char *path = scratch_text("depth.glsl", "%s", glsl);
    json_t *root = json_printed(0, "judge %s:of_range --define range=near_far --define on=1 " CAMERA, path);
    assert_string_equal(text_at(root, "defines"), "on = 1, range = near_far");
    assert_true(strlen(text_at(root, "device")) > 3 && strstr(text_at(root, "function"), ":of_range") != NULL);
    json_decref(root);
    root = json_printed(0, "judge %s:of_member " CAMERA, path); /* a member is no uniform */
    assert_string_equal(text_at(root, "defines"), "");
    json_decref(root);
    char line[512];
    snprintf(line, sizeof line, "judge %s:textbook -m d3d -F d16 --device 0", path);
    check_says_all(0, line,
                   SAID("right: eye depth from window depth: d3d, near 0.1, far 1000", "run on", "65536 depths",
                        "uNear = near (guessed), uFar = far (guessed)"));
}

TEST(test_refused) {
    need_device();
    const char *path = scratch_text("depth.glsl", "%s", glsl);
    const char *damaged = scratch_text("damaged.spv", "no SPIR-V at all");
    char line[64];
    unsigned at = 1;
    for (const char *c = glsl; c < strstr(glsl, "    return d * mystery"); c++)
        at += *c == '\n';
    snprintf(line, sizeof line, ":%u: 'mystery' : undeclared identifier (--define", at);
    check_says(2, line, "judge %s:unknown", path);
    check_says(0, "", "judge %s:unknown --define mystery=2 -F d16", path);
    check_says(2, ":15: 'mystery' : unknown variable", "judge %s:Unknown", scratch_text("depth.hlsl", "%s", hlsl));
    const struct {
        const char *words, *said;
    } rows[] = {
        {":sampled", "sampled takes vec2 uv, which nothing is known of: --define uv="},
        {":coloured", "coloured gives vec3: what is judged gives one float"},
        {":fog", "takes float scale"},
        {":tinted", "reads view.tint, which nothing is known of: --define view.tint=near"},
        {":absent", "absent is no function of the file, which has cut, of_instance, of_planes,"},
        {":vUv", "vUv is no function of the file"},
        {":textbook --define uMid=near", "knows nothing by the name of --define uMid=near"},
        {":textbook --define uFar=further", "--define: must be NAME=near"},
        {":textbook --define far", "--define: must be NAME=near"},
        {":textbook --pairs -", "judge needs FILE:FUNCTION, or --pairs FILE, or --pairs-for N"},
        {":", "judge: must be FILE, FILE:FUNCTION or FILE.spv"},
        {"", "name its function, FILE:FUNCTION; it has cut, of_instance,"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        check_says(2, rows[i].said, "judge %s%s", path, rows[i].words);
    check_says(2, "is no SPIR-V", "judge %s", damaged);
    check_says(2, "--define: is not for SPIR-V", "judge %s --define a=1", damaged);
    check_says(2, "--define: does not apply with --pairs, only with FILE", "judge --pairs %s --define a=1", damaged);
    check_says(3, "No such file", "judge absent.glsl:f");
    check_says(3, "no device has that name or number", "judge %s:textbook --device none-such", path);
}

/* Mesa gives up a loop after 65536 turns, so that a few depths may come to an end, but never 2^26. It takes half a
 * minute of work until that is known. */
TEST(test_endless) {
    if (test_effort() == EFFORT_QUICK)
        skip();
    need_device();
    printed p = print_of("judge %s:hangs --json", scratch_text("depth.glsl", "%s", glsl));
    assert_true(p.status == 3 ? strstr(p.errors, "did not end in 10 s of work") != NULL
                              : p.status == 0 && strstr(p.out, "\"pairs\":512,") != NULL);
    printed_free(&p);
}

/* A compute shader of its own, of another size of workgroup. */
TEST(test_spirv) {
    need_device();
    const char *text = scratch_text("own.comp", "#version 450\nlayout(local_size_x = 48) in;\n"
                                                "layout(std430, binding = 0) buffer A { float depth[]; };\n"
                                                "layout(std430, binding = 1) buffer B { float value[]; };\n"
                                                "void main() {\n"
                                                "    uint i = gl_GlobalInvocationID.x;\n"
                                                "    value[i] = 100.0 / (1000.0 - depth[i] * 999.9);\n}\n");
    const char *made = scratch_file("own.spv");
    char command[1024];
    snprintf(command, sizeof command, "glslangValidator -V '%s' -o '%s' >'%s'", text, made, scratch_file("said"));
    assert_int_equal(system(command), 0);
    json_t *root = json_printed(0, "judge %s -m d3d " CAMERA, made);
    assert_string_equal(text_at(root, "verdict"), "right");
    assert_string_equal(text_at(root, "defines"), "");
    assert_true(number_at(root, "pairs") == 65536);
    json_decref(root);
    root = json_printed(0, "judge %s -m d3d -F d16", made); /* nothing is given: the planes are found */
    assert_string_equal(text_at(root, "verdict"), "right");
    assert_relative(number_at(root, "fits[0].near"), 0.1, 1e-6);
    assert_relative(number_at(root, "fits[0].far"), 1000, 1e-4);
    json_decref(root);
    FILE *longer = fopen(made, "ab"); /* words of four bytes, and one more */
    assert_true(longer != NULL && fputc(0, longer) == 0 && fclose(longer) == 0);
    check_says(2, "is no SPIR-V", "judge %s -m d3d " CAMERA, made);
}

/* All codes are looked at: the one that is off is found, and so is the worst of the others. */
TEST(test_every_code) {
    need_device();
    const char *path = scratch_text("depth.glsl", "%s", glsl);
    json_t *root = json_printed(0, "judge %s:slip -m d3d " CAMERA, path);
    assert_string_equal(text_at(root, "verdict"), "unknown");
    assert_true(number_at(root, "strays") == 1 && number_at(root, "stray") == (double)(float)(12345.0 / 65535));
    const double d = (double)(float)(12345.0 / 65535), z = 100 / (1000 - d * 999.9);
    assert_true(number_at(root, "at") == d);
    assert_relative(number_at(root, "error"), (3 - z) / z, 1e-9);
    json_decref(root);
    root = json_printed(0, "judge %s:wraps -m d3d " CAMERA, path);
    assert_true(number_at(root, "strays") == 1 && number_at(root, "stray") == 1);
    json_decref(root);
    double worst[2] = {0}, at[2] = {0};
    for (int code = 0; code < 65536; code++) {
        const float n = 0.1F, f = 1000, x = (float)(code / 65535.0), size = f - n;
        const float v[2] = {x * size + n, fmaf(x, size, n)};
        const double truth = 0.1 + (double)x * 999.9;
        for (int k = 0; k < 2; k++)
            if (fabs((double)v[k] - truth) > worst[k] * truth) {
                worst[k] = fabs((double)v[k] - truth) / truth;
                at[k] = (double)x;
            }
    }
    root = json_printed(0, "judge %s:ortho --ortho -m d3d " CAMERA, path);
    const int fused = number_at(root, "at") == at[1];
    assert_true(number_at(root, "at") == at[fused]);
    assert_relative(number_at(root, "error"), worst[fused], 1e-6);
    assert_true(number_at(root, "strays") == 0);
    json_decref(root);
}
