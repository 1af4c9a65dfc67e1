/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "exr_made.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

#if __has_include(<openexr.h>)

#include "image/exr.h"
#include "image/kind.h"
#include "system/dynload.h"

#define FUNCTIONS(X)                                                                                                   \
    X(exr_start_write)                                                                                                 \
    X(exr_finish)                                                                                                      \
    X(exr_add_part)                                                                                                    \
    X(exr_initialize_required_attr_simple)                                                                             \
    X(exr_add_channel)                                                                                                 \
    X(exr_set_tile_descriptor)                                                                                         \
    X(exr_write_header)                                                                                                \
    X(exr_get_scanlines_per_chunk)                                                                                     \
    X(exr_write_scanline_chunk_info)                                                                                   \
    X(exr_write_tile_chunk_info)                                                                                       \
    X(exr_encoding_initialize)                                                                                         \
    X(exr_encoding_choose_default_routines)                                                                            \
    X(exr_encoding_run)                                                                                                \
    X(exr_encoding_destroy)                                                                                            \
    X(exr_get_default_error_message)
DYNLOAD_FUNCTIONS(FUNCTIONS)

static const library openexr = {"EXR", {IMAGE_EXR_FILE, NULL}, IMAGE_EXR_PACKAGE, symbols};

static exr_result_t write_chunk(const functions *call, exr_context_t file, const exr_made *of, int x, int y) {
    const size_t size = image_type_size(of->type), row = (size_t)of->width * size;
    exr_chunk_info_t chunk;
    exr_encode_pipeline_t encode = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_result_t code = of->tile > 0
                            ? call->exr_write_tile_chunk_info(file, 0, x / of->tile, y / of->tile, 0, 0, &chunk)
                            : call->exr_write_scanline_chunk_info(file, 0, y, &chunk);
    if (code != EXR_ERR_SUCCESS)
        return code;
    code = call->exr_encoding_initialize(file, 0, &chunk, &encode);
    if (code == EXR_ERR_SUCCESS) {
        encode.channels[0].encode_from_ptr = (const unsigned char *)of->samples + (size_t)y * row + (size_t)x * size;
        encode.channels[0].user_pixel_stride = (int32_t)size;
        encode.channels[0].user_line_stride = (int32_t)row;
        code = call->exr_encoding_choose_default_routines(file, 0, &encode);
        if (code == EXR_ERR_SUCCESS)
            code = call->exr_encoding_run(file, 0, &encode);
    }
    call->exr_encoding_destroy(file, &encode);
    return code;
}

static exr_result_t write_header(const functions *call, exr_context_t file, const exr_made *of) {
    static const exr_pixel_type_t types[] = {
        [IMAGE_U32] = EXR_PIXEL_UINT, [IMAGE_F16] = EXR_PIXEL_HALF, [IMAGE_F32] = EXR_PIXEL_FLOAT};
    int part = 0;
    exr_result_t code =
        call->exr_add_part(file, "depth", of->tile > 0 ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS)
        code = call->exr_initialize_required_attr_simple(file, part, of->width, of->height,
                                                         (exr_compression_t)of->compression);
    if (code == EXR_ERR_SUCCESS)
        code = call->exr_add_channel(file, part, of->channel, types[of->type], EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    if (code == EXR_ERR_SUCCESS && of->tile > 0)
        code = call->exr_set_tile_descriptor(file, part, (uint32_t)of->tile, (uint32_t)of->tile, EXR_TILE_ONE_LEVEL,
                                             EXR_TILE_ROUND_DOWN);
    return code == EXR_ERR_SUCCESS ? call->exr_write_header(file) : code;
}

static void say_nothing(exr_const_context_t file, exr_result_t code, const char *message) {
    (void)file, (void)code, (void)message;
}

const char *exr_make(const char *path, const exr_made *of) {
    static image_error error;
    image_source source = {.error = &error};
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t file = NULL;
    functions call;
    int32_t lines = of->tile;
    how.error_handler_fn = say_nothing;
    if (!source_library(&source, &openexr, call.all))
        return error.text;
    exr_result_t code = call.exr_start_write(&file, path, EXR_WRITE_FILE_DIRECTLY, &how);
    if (code == EXR_ERR_SUCCESS)
        code = write_header(&call, file, of);
    if (code == EXR_ERR_SUCCESS && of->tile == 0)
        code = call.exr_get_scanlines_per_chunk(file, 0, &lines);
    for (int y = 0; code == EXR_ERR_SUCCESS && y < of->height; y += lines)
        for (int x = 0; code == EXR_ERR_SUCCESS && x<of->width; x += of->tile> 0 ? of->tile : of->width)
            code = write_chunk(&call, file, of, x, y);
    const exr_result_t ended = file != NULL ? call.exr_finish(&file) : code;
    code = code == EXR_ERR_SUCCESS ? ended : code;
    return code == EXR_ERR_SUCCESS ? NULL : call.exr_get_default_error_message(code);
}

#else

const char *exr_make(const char *path, const exr_made *of) {
    (void)path, (void)of;
    return "no header openexr.h";
}

#endif
