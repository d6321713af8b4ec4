/* The shadings that a material may name. See shading.h, render.h. */
#include "shading.h"

#include "gouraud.h"
#include "mesh.h"
#include "planes.h"
#include "setup.h"
#include "small_texels.h"
#include "texel_light.h"
#include "texels.h"
#include "texture.h"

static const struct ph_lighting lighting = {
    .light_prepare = ph_light_prepare, .light_vertex = ph_light_vertex, .parts = &ph_part_lighting};

#define TEXTURING(light)                                                                                               \
    {                                                                                                                  \
        .set_texels = ph_setup_texels, .excess_of = ph_excess_of, .take_small_depth = ph_take_small_depth,             \
        .draw_texels = ph_draw_small_texels, .begin_texels = ph_small_texels_begin,                                    \
        .draw_texel_rows = ph_small_texels_draw, .draw_texel_piece = ph_small_texels_piece,                            \
        .set_texel_planes = ph_set_texel_planes, .draw_textured = ph_draw_textured, .lighting = (light)                \
    }

const struct ph_shading ph_shade_flat = {.corners = PH_FIRST_CORNER, .lighting = &lighting};
const struct ph_shading ph_shade_gouraud = {.corners = PH_EACH_CORNER, .lighting = &lighting, .gouraud = &ph_gouraud};
const struct ph_shading ph_shade_wire = {.draw_edges = ph_draw_edges};
const struct ph_shading ph_shade_texture = {.texturing = TEXTURING(NULL), .texels = &ph_shade_texture};
const struct ph_shading ph_shade_texture_lit = {.corners = PH_FIRST_CORNER,
                                                .lighting = &lighting,
                                                .texturing = TEXTURING(&ph_texel_lighting),
                                                .texels = &ph_shade_texture};
const struct ph_shading ph_shade_texture_gouraud = {.corners = PH_EACH_CORNER,
                                                    .lighting = &lighting,
                                                    .texturing = TEXTURING(&ph_texel_lighting),
                                                    .texels = &ph_shade_texture};
