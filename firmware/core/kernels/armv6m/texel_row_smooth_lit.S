@ ph_texel_row_smooth_lit of texel_row.h: bilinear texels times light. texel_smooth.inc has its loop.
#include "texel_smooth.inc"

    smooth_row ph_texel_row_smooth_lit, 1
