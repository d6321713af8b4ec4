/* A stand-in of the few calls of LVGL 9 that the examples take: one display, at most one object, RGB565. What is
 * invalidated is one rectangle; it is drawn in pieces as large as the display's buffer, as LVGL draws. */
#ifndef LVGL_H
#define LVGL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

#define LV_LOG_ERROR(...)     (printf(__VA_ARGS__), printf("\n"))
#define LV_IMAGE_HEADER_MAGIC 0x19

enum { LV_COLOR_FORMAT_RGB565 = 0x12 };
enum { LV_DISPLAY_RENDER_MODE_PARTIAL };
enum { LV_EVENT_DRAW_MAIN = 1 };
enum { LV_PART_MAIN };
enum { LV_OBJ_FLAG_SCROLLABLE = 16 };

typedef struct {
    int32_t x1, y1, x2, y2;
} lv_area_t;
typedef struct {
    void *draw_task_head;
    lv_area_t buf_area, _clip_area;
} lv_layer_t;
typedef struct {
    struct {
        uint32_t magic, cf, flags, w, h, stride;
    } header;
    uint32_t data_size;
    const void *data;
} lv_image_dsc_t;
typedef struct {
    const void *src;
} lv_draw_image_dsc_t;
typedef struct lv_obj lv_obj_t;
typedef struct lv_event lv_event_t;
typedef struct lv_display lv_display_t;
typedef struct lv_timer lv_timer_t;
typedef void (*lv_event_cb_t)(lv_event_t *event);
typedef void (*lv_timer_cb_t)(lv_timer_t *timer);
typedef void (*lv_display_flush_cb_t)(lv_display_t *display, const lv_area_t *area, uint8_t *pixels);

void lv_init(void);
lv_display_t *lv_display_create(int32_t width, int32_t height);
void lv_display_set_color_format(lv_display_t *display, uint32_t format);
void lv_display_set_buffers(lv_display_t *display, void *one, void *two, uint32_t bytes, int mode);
void lv_display_set_flush_cb(lv_display_t *display, lv_display_flush_cb_t flush);
void lv_display_flush_ready(lv_display_t *display);
void lv_refr_now(lv_display_t *display);
lv_obj_t *lv_screen_active(void);
lv_obj_t *lv_obj_create(lv_obj_t *parent);
void lv_obj_remove_style_all(lv_obj_t *obj);
void lv_obj_set_user_data(lv_obj_t *obj, void *data);
void *lv_obj_get_user_data(lv_obj_t *obj);
void lv_obj_set_size(lv_obj_t *obj, int32_t width, int32_t height);
void lv_obj_set_pos(lv_obj_t *obj, int32_t x, int32_t y);
void lv_obj_remove_flag(lv_obj_t *obj, int flag);
void *lv_obj_add_event_cb(lv_obj_t *obj, lv_event_cb_t callback, int code, void *data);
void lv_obj_get_content_coords(const lv_obj_t *obj, lv_area_t *area);
void lv_obj_invalidate(const lv_obj_t *obj);
int lv_obj_invalidate_area(const lv_obj_t *obj, const lv_area_t *area);
lv_display_t *lv_obj_get_display(const lv_obj_t *obj);
void lv_obj_init_draw_image_dsc(lv_obj_t *obj, uint32_t part, lv_draw_image_dsc_t *image);
lv_obj_t *lv_event_get_target(lv_event_t *event);
lv_layer_t *lv_event_get_layer(lv_event_t *event);
void *lv_event_get_user_data(lv_event_t *event);
void lv_draw_image_dsc_init(lv_draw_image_dsc_t *image);
void lv_draw_image(lv_layer_t *layer, const lv_draw_image_dsc_t *image, const lv_area_t *area);
void lv_draw_dispatch_wait_for_request(void);
bool lv_draw_dispatch_layer(lv_display_t *display, lv_layer_t *layer);
void lv_draw_wait_for_finish(void);
void lv_draw_dispatch_request(void);
lv_obj_t *lv_canvas_create(lv_obj_t *parent);
void lv_canvas_set_buffer(lv_obj_t *obj, void *pixels, int32_t width, int32_t height, uint32_t format);
lv_timer_t *lv_timer_create(lv_timer_cb_t callback, uint32_t period_ms, void *data);
void *lv_timer_get_user_data(lv_timer_t *timer);
void lv_timer_delete(lv_timer_t *timer);

#ifdef __cplusplus
}
#endif

#endif
