/*
 * sim_show: the depth buffer as a picture, on the glass of the kit. demo_draw_band is replaced at link time (see the
 * Makefile). A pixel's grey is its depth code's share of the largest code, as --point prints it: white is the largest,
 * nearest one, black is 0, where nothing is drawn. What a demo draws over its bands, or blurs, is left out.
 */
#ifndef SIM_SHOW_H
#define SIM_SHOW_H

#include "demo.h"

/* From now on bands show the depth buffer; false: the picture. */
void sim_show_depth(bool shown);

uint32_t sim_show_draw_band(const struct demo *demo, struct demo_context *context, struct ph_renderer *r, uint32_t band,
                            uint16_t *pixels);

#endif
