/* See list.h. */
#include "list.h"

#include "colour.h"
#include "colours.h"
#include "edge.h"
#include "kernels.h"

enum { OWN, VERTICES, TRIANGLES };

#define GRAIN   8u          /* bytes */
#define NO_ROOM 0x3fffffffu /* used: nothing is taken from there */

/* A triangle that can be seen takes a reference of 8 bytes. Half of a closed mesh can be seen, and it has half as many
 * vertices as triangles: so another 16 bytes hold as many vertices, however many meshes there are. */
const size_t ph_vertex_bytes = sizeof(struct ph_vertex);
const size_t ph_triangle_bytes = sizeof(struct ph_vertex) + sizeof(struct ph_ref);
_Static_assert(sizeof(struct ph_vertex) == PH_VERTEX_BYTES_32 &&
                   sizeof(struct ph_vertex) + sizeof(struct ph_ref) == PH_TRIANGLE_BYTES_32,
               "see render.h");

PH_TIER(mesh) void *ph_at(const struct ph_renderer *r, uint32_t place)
{
    const unsigned piece = place >> 30;
    const uint8_t *const base = piece == OWN        ? (const uint8_t *)r->own
                                : piece == VERTICES ? (const uint8_t *)r->config.vertices
                                                    : (const uint8_t *)r->config.triangles;
    return (void *)(uintptr_t)(base + (place & NO_ROOM));
}

/* Whether vertices and triangles share one piece of memory: then it is that of the vertices. */
PH_TIER(mesh) static bool is_shared(const struct ph_renderer *r)
{
    return r->config.vertices == r->config.triangles;
}

/* Bytes of a piece, without the references. */
PH_TIER(mesh) static size_t room_of(const struct ph_renderer *r, int piece)
{
    const struct ph_config *c = &r->config;
    const uint8_t *const refs = (const uint8_t *)r->list.to;
    return piece == OWN         ? sizeof r->own
           : piece == TRIANGLES ? (size_t)(refs - (const uint8_t *)c->triangles)
           : is_shared(r)       ? 0
                                : c->vertex_max * ph_vertex_bytes;
}

/* Sets list->end, down to which references may be listed: they grow downwards in memory. */
PH_TIER(mesh) static void set_end(struct ph_renderer *r)
{
    struct ph_list *const list = &r->list;
    if (list->stage != PH_LIST_OPEN) {
        list->end = list->to;
        return;
    }
    const uint8_t *const base = (const uint8_t *)r->config.triangles;
    const size_t most = ((size_t)((const uint8_t *)list->top - base) - list->used[TRIANGLES]) / sizeof(struct ph_ref);
    list->end = list->top - (most < r->config.triangle_max ? most : r->config.triangle_max);
}

PH_TIER(mesh) void ph_list_again(struct ph_renderer *r, const struct ph_draw *draw)
{
    if (!ph_list_draw(r, draw)) {
        r->list.stage = PH_LIST_FULL;
        set_end(r);
    }
}

void ph_list_close(struct ph_renderer *r)
{
    r->list.stage = PH_LIST_CLOSED;
    r->list.band = PH_NO_BAND;
    for (int piece = 0; piece < 3; piece++) {
        r->list.used[piece] = NO_ROOM;
    }
    set_end(r);
}

/* Forgets the copies of materials but for this one. */
PH_TIER(few) static void forget_copies(struct ph_list *list, uint32_t but)
{
    for (int i = 0; i < PH_LIST_COPIES; i++) {
        list->copies[i] = i == 0 ? but : PH_NONE;
    }
}

PH_TIER(few) void ph_list_begin(struct ph_renderer *r)
{
    struct ph_list *const list = &r->list;
    const struct ph_config *c = &r->config;
    const size_t bytes = is_shared(r) ? c->vertex_max * ph_vertex_bytes : c->triangle_max * ph_triangle_bytes;
    list->top = (struct ph_ref *)(void *)((uint8_t *)c->triangles + (bytes & ~(size_t)7));
    list->to = list->top;
    list->used[OWN] = list->used[VERTICES] = list->used[TRIANGLES] = 0;
    list->first = list->last = list->lens = PH_NONE;
    forget_copies(list, PH_NONE);
    list->stage = PH_LIST_OPEN;
    r->rows = 0;
    r->after = NULL;
    r->points = NULL;
    r->clouds = PH_NONE;
    list->band_scale = (uint32_t)fx_quotient_u64(((uint32_t)1 << 20) + c->band_height - 1, c->band_height);
    set_end(r);
}

/* Takes bytes from a piece, or PH_NONE. */
PH_TIER(mesh) static uint32_t take(struct ph_renderer *r, int piece, size_t bytes)
{
    const size_t all = (bytes + GRAIN - 1) & ~(size_t)(GRAIN - 1), used = r->list.used[piece], room = room_of(r, piece);
    if (used > room || all > room - used || used + all > 0x3fffffff) {
        return PH_NONE;
    }
    r->list.used[piece] = (uint32_t)(used + all);
    if (piece == TRIANGLES) {
        set_end(r);
    }
    return (uint32_t)piece << 30 | (uint32_t)used;
}

/* Takes bytes from the first of two pieces, or else from the renderer's own. */
PH_TIER(mesh) static uint32_t take_any(struct ph_renderer *r, int first, int second, size_t bytes)
{
    uint32_t place = take(r, first, bytes);
    place = place == PH_NONE ? take(r, second, bytes) : place;
    return place == PH_NONE ? take(r, OWN, bytes) : place;
}

PH_TIER(mesh) uint32_t ph_list_vertices(struct ph_renderer *r, uint32_t n)
{
    return take_any(r, VERTICES, TRIANGLES, n * sizeof(struct ph_vertex));
}

PH_TIER(seldom) int ph_list_leave_out(struct ph_renderer *r, const struct ph_mesh *mesh, bool lines)
{
    if (r->list.stage == PH_LIST_CLOSED) {
        return PH_ERR_STATE;
    }
    r->stats.vertices_dropped += mesh->vertex_count;
    if (mesh->vertex_count > r->config.vertex_max) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t i = 0; i < mesh->part_count; i++) {
        const struct ph_part *const part = &mesh->parts[i];
        if (!ph_is_wire(&mesh->materials[part->material])) {
            r->stats.triangles_in += part->count;
            r->stats.triangles_dropped += part->count;
        } else if (lines) {
            r->stats.triangles_dropped += mesh->edge_count;
        }
    }
    return PH_OK;
}

#define SET_UP_WORK 16 /* pixels: about a triangle's set-up, for each two rows */
#define ROWS_MOST   4u /* at a time: a texture is divided again for each */

PH_TIER(seldom) uint16_t *ph_list_work(const struct ph_renderer *r)
{
    return (uint16_t *)ph_at(r, r->rows_place + r->rows * ph_row_bytes(r)); /* behind the rows */
}

PH_TIER(seldom) bool ph_begin_blend(struct ph_renderer *r, const struct ph_material *material)
{
    const struct ph_blend *const blend = material->blend;
    if (blend->alphas != NULL && blend->kind != PH_BLEND_KEY && ph_texels_of_blend(material) == NULL) {
        return false;
    }
    const size_t row = ph_row_bytes(r);
    const size_t most = room_of(r, TRIANGLES) / 16 / row;
    const uint32_t rows = most > ROWS_MOST ? ROWS_MOST : most > 0 ? 2 : 1; /* two: so that two cores can draw */
    if (r->rows == 0) {
        const uint32_t pairs = (r->config.height + 1u) / 2;
        r->rows_place = take_any(r, TRIANGLES, VERTICES, rows * row + pairs * sizeof(uint16_t));
        if (r->rows_place != PH_NONE) {
            r->rows = rows;
            ph_fill(ph_list_work(r), 0, pairs);
        }
    }
    if (r->rows == 0) {
        return false;
    }
    r->after = blend->draw;
    return true;
}

PH_TIER(seldom)
struct ph_box ph_box_of(const struct ph_renderer *r, const struct ph_draw *draw, const struct ph_ref *ref)
{
    const size_t size = (draw->kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    const uint8_t *const base = ph_at(r, draw->base);
    const int n = (draw->kind & PH_DRAW_LINES) != 0 ? 2 : 3, half_width = n == 2 ? 128 << r->samples_log2 : 0;
    struct ph_box box = {INT32_MAX, INT32_MIN, INT32_MAX, INT32_MIN};
    for (int i = 0; i < n; i++) {
        const struct ph_vertex *const v = (const void *)(base + ref->corner[i] * size);
        box.x0 = ph_min(box.x0, v->x);
        box.x1 = ph_max(box.x1, v->x);
        box.y0 = ph_min(box.y0, v->y);
        box.y1 = ph_max(box.y1, v->y);
    }
    return (struct ph_box){ph_first_row(box.x0 - half_width), ph_first_row(box.x1 + half_width),
                           ph_first_row(box.y0 - half_width), ph_first_row(box.y1 + half_width)};
}

PH_TIER(seldom) void ph_put_after(struct ph_renderer *r, uint32_t since, uint32_t first)
{
    uint16_t *const work = ph_list_work(r);
    for (uint32_t place = since != PH_NONE ? since : r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        const uint32_t end = ph_end_of_draw(r, draw);
        for (uint32_t i = draw->first > first ? draw->first : first; i < end; i++) {
            struct ph_ref *const ref = ph_ref_at(r, i);
            const struct ph_box box = ph_box_of(r, draw, ref);
            const int32_t from = ph_max(box.y0, 0), last = ph_max(ph_min(box.y1, r->config.height) - 1, 0);
            ref->link = (uint16_t)(PH_LINK_AFTER | (last >> 3 & 127) << 8 | from >> 3);
            const int32_t columns = ph_max(ph_min(box.x1, r->config.width) - ph_max(box.x0, 0), 0) + SET_UP_WORK;
            for (int32_t pair = from >> 1; pair <= last >> 1; pair++) {
                work[pair] = (uint16_t)(work[pair] + columns);
            }
        }
        place = draw->next;
    }
}

PH_TIER(mesh) static struct ph_draw *draw_at(const struct ph_renderer *r, uint32_t place)
{
    return (struct ph_draw *)ph_at(r, place);
}

/* The place of the camera in use. */
PH_TIER(few) static uint32_t place_lens(struct ph_renderer *r)
{
    if (r->list.lens == PH_NONE) {
        const uint32_t place = take_any(r, OWN, TRIANGLES, sizeof r->lens);
        if (place != PH_NONE) {
            *(struct ph_lens *)ph_at(r, place) = r->lens;
        }
        r->list.lens = place;
    }
    return r->list.lens;
}

#define MATERIAL_BYTES 56u /* in the list, on every machine, so that the same fits */
_Static_assert(sizeof(struct ph_material) <= MATERIAL_BYTES, "a material fits its room in the list");

PH_TIER(mesh) static PH_NOINLINE bool is_equal(const struct ph_material *a, const struct ph_material *b)
{
    return a == b ||
           (a->shading == b->shading && a->colour == b->colour && a->texture == b->texture && a->ramp == b->ramp &&
            a->blend == b->blend && a->two_sided == b->two_sided && a->shininess_log2 == b->shininess_log2 &&
            a->depth_bias == b->depth_bias && a->depth_bias_slope == b->depth_bias_slope && a->ambient == b->ambient &&
            a->diffuse == b->diffuse && a->specular == b->specular);
}

PH_TIER(mesh)
static inline const struct ph_material *material_of(const struct ph_renderer *r, const struct ph_draw *draw)
{
    return ph_at(r, draw->copy[0] & ~1u);
}

/* The place of a copy that is equal to a material, among the last ones; or PH_NONE. The last draw's is among them. */
PH_TIER(mesh) static PH_NOINLINE uint32_t find_copy(const struct ph_renderer *r, const struct ph_material *material)
{
    for (int i = 0; i < PH_LIST_COPIES && r->list.copies[i] != PH_NONE; i++) {
        if (is_equal(ph_at(r, r->list.copies[i]), material)) {
            return r->list.copies[i];
        }
    }
    return PH_NONE;
}

/* Copies a material for the draw that follows the last one, or that takes its room (`again`), and so that of a copy
 * that was made for it. Returns what ph_draw.copy says of it, or PH_NONE. */
PH_TIER(mesh)
static PH_NOINLINE uint32_t copy_material(struct ph_renderer *r, const struct ph_draw *last, bool again,
                                          const struct ph_material *material)
{
    uint32_t *const copies = r->list.copies;
    uint32_t place = PH_NONE;
    if (again && (last->copy[0] & 1) != 0) {
        place = last->copy[0] & ~1u;
    } else {
        place = take_any(r, OWN, TRIANGLES, MATERIAL_BYTES);
        if (place == PH_NONE) {
            return PH_NONE;
        }
        for (int i = PH_LIST_COPIES - 1; i > 0; i--) {
            copies[i] = copies[i - 1];
        }
        copies[0] = place;
    }
    *(struct ph_material *)ph_at(r, place) = *material;
    return place | 1;
}

PH_TIER(mesh) bool ph_list_draw(struct ph_renderer *r, const struct ph_draw *draw)
{
    struct ph_list *const list = &r->list;
    struct ph_draw *last = list->last == PH_NONE ? NULL : draw_at(r, list->last);
    const uint32_t lens = place_lens(r), count = ph_ref_count(r), found = find_copy(r, draw->material);
    const bool equal = last != NULL && found == (last->copy[0] & ~1u);
    if (lens == PH_NONE) {
        return false;
    }
    if (equal && last->uvs == draw->uvs && last->base == draw->base && last->kind == draw->kind && last->lens == lens) {
        return true;
    }
    const bool again = last != NULL && last->first == count; /* without references it gives its room to the next one */
    const uint32_t copy = found == PH_NONE ? copy_material(r, last, again, draw->material)
                          : equal && again ? last->copy[0]
                                           : found;
    if (copy == PH_NONE) {
        return false;
    }
    if (!again) {
        const uint32_t place = take_any(r, OWN, TRIANGLES, sizeof *last);
        if (place == PH_NONE) {
            return false;
        }
        *(last != NULL ? &last->next : &list->first) = place;
        list->last = place;
        last = draw_at(r, place);
    }
    *last = *draw;
    last->copy[0] = copy;
    last->first = count;
    last->next = PH_NONE;
    last->lens = lens;
    return true;
}

const struct ph_material *ph_list_material(const struct ph_renderer *r)
{
    return material_of(r, draw_at(r, r->list.last));
}

void ph_list_end(struct ph_renderer *r)
{
    struct ph_draw *draw;
    for (uint32_t place = r->list.first; place != PH_NONE; place = draw->next) {
        draw = draw_at(r, place);
        draw->material = material_of(r, draw);
    }
    ph_list_close(r);
}

PH_TIER(few) struct ph_mark ph_list_mark(struct ph_renderer *r)
{
    place_lens(r);
    struct ph_mark mark;
    for (int piece = 0; piece < 3; piece++) {
        mark.used[piece] = r->list.used[piece];
    }
    mark.last = r->list.last;
    mark.count = ph_ref_count(r);
    mark.rows = r->rows;
    if (mark.last != PH_NONE) {
        mark.draw = *draw_at(r, mark.last);
    }
    return mark;
}

PH_TIER(few) void ph_list_rewind(struct ph_renderer *r, const struct ph_mark *mark)
{
    if (ph_ref_count(r) != mark->count) {
        return;
    }
    for (int piece = 0; piece < 3; piece++) {
        r->list.used[piece] = mark->used[piece];
    }
    if (mark->last != PH_NONE) {
        *draw_at(r, mark->last) = mark->draw;
    } else {
        r->list.first = PH_NONE;
    }
    r->list.last = mark->last;
    forget_copies(&r->list, mark->last != PH_NONE ? mark->draw.copy[0] & ~1u : PH_NONE);
    r->rows = mark->rows;
    set_end(r);
}

PH_TIER(mesh) uint32_t ph_list_base(const struct ph_renderer *r)
{
    return r->list.last != PH_NONE ? draw_at(r, r->list.last)->base : PH_NONE;
}

/* ---- two cores -------------------------------------------------------------------------------------------------- */

#define ROOM_LEAST 4096u /* bytes for what is listed in half of the room */

void *ph_list_lend(struct ph_renderer *r, const struct ph_draw *draw, size_t bytes)
{
    const size_t size = sizeof(struct ph_vertex), all = (bytes + size - 1) & ~(size - 1);
    const uint32_t base = draw->base & NO_ROOM, used = r->list.used[TRIANGLES];
    const uint32_t from = used + ((base - used) & (uint32_t)(size - 1)), room = (uint32_t)room_of(r, TRIANGLES);
    if (!is_shared(r) || draw->base >> 30 != TRIANGLES || room < from || (room - base) / size > 65536 ||
        (room - from) / 2 < all + ROOM_LEAST) {
        return NULL;
    }
    const uint32_t half = (room - from) / 2 & ~(uint32_t)(size - 1);
    struct ph_lent *const lent = ph_at(r, (uint32_t)TRIANGLES << 30 | (uint32_t)(from + half - all));
    lent->renderer = *r;
    lent->last = *draw_at(r, r->list.last);
    lent->stats = r->stats;
    lent->to = r->list.to;
    lent->base = base;
    lent->from = from;
    lent->half = half;
    struct ph_list *const theirs = &lent->renderer.list;
    lent->renderer.stats = (struct ph_stats){0};
    theirs->top = theirs->to = (struct ph_ref *)(void *)lent;
    for (int piece = 0; piece < 3; piece++) {
        lent->used[piece] = r->list.used[piece];
        theirs->used[piece] = r->list.used[piece] = NO_ROOM;
    }
    theirs->used[TRIANGLES] = from;
    theirs->last = (uint32_t)TRIANGLES << 30 | (uint32_t)(from + half - all + offsetof(struct ph_lent, last));
    r->list.used[TRIANGLES] = from + half;
    set_end(&lent->renderer);
    set_end(r);
    return lent;
}

/* Gives corners from that number on numbers that are so much less, in references from `from` down to `to`. */
static void renumber(struct ph_ref *from, const struct ph_ref *to, uint32_t first, uint32_t less)
{
    while (from > to) {
        from--;
        for (int i = 0; i < 3; i++) {
            from->corner[i] = (uint16_t)(from->corner[i] - (from->corner[i] >= first ? less : 0));
        }
    }
}

bool ph_list_take_back(struct ph_renderer *r, const struct ph_lent *lent, const uint32_t counts[], uint32_t n)
{
    struct ph_list *const list = &r->list;
    const struct ph_list *const theirs = &lent->renderer.list;
    struct ph_ref *const before = lent->to;
    const uint32_t size = sizeof(struct ph_vertex), from = lent->from, half = lent->half;
    const uint32_t corners = (list->used[TRIANGLES] - from - half) / size,
                   others = (theirs->used[TRIANGLES] - from) / size;
    const bool fits = r->stats.triangles_dropped == lent->stats.triangles_dropped &&
                      lent->renderer.stats.triangles_dropped == 0 && list->to - list->end >= theirs->top - theirs->to;
    uint32_t used = lent->used[TRIANGLES];
    list->used[OWN] = lent->used[OWN];
    list->used[VERTICES] = lent->used[VERTICES];
    if (fits) {
        renumber(before, list->to, (from + half - lent->base) / size, half / size - others);
        for (uint32_t k = n; k > 0; k--) {
            for (uint32_t i = counts[k - 1]; i < counts[k]; i++) {
                *--list->to = theirs->top[-1 - (int32_t)i];
            }
        }
        r->stats.triangles_culled += lent->renderer.stats.triangles_culled;
        r->stats.triangles_clipped += lent->renderer.stats.triangles_clipped;
        used = corners + others > 0 ? from + (corners + others) * size : used;
        struct ph_vertex *const to = ph_at(r, (uint32_t)TRIANGLES << 30 | (from + others * size));
        const struct ph_vertex *const at = ph_at(r, (uint32_t)TRIANGLES << 30 | (from + half));
        for (uint32_t i = 0; i < corners; i++) { /* they may lie over what was lent */
            to[i] = at[i];
        }
    } else {
        list->to = before;
        r->stats = lent->stats;
    }
    list->used[TRIANGLES] = used;
    set_end(r);
    return fits;
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

PH_TIER(mesh) int32_t ph_first_row_of(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const int32_t xa = v[0]->x, xb = v[1]->x, xc = v[2]->x, ya = v[0]->y, yb = v[1]->y, yc = v[2]->y;
    const int32_t left = ph_first_row(ph_min(ph_min(xa, xb), xc)), right = ph_first_row(ph_max(ph_max(xa, xb), xc));
    const int32_t top = ph_max(ph_first_row(ph_min(ph_min(ya, yb), yc)), 0);
    const int32_t low = ph_min(ph_first_row(ph_max(ph_max(ya, yb), yc)), r->config.height);
    return left >= right || right <= 0 || left >= r->config.width || top >= low ? -1 : top;
}

/* Lists the triangle with these three corner numbers in the band of its first row. False if row is -1: it has no
 * row. */
PH_TIER(scenery) static bool list_at(struct ph_renderer *r, unsigned a, unsigned b, unsigned c, int32_t row)
{
    if (row < 0) {
        return false;
    }
    struct ph_ref *const ref = ph_list_next(r);
    if (ref != NULL) {
        *ref = (struct ph_ref){{(uint16_t)a, (uint16_t)b, (uint16_t)c}, ph_band_of(r, row)};
    }
    return true;
}

PH_TIER(scenery)
bool ph_list_triangle(struct ph_renderer *r, const uint16_t corner[3], const struct ph_vertex *const v[3],
                      bool two_sided)
{
    const int32_t area = ph_sides(v[0], v[1], v[2]).area;
    if (area == 0 || (area < 0 && !two_sided)) {
        return false;
    }
    const int second = area > 0 ? 1 : 2;
    return list_at(r, corner[0], corner[second], corner[3 - second], ph_first_row_of(r, v));
}

_Static_assert(sizeof(struct ph_vertex) == 2 * GRAIN && sizeof(struct ph_corner) == 3 * GRAIN, "see number_behind");

/* The number of the first of n corners at the end of a piece, if they can have numbers of the last draw, which count
 * from its base; or -1. */
PH_TIER(few)
static int32_t number_behind(const struct ph_renderer *r, const struct ph_draw *last, uint32_t size, uint32_t n)
{
    if (last == NULL || last->uvs != NULL) {
        return -1;
    }
    const uint32_t grains = (r->list.used[last->base >> 30] - (last->base & NO_ROOM)) / GRAIN;
    const uint32_t number = size == 2 * GRAIN ? (grains + 1) / 2 : fx_mulhi_u32(grains + 2, 0xaaaaaaab) >> 1; /* / 3 */
    return number + n <= 65536 ? (int32_t)number : -1;
}

PH_TIER(few)
int32_t ph_list_corners(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                        const struct ph_corner *corners, uint32_t n)
{
    const struct ph_draw *const last = r->list.last == PH_NONE ? NULL : draw_at(r, r->list.last);
    const uint32_t size = (kind & PH_DRAW_UVS) != 0 ? sizeof(struct ph_corner) : sizeof(struct ph_vertex);
    struct ph_draw draw = {.material = material, .kind = kind};
    int32_t number = number_behind(r, last, size, n);
    uint32_t place = PH_NONE;
    if (number >= 0) {
        const uint32_t piece = last->base >> 30;
        place = last->base + (uint32_t)number * size;
        draw.base =
            take(r, (int)piece, (place & NO_ROOM) + n * size - r->list.used[piece]) != PH_NONE ? last->base : PH_NONE;
    }
    if (number < 0 || draw.base == PH_NONE) {
        number = 0;
        draw.base = place = take_any(r, TRIANGLES, VERTICES, n * size);
    }
    if (place == PH_NONE) {
        return -1;
    }
    uint8_t *const to = ph_at(r, place);
    for (uint32_t i = 0; i < n; i++) {
        if (size == sizeof *corners) {
            *(struct ph_corner *)(void *)(to + i * size) = corners[i];
        } else {
            struct ph_vertex *const v = (struct ph_vertex *)(void *)(to + i * size);
            *v = corners[i].at;
            if ((kind & PH_DRAW_COLOURS) != 0) {
                v->light = r->config.colouring->colour_of(&corners[i]);
            }
        }
    }
    return ph_list_draw(r, &draw) ? number : -1;
}

PH_TIER(few)
bool ph_list_fan(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                 const struct ph_corner *corners, uint32_t n)
{
    const struct ph_mark mark = ph_list_mark(r);
    const int32_t first = ph_list_corners(r, material, kind | (ph_has_uvs(material) ? PH_DRAW_UVS : 0), corners, n);
    bool any = false;
    if (first < 0) {
        r->stats.triangles_dropped += n - 2;
        return true;
    }
    for (uint32_t i = 2; i < n; i++) {
        const uint16_t number[3] = {(uint16_t)first, (uint16_t)((uint32_t)first + i - 1),
                                    (uint16_t)((uint32_t)first + i)};
        const struct ph_vertex *const v[3] = {&corners[0].at, &corners[i - 1].at, &corners[i].at};
        any |= ph_list_triangle(r, number, v, material->two_sided != 0 && (kind & PH_DRAW_ONE_SIDE) == 0);
    }
    ph_list_rewind(r, &mark);
    return any;
}
