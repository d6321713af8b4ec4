/* ph_pairs_times of pairs.h, in C for any CPU. */
#include "pairs.h"

/* The product of two colours, which are the low halves of words: those of its channels stand side by side, blue from
 * bit 0, red from bit 10, green from bit 20. */
static inline uint32_t times(uint32_t a, uint32_t b)
{
    const uint32_t blue = (a & 31) * (b & 31), red = (a >> 11 & 31) * (b >> 11 & 31),
                   green = (a >> 5 & 63) * (b >> 5 & 63);
    uint32_t all = (blue | red << 10 | green << 20) + (32u << 20 | 16u << 10 | 16u);
    all += (all >> 5 & (31u << 10 | 31u)) + (all >> 26 << 20); /* by 31 and by 63 */
    return (all >> 4 & 0xf800) | all >> 26 << 5 | (all >> 5 & 31);
}

void ph_pairs_times(ph_pair *to, const ph_pair *from, uint32_t n)
{
    for (; n > 0; n--, to++) {
        const uint32_t a = ph_wire_pair(*to), b = ph_wire_pair(*from++);
        uint32_t both = 0;
        for (int down = 0; down < 32; down += 16) {
            both |= times(a >> down, b >> down) << down;
        }
        *to = ph_wire_pair(both);
    }
}
