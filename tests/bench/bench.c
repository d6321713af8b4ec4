/*
 * The benchmark: scenes S1 .. S8 at 320x240, frames 0, 8, .. 56, each frame drawn whole and then stage by stage.
 *
 * Words on the command line: scene (S1 .. S8 or all), depth format (name or all). Each line of output is
 *
 *   SCENE FORMAT STAGE FRAME COUNT
 *
 * The frame is one band of 240 lines. FORMAT `kit` is what a kit runs: bands of 16 lines, and depth AUTO (float16
 * here). FORMAT `dither`, which `all` leaves out, is the same in dithered light.
 *
 * COUNT is in instructions; for `crc` it is the frame's CRC, which pinhole-sim --crc prints in hexadecimal. Stages:
 *
 * - frame: all of it: camera, geometry, bins, clears, spans
 * - geometry: camera, vertices, triangles until they are listed
 * - vertices: of these, the transform of all unique vertices (their light belongs to the triangles that show them)
 * - bins: the list sorted into bands
 * - fill: clears and spans
 * - clears: of these, colour and depth cleared, one empty frame
 * - fragments, triangles, dropped: the frame's counts
 */
#include "bench.h"

#include "demo.h"
#include "render.h"

#include <stdbool.h>
#include <string.h>

#define WIDTH     320
#define HEIGHT    240
#define STEP      8
#define LAST      56
#define FORMATS   7
#define DITHER    6 /* number of this format */
#define KIT_LINES 16
#define VERTICES  2562
#define TRIANGLES 2600
#define ARENA     (512 * 1024)

struct scene {
    const char *name, *demo; /* NULL: the torus that is next in bench_textured_tori */
};

static const struct scene scenes[] = {{"S1", "torus"},  {"S2", "cube"}, {"S3", "fill"}, {"S4", "icosphere"},
                                      {"S5", "ground"}, {"S6", NULL},   {"S7", NULL},   {"S8", NULL}};

static const char *const format_names[FORMATS] = {"kit",     "fixed16",  "float16", "fixed24",
                                                  "float24", "linear-w", "dither"};
static const struct ph_depth_format *const formats[FORMATS] = {PH_DEPTH_AUTO,    PH_DEPTH_FIXED16, PH_DEPTH_FLOAT16,
                                                               PH_DEPTH_FIXED24, PH_DEPTH_FLOAT24, PH_DEPTH_LINEAR_W,
                                                               PH_DEPTH_AUTO};

/* One image, one run: all its memory. Word-wise for alignment. */
static uint64_t arena[ARENA / 8], vertices[VERTICES * 8], triangles[TRIANGLES * 20];
static uint32_t depth[WIDTH * HEIGHT], bins[HEIGHT / KIT_LINES];
static uint16_t pixels[WIDTH * HEIGHT];
static struct ph_dithered_ramp ramps[1];

/* The last mesh drawn, caught on its way into the renderer (ld --wrap). */
static struct ph_mesh caught_mesh;
static struct ph_xform caught_place;

int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);
int __wrap_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);

int __wrap_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    caught_mesh = *mesh;
    caught_place = *to_world;
    return __real_ph_draw_mesh(r, mesh, to_world);
}

static void print_number(uint32_t n)
{
    char text[12];
    unsigned at = sizeof text - 1;
    text[at] = '\0';
    do {
        text[--at] = (char)('0' + n % 10);
        n /= 10;
    } while (n > 0);
    machine_print(text + at);
}

static void print_line(const char *const what[3], uint32_t frame, uint32_t value)
{
    for (int i = 0; i < 3; i++) {
        machine_print(what[i]);
        machine_print(" ");
    }
    print_number(frame);
    machine_print(" ");
    print_number(value);
    machine_print("\n");
}

static uint32_t crc_byte(uint32_t crc, uint32_t byte)
{
    crc ^= byte;
    for (int bit = 0; bit < 8; bit++) {
        crc = (crc >> 1) ^ (0xEDB88320u & (0u - (crc & 1)));
    }
    return crc;
}

/* The CRC-32 of the picture as RGB888, 5 and 6 bits repeated. */
static uint32_t picture_crc(void)
{
    uint32_t crc = UINT32_MAX;
    const uint8_t *wire = (const uint8_t *)pixels;
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        const uint32_t colour = (uint32_t)wire[2 * i] << 8 | wire[2 * i + 1];
        const uint32_t red = colour >> 11, green = colour >> 5 & 63, blue = colour & 31;
        crc = crc_byte(crc, red << 3 | red >> 2);
        crc = crc_byte(crc, green << 2 | green >> 4);
        crc = crc_byte(crc, blue << 3 | blue >> 2);
    }
    return ~crc;
}

static void fill(struct ph_renderer *r)
{
    for (uint32_t band = 0; band < r->band_count; band++) {
        ph_draw_band(r, band, pixels + band * r->config.band_height * WIDTH);
    }
}

static void whole_frame(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    demo->frame(context, r, frame);
    ph_frame_bands(r);
    fill(r);
}

static void stages(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t frame,
                   const char *what[3])
{
    what[2] = "geometry";
    machine_start();
    demo->frame(context, r, frame);
    machine_stop(what, frame);
    what[2] = "bins";
    machine_start();
    ph_frame_bands(r);
    machine_stop(what, frame);
    what[2] = "fill";
    machine_start();
    fill(r);
    machine_stop(what, frame);
    what[2] = "fragments";
    print_line(what, frame, r->stats.fragments);
    what[2] = "triangles";
    print_line(what, frame, r->stats.triangles_drawn);

    caught_mesh.part_count = 0;
    what[2] = "vertices";
    machine_start();
    __real_ph_draw_mesh(r, &caught_mesh, &caught_place);
    machine_stop(what, frame);

    const struct ph_xform view = r->view;
    const struct ph_projection projection = r->projection;
    const struct ph_scene_light light = r->light;
    ph_frame_begin(r, &view, &projection, &light, r->background);
    ph_frame_bands(r);
    what[2] = "clears";
    machine_start();
    fill(r);
    machine_stop(what, frame);
}

static bool run(const struct scene *scene, unsigned format)
{
    const struct demo *const demo =
        scene->demo != NULL ? demo_find(scene->demo) : &bench_textured_tori[scene->name[1] - '6'];
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = formats[format] == PH_DEPTH_AUTO ? KIT_LINES : HEIGHT,
                                     .depth_format = formats[format],
                                     .occlusion = PH_COARSE_DEPTH,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT / KIT_LINES,
                                     .depth = (void *)depth};
    struct demo_context context = {.width = WIDTH, .height = HEIGHT};
    context.arena.base = (uint8_t *)arena;
    context.arena.size = sizeof arena;
    struct ph_renderer renderer;
    struct ph_dither dither = {.ramps = ramps, .ramp_max = 1};
    if (ph_renderer_init(&renderer, &config) != 0 || demo->init(&context) != 0) {
        return false;
    }
    if (format == DITHER) {
        ph_dither(&renderer, &dither);
        whole_frame(demo, &context, &renderer, 0); /* it makes the ramp */
    }
    for (uint32_t frame = 0; frame <= LAST; frame += STEP) {
        const char *what[3] = {scene->name, format_names[format], "frame"};
        machine_start();
        whole_frame(demo, &context, &renderer, frame);
        machine_stop(what, frame);
        what[2] = "crc";
        print_line(what, frame, picture_crc());
        what[2] = "dropped";
        print_line(what, frame, renderer.stats.triangles_dropped + renderer.stats.vertices_dropped);
        stages(demo, &context, &renderer, frame, what);
    }
    return true;
}

static bool wanted(const char *word, const char *name)
{
    return strcmp(word, "all") == 0 || strcmp(word, name) == 0;
}

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"}, *const nothing[3] = {"nothing", "-", "-"};
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    machine_start();
    machine_stop(nothing, 0);
    for (unsigned i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        for (unsigned format = 0; format < FORMATS; format++) {
            if (wanted(machine_word(0), scenes[i].name) && wanted(machine_word(1), format_names[format]) &&
                (format != DITHER || strcmp(machine_word(1), "all") != 0) && !run(&scenes[i], format)) {
                machine_print("a scene does not fit the benchmark's memory\n");
                return 1;
            }
        }
    }
    return 0;
}
