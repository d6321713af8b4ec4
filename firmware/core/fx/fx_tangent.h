/* fx_tangent: the tangent as an exact-enough ratio, shared by fx_tan_sat and fx_atan2. */
#ifndef FX_TANGENT_H
#define FX_TANGENT_H

#include <stdint.h>

struct fx_ratio {
    uint64_t num, den;
};

/* num / den = tan of k 2^-17 turn, 0 < k < 16384 (below 45 degrees), relative error < 2^-40. */
struct fx_ratio fx_tangent_ratio(uint32_t k);

#endif
