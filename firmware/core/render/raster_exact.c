/* Triangles whose depth takes 64 bits, drawn strip by strip, or pixel run by pixel run. See raster_exact.h, exact.h. */
/* Kits on armv6m: -O2. */
#include "raster_exact.h"

#include "edge.h"
#include "exact.h"
#include "raster_large.h"

/* Draws the rows of a strip one by one. */
PH_TIER(seldom)
static uint32_t draw_exact_rows(const struct ph_triangle *t, const struct ph_band *band, const struct ph_band *rows,
                                struct ph_triangle *run)
{
    struct ph_half_rows in;
    uint32_t count = 0;
    const struct ph_band in_band = {.y0 = ph_max(rows->y0, band->y0), .y1 = ph_min(rows->y1, band->y1)};
    if (!ph_rows_of_half_apart(t, &in_band, rows->y0 >= t->as.large.y_mid, &in)) {
        return 0;
    }
    for (; in.y < in.y_end; in.y++) {
        int32_t x, to;
        for (ph_next_row(&in.left, &in.right, band->width, &x, &to); x < to;) {
            x += ph_exact_run(t, band->ways->exact, x, to, in.y, run);
            count += ph_draw_large(run, band);
        }
    }
    return count;
}

/* Draws a triangle whose depth takes 64 bits, strip by strip. Where strips begin does not depend on the band. */
PH_TIER(seldom) uint32_t ph_draw_exact(const struct ph_triangle *t, const struct ph_band *band)
{
    struct ph_triangle run = *t;
    struct ph_band rows = {.y0 = band->y0 & ~(PH_EXACT_ROWS - 1)};
    const int32_t y_mid = t->as.large.y_mid;
    uint32_t count = 0;
    for (rows.y0 = rows.y0 > t->y_top ? rows.y0 : t->y_top; rows.y0 < t->y_bottom && rows.y0 < band->y1;
         rows.y0 = rows.y1) {
        const int32_t half_end = rows.y0 < y_mid ? y_mid : t->y_bottom, end = (rows.y0 | (PH_EXACT_ROWS - 1)) + 1;
        struct ph_exact_strip strip = {.width = band->width, .ways = band->ways->exact};
        rows.y1 = end < half_end ? end : half_end;
        ph_rows_of_half_apart(t, &rows, rows.y0 >= y_mid, &strip.rows);
        count += ph_exact_rows(t, &strip, &run) ? ph_draw_large(&run, band) : draw_exact_rows(t, band, &rows, &run);
    }
    return count;
}
