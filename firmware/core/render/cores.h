/* cores: work that two cores share. Private to firmware/core. */
#ifndef PH_CORES_H
#define PH_CORES_H

#include "band.h"
#include "render.h"

#define PH_SHARED_LEAST 32 /* with fewer vertices or triangles one core does all */

/* Runs a function on both cores: with `mine` on this one and with `others` on the other one. If there is no other core,
 * or it is busy, both run here. Returns when both are done. Neither may change what the other reads. */
static inline void ph_run_both(const struct ph_renderer *r, void (*run)(void *argument), void *mine, void *others)
{
    const bool both = r->config.other_core != NULL && r->config.other_core(run, others);
    run(mine);
    if (both) {
        r->config.other_core_join();
    } else {
        run(others);
    }
}

/* Whether there is another core, and it is free. */
bool ph_other_core_is_idle(const struct ph_renderer *r);

struct ph_clip_matrix;
struct ph_feed;
struct ph_part_context;
struct ph_rest;
struct ph_vertex;

/* What only a renderer with two cores calls; struct ph_config names it, so that the linker leaves it out of a program
 * for one core. See transform.h, mesh.h and band_rest.h. */
struct ph_cores {
    uint32_t (*transform_both)(const struct ph_renderer *r, const struct ph_clip_matrix *m, const struct ph_mesh *mesh,
                               struct ph_vertex *vertices);
    uint32_t (*each_both)(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);
    uint32_t (*cull_both)(const struct ph_part_context *c, const uint16_t (*index)[3], const uint16_t (*end)[3]);
    bool (*is_idle)(const struct ph_renderer *r); /* ph_other_core_is_idle */
    bool (*draw_chunk)(struct ph_feed *f, struct ph_rest *rest, bool clears);
};

/* The rows of a band that one core draws. */
struct ph_share {
    struct ph_renderer *r;
    struct ph_band band;
    uint32_t part, parts; /* part 0 of 1, or parts 0 and 1 of 2 */
    uint32_t fragments;   /* 0 before */
};

/* Draws a band on both cores: the first `rows` rows here, and the others on the other core; or all of it here, if
 * `rows` is 0 or the other core is not idle. run takes a struct ph_share, whose fragments are counted. */
void ph_draw_in_parts(struct ph_renderer *r, const struct ph_band *band, int32_t rows, void (*run)(void *share));

#endif
