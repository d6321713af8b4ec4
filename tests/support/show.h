/* show: what the demos' tests share: a demo with all the memory that it asks for. Failures fail the test. */
#ifndef SHOW_H
#define SHOW_H

#include "demo.h"
#include "ref_rig.h"

/* A demo on a stage of its own. */
struct show {
    const struct demo *demo;
    struct demo_context context;
    struct rig rig;
};

struct show show_open(const struct demo *demo, uint16_t width, uint16_t height);
void show_close(struct show *s);

/* Draws the frame into s->rig.pixels; the CRC of the pixels. */
uint32_t show_frame(struct show *s, uint32_t frame);

/* Pixel in column x, row y, wire order. */
uint16_t pixel(const struct show *s, int x, int y);

/* Width and height of what is not background. */
int drawn_width(const struct show *s, int *height);

#endif
