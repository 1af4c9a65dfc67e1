/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>

#include "method/method.h"

void method_start(void) {
    gsl_set_error_handler_off();
}
