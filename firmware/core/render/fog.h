/* fog: the fog's share of a colour. Private to firmware/core. */
#ifndef PH_FOG_H
#define PH_FOG_H

#include "blend.h"
#include "render.h"

struct ph_fog_here;

/* What fogs. Only ph_frame_fog names it, so the linker leaves it out of a program without fog. */
struct ph_fogging {
    void (*fog_band)(struct ph_renderer *r, const struct ph_band *band);       /* on both cores */
    void (*fog_rows)(const struct ph_renderer *r, const struct ph_band *band); /* the rows of one core's share */
    /* Fogs n pixels with these depth codes, but empty ones. */
    void (*fog_run)(struct ph_fog_here *fog, uint16_t *pixels, const void *codes, uint32_t n, bool depth24);
};

/* What fog leaves of a colour, and what it adds: a colour as in blend.h, then the same for the channels of a pair that
 * are not those of PH_SPREAD (pairs.h). */
struct ph_fog_mix {
    uint32_t left;          /* 32 - the fog's share */
    uint32_t added, others; /* its colour times its share, and a half */
};

/* The fog at one depth code. It is kept, because neighbours mostly have the same code. */
struct ph_fog_here {
    const uint32_t *codes; /* as in the renderer */
    uint32_t colour;       /* spread */
    uint32_t below, most;  /* the depth codes below < code <= most have the same */
    struct ph_fog_mix mix;
};

/* Starts with codes for which nothing is kept. */
void ph_fog_start(struct ph_fog_here *fog, const struct ph_renderer *r, uint16_t colour);

/* Looks up what is kept for a code. */
void ph_fog_find(struct ph_fog_here *fog, uint32_t code);

/* Makes what is kept that of a code. */
static inline void ph_fog_at(struct ph_fog_here *fog, uint32_t code)
{
    if (code <= fog->below || code > fog->most) {
        ph_fog_find(fog, code);
    }
}

static inline uint32_t ph_fogged(const struct ph_fog_mix *mix, uint32_t colour)
{
    return (colour * mix->left + mix->added) >> 5 & PH_SPREAD;
}

#endif
