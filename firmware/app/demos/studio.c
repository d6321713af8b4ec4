/* demo_studio_light, demo_studio_background: see demo_scene.h. */
#include "demo_scene.h"

struct ph_scene_light demo_studio_light(const struct demo_context *context)
{
    struct ph_scene_light light = demo_two_lamps;
    if (context->studio && context->studio->has_lamp) {
        light.count = 1;
        light.lights[0].to_light_q30 = context->studio->to_lamp_q30;
    }
    return light;
}

uint16_t demo_studio_background(const struct demo_context *context)
{
    return context->studio ? context->studio->background : DEMO_MODEL_BACKGROUND;
}
