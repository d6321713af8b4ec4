/* See gltf_meshopt.h. Stands in where libmeshoptimizer is not installed: refuses, and says what to install. */
#include "gltf_meshopt.h"

const char *gltf_meshopt_unpack(const struct gltf_meshopt_view *view, const uint8_t *bytes, size_t n, void *to)
{
    (void)view;
    (void)bytes;
    (void)n;
    (void)to;
    return "is compressed, and this was built without libmeshoptimizer; install libmeshoptimizer-dev (Debian) and make "
           "again";
}
