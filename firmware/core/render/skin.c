/* Skins by two cores: see motion.h. */
#include "motion.h"

#include "cores.h"

/* Vertices that one core moves: `count` from `first` on. */
struct skin_share {
    const struct ph_bound *from;
    const struct ph_xform *matrices;
    struct fx_vec3 *positions;
    int16_t (*normals)[3]; /* or NULL */
    uint32_t first, count;
};

static void skin_share(void *argument) /* called as run */
{
    const struct skin_share *const s = argument;
    const uint32_t first = s->first;
    struct ph_bound from = *s->from;
    from.vertex_count = s->count;
    from.positions += first;
    from.normals = from.normals ? from.normals + first : NULL;
    from.influences = from.influences ? from.influences + first : NULL;
    ph_skin_vertices(&from, s->matrices, s->positions + first, s->normals ? s->normals + first : NULL);
}

void ph_skin_mesh(const struct ph_renderer *r, const struct ph_bound *from, const struct ph_xform *matrices,
                  struct fx_vec3 *positions, int16_t (*normals)[3])
{
    const uint32_t n = from->vertex_count;
    struct skin_share mine = {from, matrices, positions, normals, 0, n / 2}, others = mine;
    others.first = n / 2;
    others.count = n - n / 2;
    if (r == NULL || n < PH_SHARED_LEAST) {
        ph_skin_vertices(from, matrices, positions, normals);
    } else {
        ph_run_both(r, skin_share, &mine, &others);
    }
}
