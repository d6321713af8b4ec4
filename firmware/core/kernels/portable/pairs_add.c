/*
 * ph_pairs_add of pairs.h, in C for any CPU. The mean of two channels fits a channel, and its top bit says whether
 * their sum does not.
 */
#include "pairs.h"

void ph_pairs_add(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share)
{
    const uint32_t low = 0x08210821, top = 0x84108410; /* lowest and top bit of each channel */
    for (; n > 0; n--, to++) {
        const uint32_t a = ph_wire_pair(*to), b = ph_pair_mix(0, ph_wire_pair(*from++), share, 0), differ = a ^ b;
        const uint32_t mean = (a & b) + ((differ & ~low) >> 1), over = mean & top;
        const uint32_t full = ((over << 1) - (over >> 4)) | (over >> 5 & low); /* green has one bit more */
        *to = ph_wire_pair((mean ^ over) << 1 | (differ & low) | full);
    }
}
