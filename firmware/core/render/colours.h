/* colours: triangles with a lit colour at each corner. Private to firmware/core. */
#ifndef PH_COLOURS_H
#define PH_COLOURS_H

#include "band.h"

struct ph_clip_vertex;
struct ph_corner;
struct ph_part_context;
struct ph_part_lighting;
struct ph_setting;

/* What the name PH_COLOURS stands for. A config points to it, and nothing else refers to these functions, so the linker
 * leaves them out of a program that does not name it. */
struct ph_colouring {
    const struct ph_part_lighting *parts; /* mesh.h */
    /* mesh_colours.c: whether the vertices of a part have colours in place of light; and the same own colours as in the
     * part before, which had that material. */
    bool (*is_coloured)(const struct ph_part_context *c);
    bool (*is_alike)(const struct ph_part_context *c, const struct ph_material *before);
    /* The lit colour of a vertex, RGB565 as a number. */
    uint16_t (*vertex_colour)(const struct ph_part_context *c, uint32_t i);
    /* Before clipping: the channels of lit colours take the places of light, u and v, 16 bits each. */
    void (*take_colours)(struct ph_clip_vertex *in, bool flat);
    /* After clipping: the lit colour of a corner again, RGB565 as a number. */
    uint16_t (*colour_of)(const struct ph_corner *corner);
    /* planes.h: ph_set_colours; and ph_draw_colours. */
    void (*set_colours)(struct ph_triangle *t, const struct ph_vertex *const v[3], const struct ph_sides *sides,
                        bool flat);
    /* Ends the preparation of a draw: ph_setup_fast leaves the colours to ph_set_small_colours (colours_small.h). */
    void (*prepare)(struct ph_setting *s);
    /* setup.h */
    bool (*take_small_depth)(struct ph_triangle *t, const struct ph_setting *s, const struct ph_vertex *const v[3],
                             const struct ph_sides *sides, bool fits);
    uint32_t (*draw_colours)(const struct ph_triangle *t, const struct ph_band *band);
};

/* Draws the rows of a triangle of PH_KIND_COLOURS that lie in the band. Returns the number of its pixels. */
uint32_t ph_draw_colours(const struct ph_triangle *t, const struct ph_band *band);

#endif
