/*
 * Fog: 32 distances at which the fog's share of a colour grows by 1/32, as codes of the depth buffer. So a pixel takes
 * comparisons, and no division, in every depth format. See render.h.
 */
#include "band.h"
#include "blend.h"
#include "cores.h"
#include "depth.h"
#include "fog.h"
#include "kernels.h"
#include "list.h"
#include "pairs.h"
#include "planes.h"

void ph_fog_start(struct ph_fog_here *fog, const struct ph_renderer *r, uint16_t colour)
{
    *fog = (struct ph_fog_here){r->fog_codes, ph_spread(colour), UINT32_MAX, 0, {32, 0, 0}};
}

void ph_fog_find(struct ph_fog_here *fog, uint32_t code)
{
    const uint32_t *const codes = fog->codes;
    uint32_t share = 32 - fog->mix.left; /* a guess */
    while (share < 32 && code <= codes[share]) {
        share++;
    }
    while (share > 0 && code > codes[share - 1]) {
        share--;
    }
    fog->below = share < 32 ? codes[share] : 0;
    fog->most = share > 0 ? codes[share - 1] : UINT32_MAX;
    const uint32_t colour = fog->colour | fog->colour >> 16; /* as a number, in its low half */
    fog->mix.left = 32 - share;
    fog->mix.added = fog->colour * share + PH_SPREAD_HALF;
    fog->mix.others = ((colour << 16 | (colour & 0xffff)) & ~PH_SPREAD) / 32 * share + PH_PAIR_HALF;
}

/* See struct ph_fogging. */
static void fog_run(struct ph_fog_here *fog, uint16_t *pixels, const void *codes, uint32_t n, bool depth24)
{
    const uint32_t *const codes24 = codes;
    const uint16_t *const codes16 = codes;
    for (uint32_t i = 0; i < n;) {
        const uint32_t code = depth24 ? codes24[i] : codes16[i];
        uint32_t from = 0, size = 1; /* the codes that have the same fog: empty ones have none */
        if (code > 0) {
            ph_fog_at(fog, code);
            from = fog->below + 1;
            size = fog->most - fog->below;
        }
        const struct ph_fog_mix *const mix = code > 0 && fog->mix.left < 32 ? &fog->mix : NULL;
        if (!depth24) {
            i += ph_fog_alike(pixels + i, codes16 + i, n - i, from, size, mix);
        } else {
            const uint16_t any = (uint16_t)from; /* one code at a time */
            i += ph_fog_alike(pixels + i, &any, 1, any, 1, mix);
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
    if (r->list.stage == PH_LIST_CLOSED) {
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
