#include "demo_scene.h"

#include <string.h>

const struct demo *const demo_list[] = {
    &demo_turntable, &demo_testcard,  &demo_torus,   &demo_cube,  &demo_fill,        &demo_icosphere,
    &demo_ground,    &demo_wireframe, &demo_solar,   &demo_snake, &demo_ball,        &demo_hitchcock,
    &demo_parallel,  &demo_shadow,    &demo_fisheye, &demo_focus, &demo_conventions, &demo_zfight,
};
const uint32_t demo_count = sizeof(demo_list) / sizeof(demo_list[0]);

const struct demo *demo_find(const char *name)
{
    for (uint32_t i = 0; i < demo_count; i++) {
        if (strcmp(demo_list[i]->name, name) == 0) {
            return demo_list[i];
        }
    }
    return NULL;
}

void *demo_alloc(struct demo_arena *arena, size_t n)
{
    const size_t start = (arena->used + 7) & ~(size_t)7;
    if (start > arena->size || n > arena->size - start) {
        return NULL;
    }
    arena->used = start + n;
    return arena->base + start;
}

struct ph_projection demo_perspective(const struct demo_context *context, int32_t scale_q20, fx_t near_z, fx_t far_z)
{
    const int32_t w = context->width;
    const int32_t h = context->height;
    struct ph_projection p = {.kind = PH_PERSPECTIVE, .near_z = near_z, .far_z = far_z};
    p.scale_x_q20 = scale_q20;
    p.scale_y_q20 = scale_q20;
    if (w >= h) {
        p.scale_x_q20 = (int32_t)((fx_mul_wide(scale_q20, h) + w / 2) / w);
    } else {
        p.scale_y_q20 = (int32_t)((fx_mul_wide(scale_q20, w) + h / 2) / h);
    }
    return p;
}

int demo_begin(const struct demo_context *context, struct ph_renderer *r, const struct ph_xform *view,
               const struct ph_projection *projection, const struct ph_scene_light *light, uint16_t background)
{
    const struct demo_camera *const user = &context->camera;
    return ph_frame_begin(r, user->view_set ? &user->view : view, user->projection_set ? &user->projection : projection,
                          light, background);
}
