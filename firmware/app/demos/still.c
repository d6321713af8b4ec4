/* demo_still_init, demo_still_frame: see demo.h. */
#include "demo_scene.h"

struct still {
    const struct ph_mesh *meshes;
    uint32_t mesh_count;
    struct ph_xform view;
    struct ph_projection projection;
    struct ph_scene_light light;
};

_Static_assert(sizeof(struct still) <= DEMO_STILL_BYTES, "DEMO_STILL_BYTES is too small");

/* Fits the eye's frame into a picture with square pixels, as large as possible. */
static struct ph_projection fit_frame(const struct demo_context *context, const struct ph_projection *lens)
{
    const int64_t w = context->width, h = context->height;
    struct ph_projection p = *lens;
    const int64_t for_width = lens->scale_x_q20 * w / h;
    if (lens->scale_x_q20 != 0 && for_width < p.scale_y_q20) {
        p.scale_y_q20 = (int32_t)for_width;
    }
    const int64_t scale_x = (p.scale_y_q20 * h + w / 2) / w;
    p.scale_x_q20 = scale_x < INT32_MAX ? (int32_t)scale_x : INT32_MAX;
    return p;
}

int demo_still_init(struct demo_context *context, const struct ph_mesh *meshes, uint32_t mesh_count,
                    const struct demo_eye *eye)
{
    struct still *const s = demo_alloc(&context->arena, sizeof(*s));
    if (!s) {
        return PH_ERR_NOMEM;
    }
    const struct ph_xform to_world = ph_xform_inverse_rigid(&eye->view);
    *s = (struct still){meshes, mesh_count, eye->view, fit_frame(context, &eye->lens), demo_studio_light(context)};
    for (uint32_t i = 0; i < s->light.count; i++) { /* as on the turntable, but in the coordinates of the eye */
        struct fx_vec3 *const to_light = &s->light.lights[i].to_light_q30;
        *to_light = ph_xform_direction_q30(&to_world, *to_light);
    }
    context->state = s;
    return PH_OK;
}

int demo_still_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    const struct still *const s = context->state;
    struct ph_xform view = s->view;
    struct ph_projection projection = s->projection;
    (void)frame;
    demo_orbit(context, &view, &projection);
    const int status = demo_begin(context, r, &view, &projection, &s->light, demo_studio_background(context));
    return status ? status : demo_draw_meshes(r, s->meshes, s->mesh_count, &ph_xform_identity);
}
