/* What the small profile takes as it is from render/. See small.h. */
#include "../band.c"
#include "../check.c"
#include "../colour.c"
#include "../depth.c"
#include "../knee.c"
#include "../lift.c"
#include "../transform.c"
