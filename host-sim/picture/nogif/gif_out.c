/* See gif_out.h. Stands in where giflib is not installed: refuses, and says what to install. */
#include "gif_out.h"

#include "hal.h"

const char *const gif_out_reason = "this was built without giflib; install libgif-dev (Debian) and make again";

int gif_out_new(struct gif_out **gif, const char *path, uint32_t scale)
{
    (void)path, (void)scale;
    *gif = NULL;
    return HAL_ENOSYS;
}

uint32_t gif_out_count(const struct gif_out *gif)
{
    (void)gif;
    return 0;
}

uint32_t gif_out_every(const struct gif_out *gif)
{
    (void)gif;
    return 1;
}

int gif_out_add(struct gif_out *gif, const struct ppm *picture)
{
    (void)gif;
    (void)picture;
    return HAL_ENOSYS;
}

int gif_out_save(const struct gif_out *gif, const char *path)
{
    (void)gif;
    (void)path;
    return HAL_ENOSYS;
}

void gif_out_free(struct gif_out *gif)
{
    (void)gif;
}
