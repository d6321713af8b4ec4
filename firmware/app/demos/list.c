/* The demos, in the order of the select button: a new one is added here and in demo_scene.h. */
#include "demo_scene.h"

#include <string.h>

const struct demo *const demo_list[] = {
    &demo_turntable, &demo_testcard,  &demo_torus,     &demo_cube,      &demo_fill,        &demo_icosphere,
    &demo_ground,    &demo_wireframe, &demo_solar,     &demo_snake,     &demo_ball,        &demo_hitchcock,
    &demo_parallel,  &demo_shadow,    &demo_fisheye,   &demo_focus,     &demo_conventions, &demo_zfight,
    &demo_zoom,      &demo_pinhole,   &demo_materials, &demo_character, &demo_yard,
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
