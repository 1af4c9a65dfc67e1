/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * glTF: what triangles a file holds and where, from files put together here; nodes against rational numbers, and
 * against plain binary32; each damage has its sentence.
 */
#include <gmp.h>

#include "gltf_made.h"

/* ---- Primitives -------------------------------------------------------------------------------------------------- */

TEST(topologies) {
    static const struct {
        int mode, component, count;
        uint32_t index[6];
        int triangles;
        uint32_t corner[3][3];
    } rows[] = {
        {4, 5121, 6, {0, 1, 2, 4, 3, 2}, 2, {{0, 1, 2}, {4, 3, 2}}},
        {4, 5123, 5, {4, 1, 0, 2, 2}, 1, {{4, 1, 0}}},
        {5, 5125, 5, {0, 1, 2, 3, 4}, 3, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}},
        {6, 5123, 5, {0, 1, 2, 3, 4}, 3, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}},
        {5, 0, 5, {0}, 3, {{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}},
        {4, 0, 5, {0}, 1, {{0, 1, 2}}},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        static made f;
        model m;
        const int size = rows[k].component == 5121 ? 1 : rows[k].component == 5123 ? 2 : 4;
        f = (made){.used = 0};
        put_five(&f);
        for (int i = 0; i < rows[k].count; i++)
            put(&f, rows[k].index[i], size);
        add(&f,
            ASSET "\"nodes\":[{\"mesh\":0,\"name\":\"n\"}],\"meshes\":[{\"name\":\"m\",\"primitives\":[{\"attributes\":"
                  "{\"POSITION\":0},\"mode\":%d,\"material\":0%s},{\"attributes\":{\"POSITION\":0},\"mode\":1}]}],"
                  "\"materials\":[{\"doubleSided\":true,\"alphaMode\":\"BLEND\"}],"
                  "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":5,\"type\":\"VEC3\"}",
            rows[k].mode, rows[k].component != 0 ? ",\"indices\":1" : "");
        if (rows[k].component != 0)
            add(&f, ",{\"bufferView\":1,\"componentType\":%d,\"count\":%d,\"type\":\"SCALAR\"}", rows[k].component,
                rows[k].count);
        add(&f,
            "],\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":%zu}],",
            f.used - 60);
        add_buffer(&f);
        add(&f, "}");
        must_read(&f, &m);
        assert_int_equal(m.triangles, rows[k].triangles);
        assert_memory_equal(m.triangle, rows[k].corner, (size_t)rows[k].triangles * sizeof *m.triangle);
        assert_true(m.position[3][0] == 3.0 && m.position[3][1] == 9.0);
        assert_int_equal(m.notes.lines, 1);
        assert_int_equal(m.surfaces, 1);
        assert_string_equal(m.surface[0].node, "n");
        assert_string_equal(m.surface[0].mesh, "m");
        assert_string_equal(m.surface[0].material, "");
        assert_true(m.surface[0].two_sided && m.surface[0].blended);
        model_free(&m);
    }
}

/* A material's sides and blending: masked ones write depths where they are there at all. */
TEST(materials) {
    static const struct {
        const char *json;
        bool two_sided, blended;
    } rows[] = {
        {"{}", false, false},
        {"{\"alphaMode\":\"OPAQUE\",\"doubleSided\":false}", false, false},
        {"{\"alphaMode\":\"MASK\",\"alphaCutoff\":0.25}", false, false},
        {"{\"alphaMode\":\"BLEND\"}", false, true},
        {"{\"alphaMode\":\"MASK\",\"doubleSided\":true}", true, false},
        {"{\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1}}}", false, false},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        static made f;
        model m;
        f = (made){.used = 0};
        put_five(&f);
        add(&f,
            ASSET "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},"
                  "\"material\":0}]}],\"materials\":[%s],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
                  "\"count\":5,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":60}],",
            rows[k].json);
        add_buffer(&f);
        add(&f, "}");
        must_read(&f, &m);
        assert_int_equal(m.surface[0].two_sided, rows[k].two_sided);
        assert_int_equal(m.surface[0].blended, rows[k].blended);
        model_free(&m);
    }
}

/* Quantized, interleaved and sparse positions. */
TEST(positions) {
    static const struct {
        int component, bytes;
        bool normalized;
        uint32_t stored[3];
        double meant[3];
    } rows[] = {
        {5120, 1, false, {0x80, 0x7F, 0xFF}, {-128, 127, -1}},
        {5120, 1, true, {0x80, 0x7F, 0xFF}, {-1, 1, -1.0 / 127}},
        {5121, 1, true, {0, 255, 51}, {0, 1, 0.2}},
        {5122, 2, false, {0x8000, 0x7FFF, 0xFFFE}, {-32768, 32767, -2}},
        {5122, 2, true, {0x8000, 0x7FFF, 0xFFFE}, {-1, 1, -2.0 / 32767}},
        {5123, 2, false, {1, 65535, 256}, {1, 65535, 256}},
        {5123, 2, true, {0, 65535, 13107}, {0, 1, 0.2}},
        {5126, 4, false, {0x3F800000, 0xC0490FDB, 0x00000001}, {1, -0x1.921fb6p1, 0x1p-149}},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        static made f;
        model m;
        f = (made){.used = 0};
        for (int vertex = 0; vertex < 4; vertex++)
            for (int i = 0; i < 4; i++) /* the fourth is none of them */
                put(&f, i < 3 ? rows[k].stored[(i + vertex) % 3] : 0x7F, rows[k].bytes);
        const size_t index = f.used;
        put(&f, 1, 1);
        put(&f, 3, 1);
        const size_t value = f.used;
        for (int i = 0; i < 6; i++)
            put(&f, rows[k].stored[0], rows[k].bytes);
        add(&f,
            ASSET
            "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":%d,\"count\":4,\"type\":\"VEC3\",\"normalized\":%s,"
            "\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":1,\"componentType\":5121},"
            "\"values\":{\"bufferView\":1,\"byteOffset\":%zu}}}],",
            rows[k].component, rows[k].normalized ? "true" : "false", value - index);
        add(&f,
            "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu,\"byteStride\":%d},{\"buffer\":0,\"byteOffset\":%zu,"
            "\"byteLength\":%zu}],",
            index, 4 * rows[k].bytes, index, f.used - index);
        add_buffer(&f);
        add(&f, "}");
        must_read(&f, &m);
        assert_int_equal(m.vertices, 4);
        for (int vertex = 0; vertex < 4; vertex++)
            for (int i = 0; i < 3; i++)
                assert_true(m.position[vertex][i] ==
                            (vertex % 2 == 1 ? rows[k].meant[0] : rows[k].meant[(i + vertex) % 3]));
        model_free(&m);
    }
}

/* ---- Nodes against rational numbers ------------------------------------------------------------------------------ */

typedef struct exact {
    mpq_t m[3][4];
} exact;

static void exact_init(exact *e) {
    for (int i = 0; i < 12; i++)
        mpq_init(e->m[i / 4][i % 4]);
}

static void exact_clear(exact *e) {
    for (int i = 0; i < 12; i++)
        mpq_clear(e->m[i / 4][i % 4]);
}

typedef struct parts {
    double t[3], q[4], s[3];
} parts;

/* sum += factor a b c */
static void add_product(mpq_t sum, double factor, double a, double b, double c) {
    mpq_t x, y;
    mpq_inits(x, y, NULL);
    mpq_set_d(x, factor);
    mpq_set_d(y, a);
    mpq_mul(x, x, y);
    mpq_set_d(y, b);
    mpq_mul(x, x, y);
    mpq_set_d(y, c);
    mpq_mul(x, x, y);
    mpq_add(sum, sum, x);
    mpq_clears(x, y, NULL);
}

/* As Khronos writes it: the rows of a rotation by x y z w, scaled. */
static void exact_of(exact *e, const parts *p) {
    const double x = p->q[0], y = p->q[1], z = p->q[2], w = p->q[3];
    const struct {
        double factor, a, b;
    } terms[3][3][2] = {{{{-2, y, y}, {-2, z, z}}, {{2, x, y}, {-2, z, w}}, {{2, x, z}, {2, y, w}}},
                        {{{2, x, y}, {2, z, w}}, {{-2, x, x}, {-2, z, z}}, {{2, y, z}, {-2, x, w}}},
                        {{{2, x, z}, {-2, y, w}}, {{2, y, z}, {2, x, w}}, {{-2, x, x}, {-2, y, y}}}};
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++) {
            mpq_set_d(e->m[row][column], row == column ? p->s[column] : 0.0);
            for (int k = 0; k < 2; k++)
                add_product(e->m[row][column], terms[row][column][k].factor, terms[row][column][k].a,
                            terms[row][column][k].b, p->s[column]);
        }
        mpq_set_d(e->m[row][3], p->t[row]);
    }
}

/* to = outer (inner, 1): a point, or column k of a matrix. */
static void exact_times(const exact *outer, mpq_t from[3], bool point, mpq_t to[3]) {
    mpq_t x;
    mpq_init(x);
    for (int row = 0; row < 3; row++) {
        mpq_set(to[row], outer->m[row][3]);
        if (!point)
            mpq_set_ui(to[row], 0, 1);
        for (int k = 0; k < 3; k++) {
            mpq_mul(x, outer->m[row][k], from[k]);
            mpq_add(to[row], to[row], x);
        }
    }
    mpq_clear(x);
}

static parts random_parts(rng *r) {
    parts p;
    double length = 0.0;
    for (int i = 0; i < 4; i++) {
        p.q[i] = rng_uniform(r, -1, 1);
        length = hypot(length, p.q[i]);
    }
    for (int i = 0; i < 4; i++)
        p.q[i] = (double)(float)(p.q[i] / length);
    for (int i = 0; i < 3; i++) {
        p.t[i] = rng_uniform(r, -1000, 1000);
        p.s[i] = rng_log(r, 0.01, 100) * (rng_below(r, 8) == 0 ? -1 : 1);
    }
    return p;
}

static void add_parts(made *f, const parts *p) {
    add(f, "\"translation\":[%.17g,%.17g,%.17g],\"rotation\":[%.17g,%.17g,%.17g,%.17g],\"scale\":[%.17g,%.17g,%.17g]",
        p->t[0], p->t[1], p->t[2], p->q[0], p->q[1], p->q[2], p->q[3], p->s[0], p->s[1], p->s[2]);
}

/* A triangle below a chain of nodes; the first is the root. */
static void make_chain(made *f, const parts *p, int nodes, const double corner[3][3]) {
    f->used = 0;
    f->json[0] = '\0';
    for (int i = 0; i < 9; i++)
        put_float(f, corner[i / 3][i % 3]);
    add(f, ASSET "\"scene\":1,\"scenes\":[{},{\"nodes\":[%d]}],\"nodes\":[", nodes - 1);
    for (int i = 0; i < nodes; i++) { /* the last row is the root */
        add(f, "%s{", i == 0 ? "" : ",");
        add_parts(f, &p[nodes - 1 - i]);
        if (i == 0)
            add(f, ",\"mesh\":0}");
        else
            add(f, ",\"children\":[%d]}", i - 1);
    }
    add(f,
        "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],");
    add_buffer(f);
    add(f, "}");
}

/* A coordinate in the world: the double nearest to the rational one, or beside it where that is all but half-way. */
static void judge(tally *t, mpq_t truth, double got) {
    mpq_t off, half;
    mpq_inits(off, half, NULL);
    mpq_set_d(off, got);
    mpq_sub(off, off, truth);
    mpq_abs(off, off);
    mpq_set_d(half, 0.5 * (nextafter(fabs(got), HUGE_VAL) - fabs(got)) * (1.0 + 0x1p-20));
    TALLY(t, mpq_cmp(off, half) <= 0, "%.17g is off", got);
    mpq_clears(off, half, NULL);
}

TEST(nodes_are_exact) {
    static made f;
    rng r = rng_make("nodes");
    tally t = {.name = "world coordinates"};
    for (uint64_t run = 0; run < test_cases(50, 1000, 20000); run++) {
        parts p[4];
        double corner[3][3];
        const int nodes = 1 + (int)rng_below(&r, 4);
        bool mirrored = false;
        model m;
        for (int i = 0; i < nodes; i++) {
            p[i] = random_parts(&r);
            mirrored = mirrored != (p[i].s[0] * p[i].s[1] * p[i].s[2] < 0.0);
        }
        for (int i = 0; i < 9; i++)
            corner[i / 3][i % 3] = (double)(float)rng_uniform(&r, -100, 100);
        make_chain(&f, p, nodes, corner);
        must_read(&f, &m);
        assert_int_equal(m.triangles, 1);
        assert_int_equal(m.triangle[0][1], mirrored ? 2 : 1);
        exact e;
        mpq_t at[3], next[3];
        exact_init(&e);
        for (int i = 0; i < 3; i++)
            mpq_inits(at[i], next[i], NULL);
        for (int vertex = 0; vertex < 3; vertex++) {
            for (int i = 0; i < 3; i++)
                mpq_set_d(at[i], corner[vertex][i]);
            for (int i = nodes - 1; i >= 0; i--) {
                exact_of(&e, &p[i]);
                exact_times(&e, at, true, next);
                for (int k = 0; k < 3; k++)
                    mpq_swap(at[k], next[k]);
            }
            for (int i = 0; i < 3; i++)
                judge(&t, at[i], m.position[vertex][i]);
        }
        for (int i = 0; i < 3; i++)
            mpq_clears(at[i], next[i], NULL);
        exact_clear(&e);
        model_free(&m);
    }
    tally_end(&t);
}

/* ---- Nodes against binary32, step by step ------------------------------------------------------------------------ */

/* Products and sums in the order of transform.h, each in a float of its own. */
static void single_of(float m[3][4], const parts *p) {
    const float x = (float)p->q[0], y = (float)p->q[1], z = (float)p->q[2], w = (float)p->q[3];
    const float xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, zx = z * x, xw = x * w, yw = y * w,
                zw = z * w;
    const float squares[3] = {yy + zz, zz + xx, xx + yy};
    const float rotation[3][3] = {{1.0F - 2.0F * squares[0], 2.0F * (xy - zw), 2.0F * (zx + yw)},
                                  {2.0F * (xy + zw), 1.0F - 2.0F * squares[1], 2.0F * (yz - xw)},
                                  {2.0F * (zx - yw), 2.0F * (yz + xw), 1.0F - 2.0F * squares[2]}};
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            m[row][column] = rotation[row][column] * (float)p->s[column];
        m[row][3] = (float)p->t[row];
    }
}

static void single_times(float outer[3][4], float inner[3][4]) {
    float out[3][4];
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) {
            const float a = outer[row][0] * inner[0][column], b = outer[row][1] * inner[1][column],
                        c = outer[row][2] * inner[2][column];
            const float sum = a + b;
            out[row][column] = sum + c;
            if (column == 3)
                out[row][column] = out[row][column] + outer[row][3];
        }
    memcpy(inner, out, sizeof out);
}

TEST(nodes_in_binary32) {
    static made f;
    rng r = rng_make("single");
    tally t = {.name = "binary32 coordinates"};
    for (uint64_t run = 0; run < test_cases(50, 1000, 20000); run++) {
        parts p[2] = {random_parts(&r), random_parts(&r)};
        double corner[3][3];
        float outer[3][4], inner[3][4];
        model m;
        model_error error;
        for (int i = 0; i < 9; i++)
            corner[i / 3][i % 3] = (double)(float)rng_uniform(&r, -100, 100);
        make_chain(&f, p, 2, corner);
        assert_true(read_made(&f, MODEL_BINARY32, &m, &error));
        single_of(outer, &p[0]);
        single_of(inner, &p[1]);
        single_times(outer, inner);
        for (int vertex = 0; vertex < 3; vertex++)
            for (int row = 0; row < 3; row++) {
                const float a = inner[row][0] * (float)corner[vertex][0], b = inner[row][1] * (float)corner[vertex][1],
                            c = inner[row][2] * (float)corner[vertex][2];
                const float ab = a + b;
                const float abc = ab + c;
                const float want = abc + inner[row][3];
                TALLY(&t, m.position[vertex][row] == (double)want, "%a is %a", m.position[vertex][row], (double)want);
            }
        model_free(&m);
    }
    tally_end(&t);
}

/* ---- Instances, matrices, cameras -------------------------------------------------------------------------------- */

TEST(instances) {
    static made f;
    model m;
    f = (made){.used = 0};
    put_five(&f);
    const double t[3][3] = {{0, 0, 0}, {10, 0, 0}, {0, 20, 0}};
    for (int i = 0; i < 9; i++)
        put_float(&f, t[i / 3][i % 3]);
    for (int i = 0; i < 9; i++)
        put_float(&f, i / 3 == 2 && i % 3 == 0 ? -2 : 1);
    add(&f, ASSET
        "\"extensionsRequired\":[\"EXT_mesh_gpu_instancing\",\"KHR_materials_unlit\"],"
        "\"nodes\":[{\"mesh\":0,\"translation\":[0,0,5],\"extensions\":{\"EXT_mesh_gpu_instancing\":"
        "{\"attributes\":{\"TRANSLATION\":1,\"SCALE\":2}}}}],\"meshes\":[{\"primitives\":[{\"attributes\":"
        "{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60},{\"buffer\":0,\"byteOffset\":60,\"byteLength\":72}],");
    add_buffer(&f);
    add(&f, "}");
    must_read(&f, &m);
    assert_int_equal(m.triangles, 3);
    const double want[3][3] = {{2, 4, 5}, {12, 4, 5}, {-4, 24, 5}};
    for (int i = 0; i < 3; i++)
        assert_memory_equal(m.position[3 * i + 2], want[i], sizeof want[i]);
    assert_int_equal(m.triangle[1][1], 4);
    assert_int_equal(m.triangle[2][1], 8); /* mirrored */
    assert_int_equal(m.surfaces, 1);       /* one node: one surface */
    model_free(&m);
}

TEST(cameras) {
    static made f;
    model m;
    f = (made){.used = 0};
    put_five(&f);
    add(&f, ASSET
        "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"name\":\"eye\",\"rotation\":[0,0.7071067811865476,0,"
        "0.7071067811865476],\"translation\":[1,2,3]},{\"camera\":1,\"matrix\":[2,0,0,0,0,2,0,0,0,0,2,0,4,5,6,1]}],"
        "\"animations\":[{\"channels\":[{\"target\":{\"node\":0}},{\"target\":{\"node\":0}},{\"target\":{\"node\":2}},"
        "{\"target\":{\"node\":9}}]}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1.5707963267948966,\"znear\":0.25}},"
        "{\"name\":\"map\",\"type\":\"orthographic\",\"orthographic\":{\"xmag\":8,\"ymag\":5,\"znear\":1,\"zfar\":9}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[{}]}]}],\"accessors\":"
        "[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":60}],");
    add_buffer(&f);
    add(&f, "}");
    must_read(&f, &m);
    assert_int_equal(m.cameras, 2);
    assert_int_equal(m.notes.animated, 2);
    assert_int_equal(m.notes.morphed, 1);
    const model_camera *c = &m.camera[0];
    assert_string_equal(c->name, "eye");
    assert_false(c->ortho);
    assert_true(c->eye[0] == 1 && c->eye[1] == 2 && c->eye[2] == 3 && c->znear == 0.25 && isinf(c->zfar));
    assert_relative(c->fov_y, 90, 1e-15);
    assert_scene(c->ahead[0], -1, 1e-15);
    assert_scene(c->ahead[2], 0, 1e-15);
    assert_scene(c->up[1], 1, 1e-15);
    c = &m.camera[1];
    assert_string_equal(c->name, "map");
    assert_true(c->ortho && c->znear == 1 && c->zfar == 9 && c->ahead[2] == -1 && c->eye[2] == 6);
    model_free(&m);
}
