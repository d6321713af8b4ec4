/* Clipping: no overflow, no bad shift, no corner outside its array, for any corners and lens. See proof.h. */
#include "proof_render.h"

#include "../../firmware/core/render/clip.c"

void proof_distance(void)
{
    const struct ph_lens lens = any_lens();
    struct ph_clip_vertex v;
    const int64_t d = distance(&lens, &v, i32_between(0, PLANES - 1));
    CLAIM(d > -POWER(46) && d < POWER(46));
}

void proof_between(void)
{
    struct ph_clip_vertex a, b;
    ph_clip_between(&a, &b, i32_between(0, FX_Q30_ONE));
}

void proof_crossing(void)
{
    const struct ph_lens lens = any_lens();
    struct ph_clip_vertex a, b;
    crossing(&lens, &a, &b, i64_between(0, POWER(46)), i64_between(-POWER(46), -1), i32_between(0, PLANES - 1));
}

void proof_clip_plane(void)
{
    const struct ph_lens lens = any_lens();
    struct ph_clip_vertex in[PH_CLIP_MAX], out[PH_CLIP_MAX];
    const int n = clip_plane(&lens, in, i32_between(2, PH_CLIP_MAX), out, i32_between(0, PLANES - 1));
    CLAIM(n >= 0 && n <= PH_CLIP_MAX);
}

/* What clip_plane may do, as the proof above says. */
int any_corners(const struct ph_lens *lens, const struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out,
                int plane)
{
    (void)lens, (void)in, (void)n, (void)plane;
    struct ph_clip_vertex any;
    out[PH_CLIP_MAX - 1] = any;
    return i32_between(0, PH_CLIP_MAX);
}

/* What distance reads; it returns anything. */
int64_t any_distance(const struct ph_lens *lens, const struct ph_clip_vertex *v, int plane)
{
    (void)plane;
    return nondet_i64() + (lens->kind & 0) + (v->uv[1] & 0);
}

void proof_clip(void)
{
    const struct ph_lens lens = any_lens();
    struct ph_clip_vertex in[3], out[PH_CLIP_MAX];
    ph_clip(&lens, in, i32_between(2, 3), out);
}
