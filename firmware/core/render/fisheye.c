/*
 * The fisheye is the equidistant projection: a point at the angle theta from the view direction lies r = f theta from
 * the centre of the picture. See fisheye.h.
 *
 * A straight edge becomes a curve. So triangles and lines are subdivided until their edges are straight enough, and the
 * pieces are drawn like all triangles. An edge is divided where the bisector of the angle between its ends meets it.
 * It is divided when its ends are more than 1/20 turn apart in the picture, or when the projected dividing point is
 * more than 1/2 px off the straight line. Edges below sqrt(f) pixels are at most 1/4 px off and are not tested; edges
 * below 2^-5 radian are never divided. All of this depends on the ends of the edge alone, so two triangles that share
 * an edge divide it alike and no crack opens. The widest edge is divided first: the triangle becomes two, and one of
 * them waits on a stack.
 *
 * Depth is the distance from the eye, so the near and the far plane are spheres. N/distance is interpolated linearly
 * over a piece, as N/w is in a perspective; over 1/20 turn its error is below 1/80. The point straight behind the eye
 * would become a circle in the picture: pieces are clipped 10 degrees before it.
 */
#include "fisheye.h"

#include "list.h"

#define LONG        20                     /* edges longer than this part of a turn are divided always */
#define SHORT       ((int64_t)1 << 48)     /* shorter edges, below 2^-5 radian, never are; squared Q29 */
#define DEPTH       20                     /* pieces that wait on the stack */
#define POOL        (DEPTH + 3)            /* vertices in use at a time */
#define SPLITS_MAX  4096                   /* divisions of one triangle */
#define REACH       (2048 * 256)           /* set-up takes coordinates up to here from the centre, 1/256 px */
#define BLIND       ((uint32_t)2028179001) /* 170 degrees in turn32 */
#define STEPS_ROOT  17                     /* CORDIC steps for a length alone */
#define STEPS_ANGLE 28                     /* for length and angle */

/* atan 2^-i in turn32. */
static const uint32_t arctangent[STEPS_ANGLE] = {
    536870912, 316933406, 167458907, 85004756, 42667331, 21354465, 10679838, 5340245, 2670163, 1335087,
    667544,    333772,    166886,    83443,    41722,    20861,    10430,    5215,    2608,    1304,
    652,       326,       163,       81,       41,       20,       10,       5,
};

/*
 * Turns the vector (along, across), both 0 .. 2^30 / sqrt 2, onto the x axis by CORDIC (J. Volder, 1959). Returns its
 * length; *angle is in turn32.
 */
static uint32_t cordic(uint32_t along, uint32_t across, int steps, uint32_t *angle)
{
    int32_t x = (int32_t)along, y = (int32_t)across;
    uint32_t sum = 0;
    for (int i = 0; i < steps; i++) {
        const int32_t dx = x >> i, dy = y >> i;
        const bool above = y > 0;
        x += above ? dy : -dy;
        y -= above ? dx : -dx;
        sum += above ? arctangent[i] : 0u - arctangent[i];
    }
    *angle = (int32_t)sum < 0 ? 0 : sum;
    return fx_mulhi_u32((uint32_t)x, 2608131496u); /* the steps make it 1.647 times as long */
}

/* A point in polar coordinates: theta (turn32) from the axis, in the direction (x, y) / rho around it. */
struct polar {
    int32_t x, y;
    uint32_t rho, theta;
    int32_t w;
    uint32_t length; /* of (x, y, w), which are scaled */
    fx_t distance;   /* the same in Q16.16 */
};

static struct polar polar_of(int32_t x, int32_t y, int32_t w)
{
    const int shift = fx_clz32(fx_magnitude(x) | fx_magnitude(y) | fx_magnitude(w)) - 3; /* largest to 29 bits */
    uint32_t angle;
    struct polar p = {0};
    if (shift >= 0) {
        const int up = shift < 29 ? shift : 0;
        p.x = (int32_t)((uint32_t)x << up);
        p.y = (int32_t)((uint32_t)y << up);
        p.w = (int32_t)((uint32_t)w << up);
    } else {
        p.x = x >> -shift;
        p.y = y >> -shift;
        p.w = w >> -shift;
    }
    p.rho = cordic(fx_magnitude(p.x), fx_magnitude(p.y), STEPS_ROOT, &angle);
    p.length = cordic(fx_magnitude(p.w), p.rho, STEPS_ANGLE, &angle);
    p.theta = w < 0 ? ((uint32_t)1 << 31) - angle : angle;
    const uint32_t half = shift > 0 ? (uint32_t)1 << (shift - 1) : 0;
    const uint64_t distance = shift >= 0 ? shift < 29 ? (p.length + half) >> shift : 0 : (uint64_t)p.length << -shift;
    p.distance = distance > FX_MAX ? FX_MAX : (fx_t)distance;
    return p;
}

/* x / length in Q2.29 from the reciprocal of length; |x| <= length < 2^30, or a few units more. */
static int32_t share(int32_t x, uint32_t reciprocal, int shift)
{
    return (int32_t)(fx_mul_wide((int32_t)((uint32_t)x << (shift - 2)), (int32_t)(reciprocal >> 1)) >> 30);
}

/* x / length times r, in 1/256 px; r is in 16.16 px. */
static int32_t offset(int32_t x, uint32_t reciprocal, int shift, uint32_t r)
{
    return (int32_t)((fx_mul_wide(share(x, reciprocal, shift), (int32_t)r) + ((int64_t)1 << 36)) >> 37);
}

struct screen {
    int32_t x, y; /* 1/256 px */
};

static struct screen place(const struct ph_lens *lens, const struct polar *p)
{
    int shift;
    const uint32_t reciprocal = fx_rcp_norm(p->rho, &shift); /* rho < 2^30 */
    const uint32_t r = fx_mulhi_u32(p->theta, lens->turn_px);
    return (struct screen){lens->centre_x + offset(p->x, reciprocal, shift, r),
                           lens->centre_y + offset(p->y, reciprocal, shift, r)};
}

/* Whether set-up cannot take the position. */
static bool is_beyond(const struct ph_lens *lens, const struct screen *s)
{
    return fx_magnitude(s->x - lens->centre_x) > REACH || fx_magnitude(s->y - lens->centre_y) > REACH;
}

void ph_fisheye_lens(struct ph_lens *lens, const struct ph_projection *p, int32_t height)
{
    lens->focal_x = lens->focal_y = FX_Q30_ONE; /* x and y of the clip matrix are lengths */
    lens->turn_px = (uint32_t)((fx_mul_wide(p->scale_y_q20, height) * 205887) >> 20); /* pi half heights */
    lens->chord_min2 = lens->turn_px / 19 * 3;                                        /* f square pixels: over 2 pi */
    const uint32_t quarter_radian = lens->turn_px / (LONG * 256);
    lens->chord_max = (int32_t)(quarter_radian < 65536 ? quarter_radian : 65536);
}

void ph_fisheye_vertex(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v)
{
    const struct polar p = polar_of(x, y, w);
    v->code = p.distance < lens->near_z ? PH_NEAR : p.distance > lens->far_z || p.theta > BLIND ? PH_GUARD : 0;
    if (v->code == 0) {
        const struct screen s = place(lens, &p);
        v->x = s.x;
        v->y = s.y;
        ph_vertex_depth(v, ph_depth_quotient(lens, p.distance));
        v->code = is_beyond(lens, &s) ? PH_GUARD : 0;
    }
}

static uint64_t square_of(int32_t ax, int32_t ay, int32_t bx, int32_t by)
{
    return (uint64_t)(fx_mul_wide(bx - ax, bx - ax) + fx_mul_wide(by - ay, by - ay));
}

bool ph_fisheye_is_small(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                         const struct ph_vertex *c)
{
    const uint64_t limit = lens->chord_min2;
    return square_of(a->x, a->y, b->x, b->y) <= limit && square_of(b->x, b->y, c->x, c->y) <= limit &&
           square_of(c->x, c->y, a->x, a->y) <= limit;
}

/* A vertex of the subdivision. clip.w is the distance along the view, clip.z the distance from the eye. */
struct vertex {
    struct ph_clip_vertex clip;
    struct screen at;
    int32_t direction[3]; /* unit vector, Q2.29 */
    bool blind;
};

static struct vertex vertex_of(const struct ph_lens *lens, const struct ph_clip_vertex *clip)
{
    const struct polar p = polar_of(clip->x, clip->y, clip->w);
    int shift;
    const uint32_t reciprocal = fx_rcp_norm(p.length, &shift);
    struct vertex v = {.clip = *clip, .at = place(lens, &p), .blind = p.theta > BLIND};
    v.clip.z = p.distance;
    v.direction[0] = share(p.x, reciprocal, shift);
    v.direction[1] = share(p.y, reciprocal, shift);
    v.direction[2] = share(p.w, reciprocal, shift);
    return v;
}

/* The square of the distance between two unit vectors, Q58. For a small angle it is the square of the angle. */
static int64_t apart2(const struct vertex *a, const struct vertex *b)
{
    int64_t sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += fx_mul_wide(a->direction[i] - b->direction[i], a->direction[i] - b->direction[i]);
    }
    return sum;
}

static bool is_before(const struct ph_clip_vertex *a, const struct ph_clip_vertex *b)
{
    return a->x != b->x ? a->x < b->x : a->y != b->y ? a->y < b->y : a->w < b->w;
}

/* Divides an edge at t = |a| / (|a| + |b|). The order of the two ends does not change the point. */
static struct vertex divide(const struct ph_lens *lens, const struct vertex *v, const struct vertex *w)
{
    const bool swap = is_before(&w->clip, &v->clip);
    const struct ph_clip_vertex *a = swap ? &w->clip : &v->clip, *b = swap ? &v->clip : &w->clip;
    int shift;
    const uint32_t reciprocal = fx_rcp_norm((uint32_t)a->z + (uint32_t)b->z, &shift);
    const int32_t t = (int32_t)fx_mulhi_u32((uint32_t)a->z << shift, reciprocal);
    const struct ph_clip_vertex middle = ph_clip_between(a, b, t); /* vertex_of sets its distance */
    return vertex_of(lens, &middle);
}

static uint64_t chord2(const struct vertex *a, const struct vertex *b)
{
    return square_of(a->at.x, a->at.y, b->at.x, b->at.y);
}

static uint64_t longest2(const struct ph_lens *lens)
{
    return (uint64_t)fx_mul_wide(lens->chord_max, lens->chord_max);
}

/* Whether an edge that is not too long bends: its dividing point is more than 1/2 px off the chord. */
static bool bends(const struct ph_lens *lens, const struct vertex *a, const struct vertex *b)
{
    if (chord2(a, b) <= lens->chord_min2 || apart2(a, b) < SHORT) {
        return false;
    }
    const struct vertex m = divide(lens, a, b);
    const int32_t dx = b->at.x - a->at.x, dy = b->at.y - a->at.y;
    const int64_t area =
        fx_mul_wide(m.at.x - a->at.x, b->at.y - a->at.y) - fx_mul_wide(b->at.x - a->at.x, m.at.y - a->at.y);
    const uint32_t size = fx_magnitude(dx) > fx_magnitude(dy) ? fx_magnitude(dx) : fx_magnitude(dy);
    return area > 128 * (int64_t)size || area < -128 * (int64_t)size;
}

static bool is_long(const struct ph_lens *lens, const struct vertex *a, const struct vertex *b)
{
    return chord2(a, b) > longest2(lens) && apart2(a, b) >= SHORT;
}

/*
 * Whether all vertices are beyond one side of the picture by half of the longest chord or more. Then no edge reaches
 * the picture, however it bends.
 */
static bool misses_picture(const struct ph_renderer *r, const struct vertex *const v[], int n)
{
    uint64_t longest = 0;
    int64_t margin = 256;
    for (int i = 1; i < n; i++) { /* the third edge is at most the sum of these two */
        const uint64_t chord = chord2(v[0], v[i]);
        longest = chord > longest ? chord : longest;
    }
    while ((uint64_t)(margin * margin) < longest && margin < 2 * REACH) { /* at most 12 times */
        margin *= 2;
    }
    const int32_t right = r->config.width * 256, bottom = r->config.height * 256;
    uint32_t outside = PH_LEFT | PH_RIGHT | PH_TOP | PH_BOTTOM;
    for (int i = 0; i < n; i++) {
        const struct screen *s = &v[i]->at;
        outside &= (uint32_t)((s->x < -margin ? PH_LEFT : 0) | (s->x > right + margin ? PH_RIGHT : 0) |
                              (s->y < -margin ? PH_TOP : 0) | (s->y > bottom + margin ? PH_BOTTOM : 0));
    }
    return outside != 0;
}

static struct ph_corner corner_of(const struct ph_lens *lens, const struct ph_clip_vertex *v, const struct screen *s)
{
    const struct ph_quotient depth = ph_depth_quotient(lens, v->z);
    return (struct ph_corner){{s->x, s->y, depth.q, depth.s, 0, (uint16_t)v->light}, {v->uv[0], v->uv[1]}};
}

/* ---- triangles ------------------------------------------------------------------------------------------------ */

/* A piece of a triangle that waits on the stack. */
struct piece {
    uint8_t corner[3]; /* indices into the pool */
    uint8_t straight;  /* bit k: the edge opposite corner k need not be divided */
    uint8_t used;      /* the piece needs the first `used` vertices of the pool */
};

struct division {
    struct ph_renderer *r;
    const struct ph_material *material;
    uint32_t kind; /* enum ph_draw_kind */
    struct vertex pool[POOL];
    int32_t number[POOL]; /* of the pool's vertices as corners on the list, -1: not there yet */
    uint32_t base;        /* from which they count */
    struct piece stack[DEPTH + 1];
    bool any, clipped;
};

static const uint8_t next_corner[4] = {1, 2, 0, 1};

static const struct vertex *from_of(const struct vertex *const v[3], int edge)
{
    return v[next_corner[edge]];
}

static const struct vertex *to_of(const struct vertex *const v[3], int edge)
{
    return v[next_corner[edge + 1]];
}

/* The widest edge of those in the mask `edges`, or -1. */
static int widest(const struct vertex *const v[3], unsigned edges)
{
    int64_t most = 0;
    int edge = -1;
    for (int k = 0; k < 3; k++) {
        const int64_t apart = (edges >> k & 1) != 0 ? apart2(from_of(v, k), to_of(v, k)) : 0;
        edge = apart > most ? k : edge;
        most = apart > most ? apart : most;
    }
    return edge;
}

/* The edge to divide, or -1. */
static int edge_to_divide(const struct ph_lens *lens, struct piece *p, const struct vertex *const v[3])
{
    unsigned edges = 0;
    for (int k = 0; k < 3; k++) {
        edges |= (unsigned)((p->straight >> k & 1) == 0 && bends(lens, from_of(v, k), to_of(v, k))) << k;
    }
    p->straight = (uint8_t)(~edges & 7);
    return widest(v, edges);
}

/* Divides a piece. *p becomes one half; the other half is returned. */
static struct piece divide_piece(struct division *d, struct piece *p, int edge)
{
    const int from = next_corner[edge], to = next_corner[edge + 1];
    const uint8_t middle = p->used++;
    d->number[middle] = -1;
    d->pool[middle] = divide(&d->r->lens, &d->pool[p->corner[from]], &d->pool[p->corner[to]]);
    struct piece other = *p;
    p->corner[to] = middle;
    p->straight &= (uint8_t)(1 << to);
    other.corner[from] = middle;
    other.straight &= (uint8_t)(1 << from);
    return other;
}

/* Clips n = 2 or more corners to near and far sphere and to the cone that is visible. Returns the corners left. */
static int clip_polygon(const struct ph_lens *lens, struct ph_clip_vertex *polygon, int n)
{
    struct ph_clip_vertex cut[PH_CLIP_MAX];
    n = ph_clip(lens, polygon, n, cut);
    for (int i = 0; i < n; i++) { /* the cone is clipped as a far plane: half the angle is z */
        cut[i].z = (int32_t)(polar_of(cut[i].x, cut[i].y, cut[i].w).theta / 2);
    }
    const struct ph_lens cone = {.kind = PH_FISHEYE, .near_z = -1, .far_z = (int32_t)(BLIND / 2)};
    return ph_clip(&cone, cut, n, polygon);
}

static struct ph_corner clipped_corner(const struct ph_lens *lens, const struct ph_clip_vertex *v, bool *beyond)
{
    struct vertex at = vertex_of(lens, v);
    /* the distance is not linear along an edge: a clipped point may be 1/80 off its sphere */
    at.clip.z = at.clip.z < lens->near_z ? lens->near_z : at.clip.z > lens->far_z ? lens->far_z : at.clip.z;
    *beyond |= is_beyond(lens, &at.at);
    return corner_of(lens, &at.clip, &at.at);
}

static void clip_piece(struct division *d, const struct vertex *const v[3])
{
    struct ph_clip_vertex polygon[PH_CLIP_MAX] = {v[0]->clip, v[1]->clip, v[2]->clip};
    const int n = clip_polygon(&d->r->lens, polygon, 3);
    struct ph_corner corners[PH_CLIP_MAX];
    bool beyond = false;
    d->clipped = true;
    for (int i = 0; i < n; i++) {
        corners[i] = clipped_corner(&d->r->lens, &polygon[i], &beyond);
    }
    if (n >= 3 && !beyond) {
        d->any |= ph_list_fan(d->r, d->material, d->kind, corners, (uint32_t)n);
    }
}

/* If corners count from elsewhere now, those on the list have lost their numbers. */
static bool has_moved(struct division *d)
{
    if (ph_list_base(d->r) == d->base) {
        return false;
    }
    for (int i = 0; i < POOL; i++) {
        d->number[i] = -1;
    }
    d->base = ph_list_base(d->r);
    return true;
}

/* Puts the corners of a piece on the list, unless they are there. False: there is no room. */
static bool list_corners(struct division *d, const uint8_t corner[3], const struct ph_corner corners[3],
                         uint16_t number[3])
{
    const uint32_t kind = d->kind | (ph_has_uvs(d->material) ? PH_DRAW_UVS : 0);
    has_moved(d);
    for (int i = 0; i < 3; i++) {
        int32_t *const known = &d->number[corner[i]];
        if (*known < 0) {
            const int32_t first = ph_list_corners(d->r, d->material, kind, &corners[i], 1);
            if (first < 0) {
                return false;
            }
            i = has_moved(d) ? -1 : i; /* then all three are listed again */
            *known = first;
        }
        if (i >= 0) {
            number[i] = (uint16_t)*known;
        }
    }
    return true;
}

/* Lists a piece. False if it cannot be seen. */
static bool list_piece(struct division *d, const uint8_t corner[3], const struct ph_corner corners[3])
{
    const struct ph_mark mark = ph_list_mark(d->r);
    const struct ph_vertex *const v[3] = {&corners[0].at, &corners[1].at, &corners[2].at};
    const int32_t before[3] = {d->number[corner[0]], d->number[corner[1]], d->number[corner[2]]};
    uint16_t number[3];
    bool seen = true;
    if (list_corners(d, corner, corners, number)) {
        seen = ph_list_triangle(d->r, number, v, d->material->two_sided != 0);
    } else {
        d->r->stats.triangles_dropped++;
    }
    if (ph_list_rewind(d->r, &mark) && !has_moved(d)) {
        for (int i = 0; i < 3; i++) {
            d->number[corner[i]] = before[i];
        }
    }
    return seen;
}

static void draw_piece(struct division *d, const struct vertex *const v[3], const uint8_t corner[3])
{
    const struct ph_lens *lens = &d->r->lens;
    struct ph_corner corners[3];
    int far = 0, cut = 0;
    bool beyond = false;
    for (int i = 0; i < 3; i++) {
        far += v[i]->clip.z > lens->far_z;
        cut += v[i]->clip.z > lens->far_z || v[i]->clip.z < lens->near_z || v[i]->blind;
        beyond |= is_beyond(lens, &v[i]->at);
    }
    if (far == 3) {
        return;
    }
    if (cut > 0) {
        clip_piece(d, v);
        return;
    }
    for (int i = 0; i < 3 && !beyond; i++) {
        corners[i] = corner_of(lens, &v[i]->clip, &v[i]->at);
    }
    d->any |= !beyond && list_piece(d, corner, corners);
}

/* Draws the piece on top of the stack, or divides it into top[0] and top[1]; then it returns true. */
static bool take_piece(struct division *d, struct piece *top)
{
    const struct vertex *const v[3] = {&d->pool[top->corner[0]], &d->pool[top->corner[1]], &d->pool[top->corner[2]]};
    const struct ph_lens *lens = &d->r->lens;
    if ((v[0]->clip.z < lens->near_z && v[1]->clip.z < lens->near_z && v[2]->clip.z < lens->near_z) ||
        (v[0]->blind && v[1]->blind && v[2]->blind)) {
        return false;
    }
    unsigned edges = 0;
    for (int k = 0; k < 3; k++) {
        edges |= (unsigned)((top->straight >> k & 1) == 0 && is_long(lens, from_of(v, k), to_of(v, k))) << k;
    }
    int edge = widest(v, edges);
    if (edge < 0) {
        if (misses_picture(d->r, v, 3)) {
            return false;
        }
        edge = edge_to_divide(lens, top, v);
    }
    if (edge < 0 || top->used == POOL) {
        draw_piece(d, v, top->corner);
        return false;
    }
    top[1] = divide_piece(d, top, edge);
    return true;
}

/* Scales a vector down until its components have at most 30 bits. */
static void fit(const int64_t in[3], int32_t out[3])
{
    const int64_t all = (in[0] < 0 ? ~in[0] : in[0]) | (in[1] < 0 ? ~in[1] : in[1]) | (in[2] < 0 ? ~in[2] : in[2]);
    const uint32_t high = (uint32_t)(all >> 29);
    const int down = 32 - fx_clz32(high);
    for (int i = 0; i < 3; i++) {
        out[i] = (int32_t)(in[i] >> down);
    }
}

/*
 * Whether the triangle is a back face: the sign of a . ((b - a) x (c - a)), exact to 2^-27 radian. It is decided for
 * the whole triangle, because rounding may turn pieces of one seen edge-on either way.
 */
static bool faces_away(const struct ph_clip_vertex in[3])
{
    int32_t a[3], e[2][3], n[3];
    int64_t cross[3];
    fit((const int64_t[3]){in[0].x, in[0].y, in[0].w}, a);
    for (int i = 0; i < 2; i++) {
        const struct ph_clip_vertex *p = &in[i + 1];
        fit((const int64_t[3]){(int64_t)p->x - in[0].x, (int64_t)p->y - in[0].y, (int64_t)p->w - in[0].w}, e[i]);
    }
    for (int i = 0; i < 3; i++) {
        const int k = next_corner[i], l = next_corner[i + 1];
        cross[i] = fx_mul_wide(e[0][k], e[1][l]) - fx_mul_wide(e[0][l], e[1][k]);
    }
    fit(cross, n);
    return fx_mul_wide(a[0], n[0]) + fx_mul_wide(a[1], n[1]) + fx_mul_wide(a[2], n[2]) >= 0; /* y points down */
}

void ph_fisheye_triangle(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                         const struct ph_clip_vertex in[3])
{
    if (material->two_sided == 0 && faces_away(in)) {
        r->stats.triangles_culled++;
        return;
    }
    struct division d;
    d.r = r;
    d.material = material;
    d.kind = kind;
    d.base = ph_list_base(r);
    d.any = d.clipped = false;
    for (int i = 0; i < 3; i++) {
        d.pool[i] = vertex_of(&r->lens, &in[i]);
        d.number[i] = -1;
    }
    d.stack[0] = (struct piece){{0, 1, 2}, 0, 3};
    int waiting = 1, left = SPLITS_MAX;
    while (waiting > 0 && left > 0) {
        const bool divided = take_piece(&d, &d.stack[waiting - 1]);
        left -= divided;
        waiting += divided ? 1 : -1;
    }
    r->stats.triangles_dropped += waiting > 0;
    r->stats.triangles_clipped += d.clipped;
    r->stats.triangles_culled += !d.any;
}

/* ---- lines ---------------------------------------------------------------------------------------------------- */

static void draw_line_piece(struct ph_renderer *r, const struct ph_material *material, const struct vertex *a,
                            const struct vertex *b)
{
    struct ph_clip_vertex ends[PH_CLIP_MAX] = {a->clip, b->clip};
    if (clip_polygon(&r->lens, ends, 2) != 2) {
        return;
    }
    bool beyond = false;
    const struct ph_corner corners[2] = {clipped_corner(&r->lens, &ends[0], &beyond),
                                         clipped_corner(&r->lens, &ends[1], &beyond)};
    if (!beyond) {
        ph_list_segment(r, material, corners);
    }
}

/* The ends still to be reached wait on a stack. A piece is drawn, or its dividing point is pushed onto the stack. */
void ph_fisheye_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex ends[2])
{
    const struct ph_lens *lens = &r->lens;
    struct vertex stack[DEPTH], from = vertex_of(lens, &ends[0]);
    stack[0] = vertex_of(lens, &ends[1]);
    for (int top = 0; top >= 0;) {
        const struct vertex *to = &stack[top], *const both[2] = {&from, to};
        bool divides = is_long(lens, &from, to);
        const bool misses = !divides && misses_picture(r, both, 2);
        divides = divides || (!misses && bends(lens, &from, to));
        if (divides && top + 1 < DEPTH) {
            stack[top + 1] = divide(lens, &from, to);
            top++;
            continue;
        }
        if (!misses) {
            draw_line_piece(r, material, &from, to);
        }
        from = *to;
        top--;
    }
}
