/*
 * cover_search: a slow search for the cheapest rectangles that cover all changed pixels, to compare panel_diff with.
 * First it takes the best of all covers that straight cuts across can make (dynamic programming over all rectangles).
 * Then it anneals on the true cost, in which a rectangle after one of the same columns or lines is cheaper.
 */
#ifndef COVER_SEARCH_H
#define COVER_SEARCH_H

#include <stdint.h>

#define COVER_SIDE_MAX 48

struct cover_costs {
    uint32_t border, start, pixel; /* bytes */
};

/* changed: width x height flags. Returns the bytes of the best cover found; 0 when nothing changed. */
uint32_t cover_search(const uint8_t *changed, uint32_t width, uint32_t height, const struct cover_costs *costs,
                      uint32_t steps);

#endif
