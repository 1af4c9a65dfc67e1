/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * list: the rows of the tables that the program works from, with what is claimed of each and where it comes from: those
 * of a topic, or whatever in any of them is called by a word.
 */
#include "cli/cmd_list/request.h"
#include "cli/list.h"
#include "cli/words.h"
#include "method/cmd_methods/methods.h"
#include "report/report.h"

static const name_list topics = {.get = list_topic};
static const topic all_topics = {"topics", "", {.get = list_topic}, .bound = "bound"};

/* The topic that is listed, and the thing at hand. */
typedef struct listing {
    const list_request *o;
    const topic *topic;
    const char *what;
    const char *word; /* only what is called so; null: all of the topic */
    list_item item;
    char chosen[LIST_TEXT_SIZE]; /* with --tolerance: for what the thing is chosen, "" for nothing */
} listing;

static void *next_item(void *of, size_t i) {
    listing *l = of;
    list_item *item = &l->item;
    size_t index = 0;
    for (size_t left = i; names_get(&l->topic->of, index, item); index++)
        if ((l->word == NULL || named_is(item->name, item->aliases, l->word)) && left-- == 0)
            break;
    if (!names_get(&l->topic->of, index, item))
        return NULL;
    if (item->source != NULL && *item->source == '\0')
        item->source = NULL;
    if (option_given(l->o->line, "tolerance"))
        list_method_choice(index, l->o->tolerance, l->chosen);
    return l;
}

static void say_topics(page *p, void *of) {
    (void)of;
    page_text(p, "depthprec list WHAT, where WHAT is one of");
    list_item item;
    for (size_t i = 0; list_topic(i, &item); i++)
        page_note(p, item.name, "%s", item.note);
}

static void say_item(page *p, void *of) {
    const listing *l = of;
    const list_item *item = &l->item;
    char command[LIST_TEXT_SIZE];
    page_title(p, "%s%s%s", l->word != NULL ? l->topic->name : "", l->word != NULL ? ": " : "", item->name);
    if (l->topic->of.rows == &question_table) {
        snprintf(command, sizeof command, "%s", item->bound);
        for (char *at = command, *end; at != NULL; at = end != NULL ? end + 2 : NULL) {
            end = strstr(at, "; depthprec ");
            if (end != NULL)
                *end = '\0';
            page_command(p, at);
        }
        return;
    }
    page_wrapped(p, "", item->note);
    page_wrapped(p, l->topic->shown != NULL ? l->topic->shown : l->topic->bound, item->bound);
    page_wrapped(p, "chosen", l->chosen);
    page_wrapped(p, "source", item->source);
    page_wrapped(p, "also", item->aliases);
}

static void say_other_formats(page *p, void *of) {
    (void)of;
    output_char(p->out, '\n');
    page_title(p, "unormN, floatE.M, floatE.MbB");
    page_note(p, "",
              "formats for teaching: N = 1..32 bits; E = 2..8 exponent bits, M = 1..23 mantissa bits, bias B = "
              "1..2^E-1");
    output_char(p->out, '\n');
    page_title(p, "20e4, D24FS8");
    page_note(p, "", "float4.20b15: Direct3D 9, Xbox 360");
    output_char(p->out, '\n');
    page_title(p, "depth24plus, depth24plus-stencil8");
    page_note(p, "", "unorm24 or fp32, as the implementation chooses: both are shown");
    output_char(p->out, '\n');
    page_title(p, "rg, EncodeFloatRG, DepthNormals");
    page_note(p, "", "depth of Unity's DepthNormals, in steps of 1/65025 of far: for table and plot");
    output_char(p->out, '\n');
    page_title(p, "sort keys of Gaussian splats");
    page_note(p, "",
              "10 to 24 bits of z, as in unorm16 with --ortho -m d3d --rounding zero, near and far those of the "
              "splats; of z over far: -m linear. 'depthprec help splat' has examples");
}

enum { WITH_CHOICES = 1 };

/* Text lists the topics as help does its commands. */
static void write_list(listing *l, output *out) {
    const bool topics_alone = l->topic == &all_topics;
    const column items[] = {{FIELD(listing, item.name, "name", "")},
                            {FIELD(listing, item.aliases, "aliases", ""), .names = true},
                            {FIELD(listing, item.note, "note", "")},
                            {FIELD(listing, item.bound, l->topic->bound, "")},
                            {FIELD(listing, chosen, "chosen", ""), .only = AS_JSON, .when = WITH_CHOICES},
                            {FIELD(listing, item.source, "source", "")},
                            {FIELD(listing, chosen, "chosen", ""), .only = AS_CSV, .when = WITH_CHOICES},
                            {.kind = COLUMN_END}};
    const column columns[] = {
        {FIELD(listing, what, "what", ""), .only = AS_JSON},
        {LIST("items", items, next_item), .only = topics_alone ? AS_JSON | AS_CSV : 0, .head = say_item},
        {.kind = COLUMN_END}};
    report_write(&(report_spec){"list", columns, l, .when = option_given(l->o->line, "tolerance") ? WITH_CHOICES : 0,
                                .label = 12, .head = topics_alone ? say_topics : NULL,
                                .notes = l->topic->of.get == list_format && l->word == NULL ? say_other_formats : NULL},
                 out, l->o->out.form);
}

/* Every topic that knows the word, parted by empty lines. @return whether one does */
static bool write_word(listing *l, output *out) {
    bool found = false;
    list_item here, item;
    for (size_t i = 0; list_topic(i, &here); i++) {
        l->topic = here.row;
        if (!names_find(&l->topic->of, l->word, NULL, &item))
            continue;
        if (out != NULL && found)
            output_char(out, '\n');
        if (out != NULL)
            write_list(l, out);
        found = true;
    }
    return found;
}

bool list_knows(const char *word) {
    return names_find(&topics, word, NULL, NULL) || write_word(&(listing){.word = word}, NULL);
}

int cmd_list(void *request) {
    const list_request *o = request;
    list_item asked = {.row = &all_topics};
    listing l = {.o = o};
    int status = EXIT_FINE;
    if (o->line->operand_count > 0 && !names_find(&topics, o->line->operands[0], NULL, &asked))
        l.word = o->line->operands[0];
    if (l.word != NULL && (o->out.form != FORM_TEXT || !write_word(&l, NULL)))
        status = check_operand(o->line->command, "WHAT", &topics, l.word, &asked);
    l.topic = asked.row;
    if (status == EXIT_FINE && option_given(o->line, "tolerance") && l.topic->of.get != list_method)
        return option_error("tolerance", "applies to list methods only");
    output out;
    if (status == EXIT_FINE)
        status = output_start(&o->out, NULL, &out);
    if (status != EXIT_FINE)
        return status;
    if (o->out.form == FORM_TEXT)
        output_page(&out);
    l.what = l.topic->name;
    if (l.word != NULL)
        write_word(&l, &out);
    else
        write_list(&l, &out);
    return output_close(&out);
}
