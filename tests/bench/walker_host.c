/* Draws the walker's 64 frames at 320x240 on this computer: a line `frame N crc32 XXXXXXXX` each, as the kit's. */
#include "walker.inc"

#include "crc32.h"

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240 };

int main(void)
{
    static uint64_t memory[sizeof(struct walker) / 8 + 2], list[40000];
    static uint16_t depth[WIDTH * HEIGHT], pixels[WIDTH * HEIGHT];
    static uint8_t rgb[WIDTH * HEIGHT][3];
    static uint32_t bins[1];
    static struct ph_renderer r;
    struct demo_context context = {
        .arena = {.base = (uint8_t *)memory, .size = sizeof memory}, .width = WIDTH, .height = HEIGHT};
    const uint32_t room = sizeof list / (uint32_t)ph_vertex_bytes;
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = HEIGHT,
                                     .depth_format = PH_DEPTH_AUTO,
                                     .vertices = list,
                                     .vertex_max = room,
                                     .triangles = list,
                                     .triangle_max = room,
                                     .bins = bins,
                                     .bin_max = 1,
                                     .depth = depth};
    if (walker_init(&context) != PH_OK || ph_renderer_init(&r, &config) != PH_OK) {
        return EXIT_FAILURE;
    }
    for (uint32_t frame = 0; frame < demo_walker.loop_frames; frame++) {
        if (walker_frame(&context, &r, frame) != PH_OK || r.stats.triangles_dropped > 0) {
            return EXIT_FAILURE;
        }
        ph_frame_bands(&r);
        ph_draw_band(&r, 0, pixels);
        for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
            const uint8_t *const wire = (const uint8_t *)&pixels[i];
            const uint32_t v = (uint32_t)wire[0] << 8 | wire[1], red = v >> 11, green = v >> 5 & 63, blue = v & 31;
            rgb[i][0] = (uint8_t)(red << 3 | red >> 2);
            rgb[i][1] = (uint8_t)(green << 2 | green >> 4);
            rgb[i][2] = (uint8_t)(blue << 3 | blue >> 2);
        }
        printf("frame %u crc32 %08X\n", (unsigned)frame, (unsigned)crc32_update(0, rgb[0], sizeof rgb));
    }
    return EXIT_SUCCESS;
}
