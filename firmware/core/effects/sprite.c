/* Pictures over the picture: see overlay.h; and in the scene: see render.h. */
#include "blend.h"
#include "overlay.h"
#include "render.h"

/* Copies n pixels; 8 a turn, because a turn costs as much as two of them. */
static void copy(uint16_t *to, const uint16_t *from, uint32_t n)
{
    for (; n >= 8; n -= 8, to += 8, from += 8) {
        to[0] = from[0];
        to[1] = from[1];
        to[2] = from[2];
        to[3] = from[3];
        to[4] = from[4];
        to[5] = from[5];
        to[6] = from[6];
        to[7] = from[7];
    }
    for (; n > 0; n--) {
        *to++ = *from++;
    }
}

/* Lays n pixels of a row; from: their index in the sprite. */
static void lay(uint16_t *to, const struct ph_sprite *sprite, uint32_t from, uint32_t n)
{
    const uint32_t alpha = sprite->alpha < 32 ? sprite->alpha : 32;
    for (uint32_t i = 0; i < n; i++) {
        const uint16_t colour = sprite->pixels[from + i];
        if (sprite->has_key && colour == sprite->key) {
            continue;
        }
        const uint32_t own = sprite->alphas != NULL ? (sprite->alphas[from + i] * alpha + 16) >> 5 : alpha;
        to[i] = own >= 32 ? colour : ph_mix(to[i], colour, own);
    }
}

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

// NOLINTNEXTLINE(readability-non-const-parameter): the pixels are written through the struct
void ph_overlay_sprite(const struct ph_overlay_band *band, int32_t x, int32_t y, const struct ph_sprite *sprite)
{
    if (x < -65535 || x > 65535 || y < -65535 || y > 65535) {
        return;
    }
    const int32_t left = x > 0 ? x : 0, right = smaller(x + sprite->width, band->width);
    const int32_t top = y > band->y0 ? y : band->y0, end = smaller(y + sprite->height, band->y0 + band->lines);
    if (left >= right || top >= end) {
        return;
    }
    const bool covers = sprite->alpha >= 32 && sprite->alphas == NULL && !sprite->has_key;
    const uint32_t n = (uint32_t)(right - left);
    uint32_t from = (uint32_t)(top - y) * sprite->width + (uint32_t)(left - x);
    uint16_t *to = band->pixels + (top - band->y0) * band->width + left;
    for (int32_t row = top; row < end; row++, from += sprite->width, to += band->width) {
        if (covers) {
            copy(to, sprite->pixels + from, n);
        } else {
            lay(to, sprite, from, n);
        }
    }
}

int ph_draw_billboard(struct ph_renderer *r, struct fx_vec3 centre, fx_t width, fx_t height,
                      const struct ph_material *material)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const fx_t uvs[4][2] = {{0, FX_ONE}, {FX_ONE, FX_ONE}, {FX_ONE, 0}, {0, 0}};
    static const struct ph_part part = {.count = 2};
    const struct ph_xform *const v = &r->view; /* its rows are the directions of the picture in the world */
    fx_t add[4][3];
    for (int k = 0; k < 3; k++) {
        const int64_t right = fx_mul_wide(v->r[0][k], width / 2), up = fx_mul_wide(v->r[1][k], height / 2);
        add[0][k] = (fx_t)((-right - up) >> 30);
        add[1][k] = (fx_t)((right - up) >> 30);
        add[2][k] = (fx_t)((right + up) >> 30);
        add[3][k] = (fx_t)((up - right) >> 30);
    }
    struct fx_vec3 corners[4];
    for (int i = 0; i < 4; i++) {
        corners[i] = fx_vec3_add_sat(centre, (struct fx_vec3){add[i][0], add[i][1], add[i][2]});
    }
    const struct ph_mesh mesh = {.positions = corners,
                                 .uvs = uvs,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = material,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    return ph_draw_mesh(r, &mesh, &ph_xform_identity);
}
