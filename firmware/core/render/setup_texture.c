/* Texture of a triangle: see setup_texture.h. */
#include "setup_texture.h"

#include "setup_depth.h"

/*
 * u or v of the corners, Q16.16. If the texture repeats, a whole number of repeats is subtracted so that none is
 * negative. Returns the log2 of their range.
 */
static int texture_range(const struct ph_texture *texture, const fx_t *const uv[3], int axis, uint32_t out[3])
{
    const bool repeats = texture->wrap == PH_WRAP_REPEAT;
    const int32_t a = uv[0][axis], b = uv[1][axis], c = uv[2][axis], ab = a < b ? a : b, least = ab < c ? ab : c;
    uint32_t most = 1;
    for (int i = 0; i < 3; i++) {
        out[i] = (uint32_t)uv[i][axis] - (repeats ? (uint32_t)least & ~(uint32_t)0xffff : 0);
        const uint32_t size = repeats ? out[i] : fx_magnitude((int32_t)out[i]);
        most = size > most ? size : most;
    }
    const int log2 = 16 - fx_clz32(most - 1);
    return log2 > 0 ? log2 : 0;
}

void ph_setup_texture(const struct ph_renderer *r, const struct ph_plane_base *s, const struct ph_vertex *const v[3],
                      const fx_t *const corner_uv[3], struct ph_triangle *t)
{
    static const fx_t origin[2];
    static const fx_t *const origins[3] = {origin, origin, origin};
    const fx_t *const *from = corner_uv != NULL ? corner_uv : origins;
    const struct ph_texture *const texture = t->material->texture;
    const uint32_t positive = (uint32_t)1 << 28;
    uint32_t uv[2][3];
    const int range_u = texture_range(texture, from, 0, uv[0]), range_v = texture_range(texture, from, 1, uv[1]);
    const int range = range_u > range_v ? range_u : range_v;
    const bool perspective = r->lens.kind != PH_ORTHOGRAPHIC;
    const int least = ph_least_exponent(v);
    uint32_t w[3]; /* 1/w to a common exponent, up to 2^29 */
    for (int i = 0; i < 3; i++) {
        w[i] = perspective ? ph_over_w(v[i], least) : (uint32_t)1 << 28;
    }
    for (int axis = 0; axis < 2; axis++) {
        uint32_t over_w[3]; /* u / (4 range w): at most 2^27; then made positive */
        for (int i = 0; i < 3; i++) {
            const uint32_t u = uv[axis][i];
            const int32_t share = range <= 14 ? (int32_t)(u << (14 - range)) : (int32_t)u >> (range - 14); /* Q2.30 */
            over_w[i] = (uint32_t)(fx_mul_wide(share, (int32_t)w[i]) >> 32) + positive;
        }
        ph_plane_through(&t->attribute[axis], s, over_w, 31);
        t->attribute[axis].base -= positive;
    }
    if (t->block != PH_BLOCK_LINEAR) { /* linear-w has it as its depth */
        ph_plane_through(&t->attribute[2], s, w, 31);
    }
    t->range_log2 = (uint8_t)range;
}
