/*
 * pairs: rows of colours are laid over one another, two pixels at a time. Private to firmware/core.
 *
 * A word holds two neighbouring pixels. Its bits of PH_SPREAD (blend.h) are blue and red of the first one and green of
 * the second one, with room between them; the other bits, five places further down, are the other three channels. So
 * two products scale all six. All n pairs stand at whole words.
 */
#ifndef PH_PAIRS_H
#define PH_PAIRS_H

#include "blend.h"

#define PH_PAIR_HALF (16u << 22 | 16u << 11 | 16u) /* half of 32 in the other channels, five places further down */

/* Two pixels in wire order. */
typedef uint32_t __attribute__((may_alias)) ph_pair;

/* Swaps the bytes of two colours in wire order, or nothing on a CPU of big endian. */
static inline uint32_t ph_wire_pair(uint32_t pair)
{
    return ph_wire16(0x1234) == 0x1234 ? pair : (pair & 0xff00ff) << 8 | (pair >> 8 & 0xff00ff);
}

/* (to * rest + from * share) / 32, each channel rounded to nearest; not in wire order. share + rest: 0 .. 32. */
static inline uint32_t ph_pair_mix(uint32_t to, uint32_t from, uint32_t share, uint32_t rest)
{
    const uint32_t spread = (to & PH_SPREAD) * rest + (from & PH_SPREAD) * share + PH_SPREAD_HALF;
    const uint32_t others = (to & ~PH_SPREAD) / 32 * rest + (from & ~PH_SPREAD) / 32 * share + PH_PAIR_HALF;
    return (spread >> 5 & PH_SPREAD) | (others & ~PH_SPREAD);
}

/* pairs_mix.c: each channel of n pairs becomes (to * (32 - share) + from * share) / 32, rounded to nearest; share: 0 ..
 * 32. */
void ph_pairs_mix(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share);

/* pairs_add.c: each channel of n pairs becomes to + from * share / 32, at most full; the product is rounded to nearest.
 */
void ph_pairs_add(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share);

/* pairs_times.c: each channel of n pairs becomes to * from over a full one, rounded to nearest. */
void ph_pairs_times(ph_pair *to, const ph_pair *from, uint32_t n);

#endif
