/* cull: the kernel that lists the triangles of a mesh that can be seen. See kernels.h. */
#ifndef PH_CULL_H
#define PH_CULL_H

#include "list.h"

/*
 * ph_cull lists the triangles whose corners have no clip codes, run counter-clockwise and cover a centre of a pixel. It
 * marks their corners for the light: code gets PH_LIT, and light, where code had it not, becomes 0. It passes over
 * those that cannot be seen, and stops behind a triangle at which the caller must look: some of its corners have codes,
 * but they do not share one; or it is less than 2 px wide; or the references have no room. Corners without codes are at
 * most 2^18 apart each way.
 *
 * Two cores may mark the corners of two runs at a time: both would write the same.
 */
struct ph_cull_run {
    struct ph_vertex *vertices;
    const uint16_t (*index)[3], (*end)[3]; /* the triangles that are left */
    uint32_t codes;                        /* 0 if no vertex has any */
    struct ph_ref *to, *limit;             /* references go down from `to` to `limit` */
    uint32_t band_scale;                   /* as in struct ph_list */
    uint32_t mark;                         /* PH_LIT, or 0: nothing is marked */
};

/* The clip code of a vertex, which the other core may mark at this moment. */
static inline unsigned ph_code_of(const struct ph_vertex *v)
{
    return __atomic_load_n(&v->code, __ATOMIC_RELAXED);
}

static inline uint16_t ph_light_of(const struct ph_vertex *v)
{
    return __atomic_load_n(&v->light, __ATOMIC_RELAXED);
}

/* Marks a vertex for the light. */
static inline void ph_mark(struct ph_vertex *v)
{
    const unsigned code = ph_code_of(v);
    if (code < PH_LIT) {
        __atomic_store_n(&v->light, 0, __ATOMIC_RELAXED);
        __atomic_store_n(&v->code, (uint8_t)(code | PH_LIT), __ATOMIC_RELAXED);
    }
}

/* Lists triangles as struct ph_cull_run describes. False if no triangle is left; else the caller must look at
 * index[-1]. */
bool ph_cull(struct ph_cull_run *run);

/* ph_cull into a list that others may have added to meanwhile; adds to *seen how many it has listed. */
static inline bool ph_cull_into(struct ph_list *list, struct ph_cull_run *run, uint32_t *seen)
{
    run->to = list->to;
    run->limit = list->end;
    const bool stopped = ph_cull(run);
    *seen += (uint32_t)(list->to - run->to);
    list->to = run->to;
    return stopped;
}

#endif
