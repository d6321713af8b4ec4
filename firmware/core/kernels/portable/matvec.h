/*
 * matvec: the product of a clip matrix and a point. A CPU's folder may have a matvec.h that computes it faster there,
 * with the same functions:
 *
 *   ph_matvec_prepare(matvec, matrix)   once for each mesh
 *   ph_matvec_in_range(matvec, p)       whether the fast form is exact for p
 *   ph_matvec_near(matvec, p)           the fast form: exactly ph_matrix_mul(matrix, p), if p is in range
 *
 * This one is for CPUs on which a product of 64 bits costs little. Positions are taken 2^4 times as large, so that the
 * high word of the sum is the result.
 */
#ifndef PH_MATVEC_H
#define PH_MATVEC_H

#include "transform.h"

/* 2048.0: up to here positions times 2^4 fit a word, and neither results nor sums have to be clamped. */
#define PH_MATVEC_RANGE ((uint32_t)1 << 27)

struct ph_row {
    int64_t t; /* of the translation, times 2^4 */
    int32_t m[3], unused;
};

struct ph_matvec {
    uint32_t range; /* PH_MATVEC_RANGE, or 0 if the translation is near the end of its range */
    struct ph_row row[3];
};

static inline void ph_matvec_prepare(struct ph_matvec *matvec, const struct ph_clip_matrix *matrix)
{
    matvec->range = PH_MATVEC_RANGE;
    for (int i = 0; i < 3; i++) {
        struct ph_row *const row = &matvec->row[i];
        row->t = (int64_t)((uint64_t)matrix->t[i] << 4);
        for (int j = 0; j < 3; j++) {
            row->m[j] = matrix->m[i][j];
        }
        row->unused = 0;
        if (fx_magnitude((int32_t)(matrix->t[i] >> 28)) >> 30 != 0) {
            matvec->range = 0;
        }
    }
}

static inline bool ph_matvec_in_range(const struct ph_matvec *matvec, const struct fx_vec3 *p)
{
    const uint32_t range = matvec->range;
    return (((uint32_t)p->x + range) | ((uint32_t)p->y + range) | ((uint32_t)p->z + range)) < 2 * range;
}

static inline int32_t ph_row_high(const struct ph_row *row, int32_t x16, int32_t y16, int32_t z16)
{
    const int64_t sum =
        row->t + fx_mul_wide(row->m[0], x16) + fx_mul_wide(row->m[1], y16) + fx_mul_wide(row->m[2], z16);
    return (int32_t)(sum >> 32);
}

static inline struct fx_vec3 ph_matvec_near(const struct ph_matvec *matvec, const struct fx_vec3 *p)
{
    const int32_t x16 = p->x * 16, y16 = p->y * 16, z16 = p->z * 16;
    return (struct fx_vec3){ph_row_high(&matvec->row[0], x16, y16, z16), ph_row_high(&matvec->row[1], x16, y16, z16),
                            ph_row_high(&matvec->row[2], x16, y16, z16)};
}

#endif
