/*
 * sim_cameras: all the cameras of a demo's frame, and where one of its meshes is. ph_frame_begin, ph_frame_camera and
 * ph_draw_mesh are replaced at link time by recorders (see the Makefile).
 */
#ifndef SIM_CAMERAS_H
#define SIM_CAMERAS_H

#include "render.h"

#define SIM_CAMERAS_MAX 8 /* those beyond are drawn and not recorded */

struct sim_cameras {
    uint32_t count;
    struct sim_camera {
        struct ph_xform view;
        struct ph_projection projection;
    } cameras[SIM_CAMERAS_MAX];
    uint32_t meshes;                 /* that were drawn, or found to be outside of the picture */
    uint32_t parent;                 /* set by the caller: the number of a mesh, from 0 */
    struct ph_xform parent_to_world; /* of that mesh, if there are more than `parent` */
};

/* From now on *to has the cameras and meshes of the frame that was begun last, each camera once; NULL: nothing is
 * recorded. */
void sim_cameras_record(struct sim_cameras *to);

int sim_cameras_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                            const struct ph_scene_light *light, uint16_t background);
int sim_cameras_frame_camera(struct ph_renderer *r, const struct ph_xform *view,
                             const struct ph_projection *projection);
int sim_cameras_draw_mesh(struct ph_renderer *r, const struct ph_mesh *mesh, const struct ph_xform *to_world);

#endif
