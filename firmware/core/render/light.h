/* light: the intensity of a vertex. Private to firmware/core; the model is in light.c. */
#ifndef PH_LIGHT_H
#define PH_LIGHT_H

#include "render.h"

/* A light in the coordinates of one mesh. */
struct ph_local_light {
    bool point, spot;             /* point: it has a position; spot: and a cone */
    int16_t to_light[3], half[3]; /* directional: unit vectors, Q1.14; spot: to_light is its axis */
    struct fx_vec3 position;      /* point */
    uint32_t fall;                /* point: 1 / reach^2 is this 2^(fall_down - 164); 0: it does not fall off */
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

/* The lights of the frame for one mesh and one material. coloured: for ph_light_colour, else for ph_light_vertex, and
 * coloured lights count as white ones of their mean. */
void ph_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                      const struct ph_material *material, bool coloured);

/* Whether one of the lights is not white. */
bool ph_light_has_colour(const struct ph_scene_light *light);

/* Lit colour of a vertex, RGB565 as a number; base: its own colour, in the same form. normal: NULL: full light. */
uint16_t ph_light_colour(const struct ph_local_lights *local, const int16_t *normal, const struct fx_vec3 *position,
                         uint32_t base);

/* Light of a vertex: PH_LIGHT_ZERO .. PH_LIGHT_ZERO + PH_LIGHT_SPAN. */
uint16_t ph_light_vertex(const struct ph_local_lights *local, const int16_t normal[3], const struct fx_vec3 *position);

#endif
