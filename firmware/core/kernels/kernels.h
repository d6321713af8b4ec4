/*
 * kernels: the loops in which a frame's time goes, each in a file of its own. Private to firmware/core.
 *
 * The file in core/ is the portable form. core/armv6m and core/armv7m have the same function in assembly, core/x86_64
 * some of them in C with vectors or with two values in a word. All give the same result bit for bit
 * (tests/core/test_kernels.sh), so whoever changes the arithmetic here changes it there. Assembly takes at most 80
 * bytes of stack and calls nothing outside its file.
 */
#ifndef PH_KERNELS_H
#define PH_KERNELS_H

#include "matvec.h"
#include "pipeline.h"

#include <stddef.h>

/*
 * vertices.c: vertices of a mesh under a perspective, as ph_transform leaves them, their light being full. It goes from
 * `from` to `end`, or to the first one that asks for more: that does not lie between near plane and far, or not in the
 * guard band (`at` is that one then, before the divide), or that rows does not hold. from and to then stand at it.
 */
struct ph_vertex_run {
    const struct fx_vec3 *from, *end;
    struct ph_vertex *to;
    uint32_t codes;           /* grows by the clip codes of each */
    uint32_t near, range;     /* w is near .. near + range, below 2^28: it has 4 leading zeros or more */
    int64_t round_x, round_y; /* 2^32 times what is added to x / w, y / w in 2^-25 before `down` */
    uint32_t depth_scale;     /* as in the lens */
    int32_t near_shift;       /* as in the lens */
    uint32_t right, bottom;   /* of the picture, 1/256 px */
    uint32_t guard_up, down;  /* as in the lens; from 2^-25 to 1/256 px, 1 .. 17 */
    struct ph_matvec rows;
    struct fx_vec3 at;
};

void ph_vertices(struct ph_vertex_run *run);

/*
 * cull.c: the next triangle that may be seen: whose corners are without clip codes and run counter-clockwise, or have
 * some but are not all outside of one plane. Corners without codes are at most 2^18 apart each way.
 */
struct ph_cull_run {
    const struct ph_vertex *vertices;
    const uint16_t (*index)[3], (*end)[3]; /* what is still to be visited */
    uint32_t codes;                        /* 0 where no vertex has any */
    const struct ph_vertex *v[3];          /* of the triangle, which is index[-1] */
    struct ph_sides sides;                 /* the same; only where no corner has a code; area 1 where it is not small */
};

/* False where there is none. */
bool ph_cull(struct ph_cull_run *visit);

/* fill.c: n times a value. */
void ph_fill(uint16_t *to, uint16_t value, uint32_t n);

/*
 * span_flat.c, span_gouraud.c: n >= 1 pixels in one colour, or along a ramp of 128 colours; d: depth at the
 * first, 16.16 code, gd: per pixel; light: its top 7 bits are the entry of the ramp.
 */
void ph_span_flat(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint16_t colour);
void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t light,
                     uint32_t glight, const uint16_t *ramp);

/*
 * setup_small.c: edges and planes of a triangle that faces the viewer, sides below PH_SMALL, a pixel and more from the
 * borders of the picture: all of t->rows but the ramp, t->y_top and t->y_bottom. d: depth of its corners, of which
 * no two are 2^31 apart. False, and nothing in t, where it has no row.
 */
bool ph_setup_small(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                    const uint32_t d[3]);

/*
 * float_depths.c: 16.16 codes of float16 of a triangle's corners, none behind the far plane, plus `bias`, where all lie
 * in one octave that is not the lowest: then a float is no different from the fixed formats. Else false.
 */
bool ph_float_depths(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias, uint32_t d[3]);

/*
 * small_gouraud.c: all rows of a small triangle, its first one at depth and pixels. Returns the number of its pixels.
 */
uint32_t ph_small_gouraud(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                          uint32_t stride_bytes);

/*
 * texture_tile.c: rows of a textured triangle within a tile (texture.c) of at most PH_TILE columns. Along a row u and v
 * follow a parabola, at + i step + i^2 bend at column i; from row to row its coefficients change by second differences.
 * All of it is modulo 2^32. Two pixels share a step, the mean of what the parabola does over both: the step changes
 * half as often, and every second pixel lies on the parabola. Pairs are counted from the row's last pixel, because
 * unrolled loops are entered in the middle and end there; in a row of odd length the first pixel is the second of a
 * pair, and those behind it are off by one bend.
 */
#define PH_TILE 32

struct ph_texel_way {
    uint32_t at, step, bend;          /* of the row */
    uint32_t at_dy, step_dy, bend_dy; /* what they grow by to the row below */
    uint32_t at_ddy, step_ddy;        /* what that grows by */
};

struct ph_texel_rows {
    uint32_t left, right; /* at the row: edges as in ph_edge, from column 0 of the tile on */
    uint32_t left_dx, right_dx;
    uint32_t d, d_dy;         /* depth at column 0, 16.16 code, and per row */
    uint16_t *depth, *pixels; /* of column 0 */
    uint32_t stride_bytes;    /* from row to row, of both */
    uint32_t gd;              /* depth per column */
    uint32_t u_mask, v_mask;  /* of the column's and the row's bits in the index of a texel */
    const uint16_t *texels;
    uint32_t columns; /* of the tile that are in the picture: 1 .. PH_TILE */
    uint32_t rows, count;
    uint32_t u_outside, v_outside; /* bits that u and v have outside a clamped texture; both 0 where it is no matter */
    struct ph_texel_way u, v;      /* u: texel columns in 2^-22; v: texel rows times the texture's width in 2^-16 */
};

/*
 * Draws them; rows > 0. It stops before a row that begins or ends outside a clamped texture. Afterwards everything
 * stands at the next row, rows is how many are left, and count has grown by the pixels.
 */
void ph_texture_tile(struct ph_texel_rows *r);

/* Coefficients of the next row. */
static inline void ph_texel_way_down(struct ph_texel_way *w)
{
    w->at += w->at_dy;
    w->step += w->step_dy;
    w->bend += w->bend_dy;
    w->at_dy += w->at_ddy;
    w->step_dy += w->step_ddy;
}

static inline uint32_t ph_texel_at(const struct ph_texel_way *w, uint32_t i)
{
    return w->at + i * (w->step + i * w->bend);
}

_Static_assert(sizeof(void *) != 4 || offsetof(struct ph_vertex_run, rows) == 64, "assembly relies on it");
_Static_assert(sizeof(void *) != 4 || (offsetof(struct ph_cull_run, sides) == 28 && sizeof(struct ph_sides) == 24),
               "assembly relies on it");
_Static_assert(sizeof(void *) != 4 ||
                   (offsetof(struct ph_triangle, small) == 20 && offsetof(struct ph_sides, area) == 16 &&
                    offsetof(struct ph_vertex, light) == 14 && offsetof(struct ph_lens, far_s) == 36),
               "assembly relies on it");
_Static_assert(sizeof(void *) != 4 || offsetof(struct ph_small_triangle, lower_is_right) == 56,
               "assembly relies on it");
_Static_assert(sizeof(void *) != 4 || offsetof(struct ph_texel_rows, u) == 72, "assembly relies on it");

#endif
