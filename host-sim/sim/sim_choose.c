/* See sim_choose.h. */
#include "sim_choose.h"

#include "complain.h"
#include "nearest.h"
#include "sim_list.h"
#include "sim_wrong.h"

#define DEFAULT_DEMO "turntable"
#define DEFAULT_SIDE 240 /* pixels of the plain square panel that is used when no kit is named */

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

int sim_choose_camera(const struct sim_options *o, const struct sim_player_setup *setup, struct demo_camera *camera,
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

int sim_choose_kit(const struct sim_options *o, struct sim_choice *choice, struct sim_player_setup *setup)
{
    const int status = choose_board(o, &choice->virtual_board, &setup->board);
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
    if (o->antialias && (width > SIM_ANTIALIAS_MAX || height > SIM_ANTIALIAS_MAX)) {
        return complain_usage("--aa: pictures of at most %ux%u pixels, not %ux%u", SIM_ANTIALIAS_MAX, SIM_ANTIALIAS_MAX,
                              width, height);
    }
    return sim_choose_camera(o, setup, &setup->camera, &choice->writing);
}

int sim_choose_view(const struct sim_options *o, struct sim_player_setup *setup)
{
    char names[200];
    setup->view = o->view;
    if (o->focus != 0 && setup->demo->blur_radius == 0) {
        return complain_usage("--focus: %s has no depth of field; --demo focus has", setup->demo->name);
    }
    if (o->view == NULL || demo_has_view(setup->demo, o->view)) {
        return 0;
    }
    sim_list_views(setup->demo, names, sizeof names);
    return complain_usage("--view '%s': %s has %s%s", o->view, setup->demo->name,
                          names[0] != '\0' ? "the views" : "but one view", names);
}

int sim_choose_demo(const struct sim_options *o, struct sim_player_setup *setup)
{
    const char *name = o->demo != NULL ? o->demo : DEFAULT_DEMO;
    setup->demo = demo_find(name);
    return setup->demo != NULL ? sim_choose_view(o, setup)
                               : complain_usage("--demo '%s': no such demo; %s--list shows them", name,
                                                nearest_text(name, nearest_demo, NULL));
}
