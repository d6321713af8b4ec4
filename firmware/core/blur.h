/*
 * blur: depth of field. Pixels are blurred by their distance from the focal depth, which is read from
 * the depth buffer, band after band; there is no copy of the picture.
 *
 *   ph_frame_begin, ph_draw_..., ph_frame_bands as always
 *   ph_blur_begin(&blur, r, scratch, bytes, &focus)
 *   ph_blur_band(&blur, r, 0, pixels), ph_blur_band(&blur, r, 1, pixels) ..   instead of ph_draw_band
 *
 * Radius of the blur, as a thin lens has it: strength |1 - focal / z| in pixels, z the distance along the view (with
 * the fisheye: from the eye). So the background's blur tends to `strength`, at the focal distance all is sharp, at half
 * of it the radius is `strength` again. Orthographic: strength |z - focal| / (far - near). Empty pixels are infinitely
 * far away (orthographic: at the far plane). Below 1 px nothing is blurred.
 *
 * Two passes, along the lines and across them, each a weighted mean of at most 2 radius + 1 pixels. The nearer of two
 * pixels decides how far they mix. So a sharp object neither bleeds into a blurred background nor is smeared by it,
 * while a blurred foreground spreads over a sharp background and lets it shine through at its rim.
 *
 * Cost, measured with callgrind on x86-64 (gcc -O2, 240 x 240, nearly all of it blurred): 260 instructions a pixel at
 * radius 1, 630 at radius 4, 900 at radius 7; that is several times what it costs to draw the pixel. On a Cortex-M0+ it
 * is for stills or small pictures. No division, no 64-bit arithmetic per pixel.
 *
 * A line needs `radius` lines below it, so ph_blur_band draws ahead of what it gives out. The picture does not depend
 * on the band height.
 */
#ifndef PH_BLUR_H
#define PH_BLUR_H

#include "render.h"

#define PH_BLUR_RADIUS_MAX 7

/* Bytes of scratch memory: three for each pixel of two bands and two times `radius` lines. */
#define PH_BLUR_LINES(band_height, radius)        (2 * (size_t)(band_height) + 2 * (size_t)(radius))
#define PH_BLUR_BYTES(width, band_height, radius) (3 * (size_t)(width)*PH_BLUR_LINES(band_height, radius))

struct ph_focus {
    fx_t distance;  /* of what is sharp, along the view; > 0 */
    fx_t strength;  /* px, 0 .. 64: see above */
    uint8_t radius; /* px, 1 .. PH_BLUR_RADIUS_MAX: the largest, which costs time and memory */
};

/* Private to the blur. Points into scratch, not into itself. */
struct ph_blur {
    uint16_t *colours; /* lines blurred along, a ring of `lines` of them */
    int8_t *blurs;     /* radius in 1/16 px, positive before the focal plane */
    uint32_t lines;
    uint32_t next_band; /* of the renderer */
    uint32_t drawn;     /* lines of the picture in the ring, and before */
    uint8_t radius, depth_format;
    bool wide;           /* 4 bytes of depth a pixel */
    struct ph_lens lens; /* linear-w: from its codes back to distances */
    uint8_t most;        /* largest radius, 1/16 px */
    int8_t empty;        /* blur of empty pixels */
    int32_t focal_d;     /* depth of the focal plane, see blur.c */
    uint32_t per_d;      /* blur per depth */
    uint32_t limit;      /* difference of depth from which on the blur is the largest */
    uint16_t share[128]; /* of a neighbour, by radius */
};

/*
 * Call it after ph_frame_bands(). scratch: at least PH_BLUR_BYTES(width, band_height, radius), 2-byte aligned, the
 * caller's until the last band.
 * PH_ERR_INVAL: a value of focus out of its range, scratch NULL. PH_ERR_NOMEM: bytes too small.
 */
int ph_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                  const struct ph_focus *focus);

/* As ph_draw_band: the lines of band number `band`, all in order, each once; returns their number. */
uint32_t ph_blur_band(struct ph_blur *blur, struct ph_renderer *r, uint32_t band, uint16_t *pixels);

#endif
