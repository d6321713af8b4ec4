/* See picture_in.h. Stands in where libwebp is not installed: refuses, and says what to install. */
#include "picture_in.h"

const char webp_in_reason[] =
    "is a WebP picture, and this was built without libwebp; install libwebp-dev (Debian) and make again";

bool webp_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    (void)in;
    (void)bytes;
    (void)n;
    return false;
}
