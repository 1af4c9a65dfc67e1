/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cameras of engines: each row makes set-ups, says where it comes from and what is not confirmed. */
#include <ctype.h>

#include "camera/cost.h"
#include "camera/paste.h"
#include "camera/presets.h"
#include "cli/option/names.h"
#include "named.h"
#include "printed.h"
#include "raster/raster.h"
#include "support.h"

static size_t count(void) {
    size_t rows = 0;
    while (preset_get(rows) != NULL)
        rows++;
    return rows;
}

/* With the examples of its numbers, where it has any. */
static preset_camera made_of(const preset *row) {
    char text[PRESET_WORDS_SIZE], error[PRESET_ERROR_SIZE];
    const preset *found = NULL;
    preset_values given;
    preset_camera made;
    int length = snprintf(text, sizeof text, "%s", row->name);
    for (int i = 0; row->function != NULL && row->function->parameters[i].name != NULL; i++) {
        const preset_parameter *p = &row->function->parameters[i];
        assert_true(p->least <= p->most && p->example >= p->least && p->example <= p->most);
        assert_false(p->standard < p->least || p->standard > p->most);
        length += snprintf(text + length, sizeof text - (size_t)length, "%s%s=%.15g", i == 0 ? ":" : ",", p->name,
                           p->example);
        assert_true(length < (int)sizeof text && preset_parameter_of(row, p->name) == i);
    }
    assert_true(preset_read(text, &found, &given, error) && found == row && preset_length(text) == strlen(text));
    assert_string_equal(given.words, text);
    assert_true(preset_make(row, &given, &made, error));
    assert_true(isnan(row->znear) == (row->function != NULL) && isnan(row->zfar) == (row->function != NULL));
    return made;
}

static preset_camera made_by(const char *text) {
    char error[PRESET_ERROR_SIZE];
    const preset *row;
    preset_values given;
    preset_camera made = {0};
    assert_true(preset_read(text, &row, &given, error));
    assert_true(preset_make(row, &given, &made, error));
    return made;
}

/* Each row has numbers that its own functions gave: tests/presets.sh asks them anew. */
TEST(test_computed) {
    static const struct {
        const char *text;
        double znear, zfar, focus; /* in the row's unit */
    } known[] = {
        /* pixels of MapLibre 6.17 at .313177773185179 pixels of a metre */
        {"maplibre:zoom=14,pitch=60,latitude=48,height=800", 16 / .313177773185179,
         2867.6227893867376 / .313177773185179, 1200 / .313177773185179},
        /* of a camera less than 100 m above the ground, in metres */
        {"maplibre:zoom=21.07,pitch=82.874,latitude=-55.207,height=844,fov=44.308", 0.34208213280176064,
         5427.841405360067, 21.0043554326895},
        {"maplibre-globe:zoom=14,pitch=60,latitude=48,height=800", .5 / .313177773185179,
         3991716.697854359 / .313177773185179, 1200 / .313177773185179},
        /* heights of deck.gl's screen, 800 pixels of 40.03e6/512/1024 m; looking to the horizon far is held to 10 times
           the altitude */
        {"deckgl:zoom=10,height=800", .1 * 61080.9326171875, 1.5 * 1.01 * 61080.9326171875, 1.5 * 61080.9326171875},
        {"deckgl:zoom=10,height=800,pitch=80", .1 * 61080.9326171875, 15 * 61080.9326171875, 1.5 * 61080.9326171875},
        /* its globe's radius is 256 2^zoom/pi pixels, and 6370972 m */
        {"deckgl-globe:zoom=2,height=800", 7818358.9185258867, 36197020.755577661, 23455076.755577661},
        /* of those engines, as presets/ask.mjs has them; by hand where it has none */
        {"vtk:radius=82.26,distance=3.911", (.99 * 2.911 - 1) * 82.26,
         (1.01 * 4.911 + .5 * (4.911 - (.99 * 2.911 - 1))) * 82.26, 321.71886},
        {"vtkjs:radius=40.86600675378009,distance=1.303,fov=54.668,expansion=0.664", 1.8544315162225937,
         185.44315162225936, 53.24840680017546},
        {"babylon-default:diagonal=46.79077919847029", 0.7018616879770544, 70186.16879770544, 70.18616879770544},
        {"cesium-frusta:near=7.75,far=9718813,ratio=416,frustum=2", 1341184, 9816001.13, NAN},
        {"x3dom:radius=26.694367046251536,distance=1.298", 6.363937103826368, 73.61238656674324, 34.6492884260345},
        {"x3dom:radius=10,distance=0.5", 0.0018, 18, 5}, /* from within: far/10000 */
        {"gltf-viewer:diagonal=10", .1, 1000, 7.348469228349534},
        {"model-viewer:radius=2,orbit=100,fov=60", .008, 8, 4},
        {"model-viewer:radius=2,orbit=10,fov=60", .004, 4, .4},
        {"open3d:extent=10,fov=90", .1, 37, 7},
        {"open3d:extent=10,fov=90,zoom=2", .1, 50, 20},
        {"open3d:extent=1,fov=5,zoom=2", 42.807531, 48.807531, 45.807531},
        {"pyrender:scale=0.2", .02, 100, NAN},
        {"pyrender:scale=20", .05, 200, NAN},
        {"mujoco:extent=2", .02, 100, NAN},
        {"mujoco-2:extent=2,znear=0.1,zfar=3", .2, 6, NAN},
        {"blender:lens=35", .1, 1000, NAN},
        {"blender-viewport", .01, 1000, NAN},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const preset_camera made = made_by(known[i].text);
        const double share = strstr(known[i].text, "fov=5") != NULL ? 1e-7 : 1e-12;
        assert_relative(made.znear, known[i].znear, share);
        assert_relative(made.zfar, known[i].zfar, share);
        assert_true(isnan(known[i].focus) == isnan(made.focus));
        if (!isnan(known[i].focus))
            assert_relative(made.focus, known[i].focus, share);
    }
    for (size_t i = 0; preset_get(i) != NULL; i++) {
        const char *name = preset_get(i)->name;
        size_t k = 0;
        while (k < sizeof known / sizeof known[0] &&
               (strncmp(known[k].text, name, strlen(name)) != 0 || strchr(":", known[k].text[strlen(name)]) == NULL))
            k++;
        if (preset_get(i)->function != NULL && k == sizeof known / sizeof known[0])
            fail_msg("%s has no camera here", name);
    }
    assert_relative(made_by("blender").fov, 39.597752709049864, 1e-14); /* 2 atan(18/50) */
    assert_relative(made_by("blender:lens=18").fov, 90, 1e-14);
}

/* The width of a code in the middle of the map, of 24 bits: near^-1 z^2 2^-24. */
static double code_in_the_middle(const char *text, double znear_pixels) {
    const preset_camera made = made_by(text);
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    dp_format formats[2];
    dp_format_parse("unorm24", formats);
    spec.mapping = DP_MAPPING_GL;
    spec.format = formats[0];
    spec.zfar = made.zfar;
    spec.znear = made.znear / .5 * znear_pixels;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    const dp_cell cell = dp_cell_of(&setup, dp_code(&setup, made.focus));
    return cell.hi - cell.lo;
}

/* Users of MapLibre's globe reported fighting over kilometres, and what the flat map's near plane would do. */
TEST(test_globe) {
    static const char low[] = "maplibre-globe:zoom=4,height=800", high[] = "maplibre-globe:zoom=4,height=1080";
    assert_relative(code_in_the_middle(low, .5), 839, .01);
    assert_relative(code_in_the_middle(high, .5), 1529, .01);
    assert_relative(code_in_the_middle(low, 800 / 50.), 26.2, .01);
    assert_relative(code_in_the_middle(high, 1080 / 50.), 35.4, .01);
}

/* Mistakes that a person may make, and what the sentence then names. */
TEST(test_said) {
    static const struct {
        const char *text, *says;
    } wrong[] = {
        {"maplibre:zoom=27,height=800", "zoom from 0 to 26, got '27'"},
        {"maplibre:zoom=1e-400x", "got '1e-400x'"},
        {"maplibre:zoom=inf", "got 'inf'"},
        {"maplibre:zoom=0x10", "got '0x10'"},
        {"maplibre:zoom=", "got ''"},
        {"maplibre:zoom", "zoom, pitch, latitude, height and fov"},
        {"maplibre:", "zoom, pitch"},
        {"maplibre:zoom=1,zoom=1", "has zoom twice"},
        {"maplibre:zoom=1,,height=8", "got ''"},
        {"maplibre:zum=1", "got 'zum'"},
        {"unity:zoom=1", "must be unity alone"},
        {"unity:", "must be unity alone"},
        {"maplibre", "needs zoom and height: maplibre:zoom=14,height=800"},
        {"maplibre:zoom=3", "needs height: maplibre:zoom=3,height=800"},
        {"maplibre:height=3", "needs zoom: maplibre:zoom=14,height=3"},
    };
    char error[PRESET_ERROR_SIZE];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const preset *row;
        preset_values given;
        preset_camera made;
        assert_false(preset_read(wrong[i].text, &row, &given, error) && preset_make(row, &given, &made, error));
        if (strstr(error, wrong[i].says) == NULL)
            fail_msg("%s: '%s' lacks '%s'", wrong[i].text, error, wrong[i].says);
    }
    assert_int_equal(preset_length("maplibre:zoom=3,height=8,unity"), 24);
    assert_int_equal(preset_length("unity,maplibre:zoom=3"), 5);
    assert_int_equal(preset_length("maplibre:zoom=3,deckgl:zoom=3"), 15);
    assert_int_equal(preset_length("unity"), 5);
    assert_int_equal(preset_length("maplibre-globe:latitude=40,unity,maplibre-globe:zoom=3,height=8"), 26);
}

/* The example of a refusal is enough: of all numbers, or of those but the first, which is sought. */
TEST(test_examples) {
    size_t refusals[2] = {0};
    for (size_t i = 0; preset_get(i) != NULL; i++)
        for (int sought = 0; sought < 2 && preset_get(i)->function != NULL; sought++) {
            const preset *row;
            preset_values given;
            preset_camera made;
            char error[PRESET_ERROR_SIZE], example[PRESET_ERROR_SIZE] = "";
            assert_true(preset_read(preset_get(i)->name, &row, &given, error));
            given.sought = sought != 0;
            if (preset_make(row, &given, &made, error))
                continue;
            const char *said = strstr(error, ": ");
            assert_non_null(said);
            snprintf(example, sizeof example, "%.*s", (int)preset_length(said + 2), said + 2);
            char *more = strstr(example, ", or");
            *(more != NULL ? more : example + strlen(example)) = '\0';
            assert_true(preset_read(example, &row, &given, error) && row == preset_get(i));
            assert_int_equal(isnan(given.given[0]) != 0, sought || !isnan(row->function->parameters[0].standard));
            given.sought = sought != 0;
            if (!preset_make(row, &given, &made, error))
                fail_msg("%s: %s", example, error);
            refusals[sought]++;
        }
    assert_true(refusals[0] > 10 && refusals[1] > 3);
}

TEST(test_required) {
    static const char *const names[] = {
        "unity",        "unity-gl", "unreal",    "godot-forward", "godot-mobile",        "three",
        "three-webgpu", "bevy",     "cesium",    "mujoco",        "godot-compatibility", "r3f",
        "aframe",       "babylon",  "playcanvas"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        assert_non_null(preset_find(names[i]));
    const name_list presets = {.rows = &preset_table};
    list_item item;
    assert_true(names_find(&presets, "BEVY", NULL, &item) && item.row == preset_find("bevy"));
    assert_null(preset_find("quake"));
    assert_null(preset_find(""));
    assert_null(preset_get(count()));
}

TEST(test_rows) {
    for (size_t i = 0; i < count(); i++) {
        const preset *row = preset_get(i);
        const preset_camera made = made_of(row);
        assert_true(preset_find(row->name) == row); /* no name twice */
        for (const char *c = row->name; *c != '\0'; c++)
            assert_true(islower((unsigned char)*c) || isdigit((unsigned char)*c) || *c == '-');
        assert_non_null(bias_api_find(row->api));
        assert_true(raster_find(row->raster) != NULL && row->fov > 0 && row->fov < 180);
        assert_true(row->unit[0] != '\0' && row->note[0] != '\0' && row->source[0] != '\0');
        assert_int_equal(strlen(row->checked), 10);
        assert_true(strspn(row->checked, "0123456789-") == 10 && row->checked[4] == '-' && row->checked[7] == '-');
        dp_format formats[2];
        const size_t found = dp_format_parse(row->format, formats);
        assert_true(found >= 1);
        for (size_t f = 0; f < found; f++) {
            dp_spec spec = dp_spec_default();
            dp_setup setup;
            spec.znear = made.znear;
            spec.zfar = made.zfar;
            spec.mapping = row->mapping;
            spec.format = formats[f];
            assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
        }
    }
}

/* What is not confirmed is named by the columns that a row has. */
TEST(test_unconfirmed) {
    static const char *const columns[] = {"near", "far", "mapping", "format", "fov"};
    for (size_t i = 0; i < count(); i++) {
        char text[64];
        assert_true(strlen(preset_get(i)->unconfirmed) < sizeof text);
        strcpy(text, preset_get(i)->unconfirmed);
        for (char *word = strtok(text, ", "); word != NULL; word = strtok(NULL, ", ")) {
            int known = 0;
            for (size_t c = 0; c < 5; c++)
                known |= strcmp(word, columns[c]) == 0;
            assert_true(known);
        }
    }
}

TEST(test_known_values) {
    dp_format formats[2];
    assert_int_equal(dp_format_parse(preset_find("three-webgpu")->format, formats), 2); /* depth24plus */
    assert_string_equal(preset_find("unreal")->unit, "cm");
    /* reversed, with NDC depth in [-1, 1]; fov = 0.8 radians; planes of its own */
    assert_int_equal(preset_find("godot-gl")->mapping, DP_MAPPING_GL_REVERSED);
    assert_true(fabs(preset_find("babylonjs")->fov * acos(-1.0) / 180.0 - 0.8) < 1e-15);
    assert_true(preset_find("react-three-fiber")->zfar == 1000 && preset_find("three.js")->zfar == 2000);
    assert_true(preset_find("godot") == preset_find("godot-forward"));
    assert_true(preset_find("Unity-HDRP") == preset_find("unity"));
    assert_true(isinf(preset_find("unreal")->zfar) && isinf(preset_find("bevy")->zfar));
    assert_int_equal(preset_find("unity")->mapping, DP_MAPPING_REVERSED);
    assert_int_equal(preset_find("unity-gl")->mapping, DP_MAPPING_GL);
    assert_int_equal(preset_find("cesium")->mapping, DP_MAPPING_CESIUM);
    assert_true(strstr(preset_find("mujoco")->unconfirmed, "near") != NULL);
    dp_format_parse(preset_find("godot-mobile")->format, formats);
    assert_string_equal(formats[0].name, "unorm24");
}

/* The shader writes log2(1 + z - near)/log2(1 + far - near): 0 at the near plane, and 10 behind it log(11)/log(5e8). */
TEST(test_cesium_codes) {
    const preset *p = preset_find("cesium");
    dp_format formats[2];
    dp_format_parse(p->format, formats);
    dp_spec spec = dp_spec_default();
    spec.znear = p->znear, spec.zfar = p->zfar, spec.mapping = p->mapping, spec.format = formats[0];
    dp_setup setup;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_int_equal(dp_code(&setup, 1), 0);
    assert_int_equal(dp_code(&setup, 11), lrint(0xFFFFFF * (log(11) / log(5e8))));
    assert_int_equal(dp_code(&setup, 5e8), 0xFFFFFF);
}

/* Vertical, horizontal, and of the larger side. */
/* Code for an engine's users: each name of a row is a preset's, in one row alone. */
TEST(test_pastes) {
    static const struct {
        const char *preset, *near, *reversed;
    } known[] = {
        {"three", "camera.near = 3.2; camera.updateProjectionMatrix();",
         "new THREE.WebGLRenderer({ reversedDepthBuffer: true })"},
        {"babylon", "camera.minZ = 3.2;", "engine.useReverseDepthBuffer = true;"},
        {"playcanvas", "entity.camera.nearClip = 3.2;", NULL},
        {"unity-gl", "camera.nearClipPlane = 3.2f;", NULL},
        {"unreal", "NearClipPlane=3.2 in [/Script/Engine.Engine] of DefaultEngine.ini", NULL},
        {"godot-mobile", "camera.near = 3.2", NULL},
        {"bevy", "PerspectiveProjection { near: 3.2, ..default() }", NULL},
        {"cesium", "viewer.camera.frustum.near = 3.2;", NULL},
        {"mujoco", "model.vis.map.znear = 3.2 / model.stat.extent", NULL},
    };
    char text[128], word[64];
    size_t words = 0, said = 0;
    for (size_t i = 0; paste_presets(i) != NULL; i++)
        for (const char *at = paste_presets(i); sscanf(at, "%63s", word) == 1; words++) {
            assert_non_null(preset_find(word));
            assert_string_equal(preset_find(word)->name, word);
            at = strstr(at, word) + strlen(word);
        }
    for (size_t i = 0; i < count(); i++)
        said += paste_near(&(paste){.engine = preset_get(i)}, "1", text, sizeof text) != NULL;
    assert_int_equal(said, words);
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        const paste p = {.engine = preset_find(known[i].preset)};
        assert_string_equal(paste_near(&p, "3.2", text, sizeof text), known[i].near);
        if (known[i].reversed != NULL)
            assert_string_equal(paste_reversed(&p), known[i].reversed);
        else
            assert_null(paste_reversed(&p));
    }
    const paste metres = {preset_find("unreal"), unit_find("m")}, none = {.engine = NULL};
    assert_null(paste_near(&metres, "3.2", text, sizeof text)); /* it counts in centimetres */
    assert_null(paste_near(&none, "3.2", text, sizeof text));
    assert_null(paste_reversed(&none));
}

/* three.js has one word for the logarithms of two renderers, alone or in a list; other words mean what they say. */
TEST(the_word_of_both_renderers) {
    static const struct {
        const char *preset, *said, *meant[2];
    } rows[] = {
        {"three-webgpu", "logarithmicDepthBuffer", {"three-webgpu"}},
        {"three-webgpu", "LOGARITHMICDEPTHBUFFER,d3d", {"three-webgpu", "d3d"}},
        {"three-webgpu", "gl,logarithmicDepthBuffer", {"gl", "three-webgpu"}},
        {"three-webgpu", "three-webgl,gl", {"three-webgl", "gl"}},
        {"three", "logarithmicDepthBuffer,gl", {"three-webgl", "gl"}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        json_t *root = json_printed(0, "table --preset %s -F d24 -m %s --json", rows[i].preset, rows[i].said);
        for (size_t k = 0; k < 2 && rows[i].meant[k] != NULL; k++)
            assert_string_equal(text_at(root, "setups[%zu].mapping", k), rows[i].meant[k]);
        json_decref(root);
    }
}

TEST(test_view) {
    assert_true(preset_fov_y(preset_find("godot-forward"), 75, 1920, 1080) == 75);
    assert_true(preset_fov_y(preset_find("bevy"), 45, 100, 300) == 45);
    assert_relative(preset_fov_y(preset_find("unreal"), 90, 1920, 1080), 58.71550708558254, 1e-14);
    assert_relative(preset_fov_y(preset_find("unreal"), 90, 300, 400), 106.26020470831196, 1e-14);
    assert_true(preset_fov_y(preset_find("cesium"), 60, 1080, 1920) == 60);
    assert_relative(preset_fov_y(preset_find("cesium"), 60, 2000, 1000), 32.20422750397203, 1e-14);
    assert_string_equal(preset_find("three")->raster, "spec-gl");
    assert_string_equal(preset_find("unity")->raster, "spec-vulkan");
}

static dp_format format_of(const char *name) {
    dp_format f[2];
    assert_int_not_equal(dp_format_parse(name, f), 0);
    return f[0];
}

TEST(test_cost) {
    static const char *const order[] = {"unorm16", "fp32", "unorm24", "fp16", "float3.3"};
    for (int i = 0; i < 5; i++)
        for (int k = i + 1; k < 4; k++) {
            const dp_format a = format_of(order[i]), b = format_of(order[k]);
            const cost x = cost_of(&a, DP_MAPPING_D3D), y = cost_of(&b, DP_MAPPING_D3D);
            assert_true(cost_compare(&x, &y) < 0 && cost_compare(&y, &x) > 0);
        }
    static const struct {
        const char *format;
        double bytes;
    } whole[] = {{"unorm20", 3}, {"unorm8", 1}, {"unorm9", 2}, {"float5.8", 2}, {"float3.4", 1}, {"unorm24", 4}};
    for (size_t i = 0; i < sizeof whole / sizeof whole[0]; i++) { /* whole bytes, and four of what APIs have */
        const dp_format f = format_of(whole[i].format);
        assert_true((double)cost_of(&f, DP_MAPPING_D3D).bytes == whole[i].bytes);
    }
    for (size_t i = 0; i < dp_format_count(); i++) /* every named format has its row */
        assert_null(strstr(cost_of(&dp_format_get(i)->format, DP_MAPPING_GL).available, "study"));
}
