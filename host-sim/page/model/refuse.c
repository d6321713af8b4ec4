/* What pinhole-asset reads by libraries that the page has not: it is refused in one line. */
#include "gltf_meshopt.h"
#include "model_assimp.h"
#include "picture_in.h"

bool model_assimp_read(struct model_shared *shared, struct model_scene *scene)
{
    (void)scene;
    return model_shared_failed(shared, "is no model that this page reads: OBJ, STL, PLY, glTF and GLB are");
}

const char *gltf_meshopt_unpack(const struct gltf_meshopt_view *view, const uint8_t *bytes, size_t n, void *to)
{
    (void)view, (void)bytes, (void)n, (void)to;
    return "is compressed by meshoptimizer, which pinhole-asset reads, and this page does not";
}

const char webp_in_reason[] = "is a WebP picture, which pinhole-asset reads, and this page does not";

bool webp_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    (void)in, (void)bytes, (void)n;
    return false;
}
