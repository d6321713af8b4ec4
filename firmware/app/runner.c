/* See runner.h. */
#include "runner.h"

#include "overlay.h"

#define WIRE_MAX   4096  /* bytes of scratch for the panel driver */
#define TE_WAIT_US 50000 /* for the tearing-effect edge: three frames of the slowest panel */

#define BUFFERS_MIN 2U /* one is drawn while the other is sent */

#define ROUND8(n) (((n) + 7) & ~(uint64_t)7)

/* The memory of one picture, in the order in which it is taken; the same on every machine. */
struct picture {
    uint16_t width, height, lines;
    uint32_t bands, buffers, band_bytes, depth_bytes, bin_bytes, wire_bytes;
};

/* ... and of one demo. */
struct scene {
    bool whole;
    size_t arena_bytes, scratch_bytes;
    uint32_t vertex_max, triangle_max; /* no triangles: not even its meshes fit */
    uint64_t bytes_32;                 /* of a 32-bit target */
};

struct plan {
    struct picture picture;
    struct scene scene;
};

/* Pixels go out as they are drawn, through a backend that can keep a queue. */
static bool has_queue(const struct runner_config *config)
{
    return config->board->band_buffers > BUFFERS_MIN && config->board->format == PANEL_RGB565 && config->diff == NULL;
}

/* In bands of `lines`, with the fewest buffers. */
static struct picture picture_of(const struct runner_config *config, uint16_t lines)
{
    const struct panel *panel = config->board->panel;
    struct picture p = {.width = panel_width(panel, config->rotation),
                        .height = panel_height(panel, config->rotation),
                        .buffers = BUFFERS_MIN};
    p.lines = lines < p.height ? lines : p.height;
    p.bands = p.lines > 0 ? (p.height + p.lines - 1U) / p.lines : 0;
    const uint32_t pixels = (uint32_t)p.width * p.lines;
    p.band_bytes = (uint32_t)ROUND8(2 * pixels);
    p.depth_bytes = (uint32_t)ROUND8(ph_depth_bytes(config->depth_format) * pixels);
    p.bin_bytes = (uint32_t)ROUND8(4 * p.bands);
    if (config->diff != NULL) { /* windows are collected there */
        p.wire_bytes = WIRE_MAX;
    } else if (config->board->format != PANEL_RGB565) { /* half a band of the smallest format */
        const uint32_t wire = (uint32_t)ROUND8(pixels / 2);
        const uint32_t least = wire < PANEL_SCRATCH_MIN ? PANEL_SCRATCH_MIN : wire;
        p.wire_bytes = least < WIRE_MAX ? least : WIRE_MAX;
    }
    return p;
}

static uint64_t picture_bytes(const struct picture *p)
{
    return (uint64_t)p->buffers * p->band_bytes + p->depth_bytes + p->bin_bytes + p->wire_bytes;
}

/* What a level of a demo takes on a 32-bit target, all of it and without triangles. */
static uint64_t level_bytes_32(const struct demo_level *level, uint32_t triangle_max)
{
    return ROUND8(level->arena_bytes_32) + ROUND8((uint64_t)level->vertex_max * PH_VERTEX_BYTES_32) +
           ROUND8((uint64_t)triangle_max * PH_TRIANGLE_BYTES_32);
}

/* The finest level that fits whole, else as much as fits of the coarsest. */
static struct scene scene_of(const struct demo *demo, const struct picture *p, uint64_t budget)
{
    struct demo_level level = {demo->arena_bytes, demo->arena_bytes_32, demo->vertex_max, demo->triangle_max};
    for (uint32_t i = 0; i < demo->coarser_count && level_bytes_32(&level, level.triangle_max) > budget; i++) {
        level = demo->coarser[i];
    }
    struct scene scene = {.arena_bytes = level.arena_bytes, .vertex_max = level.vertex_max};
    const uint64_t meshes = level_bytes_32(&level, 0), whole = level_bytes_32(&level, level.triangle_max);
    scene.whole = whole <= budget;
    if (scene.whole) {
        const size_t scratch = demo_scratch_bytes(demo, p->width, p->lines);
        scene.triangle_max = level.triangle_max;
        scene.scratch_bytes = whole + ROUND8(scratch) <= budget ? scratch : 0;
    } else if (meshes < budget) {
        scene.triangle_max = (uint32_t)(((budget - meshes) & ~(uint64_t)7) / PH_TRIANGLE_BYTES_32);
    }
    scene.bytes_32 = level_bytes_32(&level, scene.triangle_max) + ROUND8(scene.scratch_bytes);
    return scene;
}

/* Of this machine. */
static uint64_t scene_bytes(const struct scene *s)
{
    return ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes) + ROUND8((uint64_t)s->triangle_max * ph_triangle_bytes) +
           ROUND8(s->arena_bytes) + ROUND8(s->scratch_bytes);
}

/* The demo in what the budget leaves beside the picture. */
static struct scene scene_beside(const struct runner_config *config, const struct demo *demo, const struct picture *p)
{
    const uint64_t taken = picture_bytes(p);
    return scene_of(demo, p, config->budget_bytes > taken ? config->budget_bytes - taken : 0);
}

/* As many buffers as the board takes as a rule; fewer for a demo that does not fit otherwise, more where there is room.
 */
static struct plan share(const struct runner_config *config, const struct demo *demo)
{
    const bool queue = has_queue(config);
    struct plan plan = {.picture = picture_of(config, config->board->band_height)};
    struct picture *p = &plan.picture;
    p->buffers = queue ? config->board->band_buffers : BUFFERS_MIN;
    plan.scene = scene_beside(config, demo, p);
    while (!plan.scene.whole && p->buffers > BUFFERS_MIN) {
        p->buffers--;
        plan.scene = scene_beside(config, demo, p);
    }
    while (queue && plan.scene.whole && p->buffers < p->bands && p->buffers < RUNNER_BANDS_MAX &&
           picture_bytes(p) + p->band_bytes + plan.scene.bytes_32 <= config->budget_bytes) {
        p->buffers++;
    }
    return plan;
}

/* Shared out as with the board's own bands, so that other bands show the same; of higher ones there are fewer. */
static struct plan plan_of(const struct runner_config *config, const struct demo *demo)
{
    struct plan plan = share(config, demo);
    struct picture p = picture_of(config, config->band_height);
    const uint32_t all_lines = plan.picture.buffers * plan.picture.lines, fit = p.lines > 0 ? all_lines / p.lines : 0;
    const uint32_t count = fit < plan.picture.buffers ? fit : plan.picture.buffers;
    p.buffers = count > BUFFERS_MIN ? count : BUFFERS_MIN;
    plan.picture = p;
    if (plan.scene.scratch_bytes > 0) {
        plan.scene.scratch_bytes = demo_scratch_bytes(demo, p.width, p.lines);
    }
    return plan;
}

static uint64_t plan_bytes(const struct plan *plan)
{
    return picture_bytes(&plan->picture) + scene_bytes(&plan->scene);
}

uint32_t runner_budget(const struct board *board)
{
    return board->ram_bytes > RUNNER_OTHER_BYTES ? board->ram_bytes - RUNNER_OTHER_BYTES : 0;
}

size_t runner_bytes(const struct runner_config *config)
{
    const struct plan own = plan_of(config, config->demo);
    uint64_t most = plan_bytes(&own);
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct plan listed = plan_of(config, demo_list[i]);
        const uint64_t bytes = listed.scene.triangle_max > 0 ? plan_bytes(&listed) : 0;
        most = bytes > most ? bytes : most;
    }
    return (size_t)most;
}

uint64_t runner_whole_bytes(const struct runner_config *config)
{
    const struct demo *demo = config->demo;
    const struct picture p = picture_of(config, config->board->band_height);
    const struct demo_level level = {demo->arena_bytes, demo->arena_bytes_32, demo->vertex_max, demo->triangle_max};
    return picture_bytes(&p) + level_bytes_32(&level, level.triangle_max);
}

static int open_panel(struct runner *runner, const struct picture *p)
{
    const struct board *board = runner->config.board;
    const struct panel_config config = {.panel = board->panel,
                                        .rotation = runner->config.rotation,
                                        .format = board->format,
                                        .clock_hz =
                                            runner->config.clock_hz != 0 ? runner->config.clock_hz : board->spi_hz,
                                        .scratch = p->wire_bytes > 0 ? (uint8_t *)runner->bins + p->bin_bytes : NULL,
                                        .scratch_bytes = p->wire_bytes};
    return panel_open(&runner->driver, &runner->hal, &config);
}

static int open_renderer(struct runner *runner, const struct picture *p, const struct scene *s)
{
    const struct ph_config config = {.width = p->width,
                                     .height = p->height,
                                     .band_height = p->lines,
                                     .depth_format = runner->config.depth_format,
                                     .other_core = runner->config.other_core,
                                     .other_core_join = runner->config.other_core_join,
                                     .vertices = runner->scene,
                                     .vertex_max = s->vertex_max,
                                     .triangles = runner->scene + ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes),
                                     .triangle_max = s->triangle_max,
                                     .bins = runner->bins,
                                     .bin_max = p->bands,
                                     .depth = runner->depth};
    return ph_renderer_init(&runner->renderer, &config);
}

static int open_demo(struct runner *runner, const struct demo *demo, const struct picture *p, const struct scene *s)
{
    const bool first = demo == runner->config.demo;
    uint8_t *arena = runner->scene + ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes) +
                     ROUND8((uint64_t)s->triangle_max * ph_triangle_bytes);
    runner->demo = demo;
    runner->context = (struct demo_context){.arena = {arena, s->arena_bytes, 0},
                                            .state = first ? runner->config.state : NULL,
                                            .view = first ? runner->config.view : NULL,
                                            .width = p->width,
                                            .height = p->height,
                                            .camera = runner->config.camera,
                                            .scratch = s->scratch_bytes > 0 ? arena + ROUND8(s->arena_bytes) : NULL,
                                            .scratch_bytes = s->scratch_bytes};
    return demo->init(&runner->context);
}

/* Buffers stand behind what is the same for every demo. */
static void place_buffers(struct runner *runner, const struct picture *p)
{
    uint8_t *next = (uint8_t *)runner->bins + p->bin_bytes + p->wire_bytes;
    runner->band_count = p->buffers;
    runner->band_next = 0;
    for (uint32_t i = 0; i < p->buffers; i++, next += p->band_bytes) {
        runner->bands[i] = (uint16_t *)(void *)next;
    }
    runner->scene = next;
    const struct hal *hal = &runner->hal;
    if (hal->ops->bus_queue != NULL) {
        hal->ops->bus_queue(hal->context, has_queue(&runner->config));
        const uint32_t written = hal->ops->bus_written(hal->context);
        for (uint32_t i = 0; i < p->buffers; i++) {
            runner->written[i] = written;
        }
    }
}

/* Nothing is on the wire. */
static int open_scene(struct runner *runner, const struct demo *demo)
{
    const struct plan plan = plan_of(&runner->config, demo);
    if (plan.scene.triangle_max == 0 || plan_bytes(&plan) > runner->config.memory_bytes) {
        return PH_ERR_NOMEM;
    }
    place_buffers(runner, &plan.picture);
    if (runner->config.tiles != NULL) {
        panel_tiles_forget(runner->config.tiles);
    }
    const int status = open_renderer(runner, &plan.picture, &plan.scene);
    return status == PH_OK ? open_demo(runner, demo, &plan.picture, &plan.scene) : status;
}

int runner_open(struct runner *runner, const struct hal *hal, const struct runner_config *config)
{
    const struct picture p = picture_of(config, config->band_height);
    *runner = (struct runner){.config = *config, .hal = *hal};
    if (p.bands == 0) {
        return PH_ERR_INVAL;
    }
    if (picture_bytes(&p) > config->memory_bytes) {
        return PH_ERR_NOMEM;
    }
    runner->depth = config->memory;
    runner->bins = (uint32_t *)(void *)((uint8_t *)runner->depth + p.depth_bytes);
    const int status = open_scene(runner, config->demo);
    return status == PH_OK ? open_panel(runner, &p) : status;
}

/* A demo that is not on the list, e.g. a model's, stands before the first. */
static const struct demo *demo_after(const struct runner *runner, const struct demo *demo)
{
    const struct demo *first = runner->config.demo;
    uint32_t i = 0;
    while (i < demo_count && demo_list[i] != demo) {
        i++;
    }
    if (i + 1 < demo_count) {
        return demo_list[i + 1];
    }
    const bool listed = demo_find(first->name) == first;
    return i < demo_count && !listed ? first : demo_list[0];
}

/* The next one for which there is room. */
static int select_next(struct runner *runner)
{
    const struct demo *demo = runner->demo;
    const int finished = runner_finish(runner); /* buffers and lists go elsewhere */
    int status = finished == HAL_OK ? PH_ERR_NOMEM : finished;
    for (uint32_t tries = 0; tries <= demo_count && status == PH_ERR_NOMEM; tries++) {
        demo = demo_after(runner, demo);
        status = open_scene(runner, demo);
    }
    return status;
}

int runner_buttons(struct runner *runner, uint32_t more)
{
    const uint32_t pressed = runner->hal.ops->buttons(runner->hal.context) | more,
                   both = HAL_BUTTON_UP | HAL_BUTTON_DOWN;
    const uint32_t buttons = pressed | ((pressed & both) == both ? HAL_BUTTON_SELECT : 0U);
    const bool select = (buttons & ~runner->buttons & HAL_BUTTON_SELECT) != 0; /* one that is held selects but once */
    runner->buttons = buttons;
    const int status = select ? select_next(runner) : PH_OK;
    demo_input(&runner->context, buttons);
    return status;
}

int runner_scene(struct runner *runner, uint32_t frame)
{
    return runner->demo->frame(&runner->context, &runner->renderer, frame);
}

/* Frame time and triangles, top left; twice as large where there is room. */
static void draw_overlay(const struct runner *runner, uint32_t band, uint16_t *pixels, uint32_t lines)
{
    char text[PH_OVERLAY_STATS_SIZE];
    const struct board *board = runner->config.board;
    const uint16_t width = runner->driver.width;
    const uint32_t us =
        panel_frame_us(board->panel, board->format, runner->config.rotation, (uint32_t)runner->driver.clock_hz);
    ph_overlay_stats(text, us, runner->renderer.stats.triangles_drawn);
    struct ph_overlay_band over = {
        .width = width, .y0 = (int32_t)(band * runner->renderer.config.band_height), .lines = (int32_t)lines};
    over.pixels = pixels;
    const uint8_t scale = ph_overlay_width(text, 2) + 8 <= width ? 2 : 1;
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(0, 0, 0), scale};
    ph_overlay_text(&over, 2 * scale, 2 * scale, text, &style);
}

static bool queues(const struct runner *runner)
{
    return has_queue(&runner->config) && runner->hal.ops->bus_queue != NULL;
}

/* Into the buffer that is not on the wire; without a queue that is so: enough panel_rows came after its own. */
static uint32_t draw_band(struct runner *runner, uint32_t band)
{
    uint16_t *pixels = runner->bands[runner->band_next];
    if (queues(runner)) {
        runner->hal.ops->bus_until(runner->hal.context, runner->written[runner->band_next]);
    }
    const uint32_t lines = demo_draw_band(runner->demo, &runner->context, &runner->renderer, band, pixels);
    if (runner->config.overlay) {
        draw_overlay(runner, band, pixels, lines);
    }
    return lines;
}

/* A panel that gives no edge is drawn without. */
static int wait_for_edge(struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    const bool wired = runner->config.board->pins.tearing.wired && hal->ops->te_wait != NULL;
    const int status = wired ? hal->ops->te_wait(hal->context, TE_WAIT_US) : HAL_OK;
    runner->edges_missed += status == HAL_ETIMEDOUT;
    return status == HAL_ETIMEDOUT ? HAL_OK : status;
}

/* They would touch a buffer that is on the wire if its band was not sent, and nobody asked for how long. */
static struct panel_tiles *tiles_of(const struct runner *runner)
{
    return queues(runner) ? runner->config.tiles : NULL;
}

/* All of the picture, or what changed. */
static int frame_begin(struct runner *runner)
{
    struct panel_diff *diff = runner->config.diff;
    struct panel_tiles *tiles = tiles_of(runner);
    return diff != NULL    ? panel_diff_begin(diff, &runner->driver)
           : tiles != NULL ? panel_tiles_begin(tiles, &runner->driver)
                           : panel_frame_begin(&runner->driver);
}

static int send_rows(struct runner *runner, const uint16_t *pixels, uint32_t lines)
{
    struct panel_diff *diff = runner->config.diff;
    struct panel_tiles *tiles = tiles_of(runner);
    return diff != NULL    ? panel_diff_rows(diff, &runner->driver, pixels, lines)
           : tiles != NULL ? panel_tiles_rows(tiles, &runner->driver, pixels, lines)
                           : panel_rows(&runner->driver, pixels, lines);
}

/* The band that was drawn last. */
static int frame_rows(struct runner *runner, uint32_t lines)
{
    const uint32_t band = runner->band_next;
    const int status = send_rows(runner, runner->bands[band], lines);
    if (queues(runner)) {
        runner->written[band] = runner->hal.ops->bus_written(runner->hal.context);
    }
    runner->band_next = (band + 1) % runner->band_count;
    return status;
}

static int frame_end(struct runner *runner)
{
    struct panel_diff *diff = runner->config.diff;
    struct panel_tiles *tiles = tiles_of(runner);
    return diff != NULL    ? panel_diff_end(diff, &runner->driver)
           : tiles != NULL ? panel_tiles_end(tiles, &runner->driver)
                           : panel_frame_end(&runner->driver);
}

/* The frame before. On a lit panel with a queue nobody need wait for its last bands: this one's follow them. */
static int end_before(struct runner *runner)
{
    const bool follows = has_queue(&runner->config) && runner->driver.lit && !runner->config.board->pins.tearing.wired;
    return follows ? HAL_OK : runner_finish(runner);
}

int runner_send(struct runner *runner)
{
    const uint32_t bands = ph_frame_bands(&runner->renderer);
    uint32_t lines = draw_band(runner, 0); /* the frame before may still be on the wire */
    int status = end_before(runner);
    if (status == HAL_OK) {
        status = wait_for_edge(runner);
    }
    if (status == HAL_OK) {
        status = frame_begin(runner);
    }
    for (uint32_t band = 0; band < bands && status == HAL_OK; band++) {
        lines = band > 0 ? draw_band(runner, band) : lines;
        status = frame_rows(runner, lines);
    }
    runner->sending = status == HAL_OK;
    return status;
}

int runner_finish(struct runner *runner)
{
    if (!runner->sending) {
        return HAL_OK;
    }
    runner->sending = false;
    return frame_end(runner);
}

_Static_assert(PH_OK == (int)HAL_OK && PH_ERR_INVAL == (int)HAL_EINVAL, "the core's and hal's codes are mixed below");

int runner_frame(struct runner *runner, uint32_t frame)
{
    int status = runner_buttons(runner, 0);
    if (status == PH_OK) {
        status = runner_scene(runner, frame);
    }
    return status == PH_OK ? runner_send(runner) : status;
}

int runner_close(struct runner *runner)
{
    runner->sending = false;
    return panel_close(&runner->driver);
}
