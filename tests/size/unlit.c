/* A mesh in one colour, with depth of 16 bits. */
#include "picture.h"

PICTURE(2);

int main(void)
{
    static const struct ph_material material = {.shading = PH_SHADE_UNLIT, .colour = 0x1234};
    const struct ph_config config = {PICTURE_CONFIG, .depth_format = PH_DEPTH_FIXED16};
    const int status = ph_renderer_init(&renderer, &config);
    return status != PH_OK ? status : show_frames(&renderer, &material, pixels);
}
