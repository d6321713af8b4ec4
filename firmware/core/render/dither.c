/*
 * Dithered light. See ph_dither in render.h.
 *
 * It takes the place of antialiasing in the renderer: struct ph_antialiasing has all that set-up and bands ask. Before
 * the first band of a frame, the list's copies of materials get a shading of their own and a ramp of all steps, so that
 * nothing else of the renderer knows of it.
 */
/* Kits on armv6m: -O3. */
#include "bands_loop.h"
#include "colour.h"
#include "edge.h"
#include "gouraud.h"
#include "kernels.h"
#include "list.h"
#include "mesh.h"
#include "planes.h"
#include "raster_rows.h"
#include "samples.h"
#include "setting.h"

_Static_assert(sizeof(((struct ph_dither *)NULL)->calls) == sizeof(struct ph_antialiasing), "room for all calls");
_Static_assert(PH_RAMP_SIZE << (PH_LIGHT_DOWN - PH_DITHERED_DOWN) == PH_DITHER_STEPS * PH_RAMP_SIZE,
               "10 bits of light");

enum {
    STEPS_LOG2 = PH_LIGHT_DOWN - PH_DITHERED_DOWN,
    STEP_BITS = 32 - STEPS_LOG2, /* below them light has its entry and what lies between entries */
};

#define STEP_X ((uint32_t)3 << STEP_BITS)        /* from column to column */
#define STEP_Y (0u - ((uint32_t)1 << STEP_BITS)) /* from row to row; of 8 steps 7 down is one up */

/* Light or its gradient, to make room for the step. */
static inline uint32_t scaled(uint32_t light)
{
    return (uint32_t)((int32_t)light >> STEPS_LOG2);
}

/* ---- triangles -------------------------------------------------------------------------------------------------- */

/* Dithers the light of a small triangle, whose first row is row y of the picture. */
static inline void dither_rows(struct ph_small_triangle *small, int32_t y)
{
    const uint32_t from = small->left >> 16, gx = scaled(small->glight);
    const uint32_t light = small->light + from * small->glight; /* unlike that at column 0, it has not wrapped */
    small->light = (light >> STEPS_LOG2) - from * gx - ((uint32_t)y << STEP_BITS); /* y STEP_Y */
    small->glight = gx + STEP_X;
    small->light_dy = scaled(small->light_dy) + STEP_Y;
}

/* Draws a small triangle in dithered light. */
static uint32_t draw_small(const struct ph_triangle *t, const struct ph_band *band)
{
    if (t->block == PH_BLOCK_NONE && t->y_top >= band->y0 && t->y_bottom <= band->y1 && t->as.small.rows.knee == 0) {
        return ph_draw_whole(t, band, ph_small_dithered);
    }
    struct ph_small_triangle r = t->as.small.rows;
    struct ph_place at = ph_cut_rows(t, band, &r);
    at.draw_gouraud = r.knee != 0 ? ph_knee_dithered : ph_small_dithered;
    at.light_down = PH_DITHERED_DOWN;
    return t->block != PH_BLOCK_NONE ? band->ways->octaves->draw_rows_split(t, &r, &at, NULL)
                                     : at.draw_gouraud(&r, at.depth, at.pixels, 2 * at.stride);
}

/* Makes a small triangle with this knee (0: none) one in dithered light. */
static inline void make_dithered(struct ph_triangle *t, uint32_t knee)
{
    t->as.small.rows.knee = knee;
    t->kind = PH_KIND_SMALL_OWN;
    t->as.small.of.own.draw = draw_small;
}

static const struct ph_shading shading;

/* See struct ph_antialiasing. All but Gouraud triangles in dithered light are set up as without it. */
static void prepare(struct ph_setting *s)
{
    if (s->fast.material->shading != &shading || (s->draw->kind & PH_DRAW_LINES) != 0) {
        s->antialiasing = NULL;
        s->keeps_light = s->source == PH_FROM_LIGHT;
    }
}

static void set_kind(struct ph_triangle *t, bool has_rows) /* called as set_kind */
{
    (void)has_rows;
    dither_rows(&t->as.small.rows, t->y_top);
    make_dithered(t, t->kind == PH_KIND_SMALL_KNEE ? t->as.small.rows.knee : 0);
}

static void take_tall(struct ph_triangle *t, const struct ph_renderer *r, const struct ph_vertex *const v[3],
                      const struct ph_sides *sides)
{
    ph_take_tall(t, r, v, sides);
    if (t->kind == PH_KIND_SMALL) {
        make_dithered(t, 0);
    }
}

/* Beside its first corner the plane of a large triangle has not wrapped. */
static void set_light(const struct ph_plane_base *s, const struct ph_vertex *const v[3], struct ph_triangle *t)
{
    struct ph_plane *const plane = &t->as.large.of.light;
    ph_set_light(s, v, t);
    const uint32_t x = (uint32_t)(v[0]->x >> 8), y = (uint32_t)(v[0]->y >> 8);
    const uint32_t gx = scaled(plane->gx), gy = scaled(plane->gy);
    const uint32_t light = ph_plane_at(plane, x, y) >> STEPS_LOG2;
    *plane = (struct ph_plane){light - x * gx - y * gy, gx + STEP_X, gy + STEP_Y};
}

static uint32_t draw_long(const struct ph_triangle *t, const struct ph_band *band)
{
    return ph_draw_long(t, band, ph_long_dithered, PH_DITHERED_DOWN);
}

static const struct ph_gouraud gouraud = {.take_tall = take_tall, .set_light = set_light, .draw_long = draw_long};
static const struct ph_shading shading = {.corners = PH_EACH_CORNER, .gouraud = &gouraud}; /* after the lighting */

/* ---- ramps ------------------------------------------------------------------------------------------------------ */

/* Thresholds of the steps, in 16ths: what is added before a channel is rounded down. Step 0 rounds to nearest. */
static const uint8_t thresholds[PH_DITHER_STEPS] = {8, 11, 13, 15, 1, 3, 5, 7};

static const struct {
    uint8_t from, top; /* bit of the channel in RGB565, and its largest value */
} channels[3] = {{11, 31}, {5, 63}, {0, 31}};

/* The colour, 0 .. 255 a channel, of which a ramp was made. False: no colour gives this ramp. Each entry leaves an
 * interval of colours, because a channel rises with the colour; what is left in the end is small, and its middle is
 * taken. */
static bool find_colour(const struct ph_material *material, uint32_t colour[3])
{
    uint32_t low[3] = {0, 0, 0}, high[3] = {255, 255, 255};
    struct ph_ramp_walk at = ph_ramp_begin(material->specular);
    for (; at.entry < PH_RAMP_SIZE; ph_ramp_next(&at)) {
        const uint32_t intensity = at.intensity, entry = ph_wire16(material->ramp[at.entry]);
        for (int k = 0; k < 3; k++) {
            const uint32_t top = channels[k].top, value = entry >> channels[k].from & top;
            while (low[k] <= high[k] && ph_ramp_channel(low[k], intensity, top, PH_RAMP_NEAREST) < value) {
                low[k]++;
            }
            while (low[k] <= high[k] && ph_ramp_channel(high[k], intensity, top, PH_RAMP_NEAREST) > value) {
                high[k]--; /* above low, so not below 0: at 0 a channel is the least that it can be */
            }
            if (low[k] > high[k] || ph_ramp_channel(low[k], intensity, top, PH_RAMP_NEAREST) != value) {
                return false;
            }
            colour[k] = (low[k] + high[k]) / 2;
        }
    }
    return true;
}

/* Makes the ramps of all steps. One that ph_material_ramp has not made stays as it is in each of them. */
static void make_ramps(struct ph_dithered_ramp *to, const struct ph_material *material)
{
    uint32_t colour[3] = {0, 0, 0};
    const bool found = find_colour(material, colour);
    to->ramp = material->ramp;
    for (struct ph_ramp_walk at = ph_ramp_begin(material->specular); at.entry < PH_RAMP_SIZE; ph_ramp_next(&at)) {
        to->colours[at.entry] = material->ramp[at.entry];
        for (uint32_t step = 1; step < PH_DITHER_STEPS; step++) {
            to->colours[step * PH_RAMP_SIZE + at.entry] =
                found ? ph_ramp_colour(colour, at.intensity, PH_RAMP_NEAREST / 8 * thresholds[step])
                      : material->ramp[at.entry];
        }
    }
}

/* Whether a ramp still has the colours that it had. */
static bool is_as_it_was(const uint16_t *colours, const uint16_t *ramp)
{
    uint32_t i = 0;
    while (i < PH_RAMP_SIZE && colours[i] == ramp[i]) {
        i++;
    }
    return i == PH_RAMP_SIZE;
}

/* The dithered ramp of a material, which is made if there is none; NULL: there is no room. One that this frame has not
 * had yet gives its room. */
static const uint16_t *ramps_of(struct ph_dither *d, const struct ph_material *material)
{
    struct ph_dithered_ramp *room = NULL;
    for (uint32_t i = 0; i < d->ramp_max; i++) {
        struct ph_dithered_ramp *const at = &d->ramps[i];
        if (at->ramp == material->ramp && is_as_it_was(at->colours, material->ramp)) {
            at->frame = d->frame;
            return at->colours;
        }
        room = at->frame != d->frame && (room == NULL || at->ramp == material->ramp) ? at : room;
    }
    if (room != NULL) {
        make_ramps(room, material);
        room->frame = d->frame;
    }
    return room != NULL ? room->colours : NULL;
}

/* Gives the materials of a frame's list the shading and the ramps of dithered light. */
static void take_materials(const struct ph_renderer *r, struct ph_dither *d)
{
    d->frame++;
    d->left_out = 0;
    for (uint32_t place = r->list.first; place != PH_NONE;) {
        const struct ph_draw *const draw = ph_at(r, place);
        struct ph_material *const material = (struct ph_material *)(uintptr_t)draw->material; /* the list's copy */
        place = draw->next;
        if (material->shading == PH_SHADE_GOURAUD && material->ramp != NULL) {
            const uint16_t *const ramps = ramps_of(d, material);
            d->left_out += ramps == NULL;
            material->shading = ramps != NULL ? &shading : material->shading;
            material->ramp = ramps != NULL ? ramps : material->ramp;
        }
    }
}

/* ---- bands ------------------------------------------------------------------------------------------------------ */

/* See bands_loop.h. A triangle that is drawn here needs no kind. */
static inline enum ph_fast_draw draw_fast(const struct ph_feed *f, const struct ph_ref *ref, struct ph_triangle *t,
                                          const struct ph_band *rows, uint32_t *fragments)
{
    const struct ph_setting *const s = &f->setting;
    if (s->antialiasing == NULL) {
        ph_setup(s, ref, t);
        return PH_FAST_NOT;
    }
    const enum ph_small_setup done = s->is_fast ? ph_setup_fast(&s->fast, ref, t) : PH_SMALL_NO_ROW;
    if (done != PH_SMALL_SET) {
        ph_setup_general(s, ref, done, t);
        return PH_FAST_NOT;
    }
    dither_rows(&t->as.small.rows, t->y_top); /* t is of PH_KIND_SMALL: it has no knee */
    if (t->y_top >= rows->y0 && t->y_bottom <= rows->y1) {
        *fragments += ph_draw_whole(t, rows, ph_small_dithered);
        return PH_FAST_DRAWN;
    }
    make_dithered(t, 0);
    return t->y_top >= rows->y0 ? PH_FAST_ABOVE : PH_FAST_NOT;
}

/* Whether a triangle is one in dithered light whose depth is a plane of codes without a knee. */
static inline bool is_plain(const struct ph_triangle *t)
{
    return t->kind == PH_KIND_SMALL_OWN && t->as.small.of.own.draw == draw_small && t->block == PH_BLOCK_NONE &&
           t->as.small.rows.knee == 0;
}

/* See bands_loop.h. */
static inline uint32_t draw_above(struct ph_triangle *t, const struct ph_band *band, enum ph_fast_draw known)
{
    return known == PH_FAST_ABOVE || (is_plain(t) && t->y_top >= band->y0)
               ? ph_draw_above_with(t, band, ph_small_dithered)
               : ph_draw_above(t, band);
}

/* See bands_loop.h. One that was stepped down to the band stands at its first row. */
static inline uint32_t draw_end(const struct ph_triangle *t, const struct ph_band *band)
{
    return is_plain(t) && t->y_top == band->y0
               ? ph_small_dithered(&t->as.small.rows, band->depth, band->pixels, 2 * (uint32_t)band->stride)
               : ph_draw_end(t, band);
}

static const struct ph_fast_draws fast = {.draw_whole = draw_fast, .draw_above = draw_above, .draw_end = draw_end};

/* Draws the carried triangles that come before the next reference, as in bands.c. */
PH_TIER(scenery)
static PH_NOINLINE uint32_t draw_begun(struct ph_feed *f, struct ph_rest *rest) /* called as draw_begun */
{
    return ph_begun_loop(f, rest, &fast);
}

/* Draws the triangles of a band that are left, as in bands.c. */
PH_TIER(mesh) static FX_APART void draw_rest(struct ph_feed *f, struct ph_rest *rest) /* called as draw_rest */
{
    ph_rest_loop(f, rest, draw_begun, &fast);
}

static void draw_band(struct ph_feed *f, struct ph_band *rows, uint16_t *pixels)
{
    if (f->band == 0 && rows->ways->walk == NULL) { /* no depth of 24 bits, nor linear-w */
        take_materials(f->r, (struct ph_dither *)(uintptr_t)f->r->config.antialiasing);
    }
    rows->pixels = pixels;
    ph_rows_loop(f, rows, draw_rest);
}

static const struct ph_antialiasing dithering = {.draw_samples = draw_band, .prepare = prepare, .set_kind = set_kind};

int ph_dither(struct ph_renderer *r, struct ph_dither *dither) /* called as set_dither */
{
    if (r == NULL || r->samples_log2 != 0 || (dither != NULL && dither->ramps == NULL)) {
        return PH_ERR_INVAL;
    }
    r->config.antialiasing = NULL;
    if (dither != NULL) {
        for (uint32_t i = 0; i < dither->ramp_max; i++) {
            dither->ramps[i].frame = 0;
        }
        __builtin_memcpy(dither->calls, &dithering, sizeof(dithering)); /* string.h is not everywhere */
        r->config.antialiasing = (const struct ph_antialiasing *)(const void *)dither;
    }
    return PH_OK;
}
