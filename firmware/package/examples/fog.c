/* Fog and glass: columns that fade into mist, behind a pane of coloured glass. */
#include "example.h"
#include "shapes.h"

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape cube, ground;
    static uint16_t ramp[PH_RAMP_SIZE], texels[256];
    static struct ph_texture checks;
    static const struct ph_blend through = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 14};
    const struct ph_fog mist = {.colour = ph_rgb565(190, 200, 205), .start = FX_INT(4), .end = FX_INT(13)};
    checks = shape_checks(texels, ph_rgb565(90, 100, 80), ph_rgb565(120, 130, 105));
    const struct ph_material stone = shape_lit(ramp, 170, 130, 100),
                             grass = {.shading = PH_SHADE_TEXTURE, .texture = &checks},
                             glass = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(40, 90, 220), .blend = &through};
    const struct ph_mesh column = shape_cube(&cube, &stone), floor = shape_floor(&ground, &grass);
    int status = example_look(r, (struct fx_vec3){FX_ONE / 4, FX_ONE * 3 / 4, FX_INT(6)},
                              (struct fx_vec3){0, FX_ONE / 4, 0}, &shapes_daylight, mist.colour);
    status = status != 0 ? status : ph_frame_fog(r, &mist);
    status = status != 0 ? status : ph_draw_mesh(r, &floor, &ph_xform_identity);
    for (int32_t i = 0; i < 6 && status == 0; i++) {
        const struct ph_xform turn = ph_xform_rotate_y(frame << 24);
        struct ph_xform place = ph_xform_scale(FX_HALF);
        place = ph_xform_mul(&turn, &place);
        place.t = (struct fx_vec3){i % 2 == 0 ? -FX_ONE * 3 / 2 : FX_ONE * 3 / 2, -FX_HALF, FX_INT(2 - i / 2 * 3)};
        for (int k = 0; k < 3 && status == 0; k++, place.t.y += FX_ONE) {
            status = ph_draw_mesh(r, &column, &place);
        }
    }
    /* what is blended comes last, the farthest first */
    return status != 0 ? status
                       : ph_draw_billboard(r, (struct fx_vec3){FX_ONE * 3 / 4, FX_HALF, FX_INT(2)}, FX_ONE * 2,
                                           FX_ONE * 2, &glass);
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
