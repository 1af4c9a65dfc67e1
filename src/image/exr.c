/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * OpenEXR by the C interface of OpenEXRCore: one channel of half, float or uint, scanlines or tiles, in any compression
 * that the library has. The channel is the one that is asked for, else Z or depth, else the one whose last part is one
 * of these, as in "ViewLayer.Depth.Z", else V, R, Y or X of a layer or a part of that name, as in "ViewLayer.Depth.V",
 * else R, else the only one. Z beside X and Y is none. Where a file has several parts, all are looked through, and a
 * channel is called by the name of its part and its own.
 *
 * The image is the display window: pixels that the data window has not hold no depth, what lies around it is left out.
 *
 * Its headers may be missing where this is compiled, and its library where this runs; its structs differ between
 * versions, so the library must be that of the headers.
 */
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/append.h"
#include "image/channel.h"
#include "image/exr.h"
#include "image/kind.h"

#if __has_include(<openexr.h>)

#include "system/dynload.h"

/* The functions of the library that are called. */
#define FUNCTIONS(X)                                                                                                   \
    X(exr_start_read)                                                                                                  \
    X(exr_finish)                                                                                                      \
    X(exr_get_default_error_message)                                                                                   \
    X(exr_get_count)                                                                                                   \
    X(exr_get_name)                                                                                                    \
    X(exr_get_storage)                                                                                                 \
    X(exr_get_channels)                                                                                                \
    X(exr_get_data_window)                                                                                             \
    X(exr_get_display_window)                                                                                          \
    X(exr_get_compression)                                                                                             \
    X(exr_get_scanlines_per_chunk)                                                                                     \
    X(exr_get_tile_descriptor)                                                                                         \
    X(exr_read_scanline_chunk_info)                                                                                    \
    X(exr_read_tile_chunk_info)                                                                                        \
    X(exr_decoding_initialize)                                                                                         \
    X(exr_decoding_update)                                                                                             \
    X(exr_decoding_choose_default_routines)                                                                            \
    X(exr_decoding_run)                                                                                                \
    X(exr_decoding_destroy)
DYNLOAD_FUNCTIONS(FUNCTIONS)

static const library openexr = {"EXR", {IMAGE_EXR_FILE, NULL}, IMAGE_EXR_PACKAGE, symbols};

/* Everything of a file. */
typedef struct reading {
    functions call;
    image_source *source;
    image *out;
    unsigned char *bytes;
    size_t size;
    exr_context_t file;
    int part;
    const char *channel;
    exr_attr_box2i_t window, shown;
    exr_decode_pipeline_t decode;
    bool decoding;
    size_t have; /* bytes of out->data */
} reading;

static int64_t give(exr_const_context_t file, void *of, void *to, uint64_t size, uint64_t offset,
                    exr_stream_error_func_ptr_t failed) {
    const reading *r = of;
    (void)file, (void)failed;
    if (offset >= r->size)
        return 0;
    const uint64_t some = size < r->size - offset ? size : r->size - offset;
    memcpy(to, r->bytes + offset, some);
    return (int64_t)some;
}

static int64_t give_size(exr_const_context_t file, void *of) {
    (void)file;
    return (int64_t)((const reading *)of)->size;
}

static void say_nothing(exr_const_context_t file, exr_result_t code, const char *message) {
    (void)file, (void)code, (void)message;
}

static bool damaged(reading *r, exr_result_t code) {
    if (code == EXR_ERR_FEATURE_NOT_IMPLEMENTED)
        return source_fail(r->source, "EXR: %s does not read its compression: save it with ZIP or PIZ",
                           openexr.files[0]);
    return source_fail(r->source, "damaged EXR: %s", r->call.exr_get_default_error_message(code));
}

/* ---- Which channel ----------------------------------------------------------------------------------------------- */

static bool is_flat(const reading *r, int part) {
    exr_storage_t storage;
    return r->call.exr_get_storage(r->file, part, &storage) == EXR_ERR_SUCCESS &&
           (storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED);
}

enum { NAME_SIZE = 256 };

/* Behind the name of its part, where there are several. */
static const char *full_name(const reading *r, int part, const char *channel, char out[NAME_SIZE]) {
    const char *name = NULL;
    int parts = 0;
    r->call.exr_get_count(r->file, &parts);
    if (parts > 1 && r->call.exr_get_name(r->file, part, &name) == EXR_ERR_SUCCESS && name != NULL)
        snprintf(out, NAME_SIZE, "%s.%s", name, channel);
    else
        snprintf(out, NAME_SIZE, "%s", channel);
    return out;
}

static const exr_attr_chlist_entry_t *find_entry(const reading *r, int part, const char *name) {
    const exr_attr_chlist_t *list;
    if (r->call.exr_get_channels(r->file, part, &list) != EXR_ERR_SUCCESS)
        return NULL;
    for (int i = 0; i < list->num_channels; i++)
        if (strcmp(list->entries[i].name.str, name) == 0)
            return &list->entries[i];
    return NULL;
}

/* Another channel of its layer. */
static const exr_attr_chlist_entry_t *find_beside(const reading *r, int part, const char *channel, const char *last) {
    char name[NAME_SIZE];
    snprintf(name, sizeof name, "%.*s%s", (int)channel_last(channel), channel, last);
    return find_entry(r, part, name);
}

/* Z of a place or of a normal. */
static bool is_of_vector(const reading *r, int part, const char *channel) {
    const bool small = channel[channel_last(channel)] == 'z';
    return find_beside(r, part, channel, small ? "x" : "X") != NULL &&
           find_beside(r, part, channel, small ? "y" : "Y") != NULL;
}

static bool fits(const reading *r, int part, const char *channel, const char *wanted, channel_likeness how) {
    char full[NAME_SIZE];
    full_name(r, part, channel, full);
    if (how == CHANNEL_SAME || how == CHANNEL_LAYER)
        return channel_is(channel, wanted, how) || channel_is(full, wanted, how);
    return channel_is(channel, wanted, how) && (strcasecmp(wanted, "Z") != 0 || !is_of_vector(r, part, channel));
}

static bool find_like(reading *r, const char *wanted, channel_likeness how) {
    int parts = 0;
    const exr_attr_chlist_t *list;
    r->call.exr_get_count(r->file, &parts);
    for (int part = 0; part < parts; part++) {
        if (!is_flat(r, part) || r->call.exr_get_channels(r->file, part, &list) != EXR_ERR_SUCCESS)
            continue;
        for (int i = 0; i < list->num_channels; i++)
            if (wanted == NULL ? list->num_channels == 1 : fits(r, part, list->entries[i].name.str, wanted, how)) {
                r->part = part;
                r->channel = list->entries[i].name.str;
                return true;
            }
    }
    return false;
}

static void add_name(char *names, size_t size, const char *name) {
    const size_t used = strlen(names);
    if (used + 48 < size)
        append(names, size, "%s%.40s", used > 0 ? ", " : "", name);
    else if (names[used - 1] != '.')
        append(names, size, ", ...");
}

/* All but the one that is read. @return how many parts are flat */
static int name_channels(reading *r, char *names, size_t size) {
    int parts = 0, flat = 0;
    const exr_attr_chlist_t *list;
    char name[NAME_SIZE];
    r->call.exr_get_count(r->file, &parts);
    for (int part = 0; part < parts; part++) {
        if (!is_flat(r, part) || r->call.exr_get_channels(r->file, part, &list) != EXR_ERR_SUCCESS)
            continue;
        flat++;
        for (int i = 0; i < list->num_channels; i++)
            if (list->entries[i].name.str != r->channel)
                add_name(names, size, full_name(r, part, list->entries[i].name.str, name));
    }
    return flat;
}

static bool no_channel(reading *r) {
    char names[128] = "";
    if (name_channels(r, names, sizeof names) == 0)
        return source_fail(r->source, "EXR: it is deep, with any number of samples a pixel: flatten it");
    if (r->source->asked.channel != NULL)
        return source_fail(r->source, "EXR: has no channel %.40s, but %s", r->source->asked.channel, names);
    return source_fail(r->source, "EXR: has no channel Z, depth or R, but %s: --channel NAME takes one", names);
}

static bool find_channel(reading *r) {
    const char *asked = r->source->asked.channel;
    if (asked != NULL)
        return find_like(r, asked, CHANNEL_SAME) || no_channel(r);
    for (channel_likeness how = CHANNEL_CASE; how <= CHANNEL_LAYER; how++)
        if (find_like(r, "Z", how) || find_like(r, "depth", how))
            return true;
    return find_like(r, "R", CHANNEL_CASE) || find_like(r, NULL, CHANNEL_SAME) || no_channel(r);
}

/* Null where it gives back what it was given, as all do for whole numbers. */
static const char *lossy_name(const reading *r, exr_pixel_type_t type) {
    exr_compression_t how = EXR_COMPRESSION_NONE;
    r->call.exr_get_compression(r->file, r->part, &how);
    switch ((int)how) {
    case EXR_COMPRESSION_PXR24: /* which cuts floats to 24 bits */
        return type == EXR_PIXEL_FLOAT ? "PXR24" : NULL;
    case EXR_COMPRESSION_B44: /* halves alone */
        return type == EXR_PIXEL_HALF ? "B44" : NULL;
    case EXR_COMPRESSION_B44A:
        return type == EXR_PIXEL_HALF ? "B44A" : NULL;
    case EXR_COMPRESSION_DWAA:
        return type != EXR_PIXEL_UINT && channel_is_colour(r->channel) ? "DWAA" : NULL;
    case EXR_COMPRESSION_DWAB:
        return type != EXR_PIXEL_UINT && channel_is_colour(r->channel) ? "DWAB" : NULL;
    default:
        return how < EXR_COMPRESSION_PXR24 ? NULL : "an unknown one";
    }
}

static uint64_t side_of(int32_t first, int32_t last) {
    return (uint64_t)((int64_t)last - first + 1);
}

static bool find_shape(reading *r) {
    static const image_type types[] = {
        [EXR_PIXEL_UINT] = IMAGE_U32, [EXR_PIXEL_HALF] = IMAGE_F16, [EXR_PIXEL_FLOAT] = IMAGE_F32};
    const exr_attr_chlist_entry_t *entry = find_entry(r, r->part, r->channel);
    exr_result_t code = r->call.exr_get_data_window(r->file, r->part, &r->window);
    if (code == EXR_ERR_SUCCESS)
        code = r->call.exr_get_display_window(r->file, r->part, &r->shown);
    if (code != EXR_ERR_SUCCESS || entry == NULL)
        return damaged(r, code);
    const exr_attr_box2i_t *w = &r->window;
    if (entry->x_sampling != 1 || entry->y_sampling != 1)
        return source_fail(r->source, "EXR: channel %.40s has not a sample for every pixel", r->channel);
    if ((unsigned)entry->pixel_type > EXR_PIXEL_FLOAT)
        return source_fail(r->source, "EXR: channel %.40s is neither half, float nor uint", r->channel);
    const char *lossy = lossy_name(r, entry->pixel_type);
    const bool good = source_shape(r->source, r->out, side_of(w->min.x, w->max.x), side_of(w->min.y, w->max.y), 1,
                                   types[entry->pixel_type]);
    r->out->lossy = lossy;
    return good;
}

/* ---- Samples ------------------------------------------------------------------------------------------------------*/

/* A chunk that begins at that pixel, of at most so many. */
static bool read_chunk(reading *r, const exr_chunk_info_t *chunk, uint32_t x, uint32_t y) {
    const uint64_t most = UINT64_C(1) << 30;
    image *out = r->out;
    const size_t size = image_type_size(out->type), row = out->width * size;
    if (chunk->width < 1 || chunk->height < 1 || (uint32_t)chunk->width > out->width - x ||
        (uint32_t)chunk->height > out->height - y || chunk->unpacked_size > most || chunk->packed_size > r->size)
        return source_fail(r->source, "damaged EXR: a block does not fit");
    if (!source_grow(r->source, out, &r->have, (y + (size_t)chunk->height) * row))
        return false;
    exr_result_t code = r->decoding ? r->call.exr_decoding_update(r->file, r->part, chunk, &r->decode)
                                    : r->call.exr_decoding_initialize(r->file, r->part, chunk, &r->decode);
    r->decoding = r->decoding || code == EXR_ERR_SUCCESS;
    for (int i = 0; code == EXR_ERR_SUCCESS && i < r->decode.channel_count; i++) {
        exr_coding_channel_info_t *c = &r->decode.channels[i];
        const bool wanted = strcmp(c->channel_name, r->channel) == 0;
        c->decode_to_ptr = wanted ? (unsigned char *)out->data + y * row + x * size : NULL;
        c->user_pixel_stride = (int32_t)size;
        c->user_line_stride = (int32_t)row;
        c->user_bytes_per_element = c->bytes_per_element;
        c->user_data_type = c->data_type;
        if (wanted && (c->height != chunk->height || c->width != chunk->width || (size_t)c->bytes_per_element != size))
            return source_fail(r->source, "damaged EXR: a block has another shape than the image");
    }
    if (code == EXR_ERR_SUCCESS)
        code = r->call.exr_decoding_choose_default_routines(r->file, r->part, &r->decode);
    if (code == EXR_ERR_SUCCESS)
        code = r->call.exr_decoding_run(r->file, r->part, &r->decode);
    return code == EXR_ERR_SUCCESS || damaged(r, code);
}

static bool read_scanlines(reading *r) {
    int32_t lines = 0;
    exr_result_t code = r->call.exr_get_scanlines_per_chunk(r->file, r->part, &lines);
    for (uint32_t y = 0; code == EXR_ERR_SUCCESS && y < r->out->height; y += (uint32_t)lines) {
        exr_chunk_info_t chunk;
        code = lines < 1 ? EXR_ERR_CORRUPT_CHUNK
                         : r->call.exr_read_scanline_chunk_info(r->file, r->part, r->window.min.y + (int)y, &chunk);
        if (code == EXR_ERR_SUCCESS && !read_chunk(r, &chunk, 0, y))
            return false;
    }
    return code == EXR_ERR_SUCCESS || damaged(r, code);
}

static bool read_tiles(reading *r) {
    uint32_t width = 0, height = 0;
    exr_tile_level_mode_t levels;
    exr_tile_round_mode_t rounding;
    exr_result_t code = r->call.exr_get_tile_descriptor(r->file, r->part, &width, &height, &levels, &rounding);
    if (code == EXR_ERR_SUCCESS && (width < 1 || height < 1))
        code = EXR_ERR_CORRUPT_CHUNK;
    for (uint64_t y = 0; code == EXR_ERR_SUCCESS && y < r->out->height; y += height)
        for (uint64_t x = 0; code == EXR_ERR_SUCCESS && x < r->out->width; x += width) {
            exr_chunk_info_t chunk;
            code =
                r->call.exr_read_tile_chunk_info(r->file, r->part, (int)(x / width), (int)(y / height), 0, 0, &chunk);
            if (code == EXR_ERR_SUCCESS && !read_chunk(r, &chunk, (uint32_t)x, (uint32_t)y))
                return false;
        }
    return code == EXR_ERR_SUCCESS || damaged(r, code);
}

static bool read_samples(reading *r) {
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    r->call.exr_get_storage(r->file, r->part, &storage);
    return storage == EXR_STORAGE_TILED ? read_tiles(r) : read_scanlines(r);
}

/* Whether another channel of the part holds what was read. */
static bool holds_same(reading *r, const char *name, bool *same) {
    reading other = *r;
    image made = *r->out;
    made.data = NULL;
    other.out = &made;
    other.channel = name;
    other.have = 0;
    const bool good = read_samples(&other);
    *same = good && memcmp(made.data, r->out->data, image_bytes(&made)) == 0;
    r->decode = other.decode;
    r->decoding = other.decoding;
    free(made.data);
    return good;
}

/* Which other colour of its layer, if any, a red channel differs from. */
static bool compare_colours(reading *r) {
    static const char *const others[] = {"G", "B"};
    const exr_attr_chlist_entry_t *red = find_entry(r, r->part, r->channel);
    for (size_t i = 0; i < 2 && r->out->unlike == NULL && strcasecmp(r->channel + channel_last(r->channel), "R") == 0;
         i++) {
        const exr_attr_chlist_entry_t *entry = find_beside(r, r->part, r->channel, others[i]);
        bool same =
            entry == NULL || (entry->pixel_type == red->pixel_type && entry->x_sampling == 1 && entry->y_sampling == 1);
        if (entry != NULL && same && !holds_same(r, entry->name.str, &same))
            return false;
        r->out->unlike = same ? NULL : others[i];
    }
    return true;
}

/* ---- The display window ------------------------------------------------------------------------------------------ */

/* Rows of what is shown; where there is nothing of them, NaN. */
static void place(const reading *r, const image *from, image *to) {
    const size_t size = image_type_size(to->type);
    const int64_t left = (int64_t)r->window.min.x - r->shown.min.x, top = (int64_t)r->window.min.y - r->shown.min.y;
    const int64_t first = left > 0 ? left : 0, most = left + from->width, last = most < to->width ? most : to->width;
    memset(to->data, 0xFF, image_bytes(to)); /* a NaN of either type */
    for (int64_t y = 0; y < to->height; y++)
        if (y >= top && y < top + from->height && first < last)
            memcpy((char *)to->data + ((size_t)y * to->width + (size_t)first) * size,
                   (const char *)from->data + ((size_t)(y - top) * from->width + (size_t)(first - left)) * size,
                   (size_t)(last - first) * size);
}

static bool show(reading *r) {
    const exr_attr_box2i_t *w = &r->window, *d = &r->shown;
    image made = *r->out;
    if (memcmp(w, d, sizeof *d) == 0)
        return true;
    if (w->min.x > d->max.x || w->max.x < d->min.x || w->min.y > d->max.y || w->max.y < d->min.y)
        return source_fail(r->source, "EXR: its data window %d,%d to %d,%d has no pixel of its display window",
                           w->min.x, w->min.y, w->max.x, w->max.y);
    if (!source_shape(r->source, &made, side_of(d->min.x, d->max.x), side_of(d->min.y, d->max.y), 1, made.type))
        return false;
    const bool covers = w->min.x <= d->min.x && w->min.y <= d->min.y && w->max.x >= d->max.x && w->max.y >= d->max.y;
    if (!covers && made.type == IMAGE_U32)
        return source_fail(r->source, "EXR: its data window is smaller than its display window, and whole numbers have "
                                      "none for no depth: save it whole, or as float");
    made.data = malloc(image_bytes(&made));
    if (made.data == NULL)
        return source_fail(r->source, "out of memory: %u x %u pixels", made.width, made.height);
    place(r, r->out, &made);
    free(r->out->data);
    *r->out = made;
    return true;
}

static bool read_file(reading *r) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = say_nothing;
    how.user_data = r;
    how.read_fn = give;
    how.size_fn = give_size;
    const exr_result_t code = r->call.exr_start_read(&r->file, "image", &how);
    if (code != EXR_ERR_SUCCESS)
        return damaged(r, code);
    if (!find_channel(r) || !find_shape(r))
        return false;
    char name[NAME_SIZE];
    full_name(r, r->part, r->channel, name);
    r->out->named_depth = channel_of_depth(name);
    snprintf(r->out->channel, sizeof r->out->channel, "%.*s", IMAGE_NAMES_SIZE - 1, name);
    name_channels(r, r->out->others, sizeof r->out->others);
    return read_samples(r) && (r->source->asked.channel != NULL || compare_colours(r)) && show(r);
}

static bool read_exr(image_source *source, image *out) {
    reading r = {.source = source, .out = out, .decode = EXR_DECODE_PIPELINE_INITIALIZER};
    if (!source_library(source, &openexr, r.call.all) || !source_all(source, &r.bytes, &r.size))
        return false;
    const bool good = read_file(&r);
    if (r.decoding)
        r.call.exr_decoding_destroy(r.file, &r.decode);
    if (r.file != NULL)
        r.call.exr_finish(&r.file);
    free(r.bytes);
    return good;
}

#else

static bool read_exr(image_source *source, image *out) {
    (void)out;
    return source_fail(source, "EXR is not read by this build, which had no header openexr.h: Debian's package "
                               "libopenexr-dev has it");
}

#endif

const image_kind image_kind_exr = {
    .name = "EXR",
    .ending = ".exr",
    .magic = {"\x76\x2f\x31\x01", NULL},
    .magic_size = 4,
    .types = 1U << IMAGE_U32 | 1U << IMAGE_F16 | 1U << IMAGE_F32,
    .channels = 1U << 1,
    .read = read_exr,
};
