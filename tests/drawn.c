/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "drawn.h"

#include <sys/wait.h>
#include <unistd.h>

#include "drawn_parts.h"
#include "support.h"

/* The palette of Okabe and Ito 2008, in the order of each theme. */
const drawn_theme drawn_light = {0xFFFFFF,
                                 0x1A1D21,
                                 0x4F5660,
                                 0x7A828C,
                                 0xE4E7EB,
                                 0xEDEFF2,
                                 {0x0072B2, 0xD55E00, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0x000000, 0xF0E442},
                                 2,
                                 "light"};
const drawn_theme drawn_dark = {0x14171C,
                                0xECEFF3,
                                0xAEB6C0,
                                0x7C8591,
                                0x2A3038,
                                0x22272E,
                                {0x56B4E9, 0xE69F00, 0x009E73, 0xCC79A7, 0xF0E442, 0xD55E00, 0xF5F5F5, 0x0072B2},
                                2,
                                "dark"};
const drawn_theme drawn_print = {0xFFFFFF,
                                 0x000000,
                                 0x000000,
                                 0x000000,
                                 0xD0D0D0,
                                 0xE8E8E8,
                                 {0x000000, 0xD55E00, 0x0072B2, 0x009E73, 0xCC79A7, 0xE69F00, 0x56B4E9, 0xF0E442},
                                 1.8,
                                 "print"};

void drawn_px_at(double got, double want, double slack, const char *what, const char *file, int line) {
    if (fabs(got - want) <= slack)
        return;
    print_error("%s lies at %.2f px, should at %.2f, give or take %.2f\n", what, got, want, slack);
    _fail(file, line);
}

/* ---- The program ------------------------------------------------------------------------------------------------- */

static char folder[256];

static void remove_folder(void) {
    char command[320];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    if (folder[0] != '\0' && system(command) != 0)
        fprintf(stderr, "%s is left behind\n", folder);
}

const char *drawn_folder(void) {
    if (folder[0] == '\0') {
        const char *temporary = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%.200s/depthprec.XXXXXX", temporary != NULL ? temporary : "/tmp");
        assert_non_null(mkdtemp(folder));
        atexit(remove_folder);
    }
    return folder;
}

static char *read_all(FILE *in, size_t *size) {
    size_t room = 1 << 16;
    char *bytes = malloc(room);
    *size = 0;
    while (bytes != NULL) {
        const size_t got = fread(bytes + *size, 1, room - *size - 1, in);
        *size += got;
        if (got == 0)
            break;
        if (*size + 1 == room)
            bytes = realloc(bytes, room *= 2);
    }
    assert_non_null(bytes);
    bytes[*size] = '\0';
    return bytes;
}

static char *output_of(const char *arguments) {
    char command[2048];
    const char *program = getenv("DEPTHPREC");
    size_t size;
    snprintf(command, sizeof command, "'%s' %s", program != NULL ? program : "build/depthprec", arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    char *bytes = read_all(pipe, &size);
    const int status = pclose(pipe);
    if (status == -1 || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
        fail_msg("%s: exit status %d", command, status == -1 ? -1 : WEXITSTATUS(status));
    return bytes;
}

char *drawn_output(const char *format, ...) {
    char arguments[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(arguments, sizeof arguments, format, list);
    va_end(list);
    return output_of(arguments);
}

/* ---- Words and boxes of the page --------------------------------------------------------------------------------- */

static bool is_words(const svg_mark *m, double size, bool bold, uint32_t colour) {
    return m->kind == SVG_WORDS && fabs(m->size - size) < 1e-9 && m->bold == bold && svg_rgb(m->fill) == colour;
}

bool drawn_is_small(const drawn *d, const svg_mark *m, uint32_t colour) {
    return is_words(m, 12 * d->scale, false, colour);
}

static bool is_text(const drawn *d, const svg_mark *m) {
    return is_words(m, 13 * d->scale, false, d->theme->text);
}

static void join(char *out, size_t size, const char *words) {
    const size_t used = strlen(out);
    snprintf(out + used, size - used, "%s%s", used > 0 ? " " : "", words);
}

static double top_of_panels(const drawn *d) {
    double top = INFINITY;
    for (size_t i = 0; i < d->panel_count; i++)
        top = fmin(top, d->panels[i].frame.y0);
    return top;
}

/* A closed line of four corners in the colour of frames. */
static bool is_box(const drawn *d, const svg_mark *m) {
    return m->kind == SVG_PATH && m->count == 5 && m->fill.a == 0 && m->dash_count == 0 && m->stroke.a == 1 &&
           fabs(m->width - d->scale) < 1e-6 && svg_rgb(m->stroke) == d->theme->frame &&
           m->points[0].x == m->points[4].x && m->points[0].y == m->points[4].y;
}

static void find_frames(drawn *d) {
    svg *s = d->svg;
    assert_true(s->count > 2);
    assert_true(s->marks[0].kind == SVG_PATH && svg_rgb(s->marks[0].fill) == d->theme->background);
    assert_px(s->marks[0].box.x1, s->width, 0);
    assert_px(s->marks[0].box.y1, s->height, 0);
    for (size_t i = 0; i < s->count; i++) {
        svg_mark *m = &s->marks[i];
        if (m->kind == SVG_IMAGE && m->columns == 1) {
            assert_null(d->bar);
            d->bar = m;
        }
        if (!is_box(d, m))
            continue;
        m->used = DRAWN_AXIS;
        if (d->bar != NULL && svg_inside(m->box, d->bar->box, 1)) {
            assert_true(svg_inside(d->bar->box, m->box, 1)); /* the scale stands at the colours */
            d->value.labels = -1;
            continue;
        }
        assert_true(d->panel_count < DRAWN_PANELS);
        d->panels[d->panel_count++] = (drawn_panel){.frame = m->box, .heading = {0}};
    }
    assert_true(d->panel_count > 0);
}

/* Panels come line by line, from the left. */
static void check_order(const drawn *d) {
    for (size_t i = 1; i < d->panel_count; i++) {
        const svg_box *a = &d->panels[i - 1].frame, *b = &d->panels[i].frame;
        assert_true(b->y0 > a->y1 || (b->x0 > a->x1 && fabs(b->y0 - a->y0) < 0.01));
        if (b->y0 > a->y1)
            assert_px(b->x0, d->panels[0].frame.x0, 0.01);
    }
}

static void read_heading(drawn *d, svg_mark *m) {
    for (size_t i = 0; i < d->panel_count; i++) {
        drawn_panel *p = &d->panels[i];
        const double above = (p->frame.y0 - m->at.y) / d->scale;
        if (fabs(m->at.x - p->frame.x0) < 1 && above > 0 && above < 3 * 17.6 && m->box.x1 <= p->frame.x1 + 1) {
            join(p->heading, sizeof p->heading, m->text);
            m->used = DRAWN_PAGE;
        }
    }
}

/* Titles, headings, captions; what is left of the same font is the legend's. */
static void read_words(drawn *d) {
    const double top = top_of_panels(d), margin = 16 * d->scale;
    double bottom = 0, caption = 0;
    for (size_t i = 0; i < d->panel_count; i++)
        bottom = fmax(bottom, d->panels[i].frame.y1);
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (is_words(m, 17 * d->scale, true, d->theme->text)) {
            join(d->title, sizeof d->title, m->text);
            d->title_y = fmax(d->title_y, m->at.y);
            m->used = DRAWN_PAGE;
            assert_px(m->at.x, margin, 0.1);
        } else if (is_words(m, 13 * d->scale, true, d->theme->text)) {
            read_heading(d, m);
        } else if (drawn_is_small(d, m, d->theme->faint) && fabs(m->at.x - margin) < 0.1 &&
                   m->at.y < top - 12 * d->scale) {
            join(d->subtitle, sizeof d->subtitle, m->text);
            assert_true(m->at.y > d->title_y + m->size);
            d->subtitle_y = m->at.y;
            m->used = DRAWN_PAGE;
        } else if (is_text(d, m) && m->at.y > bottom) {
            assert_null(d->x_caption);
            d->x_caption = m;
            m->used = DRAWN_PAGE;
        } else if (is_text(d, m) && m->at.y < top) {
            caption = fmax(caption, m->at.y);
        }
    }
    for (size_t i = 0; i < d->svg->count; i++) { /* the lowest line above the panels */
        svg_mark *m = &d->svg->marks[i];
        if (!is_text(d, m) || fabs(m->at.y - caption) > 0.1)
            continue;
        const svg_mark **place = m->at.x > d->panels[0].frame.x0 + 2 ? &d->right_caption : &d->y_caption;
        assert_null(*place);
        *place = m;
        m->used = DRAWN_PAGE;
    }
    assert_non_null(d->y_caption);
    assert_non_null(d->x_caption);
}

static void check_captions(const drawn *d) {
    const drawn_panel *first = &d->panels[0];
    double right = 0;
    for (size_t i = 0; i < d->panel_count; i++)
        right = fmax(right, d->panels[i].frame.x1);
    assert_true(d->y_caption->box.x1 <= d->svg->width && d->y_caption->box.x0 < first->frame.x0 + 2);
    assert_px(svg_middle_x(d->x_caption->box), (first->frame.x0 + right) / 2, 2);
    assert_true(d->y_caption->box.y0 > d->subtitle_y);
    if (d->right_caption != NULL)
        assert_true(d->right_caption->box.x0 > d->y_caption->box.x1 && d->right_caption->box.x1 >= right - 1);
}

/* ---- The legend -------------------------------------------------------------------------------------------------- */

static void read_swatch(drawn *d, drawn_entry *e) {
    const double s = d->scale;
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (m->kind != SVG_PATH || m->used != DRAWN_NEW || i == 0 || m->box.x0 < e->x - 50 * s ||
            m->box.x1 > e->x - 5 * s || fabs(svg_middle_y(m->box) - e->y) > 2 * s)
            continue;
        m->used = DRAWN_LEGEND;
        const drawn_marker found = drawn_marker_of(d, i);
        if (found.shape != DRAWN_NONE) {
            assert_int_equal(e->marker.shape, DRAWN_NONE);
            e->marker = found;
            if (found.shape != DRAWN_DISC && found.shape != DRAWN_ARROW)
                d->svg->marks[++i].used = DRAWN_LEGEND; /* its rim */
            assert_px(found.x, e->x - 28 * s, s);
        } else if (m->fill.a > 0) {
            assert_null(e->area);
            e->area = m;
        } else {
            e->line = m;
            e->lines++;
        }
    }
    if (e->line == NULL && e->area == NULL && e->marker.shape == DRAWN_NONE)
        fail_msg("the legend says '%s' beside nothing", e->text);
}

static void read_legend(drawn *d) {
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (!is_text(d, m) || m->used != DRAWN_NEW || m->at.y > top_of_panels(d))
            continue;
        assert_true(d->entry_count < DRAWN_ENTRIES);
        drawn_entry *e = &d->entries[d->entry_count++];
        *e = (drawn_entry){.words = m, .text = m->text, .y = m->at.y - 0.36 * m->size, .x = m->at.x};
        m->used = DRAWN_LEGEND;
        read_swatch(d, e);
    }
}

const drawn_entry *drawn_legend(const drawn *d, const char *text) {
    const drawn_entry *found = NULL;
    for (size_t i = 0; i < d->entry_count; i++)
        if (strncmp(d->entries[i].text, text, strlen(text)) == 0 &&
            (found == NULL || strcmp(d->entries[i].text, text) == 0))
            found = &d->entries[i];
    if (found == NULL)
        fail_msg("the legend does not say '%s'", text);
    return found;
}

/* Down each column, the columns from the left. */
void drawn_legend_is(const drawn *d, size_t count, const char *const *texts) {
    for (size_t i = 0; i < d->entry_count && i < count; i++) {
        assert_string_equal(d->entries[i].text, texts[i]);
        if (i > 0)
            assert_true(d->entries[i].x > d->entries[i - 1].x + 50 || d->entries[i].y > d->entries[i - 1].y + 10);
    }
    assert_int_equal(d->entry_count, count);
}

/* ---- All of it --------------------------------------------------------------------------------------------------- */

/* The title for screen readers is that of the page, which may be cut. */
static void check_title(const drawn *d) {
    const char *cut = strstr(d->title, "\u2026");
    if (cut == NULL)
        assert_string_equal(d->svg->title, d->title);
    else
        assert_memory_equal(d->svg->title, d->title, (size_t)(cut - d->title));
}

/* Lines of the legend stand on the page, beside each other. */
static void check_legend(const drawn *d) {
    for (size_t i = 0; i < d->entry_count; i++) {
        const svg_box *a = &d->entries[i].words->box;
        assert_true(a->x1 <= d->svg->width && a->y0 > d->subtitle_y && a->y1 < d->y_caption->box.y0);
        for (size_t k = 0; k < i; k++) {
            const svg_box *b = &d->entries[k].words->box;
            assert_true(a->x0 - 40 * d->scale > b->x1 || b->x0 - 40 * d->scale > a->x1 || a->y0 > b->y1 - 2 ||
                        b->y0 > a->y1 - 2);
        }
    }
}

/* All words stand on the page, none cut at its rim. */
static void check_words(const drawn *d) {
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_WORDS && !(m->box.y0 >= 2 * d->scale && m->box.y1 <= d->svg->height))
            fail_msg("'%s' stands from %g to %g on a page of %g", m->text, m->box.y0, m->box.y1, d->svg->height);
    }
}

static drawn *read_page(const drawn_theme *look, const void *bytes, size_t size, double width, double height) {
    drawn *d = calloc(1, sizeof *d);
    assert_non_null(d);
    const double scale = fmax(fmin(width / 800, height / 500), 0.75);
    const svg_font fonts[] = {{17 * scale, true}, {13 * scale, true}, {13 * scale, false}, {12 * scale, false}};
    d->svg = svg_read(bytes, size, fonts, sizeof fonts / sizeof fonts[0]);
    d->theme = look;
    d->scale = scale;
    assert_px(d->svg->width, width, 0);
    assert_px(d->svg->height, height, 0);
    find_frames(d);
    check_order(d);
    drawn_read_axes(d);
    read_words(d);
    check_captions(d);
    read_legend(d);
    check_legend(d);
    check_title(d);
    check_words(d);
    return d;
}

drawn *drawn_run(const drawn_theme *look, const char *format, ...) {
    char arguments[1024], path[320];
    size_t size;
    double width, height;
    va_list list;
    va_start(list, format);
    vsnprintf(arguments, sizeof arguments, format, list);
    va_end(list);
    snprintf(path, sizeof path, "%s/drawn.svg", drawn_folder());
    const size_t used = strlen(arguments);
    const bool named = strstr(arguments, " --histogram") != NULL; /* as its last word */
    snprintf(arguments + used, sizeof arguments - used, " %s %s",
             named                                   ? ""
             : strncmp(arguments, "texture", 7) == 0 ? "-q --figure"
                                                     : "-o",
             path);
    free(output_of(arguments));
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    char *bytes = read_all(in, &size);
    fclose(in);
    const char *tag = strstr(bytes, "<svg");
    assert_non_null(tag);
    assert_int_equal(sscanf(strstr(tag, " width="), " width=\"%lfpx\" height=\"%lfpx\"", &width, &height), 2);
    drawn *d = read_page(look, bytes, size, width, height);
    free(bytes);
    return d;
}

chart *drawn_sketch(double x_to, double y_to) {
    chart *c = chart_new();
    assert_non_null(c);
    snprintf(c->title, sizeof c->title, "t");
    snprintf(c->subtitle, sizeof c->subtitle, "s");
    chart_panel *p = chart_add_panel(c);
    p->x = (chart_axis){CHART_LINEAR, 0, x_to, "x", "x", "", NULL};
    p->y = (chart_axis){CHART_LINEAR, 0, y_to, "y", "y", "", NULL};
    return c;
}

drawn *drawn_chart(const drawn_theme *look, chart *c, int width, int height) {
    canvas_bytes bytes;
    assert_false(chart_failed(c));
    assert_true(draw_chart(c, theme_get(look == &drawn_dark), CANVAS_SVG, width, height, "command", &bytes));
    drawn *d = read_page(look, bytes.at, bytes.size, width, height);
    free(bytes.at);
    chart_free(c);
    return d;
}

const svg_mark *drawn_words(const drawn *d, svg_box within, const char *text) {
    for (size_t i = 0; i < d->svg->count; i++) {
        svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_WORDS && m->used == DRAWN_NEW && strcmp(m->text, text) == 0 &&
            svg_inside(m->box, within, 1)) {
            m->used = DRAWN_DATA;
            return m;
        }
    }
    return NULL;
}

void drawn_close(drawn *d) {
    for (size_t i = 0; i < d->svg->count; i++) {
        const svg_mark *m = &d->svg->marks[i];
        if (m->kind == SVG_WORDS && m->used == DRAWN_NEW)
            fail_msg("nobody expected the words '%s' at %.0f,%.0f", m->text, m->at.x, m->at.y);
    }
    svg_free(d->svg);
    free(d);
}
