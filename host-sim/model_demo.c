#include "model.h"

static int init(struct demo_context *context)
{
    const struct model *model = context->state;
    const struct fx_vec3 centre = {0, 0, 0};
    return demo_turntable_init(context, model->meshes, model->mesh_count, centre);
}

struct demo model_demo(const struct model *model)
{
    const uint32_t vertices = model->vertex_max;
    return (struct demo){.name = "model",
                         .summary = "a model file on the turntable",
                         .loop_frames = demo_find("turntable")->loop_frames,
                         .arena_bytes = DEMO_TURNTABLE_BYTES,
                         .arena_bytes_32 = DEMO_TURNTABLE_BYTES,
                         .vertex_max = vertices > DEMO_TURNTABLE_VERTICES ? vertices : DEMO_TURNTABLE_VERTICES,
                         /* A clipped triangle becomes several; few are clipped. */
                         .triangle_max = model->triangle_count + model->triangle_count / 4 + DEMO_TURNTABLE_TRIANGLES,
                         .init = init,
                         .frame = demo_turntable_frame};
}
