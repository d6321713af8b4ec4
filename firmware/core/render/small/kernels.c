/* What the small profile takes as it is: edges, and the kernels of kernels/portable. See small.h. */
#include "../../kernels/portable/float_depths.c"
#include "../../kernels/portable/setup_small.c"
#include "../../kernels/portable/vertices.c"
#include "../outline.c"
