/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that scene writes for machines: JUnit XML as libxml reads it, requirements as check judges them, and its
 * bias. */
#include <libxml/parser.h>
#include <libxml/tree.h>

#include "bias/bias.h"
#include "printed.h"

#define HOUSE  "tests/models/house.gltf"
#define CAMERA "-n 0.05 -F d24 -m d3d --viewport 1280x720 --fov 23"

static const char *name_of(const json_t *finding, const char *side) {
    return json_string_value(json_object_get(json_object_get(finding, side), "node"));
}

/* ---- JUnit ------------------------------------------------------------------------------------------------------- */

static bool attribute_is(xmlNode *node, const char *name, const char *want) {
    xmlChar *value = xmlGetProp(node, (const xmlChar *)name);
    const bool same = value != NULL && strcmp((const char *)value, want) == 0;
    xmlFree(value);
    return same;
}

static bool attribute_has(xmlNode *node, const char *name, const char *part) {
    xmlChar *value = xmlGetProp(node, (const xmlChar *)name);
    const bool found = value != NULL && strstr((const char *)value, part) != NULL;
    xmlFree(value);
    return found;
}

static bool is(const xmlNode *node, const char *name) {
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

/* The element `name` below, which has to be there. */
static xmlNode *below(xmlNode *node, const char *name) {
    for (xmlNode *n = node->children; n != NULL; n = n->next)
        if (is(n, name))
            return n;
    fail_msg("no <%s>", name);
    return NULL;
}

/* The message of a failure says where, to 4 digits, and what mends it: the lift, rounded up. */
static void remedy_is(const char *message, const json_t *place, double lift) {
    static const char *const axes[] = {"x", "y", "z"};
    const char *near = strstr(message, ", near "), *more = strstr(message, "; separate by another ");
    double at[3], said = 0.0;
    assert_true(near != NULL && more != NULL);
    assert_int_equal(sscanf(near, ", near %lf %lf %lf; separate by another %lf", &at[0], &at[1], &at[2], &said), 4);
    for (int k = 0; k < 3; k++)
        assert_true(fabs(at[k] - number_at(place, "%s", axes[k])) <= 5.1e-4 * fabs(at[k]));
    assert_true(said >= lift && said <= lift + 1e-3 * lift);
}

/* A case for each finding of JSON in its order; what fights fails. */
TEST(junit) {
    static const struct {
        const char *options;
        int status;
        size_t fewest;
    } rows[] = {
        {CAMERA " --within 60", 1, 17}, {CAMERA " --within 10", 1, 10}, {"-F fp32 -m reversed --within 10", 1, 2}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char command[512], text[32];
        size_t fails = 0, k = 0;
        snprintf(command, sizeof command, "scene " HOUSE " %s", rows[i].options);
        json_t *root = json_printed(-1, "%s", command);
        const json_t *list = node_at(root, "findings");
        printed p = print_of("%s --report junit", command);
        assert_int_equal(p.status, rows[i].status);
        xmlDoc *doc = xmlReadMemory(p.out, (int)strlen(p.out), NULL, NULL, XML_PARSE_NONET);
        assert_non_null(doc);
        xmlNode *suite = below(xmlDocGetRootElement(doc), "testsuite");
        for (xmlNode *n = suite->children; n != NULL; n = n->next) {
            if (!is(n, "testcase"))
                continue;
            const json_t *f = json_array_get(list, k++);
            assert_true(attribute_has(n, "name", name_of(f, "a")) && attribute_has(n, "name", name_of(f, "b")));
            assert_true(attribute_is(n, "file", HOUSE));
            const bool fights = json_is_true(node_at(f, "fights"));
            fails += fights;
            if (!fights) {
                assert_null(n->children);
                continue;
            }
            const double to = number_at(f, "certain_to"), lift = number_at(f, "lift");
            double said = 0.0;
            xmlNode *failure = below(n, "failure");
            xmlChar *message = xmlGetProp(failure, (const xmlChar *)"message");
            assert_true(attribute_is(failure, "type", "fights"));
            assert_int_equal(sscanf((const char *)message, "safe up to %lf", &said), isnan(to) ? 0 : 1);
            assert_true(isnan(to) ? strstr((const char *)message, "never safe") != NULL
                                  : said <= to && said > to - 1e-3 * to);
            remedy_is((const char *)message, node_at(f, "place"), lift);
            xmlFree(message);
        }
        assert_true(k == json_array_size(list) && k >= rows[i].fewest && fails >= 1);
        snprintf(text, sizeof text, "%zu", k);
        assert_true(attribute_is(suite, "tests", text) && attribute_is(suite, "name", HOUSE));
        snprintf(text, sizeof text, "%zu", fails);
        assert_true(attribute_is(suite, "failures", text));
        xmlFreeDoc(doc);
        printed_free(&p);
        json_decref(root);
    }
}

/* No finding is one case that passes; a name with what XML has a use for is text. */
TEST(junit_edges) {
    static const char lone[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng lone\nf 1 2 3\n";
    static const char odd[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\ng a<\"&>'\nf 1 2 3\ng b]]>\nf 1 2 3\n";
    for (int i = 0; i < 2; i++) {
        const char *path = scratch_text("junit.obj", "%s", i == 0 ? lone : odd);
        printed p = print_of("scene %s --within 10 --report junit", path);
        xmlDoc *doc = xmlReadMemory(p.out, (int)strlen(p.out), NULL, NULL, XML_PARSE_NONET);
        assert_non_null(doc);
        assert_int_equal(p.status, i);
        xmlNode *suite = below(xmlDocGetRootElement(doc), "testsuite"), *one = below(suite, "testcase");
        assert_true(attribute_is(suite, "tests", "1") && attribute_is(suite, "failures", i == 0 ? "0" : "1"));
        assert_true(i == 0 ? attribute_has(one, "name", "no surfaces within ")
                           : attribute_is(one, "name", "'a<\"&>'' and 'b]]>'"));
        xmlFreeDoc(doc);
        printed_free(&p);
    }
}

/* ---- Requirements ------------------------------------------------------------------------------------------------ */

/* By check: each pair that is not in one plane is a requirement with its gap, and fails exactly where it fights. */
TEST(needs) {
    static const char *const cameras[] = {
        CAMERA " --within 60",
        CAMERA " --within 12 --raster swiftshader --slant 10:80 --triangle-class depth=1.5,pixels=100,slim=8",
        CAMERA " --within 60 --raster spec-vulkan --subpixel 6",
        "-n 0.05 -F d24 -m d3d --within 60",
        "-n 1 -f inf -F fp32 -m reversed --separation 0.01 --within 90 --unit m",
        "-F fp16 -m d3d --within 30 --rounding zero",
        "-m log -F d24 --log-c 0.5 --within 90 --separation 0.01",
        "-m log -F d24 -f 1e9 --within 300 --separation 0.02 --viewport 640x480", /* none in the lattice */
        "-m linear -F d16 --within 90 --viewport 640x480"};
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++) {
        size_t at = 0, failed = 0;
        const char *path = scratch_file("house.need");
        json_t *root = json_printed(-1, "scene " HOUSE " %s --emit-need %s", cameras[i], path);
        json_t *judged = json_printed(-1, "check %s", path);
        const json_t *list = node_at(root, "findings"), *asked = node_at(judged, "requirements");
        for (size_t k = 0; k < json_array_size(list); k++) {
            const json_t *f = json_array_get(list, k);
            if (number_at(f, "gap_min") < 1e-9)
                continue;
            const json_t *need = json_array_get(asked, at++);
            const bool passed = json_is_true(node_at(need, "passed"));
            if (passed == json_is_true(node_at(f, "fights")) || number_at(need, "limit") != number_at(f, "gap_min"))
                fail_msg("%s: %s", cameras[i], name_of(f, "b"));
            failed += !passed;
        }
        const json_t *others = json_array_get(asked, at);
        assert_int_equal(json_array_size(asked), at + 1);
        assert_true(number_at(others, "limit") == number_at(root, "gap"));
        assert_true(json_is_true(node_at(others, "passed")));
        if (!json_equal(node_at(root, "setup"), node_at(others, "setup")))
            fail_msg("%s: another camera is written", cameras[i]);
        if (node_at(others, "triangles") != NULL &&
            !json_equal(node_at(root, "triangles"), node_at(others, "triangles")))
            fail_msg("%s: other triangles are written", cameras[i]);
        assert_true(i == 4 || i == 6 || failed > 0);
        json_decref(root);
        json_decref(judged);
    }
}

/* The mapping of the camera is put right in the file: then nothing fails, and nothing of the model was needed. */
TEST(mended) {
    const char *path = scratch_file("mended.need");
    json_decref(json_printed(-1, "scene " HOUSE " -n 0.05 -F fp32 -m d3d --within 60 --emit-need %s", path));
    json_decref(json_printed(1, "check %s", path));
    char *text = text_of_file(path), *mapping = strstr(text, "\"d3d\"");
    assert_non_null(mapping);
    scratch_text("mended.need", "%.*s\"reversed\"%s", (int)(mapping - text), text, mapping + 5);
    check_says(0, "!FAIL", "check %s", path);
    free(text);
}

/* From an eye the range is what it sees, and what it does not see is not asked for; from several it is that of all. */
TEST(needs_of_eyes) {
    const char *path = scratch_file("eye.need"), *walk = scratch_text("walk.txt", "0 2 12 0 1 0\n6 3 12 0 1 0\n");
    for (int several = 0; several < 2; several++) {
        size_t at = 0;
        json_t *root = json_printed(-1, "scene " HOUSE " " CAMERA " %s %s --within 70 --emit-need %s",
                                    several ? "--path" : "--camera", several ? walk : "street", path);
        json_t *judged = json_printed(-1, "check %s", path);
        const json_t *list = node_at(root, "findings"), *asked = node_at(judged, "requirements");
        for (size_t k = 0; k < json_array_size(list); k++) {
            const json_t *f = json_array_get(list, k);
            if (number_at(f, "gap_min") < 1e-9 || isnan(number_at(f, "seen_from")))
                continue;
            const json_t *need = json_array_get(asked, at++);
            assert_true(number_at(need, "lo") == (several ? 0.05 : number_at(f, "seen_from")));
            assert_true(number_at(need, "hi") == (several ? 70.0 : fmin(number_at(f, "seen_to"), 70.0)));
        }
        assert_true(at > 5 && json_array_size(asked) == at + 1);
        json_decref(root);
        json_decref(judged);
    }
}

/* ---- The bias ---------------------------------------------------------------------------------------------------- */

TEST(bias) {
    static const struct {
        const char *options, *api;
        double znear, within;
        bool drawn;
    } rows[] = {{CAMERA " --within 60", "d3d11", 0.05, 60.0, true},
                {"-n 0.05 -F d24 -m d3d --within 60 --api vulkan", "vulkan", 0.05, 60.0, false},
                {"-n 1 -f 1000 -F d24 -m d3d --within 90 --api gl", "gl", 1.0, 90.0, false}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char command[512];
        dp_triangles t = {0};
        double z;
        const bias_api *api = NULL;
        snprintf(command, sizeof command, "scene " HOUSE " %s", rows[i].options);
        json_t *root = json_printed(-1, "%s", command);
        const json_t *said = node_at(root, "bias");
        if (rows[i].drawn) {
            t = dp_triangles_default();
            t.width = 1280;
            t.height = 720;
            t.fov_y = 23.0;
        }
        const dp_setup setup = SETUP("unorm24", .znear = rows[i].znear, .model = DP_MODEL_FLOAT, .triangles = t);
        for (size_t k = 0; bias_api_get(k) != NULL; k++)
            if (strcmp(bias_api_get(k)->name, rows[i].api) == 0)
                api = bias_api_get(k);
        assert_non_null(api);
        const bias_goal goal = {.api = api, .factor = bias_factor_least(&setup)};
        const double units = bias_needed_over(&setup, &goal, rows[i].znear, rows[i].within, &z);
        assert_string_equal(text_at(said, "api"), rows[i].api);
        assert_true(units >= 1.0 && number_at(said, "units") == -units && number_at(said, "factor") == -goal.factor);
        json_decref(root);
        check_says(-1, "Or bias what is drawn second: ", "%s", command);
    }
    printed p = print_of("scene " HOUSE " -F fp32 -m reversed --api gl");
    assert_non_null(strstr(p.out, "glPolygonOffset(0, ")); /* and reversed depths grow towards the camera */
    assert_null(strstr(p.out, "glPolygonOffset(0, -"));
    printed_free(&p);
}

/* Triangles so wide that their set-up loses more than any slope brings back: so the library says, too. */
TEST(no_bias) {
    dp_spec spec = dp_spec_default();
    dp_setup setup;
    spec.zfar = 1000.0;
    spec.triangles = dp_triangles_default();
    spec.triangles.width = 1280;
    spec.triangles.height = 720;
    spec.triangles.pixels = 60000.0;
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    assert_true(isinf(bias_factor_least(&setup)));
    json_t *root = json_printed(-1, "scene " HOUSE " -F d24 -m d3d --viewport 1280x720 --triangle-class pixels=60000");
    const json_t *said = node_at(root, "bias");
    assert_true(json_is_null(node_at(said, "units")) && json_is_null(node_at(said, "factor")));
    json_decref(root);
    printed p = print_of("scene " HOUSE " -F d24 -m d3d --viewport 1280x720 --triangle-class pixels=60000");
    assert_non_null(strstr(p.out, "No depth bias of d3d11 keeps either surface in front up to "));
    assert_null(strstr(p.out, "drawn second"));
    printed_free(&p);
}

TEST(refused) {
    static const struct {
        const char *options;
        int status;
        const char *said;
    } rows[] = {
        {"--report junit", 2, "--report: junit needs --within: surfaces that may z-fight nearer fail"},
        {"--report junit --within 5 --csv", 2, "--report: conflicts with --json or --csv"},
        {"--emit-need none/x.need", 3, "cannot write 'none/x.need': No such file or directory"},
        {"--emit-need x.need --separation 0", 2, "--emit-need: needs a --separation above 0"},
        {"--emit-need " HOUSE, 2, "--emit-need: must not be a file that is read"},
        {"--api all", 2, "--api: must name one here, got 'all'"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("scene " HOUSE " %s", rows[i].options);
        if (p.status != rows[i].status || strstr(p.errors, rows[i].said) == NULL)
            fail_msg("%s: %d: %s", rows[i].options, p.status, p.errors);
        printed_free(&p);
    }
}

int main(void) {
    const int status = run_listed(NULL, NULL);
    xmlCleanupParser();
    return status;
}
