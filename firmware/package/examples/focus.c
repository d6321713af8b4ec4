/* Depth of field: a row of balls, of which the one in focus is sharp. Bands are drawn by ph_blur_band. */
#include "example.h"
#include "shapes.h"

#include <pinhole/blur.h>

enum { RADIUS = 6 };

static struct ph_renderer r;

static int draw(void)
{
    static struct shape ball, ground;
    static uint16_t ramps[4][PH_RAMP_SIZE], texels[256];
    static struct ph_texture checks;
    struct ph_material paints[4] = {shape_lit(ramps[0], 235, 70, 60), shape_lit(ramps[1], 245, 190, 50),
                                    shape_lit(ramps[2], 90, 200, 100), shape_lit(ramps[3], 70, 150, 235)};
    checks = shape_checks(texels, ph_rgb565(70, 84, 100), ph_rgb565(150, 160, 165));
    const struct ph_material tiles = {.shading = PH_SHADE_TEXTURE, .texture = &checks};
    const struct ph_mesh floor = shape_floor(&ground, &tiles);
    struct ph_mesh mesh = shape_ball(&ball, paints);
    int status = example_look(&r, (struct fx_vec3){-FX_ONE, FX_HALF, FX_INT(4)}, (struct fx_vec3){FX_HALF, -FX_HALF, 0},
                              &shapes_daylight, ph_rgb565(120, 150, 190));
    status = status != 0 ? status : ph_draw_mesh(&r, &floor, &ph_xform_identity);
    for (int32_t i = 0; i < 4 && status == 0; i++) {
        struct ph_xform place = ph_xform_scale(FX_HALF);
        place.t = (struct fx_vec3){FX_ONE * (i - 1) * 3 / 4, -FX_HALF, FX_ONE * 2 - FX_ONE * i * 3 / 2};
        mesh.materials = &paints[i];
        status = ph_draw_mesh(&r, &mesh, &place);
    }
    return status;
}

int main(int argc, char *argv[])
{
    static uint16_t scratch[PH_BLUR_BYTES(WIDTH, BAND, RADIUS) / 2 + 1];
    static struct ph_blur blur;
    const struct ph_config config = example_config();
    const fx_t distance = FX_INT(2) + FX_ONE * (fx_t)(example_frame(argc, argv) % 64) / 16; /* 2 to 6 */
    const struct ph_focus focus = {.distance = distance, .strength = FX_INT(10), .radius = RADIUS};
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : draw();
    const uint32_t bands = status != 0 ? 0 : ph_frame_bands(&r);
    status = status != 0 ? status : ph_blur_begin(&blur, &r, scratch, sizeof scratch, &focus);
    for (uint32_t band = 0, y = 0, lines; band < bands && status == 0; band++, y += lines) {
        lines = ph_blur_band(&blur, &r, band, config.pixels);
        status = example_flush(NULL, 0, y, WIDTH, lines, config.pixels);
    }
    return example_save(&r, status);
}
