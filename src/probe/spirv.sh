#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the table of SPIR-V words of the probe's shader, on stdout:  spirv.sh >src/probe/spirv.h  (needs glslangValidator)
set -eu
folder=$(dirname "$0")
made=$(mktemp)
trap 'rm -f "$made"' EXIT
sed '/^\/\/ SPDX/d; /^\/\/ The vertex shader/d' "$folder/shaders.glsl" |
    glslangValidator --stdin -S vert -V --target-env vulkan1.0 -o "$made" >/dev/null
cat <<'END'
/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Made by spirv.sh of shaders.glsl: not to be edited. */
#ifndef PROBE_SPIRV_H
#define PROBE_SPIRV_H

#include <stdint.h>

/* clang-format off */
static const uint32_t probe_spirv[] = {
END
od -An -v -tx4 "$made" | sed 's/ \([0-9a-f]\{8\}\)/ 0x\1,/g; s/^ /    /'
cat <<'END'
};

/* The same program for OpenGL, behind declarations of `program`, `given`, a and b. */
static const char probe_glsl[] =
END
sed -n '/^void main/,$p' "$folder/shaders.glsl" | sed 's/.*/    "&\\n"/; $s/$/;/'
cat <<'END'
/* clang-format on */

#endif
END
