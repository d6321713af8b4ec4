/* Clipping of the small profile: render/clip.c plane by plane, in room that the frame has taken. See small.h. */
#include "../clip.c"

#include "small.h"

int ph_small_clip(const struct ph_lens *lens, struct ph_small_clip *clip, const struct ph_clip_vertex **corners)
{
    const struct ph_clip_vertex *from = clip->work[0];
    int n = 3;
    for (int plane = 0; plane < PLANES && n >= 3; plane++) {
        if (!is_inside(lens, from, n, plane)) {
            struct ph_clip_vertex *const to = clip->work[from == clip->work[0]];
            n = clip_plane(lens, from, n, to, plane);
            from = to;
        }
    }
    *corners = from;
    return n;
}
