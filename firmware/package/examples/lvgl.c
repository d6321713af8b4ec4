/* Pinhole on a canvas of LVGL 9, by ph_show. Call pinhole_canvas() once after lv_init() and your display's own start.
 */
#include "triangle.h"

#include <lvgl.h>
#include <string.h>

static uint16_t canvas_pixels[WIDTH * HEIGHT];
static struct ph_renderer renderer;

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    for (uint32_t line = 0; line < height; line++) {
        memcpy(&canvas_pixels[(y + line) * WIDTH + x], (const uint16_t *)pixels + line * width, width * 2);
    }
    lv_obj_invalidate(context);
    return 0;
}

static void next_frame(lv_timer_t *timer)
{
    static uint32_t frame;
    int status = triangle_draw(&renderer, frame++);
    status = status != 0 ? status : ph_show(&renderer, flush, lv_timer_get_user_data(timer));
    if (status != 0) {
        LV_LOG_ERROR("Pinhole ends: %d (pinhole/status.h)", status);
        lv_timer_delete(timer);
    }
}

void pinhole_canvas(void)
{
    lv_obj_t *canvas = lv_canvas_create(lv_screen_active());
    lv_canvas_set_buffer(canvas, canvas_pixels, WIDTH, HEIGHT, LV_COLOR_FORMAT_RGB565);
    const int status = triangle_init(&renderer, PH_PIXELS_NATIVE);
    if (status != 0) {
        LV_LOG_ERROR("Pinhole does not begin: %d (pinhole/status.h)", status);
        return;
    }
    lv_timer_create(next_frame, 33, canvas);
}
