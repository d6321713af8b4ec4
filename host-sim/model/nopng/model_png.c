#include "model_png.h"

#include "hal.h"

const char model_png_reason[] =
    "is a PNG, and this was built without libpng; install libpng-dev (Debian) and make again";

int model_png_file(const char *path, struct ppm *picture)
{
    (void)path;
    (void)picture;
    return HAL_ENOSYS;
}

int model_png_memory(const void *bytes, size_t n, struct ppm *picture)
{
    (void)bytes;
    (void)n;
    (void)picture;
    return HAL_ENOSYS;
}
