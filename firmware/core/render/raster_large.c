/* See raster_large.h. */
/* Kits on armv6m: -O2. */
#include "raster_large.h"

#include "colours.h"
#include "raster_walk.h"
#include "shading.h"
#include "tier.h"

PH_TIER(loop) uint32_t ph_draw_large(const struct ph_triangle *t, const struct ph_band *band)
{
    const bool in_codes = t->block != PH_BLOCK_LINEAR && !band->depth24;
    if (t->kind == PH_KIND_GOURAUD && in_codes) {
        return t->material->shading->gouraud->draw_long(t, band);
    }
    return t->kind == PH_KIND_TEXTURE   ? t->material->shading->texturing.draw_textured(t, band)
           : t->kind == PH_KIND_COLOURS ? band->colouring->draw_colours(t, band)
           : in_codes                   ? ph_walk_flat(t, band)
                                        : band->ways->walk(t, band);
}
