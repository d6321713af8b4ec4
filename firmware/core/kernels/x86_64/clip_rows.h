/* clip_rows: see clip_rows_wide.h. */
#include "clip_rows_wide.h"
