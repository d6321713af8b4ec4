/* knee: small triangles with float depth that cross from one octave into the next. Private to firmware/core. */
#ifndef PH_KNEE_H
#define PH_KNEE_H

#include <stdbool.h>
#include <stdint.h>

struct ph_triangle;

/* The nearest and the farthest octave of the corners of a triangle. */
struct ph_octaves {
    int near, far;
};

/* d: the depth of the corners, in units of the block. */
struct ph_octaves ph_octaves_of(const uint32_t d[3], int block);

/* Whether the plane of ph_setup_small is exact enough for depths (units of 2^-(32 + block)) across octaves. Two octaves
 * at most; and its gradients are off by up to 2^8 units a pixel. Over 16 columns and rows, in octave `far`, these are
 * 2^(far - down - 3) codes: half a code, or one in the octave beside it, up to far = down + 2. Beyond, near the far
 * plane, they are many. */
bool ph_small_plane_does(const uint32_t d[3], int block);

/* Makes a small triangle that crosses from one octave into the next one of PH_KIND_SMALL_KNEE, unless a pixel of it may
 * lie in a third one. d: the depth of its corners, in units of its block. */
void ph_set_knee(struct ph_triangle *t, const uint32_t d[3]);

#endif
