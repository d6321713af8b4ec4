/* See runner.h. */
#include "runner.h"

#include "crc32.h"
#include "overlay.h"

#define TE_WAIT_US 50000 /* for the tearing-effect edge: three frames of the slowest panel */

/* With fewer vertices than these the other core earns less than it takes to prepare it. */
#define AHEAD_LEAST 32

/* ---- opening ------------------------------------------------------------------------------------ */

static int open_panel(struct runner *runner, const struct picture_memory *p)
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

static int init_renderer(const struct runner *runner, struct ph_renderer *r, const struct ph_config *config)
{
    const int status = ph_renderer_init(r, config);
    return status == 0 && runner->config.dither != NULL ? runner->config.set_dither(r, runner->config.dither) : status;
}

static int open_renderer(struct runner *runner, const struct picture_memory *p, const struct scene_memory *s)
{
    const struct ph_config config = {.width = p->width,
                                     .height = p->height,
                                     .band_height = p->lines,
                                     .depth_format = runner->config.depth_format,
                                     .depth_exponent = runner->config.depth_exponent,
                                     .other_core = runner->config.other_core,
                                     .other_core_join = runner->config.other_core_join,
                                     .cores = runner->config.cores,
                                     .occlusion = PH_COARSE_DEPTH,
                                     .colouring = PH_COLOURS,
                                     .vertices = runner->scene,
                                     .vertex_max = (uint32_t)(s->list_bytes / ph_vertex_bytes),
                                     .triangles = runner->scene,
                                     .triangle_max = s->triangle_max,
                                     .bins = runner->bins,
                                     .bin_max = p->bands,
                                     .depth = runner->depth,
                                     .samples = runner->samples,
                                     .antialiasing = runner->config.antialiasing};
    return init_renderer(runner, &runner->renderer, &config);
}

static int open_demo(struct runner *runner, const struct demo *demo, const struct picture_memory *p,
                     const struct scene_memory *s)
{
    const bool first = demo == runner->config.demo;
    runner->clock = (struct demo_clock){.seconds = 0};
    runner->demo = demo;
    runner->context = (struct demo_context){.arena = {runner->scene + s->arena_at, s->arena_bytes, 0},
                                            .state = first ? runner->config.state : NULL,
                                            .view = first ? runner->config.view : NULL,
                                            .width = p->width,
                                            .height = p->height,
                                            .camera = runner->config.camera,
                                            .clip_fps = runner->config.clip_fps,
                                            .scratch = s->scratch_bytes > 0 ? runner->scene + s->scratch_at : NULL,
                                            .scratch_bytes = s->scratch_bytes};
    return demo->init(&runner->context);
}

/* The buffers follow the parts of memory that are the same for every demo; the scene follows the buffers. */
static void place_buffers(struct runner *runner, const struct picture_memory *p)
{
    uint8_t *next = (uint8_t *)runner->bins + p->bin_bytes + p->wire_bytes;
    runner->samples = p->sample_bytes > 0 ? (uint16_t *)(void *)next : NULL;
    next += p->sample_bytes;
    runner->band_count = (uint16_t)p->buffers;
    runner->band_next = 0;
    for (uint32_t i = 0; i < p->buffers; i++, next += p->band_bytes) {
        runner->bands[i] = (uint16_t *)(void *)next;
    }
    runner->scene = next;
    const struct hal *hal = &runner->hal;
    if (hal->ops->bus_queue != NULL) {
        hal->ops->bus_queue(hal->context, memory_plan_has_queue(&runner->config));
        const uint32_t written = hal->ops->bus_written(hal->context);
        for (uint32_t i = 0; i < p->buffers; i++) {
            runner->written[i] = written;
        }
    }
}

/* Waits for the other core. The scene that it has made is lost. */
static void drop_ahead(struct runner *runner)
{
    if (runner->ahead) {
        runner->config.other_core_join(); /* calls other_core_join, each */
        runner->ahead = false;
    }
}

/* Opens a scene in the memory of the one before; only while nothing is on the wire. */
static int open_scene(struct runner *runner, const struct demo *demo)
{
    drop_ahead(runner);
    const struct memory_plan plan = memory_plan(&runner->config, demo);
    if (plan.scene.triangle_max == 0 || memory_plan_bytes(&plan) > runner->config.memory_bytes) {
        return PH_ERR_NOMEM;
    }
    place_buffers(runner, &plan.picture);
    const struct panel_sender *sender = &runner->config.sender;
    if (sender->ops->forget != NULL) {
        sender->ops->forget(sender->context);
    }
    const int status = open_renderer(runner, &plan.picture, &plan.scene);
    return status == PH_OK ? open_demo(runner, demo, &plan.picture, &plan.scene) : status;
}

static bool queues(const struct runner *runner)
{
    return memory_plan_has_queue(&runner->config) && runner->hal.ops->bus_queue != NULL;
}

/* A sender that skips bands needs the queue: without it nobody knows when the buffer of a skipped band is free. */
static void choose_sender(struct runner *runner)
{
    struct panel_sender *sender = &runner->config.sender;
    if (sender->ops == NULL || (sender->ops->skips && !queues(runner))) {
        *sender = panel_sender_whole;
    }
}

int runner_open(struct runner *runner, const struct hal *hal, const struct runner_config *config)
{
    const struct picture_memory p = memory_plan_picture(config, config->band_height);
    *runner = (struct runner){.config = *config, .hal = *hal};
    choose_sender(runner);
    if (p.bands == 0) {
        return PH_ERR_INVAL;
    }
    if (memory_plan_picture_bytes(&p) > config->memory_bytes) {
        return PH_ERR_NOMEM;
    }
    runner->depth = config->memory;
    runner->bins = (uint32_t *)(void *)((uint8_t *)runner->depth + p.depth_bytes);
    const int status = open_scene(runner, config->demo);
    return status == PH_OK ? open_panel(runner, &p) : status;
}

/* ---- select and buttons -------------------------------------------------------------------------- */

/* A first demo that is not on the list, e.g. a model's, comes before the list's first. */
static const struct demo *demo_after(const struct runner *runner, const struct demo *demo)
{
    const struct demo *first = runner->config.demo;
    uint32_t i = 0;
    while (i < demo_count && demo_list[i] != demo) {
        i++;
    }
    uint32_t next = i + 1;
    while (next < demo_count && demo_list[next]->by_name_only) {
        next++;
    }
    if (next < demo_count) {
        return demo_list[next];
    }
    const bool listed = demo_find(first->name) == first;
    return i < demo_count && !listed ? first : demo_list[0];
}

/* Takes the next clip of the scene, or else the next demo for which there is room. */
static int select_next(struct runner *runner)
{
    const struct demo *demo = runner->demo;
    if (demo->select != NULL && demo->select(&runner->context)) {
        return PH_OK;
    }
    const int finished = runner_finish(runner); /* buffers and lists move */
    int status = finished == HAL_OK ? PH_ERR_NOMEM : finished;
    for (uint32_t tries = 0; tries <= demo_count && status == PH_ERR_NOMEM; tries++) {
        demo = demo_after(runner, demo);
        status = open_scene(runner, demo);
    }
    return status;
}

int runner_take(struct runner *runner, const struct demo *demo)
{
    const int finished = runner_finish(runner);
    return finished == HAL_OK ? open_scene(runner, demo) : finished;
}

int runner_buttons(struct runner *runner, uint32_t more)
{
    const uint32_t pressed = runner->hal.ops->buttons(runner->hal.context) | more,
                   both = HAL_BUTTON_UP | HAL_BUTTON_DOWN;
    const uint32_t buttons = pressed | ((pressed & both) == both ? HAL_BUTTON_SELECT : 0U);
    const bool select = (buttons & ~runner->buttons & HAL_BUTTON_SELECT) != 0; /* a held button selects once */
    runner->buttons = buttons;
    if (runner->ahead && buttons != ((const struct runner_ahead *)runner->config.ahead)->buttons) {
        drop_ahead(runner);
    }
    const int status = select ? select_next(runner) : PH_OK;
    if (!runner->ahead) {
        demo_input(&runner->context, buttons);
    }
    return status;
}

struct demo_clock demo_clock_after(struct demo_clock clock, uint32_t us)
{
    const uint32_t rest = us % 1000000 * 4096 + clock.rest, part = clock.part + rest / 62500; /* 2^16 / 10^6 */
    return (struct demo_clock){clock.seconds + us / 1000000 + (part >> 16), (uint16_t)part, (uint16_t)(rest % 62500)};
}

void runner_pass(struct runner *runner, uint32_t us)
{
    runner->clock = demo_clock_after(runner->clock, us);
    runner->step = (uint16_t)(us / 64 < UINT16_MAX ? us / 64 : UINT16_MAX);
}

int runner_scene(struct runner *runner, uint32_t frame)
{
    const struct runner_ahead *const a = runner->config.ahead;
    const bool ahead = runner->ahead;
    drop_ahead(runner);
    if (!ahead || a->frame != frame) {
        runner->context.clock = runner->clock;
        return runner->demo->frame(&runner->context, &runner->renderer, frame);
    }
    runner->renderer = a->renderer;
    runner->context = a->context;
    return a->status;
}

static void make_ahead(void *argument) /* called as ahead */
{
    struct runner_ahead *const a = argument;
    a->status = a->demo->frame(&a->context, &a->renderer, a->frame);
}

/* A demo with a blur keeps the blur of a frame in its context until the bands are drawn. */
static bool may_go_ahead(const struct runner *runner)
{
    const size_t list_bytes = runner->renderer.config.vertex_max * ph_vertex_bytes;
    return runner->config.other_core != NULL && runner->config.ahead != NULL && runner->demo->blur_radius == 0 &&
           runner->renderer.stats.vertices >= AHEAD_LEAST &&
           sizeof(struct runner_ahead) + list_bytes <= runner->config.ahead_bytes;
}

/* Lets the other core make the scene of a frame. The buttons are taken to be as they were. */
void runner_ahead(struct runner *runner, uint32_t frame)
{
    struct runner_ahead *const a = runner->config.ahead;
    if (!may_go_ahead(runner)) {
        return;
    }
    struct ph_config config = runner->renderer.config;
    config.vertices = config.vertices == runner->scene ? (void *)(a + 1) : runner->scene;
    config.triangles = config.vertices;
    a->status = init_renderer(runner, &a->renderer, &config);
    a->context = runner->context;
    a->context.clock = demo_clock_after(runner->clock, runner->step * 64U);
    a->demo = runner->demo;
    a->frame = frame;
    a->buttons = runner->buttons;
    demo_input(&a->context, a->buttons);
    runner->ahead = runner->config.other_core(make_ahead, a);
}

/* ---- drawing and sending ------------------------------------------------------------------------- */

/* Writes frame time and triangles at the top left, twice as large where there is room. */
static void draw_overlay(const struct runner *runner, uint32_t band, uint16_t *pixels, uint32_t lines)
{
    char text[PH_OVERLAY_STATS_SIZE];
    const struct board *board = runner->config.board;
    const uint16_t width = runner->driver.width;
    const uint32_t us =
        panel_frame_us(board->panel, board->format, runner->config.rotation, (uint32_t)runner->driver.clock_hz);
    ph_overlay_stats(text, us, runner->renderer.stats.triangles_drawn);
    struct ph_overlay_band over = {
        .width = width,
        .y0 = (int32_t)(band * (runner->renderer.config.band_height >> runner->renderer.samples_log2)),
        .lines = (int32_t)lines};
    over.pixels = pixels;
    const uint8_t scale = ph_overlay_width(text, 2) + 8 <= width ? 2 : 1;
    const struct ph_overlay_style style = {ph_rgb565(255, 255, 255), ph_rgb565(0, 0, 0), scale};
    ph_overlay_text(&over, 2 * scale, 2 * scale, text, &style);
}

/* Draws into the next buffer, which is free once the bus has sent it. Without a queue the other was sent after it. */
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

/* Waits for the panel's tearing-effect edge. If it gives none the frame is drawn without it. */
static int wait_for_edge(struct runner *runner)
{
    const struct hal *hal = &runner->hal;
    const bool wired = runner->config.board->pins.tearing.wired && hal->ops->te_wait != NULL;
    const int status = wired ? hal->ops->te_wait(hal->context, TE_WAIT_US) : HAL_OK;
    runner->edges_missed += status == HAL_ETIMEDOUT;
    return status == HAL_ETIMEDOUT ? HAL_OK : status;
}

/* Sends the band that was drawn last. */
static int frame_rows(struct runner *runner, uint32_t lines)
{
    const struct panel_sender *sender = &runner->config.sender;
    const uint32_t band = runner->band_next;
    const int status = sender->ops->rows(sender->context, &runner->driver, runner->bands[band], lines);
    if (queues(runner)) {
        runner->written[band] = runner->hal.ops->bus_written(runner->hal.context);
    }
    runner->band_next = (uint16_t)((band + 1) % runner->band_count);
    return status;
}

/* Ends the frame before. On a lit panel a queue's or a copying backend's last bands need no wait: the next follow. */
static int end_before(struct runner *runner)
{
    const bool copied = runner->hal.ops->bus_flush != NULL && !runner->config.sender.ops->copies;
    const bool follows = (copied || memory_plan_has_queue(&runner->config)) && runner->driver.lit &&
                         !runner->config.board->pins.tearing.wired;
    return follows ? HAL_OK : runner_finish(runner);
}

int runner_send(struct runner *runner)
{
    const struct panel_sender *sender = &runner->config.sender;
    const uint32_t bands = ph_frame_bands(&runner->renderer);
    uint32_t lines = draw_band(runner, 0); /* the frame before may still be on the wire */
    int status = end_before(runner);
    status = status == HAL_OK ? wait_for_edge(runner) : status;
    status = status == HAL_OK ? sender->ops->begin(sender->context, &runner->driver) : status;
    for (uint32_t band = 0; band < bands && status == HAL_OK; band++) {
        lines = band > 0 ? draw_band(runner, band) : lines;
        status = frame_rows(runner, lines);
    }
    runner->sending = status == HAL_OK;
    return status;
}

static uint32_t crc_pixels(uint32_t crc, const uint8_t *pixels, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++, pixels += 2) {
        const uint32_t wire = (uint32_t)pixels[0] << 8 | pixels[1], r = wire >> 11, g = wire >> 5 & 63, b = wire & 31;
        const uint8_t rgb[3] = {(uint8_t)(r << 3 | r >> 2), (uint8_t)(g << 2 | g >> 4), (uint8_t)(b << 3 | b >> 2)};
        crc = crc32_update(crc, rgb, sizeof rgb);
    }
    return crc;
}

uint32_t runner_crc(struct runner *runner)
{
    uint32_t crc = 0;
    for (uint32_t band = 0, bands = ph_frame_bands(&runner->renderer); band < bands; band++) {
        const uint32_t lines = draw_band(runner, band);
        crc = crc_pixels(crc, (const uint8_t *)runner->bands[runner->band_next], lines * runner->context.width);
    }
    return crc;
}

int runner_finish(struct runner *runner)
{
    if (!runner->sending) {
        return HAL_OK;
    }
    const struct panel_sender *sender = &runner->config.sender;
    runner->sending = false;
    return sender->ops->end(sender->context, &runner->driver);
}

_Static_assert(PH_OK == (int)HAL_OK && PH_ERR_INVAL == (int)HAL_EINVAL, "the core's and hal's codes are mixed below");

int runner_frame(struct runner *runner, uint32_t frame)
{
    int status = runner_buttons(runner, 0);
    status = status == PH_OK ? runner_scene(runner, frame) : status;
    if (status == PH_OK) {
        runner_ahead(runner, frame + 1);
    }
    return status == PH_OK ? runner_send(runner) : status;
}

int runner_close(struct runner *runner)
{
    drop_ahead(runner);
    runner->sending = false;
    return panel_close(&runner->driver);
}
