/* See gltf_meshopt.h. Unpacks with libmeshoptimizer, whose decoders take any bytes, but not any stride. */
#include "gltf_meshopt.h"

#include <meshoptimizer.h>

static int unpack(const struct gltf_meshopt_view *view, const uint8_t *bytes, size_t n, void *to)
{
    switch (view->mode) {
    case GLTF_MESHOPT_ATTRIBUTES:
        return meshopt_decodeVertexBuffer(to, view->count, view->stride, bytes, n);
    case GLTF_MESHOPT_TRIANGLES:
        return meshopt_decodeIndexBuffer(to, view->count, view->stride, bytes, n);
    default:
        return meshopt_decodeIndexSequence(to, view->count, view->stride, bytes, n);
    }
}

static void undo_filter(const struct gltf_meshopt_view *view, void *to)
{
    switch (view->filter) {
    case GLTF_MESHOPT_OCTAHEDRAL:
        meshopt_decodeFilterOct(to, view->count, view->stride);
        break;
    case GLTF_MESHOPT_QUATERNION:
        meshopt_decodeFilterQuat(to, view->count, view->stride);
        break;
    case GLTF_MESHOPT_EXPONENTIAL:
        meshopt_decodeFilterExp(to, view->count, view->stride);
        break;
    default:
        break;
    }
}

/* Whether the extension allows this stride. */
static int is_sound(const struct gltf_meshopt_view *view)
{
    const uint32_t stride = view->stride;
    if (view->mode != GLTF_MESHOPT_ATTRIBUTES) {
        return (stride == 2 || stride == 4) && view->filter == GLTF_MESHOPT_NONE &&
               (view->mode != GLTF_MESHOPT_TRIANGLES || view->count % 3 == 0);
    }
    return stride > 0 && stride <= 256 && stride % 4 == 0 &&
           (view->filter != GLTF_MESHOPT_OCTAHEDRAL || stride == 4 || stride == 8) &&
           (view->filter != GLTF_MESHOPT_QUATERNION || stride == 8);
}

const char *gltf_meshopt_unpack(const struct gltf_meshopt_view *view, const uint8_t *bytes, size_t n, void *to)
{
    if (!is_sound(view)) {
        return "is compressed with a stride, count or filter that cannot be";
    }
    if (unpack(view, bytes, n, to) != 0) {
        return "is compressed, and broken, or packed in a newer way than the libmeshoptimizer here reads";
    }
    undo_filter(view, to);
    return NULL;
}
