/* demo_scene: what the demos share. The demos themselves are found through demo_list (demo.h). */
#ifndef DEMO_SCENE_H
#define DEMO_SCENE_H

#include "demo.h"

extern const struct demo demo_turntable, demo_testcard, demo_torus, demo_cube, demo_fill, demo_icosphere, demo_ground,
    demo_wireframe;

/*
 * A perspective with 60 degrees across the smaller side of the picture (so vertically for square and landscape ones);
 * the larger side sees in proportion more. scale_q20 = 1 / tan(30 degrees) in Q12.20; other angles likewise.
 */
#define DEMO_SCALE_60_Q20 1816187
struct ph_projection demo_perspective(const struct demo_context *context, int32_t scale_q20, fx_t near_z, fx_t far_z);

/*
 * The camera that sees all of what turns about the vertical axis through `centre` (which becomes the origin) from 20
 * degrees above, just so, at 40 degrees across the smaller side. Also how far that reaches from the axis and downwards.
 */
struct demo_fit {
    struct ph_xform view;
    struct ph_projection projection;
    fx_t radius, bottom;
};

struct demo_fit demo_fit(const struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                         struct fx_vec3 centre);

/* ph_frame_begin with the user's camera where there is one, with the demo's otherwise. */
int demo_begin(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
               const struct ph_projection *projection, const struct ph_scene_light *light, uint16_t background);

#endif
