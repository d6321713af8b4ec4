/* See texture_small.h. */
#include "texel_run_portable.h"

uint32_t ph_texel_run_rows(struct ph_texel_run *r, struct ph_texel_row *row)
{
    return ph_texel_run_rows_portable(r, row);
}

uint32_t ph_texel_run_rows_lit(struct ph_texel_run *r, struct ph_texel_row *row)
{
    return ph_texel_run_rows(r, row);
}
