/*
 * The frames of every demo, as tests/tools/frames.sh lets the simulator draw them: 320x240, depth AUTO, frames 11 and
 * 12, here in bands of 16 lines. Each line of output is a line of tests/golden/frames.txt, with the CRC in decimal
 * digits.
 */
#include "bench.h"
#include "crc32.h"
#include "demo.h"

#define WIDTH  320
#define HEIGHT 240
#define LINES  16
#define FIRST  11
#define COUNT  2
#define ARENA  (1024 * 1024)

static uint64_t arena[ARENA / 8], scene[ARENA / 8], scratch[ARENA / 8];
static uint32_t depth[WIDTH * LINES], bins[HEIGHT / LINES];
static uint16_t pixels[WIDTH * HEIGHT];

/* The CRC-32 of the picture as RGB888, 5 and 6 bits repeated. */
static uint32_t picture_crc(void)
{
    uint32_t crc = 0;
    const uint8_t *wire = (const uint8_t *)pixels;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t colour = (uint32_t)wire[2 * i] << 8 | wire[2 * i + 1];
        const uint32_t red = colour >> 11, green = colour >> 5 & 63, blue = colour & 31;
        const uint8_t rgb[3] = {(uint8_t)(red << 3 | red >> 2), (uint8_t)(green << 2 | green >> 4),
                                (uint8_t)(blue << 3 | blue >> 2)};
        crc = crc32_update(crc, rgb, sizeof rgb);
    }
    return crc;
}

static void print_number(uint32_t n)
{
    char text[11];
    unsigned at = sizeof text - 1;
    text[at] = '\0';
    do {
        text[--at] = (char)('0' + n % 10);
        n /= 10;
    } while (n > 0);
    machine_print(text + at);
}

static void say(const char *demo, uint32_t frame)
{
    machine_print(demo);
    machine_print(" 320x240 auto frame ");
    print_number(frame);
    machine_print(" crc32 ");
    print_number(picture_crc());
    machine_print("\n");
}

static bool run(const struct demo *demo)
{
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = LINES,
                                     .depth_format = PH_DEPTH_AUTO,
                                     .occlusion = PH_COARSE_DEPTH,
                                     .colouring = PH_COLOURS,
                                     .vertices = scene,
                                     .vertex_max = (uint32_t)(sizeof scene / ph_vertex_bytes),
                                     .triangles = scene,
                                     .triangle_max = (uint32_t)(sizeof scene / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT / LINES,
                                     .depth = (void *)depth};
    struct demo_context context = {.arena = {(uint8_t *)arena, sizeof arena, 0},
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .scratch_bytes = demo_scratch_bytes(demo, WIDTH, LINES)};
    context.scratch = context.scratch_bytes > 0 ? scratch : NULL;
    struct ph_renderer r;
    if (context.scratch_bytes > sizeof scratch || ph_renderer_init(&r, &config) != 0 || demo->init(&context) != 0) {
        return false;
    }
    for (uint32_t frame = FIRST; frame < FIRST + COUNT; frame++) {
        demo->frame(&context, &r, frame);
        const uint32_t bands = ph_frame_bands(&r);
        for (uint32_t band = 0, line = 0; band < bands && line < HEIGHT; band++) {
            line += demo_draw_band(demo, &context, &r, band, pixels + line * WIDTH);
        }
        if (r.stats.triangles_dropped + r.stats.vertices_dropped != 0) {
            return false;
        }
        say(demo->name, frame);
    }
    return true;
}

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"};
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    for (uint32_t i = 0; i < demo_count; i++) {
        if (!run(demo_list[i])) {
            machine_print("a demo does not fit the memory of this program\n");
            return 1;
        }
    }
    return 0;
}
