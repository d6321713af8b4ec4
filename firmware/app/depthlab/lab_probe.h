/*
 * lab_probe: the depth code of a plane that faces the camera at a distance, in each format of the depth lab. In drawn
 * formats a triangle at this distance goes through ph_draw_mesh, ph_frame_bands and ph_draw_band, and the code is read
 * from the depth buffer. In the others a formula in integers gives it, see lab_formats.h.
 */
#ifndef LAB_PROBE_H
#define LAB_PROBE_H

#include "lab_formats.h"

/* Holds pointers into itself once it is open, so it must stay in its place. */
struct lab_probe {
    const struct lab_format *format;
    fx_t near_z, far_z;
    uint32_t largest;   /* 2^bits - 1 */
    fx_t scale, bias;   /* clip z = scale w - bias */
    uint64_t log_far;   /* lab_log2_q56 */
    uint64_t log_range; /* log_far less the logarithm of near */
    struct ph_projection lens;
    struct ph_renderer renderer;
    uint64_t vertices[16], triangles[32]; /* room for three and for one */
    uint32_t bin;
    union {
        uint16_t code16;
        uint32_t code24;
    } depth; /* ph_depth_bytes of it */
    uint16_t pixel;
};

/* Opens a probe of a format. 0, PH_ERR_INVAL, or PH_ERR_NOMEM: the renderer's triangles are larger than the room
 * here. */
int lab_probe_open(struct lab_probe *p, const struct lab_format *format, fx_t near_z, fx_t far_z);

/* The depth code at distance w, from near_z to far_z; larger is nearer. */
uint32_t lab_code(struct lab_probe *p, fx_t w);

/* Whether the code never rises with w, so that a search may bisect. `pinhole-depth monotone` proves it if drawn. */
static inline bool lab_is_monotone(const struct lab_format *format)
{
    return format->kind != LAB_NDC_Q16 && format->kind != LAB_RECIP_Q16 && format->kind != LAB_CLIP_Q16;
}

#endif
