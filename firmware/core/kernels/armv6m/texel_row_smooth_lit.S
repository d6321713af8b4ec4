@ See texel_row.h and texel_smooth.inc.
#include "texel_smooth.inc"

    smooth_row ph_texel_row_smooth_lit, 1
