/*
 * ph_lvgl: a widget of LVGL 9 that shows what Pinhole draws.
 *
 * It has no frame buffer: while LVGL renders a part of the screen, the bands that lie in it are drawn, and put there as
 * images of one band. It takes the styles of images (opacity, recolour) and all others of an object; its events are
 * those of an object. Its picture fills the content area from the upper left.
 */
#ifndef PH_LVGL_H
#define PH_LVGL_H

#include <lvgl.h>
#include <pinhole/render.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Draws the scene as it is now: ph_frame_begin, ph_draw_mesh and the like. Without a change of the scene it must draw
 * the same again. Returns 0 or an error. */
typedef int ph_lvgl_draw(void *context, struct ph_renderer *r);

/* The widget's memory, which must stay as long as the widget. All private but `status`. */
struct ph_lvgl {
    struct ph_renderer r;
    ph_lvgl_draw *draw;
    void *context;
    int status; /* 0, or the error with which drawing stopped: pinhole/status.h */
    lv_image_dsc_t image;
    uint16_t *pixels;
    struct ph_rectangle box; /* of what the screen shows */
    uint32_t bands, next;    /* of the frame that is listed; the next one that the renderer will give */
    int32_t held;            /* the band in pixels; -1: none */
};

/*
 * Creates the widget, as large as the picture.
 * In: config says size, memory and formats, as for ph_renderer_init; config->pixels holds a band.
 * Out: the object, or NULL: the config is refused, and w->status says why.
 */
lv_obj_t *ph_lvgl_create(lv_obj_t *parent, struct ph_lvgl *w, const struct ph_config *config, ph_lvgl_draw *draw,
                         void *context);

/* The scene has changed: draws the next frame, and invalidates what differs from the one before: the smallest
 * rectangles around what both draw. */
void ph_lvgl_update(lv_obj_t *obj);

/* The background has changed, or anything else that lies outside of what is drawn: invalidates all. */
void ph_lvgl_update_all(lv_obj_t *obj);

#ifdef __cplusplus
}
#endif

#endif
