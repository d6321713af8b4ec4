/* A widget of LVGL 9: see ph_lvgl.h. */
#include "ph_lvgl.h"

#include <string.h>

/* Lists the scene; its bands are drawn as LVGL asks for them. */
static void list_scene(struct ph_lvgl *w)
{
    w->status = w->draw(w->context, &w->r);
    w->held = -1;
    w->next = 0;
    w->bands = 0;
    if (w->status != 0) {
        LV_LOG_ERROR("Pinhole stops: %d (pinhole/status.h)", w->status);
    }
}

/* Draws the next band into w->pixels, as RGB565 of this machine. */
static bool draw_next(struct ph_lvgl *w)
{
    w->bands = w->bands == 0 ? ph_frame_bands(&w->r) : w->bands;
    const uint32_t lines = w->next < w->bands ? ph_draw_band(&w->r, w->next, w->pixels) : 0;
    const uint8_t *const wire = (const uint8_t *)w->pixels;
    for (uint32_t i = 0; i < lines * w->r.config.width; i++) {
        w->pixels[i] = (uint16_t)(wire[2 * i] << 8 | wire[2 * i + 1]);
    }
    w->held = lines > 0 ? (int32_t)w->next : -1;
    w->next++;
    return lines > 0;
}

/* Brings a band into w->pixels. Bands come in order: for one that has passed, the scene is listed again. */
static bool hold_band(struct ph_lvgl *w, int32_t band)
{
    if (band == w->held) {
        return true;
    }
    if (band < (int32_t)w->next) {
        list_scene(w);
    }
    while (w->status == 0 && w->held < band) {
        if (!draw_next(w)) {
            return false;
        }
    }
    return w->status == 0;
}

/* Waits until LVGL has drawn all that the layer has, so that w->pixels may change. */
static void finish(lv_obj_t *obj, lv_layer_t *layer)
{
    while (layer->draw_task_head != NULL) {
        lv_draw_dispatch_wait_for_request();
        if (!lv_draw_dispatch_layer(lv_obj_get_display(obj), layer)) {
            lv_draw_wait_for_finish();
            lv_draw_dispatch_request();
        }
    }
}

static void draw_event(lv_event_t *event)
{
    lv_obj_t *const obj = lv_event_get_target(event);
    lv_layer_t *const layer = lv_event_get_layer(event);
    struct ph_lvgl *const w = lv_event_get_user_data(event);
    const int32_t height = w->r.config.height, lines = w->r.config.band_height;
    lv_area_t content;
    lv_draw_image_dsc_t image;
    lv_obj_get_content_coords(obj, &content);
    lv_draw_image_dsc_init(&image);
    lv_obj_init_draw_image_dsc(obj, LV_PART_MAIN, &image);
    image.src = &w->image;
    const int32_t top = layer->_clip_area.y1 - content.y1, bottom = layer->_clip_area.y2 - content.y1;
    for (int32_t band = top > 0 ? top / lines : 0; band * lines < height && band * lines <= bottom; band++) {
        if (!hold_band(w, band)) {
            return;
        }
        const int32_t left = height - band * lines, n = left < lines ? left : lines;
        const lv_area_t area = {content.x1, content.y1 + band * lines, content.x1 + w->r.config.width - 1,
                                content.y1 + band * lines + n - 1};
        lv_draw_image(layer, &image, &area);
        finish(obj, layer);
    }
}

static void invalidate(const lv_obj_t *obj, const struct ph_rectangle *box)
{
    lv_area_t area;
    lv_obj_get_content_coords(obj, &area);
    area.x1 += box->x;
    area.y1 += box->y;
    area.x2 = area.x1 + box->width - 1;
    area.y2 = area.y1 + box->height - 1;
    if (box->width > 0) {
        lv_obj_invalidate_area(obj, &area);
    }
}

void ph_lvgl_update(lv_obj_t *obj)
{
    struct ph_lvgl *const w = lv_obj_get_user_data(obj);
    const struct ph_rectangle before = w->box;
    list_scene(w);
    ph_frame_box(&w->r, &w->box);
    invalidate(obj, &before);
    invalidate(obj, &w->box);
}

void ph_lvgl_update_all(lv_obj_t *obj)
{
    ph_lvgl_update(obj);
    lv_obj_invalidate(obj);
}

lv_obj_t *ph_lvgl_create(lv_obj_t *parent, struct ph_lvgl *w, const struct ph_config *config, ph_lvgl_draw *draw,
                         void *context)
{
    memset(w, 0, sizeof *w);
    w->status = config->pixels == NULL || config->antialiasing != NULL ? PH_ERR_INVAL : ph_renderer_init(&w->r, config);
    if (w->status != 0) {
        LV_LOG_ERROR("Pinhole does not begin: %d (pinhole/status.h)", w->status);
        return NULL;
    }
    w->draw = draw;
    w->context = context;
    w->pixels = config->pixels;
    w->held = -1;
    w->image.header.magic = LV_IMAGE_HEADER_MAGIC;
    w->image.header.cf = LV_COLOR_FORMAT_RGB565;
    w->image.header.w = config->width;
    w->image.header.h = config->band_height;
    w->image.header.stride = (uint32_t)config->width * 2;
    w->image.data_size = (uint32_t)config->width * config->band_height * 2;
    w->image.data = config->pixels;
    lv_obj_t *const obj = lv_obj_create(parent);
    lv_obj_remove_style_all(obj);
    lv_obj_set_user_data(obj, w);
    lv_obj_set_size(obj, config->width, config->height);
    lv_obj_remove_flag(obj, LV_OBJ_FLAG_SCROLLABLE);
    lv_obj_add_event_cb(obj, draw_event, LV_EVENT_DRAW_MAIN, w);
    ph_lvgl_update_all(obj);
    return obj;
}
