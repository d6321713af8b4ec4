/* fog: the fog's share of a colour. Private to firmware/core. */
#ifndef PH_FOG_H
#define PH_FOG_H

#include "render.h"

/* The fog's share at that depth code, 0 .. 32; `share` is a guess of it. codes: as in the renderer. */
uint32_t ph_fog_share(const uint32_t codes[32], uint32_t code, uint32_t share);

#endif
