/* See panel_show.h. Opens all displays, draws and sends frame after frame, and closes all, also after an error. */
#define _POSIX_C_SOURCE 200809L /* clock_nanosleep */

#include "panel_show.h"

#include "complain.h"
#include "self_test.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define SECOND_NS 1000000000u
#define HOLD_NS   (SECOND_NS / 2) /* so often a picture that stands still wants panel_hold() */

uint64_t panel_show_now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * SECOND_NS + (uint64_t)now.tv_nsec;
}

const char *panel_show_text(const struct panel_display *display, int status)
{
    const char *why = display->why != NULL ? display->why(display->why_context) : "";
    if (why[0] != '\0') {
        return why;
    }
    switch (status) {
    case HAL_EINVAL:
        return "the panel has not this format, size, turn or clock";
    case HAL_EIO:
        return "the display cannot be written to";
    case HAL_ETIMEDOUT:
        return "the bus does not answer";
    default:
        return "it failed";
    }
}

/* ---- opening and closing ------------------------------------------------------------------------ */

static int open_memory(struct panel_display *d, struct runner_config *config)
{
    const struct board *board = d->board;
    config->memory_bytes = runner_bytes(config);
    config->memory = d->memory = malloc(config->memory_bytes);
    const size_t diff_bytes =
        panel_diff_bytes(panel_width(board->panel, board->rotation), panel_height(board->panel, board->rotation));
    const bool diff = config->sender.context == &d->diff;
    d->diff_memory = diff ? malloc(diff_bytes) : NULL;
    if (d->memory == NULL || (diff && d->diff_memory == NULL)) {
        return complain("%s: not enough memory for this scene", board->name);
    }
    return 0;
}

static int fail(const struct panel_display *d, const char *what, int status)
{
    return complain("%s: %s%s", d->board->name, what, panel_show_text(d, status));
}

static int open_kit(struct panel_display *d, const struct runner_config *config)
{
    int status = d->hal.ops->open(d->hal.context, d->board);
    if (status < 0) {
        return fail(d, "", status);
    }
    d->hal_open = true;
    status = runner_open(&d->runner, &d->hal, config);
    d->runner_open = d->runner.driver.config.panel != NULL; /* even a half-opened panel must go dark */
    if (status == PH_ERR_NOMEM) {
        return complain("%s: its %u KB do not hold '%s'; take a smaller scene or another board", d->board->name,
                        (unsigned)(d->board->scene_bytes / 1024), config->demo->name);
    }
    return status == 0 ? 0 : fail(d, "the panel does not wake up: ", status);
}

static int open_display(struct panel_display *d, const struct panel_scene *scene)
{
    const struct board *board = d->board;
    struct runner_config config = {.board = board,
                                   .rotation = board->rotation,
                                   .depth_format = scene->depth.format != NULL ? scene->depth.format : PH_DEPTH_AUTO,
                                   .depth_exponent = scene->depth.exponent,
                                   .band_height = scene->band != 0 ? scene->band : board->band_height,
                                   .budget_bytes = board->scene_bytes,
                                   .demo = scene->demo,
                                   .state = scene->state,
                                   .view = scene->view,
                                   .clip_fps = scene->frames == 0 ? DEMO_CLIPS_BY_CLOCK : 0,
                                   .overlay = scene->overlay,
                                   .sender = d->sender};
    if (scene->diff) {
        config.sender = panel_diff_sender(&d->diff);
    }
    int status = open_memory(d, &config);
    if (status == 0) {
        status = open_kit(d, &config);
    }
    if (status == 0 && scene->diff) {
        const size_t bytes = panel_diff_bytes(d->runner.driver.width, d->runner.driver.height);
        status = panel_diff_init(&d->diff, &d->runner.driver, scene->refresh, d->diff_memory, bytes);
        status = status == 0 ? 0 : fail(d, "", status);
    }
    return status;
}

/* Makes the display dark and releases the kit. Errors here were told before, or do not matter any more. */
static void close_display(struct panel_display *d)
{
    if (d->runner_open) {
        runner_finish(&d->runner);
        runner_close(&d->runner);
    }
    if (d->hal_open) {
        d->hal.ops->close(d->hal.context);
    }
    free(d->diff_memory);
    free(d->memory);
    d->memory = d->diff_memory = NULL;
    d->runner_open = d->hal_open = false;
}

/* ---- frames ------------------------------------------------------------------------------------- */

/* Says once what is left out, and once that the TE line is silent. */
static void tell_losses(struct panel_display *d, uint32_t frame)
{
    const struct ph_stats *s = &d->runner.renderer.stats;
    if (!d->drops_told && (s->triangles_dropped != 0 || s->vertices_dropped != 0)) {
        d->drops_told = true;
        complain_note("%s: frame %u: %u triangles and %u vertices of '%s' do not fit %u KB and are left out",
                      d->board->name, (unsigned)frame, (unsigned)s->triangles_dropped, (unsigned)s->vertices_dropped,
                      d->runner.demo->name, (unsigned)(d->board->scene_bytes / 1024));
    }
    if (!d->edge_told && d->runner.edges_missed != 0) {
        d->edge_told = true;
        complain_note("%s: the TE line gave no edge for 50 ms: frames are sent without waiting for it; check "
                      "its wire, or use --te -",
                      d->board->name);
    }
}

static int show_frame(struct panel_display *d, const struct panel_scene *scene, uint32_t frame)
{
    char what[40];
    int status = scene->before != NULL ? scene->before(scene->before_context, d, frame) : 0;
    if (status != 0) {
        return status;
    }
    status = runner_frame(&d->runner, frame);
    d->bytes += d->runner.driver.frame_bytes;
    if (status != 0) {
        snprintf(what, sizeof what, "frame %u: ", (unsigned)frame);
        return fail(d, what, status);
    }
    tell_losses(d, frame);
    return 0;
}

struct report {
    uint64_t since_ns;
    uint32_t frames;
};

/* Prints the rate, the bytes and the share of the time in which the bus was busy, computed from its clock. */
static void print_stats(const struct panel_display *d, uint32_t frames, double seconds)
{
    const double bits = 8.0 * (double)d->bytes;
    fprintf(stderr, "%s: %.1f frames/s, %.0f bytes/frame, %.0f kB/s, ", d->board->name, frames / seconds,
            frames > 0 ? (double)d->bytes / frames : 0.0, (double)d->bytes / seconds / 1000);
    if (d->sender.ops == NULL) { /* else there is no bus that we know of */
        fprintf(stderr, "bus %.0f %% of %d Hz, ", 100 * bits / seconds / d->runner.driver.clock_hz,
                (int)d->runner.driver.clock_hz);
    }
    fprintf(stderr, "%u triangles\n", (unsigned)d->runner.renderer.stats.triangles_drawn);
}

static void report_stats(struct panel_display *displays, int count, struct report *report, bool now)
{
    const uint64_t time_ns = panel_show_now_ns();
    const double seconds = (double)(time_ns - report->since_ns) / SECOND_NS;
    if (report->frames == 0 || (!now && time_ns - report->since_ns < SECOND_NS)) {
        return;
    }
    for (int i = 0; i < count; i++) {
        print_stats(&displays[i], report->frames, seconds);
        displays[i].bytes = 0;
    }
    *report = (struct report){time_ns, 0};
}

/* Sleeps until this time, or until a signal comes; then it is not 0. */
static int sleep_until(uint64_t time_ns)
{
    const struct timespec time = {(time_t)(time_ns / SECOND_NS), (long)(time_ns % SECOND_NS)};
    return clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, NULL);
}

static int hold(struct panel_display *displays, int count)
{
    int status = 0;
    for (int i = 0; i < count && status == 0; i++) {
        const int held = panel_hold(&displays[i].runner.driver);
        status = held == 0 ? 0 : fail(&displays[i], "", held);
    }
    return status;
}

/* Sleeps until the next frame is due, or a signal comes. A late frame delays those after it. */
static int pace(struct panel_display *displays, int count, uint64_t *due_ns, uint32_t fps)
{
    if (fps == 0) {
        return 0;
    }
    uint64_t now = panel_show_now_ns();
    int status = 0;
    *due_ns = *due_ns + SECOND_NS / fps > now ? *due_ns + SECOND_NS / fps : now;
    for (; status == 0 && *due_ns - now > HOLD_NS; now += HOLD_NS) {
        if (sleep_until(now + HOLD_NS) != 0) {
            return 0;
        }
        status = hold(displays, count);
    }
    if (status == 0) {
        sleep_until(*due_ns);
    }
    return status;
}

static int run_frames(struct panel_display *displays, int count, const struct panel_scene *scene)
{
    struct report report = {panel_show_now_ns(), 0};
    uint64_t due_ns = report.since_ns, before_us = report.since_ns / 1000;
    int status = 0;
    for (uint32_t i = 0; (scene->frames == 0 || i < scene->frames) && status == 0 && *scene->stop == 0; i++) {
        const uint64_t us = panel_show_now_ns() / 1000;
        for (int k = 0; k < count && status == 0; k++) {
            runner_pass(&displays[k].runner, (uint32_t)(us - before_us));
            status = show_frame(&displays[k], scene, scene->start + i);
        }
        before_us = us;
        report.frames += status == 0;
        if (scene->stats) {
            report_stats(displays, count, &report, false);
        }
        if (status == 0 && *scene->stop == 0) {
            status = pace(displays, count, &due_ns, scene->fps);
        }
    }
    status = status == PANEL_SHOW_OVER ? 0 : status;
    for (int k = 0; k < count && status == 0; k++) {
        const int finished = runner_finish(&displays[k].runner); /* the last frame is out, too */
        status = finished == 0 ? 0 : fail(&displays[k], "the last frame: ", finished);
    }
    if (scene->stats) {
        report_stats(displays, count, &report, true);
    }
    return status;
}

int panel_show_run(struct panel_display *displays, int count, const struct panel_scene *scene)
{
    int status = 0;
    for (int i = 0; i < count && status == 0 && *scene->stop == 0; i++) {
        status = open_display(&displays[i], scene);
    }
    if (status == 0 && *scene->stop == 0) {
        status = run_frames(displays, count, scene);
    }
    for (int i = count; i-- > 0;) {
        close_display(&displays[i]);
    }
    return status;
}

int panel_show_report(struct panel_display *display, const struct panel_scene *scene,
                      const struct self_test_machine *machine, self_test_put *put,
                      void (*look)(struct panel_driver *driver))
{
    int status = open_display(display, scene);
    if (status == 0) {
        status = self_test_report(&display->runner, machine, put);
        look(&display->runner.driver);
        status = status < 0   ? fail(display, "", status)
                 : status > 0 ? complain("%s: the picture is not the known one", display->board->name)
                              : 0;
    }
    close_display(display);
    return status;
}
