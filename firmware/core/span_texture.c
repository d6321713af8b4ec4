/* A run of textured pixels: see hot.h. */
#include "hot.h"
#include "span.h"

/*
 * 2^32 v + u, for additions of both at once: u is never negative at a pixel, so v there is just the upper half,
 * whatever their steps' signs.
 */
static inline uint64_t both(uint32_t u, uint32_t v)
{
    return ((uint64_t)v << 32) + (uint64_t)(int64_t)(int32_t)u;
}

void ph_span_texture(struct ph_texel_run *run, uint32_t n)
{
    const uint16_t *const texels = run->texels;
    uint16_t *const depth = run->depth, *const pixels = run->pixels;
    const uint32_t gd = run->gd, row_mask = run->row_mask;
    const uint64_t bend = both(run->ddu, run->ddv);
    uint64_t at = both(run->u, run->v), step = both(run->du, run->dv);
    uint32_t d = run->d;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t code = d >> 16;
        if (code > depth[i]) {
            PH_KEEP_BRANCH();
            depth[i] = (uint16_t)code;
            pixels[i] = texels[((uint32_t)(at >> 48) & row_mask) + ((uint32_t)at >> 16)];
        }
        d += gd;
        at += step;
        step += bend;
    }
    run->d = d;
    run->depth += n;
    run->pixels += n;
}
