/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/cmd_table/constants.h"
#include "quantity/cmd_table/request.h"

#include <math.h>
#include <string.h>

#include "camera/cmd/each_setup.h"
#include "report/number.h"
#include "shader/constants.h"

enum { LABEL = 24, DIGITS_32 = 9, DIGITS_Z = 6, DIGITS_READ = 7, DIGITS_01 = 5, DIGITS_OFF = 3, DIGITS_END = 7 };

/* Depth textures beside that of binary32, which stores what the shader has. */
enum { STORED = 2 };
static const char *const stored[STORED] = {"unorm16", "unorm24"};

/* Numbers of binary32, as doubles. */
typedef struct vector {
    double x, y, z, w;
} vector;

/* A depth on its way; NaN where it is not defined. */
typedef struct row {
    double z, clip_z, clip_w, ndc, window, eye, linear01, from_near;
    double read[STORED], depth_normals; /* eye depths, once they are stored */
    int ndc_digits, window_digits;      /* as many as it takes to see that 1 - 2^-24 is not 1 */
} row;

enum { CORNERS = 4 };
static const char *const corner_names[CORNERS] = {"top left", "top right", "bottom left", "bottom right"};

typedef struct corner {
    const char *name;
    double x, y, z;
} corner;

/* The depth that a trap reads, and by which share that is too much. */
typedef struct reading {
    double z, reads, relative, percent;
} reading;

typedef struct constants {
    each_setup each;
    const table_request *o;
    vector zbuffer, projection;
    double near_clip;
    texture_camera camera;
    double fov, aspect, to_right, to_top; /* NaN in orthographic projections */
    shader_corners corners;
    corner corner;
    row row;
    bool cancels; /* some row has a quotient of 0, */
    bool wraps;   /* or the far plane as DepthNormals has it */
    trap_row trap;
    size_t next_trap; /* the one that is looked at next */
    reading reading;
} constants;

/* ---- The camera -------------------------------------------------------------------------------------------------- */

/* No stored depth is asked about: the first format of a camera stands for all. */
static void keep_one_format(setups *all) {
    size_t kept = 0;
    char first[sizeof all->items->spec.format.name];
    for (size_t i = 0; i < all->count; i++) {
        const char *format = all->items[i].spec.format.name;
        if (i == 0 || all->cameras[i] != all->cameras[i - 1])
            strcpy(first, format);
        if (strcmp(first, format) != 0)
            continue;
        all->cameras[kept] = all->cameras[i];
        all->items[kept++] = all->items[i];
    }
    all->count = kept;
}

static int check(const setups *all) {
    for (size_t i = 0; i < all->count; i++) {
        const dp_mapping_row *mapping = dp_mapping_get(all->items[i].spec.mapping);
        if (mapping->curve != DP_CURVE_PERSPECTIVE)
            return option_error("mapping",
                                "must be one of " DP_MAPPING_NAMES_PERSPECTIVE " with --constants, got %s, whose depth "
                                "no projection matrix makes",
                                mapping->name);
    }
    return EXIT_FINE;
}

static int take_view(constants *c, size_t i) {
    const table_request *o = c->o;
    const int width = (int)o->camera.spec.width, height = (int)o->camera.spec.height;
    camera_spec view = o->camera.spec;
    if (view_vertical(camera_of(&o->camera, c->each.all.cameras[i]), width, height, &view.fov_y) != EXIT_FINE)
        return EXIT_USAGE;
    const char *wrong = camera_init(&c->camera, &c->each.all.items[i], &view);
    if (wrong != NULL)
        return usage_error("table: %s", wrong);
    c->fov = c->camera.ortho ? (double)NAN : view.fov_y; /* nothing says how wide an orthographic view is */
    c->aspect = c->camera.ortho ? (double)NAN : (double)width / height;
    return EXIT_FINE;
}

static void *next_setup(void *of, size_t i) {
    constants *c = of;
    if (!each_setup_go(&c->each, i))
        return NULL;
    const shader_constants s = shader_constants_of(c->each.setup);
    c->zbuffer = (vector){(double)s.zbuffer.x, (double)s.zbuffer.y, (double)s.zbuffer.z, (double)s.zbuffer.w};
    c->projection = (vector){(double)s.projection.flip, (double)s.projection.znear, (double)s.projection.zfar,
                             (double)s.projection.per_far};
    c->near_clip = (double)s.near_clip;
    c->next_trap = 0;
    c->cancels = c->wraps = false;
    take_view(c, i); /* cannot fail: constants_write() has seen to it */
    c->corners = shader_corners_of(&c->camera);
    c->to_right = c->camera.ortho ? (double)NAN : c->corners.to_right;
    c->to_top = c->camera.ortho ? (double)NAN : c->corners.to_top;
    return c;
}

static void *next_corner(void *of, size_t i) {
    constants *c = of;
    if (i == CORNERS || isnan(c->fov))
        return NULL;
    const double *ray = c->corners.ray[i];
    c->corner = (corner){corner_names[i], ray[0], ray[1], ray[2]};
    return &c->corner;
}

static void make_row(constants *c, double z) {
    shader_depth d;
    shader_depth_of(c->each.setup, z, &d); /* cannot fail: check() has seen to it */
    c->row = (row){.z = z,
                   .clip_z = (double)d.clip_z,
                   .clip_w = (double)d.clip_w,
                   .ndc = (double)d.ndc,
                   .window = (double)d.window,
                   .eye = (double)d.eye,
                   .linear01 = (double)d.linear01,
                   .from_near = (double)d.from_near,
                   .depth_normals = (double)shader_depth_normals_eye(c->each.setup, z)};
    c->row.ndc_digits = number_digits_within(1, 1 - fabs(c->row.ndc), DIGITS_Z, DIGITS_END);
    c->row.window_digits = number_digits_within(1, 1 - c->row.window, DIGITS_Z, DIGITS_END);
    for (int i = 0; i < STORED; i++) {
        dp_format format[2];
        dp_format_parse(stored[i], format);
        c->row.read[i] = (double)shader_stored_eye(c->each.setup, format, d.window);
        c->cancels = c->cancels || isinf(c->row.read[i]);
    }
    c->wraps = c->wraps || (c->row.depth_normals == 0 && z > c->each.setup->spec.zfar / 2);
    c->cancels = c->cancels || isinf(c->row.eye) || isinf(c->row.linear01) || isinf(c->row.from_near);
}

static void *next_row(void *of, size_t i) {
    constants *c = of;
    double z;
    if (!each_setup_depth(&c->each, i, &z))
        return NULL;
    make_row(c, z);
    return &c->row;
}

/* The same once more: text has them in a table of their own. */
static void *next_stored(void *of, size_t i) {
    constants *c = of;
    if (i == c->each.at.count)
        return NULL;
    make_row(c, depths_get(&c->each.at, i));
    return &c->row;
}

static void *next_trap(void *of, size_t i) {
    constants *c = of;
    const trap_row *trap;
    (void)i; /* some are none of this set-up */
    while ((trap = trap_get(c->next_trap++)) != NULL)
        if (!isnan(trap_reads(trap, c->each.setup, c->camera.half[1], depths_get(&c->each.at, 0)))) {
            c->trap = *trap;
            return c;
        }
    return NULL;
}

static void *next_reading(void *of, size_t i) {
    constants *c = of;
    if (i == c->each.at.count)
        return NULL;
    const double z = depths_get(&c->each.at, i), reads = trap_reads(&c->trap, c->each.setup, c->camera.half[1], z);
    const double off = (reads - z) / z;
    c->reading = (reading){z, reads, off, 100 * off};
    return &c->reading;
}

/* ---- Text -------------------------------------------------------------------------------------------------------- */

static void say_vector(page *p, const char *name, const vector *v) {
    page_note(p, name, "%s, %s, %s, %s", number_of(v->x, DIGITS_32).text, number_of(v->y, DIGITS_32).text,
              number_of(v->z, DIGITS_32).text, number_of(v->w, DIGITS_32).text);
}

static void say_camera(page *p, void *item) {
    const constants *c = item;
    const setup_fields *f = &c->each.fields;
    p->unit = f->unit;
    page_title(p, "%s%s%s, near %s, far %s, %s%s%s", f->preset != NULL ? f->preset : "", f->preset != NULL ? ": " : "",
               f->mapping, number_full(f->znear).text, number_full(f->zfar).text, f->projection,
               f->unit != NULL ? ", lengths in " : "", f->unit != NULL ? f->unit : "");
    say_vector(p, "_ZBufferParams", &c->zbuffer);
    say_vector(p, "_ProjectionParams", &c->projection);
    page_note(p, "UNITY_NEAR_CLIP_VALUE", "%s", number_full(c->near_clip).text);
    if (isnan(c->fov))
        return;
    page_note(p, "corner rays", "%s to the left and right, %s down and up at eye depth 1, fov %s",
              number_of(c->camera.half[0], DIGITS_Z).text, number_of(c->camera.half[1], DIGITS_Z).text,
              number_of(c->fov, DIGITS_Z).text);
    page_note(p, "corner vectors", "toRight %s, toTop %s: half the near plane", number_of(c->to_right, DIGITS_Z).text,
              number_of(c->to_top, DIGITS_Z).text);
    for (size_t i = 0; i < CORNERS; i++) {
        const double *ray = c->corners.ray[i], near = c->each.setup->spec.znear;
        page_note(p, i == 0 ? "  of the near plane" : "", "%s (%s, %s, %s)", corner_names[i],
                  number_of(ray[0] * near, DIGITS_Z).text, number_of(ray[1] * near, DIGITS_Z).text,
                  number_of(ray[2] * near, DIGITS_Z).text);
    }
}

/* Why there is a "-" or an infinity. */
static void say_rows(page *p, void *item) {
    const constants *c = item;
    const dp_setup *s = c->each.setup;
    if (s->spec.ortho)
        page_line(p, "orthographic: eye depth by LinearDepthToEyeDepth; Linear01Depth is of perspective%s",
                  s->spec.znear > 0   ? ""
                  : s->spec.znear < 0 ? ", and near must be above 0"
                                      : ", and near 0 makes its constants infinite");
    else if (isinf(s->spec.zfar))
        page_line(p, "Without a far plane there is no Linear01: %s, and a shader gets %s.",
                  s->reversed ? "x is infinite" : "x and y are infinite",
                  s->reversed ? "0, or NaN at a depth of 0" : "NaN");
    if (c->cancels)
        page_line(p, "inf: what is divided by is 0 in binary32, where d x + y or d z + w cancels");
}

static void say_stored_head(page *p, void *item) {
    (void)item;
    page_line(p, "eye depth as it is read back from a depth texture, and from DepthNormals:");
}

static void say_stored(page *p, void *item) {
    const constants *c = item;
    if (c->wraps)
        page_line(p, "0: EncodeFloatRG makes the camera of the far plane");
    if (c->each.setup->spec.znear > 0)
        output_char(p->out, '\n');
}

static void say_trap(page *p, void *item) {
    const trap_row *t = &((const constants *)item)->trap;
    page_title(p, "%s: %s", t->name, t->note);
    page_line(p, "%s; right: %s", t->source, t->right);
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static const column zbuffer_columns[] = {{FIELD(vector, x, "x", "")},
                                         {FIELD(vector, y, "y", "")},
                                         {FIELD(vector, z, "z", "1/scene")},
                                         {FIELD(vector, w, "w", "1/scene")},
                                         {.kind = COLUMN_END}};

static const column projection_columns[] = {{FIELD(vector, x, "x", "")},
                                            {FIELD(vector, y, "y", "scene")},
                                            {FIELD(vector, z, "z", "scene")},
                                            {FIELD(vector, w, "w", "1/scene")},
                                            {.kind = COLUMN_END}};

static const column corner_columns[] = {{FIELD(corner, name, "name", "")},
                                        {FIELD(corner, x, "x", "")},
                                        {FIELD(corner, y, "y", "")},
                                        {FIELD(corner, z, "z", "")},
                                        {.kind = COLUMN_END}};

static const column row_columns[] = {
    {FIELD(row, z, "z", "scene"), SHOWN("z", 9, DIGITS_Z), .brief = true},
    {FIELD(row, clip_z, "clip_z", "scene"), SHOWN("clip z", 11, DIGITS_Z), .brief = true},
    {FIELD(row, clip_w, "clip_w", "scene"), SHOWN("clip w", 8, DIGITS_Z), .brief = true},
    {FIELD(row, ndc, "ndc", ""), SHOWN("NDC z", 11, DIGITS_Z), .digits_at = offsetof(row, ndc_digits), .brief = true},
    {FIELD(row, window, "window", ""), SHOWN("window", 11, DIGITS_Z), .digits_at = offsetof(row, window_digits),
     .brief = true},
    {FIELD(row, eye, "eye", "scene"), SHOWN("eye depth", 10, DIGITS_Z), .brief = true},
    {FIELD(row, linear01, "linear01", ""), SHOWN("Linear01", 10, DIGITS_01), .brief = true},
    {FIELD(row, from_near, "from_near", ""), SHOWN("from near", 10, DIGITS_01), .brief = true},
    {FIELD(row, read[0], "d16", "scene")},
    {FIELD(row, read[1], "d24", "scene")},
    {FIELD(row, depth_normals, "depth_normals", "scene")},
    {.kind = COLUMN_END}};

static const column stored_columns[] = {
    {TEXT_FIELD(row, z, "z", 9, DIGITS_Z), .brief = true},
    {TEXT_FIELD(row, read[0], "D16", 12, DIGITS_READ), .brief = true},
    {TEXT_FIELD(row, read[1], "D24", 12, DIGITS_READ), .brief = true},
    {TEXT_FIELD(row, eye, "D32F", 12, DIGITS_READ), .brief = true},
    {TEXT_FIELD(row, depth_normals, "DepthNormals", 14, DIGITS_READ), .brief = true},
    {.kind = COLUMN_END}};

static const column reading_columns[] = {
    {FIELD(reading, z, "z", "scene"), SHOWN("z", 9, DIGITS_Z), .brief = true},
    {FIELD(reading, reads, "reads", "scene"), SHOWN("reads", 12, DIGITS_Z), .brief = true},
    {FIELD(reading, relative, "relative", "")},
    {TEXT_FIELD(reading, percent, "off by %", 10, DIGITS_OFF), .brief = true},
    {.kind = COLUMN_END}};

static const column trap_columns[] = {
    {FIELD(constants, trap.name, "name", "")},     {FIELD(constants, trap.note, "formula", "")},
    {FIELD(constants, trap.right, "right", "")},   {FIELD(constants, trap.source, "source", "")},
    {LIST("rows", reading_columns, next_reading)}, {.kind = COLUMN_END}};

static const column setup_report[] = {
    {FIELD(constants, each.fields.znear, "near", "scene")},
    {FIELD(constants, each.fields.zfar, "far", "scene")},
    {FIELD(constants, each.fields.projection, "projection", "")},
    {FIELD(constants, each.fields.mapping, "mapping", "")},
    {FIELD(constants, each.fields.unit, "unit", ""), .only = AS_JSON},
    {FIELD(constants, each.fields.preset, "preset", ""), .only = AS_JSON, .optional = true},
    {PART(constants, zbuffer, "zbuffer_params", zbuffer_columns), .only = AS_JSON},
    {PART(constants, projection, "projection_params", projection_columns), .only = AS_JSON},
    {FIELD(constants, near_clip, "near_clip_value", ""), .only = AS_JSON},
    {FIELD(constants, fov, "fov", "degrees"), .only = AS_JSON},
    {FIELD(constants, aspect, "aspect", ""), .only = AS_JSON},
    {FIELD(constants, to_right, "to_right", "scene"), .only = AS_JSON},
    {FIELD(constants, to_top, "to_top", "scene"), .only = AS_JSON},
    {LIST("corners", corner_columns, next_corner), .only = AS_JSON},
    {LIST("rows", row_columns, next_row), .notes = say_rows},
    {LIST(NULL, stored_columns, next_stored), .only = AS_TEXT, .head = say_stored_head, .notes = say_stored},
    EACH_PRESET_COLUMNS(constants),
    {LIST("traps", trap_columns, next_trap), .only = AS_TEXT | AS_JSON, .head = say_trap},
    {.kind = COLUMN_END}};

static const column columns[] = {{LIST("setups", setup_report, next_setup), .head = say_camera}, {.kind = COLUMN_END}};

int constants_write(const table_request *o) {
    enum { DEPTHS = 5 };
    constants c = {.each.rows = DEPTHS, .o = o};
    int status = each_setup_start(&c.each, &o->camera, &o->out);
    if (status == EXIT_FINE)
        keep_one_format(&c.each.all);
    if (status == EXIT_FINE)
        status = check(&c.each.all);
    if (status == EXIT_FINE)
        status = depths_in_binary32(&c.each.at);
    for (size_t i = 0; i < c.each.all.count && status == EXIT_FINE; i++)
        status = take_view(&c, i);
    const report_spec spec = {"table", columns, &c, .label = LABEL};
    return each_setup_write(&c.each, &spec, status);
}
