/* One bit a pixel, as small OLEDs and e-paper have it: light becomes dots by an ordered dither, in pages of 8 lines. */
#include "example.h"
#include "shapes.h"

static uint8_t pages[HEIGHT / 8 + 1][WIDTH]; /* as an SSD1306 takes them: a byte is 8 pixels one below the other */

static int to_bits(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    static const uint8_t bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
    (void)context;
    for (uint32_t i = 0; i < width * height; i++) {
        const uint8_t *const p = (const uint8_t *)pixels + 2 * i;
        const uint32_t column = x + i % width, row = y + i / width, green = (p[0] << 3 | p[1] >> 5) & 63;
        const uint8_t bit = (uint8_t)(1 << row % 8);
        if (green > 4u * bayer[row % 4][column % 4] + 2) {
            pages[row / 8][column] |= bit;
        } else {
            pages[row / 8][column] &= (uint8_t)~bit;
        }
    }
    return 0;
}

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape torus;
    static uint16_t ramp[PH_RAMP_SIZE];
    const struct ph_material material = shape_lit(ramp, 230, 230, 230);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE * 2 / 5, &material);
    const struct ph_xform turn = ph_xform_rotate_y(frame << 25);
    const int status =
        example_look(r, (struct fx_vec3){0, FX_ONE, FX_INT(4)}, (struct fx_vec3){0, 0, 0}, &shapes_daylight, 0);
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

int main(int argc, char *argv[])
{
    static struct ph_renderer r;
    const struct ph_config config = example_config();
    int status = ph_renderer_init(&r, &config);
    status = status != 0 ? status : draw(&r, example_frame(argc, argv));
    status = status != 0 ? status : ph_show(&r, to_bits, NULL);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) { /* the picture shows the bits */
        const uint32_t x = i % WIDTH, y = i / WIDTH;
        memset(example_picture[y][x], (pages[y / 8][x] >> y % 8 & 1) != 0 ? 255 : 0, 3);
    }
    return example_save(&r, status);
}
