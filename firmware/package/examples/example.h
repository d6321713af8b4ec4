/* example: what the programs here share: a picture of 240x180 in bands of 20 lines, written as PPM to stdout.
 * Usage of each: NAME [FRAME] >picture.ppm */
#ifndef EXAMPLE_H
#define EXAMPLE_H

#include <pinhole/render.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 240, HEIGHT = 180, BAND = 20, VERTICES = 1500, TRIANGLES = 6000 };

static uint64_t example_memory[PH_MEMORY(WIDTH, BAND, VERTICES, TRIANGLES)];
static uint8_t example_picture[HEIGHT][WIDTH][3];

/* A config to which a program may add before ph_renderer_init(). */
static inline struct ph_config example_config(void)
{
    struct ph_config config = {.width = WIDTH,
                               .height = HEIGHT,
                               .band_height = BAND,
                               .depth_format = PH_DEPTH_FIXED16,
                               .vertex_max = VERTICES,
                               .triangle_max = TRIANGLES};
    const int status = ph_config_memory(&config, example_memory, sizeof example_memory);
    return status == 0 ? config : (struct ph_config){0};
}

/* Takes what the renderer has drawn, as a display's driver would: RGB565, the high byte first. context: NULL, or the
 * uint32_t column in which it begins. */
static inline int example_flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height,
                                const void *pixels)
{
    const uint32_t left = context != NULL ? *(const uint32_t *)context : 0;
    const uint8_t *from = pixels;
    for (uint32_t i = 0; i < width * height; i++, from += 2) {
        uint8_t *const to = example_picture[y + i / width][left + x + i % width];
        const unsigned v = (unsigned)from[0] << 8 | from[1];
        to[0] = (uint8_t)((v >> 11) * 255 / 31);
        to[1] = (uint8_t)((v >> 5 & 63) * 255 / 63);
        to[2] = (uint8_t)((v & 31) * 255 / 31);
    }
    return 0;
}

static inline uint32_t example_frame(int argc, char *argv[])
{
    return argc > 1 ? (uint32_t)strtoul(argv[1], NULL, 10) : 20;
}

/* Writes the picture. Returns what main() returns. */
static inline int example_save(const struct ph_renderer *r, int status)
{
    const char *const why = status == 0 ? ph_why_empty(r) : NULL;
    if (status != 0 || why != NULL) {
        fprintf(stderr, "status %d, see pinhole/status.h; %s\n", status, why != NULL ? why : "stopped");
        return 1;
    }
    if (r->stats.triangles_dropped != 0 || r->stats.vertices_dropped != 0) {
        fprintf(stderr, "left out for want of memory: %u triangles, %u vertices\n",
                (unsigned)r->stats.triangles_dropped, (unsigned)r->stats.vertices_dropped);
        return 1;
    }
    printf("P6\n%d %d\n255\n", WIDTH, HEIGHT);
    return fwrite(example_picture, sizeof example_picture, 1, stdout) != 1;
}

/* Starts a frame: eye, what it looks at, light (NULL: none is needed), background. */
static inline int example_look(struct ph_renderer *r, struct fx_vec3 eye, struct fx_vec3 target,
                               const struct ph_scene_light *light, uint16_t background)
{
    const struct ph_xform view = ph_view_look_at(eye, target, (struct fx_vec3){0, FX_ONE, 0});
    struct ph_projection lens;
    const int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE * WIDTH / HEIGHT, FX_HALF, FX_INT(30));
    return status != 0 ? status : ph_frame_begin(r, &view, &lens, light, background);
}

/* Draws frame FRAME with a renderer of this config, and writes it. */
static inline int example_run(int argc, char *argv[], const struct ph_config *config,
                              int (*draw)(struct ph_renderer *r, uint32_t frame))
{
    static struct ph_renderer r;
    int status = ph_renderer_init(&r, config);
    status = status != 0 ? status : draw(&r, example_frame(argc, argv));
    status = status != 0 ? status : ph_show(&r, example_flush, NULL);
    return example_save(&r, status);
}

#endif
