/*
 * clip_rows: a point through all rows of a clip matrix. Each CPU's folder has a clip_rows.h with
 *
 *   ph_clip_rows_of(rows, matrix)   once a mesh; rows points at the matrix
 *   ph_clip_rows_times(rows, p)     exactly ph_matrix_times(matrix, p)
 *
 * This one is for CPUs on which a product of 64 bits costs little: with positions 2^4 times as large, the sum's high
 * word is the result.
 */
#ifndef PH_CLIP_ROWS_WIDE_H
#define PH_CLIP_ROWS_WIDE_H

#include "pipeline.h"

#define PH_CLIP_ROWS_REACH ((uint32_t)1 << 26) /* 1024.0: up to there no result needs to be clamped, nor its sum */

struct ph_clip_rows {
    const struct ph_clip_matrix *matrix;
    int64_t t[3];   /* the translation's, times 2^4 */
    uint32_t reach; /* PH_CLIP_ROWS_REACH, or 0 where the translation is near the end of its range */
};

static inline void ph_clip_rows_of(struct ph_clip_rows *rows, const struct ph_clip_matrix *matrix)
{
    rows->matrix = matrix;
    rows->reach = PH_CLIP_ROWS_REACH;
    for (int i = 0; i < 3; i++) {
        rows->t[i] = (int64_t)((uint64_t)matrix->t[i] << 4);
        if (fx_magnitude((int32_t)(matrix->t[i] >> 28)) >> 30 != 0) {
            rows->reach = 0;
        }
    }
}

static inline int32_t ph_row_high(const struct ph_clip_rows *rows, int row, int32_t x16, int32_t y16, int32_t z16)
{
    const int32_t *const m = rows->matrix->m[row];
    return (int32_t)((rows->t[row] + fx_mul_wide(m[0], x16) + fx_mul_wide(m[1], y16) + fx_mul_wide(m[2], z16)) >> 32);
}

static inline struct fx_vec3 ph_clip_rows_times(const struct ph_clip_rows *rows, const struct fx_vec3 *p)
{
    const uint32_t reach = rows->reach;
    if ((((uint32_t)p->x + reach) | ((uint32_t)p->y + reach) | ((uint32_t)p->z + reach)) >= 2 * reach) {
        return ph_matrix_times(rows->matrix, p);
    }
    const int32_t x16 = p->x * 16, y16 = p->y * 16, z16 = p->z * 16;
    return (struct fx_vec3){ph_row_high(rows, 0, x16, y16, z16), ph_row_high(rows, 1, x16, y16, z16),
                            ph_row_high(rows, 2, x16, y16, z16)};
}

#endif
