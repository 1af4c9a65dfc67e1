/* SPDX-License-Identifier: GPL-3.0-or-later */
/* completions: a script for a shell, by which it completes a command line, from the same rows as help. */
#include <string.h>

#include "cli/cmd_help/request.h"
#include "cli/list.h"
#include "report/output.h"

static bool takes(const command_row *v, const char *name) {
    return option_used(v, ~0U, option_find(v, name)).row != NULL;
}

/* Those of all commands, each name once. */
static void all_names(const option_row *out[OPTIONS_MAX + 1]) {
    size_t count = 0;
    options_all(out);
    for (size_t i = 0; out[i] != NULL; i++)
        if (i == 0 || strcmp(out[count - 1]->name, out[i]->name) != 0)
            out[count++] = out[i];
    out[count] = NULL;
}

static const char *words_of(const name_list *n, char out[NAMES_SIZE]) {
    out[0] = '\0';
    return n != NULL ? names_join(n, " ", " ", out) : out;
}

/* The words of an option behind it, else those of the operand and the options of the command; files where none fits. */
static void write_cases(output *out, const char *previous, const char *word) {
    const option_row *all[OPTIONS_MAX + 1];
    char text[NAMES_SIZE];
    all_names(all);
    output_format(out, "    case %s in\n", previous);
    for (size_t k = 0; all[k] != NULL; k++) {
        const option_row *row = all[k];
        const char letter[] = {'|', '-', row->letter, '\0'};
        if (*option_argument(row, text) != '\0')
            output_format(out, "    --%s%s) offered='%s' ;;\n", row->name, row->letter != 0 ? letter : "",
                          words_of(row->names, text));
    }
    output_format(out, "    *)\n        case %s in\n", word);
    for (size_t i = 0; command_get(i) != NULL; i++) {
        const command_row *v = command_get(i);
        output_format(out, "        %s) offered='%s", v->name, words_of(v->names, text));
        for (size_t k = 0; all[k] != NULL; k++)
            if (takes(v, all[k]->name))
                output_format(out, " --%s", all[k]->name);
        output_text(out, "' ;;\n");
    }
    output_format(out, "        *) offered='%s' ;;\n        esac ;;\n    esac\n",
                  words_of(&(name_list){.get = list_command}, text));
}

static void write_bash(output *out) {
    output_text(out, "_depthprec() {\n    local offered=\n");
    write_cases(out, "${COMP_WORDS[COMP_CWORD-1]}", "${COMP_WORDS[1]}");
    output_text(out, "    COMPREPLY=($(compgen -W \"$offered\" -- \"${COMP_WORDS[COMP_CWORD]}\"))\n}\n"
                     "complete -o default -F _depthprec depthprec\n");
}

static void write_zsh(output *out) {
    output_text(out, "#compdef depthprec\n_depthprec() {\n    local offered=\n");
    write_cases(out, "$words[CURRENT-1]", "$words[2]");
    output_text(out, "    compadd -- ${=offered} || _files\n}\n"
                     "if [[ $funcstack[1] = _depthprec ]]; then _depthprec; else compdef _depthprec depthprec; fi\n");
}

static void write_fish(output *out) {
    const option_row *all[OPTIONS_MAX + 1];
    char text[NAMES_SIZE];
    all_names(all);
    for (size_t i = 0; command_get(i) != NULL; i++) {
        const command_row *v = command_get(i);
        output_format(out, "complete -c depthprec -n __fish_use_subcommand -a %s\n", v->name);
        if (v->names != NULL)
            output_format(out, "complete -c depthprec -n '__fish_seen_subcommand_from %s' -a '%s'\n", v->name,
                          words_of(v->names, text));
    }
    for (size_t k = 0; all[k] != NULL; k++) {
        const option_row *row = all[k];
        const bool argument = *option_argument(row, text) != '\0';
        output_text(out, "complete -c depthprec -n '__fish_seen_subcommand_from");
        for (size_t i = 0; command_get(i) != NULL; i++)
            if (takes(command_get(i), row->name))
                output_format(out, " %s", command_get(i)->name);
        output_format(out, "' -l %s", row->name);
        if (row->letter != 0)
            output_format(out, " -s %c", row->letter);
        output_format(out, "%s%s%s%s\n", argument ? " -r" : "", row->names != NULL ? " -fa '" : "",
                      words_of(row->names, text), row->names != NULL ? "'" : "");
    }
}

int cmd_completions(void *request) {
    const help_request *o = request;
    output out;
    output_open(&out, NULL);
    const char *shell = o->line->operands[0];
    if (strcmp(shell, "bash") == 0)
        write_bash(&out);
    else if (strcmp(shell, "zsh") == 0)
        write_zsh(&out);
    else
        write_fish(&out);
    return output_close(&out);
}
