/*
 * Fog: 32 distances at which the fog's share of a colour grows by 1/32, as codes of the depth buffer. So a pixel takes
 * comparisons, and no division, in every depth format. See render.h.
 */
#include "band.h"
#include "blend.h"
#include "cores.h"
#include "depth.h"
#include "fog.h"
#include "planes.h"

/* The depth code at a distance, 1 or more: that of a triangle which keeps it. */
static uint32_t code_at(const struct ph_renderer *r, fx_t w)
{
    const struct ph_lens *const lens = &r->lens;
    const unsigned format = r->stats.depth_format;
    struct ph_vertex v = {.code = 0};
    const struct ph_vertex *const corners[3] = {&v, &v, &v};
    uint32_t d[3];
    ph_vertex_depth(&v, ph_depth_quotient(lens, w));
    if (format == PH_DEPTH_FLOAT16 || format == PH_DEPTH_FLOAT24) {
        ph_block_depths(r, corners, 0, d);
    } else if (format == PH_DEPTH_LINEAR_W && lens->kind != PH_ORTHOGRAPHIC) {
        struct ph_linear linear = lens->linear;
        linear.down = (int8_t)(linear.down - v.s);
        d[0] = ph_depth_linear(&linear, v.q >> 2);
    } else {
        d[0] = ph_depth_at(lens, (struct ph_quotient){v.q, v.s}, 0) + PH_DEPTH_BIAS_FIXED16;
    }
    return d[0] >> (ph_depth_bytes(format) == sizeof(uint32_t) ? 8 : 16);
}

/* The share of the fog at that code; `share` is a guess. */
uint32_t ph_fog_share(const uint32_t codes[32], uint32_t code, uint32_t share)
{
    while (share < 32 && code <= codes[share]) {
        share++;
    }
    while (share > 0 && code > codes[share - 1]) {
        share--;
    }
    return share;
}

/* Pixels that one core fogs. */
struct fog_share {
    const struct ph_renderer *r;
    uint16_t *pixels;
    const void *depth;
    uint32_t n;
    bool depth24;
};

/* Fogs the pixels that are not empty. Neighbours mostly have the same share of the fog: it is kept with its codes. */
static void fog_share(void *argument)
{
    const struct fog_share *const s = argument;
    const uint32_t *const depth24 = s->depth24 ? s->depth : NULL, *const codes = s->r->fog_codes;
    const uint16_t *const depth16 = s->depth;
    uint32_t share = 0, below = UINT32_MAX, most = 0; /* below < code <= most */
    uint32_t left = 0, fog = 0;                       /* the pixel's own part of 32, and the fog's with a half */
    for (uint32_t i = 0; i < s->n; i++) {
        const uint32_t code = depth24 != NULL ? depth24[i] : depth16[i];
        if (code == 0) {
            continue;
        }
        if (code <= below || code > most) {
            share = ph_fog_share(codes, code, share);
            below = share < 32 ? codes[share] : 0;
            most = share > 0 ? codes[share - 1] : UINT32_MAX;
            left = 32 - share;
            fog = ph_spread(s->r->fog_of.colour) * share + PH_SPREAD_HALF;
        }
        if (share > 0) {
            s->pixels[i] = ph_fold((ph_spread(s->pixels[i]) * left + fog) >> 5 & PH_SPREAD);
        }
    }
}

/* Fogs a band, half of it on the other core. */
static void fog_band(struct ph_renderer *r, const struct ph_band *band)
{
    const uint32_t n = (uint32_t)(band->y1 - band->y0) * (uint32_t)band->width, half = n / 2;
    struct fog_share mine = {r, band->pixels, band->depth, half, band->depth24};
    struct fog_share others = {r, band->pixels + half, ph_depth_from(band->depth, half, band->depth24), n - half,
                               band->depth24};
    ph_run_both(r, fog_share, &mine, &others);
}

int ph_frame_fog(struct ph_renderer *r, const struct ph_fog *fog)
{
    if (fog->start >= fog->end) {
        return PH_ERR_INVAL;
    }
    for (int i = 0; i < 32; i++) {
        const fx_t w = (fx_t)(fog->start + (((int64_t)fog->end - fog->start) * (2 * i + 1) >> 6));
        r->fog_codes[i] = w <= r->lens.near_z ? UINT32_MAX : w > r->lens.far_z ? 0 : code_at(r, w);
    }
    r->fog_of = *fog;
    r->fog = fog_band;
    return PH_OK;
}
