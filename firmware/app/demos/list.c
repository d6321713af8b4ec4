/* The list of demos: DEMOS_EACH of demo_scene.h. */
#include "demo_scene.h"

#include <string.h>

#define LISTED(name) &demo_##name,
const struct demo *const demo_list[] = {DEMOS_EACH(LISTED)};
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
