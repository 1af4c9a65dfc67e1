/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "svg.h"

#include <cairo.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include "support.h"
#include "svg_letters.h"

enum { IDS = 4096 };

typedef struct matrix {
    double a, b, c, d, e, f;
} matrix;

static const matrix identity = {1, 0, 0, 1, 0, 0};
static const svg_box nothing = {INFINITY, INFINITY, -INFINITY, -INFINITY};

/* A mark takes this from the elements around it. */
typedef struct around {
    matrix to_page;
    svg_box clip;
    svg_colour fill;
} around;

typedef struct reader {
    svg *out;
    size_t room, id_count;
    xmlNode *ids[IDS];
    const svg_letters *letters;
} reader;

/* ---- Attributes -------------------------------------------------------------------------------------------------- */

/* A property of an element, as an attribute of its own or within its style; "" when it has none. */
static const char *property(xmlNode *node, const char *name, char *out, size_t size) {
    xmlChar *own = xmlGetProp(node, (const xmlChar *)name), *style = xmlGetProp(node, (const xmlChar *)"style");
    const size_t length = strlen(name);
    snprintf(out, size, "%s", own != NULL ? (const char *)own : "");
    for (const char *p = (const char *)style; p != NULL && *p != '\0' && own == NULL;) {
        p += strspn(p, " ;");
        const size_t end = strcspn(p, ";");
        if (strncmp(p, name, length) == 0 && p[length] == ':')
            snprintf(out, size, "%.*s", (int)(end - length - 1), p + length + 1);
        p += end;
    }
    xmlFree(own);
    xmlFree(style);
    return out;
}

static double number(xmlNode *node, const char *name, double without) {
    char text[64];
    return *property(node, name, text, sizeof text) != '\0' ? strtod(text, NULL) : without;
}

static bool is(const xmlNode *node, const char *name) {
    return node->type == XML_ELEMENT_NODE && strcmp((const char *)node->name, name) == 0;
}

static svg_colour colour_of(xmlNode *node, const char *paint, const char *opacity) {
    char text[64];
    double v[3];
    if (sscanf(property(node, paint, text, sizeof text), "rgb(%lf%%,%lf%%,%lf%%)", &v[0], &v[1], &v[2]) != 3)
        return (svg_colour){0, 0, 0, 0};
    return (svg_colour){v[0] / 100, v[1] / 100, v[2] / 100, number(node, opacity, 1)};
}

static matrix matrix_of(xmlNode *node, const char *name) {
    char text[128];
    matrix m = identity;
    if (*property(node, name, text, sizeof text) != '\0' &&
        sscanf(text, "matrix(%lf,%lf,%lf,%lf,%lf,%lf)", &m.a, &m.b, &m.c, &m.d, &m.e, &m.f) != 6)
        fail_msg("a transform that is no matrix: %s", text);
    return m;
}

static svg_point apply(const matrix *m, double x, double y, bool starts) {
    return (svg_point){m->a * x + m->c * y + m->e, m->b * x + m->d * y + m->f, starts};
}

static matrix compose(const matrix *o, const matrix *i) {
    const svg_point x = apply(o, i->a, i->b, false), y = apply(o, i->c, i->d, false), at = apply(o, i->e, i->f, false);
    return (matrix){x.x - o->e, x.y - o->f, y.x - o->e, y.y - o->f, at.x, at.y};
}

/* The element that "#id" or "url(#id)" means. */
static xmlNode *referred(const reader *r, const char *reference) {
    const char *id = strchr(reference, '#');
    const size_t length = id != NULL ? strcspn(id + 1, ")") : 0;
    for (size_t i = 0; i < r->id_count && length > 0; i++) {
        xmlChar *own = xmlGetProp(r->ids[i], (const xmlChar *)"id");
        const bool same = strlen((const char *)own) == length && strncmp((const char *)own, id + 1, length) == 0;
        xmlFree(own);
        if (same)
            return r->ids[i];
    }
    fail_msg("'%s' refers to nothing", reference);
    return NULL;
}

static void gather_ids(reader *r, xmlNode *node) {
    for (; node != NULL; node = node->next) {
        if (node->type == XML_ELEMENT_NODE && xmlHasProp(node, (const xmlChar *)"id") != NULL && r->id_count < IDS)
            r->ids[r->id_count++] = node;
        gather_ids(r, node->children);
    }
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static void widen(svg_box *b, double x, double y) {
    b->x0 = fmin(b->x0, x);
    b->y0 = fmin(b->y0, y);
    b->x1 = fmax(b->x1, x);
    b->y1 = fmax(b->y1, y);
}

static void read_path(svg_mark *mark, const char *d, const matrix *m) {
    size_t room = 4;
    for (const char *p = d; *p != '\0'; p++)
        room += strchr("MLC", *p) != NULL;
    mark->points = calloc(room, sizeof *mark->points);
    mark->box = nothing;
    assert_non_null(mark->points);
    while (*(d += strspn(d, " ")) != '\0') {
        const char command = *d++;
        const int pairs = command == 'C' ? 3 : command == 'Z' ? 0 : 1;
        double x = 0, y = 0;
        if (strchr("MLCZ", command) == NULL)
            fail_msg("the path command '%c' is not known", command);
        for (int i = 0, used = 0; i < pairs; i++, d += used)
            assert_int_equal(sscanf(d, " %lf %lf%n", &x, &y, &used), 2);
        mark->curved = mark->curved || command == 'C';
        if (command != 'Z') {
            const svg_point at = apply(m, x, y, command == 'M');
            const bool lone = command == 'M' && d[strspn(d, " ")] == '\0'; /* what closing a path leaves behind */
            if (!lone)
                mark->points[mark->count++] = at;
            widen(&mark->box, at.x, at.y);
        }
    }
}

static svg_mark *add(reader *r, svg_kind kind, const around *within) {
    svg *s = r->out;
    if (s->count == r->room) {
        r->room = 2 * r->room + 256;
        s->marks = realloc(s->marks, r->room * sizeof *s->marks);
        assert_non_null(s->marks);
    }
    s->marks[s->count] = (svg_mark){.kind = kind, .clip = within->clip, .box = nothing};
    return &s->marks[s->count++];
}

static void read_image(reader *r, svg_mark *mark, const char *fill, const matrix *m) {
    xmlNode *pattern = referred(r, fill);
    const matrix own = matrix_of(pattern, "patternTransform"), all = compose(m, &own);
    for (xmlNode *use = pattern->children; use != NULL; use = use->next) {
        char reference[64];
        if (!is(use, "use"))
            continue;
        xmlNode *image = referred(r, property(use, "href", reference, sizeof reference));
        xmlChar *data = xmlGetProp(image, (const xmlChar *)"href");
        assert_non_null(data);
        mark->pixels = svg_pixels((const char *)data, &mark->columns, &mark->rows);
        xmlFree(data);
    }
    const svg_point from = apply(&all, 0, 0, true), to = apply(&all, mark->columns, mark->rows, true);
    const svg_box whole = {from.x, from.y, to.x, to.y};
    mark->kind = SVG_IMAGE;
    if (!svg_inside(whole, mark->box, 0.1) || !svg_inside(mark->box, whole, 0.1))
        fail_msg("an image does not fill its place");
}

static void read_shape(reader *r, xmlNode *node, const around *within) {
    const matrix own = matrix_of(node, "transform"), all = compose(&within->to_page, &own);
    svg_mark *mark = add(r, SVG_PATH, within);
    char text[256];
    if (is(node, "rect")) {
        const double x = number(node, "x", 0), y = number(node, "y", 0);
        const double w = number(node, "width", 0), h = number(node, "height", 0);
        snprintf(text, sizeof text, "M %.17g %.17g L %.17g %.17g L %.17g %.17g L %.17g %.17g Z", x, y, x + w, y, x + w,
                 y + h, x, y + h);
        read_path(mark, text, &all);
    } else {
        xmlChar *d = xmlGetProp(node, (const xmlChar *)"d");
        assert_non_null(d);
        read_path(mark, (const char *)d, &all);
        xmlFree(d);
    }
    mark->fill = colour_of(node, "fill", "fill-opacity");
    mark->stroke = colour_of(node, "stroke", "stroke-opacity");
    mark->width = mark->stroke.a > 0 ? number(node, "stroke-width", 1) : 0;
    property(node, "stroke-dasharray", text, sizeof text);
    for (char *rest = NULL, *p = strtok_r(text, " ,", &rest); p != NULL; p = strtok_r(NULL, " ,", &rest))
        if (mark->dash_count < SVG_DASHES)
            mark->dash[mark->dash_count++] = strtod(p, NULL);
    if (strncmp(property(node, "fill", text, sizeof text), "url(", 4) == 0)
        read_image(r, mark, text, &all);
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

/* The first path within an element that is one letter. */
static xmlNode *outline_in(xmlNode *node) {
    for (xmlNode *n = node->children; n != NULL; n = n->next)
        if (is(n, "path"))
            return n;
    return NULL;
}

static void read_letter(reader *r, xmlNode *use, svg_mark *mark, const matrix *m) {
    char reference[64];
    xmlNode *outline = outline_in(referred(r, property(use, "href", reference, sizeof reference)));
    xmlChar *d = outline != NULL ? xmlGetProp(outline, (const xmlChar *)"d") : NULL;
    const svg_point at = apply(m, number(use, "x", 0), number(use, "y", 0), true);
    if (mark->text[0] == '\0')
        mark->at = at;
    assert_non_null(d);
    if (*d == '\0') {
        snprintf(mark->text + strlen(mark->text), sizeof mark->text - strlen(mark->text), " ");
    } else {
        const svg_letter *letter = svg_letter_find(r->letters, (const char *)d);
        svg_mark ink = {.count = 0};
        if (letter == NULL)
            fail_msg("a letter behind '%s' of no known size or kind", mark->text);
        if (mark->size > 0 && (letter->font.size != mark->size || letter->font.bold != mark->bold))
            fail_msg("one word in two fonts, '%s'", mark->text);
        mark->size = letter->font.size;
        mark->bold = letter->font.bold;
        snprintf(mark->text + strlen(mark->text), sizeof mark->text - strlen(mark->text), "%s", letter->text);
        read_path(&ink, (const char *)d, &(matrix){m->a, m->b, m->c, m->d, at.x, at.y});
        widen(&mark->box, ink.box.x0, ink.box.y0);
        widen(&mark->box, ink.box.x1, ink.box.y1);
        free(ink.points);
    }
    xmlFree(d);
}

static void read_words(reader *r, xmlNode *group, const around *within) {
    svg_mark *mark = NULL;
    for (xmlNode *n = group->children; n != NULL; n = n->next) {
        if (!is(n, "use"))
            continue;
        if (mark == NULL)
            mark = add(r, SVG_WORDS, within);
        read_letter(r, n, mark, &within->to_page);
        mark->fill = within->fill;
    }
}

/* ---- The page ---------------------------------------------------------------------------------------------------- */

static svg_box clip_of(reader *r, xmlNode *node, const around *within) {
    char reference[64];
    if (*property(node, "clip-path", reference, sizeof reference) == '\0')
        return within->clip;
    svg_mark shape = {.count = 0};
    xmlNode *path = outline_in(referred(r, reference));
    assert_non_null(path);
    xmlChar *d = xmlGetProp(path, (const xmlChar *)"d");
    read_path(&shape, (const char *)d, &within->to_page);
    xmlFree(d);
    free(shape.points);
    return (svg_box){fmax(shape.box.x0, within->clip.x0), fmax(shape.box.y0, within->clip.y0),
                     fmin(shape.box.x1, within->clip.x1), fmin(shape.box.y1, within->clip.y1)};
}

static void note(xmlNode *node, char out[SVG_NOTE]) {
    xmlChar *content = xmlNodeGetContent(node);
    snprintf(out, SVG_NOTE, "%s", (const char *)content);
    xmlFree(content);
}

/* Whatever is drawn in a way that is not known here fails the test, lest it goes unseen. */
static void walk(reader *r, xmlNode *parent, const around *within) {
    bool words = false;
    for (xmlNode *n = parent->children; n != NULL; n = n->next) {
        if (n->type != XML_ELEMENT_NODE || is(n, "defs"))
            continue;
        if (is(n, "g")) {
            const matrix own = matrix_of(n, "transform");
            around inner = {compose(&within->to_page, &own), clip_of(r, n, within),
                            colour_of(n, "fill", "fill-opacity")};
            walk(r, n, &inner);
        } else if (is(n, "path") || is(n, "rect")) {
            read_shape(r, n, within);
        } else if (is(n, "title")) {
            note(n, r->out->title);
        } else if (is(n, "desc")) {
            note(n, r->out->description);
        } else if (is(n, "metadata")) {
            note(n, r->out->metadata);
        } else if (is(n, "use")) {
            words = true;
        } else {
            fail_msg("an element <%s> that is not known", (const char *)n->name);
        }
    }
    if (words)
        read_words(r, parent, within);
}

svg *svg_read(const void *bytes, size_t size, const svg_font *fonts, size_t font_count) {
    xmlDoc *doc = xmlReadMemory(bytes, (int)size, "drawn.svg", NULL, XML_PARSE_NONET | XML_PARSE_HUGE);
    reader *r = calloc(1, sizeof *r);
    assert_non_null(r);
    if (doc == NULL)
        fail_msg("not a well-formed SVG");
    xmlNode *root = xmlDocGetRootElement(doc);
    r->out = calloc(1, sizeof *r->out);
    assert_non_null(r->out);
    r->out->width = number(root, "width", 0);
    r->out->height = number(root, "height", 0);
    r->letters = svg_letters_of(fonts, font_count);
    gather_ids(r, root);
    const around page = {identity, {0, 0, r->out->width, r->out->height}, {0, 0, 0, 0}};
    walk(r, root, &page);
    xmlFreeDoc(doc);
    svg *out = r->out;
    free(r);
    return out;
}

void svg_free(svg *s) {
    for (size_t i = 0; s != NULL && i < s->count; i++) {
        free(s->marks[i].points);
        free(s->marks[i].pixels);
    }
    free(s != NULL ? s->marks : NULL);
    free(s);
}

double svg_middle_x(svg_box b) {
    return (b.x0 + b.x1) / 2;
}

double svg_middle_y(svg_box b) {
    return (b.y0 + b.y1) / 2;
}

bool svg_inside(svg_box a, svg_box b, double slack) {
    return a.x0 >= b.x0 - slack && a.y0 >= b.y0 - slack && a.x1 <= b.x1 + slack && a.y1 <= b.y1 + slack;
}

uint32_t svg_rgb(svg_colour c) {
    return (uint32_t)lrint(c.r * 255) << 16 | (uint32_t)lrint(c.g * 255) << 8 | (uint32_t)lrint(c.b * 255);
}
