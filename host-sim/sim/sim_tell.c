/* See sim_tell.h. */
#include "sim_tell.h"

#include "complain.h"
#include "sim_cameras.h"
#include "sim_factors.h"
#include "sim_focus.h"
#include "sim_frustum.h"
#include "sim_point.h"

/* Prints the depth of field, and the blur at the distance of --frustum and at the point. */
static void print_focus(const struct sim_options *o, FILE *file, const struct sim_focus *focus,
                        const struct sim_camera *camera, const struct ph_projection *lens, uint16_t height)
{
    if (o->point_set || o->frustum_z != 0) {
        sim_focus_print(file, focus, lens, height);
    }
    if (o->frustum_z != 0) {
        sim_focus_print_blur(file, "size.blur", focus, lens, sim_fraction_of(o->frustum_z, 16));
    }
    if (o->point_set) {
        sim_focus_print_blur(file, "blur", focus, lens, sim_point_away(o->point, &o->object, &camera->view));
    }
}

/* Prints the matrices of one camera, and the point as it sees it. focus: NULL if there is no depth of field. */
static int print_camera(const struct sim_options *o, FILE *file, const struct sim_player *p,
                        const struct sim_camera *camera, const struct sim_focus *focus,
                        struct sim_matrix_writing writing)
{
    const struct demo_camera *const user = &p->runner.context.camera; /* a demo may make its own of it */
    const struct ph_projection *const lens = user->projection_set ? &user->projection : &camera->projection;
    const uint16_t width = p->runner.driver.width, height = p->runner.driver.height;
    const struct ph_mat4 object = ph_mat4_xform(&o->object);
    int status = 0;
    if (o->matrix && o->object_set) {
        sim_matrix_print_one(file, "object", &object);
    }
    if (o->matrix) {
        status = sim_matrix_print(file, &camera->view, lens, width, height, writing);
    }
    if (status == 0 && o->factors) {
        sim_factors_print(file, &camera->view, lens, writing);
    }
    if (status == 0 && o->matrix && o->flatten != NULL) {
        sim_matrix_print_one(file, "flatten", &o->flat);
    }
    if (status == 0 && o->frustum_z != 0) {
        status = sim_frustum_print(file, lens, o->frustum_z, o->frustum_height);
    }
    if (status == 0 && o->point_set) {
        status = sim_point_print(file, o->point, &o->object, &camera->view, lens, width, height, writing);
    }
    if (status == 0 && o->point_set && o->flatten != NULL) {
        sim_point_flatten(file, o->point, &o->object, &camera->view, &o->flat, writing);
    }
    if (status == 0 && focus != NULL) {
        print_focus(o, file, focus, camera, lens, height);
    }
    if (status == PH_ERR_RANGE && lens->kind == PH_FISHEYE) {
        return complain_usage("--point: the fisheye does not see it: it is nearer than near, beyond far, more than 170 "
                              "degrees off the view direction, or over 2048 pixels off the centre");
    }
    if (status == PH_ERR_RANGE) {
        return complain_usage(o->point_set ? "--point: a number does not fit, or w is 0: the point lies beside the eye"
                                           : "--matrix: an element does not fit Q16.16; move --near and --far apart");
    }
    return status == 0 ? 0
                       : complain_usage("--matrix, --frustum: this demo's camera has no matrix; give a --projection");
}

int sim_tell_cameras(const struct sim_options *o, FILE *file, struct sim_player *p, struct sim_matrix_writing writing)
{
    struct sim_cameras seen = {.count = 0};
    struct sim_focus focus;
    int status = sim_tell_ride(o, p, o->start);
    if (status == 0) {
        sim_cameras_record(&seen);
        status = sim_player_scene(p, o->start);
        sim_cameras_record(NULL);
    }
    const bool has_focus = status == 0 && sim_focus_find(&focus, p);
    for (uint32_t i = 0; i < seen.count && status == 0; i++) {
        if (seen.count > 1) {
            fprintf(file, "camera %u of %u\n", (unsigned)i + 1, (unsigned)seen.count);
        }
        status = print_camera(o, file, p, &seen.cameras[i], has_focus ? &focus : NULL, writing);
    }
    return status;
}

int sim_tell_ride(const struct sim_options *o, struct sim_player *p, uint32_t frame)
{
    struct sim_cameras seen = {.parent = o->parent};
    if (!o->parent_set) {
        return 0;
    }
    sim_cameras_record(&seen);
    const int status = sim_player_scene(p, frame);
    sim_cameras_record(NULL);
    if (status == 0 && seen.meshes <= o->parent) {
        return complain_usage("--parent %u: frame %u has %u meshes, and the first is number 0", (unsigned)o->parent,
                              (unsigned)frame, (unsigned)seen.meshes);
    }
    const struct ph_xform to_parent = ph_view_of_node(&seen.parent_to_world);
    p->runner.context.camera.view = ph_xform_mul(&p->setup.camera.view, &to_parent);
    return status;
}
