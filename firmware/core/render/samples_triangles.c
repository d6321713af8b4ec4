/* Triangles and lines of samples. See samples.h. */
/* Kits on armv6m: -O2. */
#include "samples.h"

#include "band_rest.h"
#include "edge.h"
#include "kernels.h"
#include "line.h"
#include "raster_rows.h"
#include "setup.h"

/* Lets ph_setup_fast take longer sides where pixels are samples, if the picture is large enough. */
PH_TIER(seldom) static void prepare(struct ph_setting *s)
{
    struct ph_fast *const fast = &s->fast;
    const uint32_t more = PH_SIDE_SHORT - PH_SIDE_SMALL;
    if (s->source != PH_FROM_CORNERS && fast->inner_x > 2 * more && fast->inner_y > 2 * more) {
        fast->side += more;
        fast->margin += more;
        fast->inner_x -= 2 * more;
        fast->inner_y -= 2 * more;
    }
}

/* Whether a triangle has rows of more pixels than small ones. Rows are longest at one end of the upper ones, or where
 * the lower ones begin. */
static bool has_long_rows(const struct ph_small_triangle *small)
{
    const int32_t most = PH_SMALL_COLUMNS << 16;
    const uint32_t rows = small->upper_rows, first = small->right - small->left;
    const uint32_t last = first + (rows - 1) * (small->right_dx - small->left_dx), x = (uint32_t)small->lower.x;
    const uint32_t below =
        small->lower_is_right ? x - (small->left + rows * small->left_dx) : small->right + rows * small->right_dx - x;
    return (int32_t)first >= most || (int32_t)last >= most || (small->lower_rows > 0 && (int32_t)below >= most);
}

/* Draws a triangle that is small but for its long rows. */
static uint32_t draw_long(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_small_triangle r = t->as.small.rows;
    struct ph_place at = ph_cut_rows(t, band, &r);
    if (t->block != PH_BLOCK_NONE) {
        at.draw_gouraud = ph_long_gouraud;
        return band->ways->octaves->draw_rows_split(t, &r, &at, NULL);
    }
    return ph_long_gouraud(&r, at.depth, at.pixels, 2 * at.stride);
}

/* See struct ph_antialiasing. */
static void set_kind(struct ph_triangle *t, bool has_rows)
{
    if (has_rows || (t->kind == PH_KIND_SMALL && has_long_rows(&t->as.small.rows))) {
        t->kind = PH_KIND_SMALL_OWN;
        t->as.small.of.own.draw = draw_long;
    }
}

static void setup_sample_line(const struct ph_setting *s, const struct ph_ref *ref, struct ph_triangle *t)
{
    struct ph_vertex a = s->fast.base[ref->corner[0]], b = s->fast.base[ref->corner[1]];
    ph_line_of_samples(&a, &b, ref->corner[2]);
    s->r->lines->setup_line(s, &a, &b, t);
}

PH_TIER(seldom) static void draw_samples(struct ph_feed *f, struct ph_band *rows, uint16_t *pixels)
{
    struct ph_renderer *const r = f->r;
    struct ph_columns in;
    rows->pixels = r->config.samples;
    ph_samples_columns(r, f->band, &in);
    if (f->ref != PH_NONE || r->carried != NULL || r->after != NULL || r->points != NULL) {
        ph_samples_clear(rows, &in, r->background);
        ph_draw_rows(f, rows);
    } else {
        ph_clear_depth(rows); /* a blur reads it; nobody reads a sample */
    }
    ph_samples_resolve(rows, &in, r->background, pixels);
}

const struct ph_antialiasing ph_antialias_2x2 = {.draw_samples = draw_samples,
                                                 .prepare = prepare,
                                                 .set_kind = set_kind,
                                                 .excess_of = ph_excess_of,
                                                 .setup_sample_line = setup_sample_line};
