#include "model.h"
#include "scene_file.h"

#include <string.h>

static const char *const views[] = {"camera", "turntable", NULL};

/* The state of a demo whose meshes move: that of the still one, and the model. */
struct moving {
    void *still;
    const struct model *model;
};

static int keep_model(struct demo_context *context, const struct model *model, int status)
{
    struct moving *const moving = status == PH_OK ? demo_alloc(&context->arena, sizeof *moving) : NULL;
    if (moving == NULL) {
        return PH_ERR_NOMEM;
    }
    *moving = (struct moving){context->state, model};
    context->state = moving;
    return PH_OK;
}

static int turntable_init(struct demo_context *context)
{
    const struct model *model = context->state;
    const struct fx_vec3 centre = {0, 0, 0};
    return keep_model(context, model, demo_turntable_init(context, model->meshes, model->mesh_count, centre));
}

static bool is_turntable(const struct demo_context *context)
{
    return context->view != NULL && strcmp(context->view, "turntable") == 0;
}

static int camera_init(struct demo_context *context)
{
    const struct model *model = context->state;
    return is_turntable(context)
               ? turntable_init(context)
               : keep_model(context, model, demo_still_init(context, model->meshes, model->mesh_count, &model->camera));
}

static int move_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct moving *const moving = context->state;
    const bool turns = !moving->model->has_camera || is_turntable(context);
    model_move(moving->model, frame);
    context->state = moving->still;
    const int status = (turns ? demo_turntable_frame : demo_still_frame)(context, r, frame);
    context->state = moving;
    return status;
}

/* The demo of a binary scene finds the scene's bytes as its state. */
static int scene_init(struct demo_context *context)
{
    const struct model *model = context->state;
    context->state = (void *)(uintptr_t)model->scene;
    return scene_file_demo(model->scene).init(context);
}

#define ROW_PIXEL_BYTES 8 /* of the row that the renderer draws blended triangles into, at most */

uint32_t model_blend_triangles(const struct model *model, uint32_t width)
{
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        if (model->meshes[m].materials->blend != NULL) {
            return width * ROW_PIXEL_BYTES / PH_TRIANGLE_BYTES_32 + 1;
        }
    }
    return 0;
}

struct demo model_demo(const struct model *model)
{
    if (model->scene != NULL) {
        struct demo demo = scene_file_demo(model->scene);
        demo.views = model->has_camera ? NULL : views + 1;
        demo.init = scene_init;
        return demo;
    }
    uint32_t vertices = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        vertices += model->meshes[m].vertex_count;
    }
    return (struct demo){.name = "model",
                         .summary = "a model file",
                         .views = model->has_camera ? views : views + 1,
                         .loop_frames = demo_find("turntable")->loop_frames,
                         .arena_bytes = DEMO_TURNTABLE_BYTES + sizeof(struct moving),
                         .arena_bytes_32 = DEMO_TURNTABLE_BYTES + sizeof(struct moving),
                         .vertex_max = vertices + DEMO_TURNTABLE_VERTICES,
                         /* A clipped triangle becomes several; few are clipped. */
                         .triangle_max = model->triangle_count + model->triangle_count / 4 + DEMO_TURNTABLE_TRIANGLES +
                                         model_blend_triangles(model, 1024),
                         .init = model->has_camera ? camera_init : turntable_init,
                         .frame = move_frame};
}
