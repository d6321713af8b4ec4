/*
 * gltf_file: a glTF 2.0 or GLB file: its JSON, and the numbers that its accessors name.
 *
 * The JSON stays whole, so that nothing the file says is lost: interpolation and tangents of animations, skins and
 * morph targets are read from it with the same calls. Every size, offset and index is checked before it is used.
 * Nothing is freed: the process that reads a model ends when it is done.
 */
#ifndef GLTF_FILE_H
#define GLTF_FILE_H

#include "gltf_json.h"
#include "model_folder.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct gltf_span {
    const uint8_t *bytes;
    size_t n;
};

/* The arrays at the top of the JSON. */
enum gltf_list {
    GLTF_ACCESSORS,
    GLTF_VIEWS,
    GLTF_BUFFERS,
    GLTF_NODES,
    GLTF_SCENES,
    GLTF_MESHES,
    GLTF_MATERIALS,
    GLTF_TEXTURES,
    GLTF_IMAGES,
    GLTF_SAMPLERS,
    GLTF_CAMERAS,
    GLTF_SKINS,
    GLTF_ANIMATIONS,
    GLTF_LISTS
};

struct gltf_file {
    struct model_folder *folder;
    struct gltf_json *json;
    struct gltf_span glb; /* the binary chunk of a GLB */
    struct {
        const struct gltf_json **items;
        uint32_t count;
    } lists[GLTF_LISTS];
    struct gltf_span *buffers;  /* read when first asked for */
    struct gltf_span *unpacked; /* views that were compressed */
    char error[160];            /* why a call failed */
};

#define GLTF_NONE      UINT32_MAX
#define GLTF_COUNT_MAX 12000000u /* elements of an accessor */

/* A function that fails returns false, NULL or an empty span after writing file->error. */
bool gltf_file_failed(struct gltf_file *file, const char *format, ...) __attribute__((format(printf, 2, 3)));
bool gltf_file_open(struct gltf_file *file, struct model_folder *folder);
struct gltf_span gltf_file_view(struct gltf_file *file, uint32_t view);

/* The bytes of a URI: data in base64, or a file that the model may name. */
struct gltf_span gltf_file_uri(struct gltf_file *file, const char *uri);

/* Reads an accessor as count x components numbers; sparse values are in place, integers are normalized if it says so.
 */
float *gltf_file_numbers(struct gltf_file *file, uint32_t accessor, unsigned components, uint32_t *count);

/* Reads an accessor of unsigned integers. */
uint32_t *gltf_file_indices(struct gltf_file *file, uint32_t accessor, uint32_t *count);

/* Item i of a list. NULL: there is none. */
const struct gltf_json *gltf_file_item(const struct gltf_file *file, enum gltf_list list, uint32_t i);

/* A whole number below 2^32 - 1 of an object, or `otherwise` where the object or the number is missing. A number of
 * another kind gives GLTF_NONE. */
uint32_t gltf_file_whole(const struct gltf_json *object, const char *key, uint32_t otherwise);

/* Whether the file says that it uses an extension. */
bool gltf_file_uses(const struct gltf_file *file, const char *extension);

/* Any number of an object, or `otherwise`. */
double gltf_file_number(const struct gltf_json *object, const char *key, double otherwise);

/* Reads n numbers of an array in an object; leaves `to` as it is where they are not there. */
bool gltf_file_vector(const struct gltf_json *object, const char *key, unsigned n, double *to);

#endif
