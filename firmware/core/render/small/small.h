/*
 * small: the small profile, for chips of 16 to 32 KB of flash and 4 to 8 KB of RAM. Private to firmware/core.
 *
 * It draws meshes that are unlit, flat or Gouraud, under one directional light and ambient light, in a perspective or
 * an orthographic projection, with depth of fixed16: the same bytes as the whole library. The files of this folder
 * stand in place of those of render/, and take the arithmetic from them.
 *
 * No triangle is kept. A frame keeps its vertices, 10 bytes each, and a struct ph_small_part for each part of a mesh.
 * Each band goes through the triangles of all parts again, and sets those up that have a row in it. So a triangle is
 * set up once for each band that it touches, and all others are passed over there. What is clipped, or has a corner
 * beyond 255 pixels or left of or above the picture, is transformed again in each band.
 *
 * The arrays of a mesh and its materials must stay until the last band is drawn. Of the statistics `vertices`,
 * `triangles_in`, those of what is dropped, and `fragments` are counted.
 */
#ifndef PH_SMALL_H
#define PH_SMALL_H

#include "band.h"
#include "clip.h"
#include "exact.h"
#include "light.h"
#include "transform.h"

/* A vertex in the room of a frame. */
struct ph_small_vertex {
    uint16_t x, y;    /* 1/256 px; of a far vertex, which is transformed again: clip codes, light */
    uint16_t over[2]; /* N/w of depth.h in 2^-32, modulo 2^32: the lower half first */
    uint16_t light;   /* 0: it is far */
};

/* The triangles of a part of a mesh. */
struct ph_small_part {
    struct ph_clip_matrix matrix;
    const struct ph_material *material;
    const struct fx_vec3 *positions;
    const uint16_t (*triangles)[3];
    const struct ph_small_vertex *vertices;
    uint32_t count;
    struct ph_small_part *next;
};

/* Room to clip a triangle in. */
struct ph_small_clip {
    struct ph_clip_vertex work[2][PH_CLIP_MAX];
};

_Static_assert(sizeof(struct ph_small_vertex) == PH_VERTEX_BYTES_32, "see render.h");
_Static_assert(sizeof(void *) > 4 ||
                   (sizeof(struct ph_small_part) <= PH_PART_BYTES && sizeof(struct ph_small_clip) <= PH_CLIP_BYTES),
               "see render.h");

enum { PH_SMALL_NONE, PH_SMALL_OPEN, PH_SMALL_BANDS }; /* of a renderer: no frame, a frame, its bands are drawn */

/* Takes room of a frame for parts and for clipping, and for vertices. NULL: there is none. */
void *ph_small_room(struct ph_renderer *r, size_t bytes);
struct ph_small_vertex *ph_small_vertices(struct ph_renderer *r, uint32_t n);

/* The light of the frame for one mesh and one material, and that of a vertex. */
void ph_small_light_prepare(struct ph_local_lights *local, const struct ph_renderer *r, const struct ph_xform *to_world,
                            const struct ph_material *material);
uint16_t ph_small_light_vertex(const struct ph_local_lights *local, const int16_t normal[3]);

/* Clips the triangle in work[0][0 .. 2]. Returns the corners that are left, and in *corners their first. */
int ph_small_clip(const struct ph_lens *lens, struct ph_small_clip *clip, const struct ph_clip_vertex **corners);

/* Sets up a triangle that faces the viewer, and draws its rows in the band. False: its depth does not fit 32 bits;
 * then nothing is drawn, and ph_small_draw_exact draws it, if its corners have the depth that ph_transform gives. */
bool ph_small_draw(struct ph_renderer *r, const struct ph_material *material, const struct ph_band *band,
                   const struct ph_vertex *const v[3]);
void ph_small_draw_exact(struct ph_renderer *r, const struct ph_material *material, const struct ph_band *band,
                         const struct ph_vertex *const v[3]);

/* The plane of depth of a triangle, in 64 bits: see exact.h. */
void ph_small_set_exact(const struct ph_renderer *r, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                        struct ph_exact *e);

/* The plane of rows, if none of their depths leaves the range of the corners; else false. */
bool ph_small_exact_rows(const struct ph_exact *e, uint32_t bias, const struct ph_half_rows *rows, int32_t width,
                         struct ph_plane *run);

/* The plane of the next run of row y, from column x on. Returns its pixels, at least one. */
int32_t ph_small_exact_run(const struct ph_exact *e, uint32_t bias, int32_t x, int32_t x_end, int32_t y,
                           struct ph_plane *run);

#endif
