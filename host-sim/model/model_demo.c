/* model: a model as a demo (demo.h), on the turntable, or as its own camera or a binary scene shows it. */
#include "model.h"
#include "scene_file.h"

#include <string.h>

static const char *const views[] = {"camera", "turntable", NULL};

static bool is_turntable(const struct demo_context *context)
{
    return context->view != NULL && strcmp(context->view, "turntable") == 0;
}

/* Makes the demo of a model, before the eye, or (NULL) on the turntable. */
static int init(struct demo_context *context, const struct demo_eye *eye)
{
    const struct model *model = context->state;
    const struct fx_vec3 centre = {0, 0, 0};
    context->studio = model->studio;
    return model->motion != NULL
               ? animation_init(context, &model->motion->animation, model->meshes, model->mesh_count, eye)
           : eye != NULL ? demo_still_init(context, model->meshes, model->mesh_count, eye)
                         : demo_turntable_init(context, model->meshes, model->mesh_count, centre);
}

static int turntable_init(struct demo_context *context)
{
    return init(context, NULL);
}

static int camera_init(struct demo_context *context)
{
    const struct model *model = context->state;
    return init(context, is_turntable(context) ? NULL : &model->camera);
}

static int camera_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    return (is_turntable(context) ? demo_turntable_frame : demo_still_frame)(context, r, frame);
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
    const struct animation *a = model->motion != NULL ? &model->motion->animation : NULL;
    uint32_t vertices = 0;
    for (uint32_t m = 0; m < model->mesh_count; m++) {
        vertices += model->meshes[m].vertex_count;
    }
    const struct animation_need need = a != NULL ? animation_need(a) : (struct animation_need){0};
    const size_t moving = a != NULL ? animation_bytes(&need, a, model->mesh_count, false) : 0;
    const size_t moving_32 = a != NULL ? animation_bytes(&need, a, model->mesh_count, true) : 0;
    return (struct demo){.name = "model",
                         .summary = "a model file",
                         .views = model->has_camera ? views : views + 1,
                         .loop_frames = demo_find("turntable")->loop_frames,
                         .arena_bytes = DEMO_TURNTABLE_BYTES + moving,
                         .arena_bytes_32 = (uint32_t)(DEMO_TURNTABLE_BYTES + moving_32),
                         .vertex_max = vertices + DEMO_TURNTABLE_VERTICES,
                         /* A clipped triangle becomes several; few are clipped. */
                         .triangle_max = model->triangle_count + model->triangle_count / 4 + DEMO_TURNTABLE_TRIANGLES +
                                         model_blend_triangles(model, 1024),
                         .init = model->has_camera ? camera_init : turntable_init,
                         .select = a != NULL ? animation_select : NULL,
                         .frame = a != NULL           ? animation_frame
                                  : model->has_camera ? camera_frame
                                                      : demo_turntable_frame};
}
