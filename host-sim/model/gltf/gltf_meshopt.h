/*
 * gltf_meshopt: the bytes of a bufferView that meshoptimizer compressed (EXT_meshopt_compression, and the streams of
 * KHR_meshopt_compression that the installed library knows).
 *
 * meshopt/ unpacks with libmeshoptimizer; nomeshopt/ refuses.
 */
#ifndef GLTF_MESHOPT_H
#define GLTF_MESHOPT_H

#include <stddef.h>
#include <stdint.h>

enum gltf_meshopt_mode { GLTF_MESHOPT_ATTRIBUTES, GLTF_MESHOPT_TRIANGLES, GLTF_MESHOPT_INDICES, GLTF_MESHOPT_MODES };

enum gltf_meshopt_filter {
    GLTF_MESHOPT_NONE,
    GLTF_MESHOPT_OCTAHEDRAL,
    GLTF_MESHOPT_QUATERNION,
    GLTF_MESHOPT_EXPONENTIAL,
    GLTF_MESHOPT_FILTERS
};

/* What the file says of the view. Any numbers will do: those that cannot be are refused. */
struct gltf_meshopt_view {
    uint32_t count, stride; /* of its elements, bytes from one to the next */
    enum gltf_meshopt_mode mode;
    enum gltf_meshopt_filter filter;
};

/* Unpacks n bytes into count * stride bytes. Returns NULL, or why not ("is .."). */
const char *gltf_meshopt_unpack(const struct gltf_meshopt_view *view, const uint8_t *bytes, size_t n, void *to);

#endif
