/* See kit.h. */
#include "kit.h"

#include "overlay.h"

/* Of a 32-bit target, whose lists hold 32-bit pointers. */
#define VERTEX_BYTES_32   20
#define TRIANGLE_BYTES_32 92

#define WIRE_MAX   4096  /* bytes of scratch for the panel driver */
#define TE_WAIT_US 50000 /* for the tearing-effect edge: three frames of the slowest panel */

#define ROUND8(n) (((n) + 7) & ~(uint64_t)7)

/* The memory of one picture, in the order in which it is taken; the same on every machine. */
struct picture {
    uint16_t width, height, lines;
    uint32_t bands, buffers, band_bytes, depth_bytes, bin_bytes, wire_bytes;
};

/* ... and of one demo. */
struct scene {
    size_t arena_bytes, scratch_bytes;
    uint32_t vertex_max, triangle_max;
};

/* As many band buffers as the board says, fewer of higher bands: no more lines in all. */
static uint32_t buffers_of(const struct board *board, uint32_t lines)
{
    const uint32_t most = board_writes_ahead(board) + 1, fit = lines > 0 ? most * board->band_height / lines : 0;
    const uint32_t count = fit < most ? fit : most;
    return count < 2 ? 2 : count < KIT_BANDS_MAX ? count : KIT_BANDS_MAX;
}

static struct picture picture_of(const struct kit_config *config)
{
    const struct panel *panel = config->board->panel;
    struct picture p = {.width = panel_width(panel, config->rotation), .height = panel_height(panel, config->rotation)};
    p.lines = config->band_height < p.height ? config->band_height : p.height;
    p.bands = p.lines > 0 ? (p.height + p.lines - 1U) / p.lines : 0;
    p.buffers = buffers_of(config->board, p.lines);
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
    return ROUND8(level->arena_bytes_32) + ROUND8((uint64_t)level->vertex_max * VERTEX_BYTES_32) +
           ROUND8((uint64_t)triangle_max * TRIANGLE_BYTES_32);
}

/* The finest level that fits whole, else as much as fits of the coarsest; no triangles: not even its meshes fit. */
static struct scene scene_of(const struct demo *demo, const struct picture *p, uint64_t budget)
{
    struct demo_level level = {demo->arena_bytes, demo->arena_bytes_32, demo->vertex_max, demo->triangle_max};
    for (uint32_t i = 0; i < demo->coarser_count && level_bytes_32(&level, level.triangle_max) > budget; i++) {
        level = demo->coarser[i];
    }
    struct scene scene = {.arena_bytes = level.arena_bytes, .vertex_max = level.vertex_max};
    const uint64_t meshes = level_bytes_32(&level, 0), whole = level_bytes_32(&level, level.triangle_max);
    if (whole <= budget) {
        const size_t scratch = demo_scratch_bytes(demo, p->width, p->lines);
        scene.triangle_max = level.triangle_max;
        scene.scratch_bytes = whole + ROUND8(scratch) <= budget ? scratch : 0;
    } else if (meshes < budget) {
        scene.triangle_max = (uint32_t)(((budget - meshes) & ~(uint64_t)7) / TRIANGLE_BYTES_32);
    }
    return scene;
}

/* Of this machine. */
static uint64_t scene_bytes(const struct scene *s)
{
    return ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes) + ROUND8((uint64_t)s->triangle_max * ph_triangle_bytes) +
           ROUND8(s->arena_bytes) + ROUND8(s->scratch_bytes);
}

/* What the budget leaves for the scene. */
static uint64_t scene_budget(const struct kit_config *config, const struct picture *p)
{
    const uint64_t taken = picture_bytes(p);
    return config->budget_bytes > taken ? config->budget_bytes - taken : 0;
}

uint32_t kit_budget(const struct board *board)
{
    return board->ram_bytes > KIT_OTHER_BYTES ? board->ram_bytes - KIT_OTHER_BYTES : 0;
}

size_t kit_bytes(const struct kit_config *config)
{
    const struct picture p = picture_of(config);
    const uint64_t budget = scene_budget(config, &p);
    const struct scene own = scene_of(config->demo, &p, budget);
    uint64_t most = scene_bytes(&own);
    for (uint32_t i = 0; i < demo_count; i++) {
        const struct scene listed = scene_of(demo_list[i], &p, budget);
        const uint64_t bytes = listed.triangle_max > 0 ? scene_bytes(&listed) : 0;
        most = bytes > most ? bytes : most;
    }
    return (size_t)(picture_bytes(&p) + most);
}

uint64_t kit_whole_bytes(const struct kit_config *config)
{
    const struct demo *demo = config->demo;
    const struct picture p = picture_of(config);
    const struct demo_level level = {demo->arena_bytes, demo->arena_bytes_32, demo->vertex_max, demo->triangle_max};
    return picture_bytes(&p) + level_bytes_32(&level, level.triangle_max);
}

static int open_panel(struct kit *kit, const struct picture *p)
{
    const struct board *board = kit->config.board;
    const struct panel_config config = {.panel = board->panel,
                                        .rotation = kit->config.rotation,
                                        .format = board->format,
                                        .clock_hz = kit->config.clock_hz != 0 ? kit->config.clock_hz : board->spi_hz,
                                        .scratch = p->wire_bytes > 0 ? (uint8_t *)kit->bins + p->bin_bytes : NULL,
                                        .scratch_bytes = p->wire_bytes};
    return panel_open(&kit->driver, &kit->hal, &config);
}

static int open_renderer(struct kit *kit, const struct picture *p, const struct scene *s)
{
    const struct ph_config config = {.width = p->width,
                                     .height = p->height,
                                     .band_height = p->lines,
                                     .depth_format = kit->config.depth_format,
                                     .other_core = kit->config.other_core,
                                     .other_core_join = kit->config.other_core_join,
                                     .vertices = kit->scene,
                                     .vertex_max = s->vertex_max,
                                     .triangles = kit->scene + ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes),
                                     .triangle_max = s->triangle_max,
                                     .bins = kit->bins,
                                     .bin_max = p->bands,
                                     .depth = kit->depth};
    return ph_renderer_init(&kit->renderer, &config);
}

static int open_demo(struct kit *kit, const struct demo *demo, const struct picture *p, const struct scene *s)
{
    const bool first = demo == kit->config.demo;
    uint8_t *arena = kit->scene + ROUND8((uint64_t)s->vertex_max * ph_vertex_bytes) +
                     ROUND8((uint64_t)s->triangle_max * ph_triangle_bytes);
    kit->demo = demo;
    kit->context = (struct demo_context){.arena = {arena, s->arena_bytes, 0},
                                         .state = first ? kit->config.state : NULL,
                                         .view = first ? kit->config.view : NULL,
                                         .width = p->width,
                                         .height = p->height,
                                         .camera = kit->config.camera,
                                         .scratch = s->scratch_bytes > 0 ? arena + ROUND8(s->arena_bytes) : NULL,
                                         .scratch_bytes = s->scratch_bytes};
    return demo->init(&kit->context);
}

static int open_scene(struct kit *kit, const struct demo *demo)
{
    const struct picture p = picture_of(&kit->config);
    const struct scene s = scene_of(demo, &p, scene_budget(&kit->config, &p));
    if (s.triangle_max == 0 || picture_bytes(&p) + scene_bytes(&s) > kit->config.memory_bytes) {
        return PH_ERR_NOMEM;
    }
    const int status = open_renderer(kit, &p, &s);
    return status == PH_OK ? open_demo(kit, demo, &p, &s) : status;
}

int kit_open(struct kit *kit, const struct hal *hal, const struct kit_config *config)
{
    const struct picture p = picture_of(config);
    *kit = (struct kit){.config = *config, .hal = *hal};
    if (p.bands == 0) {
        return PH_ERR_INVAL;
    }
    if (picture_bytes(&p) > config->memory_bytes) {
        return PH_ERR_NOMEM;
    }
    uint8_t *next = config->memory;
    kit->band_count = p.buffers;
    for (uint32_t i = 0; i < p.buffers; i++, next += p.band_bytes) {
        kit->bands[i] = (uint16_t *)(void *)next;
    }
    kit->depth = next;
    kit->bins = (uint32_t *)(void *)(next + p.depth_bytes);
    kit->scene = next + p.depth_bytes + p.bin_bytes + p.wire_bytes;
    const int status = open_scene(kit, config->demo);
    return status == PH_OK ? open_panel(kit, &p) : status;
}

/* A demo that is not on the list, e.g. a model's, stands before the first. */
static const struct demo *demo_after(const struct kit *kit, const struct demo *demo)
{
    const struct demo *first = kit->config.demo;
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
static int select_next(struct kit *kit)
{
    const struct demo *demo = kit->demo;
    int status = PH_ERR_NOMEM;
    for (uint32_t tries = 0; tries <= demo_count && status == PH_ERR_NOMEM; tries++) {
        demo = demo_after(kit, demo);
        status = open_scene(kit, demo);
    }
    return status;
}

int kit_buttons(struct kit *kit, uint32_t more)
{
    const uint32_t buttons = kit->hal.ops->buttons(kit->hal.context) | more;
    const bool select = (buttons & ~kit->buttons & HAL_BUTTON_SELECT) != 0; /* one that is held selects but once */
    kit->buttons = buttons;
    const int status = select ? select_next(kit) : PH_OK;
    demo_input(&kit->context, buttons);
    return status;
}

int kit_scene(struct kit *kit, uint32_t frame)
{
    return kit->demo->frame(&kit->context, &kit->renderer, frame);
}

/* Frame time and triangles, top left; twice as large where there is room. */
static void draw_overlay(const struct kit *kit, uint32_t band, uint16_t *pixels, uint32_t lines)
{
    char text[PH_OVERLAY_STATS_SIZE];
    const struct board *board = kit->config.board;
    const uint16_t width = kit->driver.width;
    const uint32_t us =
        panel_frame_us(board->panel, board->format, kit->config.rotation, (uint32_t)kit->driver.clock_hz);
    ph_overlay_stats(text, us, kit->renderer.stats.triangles_drawn);
    struct ph_overlay_band over = {
        .width = width, .y0 = (int32_t)(band * kit->renderer.config.band_height), .lines = (int32_t)lines};
    over.pixels = pixels;
    const uint8_t scale = ph_overlay_width(text, 2) + 8 <= width ? 2 : 1;
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(0, 0, 0), scale};
    ph_overlay_text(&over, 2 * scale, 2 * scale, text, &style);
}

/* Into the buffer that is not on the wire. */
static uint32_t draw_band(struct kit *kit, uint32_t band)
{
    uint16_t *pixels = kit->bands[kit->band_next];
    const uint32_t lines = demo_draw_band(kit->demo, &kit->context, &kit->renderer, band, pixels);
    if (kit->config.overlay) {
        draw_overlay(kit, band, pixels, lines);
    }
    return lines;
}

/* A panel that gives no edge is drawn without. */
static int wait_for_edge(struct kit *kit)
{
    const struct hal *hal = &kit->hal;
    const bool wired = kit->config.board->pins.tearing.wired && hal->ops->te_wait != NULL;
    const int status = wired ? hal->ops->te_wait(hal->context, TE_WAIT_US) : HAL_OK;
    kit->edges_missed += status == HAL_ETIMEDOUT;
    return status == HAL_ETIMEDOUT ? HAL_OK : status;
}

/* All of the picture, or what changed. */
static int frame_begin(struct kit *kit)
{
    struct panel_diff *diff = kit->config.diff;
    return diff != NULL ? panel_diff_begin(diff, &kit->driver) : panel_frame_begin(&kit->driver);
}

static int frame_rows(struct kit *kit, const uint16_t *pixels, uint32_t lines)
{
    struct panel_diff *diff = kit->config.diff;
    return diff != NULL ? panel_diff_rows(diff, &kit->driver, pixels, lines) : panel_rows(&kit->driver, pixels, lines);
}

static int frame_end(struct kit *kit)
{
    struct panel_diff *diff = kit->config.diff;
    return diff != NULL ? panel_diff_end(diff, &kit->driver) : panel_frame_end(&kit->driver);
}

int kit_send(struct kit *kit)
{
    const uint32_t bands = ph_frame_bands(&kit->renderer), ahead = board_writes_ahead(kit->config.board);
    uint32_t lines = draw_band(kit, 0); /* the frame before may still be on the wire */
    int status = kit_finish(kit);
    if (status == HAL_OK) {
        status = wait_for_edge(kit);
    }
    if (status == HAL_OK) {
        status = frame_begin(kit);
    }
    for (uint32_t band = 0; band < bands && status == HAL_OK; band++) {
        lines = band > 0 ? draw_band(kit, band) : lines;
        status = frame_rows(kit, kit->bands[kit->band_next], lines);
        if (status == HAL_OK && kit->band_count <= ahead) { /* buffers are few for this backend */
            status = panel_wait(&kit->driver);
        }
        kit->band_next = (kit->band_next + 1) % kit->band_count; /* free: enough panel_rows came after its own */
    }
    kit->sending = status == HAL_OK;
    return status;
}

int kit_finish(struct kit *kit)
{
    if (!kit->sending) {
        return HAL_OK;
    }
    kit->sending = false;
    return frame_end(kit);
}

int kit_frame(struct kit *kit, uint32_t frame)
{
    int status = kit_buttons(kit, 0);
    if (status == PH_OK) {
        status = kit_scene(kit, frame);
    }
    return status == PH_OK ? kit_send(kit) : status;
}

int kit_close(struct kit *kit)
{
    kit->sending = false;
    return panel_close(&kit->driver);
}
