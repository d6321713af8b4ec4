/*
 * matvec: a point through all rows of a clip matrix. Each CPU's folder has a matvec.h with
 *
 *   ph_matvec_prepare(rows, matrix)   once a mesh; rows points at the matrix
 *   ph_matvec_in_range(rows, p)      whether p is near enough for what follows
 *   ph_matvec_near(rows, p)      exactly ph_matrix_mul(matrix, p) of such a point
 *   ph_matvec_mul(rows, p)     the same of any point
 *
 * This one is for CPUs on which a product of 64 bits costs little: with positions 2^4 times as large, the sum's high
 * word is the result.
 */
#ifndef PH_MATVEC_WIDE_H
#define PH_MATVEC_WIDE_H

#include "pipeline.h"

/* 2048.0: positions times 2^4 fit a word, and no result needs to be clamped, nor its sum. */
#define PH_MATVEC_REACH ((uint32_t)1 << 27)

struct ph_row {
    int64_t t; /* the translation's, times 2^4 */
    int32_t m[3], unused;
};

struct ph_matvec {
    const struct ph_clip_matrix *matrix;
    uint32_t reach; /* PH_MATVEC_REACH, or 0 where the translation is near the end of its range */
    struct ph_row row[3];
};

static inline void ph_matvec_prepare(struct ph_matvec *rows, const struct ph_clip_matrix *matrix)
{
    rows->matrix = matrix;
    rows->reach = PH_MATVEC_REACH;
    for (int i = 0; i < 3; i++) {
        struct ph_row *const row = &rows->row[i];
        row->t = (int64_t)((uint64_t)matrix->t[i] << 4);
        for (int j = 0; j < 3; j++) {
            row->m[j] = matrix->m[i][j];
        }
        row->unused = 0;
        if (fx_magnitude((int32_t)(matrix->t[i] >> 28)) >> 30 != 0) {
            rows->reach = 0;
        }
    }
}

static inline bool ph_matvec_in_range(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    const uint32_t reach = rows->reach;
    return (((uint32_t)p->x + reach) | ((uint32_t)p->y + reach) | ((uint32_t)p->z + reach)) < 2 * reach;
}

static inline int32_t ph_row_high(const struct ph_row *row, int32_t x16, int32_t y16, int32_t z16)
{
    const int64_t sum =
        row->t + fx_mul_wide(row->m[0], x16) + fx_mul_wide(row->m[1], y16) + fx_mul_wide(row->m[2], z16);
    return (int32_t)(sum >> 32);
}

static inline struct fx_vec3 ph_matvec_near(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    const int32_t x16 = p->x * 16, y16 = p->y * 16, z16 = p->z * 16;
    return (struct fx_vec3){ph_row_high(&rows->row[0], x16, y16, z16), ph_row_high(&rows->row[1], x16, y16, z16),
                            ph_row_high(&rows->row[2], x16, y16, z16)};
}

static inline struct fx_vec3 ph_matvec_mul(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    return ph_matvec_in_range(rows, p) ? ph_matvec_near(rows, p) : ph_matrix_mul(rows->matrix, p);
}

#endif
