/* See picture_in.h. Stands in where libpng is not installed: refuses, and says what to install. */
#include "picture_in.h"

const char png_in_reason[] = "is a PNG, and this was built without libpng; install libpng-dev (Debian) and make again";

bool png_in_memory(struct picture_in *in, const void *bytes, size_t n)
{
    (void)in;
    (void)bytes;
    (void)n;
    return false;
}
