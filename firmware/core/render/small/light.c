/* Light of the small profile: ambient and one directional light, as render/light.c has it. See small.h. */
#include "../light.c"

#include "small.h"

void ph_small_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                            const struct ph_material *material)
{
    const struct ph_light *const light = &r->light.lights[0];
    const struct fx_vec3 viewer = {r->view.r[2][0], r->view.r[2][1], r->view.r[2][2]};
    const int32_t intensity = r->light.count > 0 ? clamp_q14(light->intensity, 4 * FX_ONE) : 0;
    const int32_t specular = clamp_q14(material->specular, FX_ONE);
    struct ph_local_light *const l = &local->light[0];
    local->ambient = (clamp_q14(r->light.ambient, FX_ONE) * clamp_q14(material->ambient, FX_ONE)) >> 14;
    local->shininess_log2 = material->shininess_log2 < 7 ? material->shininess_log2 : 7;
    local->scale = (int32_t)(((uint32_t)PH_LIGHT_SPAN << 14) / (16384 + (uint32_t)specular));
    local->limit = (int32_t)(((uint32_t)PH_LIGHT_SPAN << 14) / (uint32_t)local->scale);
    l->diffuse = (clamp_q14(material->diffuse, FX_ONE) * intensity) >> 14;
    l->specular = (specular * intensity) >> 14;
    ph_light_to_local(to_world, viewer, local->to_viewer);
    ph_light_to_local(to_world, light->to_light_q30, l->to_light);
    half_of(l->to_light, local->to_viewer, l->half);
}

uint16_t ph_small_light_vertex(const struct ph_local_lights *local, const int16_t normal[3])
{
    int32_t diffuse = 0, specular = 0;
    add_directional(local, &local->light[0], normal, &diffuse, &specular);
    diffuse += local->ambient;
    const int32_t total = (diffuse > 16384 ? 16384 : diffuse) + specular;
    const int32_t capped = total > local->limit ? local->limit : total;
    return (uint16_t)(PH_LIGHT_ZERO + (((uint32_t)capped * (uint32_t)local->scale) >> 14));
}
