/* Depth codes: see lab_probe.h. */
#include "lab_probe.h"
#include "lab_num.h"

/* a / b rounded to nearest, a tie up; not negative. */
static int64_t nearest(int64_t a, int64_t b)
{
    return (a + b / 2) / b;
}

static int open_renderer(struct lab_probe *p)
{
    if (3 * ph_vertex_bytes > sizeof p->vertices || ph_triangle_bytes > sizeof p->triangles) {
        return PH_ERR_NOMEM;
    }
    const struct ph_config config = {.width = 1,
                                     .height = 1,
                                     .band_height = 1,
                                     .depth_format = p->format->format,
                                     .depth_exponent = p->format->exponent,
                                     .vertices = p->vertices,
                                     .vertex_max = 3,
                                     .triangles = p->triangles,
                                     .triangle_max = 1,
                                     .bins = &p->bin,
                                     .bin_max = 1,
                                     .depth = &p->depth};
    const int status = ph_projection_perspective(&p->lens, FX_INT(90), FX_ONE, p->near_z, p->far_z);
    return status != 0 ? status : ph_renderer_init(&p->renderer, &config);
}

int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z)
{
    if (near_z <= 0 || near_z >= far_z) {
        return PH_ERR_INVAL;
    }
    const int64_t depth = (int64_t)far_z - near_z;
    p->format = format;
    p->near_z = near_z;
    p->far_z = far_z;
    p->largest = ((uint32_t)1 << format->bits) - 1;
    p->scale = fx_sat64(nearest((int64_t)far_z * FX_ONE, depth));
    p->bias = fx_sat64(nearest((int64_t)far_z * near_z, depth));
    p->log_far = lab_log2_q56((uint32_t)far_z);
    p->log_range = p->log_far - lab_log2_q56((uint32_t)near_z);
    return format->kind == LAB_DRAWN ? open_renderer(p) : PH_OK;
}

/*
 * Draws a triangle that covers the pixel. It is four pixels wide, so that its rounded corners are well outside even one
 * LSB before the eye; one pixel where four do not fit Q16.16. It is flat, so its depth does not depend on its size.
 */
static uint32_t drawn_code(struct lab_probe *p, fx_t w)
{
    static const uint16_t faces[][3] = {{0, 1, 2}};
    static const struct ph_part all = {.count = 1};
    static const struct ph_material plain = {.shading = PH_SHADE_UNLIT};
    const fx_t r = w < FX_INT(4096) ? 4 * w : w;
    const struct fx_vec3 corners[] = {{-r, -r, -w}, {r, -r, -w}, {0, r, -w}};
    const struct ph_mesh mesh = {.positions = corners,
                                 .vertex_count = 3,
                                 .triangles = faces,
                                 .triangle_count = 1,
                                 .parts = &all,
                                 .part_count = 1,
                                 .materials = &plain};
    ph_frame_begin(&p->renderer, &ph_xform_identity, &p->lens, NULL, 0);
    ph_draw_mesh(&p->renderer, &mesh, &ph_xform_identity);
    ph_frame_bands(&p->renderer);
    ph_draw_band(&p->renderer, 0, &p->pixel);
    return ph_depth_bytes(p->format->format) == 4 ? p->depth.code24 : p->depth.code16;
}

static uint32_t from_near(const struct lab_probe *p, int64_t code)
{
    const int64_t inside = code < 0 ? 0 : code > p->largest ? p->largest : code;
    return p->largest - (uint32_t)inside;
}

/* ndc in Q16.16 as a code of all bits. */
static uint32_t ndc_code(const struct lab_probe *p, int64_t ndc)
{
    return from_near(p, ndc * ((int64_t)1 << (p->format->bits - 16)));
}

/* n/w as an unsigned float with 4 bits of exponent, its exponent and mantissa side by side. */
static uint32_t over_w_code(const struct lab_probe *p, fx_t w)
{
    const int mantissa = p->format->bits - 4;
    const uint64_t over = (uint64_t)p->near_z << 32, high = over / (uint32_t)w;
    if (high >> 32 != 0) { /* 1 has no code of its own */
        return p->largest;
    }
    const uint64_t d = high << 32 | ((over % (uint32_t)w) << 32) / (uint32_t)w; /* 2^-64 */
    const int zeros = high != 0 ? fx_clz32((uint32_t)high) : 32, octave = zeros < 14 ? zeros : 14;
    const uint32_t part =
        (uint32_t)(d << octave >> (63 - mantissa)); /* with the leading one, except in the lowest octave */
    return part + ((uint32_t)(14 - octave) << mantissa);
}

/* floor(S (ln far - ln w) / (ln far - ln near)), multiplied bit by bit of S; the quotient is counted on the way. */
static uint32_t log_code(const struct lab_probe *p, fx_t w)
{
    const uint64_t part = p->log_far - lab_log2_q56((uint32_t)w); /* up to range, below 2^61 */
    uint64_t rest = 0;
    uint32_t code = 0;
    for (int bit = 0; bit < p->format->bits; bit++) {
        rest = 2 * rest + part;
        code *= 2;
        while (rest >= p->log_range) { /* at most three times */
            rest -= p->log_range;
            code++;
        }
    }
    return code;
}

uint32_t lab_code(struct lab_probe *p, fx_t w)
{
    const int64_t clip = fx_sat64(((fx_mul_wide(p->scale, w) + FX_HALF) >> 16) - p->bias);
    switch (p->format->kind) {
    case LAB_DRAWN:
        return drawn_code(p, w);
    case LAB_NDC_Q16:
        return ndc_code(p, clip * FX_ONE / w);
    case LAB_RECIP_Q16:
        return ndc_code(p, (clip * fx_sat64(((int64_t)1 << 32) / w) + FX_HALF) >> 16);
    case LAB_CLIP_Q16:
        return from_near(p, (clip * p->largest + w / 2) / w);
    case LAB_LINEAR:
        return (uint32_t)((int64_t)p->largest * (p->far_z - w) / (p->far_z - p->near_z));
    case LAB_OVER_W:
        return over_w_code(p, w);
    default:
        return log_code(p, w);
    }
}
