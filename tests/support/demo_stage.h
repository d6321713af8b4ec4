/* demo_stage: what the demos' tests share: a demo with all the memory that it asks for. Failures fail the test. */
#ifndef DEMO_STAGE_H
#define DEMO_STAGE_H

#include "demo.h"
#include "ref_rig.h"

/* A demo on a stage of its own. */
struct demo_stage {
    const struct demo *demo;
    struct demo_context context;
    struct rig rig;
};

struct demo_stage demo_stage_open(const struct demo *demo, uint16_t width, uint16_t height);
void demo_stage_close(struct demo_stage *s);

/* Draws the frame into s->rig.pixels; the CRC of the pixels. */
uint32_t demo_stage_frame(struct demo_stage *s, uint32_t frame);

/* Pixel in column x, row y, wire order. */
uint16_t pixel(const struct demo_stage *s, int x, int y);

/* Width and height of what is not background. */
int drawn_width(const struct demo_stage *s, int *height);

#endif
