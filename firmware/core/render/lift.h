/* lift: depth_bias_slope, which moves depth towards the viewer by a share of its gradient. Private to firmware/core. */
#ifndef PH_LIFT_H
#define PH_LIFT_H

#include "depth_ways.h"
#include "triangle.h"

/* The highest 16.16 code that depth_bias_slope lifts a corner to: planes are off by 3 codes, and go beyond their
 * corners by 4. Across octaves it is ph_depth_top. */
#define PH_TOP_CODE (UINT32_MAX << 19)

/* Moves a plane through corners of the depths d as depth_bias_slope says; none of them beyond `top`. */
void ph_lift_plane(const struct ph_material *material, uint32_t top, const uint32_t d[3], struct ph_plane *plane);

/* Moves a small triangle's depth as depth_bias_slope says, no corner beyond `top`. d: the corners', in the unit of its
 * block. */
void ph_lift_small(struct ph_triangle *t, uint32_t top, const uint32_t d[3]);

/* Lifts the codes of linear-w by what they change by between two depths, as far as the nearest corner has room. */
void ph_lift_codes(struct ph_linear *linear, uint32_t from, uint32_t to, uint32_t nearest);

/* Moves codes of linear-w by what depth_bias_slope makes at the farthest corner. w: N/w of the corners. */
void ph_lift_linear(const struct ph_material *material, const uint32_t w[3], struct ph_depth *depth);

#endif
