/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models that libassimp reads, from files put together here: places, names, units; damage has a sentence. */
#include "model/model.h"
#include "printed.h"
#include "system/dynload.h"

static const char stl[] = "solid wall\n"
                          "facet normal 0 0 1\nouter loop\nvertex 0 0 0.1\nvertex 4 0 0.1\nvertex 4 3 0.1\nendloop\n"
                          "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0.1\nvertex 4 3 0.1\nvertex 0 3 0.1\n"
                          "endloop\nendfacet\nendsolid wall\n";

/* A square as one face, and a point that it does not use. */
static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                          "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                          "0 0 0\n2 0 0\n2 2 0\n0 2 0\n9 9 9\n4 0 1 2 3\n";

static const char off[] = "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0.25\n3 0 1 2\n";

/* In centimetres, z up: a triangle at two nodes of one name, one of them mirrored, and at a third within another. */
static const char collada[] =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n"
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
    "<asset><unit meter=\"0.01\" name=\"centimeter\"/><up_axis>Z_UP</up_axis></asset>\n"
    "<library_effects><effect id=\"e\"><profile_COMMON><technique sid=\"c\"><lambert><diffuse>"
    "<color>1 1 1 1</color></diffuse></lambert></technique></profile_COMMON></effect></library_effects>\n"
    "<library_materials><material id=\"m\" name=\"oak\"><instance_effect url=\"#e\"/></material></library_materials>\n"
    "<library_geometries><geometry id=\"g\" name=\"leaf\"><mesh><source id=\"p\">"
    "<float_array id=\"pa\" count=\"9\">0 0 0 100 0 0 0 0 100</float_array><technique_common>"
    "<accessor source=\"#pa\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
    "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
    "<triangles material=\"s\" count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p>"
    "</triangles></mesh></geometry></library_geometries>\n"
    "<library_visual_scenes><visual_scene id=\"w\">"
    "<node id=\"door\" name=\"door\"><translate>100 0 0</translate>" /* the bind is the same for each */
    "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\"/>"
    "</technique_common></bind_material></instance_geometry></node>"
    "<node id=\"gate\" name=\"gate\"><scale>-1 1 1</scale><node id=\"wing\" name=\"wing\"><translate>0 0 "
    "200</translate>"
    "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" target=\"#m\"/>"
    "</technique_common></bind_material></instance_geometry></node></node>"
    "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#w\"/></scene></COLLADA>\n";

/* 30 by 40 of a unit of 10 cm. */
static const char fbx[] = "; FBX 7.4.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7400\n}\n"
                          "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n"
                          "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",1\n"
                          "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",10\n\t}\n}\n"
                          "Objects:  {\n\tGeometry: 1, \"Geometry::g\", \"Mesh\" {\n"
                          "\t\tVertices: *9 {\n\t\t\ta: 0,0,0,30,0,0,0,40,0\n\t\t}\n"
                          "\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t\tGeometryVersion: 124\n\t}\n"
                          "\tModel: 2, \"Model::leaf\", \"Mesh\" {\n\t\tVersion: 232\n\t}\n}\n"
                          "Connections:  {\n\tC: \"OO\",2,0\n\tC: \"OO\",1,2\n}\n";

/* 3 m by 4 m, in millimetres, z up. */
static const char ifc[] = "ISO-10303-21;\n"
                          "HEADER;\n"
                          "FILE_DESCRIPTION((''),'2;1');\n"
                          "FILE_NAME('','',(''),(''),'','','');\n"
                          "FILE_SCHEMA(('IFC2X3'));\n"
                          "ENDSEC;\n"
                          "DATA;\n"
                          "#1=IFCPROJECT('0000000000000000000001',#30,'p',$,$,$,$,(#2),#6);\n"
                          "#2=IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-5,#3,$);\n"
                          "#3=IFCAXIS2PLACEMENT3D(#4,$,$);\n"
                          "#4=IFCCARTESIANPOINT((0.,0.,0.));\n"
                          "#6=IFCUNITASSIGNMENT((#7));\n"
                          "#7=IFCSIUNIT(*,.LENGTHUNIT.,.MILLI.,.METRE.);\n"
                          "#8=IFCSITE('0000000000000000000002',#30,'site',$,$,#9,$,$,.ELEMENT.,$,$,$,$,$);\n"
                          "#9=IFCLOCALPLACEMENT($,#3);\n"
                          "#10=IFCRELAGGREGATES('0000000000000000000003',#30,$,$,#1,(#8));\n"
                          "#11=IFCBUILDINGELEMENTPROXY('0000000000000000000004',#30,'leaf',$,$,#9,#12,$,$);\n"
                          "#12=IFCPRODUCTDEFINITIONSHAPE($,$,(#13));\n"
                          "#13=IFCSHAPEREPRESENTATION(#2,'Body','SurfaceModel',(#14));\n"
                          "#14=IFCFACEBASEDSURFACEMODEL((#15));\n"
                          "#15=IFCCONNECTEDFACESET((#16));\n"
                          "#16=IFCFACE((#17));\n"
                          "#17=IFCFACEOUTERBOUND(#18,.T.);\n"
                          "#18=IFCPOLYLOOP((#4,#19,#20));\n"
                          "#19=IFCCARTESIANPOINT((3000.,0.,0.));\n"
                          "#20=IFCCARTESIANPOINT((0.,0.,4000.));\n"
                          "#21=IFCRELCONTAINEDINSPATIALSTRUCTURE('0000000000000000000005',#30,$,$,(#11),#8);\n"
                          "#30=IFCOWNERHISTORY(#31,#34,$,.ADDED.,$,$,$,0);\n"
                          "#31=IFCPERSONANDORGANIZATION(#32,#33,$);\n"
                          "#32=IFCPERSON($,'a',$,$,$,$,$,$);\n"
                          "#33=IFCORGANIZATION($,'b',$,$,$);\n"
                          "#34=IFCAPPLICATION(#33,'1','c','d');\n"
                          "ENDSEC;\n"
                          "END-ISO-10303-21;\n";

static const char *written(const char *name, const char *text) {
    const char *path = scratch_file(name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    return path;
}

static void must_read(const char *path, model *m) {
    static const model_asked asked = {.transforms = MODEL_EXACT};
    model_error error;
    if (!model_read(path, &asked, m, &error))
        fail_msg("%s: %s", path, error.text);
}

static void corners_are(const model *m, size_t triangle, const double want[3][3]) {
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) {
            const double got = m->position[m->triangle[triangle][k]][c];
            if (!(fabs(got - want[k][c]) <= 0x1p-20)) /* of a unit: the library's matrices are binary32 */
                fail_msg("triangle %zu, corner %d: %.9g is not %.9g", triangle, k, got, want[k][c]);
        }
}

/* The header of a file says of which IFC it is; the same file of another one is refused by that name. */
TEST(schemas) {
    static const struct {
        const char *name;
        bool read;
    } rows[] = {{"IFC2X3", true}, {"IFC2X2_FINAL", true}, {"IFC4", false}, {"IFC4X3_ADD2", false}, {"IFC5", false}};
    static const model_asked asked = {.transforms = MODEL_EXACT};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[sizeof ifc + 32], want[64];
        const char *schema = strstr(ifc, "IFC2X3");
        model m;
        model_error error = {.text = ""};
        snprintf(text, sizeof text, "%.*s%s%s", (int)(schema - ifc), ifc, rows[i].name, schema + 6);
        snprintf(want, sizeof want, "is of %s, and of IFC only IFC2X3 is read", rows[i].name);
        const bool read = model_read(written("schema.ifc", text), &asked, &m, &error);
        if (read != rows[i].read || (!read && strncmp(error.text, want, strlen(want)) != 0))
            fail_msg("%s: %s", rows[i].name, error.text);
        if (read)
            model_free(&m);
    }
}

TEST(plain) {
    static const struct {
        const char *name, *text;
        size_t triangles;
        double first[3][3];
    } rows[] = {{"a.stl", stl, 2, {{0, 0, 0.1}, {4, 0, 0.1}, {4, 3, 0.1}}},
                {"b.PLY", ply, 2, {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}},
                {"c.off", off, 1, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0.25}}}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        model m;
        must_read(written(rows[i].name, rows[i].text), &m);
        assert_int_equal(m.triangles, rows[i].triangles);
        assert_true(m.metres == 0.0);
        corners_are(&m, 0, rows[i].first);
        model_free(&m);
    }
}

/* (x, y, z) up z becomes (x, z, -y) up y. A mirrored triangle turns round, so that its front stays its front. */
TEST(nodes) {
    static const double door[3][3] = {{1, 0, 0}, {2, 0, 0}, {1, 1, 0}}, wing[3][3] = {{0, 2, 0}, {0, 3, 0}, {-1, 2, 0}};
    model m;
    must_read(written("d.dae", collada), &m);
    assert_int_equal(m.triangles, 2);
    assert_int_equal(m.surfaces, 2);
    assert_true(m.metres == 1.0);
    assert_string_equal(m.surface[m.of[0]].node, "door");
    assert_string_equal(m.surface[m.of[1]].node, "wing");
    assert_string_equal(m.surface[m.of[0]].material, "oak");
    assert_false(m.surface[m.of[0]].blended || m.surface[m.of[0]].two_sided);
    corners_are(&m, 0, door);
    corners_are(&m, 1, wing);
    model_free(&m);
}

/* A material is seen from both sides, see-through, both or neither. */
TEST(materials) {
    static const char clear[] = "<transparency><float>0.5</float></transparency>",
                      sides[] = "<extra><technique profile=\"GOOGLEEARTH\"><double_sided>1</double_sided></technique>"
                                "</extra>";
    static const char lambert[] = "</lambert></technique>";
    const char *at = strstr(collada, lambert);
    for (int k = 0; k < 4; k++) {
        char text[sizeof collada + sizeof clear + sizeof sides];
        model m;
        snprintf(text, sizeof text, "%.*s%s%s%s%s", (int)(at - collada), collada, k & 1 ? clear : "", lambert,
                 k & 2 ? sides : "", at + strlen(lambert));
        must_read(written("m.dae", text), &m);
        for (size_t i = 0; i < m.surfaces; i++)
            if (m.surface[i].blended != (k & 1) || m.surface[i].two_sided != k >> 1)
                fail_msg("%d: blended %d, two-sided %d", k, m.surface[i].blended, m.surface[i].two_sided);
        model_free(&m);
    }
}

/* Metres, and y up, whatever the file has. */
TEST(buildings) {
    static const double leaf[3][3] = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
    model m;
    must_read(written("d.ifc", ifc), &m);
    assert_int_equal(m.triangles, 1);
    assert_true(m.metres == 1.0);
    assert_non_null(strstr(m.surface[m.of[0]].node, "leaf"));
    corners_are(&m, 0, leaf);
    model_free(&m);
}

/* Axes of FBX: to the right, upwards, to the one who looks; a mirrored world keeps its fronts. */
TEST(axes) {
    static const struct {
        const char *said;
        double corner[3]; /* of (30, 40, 50), 10 cm each */
    } rows[] = {{"P: \"UpAxis\", \"int\", \"Integer\", \"\",1", {3, 4, 5}},
                {"P: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"FrontAxis\", \"int\", \"Integer\", \"\",1\n"
                 "\t\tP: \"FrontAxisSign\", \"int\", \"Integer\", \"\",-1",
                 {3, 5, -4}},
                {"P: \"UpAxis\", \"int\", \"Integer\", \"\",2", {4, 5, 3}}, /* front is 2, too */
                {"P: \"UpAxis\", \"int\", \"Integer\", \"\",1\n\t\tP: \"CoordAxisSign\", \"int\", \"Integer\", \"\",-1",
                 {-3, 4, 5}},
                {"P: \"UpAxis\", \"int\", \"Integer\", \"\",2\n\t\tP: \"UpAxisSign\", \"int\", \"Integer\", \"\",-1",
                 {4, -5, -3}}}; /* and turned over: what is up is down, and in front behind */
    static const char up[] = "P: \"UpAxis\", \"int\", \"Integer\", \"\",1", last[] = "0,40,0\n";
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char text[2048];
        const char *at = strstr(fbx, up), *corner = strstr(fbx, last);
        model m;
        snprintf(text, sizeof text, "%.*s%s%.*s30,40,50\n%s", (int)(at - fbx), fbx, rows[i].said,
                 (int)(corner - at) - (int)strlen(up), at + strlen(up), corner + strlen(last));
        must_read(written("h.fbx", text), &m);
        const double *got = m.position[m.triangle[0][i == 3 ? 1 : 2]];
        for (int k = 0; k < 3; k++)
            if (!(fabs(got[k] - rows[i].corner[k]) < 1e-6))
                fail_msg("row %zu: %g %g %g", i, got[0], got[1], got[2]);
        model_free(&m);
    }
}

/* Where both the file and the command say what a unit is, the model is told in the command's; where the file alone
 * does, in its own. */
TEST(units) {
    static const struct {
        const char *name, *text, *options, *said;
    } rows[] = {{"e.dae", collada, "", "surfaces, 4.243 m across"},
                {"e.dae", collada, "--unit m", "surfaces, 4.243 m across"},
                {"e.dae", collada, "--unit cm", "surfaces, 424.3 cm across"},
                {"e.ifc", ifc, "", "1 surface, 5 m across"},
                {"e.fbx", fbx, "", "1 surface, 5 m across"},
                {"e.fbx", fbx, "--unit cm", "1 surface, 500 cm across"},
                {"e.stl", stl, "--unit cm", "surface, 5 cm across"}, /* which says nothing of its own */
                {"e.stl", stl, "", "surface, 5 across"},
                {"e.gltf", NULL, "", "surfaces, 99.78 m across"},
                {"e.gltf", NULL, "--camera street",
                 "reversed, near 0.05, far 1000, perspective, nearest, float ieee, lengths in"},
                {"e.gltf", NULL, "--unit mm", "surfaces, 99780 mm across"},
                {"e.gltf", NULL, "--preset unreal --separation 1", "surfaces, 9978 cm across"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const char *path = rows[i].text != NULL ? written(rows[i].name, rows[i].text) : "tests/models/house.gltf";
        printed p = print_of("scene %s %s", path, rows[i].options);
        if (p.status != 0 || strstr(p.out, rows[i].said) == NULL)
            fail_msg("%s: %s%s", rows[i].options, p.out, p.errors);
        printed_free(&p);
    }
    printed p = print_of("scene tests/models/house.gltf --camera street --unit cm"); /* cameras move along */
    assert_non_null(strstr(p.out, "from camera 'street' at -2000 1700 5000"));
    assert_non_null(strstr(p.out, "near 5, far "));
    printed_free(&p);
}

TEST(refused) {
    static const struct {
        const char *name, *text, *said;
    } rows[] = {{"f.xyz", "hello", "must be glTF, OBJ or a kind that libassimp reads, got '.xyz'"},
                {"f.stl", "", "is neither glTF 2.0 (.glb, .gltf) nor, by its name, OBJ"},
                {"f.off", "OFF\n3 1 3\n0 0 071 0 0\n0 1 0.25\n3 0 1 2\n", "could not be read: libassimp broke down"},
                {"f.dae", "<COLLADA", "libassimp does not read it: "},
                {"f.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nend_header\n1\n2\n", ": "},
                {"f.ifc", "ISO-10303-21;\nHEADER;\n", "libassimp does not read it: "}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        printed p = print_of("scene %s", written(rows[i].name, rows[i].text));
        if (p.status != 2 || strstr(p.errors, rows[i].said) == NULL || strlen(p.out) > 0)
            fail_msg("%s: %d: %s", rows[i].name, p.status, p.errors);
        printed_free(&p);
    }
}
