/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "setups.h"

#include "support.h"

dp_setup setup_with(const char *format, dp_spec spec) {
    const dp_spec missing = dp_spec_default();
    dp_format found[2];
    dp_setup setup;
    spec.znear = spec.znear == 0 && (!spec.ortho || spec.zfar == 0) ? missing.znear : spec.znear;
    spec.zfar = spec.zfar == 0 && (!spec.ortho || spec.znear >= 0) ? missing.zfar : spec.zfar;
    spec.log_c = spec.log_c == 0 ? missing.log_c : spec.log_c;
    assert_int_equal(dp_format_parse(format, found), 1);
    spec.format = found[0];
    assert_int_equal(dp_setup_init(&setup, &spec), DP_OK);
    return setup;
}

dp_setup setup_in(const dp_setup *setup, dp_model model) {
    dp_spec spec = setup->spec;
    dp_setup other;
    spec.model = model;
    assert_int_equal(dp_setup_init(&other, &spec), DP_OK);
    return other;
}
