/* See sim_cameras.h. */
#include "sim_cameras.h"

#include <string.h>

/* The linker's names for the functions themselves, where the recorders stand for them. */
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
int __real_ph_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                          const struct ph_scene_light *light, uint16_t background);
int __real_ph_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection);
int __real_ph_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

static struct sim_cameras *recording;

void sim_cameras_record(struct sim_cameras *to)
{
    recording = to;
}

static bool is_same(const struct sim_camera *a, const struct ph_xform *view, const struct ph_projection *projection)
{
    const struct ph_projection *const p = &a->projection;
    return memcmp(&a->view, view, sizeof *view) == 0 && p->kind == projection->kind &&
           p->scale_x_q20 == projection->scale_x_q20 && p->scale_y_q20 == projection->scale_y_q20 &&
           p->shift_x == projection->shift_x && p->shift_y == projection->shift_y && p->near_z == projection->near_z &&
           p->far_z == projection->far_z;
}

static void record(const struct ph_xform *view, const struct ph_projection *projection)
{
    bool known = recording == NULL || recording->count == SIM_CAMERAS_MAX;
    for (uint32_t i = 0; !known && i < recording->count; i++) {
        known = is_same(&recording->cameras[i], view, projection);
    }
    if (!known) {
        recording->cameras[recording->count++] = (struct sim_camera){*view, *projection};
    }
}

int sim_cameras_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                            const struct ph_scene_light *light, uint16_t background)
{
    const int status = __real_ph_frame_begin(r, view, projection, light, background);
    if (status == PH_OK && recording != NULL) {
        recording->count = recording->meshes = 0;
        record(view, projection);
    }
    return status;
}

int sim_cameras_frame_camera(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection)
{
    const int status = __real_ph_frame_camera(r, view, projection);
    if (status == PH_OK) {
        record(view, projection);
    }
    return status;
}

int sim_cameras_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world)
{
    const int status = __real_ph_draw_mesh(r, mesh, to_world);
    if (status == PH_OK && recording != NULL) {
        recording->parent_to_world = recording->meshes == recording->parent ? *to_world : recording->parent_to_world;
        recording->meshes++;
    }
    return status;
}
