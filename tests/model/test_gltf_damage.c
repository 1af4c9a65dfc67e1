/* SPDX-License-Identifier: GPL-3.0-or-later */
/* glTF that is damaged, hostile or asks for what is not read: each has its sentence. Containers and files beside it. */
#include <sys/resource.h>
#include <unistd.h>

#include "gltf_made.h"
#include "printed.h"

#define VIEWS                                                                                                          \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,\"uri\":\"data:;base64,"       \
    "AAAAAAAAAAAAAAAA\"}]"
#define MESH                                                                                                           \
    "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"name\":\"box\",\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"

static const struct {
    const char *json, *sentence;
} damaged[] = {
    {"", "is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ"},
    {"[1]", "is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ"},
    {"{", "glTF: line 1 of its JSON: string or '}' expected near end of file"},
    {"{}", "glTF: is version '', and 2 is read"},
    {"{\"asset\":{\"version\":\"1.0\"}}", "glTF: is version '1.0', and 2 is read"},
    {ASSET "\"nodes\":[]}", "glTF: has no triangles"},
    {ASSET "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]}",
     "glTF: needs KHR_draco_mesh_compression, which is not read: unpack its meshes first, with a glTF tool"},
    {ASSET "\"extensionsRequired\":[\"X_y\"]}", "glTF: needs X_y, which is not read"},
    {ASSET "\"nodes\":[{\"children\":[1]},{\"children\":[0]}],\"scenes\":[{\"nodes\":[0]}]}",
     "glTF: the scene has a root that is none"},
    {ASSET "\"nodes\":[{\"children\":[1,1]},{}]}", "glTF: node 1 has two parents"},
    {ASSET "\"nodes\":[{\"children\":[2]},{}]}", "glTF: node 0 has a child that is not there"},
    {ASSET "\"nodes\":[{}],\"scenes\":[{\"nodes\":[0,0]}]}", "glTF: the scene has a root that is none"},
    {ASSET "\"nodes\":[{\"mesh\":0}]}", "glTF: mesh is 0, and there are 0"},
    {ASSET "\"nodes\":[{\"mesh\":-1}]}", "glTF: mesh must be a whole number"},
    {ASSET "\"nodes\":[{\"mesh\":0.5}]}", "glTF: mesh must be a whole number"},
    {ASSET "\"nodes\":[{\"scale\":[1,2]}]}", "glTF: scale of a node must be 3 numbers"},
    {ASSET "\"nodes\":[{\"scale\":[1e308,1e308,1]},{\"scale\":[1e308,1,1],\"rotation\":[1e200,0,0,1]}]}",
     "glTF: the place of a node is not finite"},
    {ASSET MESH ",\"accessors\":[{\"componentType\":5126,\"count\":1000000000,\"type\":\"VEC3\"}]}",
     "glTF: accessor 0 has 1000000000 elements, more than the file has bytes"},
    {ASSET MESH ",\"accessors\":[{\"componentType\":5126,\"count\":1e300,\"type\":\"VEC3\"}]}",
     "glTF: count must be a whole number"},
    {ASSET MESH ",\"accessors\":[{\"componentType\":5124,\"count\":1,\"type\":\"VEC3\"}]}",
     "glTF: componentType 5124 cannot be one"},
    {ASSET MESH ",\"accessors\":[{\"componentType\":5126,\"count\":1,\"type\":\"VEC2\"}]}",
     "glTF: accessor 0 must be VEC3"},
    {ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"}]," VIEWS "}",
     "glTF: an accessor of 2 elements reaches beyond bufferView 0"},
    {ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"byteOffset\":4,\"componentType\":5126,\"count\":1,\"type\":"
                "\"VEC3\"}]," VIEWS "}",
     "glTF: an accessor of 1 elements reaches beyond bufferView 0"},
    {ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"}],"
                "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":1,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,"
                "\"uri\":\"data:;base64,AAAAAAAAAAAAAAAA\"}]}",
     "glTF: bufferView 0 reaches beyond its buffer"},
    {ASSET "\"buffers\":[{\"byteLength\":13,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAA\"}]}",
     "glTF: cut short: buffer 0 has 12 bytes of 13"},
    {ASSET "\"buffers\":[{\"byteLength\":1}]}", "glTF: cut short: buffer 0 has 0 bytes of 1"},
    {ASSET "\"buffers\":[{\"byteLength\":1,\"uri\":\"data:;base64,A*\"}]}",
     "glTF: the base64 of a buffer has a character that is none"},
    {ASSET "\"buffers\":[{\"byteLength\":1,\"uri\":\"data:,A\"}]}", "glTF: buffer 0 has a data URI that is not base64"},
    {ASSET "\"buffers\":[{\"byteLength\":1,\"uri\":\"a.bin\"}]}", "names the file 'a.bin', which cannot be beside it"},
    {ASSET MESH
     ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\",\"sparse\":"
     "{\"count\":2,\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{\"bufferView\":0}}}]," VIEWS "}",
     "glTF: an accessor of 2 elements reaches beyond bufferView 0"},
    {ASSET MESH
     ",\"accessors\":[{\"bufferView\":0,\"componentType\":5121,\"count\":2,\"type\":\"VEC3\",\"sparse\":"
     "{\"count\":2,\"indices\":{\"bufferView\":0,\"componentType\":5121},\"values\":{\"bufferView\":0}}}]," VIEWS "}",
     "glTF: the indices of a sparse accessor must rise and be below 2"},
    {ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"name\":\"box\",\"primitives\":[{\"attributes\":{\"POSITION\":0},"
           "\"indices\":1}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"},"
           "{\"bufferView\":0,\"byteOffset\":9,\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\"}],"
           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":12}],\"buffers\":[{\"byteLength\":12,"
           "\"uri\":\"data:;base64,AAAAAAAAAAAAAAAB\"}]}",
     "glTF: mesh 'box' has vertex 1 of 1"},
};

TEST(refused) {
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        const model_asked asked = {0};
        model m;
        model_error error;
        assert_false(model_parse(damaged[i].json, strlen(damaged[i].json), false, NULL, &asked, &m, &error));
        assert_string_equal(error.text, damaged[i].sentence);
    }
}

/* Instances have a number, whichever accessor comes first: the longest and the shortest at each place. */
TEST(instances_of_one_number) {
    static const char *const names[] = {"TRANSLATION", "ROTATION", "SCALE"};
    for (int i = 0; i < 27; i++) {
        const int count[] = {i % 3, i / 3 % 3, i / 9}; /* 0: not given */
        char attributes[128] = "", json[2048];
        int least = 2, most = 0;
        for (int k = 0; k < 3; k++) {
            if (count[k] == 0)
                continue;
            snprintf(attributes + strlen(attributes), sizeof attributes - strlen(attributes), "%s\"%s\":%d",
                     attributes[0] != '\0' ? "," : "", names[k], 2 * k + count[k]);
            least = count[k] < least ? count[k] : least;
            most = count[k] > most ? count[k] : most;
        }
        size_t used = (size_t)snprintf(
            json, sizeof json,
            ASSET
            "\"nodes\":[{\"name\":\"row\",\"mesh\":0,\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{%s}}"
            "}}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":["
            "{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}",
            attributes);
        for (int k = 1; k <= 6; k++)
            used += (size_t)snprintf(json + used, sizeof json - used,
                                     ",{\"componentType\":5126,\"count\":%d,\"type\":\"VEC%d\"}", 2 - k % 2,
                                     (k + 1) / 2 == 2 ? 4 : 3);
        snprintf(json + used, sizeof json - used, "]}");
        const model_asked asked = {0};
        model m;
        model_error error = {.text = ""};
        const bool read = model_parse(json, strlen(json), false, NULL, &asked, &m, &error);
        const bool differ = strstr(error.text, "glTF: the instances of node 'row' differ in number") != NULL;
        if (differ != (most > least) || (read && differ))
            fail_msg("%d, %d, %d instances: %s", count[0], count[1], count[2], error.text);
        if (read)
            model_free(&m);
    }
}

#ifndef __SANITIZE_ADDRESS__
/* A small file that says it has much, with room for 64 MiB more, is refused for what it lacks, not for want of room. */
TEST(claims) {
    static const struct {
        const char *json, *sentence;
    } rows[] = {
        {ASSET "\"buffers\":[{\"byteLength\":1073741824,\"uri\":\"data:;base64,AAAA\"}]}",
         "glTF: cut short: buffer 0 has 3 bytes of 1073741824"},
        {ASSET MESH ",\"accessors\":[{\"componentType\":5126,\"count\":89478485,\"type\":\"VEC3\"}]}",
         "glTF: accessor 0 has 89478485 elements, more than the file has bytes"},
        {ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\","
                    "\"sparse\":{\"count\":268435456,\"indices\":{\"bufferView\":0,\"componentType\":5125},"
                    "\"values\":{\"bufferView\":0}}}]," VIEWS "}",
         "glTF: an accessor of 268435456 elements reaches beyond bufferView 0"},
        {ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"VEC3\"}],"
                    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":1073741824,\"byteStride\":252}],"
                    "\"buffers\":[{\"byteLength\":12,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAA\"}]}",
         "glTF: bufferView 0 reaches beyond its buffer"},
    };
    struct rlimit before, less;
    unsigned long pages = 0;
    FILE *in = fopen("/proc/self/statm", "r");
    if (in == NULL)
        skip();
    assert_int_equal(fscanf(in, "%lu", &pages), 1);
    fclose(in);
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    less = before;
    less.rlim_cur = (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE) + (64 << 20);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const model_asked asked = {0};
        model m;
        model_error error;
        assert_int_equal(setrlimit(RLIMIT_AS, &less), 0);
        const bool read = model_parse(rows[i].json, strlen(rows[i].json), false, NULL, &asked, &m, &error);
        assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
        assert_false(read);
        assert_string_equal(error.text, rows[i].sentence);
    }
}
#endif

/* Blanks of JSON, and a mark of the order of bytes, may stand in front; what else is no glTF. */
TEST(blanks_in_front) {
    static const struct {
        const char *front;
        bool read;
    } rows[] = {{" ", true},
                {"\t", true},
                {"\r", true},
                {"\n", true},
                {"\r\n \t", true},
                {"\xef\xbb\xbf", true},
                {"\xef\xbb\xbf\r\n", true},
                {"\v", false},
                {"\f", false},
                {"\xbf", false}};
    const model_asked asked = {0};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[64];
        model m;
        model_error error;
        snprintf(text, sizeof text, "%s%s\"scene\":0}", rows[i].front, ASSET);
        assert_false(model_parse(text, strlen(text), false, NULL, &asked, &m, &error)); /* it has nothing */
        assert_int_equal(strstr(error.text, "is neither") == NULL, rows[i].read);
    }
}

/* A .glb is what its .gltf is; cut anywhere it is refused, and whatever byte is changed it is read or refused. */
TEST(containers) {
    static made f;
    static unsigned char glb[8192];
    const model_asked asked = {0};
    const char json[] =
        ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}],"
                   "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60}],\"buffers\":[{\"byteLength\":60}]}";
    model m;
    model_error error;
    rng r = rng_make("glb");
    const uint32_t length = (sizeof json + 2) / 4 * 4;
    f = (made){.used = 0};
    put(&f, 0x46546C67, 4);
    put(&f, 2, 4);
    put(&f, 12 + 8 + length + 8 + 60, 4);
    put(&f, length, 4);
    put(&f, 0x4E4F534A, 4);
    for (uint32_t i = 0; i < length; i++)
        put(&f, i < sizeof json - 1 ? (unsigned char)json[i] : ' ', 1);
    put(&f, 60, 4);
    put(&f, 0x004E4942, 4);
    put_five(&f);
    assert_true(model_parse(f.bytes, f.used, false, NULL, &asked, &m, &error));
    assert_true(m.triangles == 1 && m.position[2][1] == 4.0);
    model_free(&m);
    for (size_t size = 0; size < f.used; size++)
        assert_false(model_parse(f.bytes, size, false, NULL, &asked, &m, &error));
    made longer = f; /* of chunks of binary data the first counts, and what else there is does not */
    for (uint32_t kind = 0x004E4942; kind <= 0x004E4943; kind++) {
        put(&longer, 60, 4);
        put(&longer, kind, 4);
        for (int i = 0; i < 15; i++)
            put_float(&longer, 7);
    }
    for (int i = 0; i < 4; i++)
        longer.bytes[8 + i] = (unsigned char)(longer.used >> 8 * i);
    assert_true(model_parse(longer.bytes, longer.used, false, NULL, &asked, &m, &error));
    assert_true(m.triangles == 1 && m.position[2][1] == 4.0);
    model_free(&m);
    for (uint64_t run = 0; run < test_cases(2000, 20000, 1000000); run++) {
        memcpy(glb, f.bytes, f.used);
        glb[rng_below(&r, f.used)] ^= (unsigned char)(1U << rng_below(&r, 8));
        if (model_parse(glb, f.used, false, NULL, &asked, &m, &error))
            model_free(&m);
        else
            assert_true(error.text[0] != '\0');
    }
}

/* Files beside it are found by their escaped names, and nothing else is opened. */
TEST(files_beside) {
    static const struct {
        const char *uri, *why;
    } rows[] = {
        {"two%20words.bin", NULL},
        {"./two words.bin", NULL},
        {"gone.bin", "its file 'gone.bin': No such file or directory"},
        {"../two words.bin", "names the file '../two words.bin', which is not in its folder"},
        {"%2e%2e/x", "names the file '../x', which is not in its folder"},
        {"/etc/passwd", "names the file '/etc/passwd', which is not in its folder"},
        {"http://a/b", "names the file 'http://a/b', which is not in its folder"},
    };
    const model_asked asked = {0};
    FILE *out = fopen(scratch_file("two words.bin"), "wb");
    assert_non_null(out);
    for (int i = 0; i < 36; i++)
        putc(i % 4 == 3 ? 0x40 : 0, out);
    assert_int_equal(fclose(out), 0);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        model m;
        model_error error;
        const char *path = scratch_file("m.gltf");
        out = fopen(path, "wb");
        assert_non_null(out);
        fprintf(
            out,
            "\xef\xbb\xbf " ASSET MESH ",\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
            "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,"
            "\"uri\":\"%s\"}]}",
            rows[i].uri);
        assert_int_equal(fclose(out), 0);
        assert_int_equal(model_read(path, &asked, &m, &error), rows[i].why == NULL);
        if (rows[i].why == NULL) {
            assert_true(m.position[1][2] == 2.0);
            model_free(&m);
        } else {
            assert_string_equal(error.text, rows[i].why);
        }
    }
}
