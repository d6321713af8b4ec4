/* ph_frame_box: where a frame draws. See render.h. */
#include "list.h"

static int32_t within(int32_t at, int32_t size)
{
    return at < 0 ? 0 : at < size ? at : size;
}

bool ph_frame_box(const struct ph_renderer *r, struct ph_rectangle *box)
{
    const int32_t width = r->config.width, height = r->config.height;
    struct ph_box all = {width, 0, height, 0};
    if (r->list.stage == PH_LIST_CLOSED) {
        *box = (struct ph_rectangle){0, 0, 0, 0};
        return false;
    }
    if (r->points != NULL) {
        all = (struct ph_box){0, width, 0, height};
    }
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        const uint32_t end = (draw->kind & PH_DRAW_POINTS) != 0 ? draw->first : ph_end_of_draw(r, draw);
        for (uint32_t i = draw->first; i < end; i++) {
            const struct ph_box one = ph_box_of(r, draw, ph_ref_at(r, i));
            all.x0 = one.x0 < all.x0 ? one.x0 : all.x0;
            all.x1 = one.x1 > all.x1 ? one.x1 : all.x1;
            all.y0 = one.y0 < all.y0 ? one.y0 : all.y0;
            all.y1 = one.y1 > all.y1 ? one.y1 : all.y1;
        }
        place = draw->next;
    }
    const int32_t x0 = within(all.x0, width) >> r->samples_log2, y0 = within(all.y0, height) >> r->samples_log2;
    const int32_t x1 = (within(all.x1, width) + r->samples_log2) >> r->samples_log2,
                  y1 = (within(all.y1, height) + r->samples_log2) >> r->samples_log2;
    const bool any = x0 < x1 && y0 < y1;
    *box = any ? (struct ph_rectangle){(uint16_t)x0, (uint16_t)y0, (uint16_t)(x1 - x0), (uint16_t)(y1 - y0)}
               : (struct ph_rectangle){0, 0, 0, 0};
    return any;
}
