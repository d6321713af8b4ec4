/* See small_texels.h. */
/* Kits on armv6m: -O2. */
#include "small_texels.h"

#include "texel_map.h"
#include "texel_mix.h"

/* u or v of a small triangle, n rows below the row from which they count. */
static inline void set_small_line(struct ph_texel_line *line, const struct ph_plane *linear,
                                  const struct ph_curve *curve, uint32_t n)
{
    const uint32_t rise = n * curve->yy;
    line->at = linear->base + n * (linear->gy + rise);
    line->step = linear->gx + n * curve->xy;
    line->at_dy = linear->gy + 2 * rise + curve->yy;
    line->step_dy = curve->xy;
    line->at_ddy = 2 * curve->yy;
    line->bend = curve->xx;
}

/* Columns of a tile are not negative: those of a small triangle count from so many further left. */
enum { MARGIN = PH_TILE / 2 };

/* Converts a line to the form that tiles use, which begins MARGIN columns further left. */
static struct ph_texel_way way_of(const struct ph_texel_line *line)
{
    return (struct ph_texel_way){.at = line->at - MARGIN * (line->step - MARGIN * line->bend),
                                 .step = line->step - 2 * MARGIN * line->bend,
                                 .bend = line->bend,
                                 .at_dy = line->at_dy - MARGIN * line->step_dy,
                                 .step_dy = line->step_dy,
                                 .at_ddy = line->at_ddy};
}

/* The row, below that from which u and v count, with which the rows of a triangle begin at row y. */
static inline uint32_t below_of(const struct ph_triangle *t, int32_t y)
{
    return (uint32_t)(y - t->y_top - t->as.small.of.map.y);
}

/* Sets u, v and the texture, which is a map of the material's; below: see below_of. */
static inline void begin_run(struct ph_texel_run *r, const struct ph_triangle *t, uint32_t below,
                             const struct ph_texture *texture)
{
    const struct ph_small_map *const map = &t->as.small.of.map;
    r->row.texels = texture->texels;
    r->row.u_mask = (1u << texture->log2_width) - 1;
    r->row.v_mask = ((1u << texture->log2_height) - 1) << texture->log2_width;
    r->x = (uint32_t)map->x;
    set_small_line(&r->u, &map->u, &map->u_curve, below);
    set_small_line(&r->v, &map->v, &map->v_curve, below);
}

/* Sets what rows that may leave a clamped texture need besides begin_run. */
static FX_APART void begin_clamped(struct ph_small_texels *s, const struct ph_triangle *t,
                                   const struct ph_texture *texture)
{
    s->kind.triangle = t;
    s->kind.fast = true;
    s->kind.depth24 = false; /* small triangles are none of 24 bits */
    ph_set_texel_kind(&s->kind, &s->rows, texture, &t->as.small.of.map.light);
    s->rows.columns = MARGIN + 1 + MARGIN; /* up to 32 px to either side of the first corner */
}

/* The light of a run's rows, which begin at row y. */
static inline void begin_light(struct ph_texel_run *r, const struct ph_triangle *t, int32_t y)
{
    const struct ph_small_triangle *const small = &t->as.small.rows;
    const struct ph_texel_light *const light = &t->as.small.of.map.light;
    const bool shaded = light->shaded;
    r->row.glight = shaded ? small->glight : 0;
    r->row.light_dy = shaded ? small->light_dy : 0;
    r->row.light = shaded ? small->light + r->x * r->row.glight + (uint32_t)(y - t->y_top) * r->row.light_dy
                          : (uint32_t)light->light << 24;
}

/* Moves u and v of a bilinear texel to its first corner. */
static FX_APART void begin_smooth(struct ph_texel_run *r, const struct ph_texture *texture)
{
    r->u.at -= (uint32_t)1 << 21;
    r->v.at -= (uint32_t)1 << (15 + ph_texel_row_up(texture));
}

/* Chooses what draws the rows, by light and filter. */
static inline void begin_kernels(struct ph_small_texels *s)
{
    const struct ph_texel_lighting *const lighting = s->kind.lighting;
    const bool lit_alone = s->kind.filter == NULL && lighting != NULL;
    s->run.draw_row = lit_alone ? lighting->draw_nearest : ph_row_kernel(s->kind.filter, lighting);
    s->run.draw_rows = lit_alone ? lighting->draw_rows : ph_texel_run_rows;
}

/* See small_texels.h. Light without a filter is the most frequent case that ph_texture_small cannot draw. */
PH_TIER(figure)
PH_NOINLINE
void ph_small_texels_begin(struct ph_small_texels *s, const struct ph_triangle *t, int32_t y, uint32_t stride_bytes)
{
    const struct ph_texture *texture = t->material->texture;
    const struct ph_small_map *const at = &t->as.small.of.map;
    struct ph_texture map;
    if (at->level != 0) {
        map = ph_levels_of(texture)->map_of(texture, at->level);
        texture = &map;
    }
    begin_run(&s->run, t, below_of(t, y), texture);
    s->run.row.stride_bytes = stride_bytes;
    s->fast = at->fast;
    s->kind.clamp = texture->wrap;
    if (s->fast) {
        return;
    }
    begin_light(&s->run, t, y);
    if (s->kind.clamp != 0) {
        begin_clamped(s, t, texture);
        return;
    }
    s->kind.lighting = ph_is_lit(&at->light) ? t->material->shading->texturing.lighting : NULL;
    s->kind.filter = texture->filter;
    begin_kernels(s);
    if (s->kind.filter != NULL) {
        begin_smooth(&s->run, texture);
    }
}

/* Draws a row whose light is not 0 .. 32 everywhere. */
static FX_APART void draw_beyond_light(const struct ph_small_texels *s, struct ph_texel_row *row)
{
    ph_draw_texel_row(&s->kind, row, row->light, s->run.row.glight);
    row->light_step = 4 * s->run.row.glight;
    row->level = 0;
}

/* Draws the rows of a run with light or a filter. Members that ph_texel_run_rows sets stay as they are. */
static inline __attribute__((always_inline)) uint32_t draw_lit_or_smooth(struct ph_small_texels *s)
{
    struct ph_texel_run *const run = &s->run;
    struct ph_texel_row row;
    uint32_t count = 0;
    row.gd = run->row.gd;
    row.u.bend = 4 * run->u.bend;
    row.v.bend = 4 * run->v.bend;
    row.u_mask = run->row.u_mask;
    row.v_mask = run->row.v_mask;
    row.texels = run->row.texels;
    row.light_step = 4 * run->row.glight;
    row.level = 0;
    do {
        while (run->row.rows > 0) {
            count += run->draw_rows(run, &row);
            if (row.level == UINT32_MAX) {
                draw_beyond_light(s, &row);
            }
        }
    } while (ph_texel_run_lower(run));
    return count;
}

/* Makes the column that lies so far left of column 0 column 0. */
static inline void move_left(struct ph_texel_rows *row, uint32_t columns)
{
    row->left += columns << 16;
    row->right += columns << 16;
    row->d -= columns * row->gd;
    row->light -= columns * row->glight;
    row->depth -= (int32_t)columns;
    row->pixels -= (int32_t)columns;
}

/* Draws the rows of a run that may leave a clamped texture. */
static FX_APART uint32_t draw_clamped(struct ph_small_texels *s)
{
    struct ph_texel_run *const run = &s->run;
    struct ph_tile_rows *const r = &s->rows;
    r->count = 0;
    r->u = way_of(&run->u);
    r->v = way_of(&run->v);
    do {
        const uint32_t rows = run->row.rows;
        r->row = run->row;
        move_left(&r->row, MARGIN);
        ph_draw_fast_rows(&s->kind, r);
        run->row = r->row;
        move_left(&run->row, 0u - MARGIN);
        for (uint32_t i = 0; i < rows; i++) {
            ph_texel_line_down(&run->u);
            ph_texel_line_down(&run->v);
        }
    } while (ph_texel_run_lower(run));
    return r->count;
}

PH_TIER(figure) static PH_NOINLINE uint32_t draw_general(struct ph_small_texels *s)
{
    return s->kind.clamp != 0 ? draw_clamped(s) : draw_lit_or_smooth(s);
}

PH_TIER(scenery) static uint32_t draw_run_of(struct ph_small_texels *s)
{
    return s->fast ? ph_texture_small(&s->run) : draw_general(s);
}

PH_TIER(mesh) uint32_t ph_draw_small_texels(const struct ph_triangle *t, const struct ph_band *band)
{
    const struct ph_small_triangle *const s = &t->as.small.rows;
    const int32_t y = t->y_top > band->y0 ? t->y_top : band->y0;
    const uint32_t above = (uint32_t)(y - t->y_top), rows = (uint32_t)(band->y1 - y),
                   x = (uint32_t)t->as.small.of.map.x;
    const uint32_t at = (uint32_t)(y - band->y0) * band->stride + x;
    struct ph_small_texels texels;
    struct ph_texel_run *const r = &texels.run;
    const bool fast = t->as.small.of.map.fast;
    if (fast) {
        begin_run(r, t, below_of(t, y), t->material->texture);
        r->row.stride_bytes = 2 * (uint32_t)band->stride;
    } else {
        ph_small_texels_begin(&texels, t, y, 2 * (uint32_t)band->stride);
    }
    r->row.left_dx = s->left_dx;
    r->row.right_dx = s->right_dx;
    r->row.left = s->left - (x << 16) + above * r->row.left_dx;
    r->row.right = s->right - (x << 16) + above * r->row.right_dx;
    r->lower_is_right = s->lower_is_right;
    r->lower_x = (uint32_t)s->lower.x - (x << 16);
    r->lower_dx = (uint32_t)s->lower.dx;
    r->lower_rows = s->lower_rows;
    r->row.rows = s->upper_rows - above;
    if ((int32_t)r->row.rows <= 0) { /* it begins below the upper rows */
        r->lower_x -= r->row.rows * r->lower_dx;
        r->lower_rows += r->row.rows;
        ph_texel_run_lower(r);
    }
    if (r->row.rows + r->lower_rows > rows) {
        r->row.rows = r->row.rows < rows ? r->row.rows : rows;
        r->lower_rows = rows - r->row.rows;
    }
    r->row.gd = s->gd;
    r->row.d_dy = s->d_dy;
    r->row.d = s->d + x * r->row.gd + above * r->row.d_dy;
    r->row.depth = (uint16_t *)band->depth + at;
    r->row.pixels = band->pixels + at;
    if (PH_TEXTURE_KNEE && t->kind == PH_KIND_SMALL_TEXTURE_KNEE) {
        return ph_texture_knee(r, s->knee);
    }
    return fast ? ph_texture_small(r) : draw_general(&texels);
}

PH_TIER(scenery)
uint32_t ph_small_texels_draw(struct ph_small_texels *s, const struct ph_small_triangle *small, uint16_t *depth,
                              uint16_t *pixels)
{
    struct ph_texel_run *const r = &s->run;
    r->row.left = small->left - (r->x << 16);
    r->row.right = small->right - (r->x << 16);
    r->row.d = small->d + r->x * small->gd;
    r->row.left_dx = small->left_dx;
    r->row.right_dx = small->right_dx;
    r->row.d_dy = small->d_dy;
    r->row.gd = small->gd;
    r->row.depth = depth + r->x;
    r->row.pixels = pixels + r->x;
    r->row.rows = small->upper_rows;
    r->lower_rows = small->lower_rows;
    r->lower_is_right = small->lower_is_right;
    r->lower_x = (uint32_t)small->lower.x - (r->x << 16);
    r->lower_dx = (uint32_t)small->lower.dx;
    return draw_run_of(s);
}

PH_TIER(seldom)
void ph_small_texels_piece(struct ph_small_texels *s, const struct ph_row_piece *piece, uint16_t *depth,
                           uint16_t *pixels)
{
    struct ph_texel_run *const r = &s->run;
    const uint32_t x = piece->x - r->x;
    const struct ph_texel_line u = r->u, v = r->v;
    const uint32_t light = r->row.light;
    r->row.left = x << 16;
    r->row.right = (x + piece->n) << 16;
    r->row.d = piece->d - x * piece->gd;
    r->row.gd = piece->gd;
    r->row.depth = depth + r->x;
    r->row.pixels = pixels + r->x;
    r->row.rows = 1;
    r->lower_rows = 0;
    draw_run_of(s);
    if (!piece->last) {
        r->u = u;
        r->v = v;
        r->row.light = light;
    }
}
