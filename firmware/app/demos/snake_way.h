/*
 * snake_way: where the snake of the demo goes, and its apples. It plays itself: a closed path, a figure of eight that
 * crosses over itself on a hump, with apples on the way; what was eaten grows again behind it.
 *
 * Left and right steer it. After the first press it leaves that path within one cell of a field of 9 x 7 and goes from
 * cell to cell. A press turns it by a quarter in the next cell; the last press counts. It never leaves the field: it
 * ignores a turn out of it, and at the border it turns to the side with more room. Apples make it longer. When it runs
 * into itself it plays by itself again.
 *
 * Time is counted in frames: while the snake is steered from the one in which it left the path, else from frame 0.
 */
#ifndef SNAKE_WAY_H
#define SNAKE_WAY_H

#include "geom.h"

#include <stdbool.h>

#define SNAKE_BALLS   38
#define SNAKE_SPACING 10u /* frames between two balls of the body */
#define SNAKE_NOSE    10u /* frames by which the nose is before the camera */
#define SNAKE_APPLES  8
#define SNAKE_TRAIL   32u /* cells that are remembered; the longest body takes fewer */
#define SNAKE_RADIUS  (FX_ONE * 32 / 100)

struct snake_cell {
    int8_t x, z;
};

/* Directions are quarter turns from -z, counter-clockwise as seen from above. */
struct snake_passage {
    struct snake_cell cell;
    uint8_t in, out;
};

/* The snake while it is steered; all zero while it plays by itself. */
struct snake_steering {
    bool on;
    int8_t turn;     /* asked for in the next cell: 1 left, -1 right */
    uint32_t origin; /* the frame in which the snake left the path */
    uint32_t time;   /* frames since then; after 1,024 of them it repeats 512 .. 1,023 */
    uint32_t length; /* balls */
    uint32_t random;
    struct snake_passage trail[SNAKE_TRAIL]; /* the cell that was entered at time t is in [t / 16 % SNAKE_TRAIL] */
    struct snake_cell apples[SNAKE_APPLES];
    uint32_t born[SNAKE_APPLES]; /* time */
};

struct snake_way {
    struct snake_steering steering;
    uint32_t frame, buttons;      /* of the last frame */
    struct snake_steering before; /* the steering, its frame and buttons before the last frame, which may come again */
    uint32_t frame_before, buttons_before;
};

void snake_way_begin(struct snake_way *w);

/* Steers up to this frame. A frame that is drawn again is steered again, by its new buttons; a few left out are made up
 * for; a jump (the loop's end) counts as one. buttons: of hal.h. */
void snake_steer(struct snake_way *w, uint32_t frame, uint32_t buttons);

/* Where the head is at a time, and where it would be `ahead` frames later. */
struct fx_vec3 snake_spot(const struct snake_steering *s, uint32_t time, uint32_t ahead);

/* Balls of the body. When it is steered it becomes shorter, but not at once. */
uint32_t snake_balls(const struct snake_steering *s);

/* The place of apple i. Returns how far it has grown, 0 .. 24576. */
uint32_t snake_apple(const struct snake_steering *s, uint32_t i, uint32_t now, struct fx_vec3 *at);

#endif
