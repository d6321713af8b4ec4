/* See matvec_wide.h. */
#include "matvec_wide.h"
