/* SPDX-License-Identifier: MIT */
#include "depthprec/format.h"

#include <math.h>
#include <string.h>

#include "core/lattice.h"
#include "core/text.h"

/*
 * Availability. Vulkan: D16_UNORM is mandatory, and one of X8_D24 and D32_SFLOAT (specification, required format
 * support). Metal: Depth24Unorm_Stencil8 is not on Apple silicon (isDepth24Stencil8PixelFormatSupported).
 */
/* clang-format off */
static const dp_format_row rows[] = {
    {
        .format = {"fp16", DP_FORMAT_FLOAT, 15, 5, 10, 15, 15U << 10},
        .aliases = "f16 r16f half float16 binary16 R16_FLOAT R16_SFLOAT VK_FORMAT_R16_SFLOAT DXGI_FORMAT_R16_FLOAT "
                   "GL_R16F r16float MTLPixelFormatR16Float",
        .claim_absolute = 0x1p-25, .claim_relative = 0x1p-11,
        .bytes = 2, .available = "colour targets only", .caution = "fp16 is no depth buffer in any API",
        .note = "depth written to a colour target: no API has an fp16 depth buffer",
        .source = "IEEE 754-2019 binary16",
    },
    {
        .format = {"fp32", DP_FORMAT_FLOAT, 31, 8, 23, 127, 127U << 23},
        .aliases = "f32 d32 d32f d32fs8 float float32 binary32 D32_FLOAT D32_FLOAT_S8X24_UINT D32_SFLOAT "
                   "D32_SFLOAT_S8_UINT VK_FORMAT_D32_SFLOAT VK_FORMAT_D32_SFLOAT_S8_UINT DXGI_FORMAT_D32_FLOAT "
                   "DXGI_FORMAT_D32_FLOAT_S8X24_UINT DXGI_FORMAT_R32G8X24_TYPELESS "
                   "DXGI_FORMAT_R32_FLOAT_X8X24_TYPELESS D3DFMT_D32F_LOCKABLE DEPTH_COMPONENT32F DEPTH32F_STENCIL8 "
                   "GL_DEPTH_COMPONENT32F GL_DEPTH32F_STENCIL8 depth32float depth32float-stencil8 "
                   "depth32float_stencil8 Depth32FloatStencil8 WGPUTextureFormat_Depth32Float "
                   "WGPUTextureFormat_Depth32FloatStencil8 MTLPixelFormatDepth32Float "
                   "MTLPixelFormatDepth32Float_Stencil8",
        .claim_absolute = 0x1p-150, .claim_relative = 0x1p-24,
        .buffer = 1, .bytes = 4, .available = "every API",
        .caution = "fp32 needs OpenGL 3.0, OpenGL ES 3.0 or WebGL 2",
        .note = "32-bit depth buffer",
        .source = "IEEE 754-2019 binary32",
    },
    {
        .format = {"unorm16", DP_FORMAT_UNORM, 16, 0, 0, 0, 65535U},
        .aliases = "d16 D16_UNORM D16_UNORM_S8_UINT VK_FORMAT_D16_UNORM VK_FORMAT_D16_UNORM_S8_UINT "
                   "DXGI_FORMAT_D16_UNORM D3DFMT_D16 D3DFMT_D16_LOCKABLE DEPTH_COMPONENT16 GL_DEPTH_COMPONENT16 "
                   "depth16unorm WGPUTextureFormat_Depth16Unorm MTLPixelFormatDepth16Unorm",
        .claim_absolute = 0.5 / 65535.0, .claim_relative = 0.0,
        .buffer = 1, .bytes = 2, .available = "every API", .caution = "",
        .note = "16-bit depth buffer",
        .source = "D3D 11.3 functional specification 3.2.3.6, 17.11",
    },
    {
        .format = {"unorm24", DP_FORMAT_UNORM, 24, 0, 0, 0, 16777215U},
        .aliases = "d24 d24s8 d24x8 D24_UNORM D24_UNORM_S8_UINT X8_D24_UNORM_PACK32 VK_FORMAT_D24_UNORM_S8_UINT "
                   "VK_FORMAT_X8_D24_UNORM_PACK32 DXGI_FORMAT_D24_UNORM_S8_UINT DXGI_FORMAT_R24G8_TYPELESS "
                   "DXGI_FORMAT_R24_UNORM_X8_TYPELESS D3DFMT_D24S8 D3DFMT_D24X8 D3DFMT_D24X4S4 DEPTH_COMPONENT24 "
                   "DEPTH24_STENCIL8 GL_DEPTH_COMPONENT24 GL_DEPTH24_STENCIL8 GL_DEPTH_COMPONENT24_OES "
                   "GL_DEPTH24_STENCIL8_OES depth24unorm_stencil8 MTLPixelFormatDepth24Unorm_Stencil8",
        .claim_absolute = 0.5 / 16777215.0, .claim_relative = 0.0,
        .buffer = 1, .bytes = 4, .rank = 2, .available = "optional in Vulkan, none on Apple silicon",
        .caution = "unorm24 is missing on many GPUs; depth24plus of WebGPU means it or fp32",
        .note = "24-bit depth buffer",
        .source = "D3D 11.3 functional specification 3.2.3.6, 17.11",
    },
};

/*
 * No depth buffer, and in no list of them: what Unity's EncodeFloatRG leaves of a depth in two channels of 8 bits,
 * floor(255 d) and the rest of 255 d, is 255 times the one plus the other: (2^8 - 1)^2 + 1 values at equal distances.
 */
static const dp_format rg = {"rg", DP_FORMAT_UNORM, 16, 0, 0, 0, DP_RG_CODE_MAX};

/* Names that leave the choice to the implementation: both formats are meant. */
static const struct {
    const char *names;
    const char *format[2];
} choices[] = {
    {"depth24plus depth24plus-stencil8 Depth24PlusStencil8 WGPUTextureFormat_Depth24Plus "
     "WGPUTextureFormat_Depth24PlusStencil8",
     {"unorm24", "fp32"}},
};

/* Formats of old hardware that the grammar below has. D24FS8 of Direct3D 9 and Xenos: 20 bits and an exponent of 4. */
static const struct {
    const char *names, *format;
} others[] = {
    {"20e4 d24f d24fs8 D3DFMT_D24FS8", "float4.20b15"},
};

static const char *const rounding_names[DP_ROUNDING_COUNT] = {
    [DP_ROUND_NEAREST] = "nearest", [DP_ROUND_EVEN] = "even", [DP_ROUND_ZERO] = "zero",
};
/* clang-format on */

enum {
    ROW_COUNT = sizeof rows / sizeof rows[0],
    CHOICE_COUNT = sizeof choices / sizeof choices[0],
    OTHER_COUNT = sizeof others / sizeof others[0]
};

size_t dp_format_count(void) {
    return ROW_COUNT;
}

const dp_format_row *dp_format_get(size_t index) {
    return index < ROW_COUNT ? &rows[index] : NULL;
}

const char *dp_rounding_name(dp_rounding rounding) {
    return (unsigned)rounding < DP_ROUNDING_COUNT ? rounding_names[rounding] : NULL;
}

/* Reads a whole number without sign or leading zero, at most three digits, and steps over it; -1 when there is none. */
static int read_number(const char **text) {
    const char *s = *text;
    if (*s < '1' || *s > '9')
        return -1;
    int value = 0;
    for (; *s >= '0' && *s <= '9' && value < 1000; s++)
        value = 10 * value + (*s - '0');
    *text = s;
    return value;
}

/* Steps over a prefix, letter case ignored. */
static int read_prefix(const char **text, const char *prefix) {
    const char *s = *text;
    for (; *prefix != '\0'; s++, prefix++)
        if (dp_lower(*s) != *prefix)
            return 0;
    *text = s;
    return 1;
}

/* The canonical name is written in lower case and drops a bias that is the default. */
static void write_name(char *out, const char *prefix, int first, int second, int third) {
    const int numbers[3] = {first, second, third};
    const char *const before[3] = {prefix, ".", "b"};
    for (int i = 0; i < 3 && numbers[i] > 0; i++) {
        for (const char *s = before[i]; *s != '\0'; s++)
            *out++ = *s;
        for (int power = numbers[i] >= 100 ? 100 : numbers[i] >= 10 ? 10 : 1; power > 0; power /= 10)
            *out++ = (char)('0' + numbers[i] / power % 10);
    }
    *out = '\0';
}

static int parse_unorm(const char *text, dp_format *out) {
    if (!read_prefix(&text, "unorm"))
        return 0;
    int bits = read_number(&text);
    if (*text != '\0' || bits < 1 || bits > 32)
        return 0;
    *out = (dp_format){.kind = DP_FORMAT_UNORM, .bits = bits, .code_max = 0xFFFFFFFFU >> (32 - bits)};
    write_name(out->name, "unorm", bits, 0, 0);
    return 1;
}

static int parse_float(const char *text, dp_format *out) {
    if (!read_prefix(&text, "float"))
        return 0;
    int e = read_number(&text);
    if (e < 2 || e > 8 || *text++ != '.')
        return 0;
    int m = read_number(&text);
    if (m < 1 || m > 23)
        return 0;
    const int usual = (1 << (e - 1)) - 1;
    int bias = usual;
    if (read_prefix(&text, "b"))
        bias = read_number(&text);
    if (*text != '\0' || bias < 1 || bias > (1 << e) - 1)
        return 0;
    *out = (dp_format){.kind = DP_FORMAT_FLOAT,
                       .bits = e + m,
                       .exponent_bits = e,
                       .mantissa_bits = m,
                       .bias = bias,
                       .code_max = (uint32_t)bias << m};
    write_name(out->name, "float", e, m, bias == usual ? 0 : bias);
    return 1;
}

static int parse_row(const char *name, dp_format *out) {
    for (size_t i = 0; i < ROW_COUNT; i++)
        if (dp_word_among(name, rows[i].format.name) || dp_word_among(name, rows[i].aliases)) {
            *out = rows[i].format;
            return 1;
        }
    if (!dp_word_among(name, "rg EncodeFloatRG DepthNormals _CameraDepthNormalsTexture"))
        return 0;
    *out = rg;
    return 1;
}

size_t dp_format_parse(const char *name, dp_format out[2]) {
    if (name == NULL || out == NULL)
        return 0;
    for (size_t i = 0; i < CHOICE_COUNT; i++)
        if (dp_word_among(name, choices[i].names))
            return (size_t)(parse_row(choices[i].format[0], &out[0]) + parse_row(choices[i].format[1], &out[1]));
    for (size_t i = 0; i < OTHER_COUNT; i++)
        if (dp_word_among(name, others[i].names))
            name = others[i].format;
    return (size_t)(parse_row(name, out) || parse_unorm(name, out) || parse_float(name, out));
}

double dp_format_value(const dp_format *format, uint32_t code) {
    dp_point p = dp_point_of_code(format, code);
    return p.num / p.den;
}

uint32_t dp_format_encode(const dp_format *format, dp_rounding rounding, double d) {
    if (!(d > 0.0))
        return 0;
    if (d >= 1.0)
        return format->code_max;
    dp_scaled s = dp_scale_depth(format, d);
    /* The product's rounding error: 0 for FLOAT, whose scale is a power of two. */
    double lost = format->kind == DP_FORMAT_UNORM ? fma(d, s.scale, -s.t) : 0.0;
    double whole = floor(s.t);
    double part = s.t - whole;
    double above = part - 0.5; /* exact, or too far from 0 for its sign to be in doubt */
    uint32_t code = s.base + (uint32_t)whole;
    if (rounding == DP_ROUND_ZERO)
        return code - (part == 0.0 && lost < 0.0);
    if (above == -lost)
        return code + (dp_ties_up(format, rounding) || (code & 1U) != 0);
    return code + (above > -lost);
}
