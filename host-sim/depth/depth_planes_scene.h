/*
 * depth_planes_scene: two parallel planes drawn by the renderer, and where they exactly are.
 *
 * Each is a parallelogram a, a + u, a + u + v, a + v in Q16.16, seen by a camera at the origin that looks along -z;
 * u = (ux, 0, 0), v = (0, vy, vz), so the four corners lie exactly in one plane. For another azimuth the camera rolls
 * about its axis, which leaves every distance as it is. Both have the same u and v, so they are exactly parallel. (v is
 * a multiple of 64, so that one plane can be moved within itself, exactly: else both would be snapped to the same
 * sub-pixels, and could not be out of order.) The one behind is drawn first: of two equal depth codes it stays, and
 * what the format cannot tell apart counts as wrong.
 *
 *            \     \
 *             \     \  tilt: angle of the planes with the screen, 0 facing, positive leaning away at the top
 *     eye ---- \ --- \ ---- z = at (behind)
 *         front \     \ behind,  separation: along their normal
 *
 * Exactly: the ray of row j of H is y = s D (D the distance along the view), s = (H - 1 - 2 j) 2^20 / (scale_y H),
 * scale_y the projection's in Q12.20; if the camera rolls, likewise with the column, turned back. It meets the plane at
 * D = (vz ay - az vy) / (vy + s vz). The denominator is common to both planes, so at every pixel the nearer one is the
 * one with the smaller numerator by size: 64 bits decide it exactly, and tests/host-sim/test_depth_planes.c confirms it
 * pixel by pixel in rational numbers.
 */
#ifndef DEPTH_PLANES_SCENE_H
#define DEPTH_PLANES_SCENE_H

#include "depth_budget_terms.h"

struct planes_quad {
    struct fx_vec3 a;
    fx_t ux, vy, vz;
};

struct planes_pair {
    struct planes_quad behind, front;
};

/* What is asked for. Slopes, in the direction of the azimuth, of the planes' lower and upper edge; across it of their
 * sides at the middle. */
struct planes_place {
    struct planes_lean lean;
    double separation_m;
    double slope_low, slope_high, slope_side;
    double slope_middle; /* across, of the middle of the farther edge */
    int shift; /* moves the plane in front within itself by this many 64ths of its height, and a little sideways */
};

struct planes_paint {
    struct ph_material material;
    struct ph_texture texture;
    uint16_t ramp[PH_RAMP_SIZE];
};

/* The renderer and its memory for pictures of lab's size in one format. */
struct planes_canvas {
    const struct depth_lab *lab;
    struct ph_renderer renderer;
    struct ph_xform view; /* turned about z alone, see depth_planes_turn() */
    uint8_t shading;      /* a number in depth_shadings; 0, UNLIT, at first */
    struct ph_projection projection;
    struct planes_paint paint[2]; /* of the last drawing */
    /* NULL, or who draws in place of the renderer into pixels: so another renderer is measured by the same sweep. */
    void (*draw)(struct planes_canvas *canvas, const struct planes_quad *behind, const struct planes_quad *front);
    uint16_t *pixels;  /* PLANES_NONE, PLANES_FRONT or PLANES_BEHIND */
    uint8_t *verdicts; /* room for a byte a pixel, for whoever counts */
    void *memory;
};

/* The ray through a point of the picture, whose pixels have their centres at whole numbers: slopes against the view. */
struct planes_ray {
    double right, up;
};
struct planes_ray depth_planes_ray(const struct planes_canvas *canvas, double x, double y);

#define PLANES_VERTICES  512 /* of a drawing, at most */
#define PLANES_TRIANGLES 1024

enum { PLANES_NONE, PLANES_FRONT, PLANES_BEHIND };

/* Opens a canvas for two planes. 0 or COMPLAINED. Call depth_planes_close() in any case. */
int depth_planes_open(struct planes_canvas *canvas, const struct depth_lab *lab, const struct ph_depth_format *format);
void depth_planes_close(struct planes_canvas *canvas);

/* Rolls the camera, so that what leans away at the top leans in the direction of the azimuth. */
void depth_planes_turn(struct planes_canvas *canvas, double azimuth_deg);

/* Returns the widest place that picture, near and far plane allow for planes that stand so. */
struct planes_place depth_planes_whole(const struct depth_lab *lab, struct planes_lean lean, double separation_m);

/* Rounds to Q16.16. False: a plane would be a line, or its corners lie outside near .. far. */
bool depth_planes_make(const struct depth_lab *lab, const struct planes_place *place, struct planes_pair *pair);

/* Draws the quads in order (the last two arguments may be NULL) into canvas->pixels and the depth buffer. */
void depth_planes_draw(struct planes_canvas *canvas, const struct planes_quad *behind, const struct planes_quad *front);

/* The material of a colour (PLANES_FRONT, PLANES_BEHIND) in the canvas's shading, until the next call for this colour.
 * All of its ramp, which is its texture too, has the colour. */
const struct ph_material *depth_planes_paint(struct planes_canvas *canvas, uint16_t colour);

/* Returns the depth code of a pixel that was drawn last; 0: nothing is there. */
uint32_t depth_planes_code(const struct planes_canvas *canvas, uint32_t pixel);

/* Returns the distance along the view, in metres, at which the ray of a pixel meets the plane. */
double depth_planes_distance_m(const struct planes_canvas *canvas, const struct planes_quad *quad, uint32_t pixel);

/* Is the plane called front exactly nearer than the other one at every pixel? */
bool depth_planes_front_is_nearer(const struct planes_pair *pair);

/* Returns the distance between the rounded planes along their normal, in metres. */
double depth_planes_separation_m(const struct planes_pair *pair);

#endif
