/* See picture_in.h. Stands in where libjpeg is not installed: refuses, and says what to install. */
#include "picture_in.h"

const char jpeg_in_reason[] =
    "is a JPEG, and this was built without libjpeg; install libjpeg-dev (Debian) and make again";

bool jpeg_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    (void)in;
    (void)bytes;
    (void)n;
    return false;
}
