/* Only what changed: with `shown` in the config ph_show sends a rectangle a band, or nothing. What the second frame
 * sent is bright here, all else is darker. */
#include "example.h"
#include "shapes.h"

static uint32_t pixels_sent;

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    pixels_sent += width * height;
    return example_flush(context, x, y, width, height, pixels);
}

static int flush_rows(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    int status = 0;
    for (uint32_t line = 0; line < height && status == 0; line++) { /* example_flush takes a whole rectangle at x */
        status = flush(context, x, y + line, width, 1, (const uint16_t *)pixels + line * width);
    }
    return status;
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape ball, cube;
    static uint16_t ramps[2][PH_RAMP_SIZE];
    const struct ph_material red = shape_lit(ramps[0], 240, 90, 80), blue = shape_lit(ramps[1], 90, 130, 240);
    const struct ph_mesh still = shape_cube(&cube, &blue), moving = shape_ball(&ball, &red);
    const struct ph_xform turn = ph_xform_rotate_y(0x18000000);
    struct ph_xform place = ph_xform_scale(FX_ONE / 3);
    place.t = (struct fx_vec3){fx_mul_sat(FX_ONE * 9 / 5, fx_cos((fx_t)(frame << 9))), FX_ONE * 3 / 2, 0};
    int status = example_look(r, (struct fx_vec3){0, FX_INT(2), FX_INT(6)}, (struct fx_vec3){0, FX_HALF, 0},
                              &shapes_daylight, ph_rgb565(30, 30, 40));
    status = status != 0 ? status : ph_draw_mesh(r, &still, &turn);
    return status != 0 ? status : ph_draw_mesh(r, &moving, &place);
}

int main(int argc, char *argv[])
{
    static struct ph_renderer r;
    static uint16_t shown[WIDTH * HEIGHT];
    struct ph_config config = example_config();
    const uint32_t frame = example_frame(argc, argv);
    config.shown = shown;
    int status = ph_renderer_init(&r, &config);
    for (uint32_t i = 0; i < 2 && status == 0; i++) { /* the first frame is sent whole */
        if (i == 1) {
            for (size_t k = 0; k < sizeof example_picture; k++) {
                (&example_picture[0][0][0])[k] /= 2;
            }
        }
        pixels_sent = 0;
        status = draw(&r, frame + i);
        status = status != 0 ? status : ph_show(&r, flush_rows, NULL);
        fprintf(stderr, "frame %u: %u pixels sent\n", (unsigned)(frame + i), (unsigned)pixels_sent);
    }
    return example_save(&r, status);
}
