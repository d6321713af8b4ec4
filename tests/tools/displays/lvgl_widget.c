/* The widget ph_lvgl on a display in memory, with LVGL 9 or with the stand-in beside this file: what the display shows
 * must be what ph_show makes, in frames that are drawn whole and in part, whatever the height of LVGL's draw buffer. */
#include "ph_lvgl.h"

#include "shapes.h"

#include <stdio.h>
#include <string.h>

#ifndef BAND_HEIGHT
#define BAND_HEIGHT 9
#endif

enum { SCREEN_W = 100, SCREEN_H = 80, W = 64, H = 48, BAND = BAND_HEIGHT, LEFT = 13, TOP = 7 };

static uint16_t screen[SCREEN_H][SCREEN_W], expected[H][W];
static uint32_t flushed; /* pixels */
static struct shape torus;
static uint16_t ramp[PH_RAMP_SIZE];
static uint32_t frame;

static int draw(void *context, struct ph_renderer *r)
{
    const struct ph_material material = shape_lit(ramp, 240, 160, 60);
    const struct ph_mesh mesh = shape_torus(&torus, FX_ONE / 3, &material);
    const struct ph_xform view = ph_xform_translate(0, 0, -FX_INT(6)), turn = ph_xform_rotate_y(frame << 26);
    struct ph_projection lens;
    (void)context;
    int status = ph_projection_perspective(&lens, FX_INT(45), FX_ONE * W / H, FX_ONE, FX_INT(10));
    status = status != 0 ? status : ph_frame_begin(r, &view, &lens, &shapes_daylight, ph_rgb565(0, 60, 90));
    return status != 0 ? status : ph_draw_mesh(r, &mesh, &turn);
}

static int show(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    (void)context;
    for (uint32_t line = 0; line < height; line++) {
        memcpy(&expected[y + line][x], (const uint16_t *)pixels + line * width, width * 2);
    }
    return 0;
}

static void flush(lv_display_t *display, const lv_area_t *area, uint8_t *pixels)
{
    const int32_t width = area->x2 - area->x1 + 1;
    for (int32_t y = area->y1; y <= area->y2; y++) {
        memcpy(&screen[y][area->x1], pixels + (size_t)(y - area->y1) * (size_t)width * 2, (size_t)width * 2);
    }
    flushed += (uint32_t)(width * (area->y2 - area->y1 + 1));
    lv_display_flush_ready(display);
}

static struct ph_config config_in(uint64_t *memory, size_t bytes)
{
    struct ph_config c = {.width = W,
                          .height = H,
                          .band_height = BAND,
                          .pixel_order = PH_PIXELS_NATIVE,
                          .depth_format = PH_DEPTH_FIXED16,
                          .vertex_max = 700,
                          .triangle_max = 1200};
    return ph_config_memory(&c, memory, bytes) == 0 ? c : (struct ph_config){0};
}

/* Whether the screen shows the frame; its picture is made by ph_show. */
static bool shows(struct ph_renderer *r)
{
    if (draw(NULL, r) != 0 || ph_show(r, show, NULL) != 0) {
        return false;
    }
    for (int y = 0; y < H; y++) {
        if (memcmp(&screen[TOP + y][LEFT], expected[y], W * 2) != 0) {
            printf("frame %u: line %d differs\n", (unsigned)frame, y);
            return false;
        }
    }
    return true;
}

int main(void)
{
    static uint64_t memory[2][PH_MEMORY(W, BAND, 700, 1200)];
    static uint16_t buffer[SCREEN_W * 11]; /* no multiple of a band */
    static struct ph_lvgl w;
    static struct ph_renderer r;
    const struct ph_config config = config_in(memory[0], sizeof memory[0]),
                           other = config_in(memory[1], sizeof memory[1]);
    lv_init();
    lv_display_t *const display = lv_display_create(SCREEN_W, SCREEN_H);
    lv_display_set_color_format(display, LV_COLOR_FORMAT_RGB565);
    lv_display_set_buffers(display, buffer, NULL, sizeof buffer, LV_DISPLAY_RENDER_MODE_PARTIAL);
    lv_display_set_flush_cb(display, flush);
    lv_obj_t *const obj = ph_lvgl_create(lv_screen_active(), &w, &config, draw, NULL);
    if (obj == NULL || ph_renderer_init(&r, &other) != 0) {
        return 1;
    }
    lv_obj_set_pos(obj, LEFT, TOP);
    lv_refr_now(display);
    if (!shows(&r) || flushed < W * H) {
        return 2;
    }
    for (frame = 1; frame < 20; frame++) {
        flushed = 0;
        ph_lvgl_update(obj);
        lv_refr_now(display);
        if (!shows(&r)) {
            return 3;
        }
        if (flushed == 0 || flushed >= W * H) { /* the torus covers a part of the picture */
            printf("frame %u: %u pixels sent\n", (unsigned)frame, (unsigned)flushed);
            return 4;
        }
    }
    return w.status != 0 ? 5 : 0;
}
