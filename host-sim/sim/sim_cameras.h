/*
 * sim_cameras: all the cameras of a demo's frame. ph_frame_begin and ph_frame_camera are replaced at link time by
 * recorders (see the Makefile).
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
};

/* From now on *to has the cameras of the frame that was begun last, each one once; NULL: nothing is recorded. */
void sim_cameras_record(struct sim_cameras *to);

int sim_cameras_frame_begin(struct ph_renderer *r, const struct ph_xform *view, const struct ph_projection *projection,
                            const struct ph_scene_light *light, uint16_t background);
int sim_cameras_frame_camera(struct ph_renderer *r, const struct ph_xform *view,
                             const struct ph_projection *projection);

#endif
