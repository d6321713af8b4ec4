/* matvec: see matvec_wide.h. */
#include "matvec_wide.h"
