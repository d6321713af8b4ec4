/* light: the intensity of a vertex. Private to firmware/core; the model is in light.c. */
#ifndef PH_LIGHT_H
#define PH_LIGHT_H

#include "render.h"

/* A light in the coordinates of one mesh. */
struct ph_local_light {
    const struct ph_light_kind *kind;
    int16_t to_light[3], half[3]; /* directional: unit vectors, Q1.14; spot: to_light is its axis */
    struct fx_vec3 position;      /* point, spot */
    uint32_t fall;                /* point, spot: 1 / reach^2 is this 2^(fall_down - 164); 0: it does not fall off */
    int32_t fall_down;
    int32_t diffuse, specular;    /* the light's intensity times the material's share, Q2.14 */
    int32_t cos_outer, cos_width; /* spot: Q1.14; from the outer to the inner cosine, above 0 */
    int16_t colour[3]; /* shares of red, green and blue, Q1.14; white unless the light is prepared coloured */
};

struct ph_local_lights {
    int32_t ambient; /* Q2.14 */
    int32_t scale;   /* units of struct ph_vertex's light per 1.0 */
    int32_t limit;   /* 1 + specular of the material, Q2.14 */
    uint32_t count, shininess_log2;
    bool simple; /* one directional light, nothing specular */
    int16_t to_viewer[3];
    struct ph_local_light light[PH_LIGHTS_MAX];
};

/* What lights by a light with a position. The linker leaves it out of a program that names no such kind. */
struct ph_light_kind {
    /* Sets what only such a light has. */
    void (*place_light)(struct ph_local_light *l, const struct ph_light *light, const struct ph_xform *to_world);
    /* What the light adds to a vertex, Q2.14. False: nothing. */
    bool (*add_light)(const struct ph_local_lights *local, const struct ph_local_light *l, const int16_t normal[3],
                      const struct fx_vec3 *position, int32_t *diffuse, int32_t *specular);
    /* The share of the intensity in that direction, Q1.14. NULL: all of it. */
    int32_t (*in_cone)(const struct ph_local_light *l, const int16_t to_light[3]);
};

static inline __attribute__((always_inline)) int32_t ph_dot_q14(const int16_t a[3], const int16_t b[3])
{
    return (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) >> 14;
}

/* v is `in`, scaled so that its largest component has 14 bits; *bits is how many it had. Returns the square of v's
 * length, 2^26 .. 3 2^28; 0 for the zero vector. */
static inline uint32_t ph_scale_q14(const int32_t in[3], int32_t v[3], int *bits)
{
    uint32_t sum = 0;
    *bits = 32 - fx_clz32(fx_magnitude(in[0]) | fx_magnitude(in[1]) | fx_magnitude(in[2]));
    for (int i = 0; i < 3; i++) {
        v[i] = *bits > 14 ? in[i] >> (*bits - 14) : in[i] * (1 << (14 - *bits));
        sum += (uint32_t)(v[i] * v[i]);
    }
    return sum;
}

/* Brings a direction of the world, of any length, into the coordinates of the mesh as a unit vector in Q1.14. */
void ph_light_to_local(const struct ph_xform *to_world, struct fx_vec3 d, int16_t out[3]);

/* A highlight of intensity 1: n.h to the power of the shininess. */
static inline int32_t ph_shine_of(const struct ph_local_lights *local, int32_t n_h)
{
    if (n_h <= 0) {
        return 0;
    }
    int32_t shine = n_h > 16384 ? 16384 : n_h;
    for (uint32_t k = local->shininess_log2; k > 0; k--) {
        shine = (shine * shine) >> 14;
    }
    return shine;
}

/* The lights of the frame for one mesh and one material. coloured: for ph_light_colour, else for ph_light_vertex, and
 * coloured lights count as white ones of their mean. */
void ph_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                      const struct ph_material *material, bool coloured);

/* Lit colour of a vertex, RGB565 as a number; base: its own colour, in the same form. normal: NULL: full light. */
uint16_t ph_light_colour(const struct ph_local_lights *local, const int16_t *normal, const struct fx_vec3 *position,
                         uint32_t base);

/* Light of a vertex: PH_LIGHT_ZERO .. PH_LIGHT_ZERO + PH_LIGHT_SPAN. */
uint16_t ph_light_vertex(const struct ph_local_lights *local, const int16_t normal[3], const struct fx_vec3 *position);

#endif
