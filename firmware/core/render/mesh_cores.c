/* Meshes on two cores: each draws or culls a part of the triangles. See mesh.h. */
/* Kits on armv6m: -O3. */
#include "mesh.h"

#include "cores.h"
#include "edge.h"

/* Triangles that two cores draw one by one: this core from the first on, the other one from the last back, until they
 * meet. They claim triangles as struct fresh of bands_cores.c describes. This struct lies in the memory of the scene.
 */
struct each_lent {
    struct ph_lent lent;
    struct ph_part_context c; /* the other core's */
    const uint16_t (*index)[3];
    uint32_t count, claimed[2];
    uint32_t counts[PH_MESH_BLOCK + 1]; /* the other core's, see ph_list_take_back */
};

struct each_share {
    const struct ph_part_context *c;
    struct each_lent *with;
    uint32_t core, seen;
};

static void each_share(void *argument) /* called as each */
{
    struct each_share *const s = argument;
    struct each_lent *const with = s->with;
    for (uint32_t n = 0;; n++) {
        __atomic_store_n(&with->claimed[s->core], n + 1, __ATOMIC_SEQ_CST);
        if (n + 1 + __atomic_load_n(&with->claimed[1 - s->core], __ATOMIC_SEQ_CST) > with->count) {
            break;
        }
        s->seen += ph_draw_any(s->c, with->index[s->core == 0 ? n : with->count - 1 - n]);
        if (s->core == 1) {
            with->counts[n + 1] = ph_ref_count(s->c->r);
        }
    }
}

/* Draws at most PH_MESH_BLOCK triangles by ph_draw_any on two cores, and adds those that can be seen. False if there is
 * too little room for that: then nothing is listed. */
static bool each_of_block(const struct ph_part_context *c, const uint16_t (*index)[3], uint32_t count, uint32_t *seen)
{
    struct each_lent *const with = ph_list_lend(c->r, &c->draw, sizeof *with);
    if (with == NULL) {
        return false;
    }
    with->c = *c;
    with->c.r = &with->lent.renderer;
    with->index = index;
    with->count = count;
    with->claimed[0] = with->claimed[1] = with->counts[0] = 0;
    struct each_share mine = {c, with, 0, 0}, others = {&with->c, with, 1, 0};
    ph_run_both(c->r, each_share, &mine, &others);
    const uint32_t first = with->claimed[0] - 1, last = with->claimed[1] - 1;
    if (first + last < count) { /* both claimed one at the same time */
        mine.seen += ph_draw_any(c, index[first]);
    }
    if (!ph_list_take_back(c->r, &with->lent, with->counts, last)) {
        return false;
    }
    *seen += mine.seen + others.seen;
    return true;
}

/* Triangles that are drawn one by one: fewer than these are drawn by one core, which draws so many before it asks for
 * the other core again. */
#define EACH_LEAST 6
#define EACH_ALONE 3

uint32_t ph_each_both(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    uint32_t seen = 0;
    bool may_share = true;
    while (index < end) {
        uint32_t count = (uint32_t)(end - index);
        if (may_share && count >= EACH_LEAST && ph_other_core_is_idle(c->r)) {
            count = count < PH_MESH_BLOCK ? count : PH_MESH_BLOCK;
            may_share = each_of_block(c, index, count, &seen);
            index += may_share ? count : 0;
            continue;
        }
        for (const uint16_t(*const stop)[3] = index + (count < EACH_ALONE ? count : EACH_ALONE); index < stop;
             index++) {
            seen += ph_draw_any(c, *index);
        }
    }
    return seen;
}

/* Triangles that one core lists, and where. */
struct cull_share {
    const struct ph_part_context *c;
    struct ph_cull_run run;
    bool must_clip; /* it met a triangle that must be clipped, and stopped */
};

/* Lists a triangle at which ph_cull stopped, in a list of its own. False if it must be clipped. */
PH_TIER(figure) static bool list_stopped(const struct ph_part_context *c, struct ph_cull_run *run)
{
    const uint16_t *const index = run->index[-1];
    const struct ph_vertex *const v[3] = {&c->vertices[index[0]], &c->vertices[index[1]], &c->vertices[index[2]]};
    if (((ph_code_of(v[0]) | ph_code_of(v[1]) | ph_code_of(v[2])) & PH_CLIP) != 0) {
        return false;
    }
    const int32_t row = ph_sides(v[0], v[1], v[2]).area > 0 ? ph_first_row_of(c->r, v) : -1;
    if (row >= 0) {
        *--run->to = (struct ph_ref){{index[0], index[1], index[2]}, ph_band_of(c->r, row)};
        for (int i = 0; c->lit && i < 3; i++) {
            ph_mark(&c->vertices[index[i]]);
        }
    }
    return true;
}

PH_TIER(figure) static void cull_share(void *argument) /* called as run */
{
    struct cull_share *const s = argument;
    while (!s->must_clip && ph_cull(&s->run)) {
        s->must_clip = !list_stopped(s->c, &s->run);
    }
}

/* Culls and lists triangles on two cores, each into its own half of the room, and adds those that can be seen. False if
 * one must be clipped: then nothing is listed. */
PH_TIER(mesh)
static bool cull_halves(const struct ph_part_context *c, const uint16_t (*index)[3], uint32_t count, uint32_t *seen)
{
    struct ph_list *const list = &c->r->list;
    const uint32_t half = count / 2;
    struct cull_share mine = {.c = c, .run = ph_cull_run_of(c, index, index + half)};
    struct cull_share others = {.c = c, .run = ph_cull_run_of(c, index + half, index + count)};
    others.run.to -= half;
    ph_run_both(c->r, cull_share, &mine, &others);
    if (mine.must_clip || others.must_clip) {
        return false;
    }
    const struct ph_ref *from = list->to - half;
    *seen += (uint32_t)(list->to - mine.run.to) + (uint32_t)(from - others.run.to);
    for (list->to = mine.run.to; from > others.run.to;) {
        *--list->to = *--from;
    }
    return true;
}

PH_TIER(mesh)
uint32_t ph_cull_both(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3])
{
    const struct ph_list *const list = &c->r->list;
    uint32_t seen = 0;
    while (index < end) {
        const uint32_t room = (uint32_t)(list->to - list->end), left = (uint32_t)(end - index);
        const uint32_t most = c->codes != 0 && left > PH_MESH_BLOCK ? PH_MESH_BLOCK : left,
                       count = most < room ? most : room;
        if (count < PH_SHARED_LEAST) {
            break;
        }
        if (!cull_halves(c, index, count, &seen)) {
            seen += ph_cull_alone(c, index, index + count);
        }
        index += count;
    }
    return seen + ph_cull_alone(c, index, end);
}
