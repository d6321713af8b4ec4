/*
 * span: pixels, runs of pixels, and how depth becomes codes along them. The loops in which the time goes are in
 * kernels.h. Private to firmware/core.
 *
 * d is a 16.16 number whose high half is the depth code (depth.h). A pixel is drawn if its code is above the stored
 * one.
 */
#ifndef PH_SPAN_H
#define PH_SPAN_H

#include "colour.h"
#include "depth.h"
#include "kernels.h"
#include "triangle.h"

/* Keeps the branch round the two stores of a pixel. Compilers for Thumb-2 would make the stores conditional instead,
 * and a hidden pixel would pay for instructions that do nothing. */
#define PH_KEEP_BRANCH() __asm__ volatile("")

static inline void ph_pixel_flat(uint16_t *pixel, uint16_t *depth, uint32_t d, uint16_t colour)
{
    const uint32_t code = d >> 16;
    if (code > *depth) {
        PH_KEEP_BRANCH();
        *depth = (uint16_t)code;
        *pixel = colour;
    }
}

/* The top bits of light are the entry of the ramp, so no read leaves the ramp, whatever light is. light_down:
 * PH_LIGHT_DOWN, or PH_DITHERED_DOWN for a ramp that is dithered. */
static inline void ph_pixel_gouraud(uint16_t *pixel, uint16_t *depth, uint32_t d, uint32_t light, const uint16_t *ramp,
                                    unsigned light_down)
{
    const uint32_t code = d >> 16;
    if (code > *depth) {
        PH_KEEP_BRANCH();
        *depth = (uint16_t)code;
        *pixel = ramp[light >> light_down];
    }
}

#define PH_GREEN_LOG2 11 /* see ph_pixel_colour */

/* A colour in wire order. Each channel has 16 bits: red and blue are the halves of a word, the upper and the lower one,
 * and green is bits 11 to 26 of another, whose other bits are arbitrary. The upper bits of a channel are shown. */
static inline uint16_t ph_pixel_colour(uint32_t red_blue, uint32_t green)
{
    const uint32_t c = (red_blue & 0xf800f800u) * 33 | (green & 0x07e00000u); /* its upper half */
    if (ph_wire16(1) == 1) {
        return (uint16_t)(c >> 16);
    }
    const uint32_t wire = c >> 24 | (c >> 8 & 0xff00) | (c & 0xff00) << 8 | c << 24; /* an instruction, on most CPUs */
    return (uint16_t)wire;
}

/* Two planes of 16 bits, or what belongs to them, in one of 32. */
static inline uint32_t ph_red_blue(uint32_t red, uint32_t blue)
{
    return (red << 16) + blue;
}

/* Stores a depth if it is nearer. True if it was. */
static inline bool ph_nearer16(uint16_t *depth, uint32_t d)
{
    const uint32_t code = d >> 16;
    if (code <= *depth) {
        return false;
    }
    *depth = (uint16_t)code;
    return true;
}

/* Stores a 24-bit depth code if it is nearer. True if it was. */
static inline bool ph_nearer24(uint32_t *depth, uint32_t d)
{
    const uint32_t code = d >> 8;
    if (code <= *depth) {
        return false;
    }
    PH_KEEP_BRANCH();
    *depth = code;
    return true;
}

static inline void ph_pixel_flat24(uint16_t *pixel, uint32_t *depth, uint32_t d, uint16_t colour)
{
    if (ph_nearer24(depth, d)) {
        *pixel = colour;
    }
}

static inline void ph_pixel_gouraud24(uint16_t *pixel, uint32_t *depth, uint32_t d, uint32_t light,
                                      const uint16_t *ramp)
{
    if (ph_nearer24(depth, d)) {
        *pixel = ramp[light >> PH_LIGHT_DOWN];
    }
}

/* Draws a span in one colour with 24-bit depth: an odd pixel first, then two in each turn. */
static inline void ph_span_flat24(uint16_t *pixels, uint32_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                                  uint16_t colour)
{
    if ((n & 1) != 0) {
        ph_pixel_flat24(pixels++, depth++, d, colour);
        d += gd;
    }
    for (n >>= 1; n > 0; n--, d += gd, pixels += 2, depth += 2) {
        ph_pixel_flat24(pixels, depth, d, colour);
        d += gd;
        ph_pixel_flat24(pixels + 1, depth + 1, d, colour);
    }
}

static inline void ph_span_gouraud24(uint16_t *pixels, uint32_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                                     uint32_t light, uint32_t glight, const uint16_t *ramp)
{
    if ((n & 1) != 0) {
        ph_pixel_gouraud24(pixels++, depth++, d, light, ramp);
        d += gd;
        light += glight;
    }
    for (n >>= 1; n > 0; n--, d += gd, light += glight, pixels += 2, depth += 2) {
        ph_pixel_gouraud24(pixels, depth, d, light, ramp);
        d += gd;
        light += glight;
        ph_pixel_gouraud24(pixels + 1, depth + 1, d, light, ramp);
    }
}

/* Draws a span along a ramp of colours; d is a 16.16 code. light_down: as for a pixel. */
static inline void ph_span_gouraud(uint16_t *pixels, uint16_t *depth, uint32_t n, uint32_t d, uint32_t gd,
                                   uint32_t light, uint32_t glight, const uint16_t *ramp, unsigned light_down)
{
    for (; n > 0; n--, d += gd, light += glight) {
        ph_pixel_gouraud(pixels++, depth++, d, light, ramp, light_down);
    }
}

/* A run of pixels along which the depth code is linear: the 16.16 code at its first pixel, and its step. */
struct ph_piece {
    uint32_t d, gd;
};

/* raster_walk.c: the run of *n pixels that begins with depth d, in units of the triangle's plane. If the depth is a
 * float and crosses octaves, *n is cut down to the pixels in the first one. */
struct ph_piece ph_depth_piece(const struct ph_triangle *t, uint32_t d, uint32_t *n);

/* An octave of a triangle's d, bottom .. bottom + size - 1. It is kept: the next row mostly lies in it, too. */
struct ph_octave {
    uint32_t bottom, size, offset, slope;
    int up; /* from d to codes; a nearer octave has a smaller one */
};

/* raster_rows.c: the octave in which d lies; its size is 0 if d has wrapped. Without octaves to cross it is the whole
 * range. */
void ph_octave_of(struct ph_octave *o, const struct ph_triangle *t, uint32_t d, uint32_t gd);

static inline bool ph_octave_holds(const struct ph_octave *o, uint32_t first, uint32_t last)
{
    return first - o->bottom < o->size && last - o->bottom < o->size;
}

/* The code of a d in the octave; a d that has wrapped counts as 0. */
static inline uint32_t ph_depth_float16_code(const struct ph_octave *o, uint32_t d)
{
    return ph_depth_float16_value(o->size > 0 ? d : 0, o->up) + o->offset;
}

#endif
