/* See model_studio.h and, for model_is_colour, model.h. */
#include "model_studio.h"

#include <stdlib.h>
#include <string.h>

/* Thirds of a unit vector, Q2.30. */
#define THIRD 357913941

bool model_is_colour(const char *text)
{
    return strlen(text) == 6 && strspn(text, "0123456789abcdefABCDEF") == 6;
}

static struct fx_vec3 way_to(const char *lamp)
{
    static const struct {
        const char *name;
        struct fx_vec3 way;
    } lamps[] = {{"left", {-2 * THIRD, THIRD, 2 * THIRD}},
                 {"right", {2 * THIRD, THIRD, 2 * THIRD}},
                 {"front", {0, 0, 1 << 30}},
                 {"above", {0, 1 << 30, 0}},
                 {"back", {-THIRD, 2 * THIRD, -2 * THIRD}}};
    size_t i = 0;
    while (i + 1 < sizeof lamps / sizeof lamps[0] && strcmp(lamps[i].name, lamp) != 0) {
        i++;
    }
    return lamps[i].way;
}

void model_studio_make(struct model_shared *shared)
{
    const struct model_options *const o = &shared->options;
    const unsigned long colour = o->background != NULL ? strtoul(o->background, NULL, 16) : 0;
    if (o->background == NULL && o->light == NULL) {
        return;
    }
    shared->studio = (struct demo_studio){.background = DEMO_MODEL_BACKGROUND, .has_lamp = o->light != NULL};
    if (o->background != NULL) {
        shared->studio.background = ph_rgb565((uint8_t)(colour >> 16), (uint8_t)(colour >> 8), (uint8_t)colour);
    }
    if (o->light != NULL) {
        shared->studio.to_lamp_q30 = way_to(o->light);
    }
    shared->model.studio = &shared->studio;
}
