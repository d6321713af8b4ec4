/* The frames of the torus, each a line with the CRC of its pixels and a line of greys for each row, as the whole
 * library draws them. */
#include "torus.h"

#include "torus_crc.h"

#include <stdio.h>

static uint64_t vertices[VERTICES * PH_VERTEX_BYTES_32 / 8], list[1000];
static uint16_t pixels[WIDTH * HEIGHT], depth[WIDTH * HEIGHT];
static uint32_t bins[HEIGHT];

int main(void)
{
    static struct ph_renderer r;
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = HEIGHT, /* all at once: bands change nothing */
                                     .depth_format = PH_DEPTH_FIXED16,
                                     .vertices = vertices,
                                     .vertex_max = VERTICES,
                                     .triangles = list,
                                     .triangle_max = sizeof list / PH_TRIANGLE_BYTES_32,
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth};
    int status = ph_renderer_init(&r, &config);
    for (uint32_t frame = 0; frame < FRAMES && status == PH_OK; frame++) {
        status = torus_draw(&r, frame);
        ph_frame_bands(&r);
        ph_draw_band(&r, 0, pixels);
        printf("frame %08x\n", (unsigned)torus_crc(UINT32_MAX, (const uint8_t *)pixels, sizeof pixels));
    }
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        fprintf(stderr, "%x%s", (unsigned)torus_grey(pixels[i]), i % WIDTH == WIDTH - 1 ? "\n" : "");
    }
    return status != PH_OK;
}
