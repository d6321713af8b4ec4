#include "player.h"

#include "complain.h"
#include "options.h"
#include "overlay.h"

#include <stdlib.h>

#define SCRATCH_BYTES 4096

static int out_of_memory(void)
{
    return complain(EXIT_FAILED, "not enough memory for this scene");
}

/* Lines of a band. */
static uint16_t lines_of(const struct player *p)
{
    const uint16_t lines = p->setup.band_height, height = p->driver.height;
    return lines < height ? lines : height;
}

/* The controller first: it decides how large the picture is. */
static int open_kit(struct player *p, const struct player_setup *setup)
{
    p->sim = sim_open(setup->board, &p->hal);
    p->wire = malloc(SCRATCH_BYTES);
    if (p->sim == NULL || p->wire == NULL) {
        return complain(EXIT_FAILED, "%s: no memory, or no model of its display controller", setup->board->name);
    }
    const struct panel_config config = {.panel = setup->board->panel,
                                        .rotation = (uint8_t)setup->rotation,
                                        .format = setup->board->format,
                                        .clock_hz = setup->board->spi_hz,
                                        .scratch = p->wire,
                                        .scratch_bytes = SCRATCH_BYTES};
    const int status = panel_open(&p->driver, &p->hal, &config);
    return status == 0 ? 0 : complain(EXIT_FAILED, "%s: the panel does not open (%d)", setup->board->name, status);
}

/* The picture's memory: as long as the kit is open. */
static int open_picture(struct player *p)
{
    const uint16_t width = p->driver.width, height = p->driver.height;
    const size_t lines = lines_of(p);
    p->bins = malloc(sizeof *p->bins * height);
    p->depth = malloc(ph_depth_bytes(p->setup.depth_format) * width * lines);
    p->band = malloc(sizeof *p->band * width * lines);
    p->picture = (struct ppm){width, height, malloc((size_t)width * height * 3)};
    const bool all = p->bins != NULL && p->depth != NULL && p->band != NULL && p->picture.rgb != NULL;
    return all ? 0 : out_of_memory();
}

static int open_renderer(struct player *p)
{
    const struct demo *demo = p->demo;
    p->vertices = malloc(ph_vertex_bytes * demo->vertex_max + 1);
    p->triangles = malloc(ph_triangle_bytes * demo->triangle_max + 1);
    if (p->vertices == NULL || p->triangles == NULL) {
        return out_of_memory();
    }
    const struct ph_config config = {.width = p->driver.width,
                                     .height = p->driver.height,
                                     .band_height = lines_of(p),
                                     .depth_format = p->setup.depth_format,
                                     .vertices = p->vertices,
                                     .vertex_max = demo->vertex_max,
                                     .triangles = p->triangles,
                                     .triangle_max = demo->triangle_max,
                                     .bins = p->bins,
                                     .bin_max = p->driver.height,
                                     .depth = p->depth};
    const int status = ph_renderer_init(&p->renderer, &config);
    return status == 0 ? 0 : complain(EXIT_FAILED, "the renderer refuses this picture (%d)", status);
}

static int open_demo(struct player *p)
{
    const bool first = p->demo == p->setup.demo;
    const size_t scratch_bytes = demo_scratch_bytes(p->demo, p->driver.width, lines_of(p));
    p->context = (struct demo_context){.state = first ? p->setup.state : NULL,
                                       .view = first ? p->setup.view : NULL,
                                       .width = p->driver.width,
                                       .height = p->driver.height,
                                       .camera = p->setup.camera,
                                       .scratch = malloc(scratch_bytes + 1),
                                       .scratch_bytes = scratch_bytes};
    p->context.arena.base = malloc(p->demo->arena_bytes + 1);
    p->context.arena.size = p->demo->arena_bytes;
    if (p->context.scratch == NULL || p->context.arena.base == NULL || p->demo->init(&p->context) != 0) {
        return out_of_memory();
    }
    return 0;
}

static int open_scene(struct player *p, const struct demo *demo)
{
    p->demo = demo;
    const int status = open_renderer(p);
    return status == 0 ? open_demo(p) : status;
}

static void close_scene(struct player *p)
{
    free(p->context.arena.base);
    free(p->context.scratch);
    free(p->triangles);
    free(p->vertices);
    p->context = (struct demo_context){.width = 0};
    p->triangles = p->vertices = NULL;
}

int player_open(struct player *p, const struct player_setup *setup)
{
    *p = (struct player){.setup = *setup};
    int status = open_kit(p, setup);
    if (status == 0) {
        status = open_picture(p);
    }
    if (status == 0) {
        status = open_scene(p, setup->demo);
    }
    return status;
}

/* A model's demo is not on the list: it stands before the first. */
static const struct demo *demo_after(const struct player *p)
{
    uint32_t i = 0;
    while (i < demo_count && demo_list[i] != p->demo) {
        i++;
    }
    if (i + 1 < demo_count) {
        return demo_list[i + 1];
    }
    const bool listed = demo_find(p->setup.demo->name) == p->setup.demo;
    return i < demo_count && !listed ? p->setup.demo : demo_list[0];
}

/* What the kit's buttons do. One that is held selects but once. */
static int read_buttons(struct player *p)
{
    const uint32_t buttons = p->hal.ops->buttons(p->hal.context);
    const bool select = (buttons & ~p->buttons & HAL_BUTTON_SELECT) != 0;
    int status = 0;
    p->buttons = buttons;
    if (select) {
        const struct demo *next = demo_after(p);
        close_scene(p);
        status = open_scene(p, next);
    }
    demo_input(&p->context, buttons);
    return status;
}

/* Frame time and triangles, top left; twice as large where there is room. */
static void draw_overlay(const struct player *p, uint32_t band, uint32_t lines)
{
    char text[PH_OVERLAY_STATS_SIZE];
    const struct board *board = p->setup.board;
    const uint32_t us = panel_frame_us(board->panel, board->format, p->setup.rotation, p->driver.clock_hz);
    ph_overlay_stats(text, us, p->renderer.stats.triangles_drawn);
    const struct ph_overlay_band over = {p->band, p->driver.width, (int32_t)(band * p->renderer.config.band_height),
                                         (int32_t)lines};
    const uint8_t scale = ph_overlay_width(text, 2) + 8 <= p->driver.width ? 2 : 1;
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(0, 0, 0), scale};
    ph_overlay_text(&over, 2 * scale, 2 * scale, text, &style);
}

/* One band buffer: it is drawn, sent, waited for, drawn again. */
static int send_bands(struct player *p)
{
    int status = panel_frame_begin(&p->driver);
    const uint32_t bands = ph_frame_bands(&p->renderer);
    for (uint32_t band = 0; band < bands && status == 0; band++) {
        const uint32_t lines = demo_draw_band(p->demo, &p->context, &p->renderer, band, p->band);
        if (p->setup.overlay) {
            draw_overlay(p, band, lines);
        }
        status = panel_rows(&p->driver, p->band, lines);
        if (status == 0) {
            status = panel_wait(&p->driver);
        }
    }
    return status == 0 ? panel_frame_end(&p->driver) : status;
}

static int make_frame(struct player *p, uint32_t frame)
{
    const int status = p->demo->frame(&p->context, &p->renderer, frame);
    return status == 0 ? 0
                       : complain(EXIT_FAILED, "frame %u cannot be drawn with this camera or budget (%d)",
                                  (unsigned)frame, status);
}

int player_camera(struct player *p, uint32_t frame, struct ph_xform *view, struct ph_projection *projection)
{
    if (make_frame(p, frame) != 0) {
        return EXIT_FAILED;
    }
    const struct demo_camera *user = &p->context.camera; /* a demo with several cameras makes its own of it */
    *view = p->renderer.view;
    *projection = user->projection_set ? user->projection : p->renderer.projection;
    return 0;
}

int player_frame(struct player *p, uint32_t frame)
{
    p->counters = sim_counters(p->sim);
    if (read_buttons(p) != 0 || make_frame(p, frame) != 0) {
        return EXIT_FAILED;
    }
    const int status = send_bands(p);
    if (status != 0) {
        return complain(EXIT_FAILED, "frame %u: the panel failed (%d)", (unsigned)frame, status);
    }
    sim_pixels(p->sim, p->setup.rotation, p->picture.rgb);
    return 0;
}

uint64_t player_bus_ns(const struct player *p)
{
    return sim_counters(p->sim).bus_ns - p->counters.bus_ns;
}

void player_print_stats(const struct player *p, uint32_t frame)
{
    const struct ph_stats *s = &p->renderer.stats;
    const struct sim_counters now = sim_counters(p->sim);
    const double bus_us = (double)player_bus_ns(p) / 1000;
    fprintf(stderr, "frame %u: vertices %u, triangles in %u, culled %u, clipped %u, drawn %u, dropped %u; ",
            (unsigned)frame, (unsigned)s->vertices, (unsigned)s->triangles_in, (unsigned)s->triangles_culled,
            (unsigned)s->triangles_clipped, (unsigned)s->triangles_drawn, (unsigned)s->triangles_dropped);
    fprintf(stderr,
            "vertices dropped %u; fragments %u, depth %s; wire %llu bytes, writes %u, bus %.0f us at %u Hz, %.1f "
            "frames/s\n",
            (unsigned)s->vertices_dropped, (unsigned)s->fragments, options_depth_name(s->depth_format),
            (unsigned long long)(now.bytes - p->counters.bytes), (unsigned)(now.writes - p->counters.writes), bus_us,
            (unsigned)now.clock_hz, bus_us > 0 ? 1e6 / bus_us : 0);
}

static uint32_t print_complaints(const struct sim *sim)
{
    const uint32_t count = sim_complaint_count(sim);
    for (uint32_t i = 0; i < count && sim_complaint(sim, i) != NULL; i++) {
        complain(EXIT_FAILED, "display controller: %s", sim_complaint(sim, i));
    }
    if (count > SIM_COMPLAINTS_KEPT) {
        complain(EXIT_FAILED, "display controller: %u complaints in all", (unsigned)count);
    }
    return count;
}

int player_close(struct player *p)
{
    uint32_t complaints = 0;
    if (p->sim != NULL) {
        if (p->driver.width != 0) { /* it was opened */
            panel_close(&p->driver);
        }
        complaints = print_complaints(p->sim);
        sim_close(p->sim);
    }
    close_scene(p);
    free(p->picture.rgb);
    free(p->wire);
    free(p->band);
    free(p->depth);
    free(p->bins);
    return complaints == 0 ? 0 : EXIT_FAILED;
}
