/*
 * matvec for ARMv6-M, where a product of 64 bits takes 17 instructions. Elements are split into three digits of 10
 * bits, so that products with positions below 16.0, and sums of three of them, fit 32 bits. For positions within a cube
 * of 1.0 each way two digits of 14 bits are enough. Each way is exact. See portable/matvec.h.
 */
#ifndef PH_MATVEC_H
#define PH_MATVEC_H

#include "transform.h"

#define PH_MATVEC_RANGE ((uint32_t)1 << 20)

struct ph_row {
    /* An element is low + 2^10 middle + 2^20 high; low, middle: -512 .. 511. The translation is whole + 2^-28 part. */
    int32_t low[3], part, middle[3], high[3], whole;
};

/* An element is low + 2^14 high, with low: -2^13 .. 2^13 - 1. */
struct ph_short_row {
    int32_t low[3], part, high[3], whole;
};

struct ph_matvec {
    uint32_t range;       /* three digits serve -range .. range: 2^20, or 0 if the translation is near its range */
    uint32_t short_range; /* two digits serve so far: 2^16, or 0 if the elements of a row are too large */
    struct ph_row row[3];
    struct ph_short_row short_row[3];
};

/* Splits a row into two digits: sums below 3 2^29 + 2^28, then below 2^31. Returns the sum of its magnitudes. */
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

static inline void ph_matvec_prepare(struct ph_matvec *matvec, const struct ph_clip_matrix *matrix)
{
    matvec->range = PH_MATVEC_RANGE;
    matvec->short_range = (uint32_t)1 << 16;
    for (int i = 0; i < 3; i++) {
        struct ph_row *row = &matvec->row[i];
        for (int j = 0; j < 3; j++) {
            const int32_t m = matrix->m[i][j], above = (m + 512) >> 10;
            row->low[j] = m - above * 1024;
            row->high[j] = (above + 512) >> 10;
            row->middle[j] = above - row->high[j] * 1024;
        }
        row->whole = (int32_t)(matrix->t[i] >> 28);
        row->part = (int32_t)(matrix->t[i] & ((1 << 28) - 1));
        if (fx_magnitude(row->whole) >> 30 != 0) {
            matvec->range = 0;
        }
        if (ph_short_row_of(&matvec->short_row[i], matrix->m[i], matrix->t[i]) >= ((uint32_t)1 << 29) - (1 << 17)) {
            matvec->short_range = 0;
        }
    }
}

/* Sums stay below 3 2^29 + 2^28: they fit, also with the carry of the digit below. */
PH_TIER(mesh) static inline int32_t ph_row_of_digits(const struct ph_row *row, int32_t x, int32_t y, int32_t z)
{
    int32_t sum = row->low[0] * x + row->low[1] * y + row->low[2] * z + row->part;
    sum = (sum >> 10) + row->middle[0] * x + row->middle[1] * y + row->middle[2] * z;
    sum = (sum >> 10) + row->high[0] * x + row->high[1] * y + row->high[2] * z;
    return (sum >> 8) + row->whole;
}

PH_TIER(mesh) static inline int32_t ph_row_of_two(const struct ph_short_row *row, int32_t x, int32_t y, int32_t z)
{
    int32_t sum = row->low[0] * x + row->low[1] * y + row->low[2] * z + row->part;
    sum = (sum >> 14) + row->high[0] * x + row->high[1] * y + row->high[2] * z;
    return (sum >> 14) + row->whole;
}

static inline bool ph_is_within(const struct fx_vec3 *p, uint32_t range)
{
    return (((uint32_t)p->x + range) | ((uint32_t)p->y + range) | ((uint32_t)p->z + range)) < 2 * range;
}

static inline bool ph_matvec_in_range(const struct ph_matvec *matvec, const struct fx_vec3 *p)
{
    return ph_is_within(p, matvec->range);
}

static inline struct fx_vec3 ph_matvec_near(const struct ph_matvec *matvec, const struct fx_vec3 *p)
{
    const int32_t x = p->x, y = p->y, z = p->z;
    if (ph_is_within(p, matvec->short_range)) {
        return (struct fx_vec3){ph_row_of_two(&matvec->short_row[0], x, y, z),
                                ph_row_of_two(&matvec->short_row[1], x, y, z),
                                ph_row_of_two(&matvec->short_row[2], x, y, z)};
    }
    return (struct fx_vec3){ph_row_of_digits(&matvec->row[0], x, y, z), ph_row_of_digits(&matvec->row[1], x, y, z),
                            ph_row_of_digits(&matvec->row[2], x, y, z)};
}

#endif
