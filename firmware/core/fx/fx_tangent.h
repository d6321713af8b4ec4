/* fx_tangent: the tangent as a ratio, for fx_atan2. */
#ifndef FX_TANGENT_H
#define FX_TANGENT_H

#include <stdint.h>

struct fx_ratio {
    uint64_t num, den;
};

/* num / den is the tangent of `eighth` 2^-63 eighth turns, eighth < 2^63 (45 degrees), with a relative error < 2^-40.
 */
struct fx_ratio fx_tangent_ratio(uint64_t eighth);

#endif
