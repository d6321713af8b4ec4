/* The offsets that the assembly of this CPU takes, held to the structs. See offsets.inc. */
#include "cull.h"
#include "kernels.h"
#include "texel_row.h"
#include "texture_small.h"
#include "texture_tile.h"
#include "triangle.h"
#include "vertices.h"

#include <stddef.h>

#include "offsets.inc"
#include "matvec_offsets.inc"
