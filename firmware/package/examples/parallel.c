/* Parallel and perspective: the same two rows of cubes. On the left parallel lines stay parallel; on the right they
 * meet in a vanishing point, and what is far is small. */
#include "example.h"
#include "shapes.h"

enum { HALF = WIDTH / 2, CUBES = 8 };

static struct ph_renderer r;

static int draw(const struct ph_projection *lens, const struct ph_mesh *cube, uint32_t left)
{
    const struct fx_vec3 eye = {0, FX_INT(4), FX_INT(7)}, ahead = {0, 0, -FX_INT(3)}, up = {0, FX_ONE, 0};
    const struct ph_xform view = ph_view_look_at(eye, ahead, up);
    int status = ph_frame_begin(&r, &view, lens, &shapes_daylight, ph_rgb565(20, 30, 46));
    for (int32_t i = 0; i < 2 * CUBES && status == 0; i++) {
        struct ph_xform place = ph_xform_scale(FX_HALF);
        place.t = (struct fx_vec3){i % 2 != 0 ? FX_ONE * 3 / 2 : -FX_ONE * 3 / 2, 0, -FX_INT(i / 2 * 2)};
        status = ph_draw_mesh(&r, cube, &place);
    }
    return status != 0 ? status : ph_show(&r, example_flush, &left);
}

int main(void)
{
    static struct shape shape;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material paint = shape_lit(ramp, 240, 170, 70);
    const struct ph_mesh cube = shape_cube(&shape, &paint);
    const fx_t high = FX_INT(5), wide = high * HALF / HEIGHT;
    struct ph_config config = example_config();
    struct ph_projection parallel, perspective;
    config.width = HALF;
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : ph_projection_ortho(&parallel, -wide, wide, -high, high, FX_HALF, FX_INT(40));
    status = status != 0
                 ? status
                 : ph_projection_perspective(&perspective, FX_INT(60), FX_ONE * HALF / HEIGHT, FX_HALF, FX_INT(40));
    status = status != 0 ? status : draw(&parallel, &cube, 0);
    status = status != 0 ? status : draw(&perspective, &cube, HALF);
    return example_save(&r, status);
}
