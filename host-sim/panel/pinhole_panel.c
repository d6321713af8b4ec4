/* pinhole-panel: shows scenes on a real display: at this machine's SPI bus, on an FT232H, or the kernel's own. */

#include "complain.h"
#include "model.h"
#include "nearest.h"
#include "panel_doctor.h"
#include "panel_facts.h"
#include "panel_identify.h"
#include "panel_kit.h"
#include "panel_probe.h"
#include "panel_show.h"
#include "self_test.h"
#include "signal_stop.h"

#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- what is shown where ------------------------------------------------------------------------ */

struct stage {
    struct panel_kit kits[PANEL_KITS_MAX];
    struct panel_display displays[PANEL_KITS_MAX];
    int count;
    struct model *model;
    struct demo model_demo;
};

static const char *kit_error(const void *context)
{
    return panel_kit_error(context);
}

static int choose_kits(struct stage *stage, const struct panel_options *o)
{
    for (stage->count = 0; stage->count < o->kit_count; stage->count++) {
        struct panel_kit *kit = &stage->kits[stage->count];
        const int status = panel_kit_choose(kit, &o->kits[stage->count]);
        if (status != 0) {
            return status;
        }
        stage->displays[stage->count] = (struct panel_display){
            .board = &kit->board, .hal = kit->hal, .sender = kit->sender, .why = kit_error, .why_context = kit};
    }
    return 0;
}

static int choose_view(const struct panel_options *o, struct panel_scene *scene)
{
    scene->view = o->view;
    return o->view == NULL || demo_has_view(scene->demo, o->view)
               ? 0
               : complain_usage("--view '%s': %s has no such view; `pinhole-sim --list` shows them", o->view,
                                scene->demo->name);
}

static int choose_demo(const struct panel_options *o, const char *name, struct panel_scene *scene)
{
    scene->demo = demo_find(name);
    if (scene->demo == NULL) {
        return complain_usage("--demo '%s': no such demo; %s`pinhole-sim --list` shows them", name,
                              nearest_text(name, nearest_demo, NULL));
    }
    return choose_view(o, scene);
}

static int choose_scene(struct stage *stage, const struct panel_options *o, struct panel_scene *scene)
{
    if (o->command != PANEL_RUN) {
        return choose_demo(o, "testcard", scene);
    }
    if (o->model == NULL) {
        return choose_demo(o, o->demo != NULL ? o->demo : "turntable", scene);
    }
    const int status = model_open(&stage->model, o->model, &o->model_options);
    if (status != 0) {
        return status;
    }
    if (stage->model->note != NULL) {
        complain_note("--model %s: %s", o->model, stage->model->note);
    }
    stage->model_demo = model_demo(stage->model);
    scene->demo = &stage->model_demo;
    scene->state = stage->model;
    return choose_view(o, scene);
}

static struct panel_scene plain_scene(const struct panel_options *o)
{
    return (struct panel_scene){.start = o->start,
                                .frames = o->frames,
                                .fps = o->fps,
                                .band = o->band,
                                .depth = o->depth,
                                .diff = o->diff,
                                .refresh = o->refresh,
                                .overlay = o->overlay,
                                .stats = o->stats,
                                .stop = &signal_stop};
}

static int show(struct stage *stage, const struct panel_options *o)
{
    struct panel_scene scene = plain_scene(o);
    int status = choose_kits(stage, o);
    if (status == 0) {
        status = choose_scene(stage, o, &scene);
    }
    if (status == 0) {
        status = panel_show_run(stage->displays, stage->count, &scene);
    }
    for (int i = 0; i < stage->count; i++) {
        panel_kit_release(&stage->kits[i]);
    }
    model_close(stage->model);
    return status;
}

/* ---- speedtest ---------------------------------------------------------------------------------- */

#define STEP_NS 1000000000u /* for each clock, where --frames does not say how many */

static const uint32_t steps_hz[] = {4000000,  8000000,  10000000, 15000000, 16000000, 20000000, 24000000,
                                    30000000, 32000000, 40000000, 48000000, 62500000, 80000000, 100000000};
#define STEPS (sizeof steps_hz / sizeof steps_hz[0])

struct speedtest {
    const struct panel_kit *kit;
    uint32_t most_hz, frames_a_step;
    unsigned step;  /* the next one */
    int32_t got_hz; /* now; 0: before the first step */
    uint32_t frames;
    uint64_t since_ns;
};

/* spidev does not tell the clock that the controller makes of the one that was asked for, so it is measured. */
static void print_step(const struct speedtest *t, const struct panel_display *d)
{
    const double seconds = (double)(panel_show_now_ns() - t->since_ns) / 1e9;
    const uint32_t limit = d->board->panel->controller->write_hz;
    if (t->got_hz == 0) {
        return;
    }
    printf("asked %9u Hz, ", (unsigned)steps_hz[t->step - 1]);
    if (t->kit->usb) {
        printf("got %9d Hz: ", (int)t->got_hz);
    } else {
        printf("measured %9u Hz or more: ", (unsigned)linux_hal_bits_per_second(&t->kit->linux));
    }
    printf("%6.1f frames/s%s\n", t->frames / seconds,
           (uint32_t)t->got_hz > limit ? ", above the datasheet's limit" : "");
    fflush(stdout);
}

/* Before a frame: switches to the next clock when it is time. */
static int next_clock(void *context, struct panel_display *d, uint32_t frame)
{
    struct speedtest *t = context;
    const bool over =
        t->frames_a_step != 0 ? t->frames >= t->frames_a_step : panel_show_now_ns() - t->since_ns >= STEP_NS;
    (void)frame;
    if (t->got_hz > 0 && !over) {
        t->frames++;
        return 0;
    }
    int status = runner_finish(&d->runner);
    if (status == 0) {
        print_step(t, d);
        if (t->step == STEPS || steps_hz[t->step] > t->most_hz) {
            return PANEL_SHOW_OVER;
        }
        status = panel_clock(&d->runner.driver, steps_hz[t->step++]);
        if (status == 0 && d->runner.driver.clock_hz == t->got_hz) {
            return PANEL_SHOW_OVER; /* there is no faster one */
        }
        t->got_hz = d->runner.driver.clock_hz;
    }
    if (status < 0) {
        return complain("%s: %s", d->board->name, panel_show_text(d, status));
    }
    t->frames = 1;
    t->since_ns = panel_show_now_ns();
    return 0;
}

static int speedtest(struct stage *stage, const struct panel_options *o)
{
    struct panel_scene scene = plain_scene(o);
    struct speedtest test = {.kit = &stage->kits[0],
                             .most_hz = o->kits[0].speed_hz != 0 ? o->kits[0].speed_hz : UINT32_MAX,
                             .frames_a_step = o->frames};
    scene.frames = 0;
    scene.before = next_clock;
    scene.before_context = &test;
    int status = choose_kits(stage, o);
    if (status == 0) {
        status = choose_scene(stage, o, &scene);
    }
    if (status == 0) {
        puts("The test card at one clock after the other: the last one that looks right is the display's.");
        status = panel_show_run(stage->displays, stage->count, &scene);
    }
    return status;
}

/* ---- report ------------------------------------------------------------------------------------- */

static void put_text(const char *text)
{
    fputs(text, stdout);
}

#define HOLD_MS 500 /* so often a picture that stands still wants panel_hold() */

/* The card stays until the user has seen it; a script does not look. */
static void wait_for_enter(struct panel_driver *driver)
{
    fflush(stdout);
    if (isatty(STDIN_FILENO) == 0) {
        return;
    }
    struct pollfd in = {.fd = STDIN_FILENO, .events = POLLIN};
    char byte = 0;
    fputs("Look at the test card, answer the last line, then press Enter.\n", stderr);
    while (byte != '\n') {
        const int typed = poll(&in, 1, HOLD_MS);
        if (typed < 0 || (typed > 0 && read(STDIN_FILENO, &byte, 1) != 1) || panel_hold(driver) < 0) {
            return;
        }
    }
}

static int report(struct stage *stage, const struct panel_options *o)
{
    struct panel_scene scene = plain_scene(o);
    char build[80];
    const struct self_test_machine machine = {
        .build = build, .facts = panel_facts, .context = &stage->kits[0], .why = kit_error};
    int status = choose_kits(stage, o);
    snprintf(build, sizeof build, "pinhole-panel for %s", stage->kits[0].board.name);
    scene.demo = demo_find("turntable");
    scene.overlay = scene.diff = false; /* every frame whole, and nothing over it */
    if (status == 0) {
        status = panel_show_report(&stage->displays[0], &scene, &machine, put_text, wait_for_enter);
    }
    for (int i = 0; i < stage->count; i++) {
        panel_kit_release(&stage->kits[i]);
    }
    return status;
}

/* ---- identify ----------------------------------------------------------------------------------- */

#define CARD_NS 3000000000u /* how long a card is shown if nothing is typed */

struct identify {
    struct stage *stage;
    const struct panel_options *o;
    struct demo card;
    uint64_t until_ns;
};

static bool is_typed(void)
{
    struct pollfd in = {.fd = STDIN_FILENO, .events = POLLIN};
    return poll(&in, 1, 0) != 0;
}

static int identify_board(void *context, const struct panel_wiring *w, struct board *board)
{
    struct identify *i = context;
    const int status = panel_kit_choose(&i->stage->kits[0], w);
    *board = i->stage->kits[0].board;
    return status;
}

/* Before a frame: the card was there, and something was typed, or the next one is due. */
static int next_card(void *context, struct panel_display *d, uint32_t frame)
{
    const struct identify *i = context;
    (void)d;
    return frame > i->o->start && (is_typed() || panel_show_now_ns() >= i->until_ns) ? PANEL_SHOW_OVER : 0;
}

static int identify_show(void *context, const struct panel_wiring *w, const char *number)
{
    struct identify *i = context;
    struct panel_options o = *i->o;
    struct panel_scene scene = plain_scene(&o);
    o.kits[0] = *w;
    int status = choose_kits(i->stage, &o);
    scene.demo = &i->card;
    scene.view = number;
    scene.frames = 0;
    scene.fps = 20;
    scene.before = next_card;
    scene.before_context = i;
    i->until_ns = panel_show_now_ns() + CARD_NS;
    if (status == 0) {
        status = panel_show_run(i->stage->displays, 1, &scene);
    }
    return status == 0 && signal_stop != 0 ? COMPLAINED : status;
}

/* A line of what was typed: its number. */
static int identify_typed(void *context)
{
    int number = 0;
    char byte = 0;
    (void)context;
    if (!is_typed()) {
        return 0;
    }
    while (read(STDIN_FILENO, &byte, 1) == 1) {
        if (byte == '\n') {
            return number;
        }
        number = byte >= '0' && byte <= '9' && number < 100 ? 10 * number + byte - '0' : 100;
    }
    return -1;
}

static int identify(struct stage *stage, const struct panel_options *o)
{
    struct identify i = {.stage = stage, .o = o, .card = panel_identify_card()};
    const struct panel_identify_user user = {identify_board, identify_show, identify_typed, &i};
    struct panel_wiring found = o->kits[0];
    struct board board;
    int status = panel_identify(&found, &user);
    status = status == 0 ? identify_board(&i, &found, &board) : status;
    if (status == 0) {
        panel_identify_print(stdout, &found, &board);
    }
    return status;
}

/* ---- probe and list ----------------------------------------------------------------------------- */

static void print_bytes(const char *command, const uint8_t bytes[PROBE_BYTES])
{
    printf("%s", command);
    for (int i = 0; i < PROBE_BYTES; i++) {
        printf(" %02X", bytes[i]);
    }
    printf("\n");
}

static int tell_controller(const struct board *board, const struct panel_answers *answers)
{
    const char *name = panel_probe_name(answers);
    print_bytes("04h RDDID:", answers->id);
    print_bytes("D3h RDID4:", answers->id4);
    if (name != NULL) {
        const bool same = strcmp(name, board->panel->controller->name) == 0;
        printf("controller: %s%s\n", name, same ? "" : ", but the board says otherwise: give --panel");
        return same ? 0 : COMPLAINED;
    }
    if (panel_probe_answered(answers)) {
        return complain("%s: a controller that is not known answers; its datasheet has these bytes", board->name);
    }
    return complain("%s: nothing answers: check power, chip select and the data line back (MISO); many "
                    "displays do not have it",
                    board->name);
}

static int probe(struct stage *stage, const struct panel_options *o)
{
    int status = choose_kits(stage, o);
    if (status != 0) {
        return status;
    }
    const struct panel_display *d = &stage->displays[0];
    const struct board *board = &stage->kits[0].board;
    const struct hal *hal = &stage->kits[0].hal;
    if (!board->pins.data_in.wired) {
        return complain("%s: this kit has no data line back (MISO): its display cannot be asked; try "
                        "`pinhole-panel testcard`",
                        board->name);
    }
    struct panel_answers answers;
    status = hal->ops->open(hal->context, board);
    if (status == 0) {
        status = panel_probe_read(hal, board, &answers);
        if (status < 0) {
            complain("%s: %s", board->name, panel_show_text(d, status));
        }
        hal->ops->close(hal->context);
        return status < 0 ? COMPLAINED : tell_controller(board, &answers);
    }
    return complain("%s: %s", board->name, panel_show_text(d, status));
}

static void list_kms(const char *name, uint32_t width, uint32_t height)
{
    if (width > 0) {
        printf("drm    %-22s %ux%u\n", name, (unsigned)width, (unsigned)height);
    } else {
        printf("drm    %-22s nothing is connected\n", name);
    }
}

static int list(void)
{
    for (uint32_t i = 0; i < board_count; i++) {
        const struct board *board = board_list[i];
        if (panel_kit_has(board)) {
            printf("board  %-22s %-20s %s\n", board->name, board->panel->name, board->title);
        }
    }
    for (uint32_t i = 0; i < panel_count; i++) {
        const struct panel *panel = panel_list[i];
        printf("panel  %-22s %-20s at most %.1f MHz\n", panel->name, panel->controller->name,
               panel->controller->write_hz / 1e6);
    }
    kms_card_list(list_kms);
    return 0;
}

/* ---- commands ----------------------------------------------------------------------------------- */

static int obey(struct stage *stage, const struct panel_options *o)
{
    switch (o->command) {
    case PANEL_HELP:
        panel_options_help();
        return 0;
    case PANEL_LIST:
        return list();
    case PANEL_DOCTOR:
        return panel_doctor(&stage->kits[0], o);
    case PANEL_PROBE:
        return probe(stage, o);
    case PANEL_SPEEDTEST:
        return speedtest(stage, o);
    case PANEL_REPORT:
        return report(stage, o);
    case PANEL_IDENTIFY:
        return identify(stage, o);
    default:
        return show(stage, o);
    }
}

int main(int argc, char *argv[])
{
    struct panel_options options;
    complain_begin("pinhole-panel", argc, argv);
    int status = panel_options_read(&options, argc, argv);
    if (status != 0) {
        return complain_exit(status);
    }
    struct stage *stage = calloc(1, sizeof *stage);
    if (stage == NULL) {
        return complain_exit(complain("not enough memory"));
    }
    signal_stop_catch();
    signal(SIGPIPE, SIG_IGN); /* a write to a closed pipe must fail, not end the program */
    status = obey(stage, &options);
    free(stage);
    if (signal_stop != 0) {
        return 128 + signal_stop;
    }
    return complain_exit(status);
}
