/* Points: squares or discs, whose sizes are in the world or in pixels. */
#include "picture.h"

PICTURE(2);

int main(void)
{
    static const struct ph_material material = {.colour = 0x1234};
    const struct ph_config config = {PICTURE_CONFIG, .depth_format = PH_DEPTH_FIXED16};
    struct ph_projection lens;
    int status = ph_renderer_init(&renderer, &config);
    status = status != PH_OK ? status : ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(20));
    while (status == PH_OK) {
        const struct ph_xform place = ph_xform_translate(0, 0, FX_INT(-3));
        const struct ph_points points = {
            .positions = positions, .count = 6, .size = FX_ONE, .in_world = display != 0, .round = display == 2};
        status = ph_frame_begin(&renderer, &ph_xform_identity, &lens, &light, 0);
        status = status != PH_OK ? status : ph_draw_points(&renderer, &points, &place, &material);
        ph_frame_bands(&renderer);
        for (uint32_t band = 0; ph_draw_band(&renderer, band, pixels) > 0; band++) {
            display = pixels[0];
        }
    }
    return status;
}
