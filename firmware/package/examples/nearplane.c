/* The near plane: a sheet that lies 0.04 above another one. On the left near is 0.005, too close for 16 bits of depth,
 * and the two sheets fight (z-fighting); on the right near is 1. */
#include "example.h"
#include "shapes.h"

enum { HALF = WIDTH / 2 };

static struct ph_renderer r;

static int draw(fx_t near_z, const struct ph_mesh *ground, const struct ph_material *sheet, uint32_t left)
{
    const struct fx_vec3 eye = {0, FX_ONE * 2, FX_INT(5)}, ahead = {0, 0, -FX_INT(2)}, up = {0, FX_ONE, 0};
    const struct ph_xform view = ph_view_look_at(eye, ahead, up);
    struct ph_xform place = ph_xform_scale(FX_ONE / 2);
    struct ph_mesh above = *ground;
    struct ph_projection lens;
    above.materials = sheet;
    place.t.y = FX_ONE / 25 - FX_HALF; /* the floor lies at y = -1 of its mesh */
    int status = ph_projection_perspective(&lens, FX_INT(50), FX_ONE * HALF / HEIGHT, near_z, FX_INT(40));
    status = status != 0 ? status : ph_frame_begin(&r, &view, &lens, NULL, ph_rgb565(120, 150, 190));
    status = status != 0 ? status : ph_draw_mesh(&r, ground, &ph_xform_identity);
    status = status != 0 ? status : ph_draw_mesh(&r, &above, &place);
    return status != 0 ? status : ph_show(&r, example_flush, &left);
}

int main(void)
{
    static struct shape shape;
    const struct ph_material grey = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(90, 100, 110)};
    const struct ph_material red = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(230, 80, 60)};
    const struct ph_mesh ground = shape_floor(&shape, &grey);
    struct ph_config config = example_config();
    config.width = HALF;
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : draw(FX_ONE / 200, &ground, &red, 0);
    status = status != 0 ? status : draw(FX_ONE, &ground, &red, HALF);
    return example_save(&r, status);
}
