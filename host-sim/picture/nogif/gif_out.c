#include "gif_out.h"

#include "hal.h"

const char *const gif_out_reason = "this was built without giflib; install libgif-dev (Debian) and make again";

struct gif_out *gif_out_new(void)
{
    return NULL;
}

int gif_out_add(struct gif_out *gif, const struct ppm *picture)
{
    (void)gif;
    (void)picture;
    return HAL_ENOSYS;
}

int gif_out_save(struct gif_out *gif, const char *path, uint32_t scale)
{
    (void)gif;
    (void)path;
    (void)scale;
    return HAL_ENOSYS;
}

void gif_out_free(struct gif_out *gif)
{
    (void)gif;
}
