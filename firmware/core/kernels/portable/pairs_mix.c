/* ph_pairs_mix of pairs.h, in C for any CPU. */
#include "pairs.h"

void ph_pairs_mix(ph_pair *to, const ph_pair *from, uint32_t n, uint32_t share)
{
    for (; n > 0; n--, to++) {
        *to = ph_wire_pair(ph_pair_mix(ph_wire_pair(*to), ph_wire_pair(*from++), share, 32 - share));
    }
}
