/* Lights with a position: points and spots. See light.h. */
/* Kits on armv6m: -O2. */
#include "light.h"

/* A vector's square and its exponent: the vector is sqrt(square) 2^(bits - 14) long. */
struct length {
    uint32_t square; /* 2^26 .. 3 2^28, or 0 */
    int bits;        /* of the vector's largest component */
};

/* The unit vector of a vector in Q1.14, 6.2e-5 off: unit_q14 of light.c without its division, for work at each vertex.
 */
static struct length quick_unit_q14(const int32_t in[3], int16_t out[3])
{
    int32_t v[3];
    int bits;
    const uint32_t sum = ph_scale_q14(in, v, &bits);
    const int up = sum >> 28 != 0 ? 1 : 2;
    const int32_t inverse = sum != 0 ? (int32_t)fx_rsqrt16(sum << 2 * up) : 0; /* 2^31 / sqrt */
    for (int i = 0; i < 3; i++) {
        out[i] = (int16_t)((v[i] * inverse) >> (17 - up));
    }
    return (struct length){sum, bits};
}

/* Square of the transform's uniform scale. */
static fx_t scale_square(const struct ph_xform *to_world)
{
    const int32_t *row = to_world->r[0];
    const int64_t square = (fx_mul_wide(row[0], row[0]) >> 2) + (fx_mul_wide(row[1], row[1]) >> 2) +
                           (fx_mul_wide(row[2], row[2]) >> 2); /* Q58 */
    return (fx_t)(square >> 42);
}

/* A position of the world in the mesh's coordinates, for a rotation with a uniform scale s: r^T (p - t) / s^2. */
static struct fx_vec3 position_to_local(const struct ph_xform *to_world, struct fx_vec3 p, fx_t scale)
{
    const struct fx_vec3 from = fx_vec3_sub_sat(p, to_world->t);
    fx_t local[3];
    for (int j = 0; j < 3; j++) {
        const int64_t sum = (fx_mul_wide(to_world->r[0][j], from.x) >> 2) +
                            (fx_mul_wide(to_world->r[1][j], from.y) >> 2) +
                            (fx_mul_wide(to_world->r[2][j], from.z) >> 2);
        const int64_t rotated = sum >> 28;
        local[j] = fx_div_sat(fx_sat64(rotated), scale);
    }
    return (struct fx_vec3){local[0], local[1], local[2]};
}

static fx_t clamp_cosine(fx_t v)
{
    return v < -FX_ONE ? -FX_ONE : v > FX_ONE ? FX_ONE : v;
}

/* How a light falls off that has half its strength at `reach`: 1 / reach^2. */
static void set_fall(struct ph_local_light *l, fx_t reach)
{
    int shift = 0;
    const uint32_t over = reach > 0 ? fx_rcp_norm((uint32_t)reach, &shift) : 0; /* 2^(62 - shift) / reach */
    l->fall = fx_mulhi_u32(over, over);
    l->fall_down = 72 - 2 * shift;
}

static void place_point(struct ph_local_light *l, const struct ph_light *light, const struct ph_xform *to_world)
{
    const fx_t scale = scale_square(to_world);
    l->position = position_to_local(to_world, light->position, scale);
    set_fall(l, fx_div_sat(light->reach, fx_sqrt(scale)));
}

static void place_spot(struct ph_local_light *l, const struct ph_light *light, const struct ph_xform *to_world)
{
    const fx_t outer = clamp_cosine(light->cos_outer);
    const int32_t width = (clamp_cosine(light->cos_inner) - outer) >> 2;
    place_point(l, light, to_world);
    ph_light_to_local(to_world, light->to_light_q30, l->to_light);
    l->cos_outer = outer >> 2;
    l->cos_width = width > 0 ? width : 1;
}

/* 1 / (1 + (distance / reach)^2), Q2.14, without a root; 1 if the light does not fall off. */
static int32_t attenuation(const struct ph_local_light *l, struct length distance)
{
    const uint32_t part = fx_mulhi_u32(distance.square << 2, l->fall), most = (uint32_t)1 << 30;
    const int down = l->fall_down - 2 * distance.bits; /* (distance / reach)^2 is part 2^-down in Q16 */
    const uint32_t square = l->fall == 0 || down > 31 ? 0 : down > 0 ? part >> down : most;
    int shift;
    const uint32_t reciprocal = fx_rcp_norm(FX_ONE + (square < most ? square : most), &shift);
    return (int32_t)(reciprocal >> (32 - shift));
}

static int32_t in_cone(const struct ph_local_light *l, const int16_t to_light[3])
{
    const int32_t beyond = ph_dot_q14(to_light, l->to_light) - l->cos_outer;
    return beyond <= 0              ? 0
           : beyond >= l->cos_width ? 16384
                                    : (int32_t)(((uint32_t)beyond << 14) / (uint32_t)l->cos_width);
}

static bool add_point(const struct ph_local_lights *local, const struct ph_local_light *l, const int16_t normal[3],
                      const struct fx_vec3 *position, int32_t *diffuse, int32_t *specular)
{
    const int32_t in[3] = {(l->position.x >> 1) - (position->x >> 1), (l->position.y >> 1) - (position->y >> 1),
                           (l->position.z >> 1) - (position->z >> 1)};
    int16_t to_light[3], half[3];
    const struct length distance = quick_unit_q14(in, to_light);
    const int32_t n_l = ph_dot_q14(normal, to_light);
    if (n_l <= 0) {
        return false;
    }
    const int32_t near = attenuation(l, distance);
    const int32_t reaches = l->kind->in_cone != NULL ? near * l->kind->in_cone(l, to_light) >> 14 : near;
    *diffuse = (((n_l > 16384 ? 16384 : n_l) * reaches) >> 14) * l->diffuse >> 14;
    *specular = 0;
    if (l->specular > 0) {
        const int32_t sum[3] = {to_light[0] + local->to_viewer[0], to_light[1] + local->to_viewer[1],
                                to_light[2] + local->to_viewer[2]};
        quick_unit_q14(sum, half);
        *specular = ((ph_shine_of(local, ph_dot_q14(normal, half)) * reaches) >> 14) * l->specular >> 14;
    }
    return true;
}

const struct ph_light_kind ph_light_point = {.place_light = place_point, .add_light = add_point};
const struct ph_light_kind ph_light_spot = {.place_light = place_spot, .add_light = add_point, .in_cone = in_cone};
