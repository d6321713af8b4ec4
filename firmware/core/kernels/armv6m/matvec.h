/*
 * matvec, ARMv6-M, where a product of 64 bits takes 17 instructions: elements as three digits of 10 bits, so that
 * products with positions below 16.0, and sums of three, fit 32 bits; and as two of 14 bits for positions within a cube
 * of 1.0 each way. Exact all the same. See matvec_wide.h.
 */
#ifndef PH_MATVEC_H
#define PH_MATVEC_H

#include "pipeline.h"

#define PH_MATVEC_REACH ((uint32_t)1 << 20)

struct ph_row {
    int32_t low[3], part, middle[3], high[3], whole;
    /* the element is low + 2^10 middle + 2^20 high; low, middle: -512 .. 511; the translation in 2^-28 and in ones */
};

/* The element is low + 2^14 high; low: -2^13 .. 2^13 - 1. */
struct ph_short_row {
    int32_t low[3], part, high[3], whole;
};

struct ph_matvec {
    const struct ph_clip_matrix *matrix;
    uint32_t reach; /* digits serve -reach .. reach: 2^20, or 0 where the translation is near the end of its range */
    uint32_t short_reach; /* the same of two digits: 2^16, or 0 where a row's elements are too large together */
    struct ph_short_row short_row[3];
    struct ph_row row[3];
};

/* Two digits of a row; sums below 3 2^29 + 2^28, then below 2^31. Returns what its elements make together. */
static inline uint32_t ph_short_row_of(struct ph_short_row *row, const int32_t m[3], int64_t t)
{
    uint32_t together = 0;
    for (int j = 0; j < 3; j++) {
        row->high[j] = (m[j] + (1 << 13)) >> 14;
        row->low[j] = m[j] - row->high[j] * (1 << 14);
        together += fx_magnitude(m[j]);
    }
    row->whole = (int32_t)(t >> 28);
    row->part = (int32_t)(t & ((1 << 28) - 1));
    return together;
}

static inline void ph_matvec_prepare(struct ph_matvec *rows, const struct ph_clip_matrix *matrix)
{
    rows->matrix = matrix;
    rows->reach = PH_MATVEC_REACH;
    rows->short_reach = (uint32_t)1 << 16;
    for (int i = 0; i < 3; i++) {
        struct ph_row *row = &rows->row[i];
        for (int j = 0; j < 3; j++) {
            const int32_t m = matrix->m[i][j], above = (m + 512) >> 10;
            row->low[j] = m - above * 1024;
            row->high[j] = (above + 512) >> 10;
            row->middle[j] = above - row->high[j] * 1024;
        }
        row->whole = (int32_t)(matrix->t[i] >> 28);
        row->part = (int32_t)(matrix->t[i] & ((1 << 28) - 1));
        if (fx_magnitude(row->whole) >> 30 != 0) {
            rows->reach = 0;
        }
        if (ph_short_row_of(&rows->short_row[i], matrix->m[i], matrix->t[i]) >= ((uint32_t)1 << 29) - (1 << 17)) {
            rows->short_reach = 0;
        }
    }
}

/* Sums below 3 2^29 + 2^28: they fit, also with what comes up from the digit below. */
static inline int32_t ph_row_of_digits(const struct ph_row *row, int32_t x, int32_t y, int32_t z)
{
    int32_t sum = row->low[0] * x + row->low[1] * y + row->low[2] * z + row->part;
    sum = (sum >> 10) + row->middle[0] * x + row->middle[1] * y + row->middle[2] * z;
    sum = (sum >> 10) + row->high[0] * x + row->high[1] * y + row->high[2] * z;
    return (sum >> 8) + row->whole;
}

static inline int32_t ph_row_of_two(const struct ph_short_row *row, int32_t x, int32_t y, int32_t z)
{
    int32_t sum = row->low[0] * x + row->low[1] * y + row->low[2] * z + row->part;
    sum = (sum >> 14) + row->high[0] * x + row->high[1] * y + row->high[2] * z;
    return (sum >> 14) + row->whole;
}

static inline bool ph_is_within(const struct fx_vec3 *p, uint32_t reach)
{
    return (((uint32_t)p->x + reach) | ((uint32_t)p->y + reach) | ((uint32_t)p->z + reach)) < 2 * reach;
}

static inline bool ph_matvec_in_range(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    return ph_is_within(p, rows->reach);
}

static inline struct fx_vec3 ph_matvec_near(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    const int32_t x = p->x, y = p->y, z = p->z;
    if (ph_is_within(p, rows->short_reach)) {
        return (struct fx_vec3){ph_row_of_two(&rows->short_row[0], x, y, z),
                                ph_row_of_two(&rows->short_row[1], x, y, z),
                                ph_row_of_two(&rows->short_row[2], x, y, z)};
    }
    return (struct fx_vec3){ph_row_of_digits(&rows->row[0], x, y, z), ph_row_of_digits(&rows->row[1], x, y, z),
                            ph_row_of_digits(&rows->row[2], x, y, z)};
}

static inline struct fx_vec3 ph_matvec_mul(const struct ph_matvec *rows, const struct fx_vec3 *p)
{
    return ph_matvec_in_range(rows, p) ? ph_matvec_near(rows, p) : ph_matrix_mul(rows->matrix, p);
}

#endif
