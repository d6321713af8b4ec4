/*
 * See asset_mesh.h. Collapses edges of the model's net (asset_net.h), always the one that changes the picture least: a
 * point moves onto a neighbour, and the triangles between the two are gone. What an edge costs its quadrics tell
 * (asset_quadric.h). Small pieces that touch nothing else go whole, as soon as edges cost more.
 */
#include "asset_mesh.h"
#include "asset_net.h"
#include "asset_quadric.h"
#include "complain.h"

#include <math.h>
#include <stdlib.h>

#define HELD_MOST    32  /* points, */
#define HELD_SHARE   32  /* or one of so many triangles */
#define WEDGES_MOST  64  /* at a point that moves */
#define LEAST_TURN   .5  /* cosine of the angle by which a triangle may turn */
#define PIECE_WEIGHT 2.0 /* of the error that leaving out a piece is */

/* An edge that may be collapsed: `from` moves onto `to`. It is out of date when one of them has another version. */
struct step {
    double cost;
    uint32_t from, to, versions[2];
    bool is_second; /* the other direction has been tried */
};

/* A piece of the net, and what it costs to leave it out. */
struct piece {
    double cost, size;   /* size: the diagonal of its box, in sizes of the model */
    uint32_t first, end; /* in by_piece */
};

/* Where the wedges of a point go. */
struct moves {
    uint32_t from[WEDGES_MOST], to[WEDGES_MOST], count;
};

struct work {
    struct asset_net net;
    uint32_t live, *versions; /* triangles; of each point */
    uint32_t *marks, mark;    /* of each point, for sets of points */
    bool *is_held;            /* of each point: it stays where it is */
    double *moved, error;     /* how far from the model each point has come, in sizes of the model */
    struct step *heap;        /* the cheapest first */
    size_t heap_count, heap_room;
    struct piece *pieces;                        /* the cheapest first */
    uint32_t piece_count, next_piece, *by_piece; /* triangles, piece by piece */
    bool may_turn; /* nothing is left to do unless triangles turn over, or held points move */
    bool is_out;   /* of memory */
};

/* ---- the heap --------------------------------------------------------------------------------------------------- */

static bool is_before(const struct step *a, const struct step *b)
{
    return a->cost != b->cost ? a->cost < b->cost : a->from != b->from ? a->from < b->from : a->to < b->to;
}

static void push(struct work *w, const struct step *step)
{
    if (w->heap_count == w->heap_room) {
        const size_t room = w->heap_room * 2 + 1024;
        struct step *const heap = realloc(w->heap, sizeof *heap * room);
        w->is_out = w->is_out || heap == NULL;
        if (heap == NULL) {
            return;
        }
        w->heap = heap;
        w->heap_room = room;
    }
    size_t i = w->heap_count++;
    for (; i > 0 && is_before(step, &w->heap[(i - 1) / 2]); i = (i - 1) / 2) {
        w->heap[i] = w->heap[(i - 1) / 2];
    }
    w->heap[i] = *step;
}

static struct step pop(struct work *w)
{
    const struct step first = w->heap[0], last = w->heap[--w->heap_count];
    size_t i = 0;
    for (size_t child = 1; child < w->heap_count; child = 2 * i + 1) {
        child += child + 1 < w->heap_count && is_before(&w->heap[child + 1], &w->heap[child]);
        if (!is_before(&w->heap[child], &last)) {
            break;
        }
        w->heap[i] = w->heap[child];
        i = child;
    }
    w->heap[i] = last;
    return first;
}

/* ---- what an edge costs ----------------------------------------------------------------------------------------- */

/* The first live corner at a point from this one on; NONE: there is no more. */
static uint32_t live_corner(const struct asset_net *net, uint32_t corner)
{
    while (corner != ASSET_NET_NONE && !net->is_live[corner / 3]) {
        corner = net->next[corner];
    }
    return corner;
}

/* Walks over the live corners at a point. */
/* NOLINTBEGIN(bugprone-macro-parentheses): a name, which stands in none */
#define EACH_CORNER(net, corner, point)                                                                                \
    for (uint32_t corner = live_corner(net, (net)->heads[point]); corner != ASSET_NET_NONE;                            \
         corner = live_corner(net, (net)->next[corner]))
/* NOLINTEND(bugprone-macro-parentheses) */

/* The corner at a point of the triangle of another corner; NONE: it has none there. */
static uint32_t corner_at(const struct asset_net *net, uint32_t corner, uint32_t point)
{
    const uint32_t first = corner / 3 * 3;
    for (uint32_t i = 0; i < 3; i++) {
        if (asset_net_point(net, first + i) == point) {
            return first + i;
        }
    }
    return ASSET_NET_NONE;
}

static uint32_t *move_of(struct moves *moves, uint32_t wedge)
{
    uint32_t i = 0;
    while (i < moves->count && moves->from[i] != wedge) {
        i++;
    }
    if (i == WEDGES_MOST) {
        return NULL;
    }
    if (i == moves->count) {
        moves->from[moves->count++] = wedge;
        moves->to[i] = ASSET_NET_NONE;
    }
    return &moves->to[i];
}

static double distance_2(const struct asset_net *net, uint32_t a, uint32_t b)
{
    const double *const p = asset_net_x(net, a), *const q = asset_net_x(net, b);
    double sum = 0;
    for (int i = 0; i < net->dimensions; i++) {
        sum += (p[i] - q[i]) * (p[i] - q[i]);
    }
    return sum;
}

/* The wedge of the same mesh at a point that differs least; NONE: that mesh has none there. */
static uint32_t nearest_wedge(const struct asset_net *net, uint32_t wedge, uint32_t point)
{
    uint32_t nearest = ASSET_NET_NONE;
    double least = HUGE_VAL;
    EACH_CORNER(net, corner, point)
    {
        const uint32_t at = asset_net_wedge(net, corner);
        const double distance = distance_2(net, wedge, at);
        if (net->wedges[at].mesh == net->wedges[wedge].mesh && distance < least) {
            least = distance;
            nearest = at;
        }
    }
    return nearest;
}

/* Finds where the wedges of a point go when it moves: along the edge where a triangle has it, else to what is most
 * alike there. False: one cannot go. */
static bool find_moves(const struct asset_net *net, uint32_t from, uint32_t to, struct moves *moves)
{
    moves->count = 0;
    EACH_CORNER(net, corner, from)
    {
        const uint32_t other = corner_at(net, corner, to);
        uint32_t *const move = move_of(moves, asset_net_wedge(net, corner));
        if (move == NULL) {
            return false;
        }
        *move = other != ASSET_NET_NONE ? asset_net_wedge(net, other) : *move;
    }
    for (uint32_t i = 0; i < moves->count; i++) {
        moves->to[i] = moves->to[i] != ASSET_NET_NONE ? moves->to[i] : nearest_wedge(net, moves->from[i], to);
        if (moves->to[i] == ASSET_NET_NONE) {
            return false;
        }
    }
    return moves->count > 0;
}

/* Error times area would give up what is small, such as the eyes of a face, and error alone what is large. */
static double cost_of(const struct asset_net *net, const struct moves *moves)
{
    double cost = 0, area = 0;
    for (uint32_t i = 0; i < moves->count; i++) {
        area += net->areas[moves->from[i]];
        cost +=
            asset_quadric_at(asset_net_quadric(net, moves->from[i]), net->dimensions, asset_net_x(net, moves->to[i]));
    }
    return area > 0 ? cost / sqrt(area) : 0;
}

/* Adds the better direction of an edge, or the second one. */
static void push_edge(struct work *w, uint32_t a, uint32_t b)
{
    struct moves moves;
    const double there = find_moves(&w->net, a, b, &moves) ? cost_of(&w->net, &moves) : HUGE_VAL;
    const double back = find_moves(&w->net, b, a, &moves) ? cost_of(&w->net, &moves) : HUGE_VAL;
    const bool is_there = there < back || (there == back && a < b);
    const struct step step = {is_there ? there : back,
                              is_there ? a : b,
                              is_there ? b : a,
                              {w->versions[is_there ? a : b], w->versions[is_there ? b : a]},
                              false};
    if (step.cost < HUGE_VAL) {
        push(w, &step);
    }
}

/* ---- which edges may be collapsed -------------------------------------------------------------------------------- */

/* Whether the triangle of a corner would turn over, if that corner were at the place of x. */
static bool turns_over(const struct asset_net *net, uint32_t corner, const double *x)
{
    const uint32_t first = corner / 3 * 3;
    const double *before[3], *after[3];
    double old[3], new[3];
    for (uint32_t i = 0; i < 3; i++) {
        before[i] = asset_net_x(net, asset_net_wedge(net, first + i));
        after[i] = first + i == corner ? x : before[i];
    }
    asset_net_normal(before, old);
    asset_net_normal(after, new);
    const double both = old[0] * new[0] + old[1] * new[1] + old[2] * new[2];
    const double lengths =
        (old[0] * old[0] + old[1] * old[1] + old[2] * old[2]) * (new[0] * new[0] + new[1] * new[1] + new[2] * new[2]);
    return both < LEAST_TURN * sqrt(lengths) || lengths == 0;
}

static bool may_collapse(const struct work *w, uint32_t from, uint32_t to)
{
    const struct asset_net *const net = &w->net;
    const double *const x = asset_net_x(net, asset_net_wedge(net, live_corner(net, net->heads[to])));
    uint32_t between = 0;
    bool is_bad = w->is_held[from];
    EACH_CORNER(net, corner, from)
    {
        const bool is_between = corner_at(net, corner, to) != ASSET_NET_NONE;
        between += is_between;
        is_bad = is_bad || (!is_between && turns_over(net, corner, x));
    }
    return between > 0 && (w->may_turn || !is_bad);
}

/* ---- collapsing -------------------------------------------------------------------------------------------------- */

static double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The square of the distance of p from a triangle (C. Ericson, Real-Time Collision Detection, 5.1.5). */
static double distance_2_to(const double *p, const double *const t[3])
{
    double best = HUGE_VAL, n[3];
    asset_net_normal(t, n);
    bool is_inside = dot3(n, n) > 0;
    const double above[3] = {p[0] - t[0][0], p[1] - t[0][1], p[2] - t[0][2]};
    for (int i = 0; i < 3; i++) {
        const double *const a = t[i], *const b = t[(i + 1) % 3];
        const double e[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, d[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
        const double length_2 = dot3(e, e), share = length_2 > 0 ? fmin(fmax(dot3(d, e) / length_2, 0), 1) : 0;
        const double off[3] = {d[0] - share * e[0], d[1] - share * e[1], d[2] - share * e[2]};
        best = fmin(best, dot3(off, off));
        const double side[3] = {n[1] * e[2] - n[2] * e[1], n[2] * e[0] - n[0] * e[2], n[0] * e[1] - n[1] * e[0]};
        is_inside = is_inside && dot3(side, d) >= 0;
    }
    return is_inside ? dot3(above, n) * dot3(above, n) / dot3(n, n) : best;
}

/* Keeps how far the surface is from the place that a point left. */
static void measure(struct work *w, const double *place, uint32_t from, uint32_t to)
{
    const struct asset_net *const net = &w->net;
    double least = HUGE_VAL;
    EACH_CORNER(net, corner, to)
    {
        const uint32_t *const t = net->triangles[corner / 3];
        const double *const places[3] = {asset_net_x(net, t[0]), asset_net_x(net, t[1]), asset_net_x(net, t[2])};
        least = fmin(least, distance_2_to(place, places));
    }
    const double moved = w->moved[from] + (least < HUGE_VAL ? sqrt(least) : 0);
    w->moved[to] = fmax(w->moved[to], moved);
    w->error = fmax(w->error, moved);
}

/* Adds all edges of a point, once each. */
static void push_edges_of(struct work *w, uint32_t point)
{
    const uint32_t mark = ++w->mark;
    w->marks[point] = mark;
    EACH_CORNER(&w->net, corner, point)
    {
        for (uint32_t i = corner / 3 * 3; i < corner / 3 * 3 + 3; i++) {
            const uint32_t other = asset_net_point(&w->net, i);
            if (w->marks[other] != mark) {
                w->marks[other] = mark;
                push_edge(w, point, other);
            }
        }
    }
}

static void collapse(struct work *w, uint32_t from, uint32_t to, const struct moves *moves)
{
    struct asset_net *const net = &w->net;
    const double *const place = asset_net_x(net, moves->from[0]);
    for (uint32_t corner = net->heads[from], next; corner != ASSET_NET_NONE; corner = next) {
        next = net->next[corner];
        if (net->is_live[corner / 3] && corner_at(net, corner, to) != ASSET_NET_NONE) {
            net->is_live[corner / 3] = false;
            w->live--;
        } else if (net->is_live[corner / 3]) {
            uint32_t i = 0;
            while (i + 1 < moves->count && moves->from[i] != asset_net_wedge(net, corner)) {
                i++;
            }
            net->triangles[corner / 3][corner % 3] = moves->to[i];
            net->next[corner] = net->heads[to];
            net->heads[to] = corner;
        }
    }
    net->heads[from] = ASSET_NET_NONE;
    for (uint32_t i = 0; i < moves->count; i++) {
        double *const q = asset_net_quadric(net, moves->to[i]);
        const double *const more = asset_net_quadric(net, moves->from[i]);
        for (int k = 0; k < net->numbers; k++) {
            q[k] += more[k];
        }
        net->areas[moves->to[i]] += net->areas[moves->from[i]];
    }
    w->versions[from]++;
    w->versions[to]++;
    measure(w, place, from, to);
    push_edges_of(w, to);
}

/* Takes the next edge of the heap. */
static void step(struct work *w)
{
    struct step s = pop(w);
    struct moves moves;
    if (w->versions[s.from] != s.versions[0] || w->versions[s.to] != s.versions[1]) {
        return;
    }
    const bool has_moves = find_moves(&w->net, s.from, s.to, &moves);
    if (has_moves && may_collapse(w, s.from, s.to)) {
        collapse(w, s.from, s.to, &moves);
    } else if (!s.is_second && find_moves(&w->net, s.to, s.from, &moves)) {
        const struct step other = {cost_of(&w->net, &moves), s.to, s.from, {s.versions[1], s.versions[0]}, true};
        push(w, &other);
    }
}

/* ---- pieces ------------------------------------------------------------------------------------------------------ */

static uint32_t root_of(uint32_t *parents, uint32_t i)
{
    while (parents[i] != i) {
        parents[i] = parents[parents[i]];
        i = parents[i];
    }
    return i;
}

static int by_cost(const void *p, const void *q)
{
    const struct piece *a = p, *b = q;
    return a->cost != b->cost ? (a->cost < b->cost ? -1 : 1) : (a->first > b->first) - (a->first < b->first);
}

/* What it costs to leave out a piece: all of its area is wrong, at worst by its size. */
static void measure_piece(const struct asset_net *net, const uint32_t *triangles, struct piece *piece)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, area = 0, size_2 = 0;
    for (uint32_t i = piece->first; i < piece->end; i++) {
        const double *corners[3];
        double normal[3];
        for (int k = 0; k < 3; k++) {
            corners[k] = asset_net_x(net, net->triangles[triangles[i]][k]);
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = fmin(low[axis], corners[k][axis]);
                high[axis] = fmax(high[axis], corners[k][axis]);
            }
        }
        asset_net_normal(corners, normal);
        area += sqrt(dot3(normal, normal)) / 2;
    }
    for (int axis = 0; axis < 3; axis++) {
        size_2 += (high[axis] - low[axis]) * (high[axis] - low[axis]);
    }
    piece->size = sqrt(size_2);
    piece->cost = PIECE_WEIGHT * sqrt(area) * size_2;
}

/* Sorts the triangles by piece, and the pieces by cost. `parents`: a tree for each piece, of its points. */
static bool sort_pieces(struct work *w, uint32_t *parents)
{
    const struct asset_net *const net = &w->net;
    uint32_t *const ends = calloc((size_t)net->point_count + 1, sizeof *ends);
    w->by_piece = calloc((size_t)net->triangle_count + 1, sizeof *w->by_piece);
    w->pieces = calloc((size_t)net->triangle_count + 1, sizeof *w->pieces);
    const bool is_done = ends != NULL && w->by_piece != NULL && w->pieces != NULL;
    for (uint32_t t = 0; t < net->triangle_count && is_done; t++) {
        ends[root_of(parents, asset_net_point(net, 3 * t))]++;
    }
    for (uint32_t p = 0, first = 0; p < net->point_count && is_done; p++) {
        const uint32_t n = ends[p];
        if (n > 0) {
            w->pieces[w->piece_count++] = (struct piece){0, 0, first, first + n};
        }
        ends[p] = first;
        first += n;
    }
    for (uint32_t t = 0; t < net->triangle_count && is_done; t++) {
        w->by_piece[ends[root_of(parents, asset_net_point(net, 3 * t))]++] = t;
    }
    for (uint32_t i = 0; i < w->piece_count && is_done; i++) {
        measure_piece(net, w->by_piece, &w->pieces[i]);
    }
    if (is_done) {
        qsort(w->pieces, w->piece_count, sizeof *w->pieces, by_cost);
    }
    free(ends);
    return is_done;
}

static bool find_pieces(struct work *w)
{
    const struct asset_net *const net = &w->net;
    uint32_t *const parents = malloc(sizeof *parents * ((size_t)net->point_count + 1));
    for (uint32_t p = 0; p < net->point_count && parents != NULL; p++) {
        parents[p] = p;
    }
    for (uint32_t corner = 0; corner < 3 * net->triangle_count && parents != NULL; corner++) {
        const uint32_t a = root_of(parents, asset_net_point(net, corner)),
                       b = root_of(parents, asset_net_point(net, corner / 3 * 3));
        parents[a > b ? a : b] = a > b ? b : a;
    }
    const bool is_done = parents != NULL && sort_pieces(w, parents);
    free(parents);
    return is_done;
}

/* Leaves out the cheapest piece. The last one stays. */
static void drop_piece(struct work *w)
{
    const struct piece *const piece = &w->pieces[w->next_piece++];
    for (uint32_t i = piece->first; i < piece->end; i++) {
        w->live -= w->net.is_live[w->by_piece[i]];
        w->net.is_live[w->by_piece[i]] = false;
    }
    w->error = fmax(w->error, piece->size);
}

/* ---- all of it --------------------------------------------------------------------------------------------------- */

static void push_all(struct work *w)
{
    for (uint32_t p = 0; p < w->net.point_count; p++) {
        const uint32_t mark = ++w->mark;
        EACH_CORNER(&w->net, corner, p)
        {
            for (uint32_t i = corner / 3 * 3; i < corner / 3 * 3 + 3; i++) {
                const uint32_t other = asset_net_point(&w->net, i);
                if (other > p && w->marks[other] != mark) {
                    w->marks[other] = mark;
                    push_edge(w, p, other);
                }
            }
        }
    }
}

/* Removes triangles until so many are left, or nothing more can go. */
static void reduce(struct work *w, uint32_t triangles)
{
    push_all(w);
    while (w->live > triangles && !w->is_out) {
        const bool has_piece = w->next_piece + 1 < w->piece_count;
        if (w->heap_count > 0 && (!has_piece || w->heap[0].cost <= w->pieces[w->next_piece].cost)) {
            step(w);
        } else if (w->heap_count == 0 && !w->may_turn) {
            w->may_turn = true;
            push_all(w);
        } else if (has_piece) {
            drop_piece(w);
        } else {
            break;
        }
    }
}

/* Holds points that are outermost as the model turns, from the lowest to the highest: the turntable's camera goes back
 * until they are in the picture, so without one all of the picture would be another. */
static void hold_outermost(struct work *w, uint32_t triangles)
{
    const uint32_t count = triangles / HELD_SHARE < HELD_MOST ? triangles / HELD_SHARE : HELD_MOST;
    for (uint32_t i = 0; i < count; i++) {
        const double up = (2.0 * i + 1) / count - 1, out = sqrt(1 - up * up);
        double most = -HUGE_VAL;
        uint32_t outermost = 0;
        for (uint32_t wedge = 0; wedge < w->net.wedge_count; wedge++) {
            const double *const x = asset_net_x(&w->net, wedge);
            const double far = out * sqrt(x[0] * x[0] + x[2] * x[2]) + up * x[1];
            outermost = far > most ? w->net.wedges[wedge].point : outermost;
            most = fmax(most, far);
        }
        w->is_held[outermost] = true;
    }
}

static bool begin(struct work *w, const struct model *model)
{
    *w = (struct work){.live = 0};
    if (!asset_net_make(&w->net, model) || !find_pieces(w)) {
        return false;
    }
    const size_t points = (size_t)w->net.point_count + 1;
    w->versions = calloc(points, sizeof *w->versions);
    w->marks = calloc(points, sizeof *w->marks);
    w->moved = calloc(points, sizeof *w->moved);
    w->is_held = calloc(points, sizeof *w->is_held);
    w->live = w->net.triangle_count;
    return w->versions != NULL && w->marks != NULL && w->moved != NULL && w->is_held != NULL;
}

static void end(struct work *w)
{
    asset_net_free(&w->net);
    free(w->versions);
    free(w->marks);
    free(w->moved);
    free(w->is_held);
    free(w->heap);
    free(w->pieces);
    free(w->by_piece);
}

int asset_simplify(const struct model *model, uint32_t triangles, struct asset_rest *rest)
{
    struct work w;
    *rest = (struct asset_rest){.indices = malloc(sizeof *rest->indices * 3 * ((size_t)model->triangle_count + 1)),
                                .is_simplified = true};
    const bool has_room = begin(&w, model) && rest->indices != NULL;
    if (has_room) {
        hold_outermost(&w, triangles);
        reduce(&w, triangles);
    }
    for (uint32_t corner = 0; has_room && corner < 3 * w.net.triangle_count; corner++) {
        if (w.net.is_live[corner / 3]) {
            rest->indices[rest->index_count++] = w.net.wedges[asset_net_wedge(&w.net, corner)].source;
        }
    }
    rest->error = w.error * w.net.size;
    const bool is_done = has_room && !w.is_out;
    end(&w);
    return is_done ? 0 : complain("not enough memory to simplify the model");
}
