@ ph_texel_row_smooth of texel_row.h: bilinear texels as they are. texel_smooth.inc has its loop.
#include "texel_smooth.inc"

    smooth_row ph_texel_row_smooth, 0
