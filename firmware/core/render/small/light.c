/* Light of the small profile: ambient and one directional light, as render/light.c has it. See small.h. */
#include "../light.c"

#include "small.h"

void ph_small_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                            const struct ph_material *material)
{
    const struct ph_light *const light = &r->light.lights[0];
    const int32_t intensity = r->light.count > 0 ? clamp_q14(light->intensity, 4 * FX_ONE) : 0;
    struct ph_local_light *const l = &local->light[0];
    prepare_material(local, r, to_world, material);
    l->diffuse = (clamp_q14(material->diffuse, FX_ONE) * intensity) >> 14;
    l->specular = (clamp_q14(material->specular, FX_ONE) * intensity) >> 14;
    ph_light_to_local(to_world, light->to_light_q30, l->to_light);
    if (l->specular > 0) {
        half_of(l->to_light, local->to_viewer, l->half);
    }
}

uint16_t ph_small_light_vertex(const struct ph_local_lights *local, const int16_t normal[3])
{
    int32_t diffuse = 0, specular = 0;
    add_directional(local, &local->light[0], normal, &diffuse, &specular);
    return light_of(local, local->ambient + diffuse, specular);
}
