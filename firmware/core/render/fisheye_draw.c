/*
 * Triangles and lines under a fisheye are divided until their edges are straight enough (fisheye_edges.c). The longest
 * edge is divided first: the triangle becomes two, and one of them waits on a stack.
 *
 * N/distance is interpolated linearly over a piece, as N/w is in a perspective; over 1/20 turn its error is below 1/80.
 */
/* Kits on armv6m: -O2. */
#include "fisheye.h"
#include "fisheye_ray.h"

#include "line.h"
#include "list.h"

#define DEPTH      20          /* pieces that wait on the stack */
#define POOL       (DEPTH + 3) /* vertices in use at a time */
#define SPLITS_MAX 4096        /* divisions of one triangle */
#define NOT_LISTED UINT16_MAX  /* a corner that has this number is listed again when it is used again */

/* ---- triangles -------------------------------------------------------------------------------------------------- */

/* A piece of a triangle that waits on the stack; aligned, so that it is copied as one word. */
struct piece {
    _Alignas(4) uint8_t corner[3]; /* indices into the pool */
    uint8_t straight;              /* as in ph_fisheye_edge_to_divide */
};

struct division {
    struct ph_renderer *r;
    const struct ph_material *material;
    uint32_t kind; /* enum ph_draw_kind */
    struct ph_ray pool[POOL];
    uint16_t number[POOL]; /* of the pool's vertices as corners on the list, or NOT_LISTED */
    uint32_t base;         /* from which they count */
    struct piece stack[DEPTH + 1];
    uint8_t used[DEPTH + 1];     /* each piece needs so many of the first vertices of the pool */
    uint32_t arcs[DEPTH + 1][3]; /* of each piece's edges, see ph_fisheye_arc */
    bool any, clipped;
};

/* Divides piece number `top` at the pool's next vertex: into pieces top and top + 1. Each keeps one edge, and the edge
 * between them is measured once. */
PH_TIER(few) static void divide_piece(struct division *d, int top, int edge)
{
    const int from = ph_next_corner[edge], to = ph_next_corner[edge + 1];
    const uint8_t middle = d->used[top];
    const struct ph_lens *const lens = &d->r->lens;
    const struct ph_ray *const pool = d->pool, *const m = &pool[middle];
    struct piece *const p = &d->stack[top];
    uint32_t(*const arcs)[3] = &d->arcs[top];
    d->number[middle] = NOT_LISTED;
    d->used[top] = d->used[top + 1] = (uint8_t)(middle + 1);
    p[1] = p[0];
    arcs[1][from] = arcs[0][from];
    arcs[0][edge] = ph_fisheye_arc(lens, &pool[p->corner[from]], m);
    arcs[1][edge] = ph_fisheye_arc(lens, m, &pool[p->corner[to]]);
    arcs[0][from] = arcs[1][to] = ph_fisheye_arc(lens, m, &pool[p->corner[edge]]);
    p[0].corner[to] = p[1].corner[from] = middle;
    p[0].straight &= (uint8_t)(1 << to);
    p[1].straight &= (uint8_t)(1 << from);
}

PH_TIER(few) static void clip_piece(struct division *d, const struct ph_ray *const v[3])
{
    struct ph_corner corners[PH_CLIP_MAX];
    bool beyond = false;
    const int n = ph_fisheye_clip(&d->r->lens, v, 3, corners, &beyond);
    d->clipped = true;
    if (n >= 3 && !beyond) {
        d->any |= ph_list_fan(d->r, d->material, d->kind, corners, (uint32_t)n);
    }
}

/* If corners count from elsewhere now, those on the list have lost their numbers. */
PH_TIER(few) static bool has_moved(struct division *d)
{
    if (ph_list_base(d->r) == d->base) {
        return false;
    }
    for (int i = 0; i < POOL; i++) {
        d->number[i] = NOT_LISTED;
    }
    d->base = ph_list_base(d->r);
    return true;
}

/* Puts the corners of a piece on the list, unless they are there. False: there is no room. */
PH_TIER(few) static bool list_corners(struct division *d, const uint8_t corner[3], uint16_t number[3])
{
    const uint32_t kind = d->kind | (ph_has_uvs(d->material) ? PH_DRAW_UVS : 0);
    has_moved(d);
    for (int i = 0; i < 3; i++) {
        uint16_t *const known = &d->number[corner[i]];
        if (*known == NOT_LISTED) {
            const struct ph_corner to = ph_ray_corner(&d->r->lens, &d->pool[corner[i]]);
            const int32_t first = ph_list_corners(d->r, d->material, kind, &to, 1);
            if (first < 0) {
                return false;
            }
            i = has_moved(d) ? -1 : i; /* then all three are listed again */
            *known = (uint16_t)first;
        }
        if (i >= 0) {
            number[i] = *known;
        }
    }
    return true;
}

/* Lists a piece if it can be seen. */
PH_TIER(few) static void list_piece(struct division *d, const struct ph_ray *const v[3], const uint8_t corner[3])
{
    struct ph_vertex at[3];
    for (int i = 0; i < 3; i++) {
        at[i].x = v[i]->at.x;
        at[i].y = v[i]->at.y;
    }
    const struct ph_vertex *const place[3] = {&at[0], &at[1], &at[2]};
    const int32_t area = ph_sides(&at[0], &at[1], &at[2]).area;
    const int32_t row = ph_first_row_of(d->r, place);
    uint16_t number[3];
    if (area == 0 || (area < 0 && d->material->two_sided == 0) || row < 0) {
        return;
    }
    d->any = true;
    if (!list_corners(d, corner, number)) {
        d->r->stats.triangles_dropped++;
        return;
    }
    struct ph_ref *const ref = ph_list_next(d->r);
    if (ref != NULL) {
        *ref = (struct ph_ref){{number[0], number[area > 0 ? 1 : 2], number[area > 0 ? 2 : 1]}, ph_band_of(d->r, row)};
    }
}

/* Draws piece number `top`, or divides it into pieces top and top + 1; then it returns true. */
PH_TIER(few) static bool take_piece(struct division *d, int top)
{
    struct piece *const p = &d->stack[top];
    const struct ph_ray *const v[3] = {&d->pool[p->corner[0]], &d->pool[p->corner[1]], &d->pool[p->corner[2]]};
    const unsigned all = v[0]->flags & v[1]->flags & v[2]->flags, any = v[0]->flags | v[1]->flags | v[2]->flags;
    if ((all & (PH_RAY_NEAR | PH_RAY_BLIND)) != 0) {
        return false;
    }
    const uint32_t used = d->used[top];
    const int edge = used < POOL ? ph_fisheye_edge_to_divide(d->r, v, d->arcs[top], &p->straight, &d->pool[used]) : -1;
    if (edge >= 0) {
        divide_piece(d, top, edge);
        return true;
    }
    if ((all & PH_RAY_FAR) == 0 && (any & PH_RAY_CUT) != 0) {
        clip_piece(d, v);
    } else if ((all & PH_RAY_FAR) == 0 && (any & PH_RAY_BEYOND) == 0) {
        list_piece(d, v, p->corner);
    }
    return false;
}

/*
 * Whether the triangle is a back face: the sign of the volume of its directions. It is decided for the whole triangle,
 * because rounding may turn pieces of one seen edge-on either way.
 */
PH_TIER(few) static bool faces_away(const struct ph_ray v[3])
{
    int32_t e[2][3];
    int64_t volume = 0;
    for (int i = 0; i < 3; i++) {
        e[0][i] = v[1].direction[i] - v[0].direction[i];
        e[1][i] = v[2].direction[i] - v[0].direction[i];
    }
    for (int i = 0; i < 3; i++) {
        const int k = ph_next_corner[i], l = ph_next_corner[i + 1];
        const int64_t cross = fx_mul_wide(e[0][k], e[1][l]) - fx_mul_wide(e[0][l], e[1][k]);
        volume += fx_mul_wide(v[0].direction[i], (int32_t)(cross >> 31));
    }
    return volume >= 0; /* y points down */
}

PH_TIER(few)
void ph_fisheye_triangle(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                         const struct ph_clip_vertex in[3])
{
    struct division d;
    d.r = r;
    d.material = material;
    d.kind = kind;
    d.base = ph_list_base(r);
    d.any = d.clipped = false;
    for (int i = 0; i < 3; i++) {
        ph_fisheye_ray(&r->lens, &in[i], &d.pool[i]);
        d.number[i] = NOT_LISTED;
    }
    if (material->two_sided == 0 && faces_away(d.pool)) {
        r->stats.triangles_culled++;
        return;
    }
    const struct ph_mark mark = ph_list_mark(r);
    d.stack[0] = (struct piece){{0, 1, 2}, 0};
    d.used[0] = 3;
    for (int k = 0; k < 3; k++) {
        d.arcs[0][k] = ph_fisheye_arc(&r->lens, &d.pool[ph_next_corner[k]], &d.pool[ph_next_corner[k + 1]]);
    }
    int waiting = 1, left = SPLITS_MAX;
    while (waiting > 0 && left > 0) {
        const bool divided = take_piece(&d, waiting - 1);
        left -= divided;
        waiting += divided ? 1 : -1;
    }
    ph_list_rewind(r, &mark);
    r->stats.triangles_dropped += waiting > 0;
    r->stats.triangles_clipped += d.clipped;
    r->stats.triangles_culled += !d.any;
}

/* ---- lines ---------------------------------------------------------------------------------------------------- */

PH_TIER(few)
static void draw_line_piece(struct ph_renderer *r, const struct ph_material *material, const struct ph_ray *a,
                            const struct ph_ray *b)
{
    const struct ph_ray *const ends[3] = {a, b, b};
    struct ph_corner corners[PH_CLIP_MAX];
    bool beyond = false;
    if (((a->flags | b->flags) & PH_RAY_CUT) == 0) {
        corners[0] = ph_ray_corner(&r->lens, a);
        corners[1] = ph_ray_corner(&r->lens, b);
        beyond = ((a->flags | b->flags) & PH_RAY_BEYOND) != 0;
    } else if (ph_fisheye_clip(&r->lens, ends, 2, corners, &beyond) != 2) {
        return;
    }
    if (!beyond) {
        ph_list_segment(r, material, corners);
    }
}

/* The ends still to be reached wait on a stack. A piece is drawn, or its dividing point is pushed onto the stack. */
PH_TIER(few)
void ph_fisheye_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex ends[2])
{
    const struct ph_lens *lens = &r->lens;
    struct ph_ray stack[DEPTH], from;
    ph_fisheye_ray(lens, &ends[0], &from);
    ph_fisheye_ray(lens, &ends[1], &stack[0]);
    for (int top = 0; top >= 0;) {
        const struct ph_ray *to = &stack[top], *const both[2] = {&from, to};
        struct ph_ray middle;
        bool misses;
        if (ph_fisheye_divides_line(r, both, &middle, &misses) && top + 1 < DEPTH) {
            stack[++top] = middle;
            continue;
        }
        if (!misses) {
            draw_line_piece(r, material, &from, to);
        }
        from = *to;
        top--;
    }
}
