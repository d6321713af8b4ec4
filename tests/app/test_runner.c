/* runner: buffers and an asynchronous bus, with and without a queue; memory of exactly the stated size; select. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "boards.h"
#include "boards_all.h"
#include "crc32.h"
#include "runner.h"
#include "sim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define QUEUED_MAX 4096

/* A bus that reads a buffer only when it has to give it back, so that it notices whoever changed the buffer before. */
struct late_bus {
    struct sim *sim;
    struct hal below;
    const uint8_t *bytes;
    uint8_t copy[65536];
    size_t n;
    uint32_t held; /* writes of pixels that were on their way when the next one came */
    uint32_t buttons;
    bool queue;
    struct queued {
        const uint8_t *bytes;
        uint8_t *copy;
        size_t n;
    } queued[QUEUED_MAX]; /* numbered released .. written - 1; copied ones have no bytes */
    uint32_t written, released, most;
    uint32_t pixel_bytes;
};

static void give_back(struct late_bus *bus)
{
    if (bus->n > 0) {
        assert_memory_equal(bus->bytes, bus->copy, bus->n);
        bus->n = 0;
    }
}

/* Ends the writes below number `to`: nobody has changed their buffers. */
static void release(struct late_bus *bus, uint32_t to)
{
    for (; bus->released != to; bus->released++) {
        struct queued *q = &bus->queued[bus->released % QUEUED_MAX];
        if (q->copy != NULL) {
            assert_memory_equal(q->bytes, q->copy, q->n);
            free(q->copy);
        }
    }
}

static int queue_write(struct late_bus *bus, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    assert_true(bus->written - bus->released < QUEUED_MAX);
    struct queued *q = &bus->queued[bus->written++ % QUEUED_MAX];
    *q = (struct queued){bytes, NULL, n};
    if (n > HAL_COPIED) {
        q->copy = malloc(n);
        memcpy(q->copy, bytes, n);
        bus->pixel_bytes += (uint32_t)n;
    }
    const uint32_t waiting = bus->written - bus->released;
    bus->most = waiting > bus->most ? waiting : bus->most;
    return bus->below.ops->bus_write(bus->below.context, dc, bytes, n);
}

static int late_write(void *context, enum hal_dc dc, const uint8_t *bytes, size_t n)
{
    struct late_bus *bus = context;
    if (bus->queue) {
        return queue_write(bus, dc, bytes, n);
    }
    bus->held += bus->n > 1000 && n > 1000;
    assert_true(bus->n < 1000 || bytes + n <= bus->bytes || bytes >= bus->bytes + bus->n);
    give_back(bus);
    assert_true(n <= sizeof bus->copy);
    memcpy(bus->copy, bytes, n);
    bus->bytes = bytes;
    bus->n = n;
    return bus->below.ops->bus_write(bus->below.context, dc, bytes, n);
}

static int late_wait(void *context)
{
    struct late_bus *bus = context;
    give_back(bus);
    release(bus, bus->written);
    return HAL_OK;
}

static void late_queue(void *context, bool on)
{
    struct late_bus *bus = context;
    assert_int_equal(bus->n, 0); /* nothing is on its way when buffers move */
    assert_int_equal(bus->released, bus->written);
    bus->queue = on;
}

static uint32_t late_written(void *context)
{
    const struct late_bus *bus = context;
    return bus->written;
}

static int late_until(void *context, uint32_t written)
{
    struct late_bus *bus = context;
    if ((int32_t)(written - bus->released) > 0) {
        release(bus, written);
    }
    return HAL_OK;
}

static int32_t late_clock(void *context, uint32_t hz)
{
    const struct late_bus *bus = context;
    return bus->below.ops->bus_clock(bus->below.context, hz);
}

static int late_pin(void *context, enum hal_pin pin, bool level)
{
    const struct late_bus *bus = context;
    return bus->below.ops->pin_set(bus->below.context, pin, level);
}

static void late_delay(void *context, uint32_t us)
{
    const struct late_bus *bus = context;
    bus->below.ops->delay_us(bus->below.context, us);
}

static uint32_t late_buttons(void *context)
{
    const struct late_bus *bus = context;
    return bus->buttons;
}

/* Every frame ends at once. */
static uint32_t late_time(void *context)
{
    (void)context;
    return 0;
}

static const struct hal_ops late_ops = {.name = "late",
                                        .bus_clock = late_clock,
                                        .bus_write = late_write,
                                        .bus_wait = late_wait,
                                        .pin_set = late_pin,
                                        .delay_us = late_delay,
                                        .buttons = late_buttons};

static const struct hal_ops queue_ops = {.name = "late",
                                         .time_us = late_time,
                                         .bus_clock = late_clock,
                                         .bus_write = late_write,
                                         .bus_wait = late_wait,
                                         .bus_queue = late_queue,
                                         .bus_written = late_written,
                                         .bus_until = late_until,
                                         .pin_set = late_pin,
                                         .delay_us = late_delay,
                                         .buttons = late_buttons};

struct stage {
    struct late_bus bus;
    struct hal hal;
    struct runner runner;
    struct runner_config config;
};

static struct stage *stage_of(const struct board *board, const char *demo, uint16_t band_height, uint32_t budget,
                              int expected)
{
    struct stage *s = calloc(1, sizeof *s);
    assert_non_null(s);
    s->bus.sim = sim_open(board, &s->bus.below);
    s->hal = (struct hal){&late_ops, &s->bus};
    s->config = (struct runner_config){.board = board,
                                       .depth_format = PH_DEPTH_AUTO,
                                       .rotation = board->rotation,
                                       .band_height = band_height,
                                       .budget_bytes = budget,
                                       .demo = demo_find(demo)};
    s->config.memory_bytes = runner_bytes(&s->config);
    s->config.memory = malloc(s->config.memory_bytes); /* not a byte more, so that a sanitizer sees an overrun */
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), expected);
    return s;
}

static struct stage *stage_open(const struct board *board, uint32_t budget, int expected)
{
    return stage_of(board, "cube", board->band_height, budget, expected);
}

static void stage_close(struct stage *s)
{
    sim_close(s->bus.sim);
    free(s->config.memory);
    free(s);
}

static void no_buffer_is_touched_while_it_is_sent(void **state)
{
    (void)state;
    struct stage *s = stage_open(board_find("waveshare-pico-lcd-1in3"), board_find("pico-display")->scene_bytes, 0);
    for (uint32_t frame = 0; frame < 5; frame++) {
        assert_int_equal(runner_frame(&s->runner, frame), 0);
    }
    assert_int_equal(runner_finish(&s->runner), 0);
    assert_true(s->bus.held >= 5 * 13); /* 15 bands a frame: each was drawn while the one before was sent */
    assert_int_equal(runner_close(&s->runner), 0);
    assert_int_equal(sim_complaint_count(s->bus.sim), 0);
    stage_close(s);
}

/* 20 KB: the ground's meshes do not fit beside the bands. */
static void select_takes_the_next_demo_that_fits(void **state)
{
    (void)state;
    const struct board *board = board_find("lm3s6965evb");
    struct stage *s = stage_open(board, 20000, 0);
    for (uint32_t i = 0; i < 2 * demo_count; i++) {
        s->bus.buttons = i % 2 == 0 ? HAL_BUTTON_SELECT : 0;
        assert_int_equal(runner_frame(&s->runner, i), 0);
        assert_string_not_equal(s->runner.demo->name, "ground");
        assert_string_not_equal(s->runner.demo->name, "fill"); /* by name only */
    }
    stage_close(s);
}

static void a_button_that_is_held_selects_once(void **state)
{
    (void)state;
    struct stage *s = stage_open(board_find("pico-display"), board_find("pico-display")->scene_bytes, 0);
    s->bus.buttons = HAL_BUTTON_SELECT;
    assert_int_equal(runner_frame(&s->runner, 0), 0);
    const struct demo *first = s->runner.demo;
    assert_int_equal(runner_frame(&s->runner, 1), 0);
    assert_ptr_equal(s->runner.demo, first);
    assert_ptr_not_equal(s->runner.demo, demo_find("cube"));
    stage_close(s);
}

static void up_and_down_together_select(void **state)
{
    (void)state;
    struct stage *s = stage_open(board_find("pico-display"), board_find("pico-display")->scene_bytes, 0);
    const struct demo *first = s->runner.demo;
    s->bus.buttons = HAL_BUTTON_UP;
    assert_int_equal(runner_frame(&s->runner, 0), 0);
    s->bus.buttons = HAL_BUTTON_DOWN;
    assert_int_equal(runner_frame(&s->runner, 1), 0);
    assert_ptr_equal(s->runner.demo, first);
    s->bus.buttons = HAL_BUTTON_UP | HAL_BUTTON_DOWN;
    assert_int_equal(runner_frame(&s->runner, 2), 0);
    const struct demo *second = s->runner.demo;
    assert_ptr_not_equal(second, first);
    assert_int_equal(runner_frame(&s->runner, 3), 0);
    assert_ptr_equal(s->runner.demo, second);
    stage_close(s);
}

/* A cube, of which the select button first goes through two clips. */
static int clips_left;
static bool take_clip(struct demo_context *context)
{
    context->clip = "run";
    return clips_left-- > 0;
}

static void select_asks_the_demo_before_it_takes_the_next(void **state)
{
    (void)state;
    struct demo demo = *demo_find("cube");
    demo.select = take_clip;
    clips_left = 2;
    struct stage *s = stage_open(board_find("pico-display"), board_find("pico-display")->scene_bytes, 0);
    s->runner.demo = &demo;
    for (uint32_t i = 0; i < 6; i++) { /* a held button asks once */
        s->bus.buttons = i % 3 < 2 ? HAL_BUTTON_SELECT : 0;
        assert_int_equal(runner_frame(&s->runner, i), 0);
        assert_ptr_equal(s->runner.demo, &demo);
        assert_int_equal(clips_left, i < 3 ? 1 : 0);
        assert_string_equal(s->runner.context.clip, "run");
    }
    s->bus.buttons = HAL_BUTTON_SELECT;
    assert_int_equal(runner_frame(&s->runner, 6), 0);
    assert_ptr_not_equal(s->runner.demo, &demo);
    assert_null(s->runner.context.clip);
    stage_close(s);
}

static void too_little_memory_is_refused(void **state)
{
    (void)state;
    stage_close(stage_open(board_find("pico-display"), 30000, PH_ERR_NOMEM)); /* bands, no scene */
    stage_close(stage_open(board_find("pico-display"), 1000, PH_ERR_NOMEM));
}

static void a_smaller_budget_leaves_out_more_and_counts_it(void **state)
{
    (void)state;
    uint32_t dropped = UINT32_MAX;
    for (uint32_t budget = 20000; dropped > 0; budget += 5000) {
        struct stage *s = stage_open(board_find("lm3s6965evb"), budget, 0);
        while (strcmp(s->runner.demo->name, "fisheye") != 0) {
            assert_int_equal(runner_buttons(&s->runner, HAL_BUTTON_SELECT), 0);
            assert_int_equal(runner_buttons(&s->runner, 0), 0);
        }
        assert_int_equal(runner_frame(&s->runner, 0), 0);
        assert_true(s->runner.renderer.stats.triangles_dropped < dropped);
        dropped = s->runner.renderer.stats.triangles_dropped;
        assert_true((budget == 20000) <= (dropped > 0)); /* the first has too little */
        stage_close(s);
    }
}

static struct stage *stage_on(const struct board *board, const char *demo, uint16_t band_height)
{
    return stage_of(board, demo, band_height, board->scene_bytes, 0);
}

static void a_demo_has_the_buffers_that_fit_beside_it(void **state)
{
    (void)state;
    const struct board *board = board_find("waveshare-pico-lcd-1in3");
    static const struct {
        const char *demo;
        uint32_t least, most;
    } expected[] = {{"fill", 12, 14}, {"solar", 5, 7}, {"hitchcock", 5, 7}, {"focus", 2, 5}};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        struct stage *s = stage_on(board, expected[i].demo, board->band_height);
        assert_in_range(s->runner.band_count, expected[i].least, expected[i].most);
        stage_close(s);
    }
    struct stage *s = stage_on(board_find("lm3s6965evb"), "fill", 8); /* its backend has no queue */
    assert_int_equal(s->runner.band_count, 2);
    stage_close(s);
}

/* Bands of any height leave out the same triangles. */
static void other_bands_share_the_memory_out_alike(void **state)
{
    (void)state;
    static const uint16_t heights[] = {1, 8, 40, 1024};
    const struct board *board = board_find("lm3s6965evb");
    for (size_t i = 0; i < sizeof heights / sizeof heights[0]; i++) {
        struct stage *own = stage_on(board, "fisheye", board->band_height),
                     *other = stage_on(board, "fisheye", heights[i]);
        assert_int_equal(own->runner.renderer.config.triangle_max, other->runner.renderer.config.triangle_max);
        stage_close(own);
        stage_close(other);
    }
}

static struct stage *queue_on(const char *demo)
{
    struct stage *s = stage_on(board_find("pico-display"), demo, 16);
    s->hal.ops = &queue_ops;
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    return s;
}

static void no_buffer_in_the_queue_is_touched(void **state)
{
    (void)state;
    struct stage *s = queue_on("fill");
    for (uint32_t frame = 0; frame < 2 * demo_count; frame++) {
        s->bus.buttons = frame % 2 == 1 ? HAL_BUTTON_SELECT : 0;
        assert_int_equal(runner_frame(&s->runner, frame), 0);
        assert_true(s->bus.queue);
    }
    assert_true(s->bus.most >= s->runner.band_count);
    assert_int_equal(runner_close(&s->runner), 0);
    stage_close(s);
}

/* The glass shows the whole picture. Less is sent, except for demos in which everything moves. */
static void tiles_show_every_demo_as_it_is(void **state)
{
    (void)state;
    static uint8_t seen[3 * 240 * 135], expected[sizeof seen];
    struct stage *whole = queue_on("fill"), *s = queue_on("fill");
    const uint32_t bytes = (uint32_t)panel_tiles_bytes(240, 135, 16);
    struct panel_tiles tiles;
    void *memory = malloc(bytes);
    s->config.sender = panel_tiles_sender(&tiles);
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    assert_int_equal(panel_tiles_init(&tiles, &s->runner.driver, 16, memory, bytes), 0);
    for (uint32_t frame = 0; frame < 6 * demo_count; frame++) {
        whole->bus.buttons = s->bus.buttons = frame % 6 == 5 ? HAL_BUTTON_SELECT : 0;
        assert_int_equal(runner_frame(&whole->runner, frame), 0);
        assert_int_equal(runner_frame(&s->runner, frame), 0);
        sim_pixels(whole->bus.sim, whole->config.rotation, expected);
        sim_pixels(s->bus.sim, s->config.rotation, seen);
        assert_memory_equal(seen, expected, sizeof seen);
    }
    print_message("# sent %u %% of the pixels\n", (unsigned)(100ULL * s->bus.pixel_bytes / whole->bus.pixel_bytes));
    assert_true(10 * (uint64_t)s->bus.pixel_bytes < 8 * (uint64_t)whole->bus.pixel_bytes);
    assert_int_equal(runner_close(&s->runner), 0);
    assert_int_equal(runner_close(&whole->runner), 0);
    free(memory);
    stage_close(whole);
    stage_close(s);
}

/* Without a queue nobody knows when the buffer of a band that was not sent is free. */
static int edge_status;
static uint32_t edge_timeout_us;

static int late_te_wait(void *context, uint32_t timeout_us)
{
    (void)context;
    edge_timeout_us = timeout_us;
    return edge_status;
}

/* Frames of at least 15 a second give an edge in time. */
static void a_frame_that_gets_no_edge_is_sent_and_counted(void **state)
{
    (void)state;
    static const int statuses[] = {HAL_OK, HAL_ETIMEDOUT, HAL_ETIMEDOUT, HAL_OK, HAL_ETIMEDOUT};
    struct board board = board_pico_display;
    board.pins.tearing = (struct board_pin)BOARD_PIN(7);
    struct hal_ops ops = late_ops;
    ops.te_wait = late_te_wait;
    struct stage *s = stage_open(&board, 60000, 0);
    s->runner.hal.ops = &ops;
    uint32_t missed = 0;
    for (uint32_t frame = 0; frame < sizeof statuses / sizeof statuses[0]; frame++) {
        const uint64_t before = sim_counters(s->bus.sim).bytes;
        edge_status = statuses[frame];
        missed += edge_status == HAL_ETIMEDOUT;
        assert_int_equal(runner_frame(&s->runner, frame), 0);
        assert_int_equal(runner_finish(&s->runner), 0);
        assert_int_equal(s->runner.edges_missed, missed);
        assert_true(sim_counters(s->bus.sim).bytes - before >= 2 * 240 * 135);
        assert_in_range(edge_timeout_us, 1000000 / 60, 1000000 / 15);
    }
    edge_status = HAL_EIO;
    assert_int_equal(runner_frame(&s->runner, 9), HAL_EIO);
    assert_int_equal(s->runner.edges_missed, missed);
    stage_close(s);
}

static void no_edge_is_waited_for_where_its_line_is_not_wired(void **state)
{
    (void)state;
    struct hal_ops ops = late_ops;
    ops.te_wait = late_te_wait;
    edge_status = HAL_ETIMEDOUT;
    struct stage *s = stage_open(&board_pico_display, 60000, 0);
    s->runner.hal.ops = &ops;
    assert_int_equal(runner_frame(&s->runner, 0), 0);
    assert_int_equal(s->runner.edges_missed, 0);
    stage_close(s);
}

static void without_a_queue_frames_are_sent_whole(void **state)
{
    (void)state;
    struct stage *s = stage_on(board_find("pico-display"), "fill", 16);
    struct panel_tiles tiles = {0};
    s->config.sender = panel_tiles_sender(&tiles);
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    assert_ptr_equal(s->runner.config.sender.ops, panel_sender_whole.ops);
    s->hal.ops = &queue_ops;
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    assert_ptr_equal(s->runner.config.sender.context, &tiles);
    stage_close(s);
}

/* ---- a demo that keeps what it is told, and another core that works at once ---- */

static struct {
    struct demo_context at_init, at_frame;
    uint32_t frames, frame, vertices, joins;
    int status;
} told;

static int told_init(struct demo_context *context)
{
    told.at_init = *context;
    return PH_OK;
}

static int told_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct ph_projection lens = {
        .kind = PH_PERSPECTIVE, .scale_x_q20 = 1 << 20, .scale_y_q20 = 1 << 20, .near_z = FX_ONE, .far_z = 9 * FX_ONE};
    const struct ph_scene_light light = {0};
    assert_int_equal(ph_frame_begin(r, &ph_xform_identity, &lens, &light, 0), 0);
    r->stats.vertices = told.vertices;
    told.at_frame = *context;
    told.frame = context->frame = frame;
    told.frames++;
    return told.status;
}

/* Every pixel has another colour than its neighbours, and all of them come. */
static uint32_t told_band(struct demo_context *context, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t y0 = band * r->config.band_height, left = context->height - y0,
                   lines = left < r->config.band_height ? left : r->config.band_height;
    for (uint32_t i = 0; i < lines * context->width; i++) {
        const uint32_t wire = 40503u * (y0 * context->width + i);
        const uint8_t bytes[2] = {(uint8_t)(wire >> 8), (uint8_t)wire};
        memcpy(&pixels[i], bytes, sizeof bytes);
    }
    return lines;
}

static bool core_at_once(void (*run)(void *argument), void *argument)
{
    run(argument);
    return true;
}

static void join_at_once(void)
{
    told.joins++;
}

static struct demo teller(const char *name)
{
    return (struct demo){.name = name,
                         .loop_frames = 1,
                         .arena_bytes = 64,
                         .arena_bytes_32 = 64,
                         .vertex_max = 64,
                         .triangle_max = 64,
                         .init = told_init,
                         .frame = told_frame,
                         .band = told_band};
}

#define AHEAD_BYTES(s) (sizeof(struct runner_ahead) + (s)->runner.renderer.config.vertex_max * ph_vertex_bytes)

/* A runner with a demo that is not on the list, opened after `set` has changed its configuration. */
static struct stage *teller_open(const struct demo *demo, void (*set)(struct runner_config *))
{
    struct stage *s = stage_on(board_find("pico-display"), "cube", 16);
    memset(&told, 0, sizeof told);
    told.vertices = 32;
    s->config.demo = demo;
    if (set != NULL) {
        set(&s->config);
    }
    assert_int_equal(runner_open(&s->runner, &s->hal, &s->config), 0);
    return s;
}

static void set_all(struct runner_config *config)
{
    config->state = &told;
    config->view = "a view";
    config->camera.view_set = true;
    config->camera.view.t.z = 77;
    config->depth_exponent = 3;
    config->clip_fps = 25;
}

/* State and view are the first demo's alone; the camera is everybody's. */
static void a_demo_is_told_what_the_configuration_says(void **state)
{
    (void)state;
    const struct demo first = teller("first"), second = teller("second");
    struct stage *s = teller_open(&first, set_all);
    assert_ptr_equal(told.at_init.state, &told);
    assert_string_equal(told.at_init.view, "a view");
    assert_int_equal(told.at_init.camera.view.t.z, 77);
    assert_int_equal(told.at_init.clip_fps, 25);
    assert_int_equal(s->runner.renderer.config.depth_exponent, 3);
    assert_int_equal(runner_take(&s->runner, &second), 0);
    assert_null(told.at_init.state);
    assert_null(told.at_init.view);
    assert_int_equal(told.at_init.camera.view.t.z, 77);
    stage_close(s);
}

/* A channel's bits are repeated below them: times 33 / 4 or 65 / 16, rounded down. */
static void the_crc_is_that_of_channels_of_8_bits(void **state)
{
    (void)state;
    const struct demo demo = teller("first");
    struct stage *s = teller_open(&demo, NULL);
    uint32_t crc = 0;
    assert_int_equal(runner_scene(&s->runner, 0), 0);
    for (uint32_t i = 0; i < 240 * 135; i++) {
        const uint32_t wire = 40503u * i & 0xFFFF;
        const uint8_t rgb[3] = {(uint8_t)((wire >> 11) * 33 / 4), (uint8_t)(wire / 32 % 64 * 65 / 16),
                                (uint8_t)(wire % 32 * 33 / 4)};
        crc = crc32_update(crc, rgb, 3);
    }
    assert_int_equal(runner_crc(&s->runner), crc);
    stage_close(s);
}

static void a_first_demo_that_is_not_listed_comes_after_the_last(void **state)
{
    (void)state;
    const struct demo demo = teller("first");
    struct stage *s = teller_open(&demo, NULL);
    const struct demo *last = NULL;
    for (uint32_t i = 0; i < demo_count; i++) {
        last = demo_list[i]->by_name_only ? last : demo_list[i];
    }
    assert_int_equal(runner_buttons(&s->runner, HAL_BUTTON_SELECT), 0);
    assert_ptr_equal(s->runner.demo, demo_list[0]);
    assert_int_equal(runner_take(&s->runner, last), 0);
    assert_int_equal(runner_buttons(&s->runner, 0), 0);
    assert_int_equal(runner_buttons(&s->runner, HAL_BUTTON_SELECT), 0);
    assert_ptr_equal(s->runner.demo, &demo);
    stage_close(s);
}

static void set_cores(struct runner_config *config)
{
    static uint64_t memory[20000];
    config->other_core = core_at_once;
    config->cores = PH_TWO_CORES;
    config->other_core_join = join_at_once;
    config->ahead = memory;
    config->ahead_bytes = sizeof memory;
}

static bool is_ahead_after(struct stage *s, uint32_t frame)
{
    assert_int_equal(runner_buttons(&s->runner, 0), 0);
    assert_int_equal(runner_scene(&s->runner, frame), 0);
    runner_ahead(&s->runner, frame + 1);
    return s->runner.ahead;
}

static void the_scene_made_ahead_is_the_next_one_with_its_context(void **state)
{
    (void)state;
    const struct demo demo = teller("first");
    struct stage *s = teller_open(&demo, set_cores);
    s->bus.buttons = HAL_BUTTON_LEFT;
    assert_int_equal(runner_frame(&s->runner, 5), 0);
    assert_int_equal(told.frames, 2);
    assert_int_equal(told.frame, 6);
    assert_int_equal(told.at_frame.buttons, HAL_BUTTON_LEFT);
    const uint32_t orbit = told.at_frame.orbit;
    assert_true(orbit != s->runner.context.orbit && orbit == 2 * s->runner.context.orbit);
    const void *const list = s->runner.renderer.config.vertices;
    assert_int_equal(runner_buttons(&s->runner, 0), 0);
    told.status = PH_ERR_STATE;
    assert_int_equal(runner_scene(&s->runner, 6), PH_OK); /* as it was when it was made */
    assert_int_equal(told.frames, 2);
    assert_int_equal(s->runner.context.frame, 6);
    assert_int_equal(s->runner.context.orbit, orbit);
    assert_ptr_not_equal(s->runner.renderer.config.vertices, list);
    assert_false(s->runner.ahead);
    runner_ahead(&s->runner, 7);
    assert_int_equal(runner_scene(&s->runner, 7), PH_ERR_STATE);
    assert_ptr_equal(s->runner.renderer.config.vertices, list); /* two lists take turns */
    told.status = PH_OK;
    assert_true(is_ahead_after(s, 8));
    assert_int_equal(runner_scene(&s->runner, 20), PH_OK);
    assert_int_equal(told.frame, 20); /* made again */
    runner_ahead(&s->runner, 21);
    s->bus.buttons = 0;
    assert_int_equal(runner_buttons(&s->runner, 0), 0);
    assert_false(s->runner.ahead); /* other buttons */
    const uint32_t joins = told.joins;
    assert_true(is_ahead_after(s, 30));
    runner_close(&s->runner);
    assert_int_equal(told.joins, joins + 1);
    stage_close(s);
}

static double seconds_of(struct demo_clock clock)
{
    return clock.seconds + clock.part / 65536.;
}

/* 13 frames a second: each scene has the time that has passed before its frame, also one that the other core makes
 * before that time has come. Where a frame takes longer than the one before, one scene is early. */
static void clips_run_by_the_clock(void **state)
{
    const struct demo demo = teller("first"), second = teller("second");
    (void)state;
    for (int ahead = 0; ahead < 2; ahead++) {
        struct stage *s = teller_open(&demo, ahead == 1 ? set_cores : NULL);
        for (uint32_t frame = 0; frame < 130; frame++) {
            runner_pass(&s->runner, frame == 0 ? 0 : 76923);
            assert_int_equal(runner_scene(&s->runner, frame), 0);
            const double off = seconds_of(s->runner.context.clock) - frame * .076923;
            assert_true(frame == 1 ? off <= 0 : fabs(off) < 1e-4);
            runner_ahead(&s->runner, frame + 1);
            assert_int_equal(s->runner.ahead, ahead == 1);
        }
        runner_pass(&s->runner, 100000);
        assert_int_equal(runner_scene(&s->runner, 130), 0);
        assert_true(fabs(seconds_of(s->runner.context.clock) - (ahead == 1 ? 130 * .076923 : 129 * .076923 + .1)) <
                    1e-4);
        assert_int_equal(runner_take(&s->runner, &second), 0);
        assert_true(seconds_of(s->runner.clock) == 0 && s->runner.context.clip_fps == 0);
        stage_close(s);
    }
}

static void a_scene_is_made_ahead_only_where_it_can_be_and_earns(void **state)
{
    (void)state;
    const struct demo demo = teller("first");
    struct stage *s = teller_open(&demo, set_cores);
    assert_true(is_ahead_after(s, 0));
    told.vertices = 31;
    assert_false(is_ahead_after(s, 5));
    told.vertices = 32;
    assert_true(is_ahead_after(s, 10));
    s->runner.config.ahead_bytes = AHEAD_BYTES(s);
    assert_true(is_ahead_after(s, 15));
    s->runner.config.ahead_bytes--;
    assert_false(is_ahead_after(s, 20));
    s->runner.config.ahead_bytes++;
    struct demo blurred = demo;
    blurred.blur_radius = 1;
    assert_true(is_ahead_after(s, 25));
    runner_scene(&s->runner, 30);
    s->runner.demo = &blurred;
    assert_false(is_ahead_after(s, 35));
    s->runner.demo = &demo;
    s->runner.config.other_core = NULL;
    assert_false(is_ahead_after(s, 40));
    stage_close(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_demo_has_the_buffers_that_fit_beside_it),
        cmocka_unit_test(other_bands_share_the_memory_out_alike),
        cmocka_unit_test(no_buffer_in_the_queue_is_touched),
        cmocka_unit_test(tiles_show_every_demo_as_it_is),
        cmocka_unit_test(a_frame_that_gets_no_edge_is_sent_and_counted),
        cmocka_unit_test(no_edge_is_waited_for_where_its_line_is_not_wired),
        cmocka_unit_test(without_a_queue_frames_are_sent_whole),
        cmocka_unit_test(a_demo_is_told_what_the_configuration_says),
        cmocka_unit_test(the_crc_is_that_of_channels_of_8_bits),
        cmocka_unit_test(a_first_demo_that_is_not_listed_comes_after_the_last),
        cmocka_unit_test(the_scene_made_ahead_is_the_next_one_with_its_context),
        cmocka_unit_test(clips_run_by_the_clock),
        cmocka_unit_test(a_scene_is_made_ahead_only_where_it_can_be_and_earns),
        cmocka_unit_test(no_buffer_is_touched_while_it_is_sent),
        cmocka_unit_test(select_takes_the_next_demo_that_fits),
        cmocka_unit_test(a_button_that_is_held_selects_once),
        cmocka_unit_test(up_and_down_together_select),
        cmocka_unit_test(select_asks_the_demo_before_it_takes_the_next),
        cmocka_unit_test(too_little_memory_is_refused),
        cmocka_unit_test(a_smaller_budget_leaves_out_more_and_counts_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
