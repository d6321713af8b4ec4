/*
 * The image of all demos. The first demo starts, or the scene that the image was built with; the select button takes
 * the next clip of a scene, and then the next demo.
 *
 * On the log UART (115200 8N1) it writes which demo or clip starts, a line about frames each second, and why it
 * stopped. It reads single characters:
 *   B          reboot into the chip's boot loader (as a button does that is held at power-up)
 *   H          draw one frame, write a line about it, and hold; G: go on
 *   R          a report of the kit to paste (self_test.h); then it holds, with the test card on the glass
 *   u d l r s  as if the kit's button were held during one frame
 */
#include "image.h"
#include "port.h"
#include "runner.h"
#include "scene_file.h"
#include "self_test.h"

#define SECOND_MS 1000U
#define CHARGE_US 20000U /* a button's line reads released after this time: 100 nF and 80 kOhm take 8 ms to 2 V */

struct console {
    bool first; /* no frame was drawn yet; frame 0 comes again after 2^32 of them */
    bool holding;
    bool reporting;      /* a report was asked for */
    uint32_t buttons;    /* for the next frame */
    uint32_t frame_us;   /* when the frame before began */
    uint32_t counted_us; /* until when time is counted */
    uint32_t passed_ms;  /* since it last wrote a line about frames; UINT32_MAX: so long or longer */
    uint32_t line_frame; /* the next frame then */
};

static void log_named(const char *name, uint32_t value)
{
    port_log(name);
    self_test_number(port_log, value, false, 1);
}

/* Writes to the log: "frame 117, 24 frames/s, left out 0 triangles 0 vertices, stack 4032". */
static void log_frame(const struct runner *runner, uint32_t frame, uint32_t rate)
{
    log_named("frame ", frame);
    log_named(", ", rate);
    log_named(" frames/s, left out ", runner->renderer.stats.triangles_dropped);
    log_named(" triangles ", runner->renderer.stats.vertices_dropped);
    log_named(" vertices, stack ", port_stack_used());
    port_log("\r\n");
}

static void log_start(const char *kind, const char *name)
{
    port_log(kind);
    port_log(name);
    port_log("\r\n");
}

/* Returns true if the character starts the next frame. */
static bool obey(struct console *console, int byte)
{
    static const char keys[] = "udlrs"; /* in the order of the bits of enum hal_button */
    for (uint32_t i = 0; i < sizeof keys - 1; i++) {
        console->buttons |= byte == keys[i] ? 1U << i : 0U;
    }
    if (byte == 'B') {
        port_boot_loader();
    }
    if (byte == 'H' || byte == 'G') {
        console->holding = byte == 'H';
    }
    console->reporting = byte == 'R';
    return byte == 'H' || byte == 'G' || byte == 'R';
}

/* Counts the time that has passed. Call it often: time_us begins anew after 71 minutes, and a hold may take longer. */
static void count_time(struct console *console, const struct hal *hal)
{
    const uint32_t ms = (hal->ops->time_us(hal->context) - console->counted_us) / 1000;
    console->counted_us += ms * 1000;
    console->passed_ms = ms < UINT32_MAX - console->passed_ms ? console->passed_ms + ms : UINT32_MAX;
}

/* Reads all characters that wait. While the console holds, it reads on until the next frame is asked for. */
static void listen(struct console *console, const struct hal *hal)
{
    bool next = !console->holding;
    console->buttons = 0;
    for (int byte = port_log_read(); byte >= 0 || !next; byte = port_log_read()) {
        count_time(console, hal);
        if (byte >= 0 && obey(console, byte)) {
            return;
        }
    }
}

static int draw(struct runner *runner, struct console *console, uint32_t frame)
{
    const struct demo *before = runner->demo;
    const char *const clip = runner->context.clip;
    const uint32_t now = runner->hal.ops->time_us(runner->hal.context);
    runner_pass(runner, console->first ? 0 : now - console->frame_us);
    console->frame_us = now;
    int status = runner_buttons(runner, console->buttons);
    status = status == 0 ? runner_scene(runner, frame) : status;
    if (status == 0 && !console->holding) {
        runner_ahead(runner, frame + 1);
    }
    status = status == 0 ? runner_send(runner) : status;
    if (status == 0 && (console->holding || console->first)) {
        status = runner_finish(runner);
    }
    if (runner->demo != before) {
        log_start("demo ", runner->demo->name);
    } else if (runner->context.clip != clip) {
        log_start("clip ", runner->context.clip);
    }
    return status;
}

static void report(const struct runner *runner, struct console *console, uint32_t frame)
{
    count_time(console, &runner->hal);
    if (!console->holding && console->passed_ms < SECOND_MS) {
        return;
    }
    const uint32_t frames = frame + 1 - console->line_frame;
    log_frame(runner, frame, console->passed_ms > 0 ? frames * 1000 / console->passed_ms : 0);
    console->passed_ms = 0;
    console->line_frame = frame + 1;
}

static void log_text(const char *text) /* called as put */
{
    port_log(text[0] == '\n' ? "\r\n" : text);
}

static void log_fact(const char *text, uint32_t value, enum port_form form) /* called as fact */
{
    log_text(text);
    if (form != PORT_TEXT) {
        self_test_number(port_log, value, form == PORT_HEX, 1);
    }
}

static void log_facts(const void *context, self_test_put *put)
{
    (void)context, (void)put; /* log_text */
    port_facts(log_fact);
}

/* Writes the report of a kit. A failed CRC is in the report; only an error stops the image. */
static int write_report(struct runner *runner, struct console *console, uint32_t frames)
{
    const struct self_test_machine machine = {.build = image_build, .frames = frames, .facts = log_facts};
    const int status = self_test_report(runner, &machine, log_text);
    console->reporting = false;
    console->holding = true;
    return status < 0 ? status : 0;
}

static int run(struct runner *runner)
{
    struct console console = {.first = true, .counted_us = runner->hal.ops->time_us(runner->hal.context)};
    int status = 0;
    log_start("demo ", runner->demo->name);
    for (uint32_t frame = 0; status == 0; frame++) {
        listen(&console, &runner->hal);
        if (console.reporting) {
            status = write_report(runner, &console, frame);
            frame--;
            continue;
        }
        status = draw(runner, &console, frame);
        console.first = false;
        report(runner, &console, frame);
    }
    return status;
}

/* Run on the other core, to see if there is one. */
static void do_nothing(void *argument) /* called as run */
{
    (void)argument;
}

/* Sends only tiles that changed if the build gives enough memory for their signatures, else every frame whole. */
static struct panel_sender sender(struct panel_tiles *tiles)
{
    const struct panel *panel = board_here->panel;
    const uint8_t rotation = board_here->rotation;
    const size_t needed =
        panel_tiles_bytes(panel_width(panel, rotation), panel_height(panel, rotation), board_here->band_height);
    return needed <= image_tiles_bytes ? panel_tiles_sender(tiles) : panel_sender_whole;
}

/* A line that reads pressed may still be charged by its pull-up, which hal.ops->open() turned on. */
static bool button_held(const struct hal *hal)
{
    const uint32_t from = hal->ops->time_us(hal->context);
    bool held;
    do {
        held = hal->ops->buttons(hal->context) != 0;
    } while (held && hal->ops->time_us(hal->context) - from <= CHARGE_US);
    return held;
}

/* Whether a scene is in flash that can be drawn. */
static bool has_scene(void)
{
    const char *const wrong = image_scene_bytes > 0 ? scene_file_wrong(image_scene, image_scene_bytes) : "is missing";
    if (wrong != NULL && image_scene_bytes > 0 && *(const uint32_t *)image_scene != UINT32_MAX) { /* not erased */
        port_log("the scene in flash ");
        port_log(wrong);
        port_log("\r\n");
    }
    return wrong == NULL;
}

/* Opens with the scene in flash as the first demo; its struct demo takes the beginning of the memory. Without room for
 * the scene the image's own demo is the first. */
static int open_runner(struct runner *runner, const struct hal *hal, const struct runner_config *own)
{
    struct runner_config config = *own;
    const size_t taken = (sizeof(struct demo) + 7) & ~(size_t)7;
    if (has_scene()) {
        struct demo *const demo = config.memory;
        *demo = scene_file_demo(image_scene);
        config.demo = demo;
        config.state = (void *)(uintptr_t)image_scene;
        config.memory = (uint8_t *)config.memory + taken;
        config.memory_bytes -= taken;
        config.budget_bytes -= taken;
        const int status = runner_open(runner, hal, &config);
        if (status != PH_ERR_NOMEM) {
            return status;
        }
        port_log("the scene in flash needs more memory\r\n");
    }
    return runner_open(runner, hal, own);
}

static int open(struct runner *runner, struct panel_tiles *tiles)
{
    const struct hal hal = port_hal();
    int status = hal.ops->open(hal.context, board_here);
    if (status != 0) {
        return status;
    }
    if (button_held(&hal)) {
        port_boot_loader();
    }
    const bool second = port_core_run(do_nothing, NULL);
    port_core_join();
    const struct runner_config config = {.board = board_here,
                                         .rotation = board_here->rotation,
                                         .depth_format = PH_DEPTH_AUTO,
                                         .band_height = board_here->band_height,
                                         .budget_bytes = board_here->scene_bytes,
                                         .other_core = second ? port_core_run : NULL,
                                         .other_core_join = second ? port_core_join : NULL,
                                         .cores = second ? PH_TWO_CORES : NULL,
                                         .ahead = image_ahead,
                                         .ahead_bytes = image_ahead_bytes,
                                         .demo = demo_here,
                                         .clip_fps = image_clip_fps,
                                         .dither = image_dither,
                                         .set_dither = image_set_dither,
                                         .sender = sender(tiles),
                                         .memory = image_memory,
                                         .memory_bytes = image_memory_bytes};
    status = open_runner(runner, &hal, &config);
    if (status == 0 && runner->config.sender.context == tiles) {
        status = panel_tiles_init(tiles, &runner->driver, config.band_height, image_tiles, image_tiles_bytes);
    }
    return status;
}

int main(void)
{
    static struct runner runner;
    static struct panel_tiles tiles;
    port_log("\r\nPinhole on ");
    port_log(board_here->title);
    port_log("\r\n");
    int status = open(&runner, &tiles);
    status = status == 0 ? run(&runner) : status;
    log_named("stopped: error ", (uint32_t)-status);
    port_log("\r\n");
    return 1;
}
