/*
 * pinhole-sim: draws demos and models on a simulated display kit and shows what its glass shows.
 * The options are in sim_options.c (--help).
 */
#define _XOPEN_SOURCE 700 /* isatty */

#include "complain.h"
#include "crc32.h"
#include "frame_check.h"
#include "frame_out.h"
#include "key_script.h"
#include "model.h"
#include "progress.h"
#include "signal_stop.h"
#include "sim_choose.h"
#include "sim_focus.h"
#include "sim_list.h"
#include "sim_show.h"
#include "sim_tell.h"
#include "sim_window.h"

#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define FRAME_LIMIT 1000000000u        /* the highest number of a frame is below */
#define SHORTEST_NS (1000000000u / 60) /* a window shows no more frames than most screens do */

/* The setup points into this, so that it lives as long as the run. */
struct chosen {
    struct sim_choice choice;
    struct model *model;
    struct asset asset; /* the model simplified, as an image of the board has it */
    struct demo model_demo;
};

#define KIT_RAM_MOST (1u << 20) /* a board with more has an operating system, and draws the file itself */

/* Takes the model as an image of the kit has it, with all its triangles also where they do not fit; or simplified to a
 * number of triangles; or as it is. */
static int choose_model(const struct sim_options *o, struct chosen *chosen, struct sim_player_setup *setup)
{
    struct asset_goal goal = o->goal;
    goal.model = o->model;
    goal.board = o->board != NULL ? setup->board : NULL;
    goal.turntable = o->view != NULL && strcmp(o->view, "turntable") == 0;
    const bool is_kit = goal.board != NULL && goal.board->scene_bytes < KIT_RAM_MOST;
    goal.fit = o->goal_set ? goal.fit : is_kit;
    const bool is_all = !goal.fit && goal.triangles == UINT32_MAX;
    setup->demo = &chosen->model_demo;
    setup->state = chosen->model;
    setup->file = o->model;
    setup->cure = chosen->model->scene != NULL ? "make it by pinhole-asset --max-triangles fit for this --board"
                                               : "leave --max-triangles out, or say --max-triangles fit";
    chosen->model_demo = model_demo(chosen->model);
    if (chosen->model->scene != NULL || (is_all && !is_kit)) {
        return 0;
    }
    const int status =
        is_all ? asset_fit_make(&chosen->asset, chosen->model, &goal) : asset_fit(&chosen->asset, chosen->model, &goal);
    if (status == 0) {
        chosen->model_demo = asset_demo(&chosen->asset);
        chosen->model_demo.views = model_demo(&chosen->asset.model).views;
        setup->state = &chosen->asset.model;
    }
    return status;
}

static int choose_scene(const struct sim_options *o, struct chosen *chosen, struct sim_player_setup *setup)
{
    if (o->model == NULL) {
        return sim_choose_demo(o, setup);
    }
    int status = model_open(&chosen->model, o->model, &o->model_options);
    if (status != 0) {
        return status;
    }
    if (chosen->model->note != NULL) {
        complain_note("--model %s: %s", o->model, chosen->model->note);
    }
    status = model_play(chosen->model, o->clip);
    if (status == 0) {
        status = choose_model(o, chosen, setup);
    }
    return status == 0 ? sim_choose_view(o, setup) : status;
}

static int choose(const struct sim_options *o, struct chosen *chosen, struct sim_player_setup *setup)
{
    const int status = sim_choose_kit(o, &chosen->choice, setup);
    return status != 0 ? status : choose_scene(o, chosen, setup);
}

/* Lines about the frames go to stderr if the frames go to stdout. */
static FILE *report_file(const struct frame_out *out)
{
    return out->kind == FRAME_OUT_STREAM ? stderr : stdout;
}

/* Where the frames go, what they are compared with, and where the buttons come from. */
struct stage {
    struct sim_player_setup *setup;
    struct chosen *chosen;
    struct frame_out out;
    struct frame_check check;
    struct key_script keys;
    struct sim_window *window; /* NULL: none asked for */
    char title[160];           /* of the window, as it is shown */
    bool paused;
    uint64_t held_us; /* how long it was, before the frame that comes */
};

static void print_crc(FILE *file, const struct sim_options *o, uint32_t frame, const struct ppm *picture)
{
    const uint32_t crc = crc32_update(0, picture->rgb, (size_t)picture->width * picture->height * 3);
    fprintf(file, o->json ? "{\"frame\": %u, \"crc32\": \"%08X\"}\n" : "frame %u crc32 %08X\n", (unsigned)frame,
            (unsigned)crc);
}

static int show_frame(const struct sim_options *o, struct stage *stage, struct sim_player *p, uint32_t frame)
{
    struct frame_out *const out = &stage->out;
    int status = sim_tell_ride(o, p, frame);
    if (status == 0) {
        status = sim_player_frame(p, frame);
    }
    if (status == 0) {
        status = frame_out_put(out, frame, &p->picture);
    }
    if (status == 0) {
        status = frame_check_put(&stage->check, frame, &p->picture);
    }
    if (status == 0 && o->crc) {
        print_crc(report_file(out), o, frame, &p->picture);
    }
    if (status == 0 && o->stats) {
        (o->json ? sim_player_print_json : sim_player_print_stats)(p, frame);
    }
    return status;
}

/* Gives a glass without a kit the size of the window, and the camera its aspect. */
static int follow(const struct sim_options *o, struct stage *stage, struct sim_player *p, uint16_t width,
                  uint16_t height)
{
    const struct demo_context before = p->runner.context;
    int status = sim_player_close(p);
    *p = (struct sim_player){.sim = NULL};
    sim_virtual(&stage->chosen->choice.virtual_board, width, height);
    if (status == 0) {
        status = sim_choose_camera(o, stage->setup, &stage->setup->camera, &stage->chosen->choice.writing);
    }
    if (status == 0) {
        status = sim_player_open(p, stage->setup);
    }
    sim_player_move(p, before.orbit, before.tilt, before.dolly);
    return status == 0 ? sim_window_resize(stage->window, width, height) : status;
}

static uint64_t now_us(void)
{
    struct timespec now = {.tv_sec = 0};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000 + (uint64_t)now.tv_nsec / 1000;
}

/* Shows the demo's name, the kit's, and whether time stands still. */
static void name_window(struct stage *stage, const struct sim_player *p)
{
    char title[sizeof stage->title];
    const char *const name = stage->setup->file != NULL ? stage->setup->file : p->runner.demo->name;
    snprintf(title, sizeof title, "%s - %s%s", name, stage->setup->board->title, stage->paused ? " - paused" : "");
    if (strcmp(title, stage->title) != 0) {
        memcpy(stage->title, title, sizeof title);
        sim_window_title(stage->window, title);
    }
}

/* Saves the picture that the window shows, in the folder where the program runs. A full disk does not end it. */
static void save_picture(const struct sim_options *o, const struct sim_player *p, uint32_t frame)
{
    char name[80];
    struct frame_out out = {.scale = o->scale};
    snprintf(name, sizeof name, "pinhole-%s-%04u.png", p->runner.demo->name, (unsigned)frame);
    int status = frame_out_open(&out, name, false, frame);
    if (status == 0) {
        status = frame_out_close(&out, frame_out_put(&out, frame, &p->picture));
    }
    if (status == 0) {
        complain_note("%s is saved", name);
    }
}

/* Reads the window, again and again while it is paused. False: it was closed. */
static bool read_window(const struct sim_options *o, struct stage *stage, const struct sim_player *p, uint32_t frame,
                        struct sim_window_input *input)
{
    const uint64_t from_us = now_us();
    bool stays = true;
    do {
        name_window(stage, p);
        if (!sim_window_input(stage->window, input)) {
            return false;
        }
        if (input->save) {
            save_picture(o, p, frame > o->start ? frame - 1 : frame);
        }
        stage->paused = input->step || stage->paused != input->pause;
        stays = stage->paused && !input->step && signal_stop == 0;
        if (stays) {
            sim_window_show(stage->window, p->picture.rgb, SHORTEST_NS);
        }
    } while (stays);
    stage->held_us = now_us() - from_us;
    return true;
}

/* Sets the kit's buttons from script and keyboard, and moves the camera by the mouse. 0, COMPLAINED, or WINDOW_CLOSED.
 */
#define WINDOW_CLOSED 1
static int press(const struct sim_options *o, struct stage *stage, struct sim_player *p, uint32_t frame)
{
    struct sim_window_input input = {.buttons = 0};
    if (stage->window != NULL) {
        if (!read_window(o, stage, p, frame, &input)) {
            return WINDOW_CLOSED;
        }
        if (o->antialias) {
            input.width = input.width < SIM_ANTIALIAS_MAX ? input.width : SIM_ANTIALIAS_MAX;
            input.height = input.height < SIM_ANTIALIAS_MAX ? input.height : SIM_ANTIALIAS_MAX;
        }
        const bool follows = o->board == NULL && o->out == NULL && o->check == NULL;
        if (follows && (input.width != p->picture.width || input.height != p->picture.height)) {
            const int status = follow(o, stage, p, input.width, input.height);
            if (status != 0) {
                return status;
            }
        }
        sim_player_drag(p, input.drag, input.lift, input.notches);
    }
    sim_buttons_set(p->sim, input.buttons | key_script_at(&stage->keys, frame));
    return 0;
}

static int run_frames(const struct sim_options *o, struct stage *stage, struct sim_player *p)
{
    const bool drawn =
        o->out != NULL || o->crc || o->stats || o->check != NULL || o->show_window; /* --matrix alone draws none */
    const bool listed = o->stats || (o->crc && (stage->out.kind == FRAME_OUT_STREAM || isatty(STDOUT_FILENO)));
    sim_focus_set(o->focus, o->focus_strength);
    const bool bar = drawn && !listed && !o->show_window; /* lines about frames where the bar would be tell enough */
    int status = o->matrix || o->point_set || o->frustum_z != 0
                     ? sim_tell_cameras(o, report_file(&stage->out), p, stage->chosen->choice.writing)
                     : 0;
    uint64_t before_us = now_us();
    sim_show_depth(o->show != NULL); /* model files are framed by pictures, before */
    for (uint32_t i = 0; drawn && i < o->frames && status == 0 && signal_stop == 0; i++) {
        const uint64_t us = now_us();
        runner_pass(&p->runner, (uint32_t)(us - before_us));
        before_us = us;
        status = press(o, stage, p, o->start + i);
        if (status != 0 || signal_stop != 0) {
            break;
        }
        before_us += stage->held_us; /* a clip waits, too */
        if (bar) {
            progress_show("frames", i, o->frames);
        }
        status = show_frame(o, stage, p, o->start + i);
        if (status == 0 && stage->window != NULL) {
            const uint64_t ns = sim_player_bus_ns(p);
            sim_window_show(stage->window, p->picture.rgb, ns > SHORTEST_NS ? ns : SHORTEST_NS);
        }
    }
    if (bar) {
        progress_show("frames", 1, 1);
    }
    return status == WINDOW_CLOSED ? 0 : status;
}

static int run(const struct sim_options *o, struct chosen *chosen, struct sim_player_setup *setup)
{
    struct stage stage = {.setup = setup,
                          .chosen = chosen,
                          .out = {.scale = o->scale},
                          .check = {.reference = o->check,
                                    .difference = o->difference != NULL ? o->difference : "difference.png",
                                    .tolerance = o->tolerance,
                                    .scale = o->scale,
                                    .several = o->frames > 1}};
    struct sim_player player;
    const uint32_t more = o->frames == UINT32_MAX ? FRAME_LIMIT : o->frames - 1; /* behind the highest comes frame 0 */
    const uint32_t last = more < UINT32_MAX - o->start ? o->start + more : UINT32_MAX;
    int status = key_script_read(&stage.keys, o->keys);
    if (status == 0) {
        status = frame_check_open(&stage.check, last);
    }
    if (status == 0) {
        status = frame_out_open(&stage.out, o->out, o->frames > 1, last);
    }
    if (status != 0) {
        key_script_free(&stage.keys);
        return frame_check_close(&stage.check, status);
    }
    status = sim_player_open(&player, setup);
    if (status == 0 && o->stats && sim_note(player.sim) != NULL) {
        fprintf(stderr, "note: %s\n", sim_note(player.sim));
    }
    if (status == 0 && o->show_window) {
        status = sim_window_open(&stage.window, setup->board->title, player.picture.width, player.picture.height);
    }
    if (status == 0) {
        status = run_frames(o, &stage, &player);
    }
    sim_window_close(stage.window);
    key_script_free(&stage.keys);
    const int closed = sim_player_close(&player);
    const bool is_recording = stage.out.kind == FRAME_OUT_GIF && o->show_window; /* a signal is how one ends it */
    status = frame_out_close(&stage.out, status != 0                         ? status
                                         : signal_stop != 0 && !is_recording ? COMPLAINED
                                                                             : closed);
    return frame_check_close(&stage.check, status);
}

static int draw(const struct sim_options *o)
{
    struct chosen chosen = {.model = NULL, .choice.writing.convention = (enum ph_convention)o->convention};
    struct sim_player_setup setup = {.board = NULL};
    int status = choose(o, &chosen, &setup);
    if (status == 0) {
        signal_stop_catch();
        status = run(o, &chosen, &setup);
    }
    asset_free(&chosen.asset);
    model_close(chosen.model);
    if (signal_stop != 0) { /* end by the signal, so that a loop of a shell ends, too */
        signal(signal_stop, SIG_DFL);
        raise(signal_stop);
    }
    return status;
}

int main(int argc, char *argv[])
{
    struct sim_options options;
    complain_begin("pinhole-sim", argc, argv);
    int status = sim_options_read(&options, argc, argv);
    if (status != 0) {
        return complain_exit(status);
    }
    if (options.action == OPTION_HELP) {
        sim_options_help();
    } else if (options.action == OPTION_LIST) {
        (options.json ? sim_list_print_json : sim_list_print)();
    } else if (options.out != NULL && strcmp(options.out, "-") == 0 && isatty(STDOUT_FILENO)) {
        status = complain_usage("--out -: stdout is a terminal; pipe it into a program, or use --out FILE.ppm");
    } else {
        status = draw(&options);
    }
    return complain_exit(status);
}
