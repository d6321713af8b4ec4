/* The depth formats, out of their only list: PH_DEPTH_EACH in render.h. */
#include "render.h"

#define FORMAT(id, name, coding, bits, octaves, small)                                                                 \
    const struct ph_depth_format ph_depth_##id = {name, PH_DEPTH_IS_##coding, bits, octaves, small, NULL};
PH_DEPTH_EACH(FORMAT)

const struct ph_depth_format *ph_depth_choose(const struct ph_projection *projection)
{
    if (projection->kind == PH_ORTHOGRAPHIC ||
        projection->far_z <= (int64_t)projection->near_z * PH_DEPTH_FIXED16_RATIO) {
        return PH_DEPTH_FIXED16;
    }
    return PH_DEPTH_FLOAT16;
}

const struct ph_depth_format ph_depth_auto = {.name = "auto", .bits = 16, .choose = ph_depth_choose};

#define NAMED(id, name, coding, bits, octaves, small) , &ph_depth_##id
const struct ph_depth_format *const ph_depth_formats[] = {&ph_depth_auto PH_DEPTH_EACH(NAMED)};

size_t ph_depth_bytes(const struct ph_depth_format *format)
{
    return format != NULL && format->bits > 16 ? sizeof(uint32_t) : sizeof(uint16_t);
}
