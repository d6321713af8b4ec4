/* The depth formats, out of their only list: PH_DEPTH_EACH in render.h. See depth_ways.h. */
#include "exact.h"
#include "kernels.h"
#include "knee.h"
#include "lens.h"
#include "planes.h"
#include "raster_rows.h"
#include "raster_walk.h"
#include "setup.h"

static const struct ph_octave_ways octaves = {.set_codes = ph_float_depths,
                                              .draw_knee = ph_small_knee,
                                              .finish_depth = ph_finish_octaves,
                                              .set_knee = ph_set_knee,
                                              .draw_split = ph_draw_split,
                                              .draw_rows_split = ph_draw_rows_split,
                                              .draw_flat = ph_draw_flat_across};

/* What formats of a coding and so many bits share. */
static const struct ph_depth_ways ways_FIXED_16 = {.set_near = ph_lens_near,
                                                   .set_plane = ph_set_fixed16,
                                                   .draw_run = ph_draw_run},
                                  ways_FLOAT_16 = {.set_plane = ph_set_float,
                                                   .block_depths = ph_block_depths,
                                                   .exact = &ph_exact_float,
                                                   .octaves = &octaves,
                                                   .draw_run = ph_draw_run},
                                  ways_FIXED_24 = {.set_near = ph_lens_near,
                                                   .set_plane = ph_set_fixed24,
                                                   .draw_run = ph_draw_run24,
                                                   .walk = ph_walk},
                                  ways_FLOAT_24 = {.set_plane = ph_set_float,
                                                   .block_depths = ph_block_depths,
                                                   .exact = &ph_exact_float,
                                                   .draw_run = ph_draw_run24,
                                                   .walk = ph_walk},
                                  ways_LINEAR_16 = {.linear_of = ph_depth_linear_of,
                                                    .set_plane = ph_set_linear,
                                                    .exact = &ph_exact_linear,
                                                    .draw_run = ph_draw_run_linear,
                                                    .walk = ph_walk};

#define FORMAT(id, name, coding, bits, octaves, small)                                                                 \
    const struct ph_depth_format ph_depth_##id = {name, PH_DEPTH_IS_##coding,   bits, octaves, small,                  \
                                                  NULL, &ways_##coding##_##bits};
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
