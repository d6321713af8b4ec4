#include "model.h"

static int init(struct demo_context *context)
{
    const struct model *model = context->state;
    const struct fx_vec3 centre = {0, 0, 0};
    return demo_turntable_init(context, model->meshes, model->mesh_count, centre);
}

struct demo model_demo(const struct model *model)
{
    return (struct demo){.name = "model",
                         .summary = "a model file on the turntable",
                         .loop_frames = demo_find("turntable")->loop_frames,
                         .arena_bytes = DEMO_TURNTABLE_BYTES,
                         .vertex_max = model->vertex_max,
                         /* A clipped triangle becomes several; few are clipped. */
                         .triangle_max = model->triangle_count + model->triangle_count / 4 + 256,
                         .init = init,
                         .frame = demo_turntable_frame};
}
