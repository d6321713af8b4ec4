#include "png_in.h"

#include "hal.h"

const char png_in_reason[] = "is a PNG, and this was built without libpng; install libpng-dev (Debian) and make again";

int png_in_file(const char *path, struct ppm *picture)
{
    (void)path;
    (void)picture;
    return HAL_ENOSYS;
}

int png_in_memory(const void *bytes, size_t n, struct ppm *picture)
{
    (void)bytes;
    (void)n;
    (void)picture;
    return HAL_ENOSYS;
}
