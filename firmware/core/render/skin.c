/* Skins by two cores: see motion.h. */
#include "motion.h"

#include "cores.h"

/* Vertices that one core moves. */
struct skin_share {
    struct ph_bound from;
    const struct ph_xform *matrices;
    struct fx_vec3 *positions;
    int16_t (*normals)[3]; /* or NULL */
};

static void skin_share(void *argument)
{
    const struct skin_share *const s = argument;
    ph_skin_vertices(&s->from, s->matrices, s->positions, s->normals);
}

void ph_skin_mesh(const struct ph_renderer *r, const struct ph_bound *from, const struct ph_xform *matrices,
                  struct fx_vec3 *positions, int16_t (*normals)[3])
{
    const uint32_t n = from->vertex_count, half = n >= PH_SHARED_LEAST ? n / 2 : 0;
    struct skin_share mine = {*from, matrices, positions, normals}, others = mine;
    mine.from.vertex_count = half;
    others.from.vertex_count = n - half;
    others.from.positions += half;
    others.from.normals = from->normals ? from->normals + half : NULL;
    others.from.influences = from->influences ? from->influences + half : NULL;
    others.positions += half;
    others.normals = normals ? normals + half : NULL;
    if (half == 0 || r == NULL || r->config.other_core == NULL) {
        ph_skin_vertices(from, matrices, positions, normals);
    } else {
        ph_run_both(r, skin_share, &mine, &others);
    }
}
