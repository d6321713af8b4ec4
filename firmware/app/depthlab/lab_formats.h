/*
 * lab_formats: the depth formats that the depth lab compares: the renderer's own, and those of other renderers. They
 * store the distance w between the planes n and f in a code up to S = 2^bits - 1.
 *
 * Formats of other renderers; every named quantity is a Q16.16 number that saturates:
 *   scale = f / (f - n) and bias = f n / (f - n) to the nearest, clip = scale w - bias, the product to the nearest;
 *   ndc-q16    ndc = clip / w towards 0; the code is ndc shifted, up to S
 *   recip-q16  r = 1 / w rounded down; ndc = clip r to the nearest; likewise
 *   clip-q16   the code is S clip / w to the nearest, in 64 bits
 *   log        S ln(f / w) / ln(f / n) rounded down: no code of as many bits does better in dz/z
 * Their codes are reversed, so that a larger code is nearer here, too. Two more for comparison:
 *   linear-w   with 24 bits: S (f - w) / (f - n) rounded down
 *   over-w     n/w as an unsigned float with 4 bits of exponent, rounded down
 */
#ifndef LAB_FORMATS_H
#define LAB_FORMATS_H

#include "render.h"

enum lab_kind { LAB_DRAWN, LAB_NDC_Q16, LAB_RECIP_Q16, LAB_CLIP_Q16, LAB_LINEAR, LAB_OVER_W, LAB_LOG };

struct lab_format {
    const char *name;
    uint8_t kind;                         /* enum lab_kind */
    uint8_t bits;                         /* of the stored code */
    const struct ph_depth_format *format; /* LAB_DRAWN; else NULL */
    uint8_t exponent; /* a float's bits of exponent; 0: as many as the renderer takes for the lens, or no float */
};

/* The rows of the tables, in the order in which they are printed. A name appears twice if a kind has two widths. */
extern const struct lab_format lab_formats[];
extern const uint32_t lab_format_count; /* at most 32 */

/* A float's bits of exponent between these planes; 0: the format is no float. */
int lab_exponent(const struct lab_format *format, fx_t near_z, fx_t far_z);

#endif
