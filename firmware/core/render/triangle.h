/* triangle: a triangle after set-up. Private to firmware/core. */
#ifndef PH_TRIANGLE_H
#define PH_TRIANGLE_H

#include "render.h"

struct ph_band;
struct ph_triangle;

/* An edge that is walked from row to row. x is its 16.16 column at its first row; half a pixel is subtracted from it
 * and it is rounded up, so that the first pixel on its right has the column x >> 16. */
struct ph_edge {
    int32_t x, dx;
};

/* Rows y .. y_end - 1 between two edges, which are given at row y. */
struct ph_half_rows {
    int32_t y, y_end;
    struct ph_edge left, right;
};

/* A line, which is walked along its longer axis. */
struct ph_line {
    int32_t across,
        slope;            /* 16.16: its place across the axis at the centre of the next pixel, and the change a pixel */
    int16_t along, count; /* column or row of the next pixel; pixels left */
    int16_t step, x_major; /* of `along`: 1 or -1; whether x is the longer axis, else y */
};

/* A value that is linear on the screen: at the centre of pixel (0, 0), modulo 2^32, and per pixel right and down. */
struct ph_plane {
    uint32_t base, gx, gy;
};

static inline uint32_t ph_plane_at(const struct ph_plane *p, uint32_t x, uint32_t y)
{
    return p->base + p->gx * x + p->gy * y;
}

/*
 * A small Gouraud triangle. None of its spans leaves the picture or has more than PH_SMALL_COLUMNS pixels. Edges, depth
 * and light are given at column 0 of its first row. Below the upper rows the lower edge takes the place of the left or
 * of the right one. If the top of the triangle is flat, all of its rows count as upper rows.
 */
struct ph_small_triangle {
    uint32_t left_dx, right_dx, d_dy, light_dy; /* per row */
    uint32_t gd, glight;                        /* per column */
    const uint16_t *ramp;
    uint32_t left, right, d, light; /* edges as in ph_edge */
    struct ph_edge lower;
    uint16_t upper_rows, lower_rows; /* above 0; 0 or more */
    uint32_t lower_is_right;         /* 0, 1 */
    uint32_t knee;                   /* PH_KIND_SMALL_KNEE: below it codes are twice as steep as d */
};

/* The 16.16 code of a float. Across two octaves codes are one plane with a knee, where the far octave begins: where d
 * is below the knee its step is two codes. */
static inline uint32_t ph_knee_code(uint32_t d, uint32_t knee)
{
    return d < knee ? 2 * d - knee : d;
}

/* Steps edges, depth and light n rows down, within the upper rows or to their end. */
static inline void ph_small_step(struct ph_small_triangle *small, uint32_t n)
{
    small->left += n * small->left_dx;
    small->right += n * small->right_dx;
    small->d += n * small->d_dy;
    small->light += n * small->light_dy;
}

/* Goes on from the upper rows to the lower ones: the lower edge becomes the left or the right one. */
static inline void ph_small_lower(struct ph_small_triangle *small)
{
    uint32_t *const x = small->lower_is_right ? &small->right : &small->left;
    uint32_t *const dx = small->lower_is_right ? &small->right_dx : &small->left_dx;
    *x = (uint32_t)small->lower.x;
    *dx = (uint32_t)small->lower.dx;
    small->upper_rows = small->lower_rows;
    small->lower_rows = 0;
}

/* A depth plane of 64 bits: see exact.h. Pairs of words are 64 bits, the lower first. */
struct ph_exact {
    uint32_t base[2], gx[2], gy[2]; /* as in struct ph_plane */
    uint32_t low[2], size[2];       /* range of the corners */
    uint8_t coding;                 /* enum ph_depth_coding */
    uint8_t unit;                   /* codes are as steep as a depth in 2^-(56 - unit) is in octave 0 */
    int8_t down;                    /* linear-w: that of the lens; floats: bits of exponent less 1 */
};

/* Depth over a triangle that is not small, or over a line in any format. */
struct ph_depth {
    union {
        struct ph_plane plane;
        struct ph_exact exact; /* PH_BLOCK_EXACT */
    } as;
    union {
        struct ph_linear linear; /* linear-w: how 1/w, which is the plane, becomes codes */
        struct ph_plane plane;   /* other formats, textured: 1/w */
    } over_w;
};

/* A row of pixels or of depths, so many bytes further down. */
static inline uint16_t *ph_row_below(uint16_t *row, uint32_t bytes)
{
    return (uint16_t *)(void *)((uint8_t *)row + bytes);
}

/* The second-order part of u or v over a small triangle: xx x^2 + xy x y + yy y^2 for column x and row y. */
struct ph_curve {
    uint32_t xx, xy, yy;
};

/*
 * The sides over their area (twice the triangle's), times 2^shift: dy1, dy2, dx2, dx1, in this order. Let d1 and d2 be
 * the differences between the value at the second or third corner and that at the first. Then the gradient of the value
 * is x = (d2 dy1 - d1 dy2) / area = d2 a - d1 b and y = (d1 dx2 - d2 dx1) / area = d1 d - d2 c.
 */
struct ph_slopes {
    int32_t a, b, d, c;
    int32_t shift;
};

/* The most frequent come first: kernels and tests for them are shortest then. */
enum ph_kind {
    PH_KIND_SMALL,
    PH_KIND_SMALL_KNEE,
    PH_KIND_SMALL_SPLIT, /* depth crosses octaves; with PH_KIND_SMALL and PH_KIND_SMALL_KNEE it is a plane of codes */
    PH_KIND_SMALL_OWN,   /* what draws it stands in it: samples, whose rows are up to twice as long, dithered light,
                            colours. Depth may cross octaves */
    PH_KIND_SMALL_TEXTURE,
    PH_KIND_SMALL_TEXTURE_KNEE, /* only if PH_TEXTURE_KNEE */
    PH_KIND_FLAT,
    PH_KIND_GOURAUD,
    PH_KIND_TEXTURE,
    PH_KIND_COLOURS,
    PH_KIND_LINE,
    PH_KIND_ANY_LINE
};

/* How far a triangle exceeds a small one. */
enum ph_excess {
    PH_EXCESS_LARGE,  /* it is drawn as a large one */
    PH_EXCESS_ROWS,   /* in height and width */
    PH_EXCESS_NARROW, /* in height only */
};

/* What the texels of a triangle are drawn with. */
struct ph_texel_light {
    uint8_t light; /* 32nds, 0 .. 32, unless it is shaded */
    bool shaded;   /* light changes from pixel to pixel */
};

/* u and v over a small triangle; these and the curves count from pixel (x, y_top + y), that of the first corner. */
struct ph_small_map {
    int16_t x;
    int8_t y;
    bool fast; /* ph_texture_small can draw it */
    struct ph_texel_light light;
    uint8_t level;        /* of the map */
    struct ph_plane u, v; /* the linear part */
    struct ph_curve u_curve, v_curve;
};

/* u and v over a triangle that is drawn in tiles: u/w and v/w; 1/w is in its struct ph_depth. */
struct ph_map {
    struct ph_texel_light light;
    uint8_t range_log2; /* |u|, |v| are below 2^this */
    struct ph_plane u, v;
    struct ph_plane shades; /* if it is shaded: see ph_texel_light_of */
};

/* A triangle whose rows are small ones. */
struct ph_small {
    struct ph_small_triangle rows; /* textured: light is that of the texels, and there is no ramp; colours: light is red
                                      and blue, see ph_pixel_colour */
    union {
        struct ph_slopes slopes; /* no ramp, from ph_setup_small to ph_setup_texels or ph_set_small_colours */
        struct ph_small_map map; /* PH_KIND_SMALL_TEXTURE.. */
        struct {
            struct ph_plane green; /* of colours, beside light: at column 0 of the first row */
            uint32_t (*draw)(const struct ph_triangle *t, const struct ph_band *band); /* the rows in a band */
        } own;                                                                         /* PH_KIND_SMALL_OWN */
    } of;
};

/* A triangle that is not small. */
struct ph_large {
    uint8_t long_left; /* the long edge is the left one */
    int16_t y_mid;     /* where the short edges meet */
    struct ph_edge long_edge, upper, lower;
    union {
        uint16_t colour;            /* PH_KIND_FLAT: wire order */
        struct ph_plane light;      /* PH_KIND_GOURAUD */
        struct ph_plane colours[3]; /* PH_KIND_COLOURS: red, green, blue */
        struct ph_map map;          /* PH_KIND_TEXTURE */
    } of;
    struct ph_depth depth;
};

/* A triangle or a line in a slot. Its kind says which arm of `as` it has: PH_KIND_SMALL.. small, PH_KIND_LINE and
 * PH_KIND_ANY_LINE line, others large. */
struct ph_triangle {
    uint32_t order;          /* number of its reference */
    int16_t y_top, y_bottom; /* rows y_top .. y_bottom - 1 */
    struct ph_triangle *next;
    const struct ph_material *material;
    uint8_t kind;  /* enum ph_kind */
    uint8_t block; /* FLOAT16 and FLOAT24, depth that crosses octaves: see ph_block_of; or one of PH_BLOCK_... */
    union {
        struct {
            const struct ph_draw *draw;
            struct ph_triangle *before;
        } listed; /* until it is set up: the draw of its reference, and the triangle before it in its list */
        struct ph_small small;
        struct ph_large large;
        struct {
            struct ph_line way;
            uint16_t colour; /* wire order */
            union {
                struct {
                    uint32_t d, gd;  /* of the next pixel, and its change a pixel */
                } codes;             /* PH_KIND_LINE: 16.16 codes */
                struct ph_depth any; /* PH_KIND_ANY_LINE */
            } depth;
            const struct ph_lines *lines; /* draws it */
        } line;
    } as;
};

#define PH_NONE          UINT32_MAX
#define PH_SMALL_COLUMNS 32
#define PH_DEPTH_WRAPPED 0xffc00000u /* d from here on has fallen below 0: the nearest d and its head room are less */
#define PH_BLOCK_NONE    255         /* depth is stepped in 16.16 codes */
#define PH_BLOCK_LINEAR  254         /* linear-w: 1/w is stepped */
#define PH_BLOCK_EXACT   253         /* depth stands in `exact` */

/* A block exponent, 0 .. 60, and the float's bits of exponent less 1 (ph_lens.float_down, 2 .. 5), in a byte. */
static inline uint8_t ph_block_of(int exponent, int down)
{
    return (uint8_t)(exponent + 64 * (down - 2));
}

static inline int ph_block_exponent(int block)
{
    return block & 63;
}

static inline int ph_block_down(int block)
{
    return 2 + (block >> 6);
}

/* A depth d or its gradient, rounded so that no bit of it is lost when it is shifted down to codes. */
static inline uint32_t ph_block_rounded(uint32_t d, int block)
{
    const int down = ph_block_down(block);
    return (d + ((uint32_t)1 << down >> 1)) >> down << down;
}

#endif
