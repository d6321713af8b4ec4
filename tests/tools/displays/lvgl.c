/* See lvgl.h. An image is drawn when its layer is dispatched, not before: who changes its pixels meanwhile is seen. */
#include <lvgl.h>

#include <string.h>

struct lv_obj {
    lv_area_t area;
    lv_event_cb_t callback;
    void *event_data, *user_data;
};

struct lv_event {
    lv_obj_t *target;
    lv_layer_t *layer;
    void *data;
};

struct lv_display {
    int32_t width, height;
    uint16_t *buffer;
    uint32_t pixels;
    lv_display_flush_cb_t flush;
    lv_area_t invalid;
};

struct task {
    const lv_image_dsc_t *image;
    lv_area_t area;
};

static lv_display_t the_display;
static lv_obj_t the_screen, the_object;
static struct task task;

static lv_area_t common(lv_area_t a, lv_area_t b)
{
    return (lv_area_t){a.x1 > b.x1 ? a.x1 : b.x1, a.y1 > b.y1 ? a.y1 : b.y1, a.x2 < b.x2 ? a.x2 : b.x2,
                       a.y2 < b.y2 ? a.y2 : b.y2};
}

void lv_init(void)
{
}

lv_display_t *lv_display_create(int32_t width, int32_t height)
{
    the_display = (lv_display_t){.width = width, .height = height, .invalid = {0, 0, width - 1, height - 1}};
    return &the_display;
}

void lv_display_set_color_format(lv_display_t *display, uint32_t format)
{
    display->flush = format == LV_COLOR_FORMAT_RGB565 ? display->flush : NULL;
}

void lv_display_set_buffers(lv_display_t *display, void *one, void *two, uint32_t bytes, int mode)
{
    display->buffer = two == NULL && mode == LV_DISPLAY_RENDER_MODE_PARTIAL ? one : NULL;
    display->pixels = bytes / 2;
}

void lv_display_set_flush_cb(lv_display_t *display, lv_display_flush_cb_t flush)
{
    display->flush = flush;
}

void lv_display_flush_ready(lv_display_t *display)
{
    (void)display;
}

/* Draws a piece that fits the buffer: black, then the object. */
static void draw_piece(lv_display_t *display, lv_area_t piece)
{
    lv_layer_t layer = {.buf_area = piece, ._clip_area = piece};
    lv_event_t event = {&the_object, &layer, the_object.event_data};
    const lv_area_t seen = common(piece, the_object.area);
    memset(display->buffer, 0, display->pixels * 2);
    if (seen.x1 <= seen.x2 && seen.y1 <= seen.y2 && the_object.callback != NULL) {
        layer._clip_area = seen;
        the_object.callback(&event);
    }
    display->flush(display, &piece, (uint8_t *)display->buffer);
}

void lv_refr_now(lv_display_t *display)
{
    const lv_area_t all = common(display->invalid, (lv_area_t){0, 0, display->width - 1, display->height - 1});
    const int32_t lines = (int32_t)display->pixels / (all.x2 - all.x1 + 1);
    for (int32_t y = all.y1; y <= all.y2; y += lines) {
        draw_piece(display, common(all, (lv_area_t){all.x1, y, all.x2, y + lines - 1}));
    }
    display->invalid = (lv_area_t){display->width, display->height, -1, -1};
}

lv_obj_t *lv_screen_active(void)
{
    return &the_screen;
}

lv_obj_t *lv_obj_create(lv_obj_t *parent)
{
    return parent == &the_screen ? &the_object : NULL;
}

void lv_obj_remove_style_all(lv_obj_t *obj)
{
    (void)obj;
}

void lv_obj_set_user_data(lv_obj_t *obj, void *data)
{
    obj->user_data = data;
}

void *lv_obj_get_user_data(lv_obj_t *obj)
{
    return obj->user_data;
}

void lv_obj_set_size(lv_obj_t *obj, int32_t width, int32_t height)
{
    obj->area.x2 = obj->area.x1 + width - 1;
    obj->area.y2 = obj->area.y1 + height - 1;
}

void lv_obj_set_pos(lv_obj_t *obj, int32_t x, int32_t y)
{
    obj->area = (lv_area_t){x, y, x + obj->area.x2 - obj->area.x1, y + obj->area.y2 - obj->area.y1};
    lv_obj_invalidate(obj);
}

void lv_obj_remove_flag(lv_obj_t *obj, int flag)
{
    (void)obj;
    (void)flag;
}

void *lv_obj_add_event_cb(lv_obj_t *obj, lv_event_cb_t callback, int code, void *data)
{
    obj->callback = code == LV_EVENT_DRAW_MAIN ? callback : obj->callback;
    obj->event_data = data;
    return obj;
}

void lv_obj_get_content_coords(const lv_obj_t *obj, lv_area_t *area)
{
    *area = obj->area;
}

void lv_obj_invalidate(const lv_obj_t *obj)
{
    (void)lv_obj_invalidate_area(obj, &obj->area);
}

int lv_obj_invalidate_area(const lv_obj_t *obj, const lv_area_t *area)
{
    lv_area_t *const all = &the_display.invalid, one = common(*area, obj->area);
    *all = (lv_area_t){one.x1 < all->x1 ? one.x1 : all->x1, one.y1 < all->y1 ? one.y1 : all->y1,
                       one.x2 > all->x2 ? one.x2 : all->x2, one.y2 > all->y2 ? one.y2 : all->y2};
    return 1;
}

lv_display_t *lv_obj_get_display(const lv_obj_t *obj)
{
    return obj == &the_object ? &the_display : NULL;
}

void lv_obj_init_draw_image_dsc(lv_obj_t *obj, uint32_t part, lv_draw_image_dsc_t *image)
{
    (void)obj;
    (void)part;
    (void)image;
}

lv_obj_t *lv_event_get_target(lv_event_t *event)
{
    return event->target;
}

lv_layer_t *lv_event_get_layer(lv_event_t *event)
{
    return event->layer;
}

void *lv_event_get_user_data(lv_event_t *event)
{
    return event->data;
}

void lv_draw_image_dsc_init(lv_draw_image_dsc_t *image)
{
    image->src = NULL;
}

void lv_draw_image(lv_layer_t *layer, const lv_draw_image_dsc_t *image, const lv_area_t *area)
{
    task = (struct task){image->src, *area};
    layer->draw_task_head = &task;
}

void lv_draw_dispatch_wait_for_request(void)
{
}

bool lv_draw_dispatch_layer(lv_display_t *display, lv_layer_t *layer)
{
    const lv_area_t seen = common(task.area, layer->_clip_area);
    const int32_t width = layer->buf_area.x2 - layer->buf_area.x1 + 1;
    for (int32_t y = seen.y1; y <= seen.y2 && seen.x1 <= seen.x2; y++) {
        const uint8_t *const from =
            (const uint8_t *)task.image->data + (y - task.area.y1) * (int32_t)task.image->header.stride;
        memcpy(display->buffer + (y - layer->buf_area.y1) * width + seen.x1 - layer->buf_area.x1,
               from + (seen.x1 - task.area.x1) * 2, (size_t)(seen.x2 - seen.x1 + 1) * 2);
    }
    layer->draw_task_head = NULL;
    return true;
}

void lv_draw_wait_for_finish(void)
{
}

void lv_draw_dispatch_request(void)
{
}
