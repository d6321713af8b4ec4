/* See gltf_file.h. Reads JSON, buffers and accessors, from files, chunks of a GLB and data: URIs. */
#include "gltf_file.h"

#include "gltf_meshopt.h"
#include "model.h"
#include "model_text.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const list_names[GLTF_LISTS] = {"accessors", "bufferViews", "buffers",   "nodes",  "scenes",
                                                   "meshes",    "materials",   "textures",  "images", "samplers",
                                                   "cameras",   "skins",       "animations"};

bool gltf_file_failed(struct gltf_file *file, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (file->error[0] == '\0') {
        vsnprintf(file->error, sizeof file->error, format, arguments);
    }
    va_end(arguments);
    return false;
}

static struct gltf_span none(void)
{
    return (struct gltf_span){NULL, 0};
}

const struct gltf_json *gltf_file_item(const struct gltf_file *file, enum gltf_list list, uint32_t i)
{
    return i < file->lists[list].count ? file->lists[list].items[i] : NULL;
}

uint32_t gltf_file_whole(const struct gltf_json *object, const char *key, uint32_t otherwise)
{
    const struct gltf_json *item = gltf_json_get(object, key);
    if (item == NULL) {
        return otherwise;
    }
    const double value = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : -1;
    return value >= 0 && value < GLTF_NONE && value == floor(value) ? (uint32_t)value : GLTF_NONE;
}

bool gltf_file_uses(const struct gltf_file *file, const char *extension)
{
    const struct gltf_json *item, *list = gltf_json_get(file->json, "extensionsUsed");
    bool is_used = false;
    GLTF_JSON_EACH(item, list)
    {
        is_used = is_used || (gltf_json_is(item, GLTF_JSON_STRING) && strcmp(item->text, extension) == 0);
    }
    return is_used;
}

double gltf_file_number(const struct gltf_json *object, const char *key, double otherwise)
{
    const struct gltf_json *item = gltf_json_get(object, key);
    return gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : otherwise;
}

bool gltf_file_vector(const struct gltf_json *object, const char *key, unsigned n, double *to)
{
    const struct gltf_json *item = gltf_json_get(object, key);
    if (!gltf_json_is(item, GLTF_JSON_ARRAY) || item->count != n) {
        return false;
    }
    for (item = item->child; item != NULL; item = item->next) {
        *to++ = gltf_json_is(item, GLTF_JSON_NUMBER) ? item->number : 0;
    }
    return true;
}

/* ---- bytes ----------------------------------------------------------------------------------------------------- */

static struct gltf_span read_whole(struct gltf_file *file, const char *path)
{
    size_t n = 0;
    const uint8_t *bytes = (const uint8_t *)model_text_load(path, &n);
    if (bytes == NULL) {
        gltf_file_failed(file, "%.100s cannot be opened", path);
    }
    return (struct gltf_span){bytes, n};
}

static int base64_value(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c != '\0' ? strchr(digits, c) : NULL;
    return at != NULL ? (int)(at - digits) : -1;
}

static struct gltf_span decode_base64(struct gltf_file *file, const char *text)
{
    uint8_t *bytes = malloc(strlen(text) / 4 * 3 + 4);
    size_t n = 0;
    uint32_t bits = 0;
    unsigned count = 0;
    for (; bytes != NULL && *text != '\0' && *text != '='; text++) {
        const int value = base64_value(*text);
        if (value < 0) {
            gltf_file_failed(file, "a data URI is no base64");
            return none();
        }
        bits = bits << 6 | (uint32_t)value;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes[n++] = (uint8_t)(bits >> count);
        }
    }
    return (struct gltf_span){bytes, n};
}

static int hex_value(char c)
{
    static const char digits[] = "0123456789abcdefABCDEF";
    const char *at = c != '\0' ? strchr(digits, c) : NULL;
    return at == NULL ? -1 : at - digits < 16 ? (int)(at - digits) : (int)(at - digits) - 6;
}

/* Turns %20 and its like into characters. */
static void decode_percent(char *text)
{
    char *to = text;
    for (const char *from = text; *from != '\0'; from++) {
        const int high = *from == '%' ? hex_value(from[1]) : -1, low = high >= 0 ? hex_value(from[2]) : -1;
        *to++ = low > 0 || (low == 0 && high > 0) ? (char)(high * 16 + low) : *from;
        from += low > 0 || (low == 0 && high > 0) ? 2 : 0;
    }
    *to = '\0';
}

struct gltf_span gltf_file_uri(struct gltf_file *file, const char *uri)
{
    char name[MODEL_PATH_BYTES], path[MODEL_PATH_BYTES];
    if (strncmp(uri, "data:", 5) == 0) {
        const char *text = strstr(uri, ";base64,");
        if (text == NULL) {
            gltf_file_failed(file, "a data URI is no base64");
            return none();
        }
        return decode_base64(file, text + 8);
    }
    if (snprintf(name, sizeof name, "%s", uri) >= (int)sizeof name) {
        gltf_file_failed(file, "a file name is too long");
        return none();
    }
    decode_percent(name);
    if (!model_folder_find(file->folder, name, path)) {
        gltf_file_failed(file, "%.100s cannot be opened", name);
        return none();
    }
    return read_whole(file, path);
}

static struct gltf_span read_buffer(struct gltf_file *file, uint32_t i)
{
    const struct gltf_json *buffer = gltf_file_item(file, GLTF_BUFFERS, i);
    const struct gltf_json *uri = gltf_json_get(buffer, "uri");
    const uint32_t length = gltf_file_whole(buffer, "byteLength", GLTF_NONE);
    const double said = gltf_file_number(buffer, "byteLength", -1);
    if (said > MODEL_FILE_MAX) {
        gltf_file_failed(file, "buffer %u has a byteLength of %.0f, and at most %u are read", i, said, MODEL_FILE_MAX);
        return none();
    }
    if (buffer == NULL || length == GLTF_NONE) {
        gltf_file_failed(file, "buffer %u is missing, or has no length", i);
        return none();
    }
    if (file->buffers[i].bytes == NULL) {
        const char *const text = gltf_json_text(uri);
        file->buffers[i] = text != NULL ? gltf_file_uri(file, text) : i == 0 ? file->glb : none();
    }
    if (file->buffers[i].bytes == NULL || file->buffers[i].n < length) {
        gltf_file_failed(file, "buffer %u has %zu bytes of %u", i, file->buffers[i].n, length);
        return none();
    }
    return (struct gltf_span){file->buffers[i].bytes, length};
}

/* The bytes of a buffer that an object names by buffer, byteOffset and byteLength. */
static struct gltf_span part_of_buffer(struct gltf_file *file, const struct gltf_json *from, uint32_t view)
{
    const struct gltf_span buffer = read_buffer(file, gltf_file_whole(from, "buffer", GLTF_NONE));
    const uint32_t offset = gltf_file_whole(from, "byteOffset", 0), n = gltf_file_whole(from, "byteLength", GLTF_NONE);
    if (buffer.bytes == NULL || n > buffer.n || offset > buffer.n - n) {
        gltf_file_failed(file, "bufferView %u is not inside a buffer", view);
        return none();
    }
    return (struct gltf_span){buffer.bytes + offset, n};
}

/* The number of a name in a list of n, the first where nothing is said; n: it is another. */
static unsigned name_in(const struct gltf_json *said, const char *const *names, unsigned n)
{
    unsigned i = 0;
    while (said != NULL && i < n && (gltf_json_text(said) == NULL || strcmp(gltf_json_text(said), names[i]) != 0)) {
        i++;
    }
    return i;
}

static struct gltf_span unpack(struct gltf_file *file, const struct gltf_json *from, uint32_t view)
{
    static const char *const modes[] = {"ATTRIBUTES", "TRIANGLES", "INDICES"};
    static const char *const filters[] = {"NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL"};
    const struct gltf_span packed = part_of_buffer(file, from, view);
    const struct gltf_meshopt_view how = {
        .count = gltf_file_whole(from, "count", 0),
        .stride = gltf_file_whole(from, "byteStride", 0),
        .mode = name_in(gltf_json_get(from, "mode"), modes, GLTF_MESHOPT_MODES),
        .filter = name_in(gltf_json_get(from, "filter"), filters, GLTF_MESHOPT_FILTERS),
    };
    const uint64_t n = (uint64_t)how.count * how.stride;
    uint8_t *bytes = packed.bytes != NULL && n > 0 && n <= MODEL_FILE_MAX ? malloc(n) : NULL;
    const char *why = bytes == NULL ? "is too large"
                      : how.mode == GLTF_MESHOPT_MODES || how.filter == GLTF_MESHOPT_FILTERS
                          ? "is compressed in a way that is not known"
                          : gltf_meshopt_unpack(&how, packed.bytes, packed.n, bytes);
    if (why != NULL) {
        free(bytes);
        gltf_file_failed(file, "bufferView %u %s", view, why);
        return none();
    }
    return (struct gltf_span){bytes, n};
}

struct gltf_span gltf_file_view(struct gltf_file *file, uint32_t view)
{
    const struct gltf_json *item = gltf_file_item(file, GLTF_VIEWS, view);
    const struct gltf_json *extensions = gltf_json_get(item, "extensions");
    const struct gltf_json *draft = gltf_json_get(extensions, "EXT_meshopt_compression"),
                           *packed = draft != NULL ? draft : gltf_json_get(extensions, "KHR_meshopt_compression");
    if (packed == NULL) {
        return part_of_buffer(file, item, view);
    }
    if (file->unpacked[view].bytes == NULL) {
        file->unpacked[view] = unpack(file, packed, view);
    }
    return file->unpacked[view];
}

/* ---- accessors --------------------------------------------------------------------------------------------------- */

/* Where the elements of an accessor lie. */
struct elements {
    const uint8_t *bytes; /* NULL: all are 0 */
    size_t stride;
    uint32_t count, type;
    unsigned components;
    bool is_normalized;
};

static unsigned bytes_of(uint32_t type)
{
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : type == 5125 || type == 5126 ? 4 : 0;
}

static uint32_t bits_at(const uint8_t *p, unsigned bytes)
{
    uint32_t bits = 0;
    for (unsigned i = 0; i < bytes; i++) {
        bits |= (uint32_t)p[i] << 8 * i;
    }
    return bits;
}

static float number_at(const uint8_t *p, uint32_t type, bool is_normalized)
{
    const uint32_t bits = bits_at(p, bytes_of(type));
    float value;
    switch (type) {
    case 5120:
        return is_normalized ? fmaxf((int8_t)bits / 127.f, -1) : (int8_t)bits;
    case 5121:
        return is_normalized ? (float)bits / 255 : (float)bits;
    case 5122:
        return is_normalized ? fmaxf((int16_t)bits / 32767.f, -1) : (int16_t)bits;
    case 5123:
        return is_normalized ? (float)bits / 65535 : (float)bits;
    case 5125:
        return (float)bits;
    default:
        memcpy(&value, &bits, sizeof value);
        return value;
    }
}

/* Finds `count` elements from an offset of a view on. */
static bool find_elements(struct gltf_file *file, const struct gltf_json *from, struct elements *to)
{
    const uint32_t view = gltf_file_whole(from, "bufferView", GLTF_NONE),
                   offset = gltf_file_whole(from, "byteOffset", 0);
    const size_t size = (size_t)bytes_of(to->type) * to->components;
    const struct gltf_span bytes = gltf_file_view(file, view);
    const uint32_t stride = gltf_file_whole(gltf_file_item(file, GLTF_VIEWS, view), "byteStride", (uint32_t)size);
    if (bytes.bytes == NULL || size == 0 || stride < size || stride > 252 || offset > bytes.n ||
        (to->count > 0 && (bytes.n - offset < size || (bytes.n - offset - size) / stride < to->count - 1))) {
        return gltf_file_failed(file, "an accessor is not inside bufferView %u", view);
    }
    to->bytes = bytes.bytes + offset;
    to->stride = stride;
    return true;
}

static bool find_accessor(struct gltf_file *file, uint32_t i, struct elements *to)
{
    static const struct {
        const char *name;
        unsigned components;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    const struct gltf_json *item = gltf_file_item(file, GLTF_ACCESSORS, i);
    const char *type = gltf_json_text(gltf_json_get(item, "type"));
    *to = (struct elements){.count = gltf_file_whole(item, "count", GLTF_NONE),
                            .type = gltf_file_whole(item, "componentType", 0),
                            .is_normalized = gltf_json_is(gltf_json_get(item, "normalized"), GLTF_JSON_TRUE)};
    for (size_t k = 0; type != NULL && k < sizeof types / sizeof types[0]; k++) {
        to->components = strcmp(type, types[k].name) == 0 ? types[k].components : to->components;
    }
    if (to->components == 0 || to->count == 0 || to->count > GLTF_COUNT_MAX || bytes_of(to->type) == 0) {
        return gltf_file_failed(file, "accessor %u is missing, or has a type or count that cannot be", i);
    }
    return gltf_json_get(item, "bufferView") == NULL || find_elements(file, item, to);
}

/* Puts the values of a sparse accessor into their places. */
static bool add_sparse(struct gltf_file *file, const struct gltf_json *sparse, const struct elements *all,
                       float *numbers)
{
    const struct gltf_json *places = gltf_json_get(sparse, "indices");
    struct elements at = {.count = gltf_file_whole(sparse, "count", GLTF_NONE),
                          .type = gltf_file_whole(places, "componentType", 0),
                          .components = 1};
    struct elements values = *all;
    values.count = at.count;
    if (at.count > all->count || at.type == 5126 || !find_elements(file, places, &at) ||
        !find_elements(file, gltf_json_get(sparse, "values"), &values)) {
        return gltf_file_failed(file, "a sparse accessor is broken");
    }
    for (uint32_t i = 0; i < at.count; i++) {
        const uint32_t to = bits_at(at.bytes + i * at.stride, bytes_of(at.type));
        if (to >= all->count) {
            return gltf_file_failed(file, "a sparse accessor has an index that is not there");
        }
        for (unsigned c = 0; c < all->components; c++) {
            numbers[(size_t)to * all->components + c] =
                number_at(values.bytes + i * values.stride + c * bytes_of(all->type), all->type, all->is_normalized);
        }
    }
    return true;
}

float *gltf_file_numbers(struct gltf_file *file, uint32_t accessor, unsigned components, uint32_t *count)
{
    struct elements from;
    if (!find_accessor(file, accessor, &from)) {
        return NULL;
    }
    const struct gltf_json *sparse = gltf_json_get(gltf_file_item(file, GLTF_ACCESSORS, accessor), "sparse");
    float *numbers = calloc((size_t)from.count * from.components, sizeof *numbers);
    if (from.components != components || numbers == NULL) {
        gltf_file_failed(file, "accessor %u has not the %u components that its use asks for", accessor, components);
        return NULL;
    }
    for (uint32_t i = 0; from.bytes != NULL && i < from.count; i++) {
        for (unsigned c = 0; c < components; c++) {
            numbers[(size_t)i * components + c] =
                number_at(from.bytes + i * from.stride + c * bytes_of(from.type), from.type, from.is_normalized);
        }
    }
    *count = from.count;
    return sparse == NULL || add_sparse(file, sparse, &from, numbers) ? numbers : NULL;
}

uint32_t *gltf_file_indices(struct gltf_file *file, uint32_t accessor, uint32_t *count)
{
    struct elements from;
    if (!find_accessor(file, accessor, &from)) {
        return NULL;
    }
    uint32_t *indices = calloc(from.count, sizeof *indices);
    if (from.components != 1 || from.type == 5126 || indices == NULL) {
        gltf_file_failed(file, "accessor %u holds no indices", accessor);
        return NULL;
    }
    for (uint32_t i = 0; from.bytes != NULL && i < from.count; i++) {
        indices[i] = bits_at(from.bytes + i * from.stride, bytes_of(from.type));
    }
    *count = from.count;
    return indices;
}

/* ---- the file ---------------------------------------------------------------------------------------------------- */

static bool find_lists(struct gltf_file *file)
{
    for (int list = 0; list < GLTF_LISTS; list++) {
        const struct gltf_json *array = gltf_json_get(file->json, list_names[list]);
        const struct gltf_json *item = gltf_json_is(array, GLTF_JSON_ARRAY) ? array->child : NULL;
        const size_t n = item != NULL ? array->count : 0;
        file->lists[list].items = calloc(n + 1, sizeof(void *));
        file->lists[list].count = (uint32_t)n;
        for (size_t i = 0; file->lists[list].items != NULL && item != NULL; i++, item = item->next) {
            file->lists[list].items[i] = item;
        }
    }
    file->buffers = calloc(file->lists[GLTF_BUFFERS].count + 1, sizeof *file->buffers);
    file->unpacked = calloc(file->lists[GLTF_VIEWS].count + 1, sizeof *file->unpacked);
    return (file->buffers != NULL && file->unpacked != NULL) || gltf_file_failed(file, "it needs too much memory");
}

/* What a file may ask for: without these the model would be something else. */
static bool check_required(struct gltf_file *file)
{
    static const char *const known[] = {"KHR_texture_transform",   "KHR_materials_unlit",
                                        "KHR_mesh_quantization",   "KHR_lights_punctual",
                                        "EXT_meshopt_compression", "KHR_meshopt_compression",
                                        "EXT_texture_webp",        "KHR_materials_pbrSpecularGlossiness"};
    const struct gltf_json *item, *list = gltf_json_get(file->json, "extensionsRequired");
    GLTF_JSON_EACH(item, list)
    {
        bool is_known = false;
        for (size_t i = 0; gltf_json_is(item, GLTF_JSON_STRING) && i < sizeof known / sizeof known[0]; i++) {
            is_known = is_known || strcmp(item->text, known[i]) == 0;
        }
        if (!is_known) {
            return gltf_file_failed(file, "it needs the extension %.60s, which is not read: export it without",
                                    gltf_json_is(item, GLTF_JSON_STRING) ? item->text : "?");
        }
    }
    return true;
}

/* Splits a GLB into its chunks; a file of text is the JSON itself. */
static bool split_chunks(struct gltf_file *file, struct gltf_span all, struct gltf_span *json)
{
    *json = all;
    if (all.n == 0 || memcmp(all.bytes, "glTF", all.n < 4 ? all.n : 4) != 0) {
        return all.n > 0 || gltf_file_failed(file, "it is empty");
    }
    const uint32_t version = all.n < 8 ? 2 : bits_at(all.bytes + 4, 4);
    const uint32_t length = all.n < 12 ? 12 : bits_at(all.bytes + 8, 4);
    if (version != 2) {
        return gltf_file_failed(file, "a GLB of version %u, not 2", version);
    }
    if (length > all.n) {
        return gltf_file_failed(file, "it is %zu bytes long, its header %s %u: it is cut off", all.n,
                                all.n < 12 ? "alone" : "says", length);
    }
    const uint32_t n = length < 20 ? 0 : bits_at(all.bytes + 12, 4);
    if (length < 20 || n > all.n - 20 || memcmp(all.bytes + 16, "JSON", 4) != 0) {
        return gltf_file_failed(file, "a GLB with a header that is broken");
    }
    *json = (struct gltf_span){all.bytes + 20, n};
    const size_t rest = all.n - 20 - n;
    const uint8_t *next = json->bytes + n;
    if (rest >= 8 && memcmp(next + 4, "BIN", 4) == 0) {
        const uint32_t bytes = bits_at(next, 4);
        file->glb = (struct gltf_span){next + 8, bytes < rest - 8 ? bytes : rest - 8};
    }
    return true;
}

bool gltf_file_open(struct gltf_file *file, struct model_folder *folder)
{
    struct gltf_span json;
    *file = (struct gltf_file){.folder = folder};
    const struct gltf_span all = read_whole(file, folder->model);
    if (all.bytes == NULL || !split_chunks(file, all, &json)) {
        return false;
    }
    const char *why = NULL;
    size_t at = 0;
    file->json = gltf_json_parse((char *)(uintptr_t)json.bytes, json.n, &why, &at);
    const struct gltf_json *asset = gltf_json_get(file->json, "asset");
    const char *version = gltf_json_text(gltf_json_get(asset, "version"));
    if (file->json == NULL) {
        return gltf_file_failed(file, "its JSON is broken at byte %zu: %s", at, why);
    }
    if (version == NULL || strncmp(version, "2.", 2) != 0) {
        return gltf_file_failed(file, "it is no glTF of version 2");
    }
    return check_required(file) && find_lists(file);
}
