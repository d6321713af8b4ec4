/*
 * dither: light without bands.
 *
 * RGB565 has 32 steps of red and of blue. Where light changes slowly, each step is a band that the eye sees: slow
 * gradients are 1.2 to 1.7 off (RMS, CIE76 after a blur of 1 pixel), and in places over 2.3, which is called
 * noticeable. In dithered light neighbouring pixels round the same colour differently, so that their mean is right: it
 * is .3 to .5 off, and nowhere 2.3 (tests/core/test_dither.c).
 *
 * What is dithered: PH_SHADE_GOURAUD with a ramp that ph_material_ramp() has made, in depth of 16 bits but linear-w.
 * All else is as without: FLAT, textures, colours of vertices, coloured light, other ramps, depth of 24 bits. An
 * antialiased picture cannot be dithered, and the small profile has no dither.
 *
 * How: pixel (x, y) has step k = (3 x + 7 y) mod 8 of an ordered dither, whose thresholds lie on a lattice that is tied
 * to the screen. So a frame that stands still has pixels that stand still, and neither bands nor cores change a byte. A
 * ramp becomes 8, one behind the other, each of which rounds at the threshold of its step. The plane of light has k in
 * its top 3 bits, above the entry of the ramp. k is linear in x and y modulo 8 as planes are modulo 2^32, so a pixel
 * takes no instruction more.
 *
 *   static struct ph_dithered_ramp ramps[3];
 *   static struct ph_dither dither = {.ramps = ramps, .ramp_max = 3};
 *   ph_renderer_init(&r, &config);
 *   ph_dither(&r, &dither);
 */
#ifndef PH_DITHER_H
#define PH_DITHER_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

#define PH_DITHER_STEPS 8

/* The ramps of all steps; those of step 0 are the material's own colours. Private. */
struct ph_dithered_ramp {
    const uint16_t *ramp; /* the material's; NULL: none yet */
    uint32_t frame;       /* the last one that had it */
    uint16_t colours[PH_DITHER_STEPS * PH_RAMP_SIZE];
};

/* The caller sets ramps and ramp_max; all else begins as zeros. */
struct ph_dither {
    uintptr_t calls[6];             /* private */
    struct ph_dithered_ramp *ramps; /* room for dithered ramps, which begins as zeros */
    uint32_t ramp_max;              /* so many: one for each ramp that a frame has in GOURAUD */
    uint32_t left_out;              /* materials of the last frame that are not dithered: there was no room */
    uint32_t frame;                 /* private */
};

/*
 * Dithers the frames that r draws from now on. Call it between two frames.
 * In:     dither and its ramps must stay as long as r uses them. NULL: dithers no more.
 * Cost:   2,056 bytes a ramp. On a Cortex-M0+ some 35 instructions a triangle (20 on an M3), 1,500 a ramp and frame,
 * and some 300,000 at the first sight of a ramp or of new colours in it: 2 to 3 % of a frame
 *         (tests/bench/long_dither.sh). A program without it links nothing of it.
 * Errors: PH_ERR_INVAL: r is NULL or antialiases, or dither has no ramps. r stays as it was.
 */
int ph_dither(struct ph_renderer *r, struct ph_dither *dither);

#ifdef __cplusplus
}
#endif

#endif
