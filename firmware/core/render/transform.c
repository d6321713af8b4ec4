/*
 * Vertices: one matrix for each mesh, the divide by w, clip codes. See transform.h.
 *
 * ph_vertices of vertices.h does this for vertices of a perspective that lie in front of the eye, in the guard
 * band and nearer than 4096.0; place_vertex here does it for all others.
 */
#include "transform.h"

#include "fisheye.h"
#include "vertices.h"

/* Row 0 or 1 of the clip matrix: that of the view times `scale`. */
PH_TIER(mesh)
static void fold_row(struct ph_clip_matrix *out, int row, const struct ph_xform *object_to_view, int32_t scale)
{
    for (int j = 0; j < 3; j++) {
        out->m[row][j] = (int32_t)((fx_mul_wide(object_to_view->r[row][j], scale) + ((int64_t)1 << 31)) >> 32);
    }
    const int32_t along = row == 0 ? object_to_view->t.x : object_to_view->t.y;
    out->t[row] = (int64_t)fx_sat64((fx_mul_wide(along, scale) + (1 << 29)) >> 30) * (1 << 28) + (1 << 27);
}

PH_TIER(mesh) struct ph_clip_matrix ph_clip_matrix(const struct ph_lens *lens, const struct ph_xform *object_to_view)
{
    struct ph_clip_matrix m;
    fold_row(&m, 0, object_to_view, lens->focal_x);
    fold_row(&m, 1, object_to_view, -lens->focal_y);
    for (int j = 0; j < 3; j++) { /* the scale of row 2 is -1: Q2.30 becomes Q4.28, a tie rounded upwards */
        m.m[2][j] = -(int32_t)(((int64_t)object_to_view->r[2][j] + 1) >> 2);
    }
    m.t[2] = (int64_t)fx_sat64(-(int64_t)object_to_view->t.z) * (1 << 28) + (1 << 27);
    return m;
}

/* x / w in 2^-25, from the reciprocal of w (31 bits); |x| <= 8 w. */
static inline int32_t divide_q25(int32_t x, int32_t reciprocal, int shift)
{
    const int32_t aligned = shift >= 4 ? (int32_t)((uint32_t)x << (shift - 4)) : x >> (4 - shift);
    return (int32_t)(fx_mul_wide(aligned, reciprocal) >> 32);
}

/* Converts a place on the screen from 2^-25 to 1/256 px, rounded. */
PH_TIER(mesh) static inline int32_t screen_q8(const struct ph_lens *lens, int32_t q25)
{
    const int down = 17 - lens->focal_log2;
    return down > 0 ? (q25 + ((1 << down) >> 1)) >> down : q25 * (1 << -down);
}

PH_TIER(scenery)
void ph_project(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, int32_t z, struct ph_vertex *v)
{
    int32_t x_q25, y_q25;
    if (lens->kind == PH_PERSPECTIVE) {
        int shift;
        const uint32_t reciprocal = fx_rcp_far((uint32_t)w, &shift);
        x_q25 = divide_q25(x, (int32_t)(reciprocal >> 1), shift);
        y_q25 = divide_q25(y, (int32_t)(reciprocal >> 1), shift);
        ph_vertex_depth(v, ph_depth_quotient_of(lens, reciprocal, shift));
    } else { /* orthographic: w = 1, Q16.16 */
        x_q25 = x * 512;
        y_q25 = y * 512;
        ph_vertex_depth(v, ph_depth_quotient(lens, z));
    }
    v->x = lens->centre_x + screen_q8(lens, x_q25);
    v->y = lens->centre_y + screen_q8(lens, y_q25);
}

/* Clip codes left and right, or top and bottom, of a vertex that cannot be projected. Its place on the screen, 256 (x
 * 2^focal_log2 / w) + centre, is compared with 0 and with size; both sides are multiplied by w. */
PH_TIER(scenery)
static PH_NOINLINE uint8_t side_codes(int32_t x, int32_t w, const struct ph_lens *lens, int32_t centre, int32_t size,
                                      uint8_t below)
{
    const int64_t at = (int64_t)((uint64_t)(int64_t)x << (lens->focal_log2 + 8)) + fx_mul_wide(centre, w);
    return (uint8_t)(at < 0 ? below : at > fx_mul_wide(size * 256, w) ? below * 2 : 0);
}

/* Clip codes left, right, top and bottom of a vertex that is projected. */
PH_TIER(scenery) static uint8_t screen_codes(const struct ph_renderer *r, const struct ph_vertex *v)
{
    const int32_t right = r->config.width * 256, bottom = r->config.height * 256;
    const unsigned across = v->x < 0 ? PH_LEFT : v->x > right ? PH_RIGHT : 0;
    return (uint8_t)(across | (v->y < 0 ? PH_TOP : v->y > bottom ? PH_BOTTOM : 0u));
}

/* Projects a vertex, or only gives it clip codes: any lens, any place. */
PH_TIER(scenery)
static PH_NOINLINE void place_vertex(const struct ph_renderer *r, int32_t x, int32_t y, int32_t z, struct ph_vertex *v)
{
    const struct ph_lens *lens = &r->lens;
    if (lens->kind == PH_FISHEYE) {
        r->projection.curved->place_curved(lens, x, y, z, v);
        return;
    }
    const int32_t w = lens->kind == PH_PERSPECTIVE ? z : FX_ONE;
    const int32_t width = r->config.width, height = r->config.height;
    uint8_t code = z < lens->near_z ? PH_NEAR : z > lens->far_z ? PH_FAR : 0;
    if (w < 0 || code == PH_NEAR || ((fx_magnitude(x) | fx_magnitude(y)) >> 31) != 0 ||
        (fx_magnitude(x) + 7) >> 3 > (uint32_t)w >> lens->guard_up ||
        (fx_magnitude(y) + 7) >> 3 > (uint32_t)w >> lens->guard_up) {
        code |= side_codes(x, w, lens, lens->centre_x, width, PH_LEFT);
        code |= side_codes(y, w, lens, lens->centre_y, height, PH_TOP);
        v->code = code | PH_GUARD;
        return;
    }
    ph_project(lens, x, y, w, z, v);
    v->code = code | screen_codes(r, v);
}

PH_TIER(scenery)
void ph_transform(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *p,
                  struct ph_vertex *v)
{
    place_vertex(r, ph_matrix_row_mul(m, 0, p), ph_matrix_row_mul(m, 1, p), ph_matrix_row_mul(m, 2, p), v);
}

/* 4096.0: ph_vertices does not take vertices from this distance on. */
#define FAST_W ((uint32_t)1 << 28)

/* A centre with half a unit added, so that the shift down rounds: see struct ph_vertex_run. */
PH_TIER(mesh) static int64_t rounded_centre(int32_t centre, int down)
{
    return (int64_t)((uint64_t)((uint32_t)centre << down | (uint32_t)1 << (down - 1)) << 32);
}

/* Prepares ph_vertices. It takes vertices of a perspective with a near plane below 4096.0, and a focal length within
 * its range. In front of all others it stops, with their place: none has `w` = -2^31. */
PH_TIER(mesh)
static void start_run(struct ph_vertex_run *run, const struct ph_renderer *r, const struct ph_clip_matrix *m)
{
    const struct ph_lens *lens = &r->lens;
    const uint32_t near = (uint32_t)lens->near_z, far = (uint32_t)lens->far_z;
    const int down = 17 - lens->focal_log2;
    ph_matvec_prepare(&run->matvec, m);
    if (lens->kind != PH_PERSPECTIVE || near >= FAST_W || down < 1) {
        run->near = (uint32_t)1 << 31;
        run->range = 0;
        return;
    }
    run->near = near;
    run->range = (far < FAST_W ? far : FAST_W - 1) - near;
    run->round_x = rounded_centre(lens->centre_x, down);
    run->round_y = rounded_centre(lens->centre_y, down);
    run->depth_scale = lens->depth_scale;
    run->near_shift = lens->near_shift;
    run->right = (uint32_t)r->config.width * 256;
    run->bottom = (uint32_t)r->config.height * 256;
    run->guard_up = lens->guard_up;
    run->down = (uint32_t)down;
}

PH_TIER(mesh)
struct ph_clip_vertex ph_clip_place(const struct ph_lens *lens, const struct ph_clip_matrix *m, const struct fx_vec3 *p)
{
    const int32_t x = ph_matrix_row_mul(m, 0, p), y = ph_matrix_row_mul(m, 1, p), z = ph_matrix_row_mul(m, 2, p);
    const int32_t w = lens->kind == PH_ORTHOGRAPHIC ? FX_ONE : z;
    return (struct ph_clip_vertex){.x = x, .y = y, .w = w, .z = z};
}

PH_TIER(mesh)
uint32_t ph_transform_points(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct fx_vec3 *points,
                             uint32_t n, struct ph_vertex *vertices)
{
    struct ph_vertex_run run;
    run.from = points;
    run.end = points + n;
    run.to = vertices;
    run.codes = 0;
    start_run(&run, r, m);
    for (ph_vertices(&run); run.from < run.end; ph_vertices(&run)) {
        const struct fx_vec3 at = ph_matvec_in_range(&run.matvec, run.from) ? run.at : ph_matrix_mul(m, run.from);
        place_vertex(r, at.x, at.y, at.z, run.to);
        run.to->light = PH_LIGHT_ZERO + PH_LIGHT_SPAN; /* kept by meshes that are not lit */
        run.codes |= run.to->code;
        run.from++;
        run.to++;
    }
    return run.codes;
}
