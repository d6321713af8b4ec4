/*
 * blur: depth of field. Each pixel is blurred by its distance from the focal plane, which is read from the depth
 * buffer, band after band. There is no copy of the picture.
 *
 *   ph_frame_begin, ph_draw_..., ph_frame_bands as always
 *   ph_blur_begin(&blur, r, scratch, bytes, &focus)
 *   ph_blur_band(&blur, r, 0, pixels), ph_blur_band(&blur, r, 1, pixels) ..   instead of ph_draw_band
 *
 * The radius of the blur is that of a thin lens: strength |1 - focal / z| pixels, where z is the distance along the
 * view (fisheye: from the eye). It is 0 at the focal distance and `strength` at half of it, and tends to `strength` far
 * away. With an orthographic camera it is strength |z - focal| / (far - near). Empty pixels count as infinitely far
 * away (orthographic: as at the far plane). A radius below 1 px blurs nothing.
 *
 * There are two passes, along the lines and across them. Each takes a weighted mean of at most 2 radius + 1 pixels, and
 * the nearer of two pixels decides how far they mix. So a sharp object neither bleeds into a blurred background nor is
 * smeared by it, while a blurred foreground spreads over a sharp background, which shines through at its rim.
 *
 * A line needs `radius` lines below it, so ph_blur_band draws ahead of what it returns. The picture does not depend on
 * the band height.
 *
 * Cost, measured with callgrind on x86-64 (gcc -O2, 240 x 240, nearly all of it blurred): 260 instructions a pixel at
 * radius 1, 630 at radius 4, 900 at radius 7, which is several times the cost of drawing. On a Cortex-M0+ it suits
 * stills and small pictures. It takes no division and no 64-bit arithmetic per pixel.
 */
#ifndef PH_BLUR_H
#define PH_BLUR_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PH_BLUR_RADIUS_MAX 7 /* px */

/* Scratch memory: three bytes for each pixel of two bands and 2 radius lines. */
#define PH_BLUR_LINES(band_height, radius)        (2 * (size_t)(band_height) + 2 * (size_t)(radius))
#define PH_BLUR_BYTES(width, band_height, radius) (3 * (size_t)(width)*PH_BLUR_LINES(band_height, radius))

/* A lens with depth of field. */
struct ph_focus {
    fx_t distance;  /* focal distance along the view, > 0 */
    fx_t strength;  /* px, 0 .. 64: see the head of this file */
    uint8_t radius; /* largest radius, px, 1 .. PH_BLUR_RADIUS_MAX; it decides time and memory */
};

/* Private to the blur. It points into scratch, not into itself. */
struct ph_blur {
    uint16_t *colours; /* lines after the first pass, a ring of `lines` of them */
    int8_t *blurs;     /* radius in 1/16 px, positive before the focal plane */
    uint32_t lines;
    uint32_t next_band;     /* the renderer's next band */
    uint32_t drawn;         /* lines of the picture that have entered the ring */
    uint8_t radius, coding; /* coding: enum ph_depth_coding */
    bool wide;              /* depth has 4 bytes a pixel */
    struct ph_lens lens;    /* for linear-w: turns codes back into distances */
    uint8_t most;           /* largest radius, 1/16 px */
    int8_t empty;           /* blur of empty pixels */
    int32_t focal_d;        /* depth of the focal plane, see blur.c */
    uint32_t per_d;         /* blur per unit of depth */
    uint32_t limit;         /* from this difference of depth on the blur is the largest */
    uint16_t share[128];    /* weight of a neighbour, by its radius in 1/16 px */
};

/*
 * Prepares the blur of a frame; call it after ph_frame_bands().
 * In:     scratch has at least PH_BLUR_BYTES(width, band_height, radius), is 2-byte aligned and stays in use until the
 *         last band is drawn.
 * Errors: PH_ERR_INVAL: a value of focus is out of its range, or scratch is NULL. PH_ERR_NOMEM: bytes is too small.
 */
int ph_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                  const struct ph_focus *focus);

/*
 * The blur at a distance: its radius in 1/16 px, rounded down, positive before the focal plane. A pixel there may have
 * 1/16 px less or more, because its depth code is rounded.
 * In:     blur has begun; z, from the near to the far plane, is a distance along the view (fisheye: from the eye).
 */
int32_t ph_blur_at(const struct ph_blur *blur, fx_t z);

/* Gives band number `band` as ph_draw_band does: call it for all bands in order, each once. Returns its lines. */
uint32_t ph_blur_band(struct ph_blur *blur, struct ph_renderer *r, uint32_t band, uint16_t *pixels);

#ifdef __cplusplus
}
#endif

#endif
