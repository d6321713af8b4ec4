/* Colours of vertices, and coloured light, of meshes. See colours.h. */
#include "colours.h"
#include "colour.h"
#include "colours_small.h"
#include "mesh.h"
#include "planes.h"
#include "setup.h"

/* Whether one of the lights is not white. */
static bool has_colour(const struct ph_scene_light *light)
{
    fx_t any = 0;
    for (uint32_t i = 0; i < light->count; i++) {
        any |= light->lights[i].red | light->lights[i].green | light->lights[i].blue;
    }
    return any != 0;
}

/* Whether the vertices of a part have colours in place of light. */
static bool is_coloured(const struct ph_part_context *c)
{
    const bool lit = ph_lit_corners_of(c->material) != PH_NO_CORNER && !ph_takes_texture(c->material);
    return c->mesh->colours != NULL ? lit || c->material->shading == PH_SHADE_UNLIT
                                    : lit && c->mesh->normals != NULL && has_colour(&c->r->light);
}

/* Whether the vertices have the same own colour as in the part before. */
static bool is_alike(const struct ph_part_context *c, const struct ph_material *before)
{
    return c->mesh->colours != NULL ? (before->shading == PH_SHADE_UNLIT) == (c->material->shading == PH_SHADE_UNLIT)
                                    : before->colour == c->material->colour;
}

/* Without normals or a shading that is lit, it is the vertex's own. */
static uint16_t vertex_colour(const struct ph_part_context *c, uint32_t i)
{
    const struct ph_mesh *const mesh = c->mesh;
    const int16_t *const normal = mesh->normals != NULL && c->lighting != NULL ? mesh->normals[i] : NULL;
    const uint16_t base = ph_wire16(mesh->colours != NULL ? mesh->colours[i] : c->material->colour);
    return normal != NULL ? ph_light_colour(&c->lights, normal, &mesh->positions[i], base) : base;
}

static void take_colours(struct ph_clip_vertex in[3], bool flat)
{
    for (int i = 2; i >= 0; i--) { /* the first corner last: flat triangles have its colour */
        const int32_t colour = in[flat ? 0 : i].light;
        in[i].uv[0] = (colour >> 5 & 63) << 10 | 1 << 9;
        in[i].uv[1] = (colour & 31) << 11 | 1 << 10;
        in[i].light = (colour >> 11) << 11 | 1 << 10;
    }
}

static uint16_t colour_of(const struct ph_corner *corner)
{
    const unsigned green = (unsigned)corner->uv[0], blue = (unsigned)corner->uv[1];
    return (uint16_t)((corner->at.light & 0xf800) | (green >> 10 & 63) << 5 | (blue >> 11 & 31));
}

static void prepare(struct ph_setting *s)
{
    s->fast.ramp = NULL;
    s->source = PH_FROM_CORNERS;
    s->set_corners = ph_set_small_colours;
    s->excess_of = ph_excess_of;
    s->antialiasing = s->r->samples_log2 != 0 ? s->antialiasing : NULL; /* lit colours are not dithered */
}

const struct ph_colouring ph_colouring = {.parts = &ph_part_lighting,
                                          .is_coloured = is_coloured,
                                          .is_alike = is_alike,
                                          .vertex_colour = vertex_colour,
                                          .take_colours = take_colours,
                                          .colour_of = colour_of,
                                          .set_colours = ph_set_colours,
                                          .prepare = prepare,
                                          .take_small_depth = ph_take_small_depth,
                                          .draw_colours = ph_draw_colours};
