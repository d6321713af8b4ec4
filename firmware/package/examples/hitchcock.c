/* Hitchcock zoom: three cameras, each nearer and with a wider angle than the one before it. The ring keeps its size;
 * what stands behind it does not. */
#include "example.h"
#include "shapes.h"

#include <pinhole/camera.h>

enum { STRIP = WIDTH / 3 };

static struct ph_renderer r;

static int draw(fx_t fov, const struct ph_mesh *ring, const struct ph_mesh *cube, uint32_t left)
{
    const struct ph_xform view =
        ph_xform_translate(0, 0, -ph_distance_of(FX_INT(5), fov)); /* 5 units fill the height */
    struct ph_projection lens;
    int status = ph_projection_perspective(&lens, fov, FX_ONE * STRIP / HEIGHT, FX_ONE, FX_INT(60));
    status = status != 0 ? status : ph_frame_begin(&r, &view, &lens, &shapes_daylight, ph_rgb565(20, 30, 46));
    for (int32_t i = 0; i < 8 && status == 0; i++) {
        struct ph_xform place = ph_xform_scale(FX_HALF);
        place.t =
            (struct fx_vec3){i % 2 != 0 ? FX_ONE * 6 / 5 : -FX_ONE * 6 / 5, -FX_ONE * 3 / 2, -FX_INT(1 + i / 2 * 4)};
        status = ph_draw_mesh(&r, cube, &place);
    }
    status = status != 0 ? status : ph_draw_mesh(&r, ring, &ph_xform_identity);
    return status != 0 ? status : ph_show(&r, example_flush, &left);
}

int main(void)
{
    static const fx_t fovs[] = {FX_INT(15), FX_INT(40), FX_INT(80)};
    static struct shape shapes[2];
    static uint16_t ramps[2][PH_RAMP_SIZE];
    const struct ph_material red = shape_lit(ramps[0], 235, 80, 60), grey = shape_lit(ramps[1], 150, 170, 190);
    const struct ph_mesh ring = shape_torus(&shapes[0], FX_ONE / 5, &red);
    const struct ph_mesh cube = shape_cube(&shapes[1], &grey);
    struct ph_config config = example_config();
    config.width = STRIP;
    int status = ph_renderer_init(&r, &config);
    for (uint32_t i = 0; i < 3 && status == 0; i++) {
        status = draw(fovs[i], &ring, &cube, i * STRIP);
    }
    return example_save(&r, status);
}
