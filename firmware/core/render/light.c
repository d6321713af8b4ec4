/*
 * Light of a vertex: ambient + diffuse (Lambert) + specular (Blinn 1977, viewer at infinity), as one white intensity.
 * Lights are brought into the coordinates of the mesh, so that neither normals nor positions have to be rotated.
 * Products have 16 bits, Q2.14. Lights with a position are in light_point.c. See light.h.
 */
/* Kits on armv6m: -O2. */
#include "light.h"

#include "vertex.h"

/* Q16.16, clamped to 0 .. most, as Q2.14. */
static int32_t clamp_q14(fx_t v, fx_t most)
{
    return (v < 0 ? 0 : v > most ? most : v) >> 2;
}

/* The unit vector of any vector, in Q1.14; zero stays zero. */
static void unit_q14(const int32_t in[3], int16_t out[3])
{
    int32_t v[3];
    int bits;
    const uint32_t sum = ph_scale_q14(in, v, &bits);
    const fx_t inverse = fx_rsqrt_sat((fx_t)(sum >> 12)); /* |v| = 2^14 sqrt(sum / 2^28): 1 / that in Q16.16 */
    for (int i = 0; i < 3; i++) {
        out[i] = (int16_t)((v[i] * (inverse >> 2)) >> 14);
    }
}

/* The transposed rotation, then length one. */
void ph_light_to_local(const struct ph_xform *to_world, struct fx_vec3 d, int16_t out[3])
{
    const int32_t in[3] = {d.x >> 2, d.y >> 2, d.z >> 2};
    int32_t local[3];
    for (int j = 0; j < 3; j++) {
        const int64_t sum = fx_mul_wide(to_world->r[0][j], in[0]) + fx_mul_wide(to_world->r[1][j], in[1]) +
                            fx_mul_wide(to_world->r[2][j], in[2]);
        local[j] = (int32_t)(sum >> 31);
    }
    unit_q14(local, out);
}

/* The half vector between two unit vectors. */
static void half_of(const int16_t a[3], const int16_t b[3], int16_t out[3])
{
    const int32_t sum[3] = {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    unit_q14(sum, out);
}

static void prepare_colour(struct ph_local_light *l, const struct ph_light *light, bool coloured)
{
    const fx_t share[3] = {light->red, light->green, light->blue};
    const bool white = (share[0] | share[1] | share[2]) == 0;
    uint32_t sum = 0;
    for (int k = 0; k < 3; k++) {
        l->colour[k] = (int16_t)(white ? 16384 : clamp_q14(share[k], FX_ONE));
        sum += (uint32_t)l->colour[k];
    }
    if (!coloured && !white) {
        const int32_t mean = (int32_t)(sum * 43691 >> 17); /* a third: exact up to 3 * 16384 */
        l->diffuse = l->diffuse * mean >> 14;
        l->specular = l->specular * mean >> 14;
    }
}

/* What all lights of a mesh and a material share; to_viewer is set where the material has highlights. */
static void prepare_material(struct ph_local_lights *local, const struct ph_renderer *r,
                             const struct ph_xform *to_world, const struct ph_material *material)
{
    const struct fx_vec3 viewer = {r->view.r[2][0], r->view.r[2][1], r->view.r[2][2]};
    local->ambient = (clamp_q14(r->light.ambient, FX_ONE) * clamp_q14(material->ambient, FX_ONE)) >> 14;
    local->shininess_log2 = material->shininess_log2 < 7 ? material->shininess_log2 : 7;
    const uint32_t specular = (uint32_t)clamp_q14(material->specular, FX_ONE), span = (uint32_t)PH_LIGHT_SPAN << 14;
    local->scale = PH_LIGHT_SPAN;
    local->limit = 16384;
    if (specular > 0) {
        local->scale = (int32_t)fx_quotient_u64(span, 16384 + specular);
        local->limit = (int32_t)fx_quotient_u64(span, (uint32_t)local->scale);
        ph_light_to_local(to_world, viewer, local->to_viewer);
    }
}

void ph_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                      const struct ph_material *material, bool coloured)
{
    const struct ph_scene_light *scene = &r->light;
    const int32_t diffuse = clamp_q14(material->diffuse, FX_ONE), specular = clamp_q14(material->specular, FX_ONE);
    prepare_material(local, r, to_world, material);
    local->count = scene->count;
    for (uint32_t i = 0; i < scene->count; i++) {
        const struct ph_light *light = &scene->lights[i];
        struct ph_local_light *l = &local->light[i];
        l->kind = light->kind;
        l->diffuse = (diffuse * clamp_q14(light->intensity, 4 * FX_ONE)) >> 14;
        l->specular = (specular * clamp_q14(light->intensity, 4 * FX_ONE)) >> 14;
        prepare_colour(l, light, coloured);
        if (l->kind != NULL) {
            l->kind->place_light(l, light, to_world);
        } else {
            ph_light_to_local(to_world, light->to_light_q30, l->to_light);
            if (specular > 0) {
                half_of(l->to_light, local->to_viewer, l->half);
            }
        }
    }
    local->simple = scene->count == 1 && local->light[0].kind == NULL && local->light[0].specular <= 0;
}

/* What a directional light adds to a vertex, Q2.14. */
static inline __attribute__((always_inline)) bool add_directional(const struct ph_local_lights *local,
                                                                  const struct ph_local_light *l,
                                                                  const int16_t normal[3], int32_t *diffuse,
                                                                  int32_t *specular)
{
    const int32_t n_l = ph_dot_q14(normal, l->to_light);
    if (n_l <= 0) {
        return false;
    }
    *diffuse = (n_l > 16384 ? 16384 : n_l) * l->diffuse >> 14;
    *specular = l->specular > 0 ? ph_shine_of(local, ph_dot_q14(normal, l->half)) * l->specular >> 14 : 0;
    return true;
}

/* What one light adds to a vertex, Q2.14. False: nothing. */
static inline __attribute__((always_inline)) bool add_of(const struct ph_local_lights *local,
                                                         const struct ph_local_light *l, const int16_t normal[3],
                                                         const struct fx_vec3 *position, int32_t *diffuse,
                                                         int32_t *specular)
{
    return l->kind != NULL ? l->kind->add_light(local, l, normal, position, diffuse, specular)
                           : add_directional(local, l, normal, diffuse, specular);
}

/* The light of a vertex, of what all lights add up to. */
static inline __attribute__((always_inline)) uint16_t light_of(const struct ph_local_lights *local, int32_t diffuse,
                                                               int32_t specular)
{
    const int32_t total = (diffuse > 16384 ? 16384 : diffuse) + specular;
    const int32_t capped = total > local->limit ? local->limit : total;
    return (uint16_t)(PH_LIGHT_ZERO + (((uint32_t)capped * (uint32_t)local->scale) >> 14));
}

/* The light of a vertex under any lights. */
PH_TIER(mesh)
static PH_NOINLINE uint16_t any_light(const struct ph_local_lights *local, const int16_t normal[3],
                                      const struct fx_vec3 *position)
{
    int32_t diffuse = local->ambient, specular = 0;
    for (uint32_t i = 0; i < local->count; i++) {
        int32_t more, shine;
        if (add_of(local, &local->light[i], normal, position, &more, &shine)) {
            diffuse += more;
            specular += shine;
        }
    }
    return light_of(local, diffuse, specular);
}

/* A channel of 0 .. top under this light: black at 0, its colour at 1, white at 2. */
static uint32_t lit_channel(uint32_t base, uint32_t top, int32_t diffuse, int32_t specular, int32_t limit)
{
    const int32_t sum = (diffuse > 16384 ? 16384 : diffuse) + specular, total = sum > limit ? limit : sum;
    const uint32_t colour = (uint32_t)(total > 16384 ? 16384 : total), white = (uint32_t)total - colour;
    return (base * colour + (top - base) * white + 8192) >> 14;
}

uint16_t ph_light_colour(const struct ph_local_lights *local, const int16_t *normal, const struct fx_vec3 *position,
                         uint32_t base)
{
    int32_t diffuse[3] = {local->ambient, local->ambient, local->ambient}, specular[3] = {0, 0, 0};
    if (normal == NULL) {
        return (uint16_t)base;
    }
    for (uint32_t i = 0; i < local->count; i++) {
        const struct ph_local_light *const l = &local->light[i];
        int32_t more, shine;
        if (add_of(local, l, normal, position, &more, &shine)) {
            for (int k = 0; k < 3; k++) {
                diffuse[k] += more * l->colour[k] >> 14;
                specular[k] += shine * l->colour[k] >> 14;
            }
        }
    }
    /* `limit` has been rounded to the ramp's scale: at full light it is at most 2 */
    const int32_t limit = local->limit < 32768 ? local->limit : 32768;
    return (uint16_t)(lit_channel(base >> 11, 31, diffuse[0], specular[0], limit) << 11 |
                      lit_channel(base >> 5 & 63, 63, diffuse[1], specular[1], limit) << 5 |
                      lit_channel(base & 31, 31, diffuse[2], specular[2], limit));
}

PH_TIER(mesh)
uint16_t ph_light_vertex(const struct ph_local_lights *local, const int16_t normal[3], const struct fx_vec3 *position)
{
    if (!local->simple) {
        return any_light(local, normal, position);
    }
    const struct ph_local_light *const l = &local->light[0];
    const int32_t n_l = ph_dot_q14(normal, l->to_light);
    const int32_t shone = n_l <= 0 ? 0 : ((n_l > 16384 ? 16384 : n_l) * l->diffuse) >> 14;
    const int32_t total = local->ambient + shone;
    return (uint16_t)(PH_LIGHT_ZERO + (((uint32_t)(total > 16384 ? 16384 : total) * (uint32_t)local->scale) >> 14));
}
