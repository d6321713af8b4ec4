/*
 * kernels: the loops in which a frame's time goes. Each is in a file of its own. Private to firmware/core.
 *
 * portable/ has every kernel in C. armv6m/ and armv7m/ have the same functions in assembly, rv32/ has most of them,
 * x86_64/ has some of them in C with vectors or with two values in a word. All give the same result bit for bit
 * (tests/core/test_kernels.sh), so a change of the arithmetic in one is a change in all. Assembly takes at most 100
 * bytes of stack, calls nothing but kernels and what stands in their files, and knows the structs by offsets.inc.
 *
 * Kernels with a type of their own have a header: vertices.h, cull.h, pairs.h, texture_tile.h, texture_small.h.
 */
#ifndef PH_KERNELS_H
#define PH_KERNELS_H

#include <stdbool.h>
#include <stdint.h>

struct ph_fog_mix;
struct ph_lens;
struct ph_material;
struct ph_ref;
struct ph_sides;
struct ph_small;
struct ph_small_triangle;
struct ph_triangle;
struct ph_vertex;

/* fill.c: stores a value n times. */
void ph_fill(uint16_t *to, uint16_t value, uint32_t n);

/* span_flat.c: n >= 1 pixels in one colour. d is the depth at the first pixel, a 16.16 code, and gd its step per pixel.
 */
void ph_span_flat(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint16_t colour);

/* span_blend.c: n >= 1 pixels of one colour are blended, and depth stays. Each channel becomes (itself * rest + source)
 * / 32, rounded down; source is spread as in blend.h, and rest is 0 .. 32. d is the depth at the first pixel, a 16.16
 * code, and gd its step per pixel. */
void ph_span_blend(uint16_t *pixels, const uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd, uint32_t source,
                   uint32_t rest);

/* span_seen.c: how many pixels, of the first ones of n, are seen: their codes are above the depth, or as much, if
 * `same`; or how many are not, if not `seen`. */
uint32_t ph_span_seen(const uint16_t *codes, const uint16_t *depth, uint32_t n, bool same, bool seen);

/* fog_alike.c: how many depth codes, of the first ones of n, are from .. from + size - 1, modulo 2^32. Their pixels are
 * fogged, unless mix is NULL. */
uint32_t ph_fog_alike(uint16_t *pixels, const uint16_t *codes, uint32_t n, uint32_t from, uint32_t size,
                      const struct ph_fog_mix *mix);

/* What ph_line_pixels takes of a line. */
struct ph_line_run {
    int32_t slope;   /* 16.16: change of `across` a pixel */
    uint32_t gd;     /* change of d */
    int32_t forward; /* pixels of memory from a pixel to the next one along the longer axis */
    uint32_t colour;
    int32_t across; /* 16.16: column or row of the first pixel, across the longer axis */
    uint32_t d;     /* its depth, a 16.16 code */
    int32_t stride; /* pixels of memory from a column or row to the next one */
};

/* line_pixels.c: n >= 1 pixels of a line. pixels, depth: where the first one stands if its column or row is 0. */
void ph_line_pixels(const struct ph_line_run *run, uint16_t *pixels, uint16_t *depth, uint32_t n);

/* halve.c: n pixels, each the mean of 2 x 2 samples in two rows; every channel is rounded to nearest. */
void ph_halve(uint16_t *to, const uint16_t *upper, const uint16_t *lower, uint32_t n);

/*
 * setup_small.c: edges and planes of a small triangle. It faces the viewer, its sides are below PH_SIDE_SMALL (or below
 * PH_SIDE_SHORT downwards), and it keeps a pixel or more away from the borders of the picture. d
 * is the depth of its corners; no two are 2^31 apart. Sets y_top, y_bottom and all of as.small.rows but the ramp. If
 * the ramp is NULL, the triangle is textured: slopes are set in place of the plane of light. If depth changes by
 * more than 2^25 a pixel, or if the triangle is thin, the 15 bits of a difference that are kept here would show: then
 * d, gd and d_dy are left to the caller.
 */
enum ph_small_setup {
    PH_SMALL_NO_ROW, /* the triangle has no row, and nothing is set */
    PH_SMALL_SET,
    PH_SMALL_STEEP, /* all is set but depth */
};

enum ph_small_setup ph_setup_small(struct ph_triangle *t, const struct ph_vertex *const v[3],
                                   const struct ph_sides *sides, const uint32_t d[3]);

/* float_depths.c: 16.16 codes of float16 of a triangle's corners, plus `bias`, if all three lie in one octave that is
 * not the lowest: there a float is a fixed number with another slope. Else false. No corner is behind the far plane. */
typedef bool ph_codes_kernel(const struct ph_lens *lens, const struct ph_vertex *const v[3], uint32_t bias,
                             uint32_t d[3]);
ph_codes_kernel ph_float_depths;

/* What ph_setup_fast takes of the references of a draw. */
struct ph_fast {
    const struct ph_vertex *base;      /* corner 0 */
    uint32_t margin, inner_x, inner_y; /* inner: as in the renderer, for this margin (side + 256); neither is 0 */
    uint32_t side;                     /* PH_SIDE_SMALL or PH_SIDE_SHORT: the sides that it takes are below it */
    const struct ph_lens *lens;        /* NULL: fixed16 */
    uint32_t bias;                     /* for set_codes; fixed16: what is added to N/w (depth.h) */
    const uint16_t *ramp;
    const struct ph_material *material;
    ph_codes_kernel *set_codes; /* ph_float_depths; fixed16: not called */
};

/* setup_small.c: sets up a listed triangle as ph_setup_small does, if its sides from the first corner and their
 * difference across are below `side`, it is off the borders as there, and ph_float_depths can tell its depth, or it is
 * fixed16. Sets kind, block, material and ramp, too, and writes over the rest of t but order. If it does not return
 * PH_SMALL_SET, something of that is not so, or ph_setup_small leaves depth to the caller.
 */
enum ph_small_setup ph_setup_fast(const struct ph_fast *fast, const struct ph_ref *ref, struct ph_triangle *t);

/* Draws rows of a triangle; depth, pixels: of column 0 of the first one. Returns their pixels. */
typedef uint32_t ph_gouraud_kernel(const struct ph_small_triangle *rows, uint16_t *depth, uint16_t *pixels,
                                   uint32_t stride_bytes);

/* small_gouraud.c: draws a small triangle. No code is 0 (depth.h has head room), so where the depth is 0 the triangle
 * can be seen. */
ph_gouraud_kernel ph_small_gouraud;

/* long_gouraud.c: draws at most PH_LONG_ROWS rows of any triangle, or all of one whose sides are below PH_SIDE_SHORT,
 * as ph_small_gouraud does. Its rows are cut to the picture; they may be longer than PH_SMALL_COLUMNS. */
#define PH_LONG_ROWS 16
ph_gouraud_kernel ph_long_gouraud;

/* small_knee.c: draws a triangle of PH_KIND_SMALL_KNEE as ph_small_gouraud does one without a knee. */
ph_gouraud_kernel ph_small_knee;

/* small_dithered.c, long_dithered.c, knee_dithered.c: draw what ph_small_gouraud, ph_long_gouraud and ph_small_knee
 * draw, but along a ramp of PH_DITHER_STEPS * PH_RAMP_SIZE colours (ph_dither). */
ph_gouraud_kernel ph_small_dithered, ph_long_dithered, ph_knee_dithered;

/* small_colours.c: draws a small triangle as ph_small_gouraud does, in colours whose planes are light (red and blue)
 * and of.own.green; see ph_pixel_colour. Its rows may have any number of pixels. */
uint32_t ph_small_colours(const struct ph_small *small, uint16_t *depth, uint16_t *pixels, uint32_t stride_bytes);

/* The entry of the ramp is light >> this: the top 7 bits of light, or 10 of a ramp that is dithered. */
#define PH_LIGHT_DOWN    25
#define PH_DITHERED_DOWN 22

#endif
