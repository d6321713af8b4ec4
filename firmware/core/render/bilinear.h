/* bilinear: a texel between the four around it. Private to firmware/core. */
#ifndef PH_BILINEAR_H
#define PH_BILINEAR_H

#include <stdint.h>

struct ph_texel_row;
struct ph_tile_kind;

/* As struct ph_filter has them. */
uint16_t ph_bilinear_of_row(const struct ph_texel_row *row, uint32_t u, uint32_t v);
uint16_t ph_bilinear(const struct ph_tile_kind *k, uint32_t u, uint32_t v);

#endif
