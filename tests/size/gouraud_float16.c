/* A mesh in Gouraud shading, with depth in floating point. */
#include "picture.h"

PICTURE(2);

int main(void)
{
    static uint16_t ramp[PH_RAMP_SIZE];
    static const struct ph_material material = {
        .shading = PH_SHADE_GOURAUD, .ambient = FX_HALF, .diffuse = FX_HALF, .ramp = ramp};
    const struct ph_config config = {PICTURE_CONFIG, .depth_format = PH_DEPTH_FLOAT16};
    const int status = ph_renderer_init(&renderer, &config);
    ph_material_ramp(ramp, 255, 160, 0, 0);
    return status != PH_OK ? status : show_frames(&renderer, &material, pixels);
}
