/*
 * ref_drawing: small raster cases as ASCII pictures of 16 x 12 pixels, drawn through the renderer's public interface.
 * An orthographic camera makes picture coordinates of model coordinates: (x, y) in pixels from the top left corner,
 * y down, z further away.
 */
#ifndef REF_DRAWING_H
#define REF_DRAWING_H

#include "ref_rig.h"

#define WIDTH     16
#define HEIGHT    12
#define SHAPE_MAX 16
#define BLACK     0

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

/* A triangle, counter-clockwise as seen, of the colour of its letter. */
struct shape {
    char letter;
    double corners[3][3]; /* x, y down, z: 0 in the middle, -1 at the near, 1 at the far plane */
};

struct drawing {
    struct rig rig;
    struct rig_one ones[SHAPE_MAX]; /* the meshes of this frame: the renderer may refer to them */
    int count;
};

/* A picture of black, fixed16, one band. */
void drawing_open(struct drawing *d);
void drawing_open_formats(struct drawing *d, int band_height, int triangle_max, const struct ph_depth_format *format);
void drawing_close(struct drawing *d);

/* Starts a frame (drawing_open has done so). */
void drawing_begin(struct drawing *d, const struct ph_scene_light *light);

/* The mesh of one shape, unlit; the caller may change it before drawing. */
struct rig_one *shape_mesh(struct drawing *d, const struct shape *shape);

void draw_mesh(struct drawing *d, const struct rig_one *one);
void draw_shapes(struct drawing *d, const struct shape *shapes, int count);

/* Colours of '0' .. 'z', none black. */
uint16_t colour_of(char letter);

/* The letter of a pixel's colour; '.' is black, '?' any other. */
char letter_at(const struct drawing *d, int x, int y);

/* Draws the bands and compares; shows both pictures where they differ (left what should be). */
void expect(struct drawing *d, const char *const rows[HEIGHT]);

void expect_shapes(const struct shape *shapes, int count, const char *const rows[HEIGHT]);

extern const char *const nothing[HEIGHT];

#endif
