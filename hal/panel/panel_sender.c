/* See panel.h: every frame whole. */
#include "panel.h"

static int sender_begin(void *context, struct panel_driver *d)
{
    (void)context;
    return panel_frame_begin(d);
}

static int sender_rows(void *context, struct panel_driver *d, const uint16_t *pixels, uint32_t lines)
{
    (void)context;
    return panel_rows(d, pixels, lines);
}

static int sender_end(void *context, struct panel_driver *d)
{
    (void)context;
    return panel_frame_end(d);
}

static const struct panel_sender_ops ops = {.begin = sender_begin, .rows = sender_rows, .end = sender_end};

const struct panel_sender panel_sender_whole = {&ops, NULL};
