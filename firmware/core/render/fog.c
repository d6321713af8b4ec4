/*
 * Fog: 32 distances at which the fog's share of a colour grows by 1/32, as codes of the depth buffer. So a pixel takes
 * comparisons, and no division, in every depth format. See render.h.
 */
#include "band.h"
#include "blend.h"
#include "cores.h"
#include "depth.h"
#include "fog.h"
#include "list.h"
#include "planes.h"

void ph_fog_start(struct ph_fog_here *fog, const struct ph_renderer *r, uint16_t colour)
{
    *fog = (struct ph_fog_here){r->fog_codes, ph_spread(colour), UINT32_MAX, 0, 32, 0};
}

void ph_fog_find(struct ph_fog_here *fog, uint32_t code)
{
    const uint32_t *const codes = fog->codes;
    uint32_t share = 32 - fog->left; /* a guess */
    while (share < 32 && code <= codes[share]) {
        share++;
    }
    while (share > 0 && code > codes[share - 1]) {
        share--;
    }
    fog->below = share < 32 ? codes[share] : 0;
    fog->most = share > 0 ? codes[share - 1] : UINT32_MAX;
    fog->left = 32 - share;
    fog->added = fog->colour * share + PH_SPREAD_HALF;
}

/* See struct ph_fogging. */
static void fog_run(struct ph_fog_here *fog, uint16_t *pixels, const void *codes, uint32_t n, bool depth24)
{
    const uint32_t *const codes24 = codes;
    const uint16_t *const codes16 = codes;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t code = depth24 ? codes24[i] : codes16[i];
        if (code == 0) {
            continue;
        }
        ph_fog_at(fog, code);
        if (fog->left < 32) {
            pixels[i] = ph_fold(ph_fogged(fog, ph_spread(pixels[i])));
        }
    }
}

static void fog_rows(const struct ph_renderer *r, const struct ph_band *band)
{
    struct ph_fog_here fog;
    ph_fog_start(&fog, r, r->fog_of.colour);
    fog_run(&fog, band->pixels, band->depth, (uint32_t)(band->y1 - band->y0) * (uint32_t)band->width, band->depth24);
}

static void fog_share(void *argument) /* called as run */
{
    const struct ph_share *const s = argument;
    fog_rows(s->r, &s->band);
}

static void fog_band(struct ph_renderer *r, const struct ph_band *band)
{
    ph_draw_in_parts(r, band, (band->y1 - band->y0) / 2, fog_share);
}

static const struct ph_fogging fogging = {.fog_band = fog_band, .fog_rows = fog_rows, .fog_run = fog_run};

PH_TIER(seldom) int ph_frame_fog(struct ph_renderer *r, const struct ph_fog *fog)
{
    if (r->list.is_closed == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    if (fog == NULL || fog->start >= fog->end) {
        return PH_ERR_INVAL;
    }
    for (int i = 0; i < 32; i++) {
        const fx_t w = (fx_t)(fog->start + (((int64_t)fog->end - fog->start) * (2 * i + 1) >> 6));
        r->fog_codes[i] = w <= r->lens.near_z ? UINT32_MAX
                          : w > r->lens.far_z ? 0
                                              : ph_depth_code(r, ph_depth_quotient(&r->lens, w), 0);
    }
    r->fog_of = *fog;
    r->fog = &fogging;
    return PH_OK;
}
