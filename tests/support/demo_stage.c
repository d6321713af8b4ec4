/* See demo_stage.h. */
#include "demo_stage.h"

#include "crc32.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include <stdlib.h>

struct demo_stage demo_stage_open(const struct demo *demo, uint16_t width, uint16_t height)
{
    struct demo_stage s = {.demo = demo, .context = {.width = width, .height = height}};
    s.context.arena = (struct demo_arena){malloc(demo->arena_bytes), demo->arena_bytes, 0};
    assert_non_null(s.context.arena.base);
    s.context.scratch_bytes = demo_scratch_bytes(demo, width, height);
    s.context.scratch = malloc(s.context.scratch_bytes + 1);
    assert_non_null(s.context.scratch);
    assert_int_equal(demo->init(&s.context), PH_OK);
    rig_open(&s.rig, width, height, height, PH_DEPTH_FIXED16, (int)demo->vertex_max, (int)demo->triangle_max);
    return s;
}

void demo_stage_close(struct demo_stage *s)
{
    rig_close(&s->rig);
    free(s->context.scratch);
    free(s->context.arena.base);
}

uint32_t demo_stage_frame(struct demo_stage *s, uint32_t frame)
{
    assert_int_equal(s->demo->frame(&s->context, &s->rig.r, frame), PH_OK);
    uint32_t row = 0;
    const uint32_t bands = ph_frame_bands(&s->rig.r);
    for (uint32_t band = 0; band < bands; band++) {
        row += demo_draw_band(s->demo, &s->context, &s->rig.r, band, s->rig.pixels + row * (uint32_t)s->rig.width);
    }
    assert_int_equal(row, s->rig.height);
    return crc32_update(0, (const uint8_t *)s->rig.pixels, 2 * (size_t)s->rig.width * (size_t)s->rig.height);
}

uint16_t pixel(const struct demo_stage *s, int x, int y)
{
    return s->rig.pixels[y * s->rig.width + x];
}

int drawn_width(const struct demo_stage *s, int *height)
{
    int x0 = s->rig.width, x1 = -1, y0 = s->rig.height, y1 = -1;
    for (int i = 0; i < s->rig.width * s->rig.height; i++) {
        const int x = i % s->rig.width;
        const int y = i / s->rig.width;
        if (s->rig.pixels[i] != s->rig.r.background) {
            x0 = x < x0 ? x : x0;
            x1 = x > x1 ? x : x1;
            y0 = y < y0 ? y : y0;
            y1 = y > y1 ? y : y1;
        }
    }
    *height = y1 - y0 + 1;
    return x1 - x0 + 1;
}
