/*
 * line: lines one pixel wide; render.h has the rule of their pixels. Private to firmware/core.
 *
 * A line is walked along its longer axis, from its upper end (of a level one: the left) to the lower. Across this axis
 * it takes the pixel that it runs through at the centre of each column or row; its place there is rounded to 2^-16 px,
 * and each step is 2^-17 px off at most. Depth is linear along the longer axis. All of this counts from the end of the
 * line, not from the band, so the pixels are the same at any height of the bands.
 */
#ifndef PH_LINE_H
#define PH_LINE_H

#include "band.h"
#include "setting.h"

/* What sets up and draws lines. Only what lists lines names it, and gives it to the renderer; a line that is set up
 * names it, too. So the linker leaves it out of a program without lines. */
struct ph_lines {
    void (*setup_line)(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                       struct ph_triangle *t);
    /* Draws the part of a line that lies in the band. Returns the pixels tested. */
    uint32_t (*draw_line)(const struct ph_triangle *t, const struct ph_band *band);
    /* Draws a line that goes on below the band, and steps it down to the next one in place. */
    uint32_t (*draw_and_step)(struct ph_triangle *t, const struct ph_band *band);
    /* Steps a line down to row y. */
    void (*step_line)(struct ph_triangle *t, int32_t y);
};

extern const struct ph_lines ph_lines;

/* Lists a line of the current draw if a pixel of it may lie in the picture. */
void ph_list_line(struct ph_renderer *r, const uint16_t ends[2], const struct ph_vertex *a, const struct ph_vertex *b);

/* Lists edges of a mesh, up to one that must be clipped. Returns how many come before that. */
uint32_t ph_list_lines(struct ph_renderer *r, const uint16_t (*edges)[2], uint32_t n, const struct ph_vertex *vertices);

/* Lists a line that is no edge of a mesh and whose ends are projected. */
void ph_list_segment(struct ph_renderer *r, const struct ph_material *material, const struct ph_corner ends[2]);

/* Sets up a line that has a column or row in the picture. */
void ph_setup_line(const struct ph_setting *s, const struct ph_vertex *a, const struct ph_vertex *b,
                   struct ph_triangle *t);

#endif
