/* The traits of the depth formats, out of their only list: PH_DEPTH_EACH in render.h. */
#include "render.h"

#define TRAITS(id, name, coding, bits, octaves, small) {PH_DEPTH_IS_##coding, bits, octaves, small},

const struct ph_depth_traits ph_depth_traits[] = {{.bits = 16}, PH_DEPTH_EACH(TRAITS)};

size_t ph_depth_bytes(unsigned format)
{
    return ph_depth_traits[format].bits > 16 ? sizeof(uint32_t) : sizeof(uint16_t);
}
