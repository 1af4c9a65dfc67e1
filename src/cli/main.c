/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No setlocale here or anywhere: numbers are read and written in the C locale whatever LC_ALL says. */
#include "cli/options.h"
#include "method/method.h"

int main(int argc, char **argv) {
    options o;
    method_start();
    int status = options_parse(&o, argc, argv);
    if (status == EXIT_FINE)
        status = o.verb->run(&o);
    options_release(&o);
    return status;
}
