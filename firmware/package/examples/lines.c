/* Lines: waves on a grid, drawn one line at a time, and hidden behind what is nearer. */
#include "example.h"
#include "shapes.h"

static fx_t wave(int32_t x, int32_t z, uint32_t frame)
{
    return fx_sin(FX_ONE * (x * 3 + z * 2) / 48 + (fx_t)(frame << 9)) / 3;
}

static struct fx_vec3 at(int32_t x, int32_t z, uint32_t frame)
{
    return (struct fx_vec3){FX_ONE * x / 4, wave(x, z, frame) - FX_HALF, FX_ONE * z / 4};
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape ball;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material green = {.shading = PH_SHADE_UNLIT, .colour = ph_rgb565(80, 255, 140)},
                             red = shape_lit(ramp, 240, 70, 70);
    const struct ph_mesh buoy = shape_ball(&ball, &red);
    struct ph_xform place = ph_xform_scale(FX_HALF);
    place.t = (struct fx_vec3){0, wave(0, 0, frame), 0};
    int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(5)}, (struct fx_vec3){0, -FX_HALF, 0},
                              &shapes_daylight, ph_rgb565(0, 16, 8));
    status = status != 0 ? status : ph_draw_mesh(r, &buoy, &place);
    for (int32_t i = -10; i <= 10 && status == 0; i++) {
        for (int32_t k = -10; k < 10 && status == 0; k++) {
            status = ph_draw_line(r, at(i, k, frame), at(i, k + 1, frame), &green);
            status = status != 0 ? status : ph_draw_line(r, at(k, i, frame), at(k + 1, i, frame), &green);
        }
    }
    return status;
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
