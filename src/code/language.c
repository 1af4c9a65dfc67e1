/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "code/language.h"

#include <stdio.h>

/* In half units. Vulkan, WGSL and Metal leave the direction of rounding open, and Direct3D lets hardware truncate. The
 * divisors of all rows lie between 2^-126 and 2^126, where quotients are good to what is said here. */
#define GPU(quotient, fuses, ...)                                                                                      \
    { .rounding = 2, .division = (quotient), .contracts = (fuses), .flushes = true, __VA_ARGS__ }
#define IEEE(fuses)                                                                                                    \
    { .rounding = 1, .division = 1, .contracts = (fuses), .flushes = false }

#define POWERS       .exp2 = {3 * 0x1p-23, 2 * 0x1p-23}, .log2 = {0x1p-21, 3 * 0x1p-23}
#define POWERS_WORDS "exp2(x) within 3 + 2|x| ulp; log2 within 2^-21 from 0.5 to 2, else 3 ulp"
#define POWERS_D3D   .exp2 = {0x1p-21}, .log2 = {0x1p-21, 0x1p-21}
#define POWERS_METAL .exp2 = {4 * 0x1p-23}, .log2 = {4 * 0x1p-23, 4 * 0x1p-23}

/* clang-format off */
static const code_language rows[] = {
    {.name = "glsl", .note = "GLSL of Vulkan and OpenGL",
     .comment = "//", .advice = "Before GLSL 4.00 and ES 3.20: #define precise. In ES floats must be highp.",
     .type = {"float", "uint", "vec@"}, .function = "$ @(@) {\n", .parameter = {"float @"},
     .constant = {"    const float @ = @;"},
     .step = {"    precise float @ = @;\n"}, .result = {"    return @;\n}\n"}, .members = "    return $(@);\n}\n",
     .literal = {"@"},
     .sign = "@ * (2.0 * step(0.0, @) - 1.0)", .before = "", .behind = "",
     .whole = "uint(@)", .even = "roundEven(@)", .magic = "uintBitsToFloat(0x7ef311c7u - floatBitsToUint(@))",
     .matrix = "const mat4 projection = mat4(\n", .end = ");\n", .how = GPU(5, false, POWERS),
     .powers = POWERS_WORDS,
     .rules = "Vulkan", .source = "Vulkan, Precision and Operation of SPIR-V Instructions"},
    {.name = "hlsl", .note = "HLSL of Direct3D",
     .comment = "//",
     .type = {"float", "uint", "float@"}, .function = "$ @(@) {\n", .parameter = {"float @"},
     .constant = {"    const float @ = @;"},
     .step = {"    precise float @ = @;\n"}, .result = {"    return @;\n}\n"}, .members = "    return $(@);\n}\n",
     .literal = {"@f"},
     .sign = "@ * (2.0f * step(0.0f, @) - 1.0f)", .before = "", .behind = "",
     .whole = "uint(@)", .even = "round(@)", .magic = "asfloat(0x7ef311c7u - asuint(@))",
     .matrix = "static const float4x4 projection = float4x4(\n", .end = ");\n", .by_rows = true,
     .how = GPU(2, false, POWERS_D3D),
     .powers = "exp2 and log2 within 2^-21 of themselves, log2 from 0.5 to 2 within 2^-21",
     .rules = "Direct3D", .source = "Direct3D 11.3 functional specification 3.1"},
    {.name = "wgsl", .note = "WGSL of WebGPU",
     .comment = "//",
     .type = {"f32", "u32", "vec@<f32>"}, .function = "fn @(@) -> $ {\n", .parameter = {"@: f32"},
     .constant = {"    const @ = @;"},
     .step = {"    let @ = @;\n"}, .result = {"    return @;\n}\n"}, .members = "    return $(@);\n}\n",
     .literal = {"@f"},
     .sign = "@ * (2.0f * step(0.0f, @) - 1.0f)", .before = "", .behind = "",
     .whole = "u32(@)", .even = "round(@)", .magic = "bitcast<f32>(0x7ef311c7u - bitcast<u32>(@))",
     .matrix = "const projection = mat4x4<f32>(\n", .end = ");\n", .how = GPU(5, true, POWERS),
     .powers = POWERS_WORDS,
     .rules = "WGSL", .source = "WGSL, Floating Point Accuracy"},
    {.name = "msl", .note = "Metal Shading Language, math mode safe",
     .comment = "//", .advice = "Compile with math mode safe (-fno-fast-math): with fast math nothing is proven.",
     .type = {"float", "uint", "float@"}, .function = "$ @(@) {\n", .parameter = {"float @"},
     .constant = {"    const float @ = @;"},
     .step = {"    const float @ = @;\n"}, .result = {"    return @;\n}\n"}, .members = "    return $(@);\n}\n",
     .literal = {"@f"},
     .sign = "@ * (2.0f * step(0.0f, @) - 1.0f)", .before = "", .behind = "",
     .whole = "uint(@)", .even = "rint(@)",
     .fused = "fma(@, @, @)", .magic = "as_type<float>(0x7ef311c7u - as_type<uint>(@))",
     .matrix = "constant float4x4 projection = float4x4(\n", .end = ");\n", .how = GPU(2, true, POWERS_METAL),
     .powers = "exp2 and log2 within 4 ulp",
     .rules = "Metal, math mode safe", .source = "Metal Shading Language Specification, Numerical Compliance"},
    {.name = "c", .note = "C99 with IEEE 754, contracted or not",
     .comment = "//",
     .advice = "Include <math.h> and <stdint.h>. With -ffp-contract=off every compiler gives the same bits.",
     .type = {"float", "uint32_t", "vector@"}, .define = "typedef struct { float at[@]; } $;\n",
     .function = "static inline $ @(@) {\n",
     .parameter = {"float @", "double @"},
     .constant = {"    const float @ = @;", "    const double @ = @;"},
     .step = {"    const float @ = @;\n", "    const double @ = @;\n"},
     .result = {"    return @;\n}\n", "    return (float)@;\n}\n"}, .members = "    return ($){{@}};\n}\n",
     .literal = {"@f", "@"},
     .sign = "copysignf(@, @)", .before = "", .behind = "f",
     .whole = "(uint32_t)(@)", .even = "rintf(@)", .fused = "fmaf(@, @, @)",
     .magic = "((union { uint32_t u; float f; }){.u = 0x7ef311c7u - (union { float f; uint32_t u; }){@}.u}).f",
     .matrix = "static const float projection[16] = {\n", .end = "};\n", .how = IEEE(true),
     .rules = "IEEE 754", .source = "C99 annex F"},
    {.name = "numpy", .note = "Python with numpy",
     .comment = "#", .import = "import numpy as np\n\n\n",
     .type = {"", "", ""}, .function = "def @(@):\n",
     .input = {"    @ = np.asarray(@, np.float32)\n", "    @ = np.asarray(@, np.float32).astype(np.float64)\n"},
     .parameter = {"@", "@"},
     .constant = {"    @ = @", "    @ = @"},
     .step = {"    @ = @\n", "    @ = @\n"}, .result = {"    return @\n", "    return np.float32(@)\n"},
     .members = "    return np.stack([@], -1)\n", .sign = "np.copysign(@, @)", .before = "np.", .behind = "",
     .literal = {"np.float32(@)", "np.float64(@)"}, .whole = "np.uint32(@)", .even = "np.rint(@)",
     .magic = "(np.uint32(0x7ef311c7) - @.view(np.uint32)).view(np.float32)",
     .matrix = "projection = np.array([\n", .end = "], np.float32).reshape(4, 4)\n", .by_rows = true,
     .how = IEEE(false),
     .rules = "IEEE 754", .source = "numpy"},
    {.name = "fpcore", .note = "FPCore 2.0, for Herbie and its kin", .form = CODE_PREFIX,
     .comment = ";", .literal = {"@", "@"}, .fused = "fma", .how = IEEE(false),
     .rules = "IEEE 754", .source = "FPBench, FPCore 2.0"},
    {.name = "gappa", .note = "a script from which Gappa proves the bound", .form = CODE_PROOF,
     .comment = "#", .step = {"@ rnd= @;\n", "@ dbl= @;\n"}, .literal = {"rnd(@)", "dbl(@)"}, .fused = "rnd(@ * @ + @)",
     .how = IEEE(false), .rules = "IEEE 754", .source = "Gappa"},
};
/* clang-format on */

NAMED_TABLE(code_language, rows);

const char *code_language_rules(const code_language *l, char out[CODE_RULES_SIZE]) {
    const bound_arithmetic *how = &l->how;
    if (how->division > how->rounding)
        snprintf(out, CODE_RULES_SIZE, "sums and products within %g ulp, quotients within %g", how->rounding / 2,
                 how->division / 2);
    else
        snprintf(out, CODE_RULES_SIZE, "every operation %s", how->rounding > 1 ? "within 1 ulp" : "to nearest");
    return out;
}
