/*
 * Depth of field: see blur.h. The blur of a pixel is its radius in 1/16 px, positive in front of the focal plane and
 * negative behind it. So the nearer of two pixels has the larger blur.
 *
 * The depth d = N/z - N/f is linear in the code (of the floats: in the unpacked code), see depth.h. So is the radius:
 * strength |1 - focal / z| = strength focal / N |d - d of focal|. d is in units of 2^-20; 16 bits of a 24-bit code are
 * enough.
 */
#include "blur.h"

#include "colour.h"
#include "cores.h"
#include "depth.h"

#define WHOLE 2048 /* sum of all weights of a pixel */

/* d at a distance along the view. */
static int32_t depth_at(const struct ph_lens *lens, fx_t z)
{
    return (int32_t)(ph_depth_at(lens, ph_depth_quotient(lens, z), 0) >> 12);
}

/* d of a linear-w code, computed from the distance. */
PH_NOINLINE static int32_t depth_of_linear(const struct ph_blur *b, uint32_t code)
{
    const struct ph_lens *lens = &b->lens;
    const uint32_t range = (uint32_t)lens->far_z - (uint32_t)lens->near_z, top = 65408; /* 65536 (1 - 2^-9) */
    const uint32_t share = code < 16 ? 0 : code - 16 < top ? code - 16 : top;
    const uint32_t before_far = fx_mulhi_u32(range, (share << 16) + (share << 7)); /* / 65408, less than 2^-16 off */
    const fx_t z = (fx_t)((uint32_t)lens->far_z - before_far);
    return depth_at(lens, z);
}

/* d of a depth code. */
static inline int32_t depth_of(const struct ph_blur *b, uint32_t code)
{
    if (b->wide) {
        code >>= 8;
    }
    if (b->coding == PH_DEPTH_IS_FIXED) {
        return (int32_t)code * 16 - 260;
    }
    if (b->coding == PH_DEPTH_IS_LINEAR) {
        return depth_of_linear(b, code);
    }
    const int mantissa = 15 - b->lens.float_down, least = (2 << b->lens.float_down) + mantissa - 21;
    const uint32_t f = code > 8 ? code - 8 : 0, exponent = f >> mantissa, octave = exponent > 1 ? exponent - 1 : 0;
    const int up = (int)octave - least;
    const uint32_t value = f - (octave << mantissa); /* with the leading one, except in the lowest octave */
    return (int32_t)(up >= 0 ? value << up : up > -32 ? value >> -up : 0);
}

static inline int32_t blur_at(const struct ph_blur *b, int32_t depth)
{
    const int32_t d = depth - b->focal_d;
    const uint32_t size = fx_magnitude(d);
    const uint32_t radius = size >= b->limit ? b->most : (size * b->per_d) >> 24;
    return d < 0 ? -(int32_t)radius : (int32_t)radius;
}

static inline int8_t blur_of(const struct ph_blur *b, uint32_t code)
{
    if (code == 0) {
        return b->empty;
    }
    return (int8_t)blur_at(b, depth_of(b, code));
}

int32_t ph_blur_at(const struct ph_blur *blur, fx_t z)
{
    return blur_at(blur, depth_at(&blur->lens, z));
}

static int32_t smaller(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

/* N of depth.h, rounded up. */
static int64_t near_of(const struct ph_lens *lens)
{
    const int down = lens->near_shift;
    return down < 0 ? (int64_t)lens->depth_scale << -down : (lens->depth_scale + ((int64_t)1 << down) - 1) >> down;
}

static void set_scale(struct ph_blur *b, const struct ph_lens *lens, const struct ph_focus *focus)
{
    const fx_t z = focus->distance < lens->near_z  ? lens->near_z
                   : focus->distance > lens->far_z ? lens->far_z
                                                   : focus->distance;
    b->focal_d = depth_at(lens, z);
    const bool parallel = lens->kind == PH_ORTHOGRAPHIC;
    const int64_t over = parallel ? FX_ONE : z, under = parallel ? FX_ONE - (FX_ONE >> 9) : near_of(lens);
    const int64_t per_d = (int64_t)focus->strength * over / under >> 8; /* 256 per px */
    b->per_d = per_d < 1 ? 1 : per_d > 1 << 24 ? 1 << 24 : (uint32_t)per_d;
    b->most = (uint8_t)(16 * focus->radius + 15);
    b->limit = ((uint32_t)b->most << 24) / b->per_d;
    const int32_t far = (focus->strength + 2048) >> 12;
    b->empty = (int8_t)(parallel ? blur_of(b, 1) : -smaller(far, b->most));
}

int ph_blur_begin(struct ph_blur *blur, const struct ph_renderer *r, void *scratch, size_t bytes,
                  const struct ph_focus *focus)
{
    const uint32_t width = (uint32_t)r->config.width >> r->samples_log2,
                   lines = (uint32_t)r->config.band_height >> r->samples_log2;
    if (scratch == NULL || focus->distance <= 0 || focus->strength < 0 || focus->strength > FX_INT(64) ||
        focus->radius < 1 || focus->radius > PH_BLUR_RADIUS_MAX) {
        return PH_ERR_INVAL;
    }
    if (bytes < PH_BLUR_BYTES(width, lines, focus->radius)) {
        return PH_ERR_NOMEM;
    }
    struct ph_blur b = {
        .colours = scratch, .radius = focus->radius, .coding = r->stats.depth_format->coding, .lens = r->lens};
    b.wide = ph_depth_bytes(r->config.depth_format) == sizeof(uint32_t);
    b.lines = (uint32_t)PH_BLUR_LINES(lines, focus->radius);
    b.blurs = (int8_t *)(b.colours + width * b.lines);
    set_scale(&b, &r->lens, focus);
    for (uint32_t c = 17; c < 128; c++) {
        b.share[c] = (uint16_t)((uint32_t)WHOLE * 256 / (2 * c - 16));
    }
    *blur = b;
    return PH_OK;
}

/* The weighted sum of a pixel: red and blue in one word, green, and the weight that is left for the pixel itself. */
struct mix {
    uint32_t red_blue, green;
    uint32_t rest;
};

static inline uint32_t red_blue_of(uint32_t colour)
{
    return (colour & 0xf800) << 5 | (colour & 31);
}

/*
 * Adds a neighbour k16 / 16 pixels away, if the blur of the nearer of the two pixels reaches that far. All pixels
 * within the radius have the same weight, 1 / (2 radius - 1); the outermost has a part of it.
 */
static inline void add(struct mix *m, const struct ph_blur *b, int32_t own, int32_t other, int32_t k16, uint32_t colour)
{
    const int32_t nearer = own > other ? own : other, radius = nearer < 0 ? -nearer : nearer, over = radius - k16;
    if (over > 0) {
        uint32_t share = ((uint32_t)(over < 16 ? over : 16) * b->share[radius]) >> 8;
        share = share < m->rest ? share : m->rest;
        m->red_blue += red_blue_of(colour) * share;
        m->green += (colour >> 5 & 63) * share;
        m->rest -= share;
    }
}

static inline uint16_t finish(const struct mix *m, uint32_t colour)
{
    const uint32_t red_blue = m->red_blue + red_blue_of(colour) * m->rest + WHOLE / 2 * 0x10001u;
    const uint32_t green = m->green + (colour >> 5 & 63) * m->rest + WHOLE / 2;
    return (uint16_t)((red_blue >> 27) << 11 | (green >> 11) << 5 | (red_blue >> 11 & 31));
}

/* First pass: blurs line y of the picture along itself, into the ring. */
static void take_line(const struct ph_blur *b, uint32_t y, const uint16_t *pixels, const void *depth, int samples_log2,
                      int32_t width)
{
    const uint32_t line = y % b->lines;
    uint16_t *out = b->colours + line * (uint32_t)width;
    int8_t *blurs = b->blurs + line * (uint32_t)width;
    for (int32_t x = 0; x < width; x++) {
        const int32_t at = x << samples_log2; /* the first sample of the pixel */
        blurs[x] = blur_of(b, b->wide ? ((const uint32_t *)depth)[at] : ((const uint16_t *)depth)[at]);
    }
    for (int32_t x = 0; x < width; x++) {
        struct mix m = {0, 0, WHOLE};
        for (int32_t k = 1; k <= b->radius; k++) {
            if (x >= k) {
                add(&m, b, blurs[x], blurs[x - k], 16 * k, ph_wire16(pixels[x - k]));
            }
            if (x + k < width) {
                add(&m, b, blurs[x], blurs[x + k], 16 * k, ph_wire16(pixels[x + k]));
            }
        }
        out[x] = finish(&m, ph_wire16(pixels[x]));
    }
}

/* Second pass: blurs line y of the ring across the lines. */
static void give_line(const struct ph_blur *b, uint32_t y, uint32_t height, uint32_t width, uint16_t *pixels)
{
    const uint32_t here = y % b->lines * width;
    uint32_t at[2 * PH_BLUR_RADIUS_MAX]; /* where lines y - 1, y + 1, y - 2 .. start in the ring */
    int32_t away16[2 * PH_BLUR_RADIUS_MAX];
    uint32_t count = 0;
    for (uint32_t k = 1; k <= b->radius; k++) {
        for (uint32_t side = 0; side < 2; side++) {
            const uint32_t line = side == 0 ? y - k : y + k; /* above the picture it wraps to a large value */
            if (line < height) {
                away16[count] = (int32_t)(16 * k);
                at[count++] = line % b->lines * width;
            }
        }
    }
    for (uint32_t x = 0; x < width; x++) {
        struct mix m = {0, 0, WHOLE};
        const int32_t own = b->blurs[here + x];
        for (uint32_t i = 0; i < count; i++) {
            add(&m, b, own, b->blurs[at[i] + x], away16[i], b->colours[at[i] + x]);
        }
        pixels[x] = ph_wire16(finish(&m, b->colours[here + x]));
    }
}

/* Lines that one core blurs: from .. end - 1 of the lines at `pixels`. */
struct blur_share {
    const struct ph_blur *b;
    const struct ph_renderer *r;
    uint16_t *pixels;
    uint32_t y0, from, end; /* y0: the line at `pixels` */
    bool across;            /* the second pass */
};

static void blur_share(void *argument) /* called as run */
{
    const struct blur_share *const s = argument;
    const int samples_log2 = s->r->samples_log2;
    const uint32_t width = (uint32_t)s->r->config.width >> samples_log2,
                   height = (uint32_t)s->r->config.height >> samples_log2;
    for (uint32_t i = s->from; i < s->end; i++) {
        if (s->across) {
            give_line(s->b, s->y0 + i, height, width, s->pixels + i * width);
        } else {
            const uint8_t *const depth = s->r->config.depth;
            take_line(s->b, s->y0 + i, s->pixels + i * width,
                      depth + (i * width << 2 * samples_log2) * (s->b->wide ? 4 : 2), samples_log2, (int32_t)width);
        }
    }
}

/* NOLINTNEXTLINE(readability-non-const-parameter): the pixels are written through the struct */
static void blur_lines(const struct ph_blur *b, const struct ph_renderer *r, uint16_t *pixels, uint32_t y0,
                       uint32_t count, bool across)
{
    struct blur_share upper = {b, r, pixels, y0, 0, count / 2, across},
                      lower = {b, r, pixels, y0, count / 2, count, across};
    ph_run_both(r, blur_share, &upper, &lower);
}

uint32_t ph_blur_band(struct ph_blur *blur, struct ph_renderer *r, uint32_t band, uint16_t *pixels)
{
    const uint32_t height = (uint32_t)r->config.height >> r->samples_log2,
                   lines = (uint32_t)r->config.band_height >> r->samples_log2;
    const uint32_t y0 = band * lines, y1 = y0 + lines < height ? y0 + lines : height;
    const uint32_t needed = y1 + blur->radius < height ? y1 + blur->radius : height;
    while (blur->drawn < needed) { /* a band each time */
        const uint32_t come = ph_draw_band(r, blur->next_band++, pixels);
        blur_lines(blur, r, pixels, blur->drawn, come, false);
        blur->drawn += come;
    }
    blur_lines(blur, r, pixels, y0, y1 - y0, true);
    return y1 - y0;
}
