/* Slots and rows of a band, for one core and for two. See band_rest.h. */
/* Kits on armv6m: -O2. */
#include "band_rest.h"

#include "band.h"
#include "kernels.h"

/* A slot behind the `used` bytes at base, or NULL. */
static inline struct ph_triangle *slot_behind(void *base, uint32_t *used, size_t room)
{
    const uint32_t at = *used;
    if (at + sizeof(struct ph_triangle) > room) {
        return NULL;
    }
    *used = (uint32_t)(at + sizeof(struct ph_triangle));
    return (struct ph_triangle *)(void *)((uint8_t *)base + at);
}

PH_TIER(mesh) struct ph_triangle *ph_take_fresh_slot(struct ph_renderer *r)
{
    const struct ph_config *const c = &r->config;
    struct ph_triangle *const t =
        slot_behind(c->triangles, &r->slots_used[1], (size_t)((uint8_t *)r->list.to - (uint8_t *)c->triangles));
    return t == NULL && c->vertices != c->triangles
               ? slot_behind(c->vertices, &r->slots_used[0], c->vertex_max * ph_vertex_bytes)
               : t;
}

PH_TIER(mesh) void ph_clear_depth(const struct ph_band *rows)
{
    const uint32_t area = (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width;
    ph_fill(rows->depth, 0, rows->depth24 ? 2 * area : area);
}

PH_TIER(mesh) void ph_clear_rows(const struct ph_renderer *r, const struct ph_band *rows)
{
    if (r->samples_log2 == 0) {
        ph_fill(rows->pixels, r->background, (uint32_t)(rows->y1 - rows->y0) * (uint32_t)rows->width);
    }
    ph_clear_depth(rows);
}

PH_TIER(mesh) void ph_change_lens(struct ph_renderer *r, uint32_t place)
{
    r->lens = *(const struct ph_lens *)ph_at(r, place);
    r->list.lens = place;
}
