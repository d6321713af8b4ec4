/* panel_picture: a picture for panel tests, and what a format should leave of it, computed another way than the
 * driver's. */
#ifndef PANEL_PICTURE_H
#define PANEL_PICTURE_H

#include "sim.h"

/* Largest picture of the tests. */
#define PICTURE_PIXELS (480 * 320)

/* Noise from a seed, with black, white, red, green and blue in a row at the top left. In wire order. */
void picture_fill(uint16_t *pixels, uint32_t width, uint32_t height, uint32_t seed);

/* The picture as RGB888 after `format`, black where a round glass has none. */
void picture_expect(const uint16_t *pixels, uint32_t width, uint32_t height, unsigned format, bool round, uint8_t *rgb);

/* Draws the picture `lines` lines at a time; the first status below zero, or 0. */
int picture_draw(struct panel_driver *d, const uint16_t *pixels, uint32_t lines);

/* Fails the test with place and values where they differ. */
void picture_compare(const uint8_t *seen, const uint8_t *expected, uint32_t width, uint32_t height, const char *what);

/* Fails the test if the simulator has complained. */
void picture_no_complaint(const struct sim *sim, const char *what);

#endif
