/*
 * scene: what is drawn: materials with their shadings, textures and blends; meshes and points; lights. render.h, which
 * includes this header, draws them.
 */
#ifndef PH_SCENE_H
#define PH_SCENE_H

#include "geom.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A shading: these names are addresses. A program links what draws in the shadings that its materials name, and nothing
 * of the others. */
struct ph_shading;
extern const struct ph_shading ph_shade_flat, ph_shade_gouraud, ph_shade_texture, ph_shade_texture_lit, ph_shade_wire,
    ph_shade_texture_gouraud;

#define PH_SHADE_UNLIT       ((const struct ph_shading *)NULL) /* material colour */
#define PH_SHADE_FLAT        (&ph_shade_flat)                  /* light at the triangle's first vertex */
#define PH_SHADE_GOURAUD     (&ph_shade_gouraud)               /* light interpolated */
#define PH_SHADE_TEXTURE     (&ph_shade_texture)               /* texture, unlit */
#define PH_SHADE_TEXTURE_LIT (&ph_shade_texture_lit) /* texture times the light at the triangle's first vertex */
#define PH_SHADE_WIRE        (&ph_shade_wire)        /* edges of the mesh as lines in the material colour */
/* Texture times light that is interpolated, and the highlight on top: as with GOURAUD, texels fade from black to their
 * colour at an intensity of 1, and to white above it. */
#define PH_SHADE_TEXTURE_GOURAUD (&ph_shade_texture_gouraud)

/* What lies outside of 0 .. 1: the texture again, or the texels of its border. _U and _V: those of the border only
 * along u, or only along v. */
enum ph_wrap { PH_WRAP_REPEAT, PH_WRAP_CLAMP_U, PH_WRAP_CLAMP_V, PH_WRAP_CLAMP = PH_WRAP_CLAMP_U | PH_WRAP_CLAMP_V };

/* A filter: these names are addresses, and a program links what filters by those that its textures name. */
struct ph_filter;
extern const struct ph_filter ph_filter_bilinear, ph_filter_mipmap;

#define PH_FILTER_NEAREST  ((const struct ph_filter *)NULL) /* the texel in which the pixel's centre lies */
#define PH_FILTER_BILINEAR (&ph_filter_bilinear)            /* between the four texels around it */
/* Bilinear in the level whose texels are nearest to pixels in size: one level for a small triangle, and one for each
 * tile of up to 64 x 16 pixels of a larger one. */
#define PH_FILTER_MIPMAP (&ph_filter_mipmap)

#define PH_TEXTURE_LOG2_MAX 10 /* textures have up to 1024 x 1024 texels */

/* A texture whose sides are powers of two: RGB565 in wire order, rows from the top. v = 0 is at the top row. Each level
 * has half the width and half the height of the one before, at least 1, and lies behind it in memory. */
struct ph_texture {
    const uint16_t *texels;
    uint8_t log2_width, log2_height; /* 0 .. PH_TEXTURE_LOG2_MAX */
    uint8_t wrap;                    /* enum ph_wrap */
    uint8_t levels;                  /* behind the texels, for PH_FILTER_MIPMAP: 0 .. 10 */
    const struct ph_filter *filter;  /* PH_FILTER_... */
};

#define PH_RAMP_SIZE 128 /* colours in a ramp; intensity 0 is at entry 4, full intensity at entry 123 */

struct ph_renderer;
struct ph_band;
struct ph_blending;

/* How a blend mixes what it draws with what is behind. */
enum ph_blend_kind {
    PH_BLEND_KEY,   /* cut-out: texels of the colour `key` are left out */
    PH_BLEND_MASK,  /* cut-out: texels are left out where `alphas` is below one half */
    PH_BLEND_TIMES, /* multiplied: what is behind, or at the same depth, times the colour, as far as a says */
    PH_BLEND_ALPHA, /* blended: colour times a plus what is behind times 1 - a; a is `alpha` times the texel's alpha
                     */
    PH_BLEND_ADD,   /* blended: colour times a is added to what is behind, up to full colour */
};

/*
 * A blend through which something else is seen. A cut-out writes depth like an opaque triangle. What is blended is
 * hidden by what is nearer, but writes no depth: it is drawn in the order of the calls that draw it, so draw the
 * farthest object first. The far side of a two-sided mesh comes before its near side; that is the right order for a
 * convex mesh. Inside any other mesh, and where objects cut through each other, nothing is sorted.
 * What is multiplied comes with the cut-outs, before the fog, in the order of the calls, and writes no depth. It
 * colours textures: draw a mesh with its texture, then the same mesh again, UNLIT or GOURAUD, with PH_BLEND_TIMES and
 * colours for its vertices, or in coloured light. Both have the same depth at each pixel. The key is looked for in the
 * nearest texel, without light; alphas have their own filter. The renderer takes 6 to 32 bytes for each column of the
 * picture, and a byte for each row, from the triangle budget in a frame that has some; without room, with draw =
 * NULL, or with alphas that draw has not the code for, their triangles are left out.
 * Cost of a pixel, in instructions on a Cortex-M0+ (tests/bench/blends.sh), in one colour (opaque 8), along a ramp (10)
 * and of nearest texels (22): ALPHA 21, 34, 57; ADD 36, 38, 61; TIMES 51, 53, 75, and 15 more if alpha is below 32;
 * KEY 55 (bilinear 143, opaque 67), MASK 97 and ALPHA with alphas 146 of nearest texels. A hidden pixel takes that of
 * the opaque form and 6.
 */
struct ph_blend {
    const struct ph_blending *draw;  /* ph_draw_blended: a program links what blends if it names this; or
                                        ph_draw_blended_alphas */
    uint8_t kind;                    /* enum ph_blend_kind */
    uint8_t alpha;                   /* TIMES, ALPHA, ADD: 1 .. 32; 0: nothing shows */
    uint16_t key;                    /* wire order */
    const struct ph_texture *alphas; /* all but KEY: the green of each texel is its alpha, beside the material's
                                        texture or its colour; its sides may differ from the texture's. Or NULL: all
                                        have alpha 1 */
};

/* For struct ph_blend: what blends in a colour, and by the alphas of a texture. */
extern const struct ph_blending ph_blending, ph_blending_alphas;
#define ph_draw_blended (&ph_blending)
/* Also by alphas over a material without a texture, for which it links what draws textures. */
#define ph_draw_blended_alphas (&ph_blending_alphas)

/* depth_bias of a decal in any format, with a depth_bias_slope of PH_DECAL_SLOPE. In the fixed formats and linear-w 2
 * is enough, and lets the decal show through less that lies before it. */
#define PH_DECAL_BIAS  16
#define PH_DECAL_SLOPE 2

/* What a surface looks like. */
struct ph_material {
    const struct ph_shading *shading; /* PH_SHADE_... */
    uint8_t two_sided;                /* draw back faces too */
    uint8_t shininess_log2;           /* specular exponent 2^this, 0 .. 7 */
    uint8_t depth_bias; /* towards the viewer, 0 .. 56 (more counts as 56), in codes of fixed16 or eighths of codes of
                           float16 */
    /* Towards the viewer, too, for decals on surfaces that lean away: this many sixteenths of what depth changes by
     * from pixel to pixel, right or down, whichever is more; at most the range of the triangle's corners. With linear-w
     * it is taken at the farthest corner, and at most 255 codes together with depth_bias. Where a float reaches into
     * the next octave by it, codes may go on as steep as before. 0: none. A decal that lies in the plane of its
     * surface shows with 2 and a depth_bias of 2, in the float formats of PH_DECAL_BIAS (tests/core/test_decals.c). */
    uint8_t depth_bias_slope;
    fx_t ambient;         /* share of the scene's ambient light reflected, 0 .. 1 */
    fx_t diffuse;         /* 0 .. 1 */
    fx_t specular;        /* 0 .. 1 */
    uint16_t colour;      /* wire order */
    const uint16_t *ramp; /* FLAT and GOURAUD: PH_RAMP_SIZE colours, made by ph_material_ramp() */
    const struct ph_texture *texture;
    const struct ph_blend *blend; /* NULL: opaque */
};

/* A run of triangles of one material. */
struct ph_part {
    uint32_t first, count; /* in triangles */
    uint16_t material;     /* index into mesh->materials */
};

/* What passes over meshes whose bounds lie off the picture: an address, for struct ph_sphere. */
struct ph_culling;
extern const struct ph_culling ph_cull_spheres;
#define PH_CULL_SPHERES (&ph_cull_spheres)

/* A sphere around vertices, in the coordinates of their mesh, Q16.16. */
struct ph_sphere {
    struct fx_vec3 centre;
    fx_t radius;                      /* 0 or less: there is no sphere */
    const struct ph_culling *culling; /* PH_CULL_SPHERES: a program links the test if it names it. NULL: no test */
};

/* Triangles are counter-clockwise seen from outside. There are at most 65536 vertices. All data may lie in flash.
 * Until the last band is drawn these must stay: uvs, and what materials point to (ramps, textures with their texels,
 * blends with their alphas). All else, materials too, is copied where it is needed, and may change after the call.
 */
struct ph_mesh {
    const struct fx_vec3 *positions;
    const int16_t (*normals)[3]; /* Q1.14: 16384 = 1; NULL where nothing is lit */
    const fx_t (*uvs)[2];        /* Q16.16, 1.0 = the texture's width or height; NULL without texture */
    const uint16_t (*triangles)[3];
    const uint16_t (*edges)[2]; /* for PH_SHADE_WIRE; NULL if edge_count is 0 */
    const struct ph_part *parts;
    const struct ph_material *materials;
    uint32_t vertex_count, triangle_count, edge_count;
    uint16_t part_count;
    uint16_t material_count; /* in a checked build no part may have another material; 0: not told, and not checked */
    /* A colour for each vertex, wire order, in place of the colour and the ramp of materials that are UNLIT, FLAT or
     * GOURAUD; for a renderer whose config says PH_COLOURS, any other one refuses the mesh. It is interpolated on the
     * screen, also if it is UNLIT. NULL without. In linear-w a triangle has the colour of its first vertex. */
    const uint16_t *colours;
    /* Optional: what is off the picture is passed over before any vertex is looked at. bounds[0] is a sphere around all
     * corners; with several parts, bounds[1 + i] is one around those of part i. ph_mesh_bounds() makes them. The
     * picture is the same without bounds, unless a corner lies outside of them: in a checked build ph_draw_mesh()
     * refuses such a mesh. */
    const struct ph_sphere *bounds;
};

/* How many spheres a mesh of so many parts has. */
#define PH_BOUNDS(part_count) ((part_count) > 1 ? 1 + (part_count) : 1)

/*
 * Computes the bounds of a mesh into PH_BOUNDS(mesh->part_count) spheres, and makes them those of the mesh. A centre is
 * the middle of the box around the vertices, whatever their positions are, and a radius the distance of the farthest
 * one, rounded up; where it does not fit Q16.16 it is 0. A part without triangles has none; one of PH_SHADE_WIRE has
 * the sphere of the mesh.
 * Errors: PH_ERR_INVAL: bounds is NULL, or the mesh is one that ph_draw_mesh refuses; it stays as it was.
 * Cost:   a product of 64 bits for each coordinate, of the mesh and of each corner of its parts: for a mesh whose
 *         vertices stay, call it once.
 */
int ph_mesh_bounds(struct ph_mesh *mesh, struct ph_sphere *bounds);

#define PH_POINTS_MAX 65000 /* in a call */

/* Points, as of a point cloud or of particles: squares or discs that face the viewer. All arrays may lie in flash, and
 * may change after the call. */
struct ph_points {
    const struct fx_vec3 *positions; /* of their middles, object space */
    const uint16_t *colours;         /* of each point, wire order; NULL: all have the material's */
    const fx_t *sizes;               /* of each point, in place of `size`; or NULL */
    uint32_t count;                  /* at most PH_POINTS_MAX */
    fx_t size;     /* side of a square or diameter of a disc, Q16.16; a point of size 0 or below is left out */
    bool in_world; /* sizes are in world units, and on the picture they fall with the distance along the view (fisheye:
                      from the eye); else they are in pixels of the picture */
    bool round;    /* discs, else squares */
};

/* A kind of light: these names are addresses, and a program links what lights by those that its lights name. */
struct ph_light_kind;
extern const struct ph_light_kind ph_light_point, ph_light_spot;

/* Far away, at a point, at a point with a cone. */
#define PH_LIGHT_DIRECTIONAL ((const struct ph_light_kind *)NULL)
#define PH_LIGHT_POINT       (&ph_light_point)
#define PH_LIGHT_SPOT        (&ph_light_spot)

/* A light. */
struct ph_light {
    const struct ph_light_kind *kind; /* PH_LIGHT_... */
    fx_t intensity;                   /* 0 .. 4 */
    struct fx_vec3 to_light_q30; /* directional: unit vector towards the light, world space, Q2.30; spot: against its
                                    axis, from where it points to back to the light */
    struct fx_vec3 position;     /* point, spot: world space, Q16.16 */
    fx_t reach;                  /* point, spot: intensity falls as 1 / (1 + (distance / reach)^2); 0: does not fall */
    /* Coloured: shares of red, green and blue, 0 .. 1; all zero: white. With one coloured light in the scene, and
     * PH_COLOURS in the renderer's config, materials that are FLAT or GOURAUD take their `colour` (or the colours of
     * the mesh) three times lit, in place of the ramp: 1.5 to 2 times the work of a vertex and a pixel. Textures are
     * lit by the mean of the three, and so is everything without PH_COLOURS. */
    fx_t red, green, blue;
    fx_t cos_outer, cos_inner; /* spot: cosines of the angles to the axis at which it ends, and up to which it has its
                                  full intensity; between them intensity is linear in the cosine. -1 .. 1, what is
                                  beyond counts as the nearest */
};

#ifdef PH_PROFILE_SMALL
#define PH_LIGHTS_MAX 1
#else
#define PH_LIGHTS_MAX 4 /* of one scene; 1 in the small profile */
#endif

/* All lights of a scene. */
struct ph_scene_light {
    fx_t ambient; /* 0 .. 1 */
    uint32_t count;
    struct ph_light lights[PH_LIGHTS_MAX];
};

#ifdef __cplusplus
}
#endif

#endif
