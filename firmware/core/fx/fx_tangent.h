/* fx_tangent: the tangent as a ratio, for fx_atan2. */
#ifndef FX_TANGENT_H
#define FX_TANGENT_H

#include <stdint.h>

struct fx_ratio {
    uint64_t num, den;
};

/* num / den is the tangent of k 2^-17 turn, 0 < k < 16384 (below 45 degrees), with a relative error < 2^-40. */
struct fx_ratio fx_tangent_ratio(uint32_t k);

#endif
