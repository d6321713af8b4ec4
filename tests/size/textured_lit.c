/* A mesh with a texture times light, bilinear, of several levels. */
#include "picture.h"

PICTURE(2);

int main(void)
{
    static const uint16_t texels[5] = {0xffff, 0x1234, 0x1234, 0xffff, 0x5555};
    static const struct ph_texture texture = {
        .texels = texels, .log2_width = 1, .log2_height = 1, .filter = PH_FILTER_MIPMAP, .levels = 1};
    static const struct ph_material material = {
        .shading = PH_SHADE_TEXTURE_GOURAUD, .ambient = FX_HALF, .diffuse = FX_HALF, .texture = &texture};
    const struct ph_config config = {PICTURE_CONFIG, .depth_format = PH_DEPTH_FLOAT16};
    const int status = ph_renderer_init(&renderer, &config);
    return status != PH_OK ? status : show_frames(&renderer, &material, pixels);
}
