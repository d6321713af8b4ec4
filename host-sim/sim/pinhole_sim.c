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
#include "nearest.h"
#include "progress.h"
#include "signal_stop.h"
#include "sim_list.h"
#include "sim_options.h"
#include "sim_player.h"
#include "sim_show.h"
#include "sim_tell.h"
#include "sim_window.h"
#include "sim_wrong.h"

#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define DEFAULT_DEMO "turntable"
#define DEFAULT_SIDE 240 /* pixels of the plain square panel that is used when no kit is named */

#define ANTIALIAS_SIDE_MAX 512u /* pixels: see struct ph_config */

#define FRAME_LIMIT 1000000000u        /* the highest number of a frame is below */
#define SHORTEST_NS (1000000000u / 60) /* a window shows no more frames than most screens do */

static int choose_board(const struct sim_options *o, struct sim_virtual *virtual_board, const struct board **board)
{
    if (o->board != NULL) {
        *board = board_find(o->board);
        return *board != NULL ? 0
                              : complain_usage("--board '%s': no such board; %s--list shows them", o->board,
                                               nearest_text(o->board, nearest_board, NULL));
    }
    const uint16_t width = o->width != 0 ? o->width : DEFAULT_SIDE;
    const uint16_t height = o->width != 0 ? o->height : DEFAULT_SIDE;
    sim_virtual(virtual_board, width, height);
    *board = &virtual_board->board;
    return 0;
}

/* Writes the camera down in the convention, with its handedness and its near and far plane, and reads it back from
 * there: the camera that is drawn has gone through the convention. 0 or PH_ERR_INVAL. */
static int through_convention(enum ph_convention convention, struct demo_camera *camera)
{
    fx_t near_z = camera->projection_set ? camera->projection.near_z : FX_ONE;
    fx_t far_z = camera->projection_set ? camera->projection.far_z : FX_INT(2);
    if (convention == PH_LMU) {
        near_z = fx_neg_sat(near_z);
        far_z = fx_neg_sat(far_z);
    }
    if (convention == PH_D3D) { /* its matrix, but in Q2.30, where nothing is rounded */
        for (int j = 0; j < 3; j++) {
            camera->view.r[2][j] = fx_neg_sat(camera->view.r[2][j]);
        }
        camera->view.t.z = fx_neg_sat(camera->view.t.z);
    }
    const int status = ph_camera_from(convention, &camera->view, &near_z, &far_z);
    camera->projection.near_z = near_z;
    camera->projection.far_z = far_z;
    return status;
}

static struct sim_matrix in_doubles(const struct ph_mat4 *from)
{
    struct sim_matrix m;
    for (int i = 0; i < 16; i++) {
        m.m[i / 4][i % 4] = from->m[i / 4][i % 4] / (double)FX_ONE;
    }
    return m;
}

/* Makes *camera draw what the two matrices draw. */
static int draw_anyway(const struct sim_options *o, struct demo_camera *camera)
{
    const enum ph_convention convention = (enum ph_convention)o->convention;
    struct sim_matrix view = o->view_matrix, lens = o->lens_matrix;
    struct ph_mat4 own;
    if (!o->view_matrix_set) {
        if (!o->camera.set) {
            return complain_usage("--anyway: which view? give --camera or --view-matrix");
        }
        own = ph_matrix_view(&camera->view, convention);
        view = in_doubles(&own);
    }
    if (!o->lens_matrix_set) {
        if (ph_matrix_projection(&own, &camera->projection, convention) != 0) {
            return complain_usage("--anyway: this lens has no matrix; choose another --projection");
        }
        lens = in_doubles(&own);
    }
    const int status = sim_wrong_camera(&view, &lens, convention, &camera->view, &camera->projection);
    if (status == 1) {
        complain_note("--anyway: nothing is visible: its w or its depth is nowhere in the view volume");
        camera->projection.near_z = FX_MAX - FX_ONE;
        camera->projection.far_z = FX_MAX;
        camera->projection.kind = PH_PERSPECTIVE;
    }
    return status >= 0 ? 0 : complain_usage("--anyway: the camera that draws so does not fit fixed point");
}

/* Says what is wrong with a matrix of the options, and refuses it unless it is drawn --anyway. */
static int tell_wrong(const struct sim_options *o, bool is_view)
{
    const enum ph_convention convention = (enum ph_convention)o->convention;
    const char *const option = is_view ? "view-matrix" : "projection-matrix";
    char why[SIM_WRONG_TEXT];
    (is_view ? sim_wrong_view : sim_wrong_lens)(is_view ? &o->view_matrix : &o->lens_matrix, convention, why);
    if (!o->anyway) {
        return complain_usage("--%s: %s; --anyway draws it", option, why);
    }
    complain_note("--%s: %s", option, why);
    return 0;
}

/* Gets the view of the options. *wrong: it is no view, and --anyway may draw it. */
static void choose_view_of(const struct sim_options *o, struct ph_xform *view, bool *left_world, bool *wrong)
{
    *left_world = false;
    *wrong = o->view_matrix_set &&
             sim_matrix_view(&o->view_matrix, (enum ph_convention)o->convention, view, left_world) != 0;
    if (o->focal < 0 && !*wrong) { /* behind the hole the image is upside down */
        const struct ph_xform half_turn = ph_xform_rotate_z(0x80000000u);
        *view = ph_xform_mul(&half_turn, view);
    }
}

/* Says what is wrong with a lens that is no matrix. */
static int refuse_lens(const struct sim_options *o)
{
    return o->near_z <= 0 || o->far_z <= o->near_z
               ? complain_usage("--near, --far: near must be more than 0, and far more than near%s",
                                o->near_z < 0 ? "; below 0 they are in --convention lmu" : "")
               : complain_usage("--projection, --fov: no such view volume; left and right, bottom and top must differ, "
                                "and near, far and the angle be less extreme");
}

/* Chooses the camera, and how its matrices are written. */
static int choose_camera(const struct sim_options *o, const struct sim_player_setup *setup, struct demo_camera *camera,
                         struct sim_matrix_writing *writing)
{
    const struct panel *panel = setup->board->panel;
    const enum ph_convention convention = (enum ph_convention)o->convention;
    /* A demo's own near and far planes fit its own view only. */
    const bool view_set = o->camera.set || o->view_matrix_set;
    const bool lens_set = o->projection_set || o->lens_matrix_set || view_set;
    bool wrong_view, wrong_lens;
    int status = 0;
    *camera = (struct demo_camera){.view = o->camera.view, .view_set = view_set, .projection_set = lens_set};
    choose_view_of(o, &camera->view, &writing->left_world, &wrong_view);
    if (lens_set) {
        status = sim_options_projection(o, panel_width(panel, setup->rotation), panel_height(panel, setup->rotation),
                                        &camera->projection);
    }
    wrong_lens = o->lens_matrix_set && (status != 0 || camera->projection.near_z <= 0);
    if (wrong_view || wrong_lens) {
        status = status != 0 && !wrong_lens ? refuse_lens(o) : o->anyway ? draw_anyway(o, camera) : 0;
        status = status == 0 && wrong_view ? tell_wrong(o, true) : status;
        return status == 0 && wrong_lens ? tell_wrong(o, false) : status;
    }
    const fx_t off_x = fx_abs_sat(camera->projection.shift_x), off_y = fx_abs_sat(camera->projection.shift_y);
    if (status == 0 && lens_set && (off_x > 2 * FX_ONE || off_y > 2 * FX_ONE)) {
        return complain_usage("--projection: the window lies more than its own size off the middle");
    }
    status = status == 0 ? through_convention(convention, camera) : status;
    return status == 0 ? 0 : refuse_lens(o);
}

/* The setup points into this, so that it lives as long as the run. */
struct chosen {
    struct sim_virtual virtual_board;
    struct model *model;
    struct asset asset; /* the model simplified, as an image of the board has it */
    struct demo model_demo;
    struct sim_matrix_writing writing;
};

static int choose_view(const struct sim_options *o, struct sim_player_setup *setup)
{
    char names[200];
    setup->view = o->view;
    if (o->view == NULL || demo_has_view(setup->demo, o->view)) {
        return 0;
    }
    sim_list_views(setup->demo, names, sizeof names);
    return complain_usage("--view '%s': %s has %s%s", o->view, setup->demo->name,
                          names[0] != '\0' ? "the views" : "but one view", names);
}

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
        const char *name = o->demo != NULL ? o->demo : DEFAULT_DEMO;
        setup->demo = demo_find(name);
        return setup->demo != NULL ? choose_view(o, setup)
                                   : complain_usage("--demo '%s': no such demo; %s--list shows them", name,
                                                    nearest_text(name, nearest_demo, NULL));
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
    return status == 0 ? choose_view(o, setup) : status;
}

static int choose(const struct sim_options *o, struct chosen *chosen, struct sim_player_setup *setup)
{
    int status = choose_board(o, &chosen->virtual_board, &setup->board);
    if (status != 0) {
        return status;
    }
    setup->rotation = o->rotate_set ? o->rotate : setup->board->rotation;
    setup->band_height = o->band != 0 ? o->band : setup->board->band_height;
    setup->depth = o->depth;
    setup->overlay = o->overlay;
    setup->clip_fps = o->clip_fps == 0 && o->frames == UINT32_MAX ? DEMO_CLIPS_BY_CLOCK : (uint16_t)o->clip_fps;
    setup->antialias = o->antialias;
    setup->dither = o->dither;
    const unsigned width = panel_width(setup->board->panel, setup->rotation);
    const unsigned height = panel_height(setup->board->panel, setup->rotation);
    if (o->antialias && (width > ANTIALIAS_SIDE_MAX || height > ANTIALIAS_SIDE_MAX)) {
        return complain_usage("--aa: pictures of at most %ux%u pixels, not %ux%u", ANTIALIAS_SIDE_MAX,
                              ANTIALIAS_SIDE_MAX, width, height);
    }
    status = choose_camera(o, setup, &setup->camera, &chosen->writing);
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
    sim_virtual(&stage->chosen->virtual_board, width, height);
    if (status == 0) {
        status = choose_camera(o, stage->setup, &stage->setup->camera, &stage->chosen->writing);
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
            input.width = input.width < ANTIALIAS_SIDE_MAX ? input.width : ANTIALIAS_SIDE_MAX;
            input.height = input.height < ANTIALIAS_SIDE_MAX ? input.height : ANTIALIAS_SIDE_MAX;
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
    const bool bar = drawn && !listed && !o->show_window; /* lines about frames where the bar would be tell enough */
    int status = o->matrix || o->point_set || o->frustum_z != 0
                     ? sim_tell_cameras(o, report_file(&stage->out), p, stage->chosen->writing)
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
    struct chosen chosen = {.model = NULL, .writing = {.convention = (enum ph_convention)o->convention}};
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
