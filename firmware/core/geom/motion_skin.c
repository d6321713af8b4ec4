/*
 * Skins and morph targets: see motion.h. Products have 32 bits here, as a Cortex-M0+ makes no others, and no sum can
 * overflow: the bounds stand beside them. Sums are made in uint32_t, where what a caller breaks wraps.
 */
/* Kits on armv6m: -O2. */
#include "geom_sum.h"
#include "motion.h"
#include "tier.h"

#include <stddef.h>

void ph_skin_matrices(const struct ph_skin *skin, const struct ph_xform *places, struct ph_xform *matrices)
{
    for (uint32_t i = 0; i < skin->joint_count; i++) {
        const struct ph_xform *const joint = &places[skin->nodes[i]];
        matrices[i] = skin->inverse_bind ? ph_xform_mul_near(joint, &skin->inverse_bind[i]) : *joint;
    }
}

/* A row of a matrix in Q2.30, and its t in Q8.24. */
struct row {
    int32_t x, y, z, t;
};

/*
 * The weighted mean of row i of up to four matrices. Elements count in Q17.15 and are rounded down, by half an LSB in
 * the mean, which the sums begin with; weights in Q15 give Q2.30. t goes in two halves of 17 and 15 bits.
 */
static inline struct row mean_row(const struct ph_xform *matrices, const struct ph_influence *in, int i)
{
    uint32_t x = 1 << 14, y = 1 << 14, z = 1 << 14, high = 0, low = 0, sum = 0;
    for (int k = 0; k < 4 && sum < PH_INFLUENCE_ONE && in->weights[k] != 0; k++) {
        const uint32_t w = in->weights[k];
        const struct ph_xform *const m = &matrices[in->joints[k]];
        const int32_t t = (&m->t.x)[i];
        x += w * (uint32_t)(m->r[i][0] >> 15);
        y += w * (uint32_t)(m->r[i][1] >> 15);
        z += w * (uint32_t)(m->r[i][2] >> 15);
        high += w * (uint32_t)(t >> 15);    /* 2^15 2^16 */
        low += w * ((uint32_t)t & 0x7fffu); /* 2^15 2^15 */
        sum += w;
    }
    return (struct row){(int32_t)x, (int32_t)y, (int32_t)z, (int32_t)(high + (low >> 15))};
}

static inline struct row row_of(const struct ph_xform *m, int i)
{
    return (struct row){m->r[i][0], m->r[i][1], m->r[i][2], (&m->t.x)[i]};
}

/* A matrix as vertices need it: an element is high 2^18 + low 2^4 and less than 2^4; turn is for normals, Q2.14. */
struct mean {
    struct {
        int32_t high[3], low[3], turn[3], t; /* t: Q9.23 */
    } rows[3];
};

static void set_mean(struct mean *mean, const struct ph_xform *matrices, const struct ph_influence *in)
{
    const bool is_mean = in && in->weights[0] != PH_INFLUENCE_ONE;
    const struct ph_xform *const one = in && !is_mean ? &matrices[in->joints[0]] : matrices;
    for (int i = 0; i < 3; i++) {
        const struct row row = is_mean ? mean_row(matrices, in, i) : row_of(one, i);
        const int32_t elements[3] = {row.x, row.y, row.z};
        for (int k = 0; k < 3; k++) {
            mean->rows[i].high[k] = elements[k] >> 18;
            mean->rows[i].low[k] = elements[k] >> 4 & 0x3fff;
            mean->rows[i].turn[k] = elements[k] >> 16;
        }
        mean->rows[i].t = row.t >> 1;
    }
}

/*
 * Makes turn the cofactors of the matrix, which turn normals as it turns surfaces, by a common factor: negative ones
 * where the matrix mirrors, so that normals that look outwards do so then. Each column is
 * brought to 14 bits first, so that an axis which is short keeps its direction: column k of the cofactors, which is
 * the cross product of the other two, then counts 2^-down[k].
 */
static void set_cofactors(struct mean *mean)
{
    int32_t a[3][3];
    int down[3], least = 31;
    for (int k = 0; k < 3; k++) {
        uint32_t bits = 0;
        for (int i = 0; i < 3; i++) {
            a[i][k] = (int32_t)((uint32_t)mean->rows[i].high[k] << 14) + mean->rows[i].low[k];
            bits |= (uint32_t)(a[i][k] ^ a[i][k] >> 31);
        }
        down[k] = 18 - fx_clz32(bits);
        least = down[k] < least ? down[k] : least;
        for (int i = 0; i < 3; i++) {
            a[i][k] = down[k] < 0 ? a[i][k] * (1 << -down[k]) : a[i][k] >> down[k]; /* -2^14 .. 2^14 - 1 */
        }
    }
    int32_t size = 0; /* of the sign that the determinant has */
    for (int k = 0; k < 3; k++) {
        const int b = k < 2 ? k + 1 : 0, c = k > 0 ? k - 1 : 2;
        for (int i = 0; i < 3; i++) {
            const int m = i < 2 ? i + 1 : 0, n = i > 0 ? i - 1 : 2;
            const int32_t cross = a[m][b] * a[n][c] - a[m][c] * a[n][b]; /* -2^29 .. 2^29 */
            mean->rows[i].turn[k] = cross >> (down[k] - least < 16 ? 15 + down[k] - least : 31);
            size += k == 0 ? a[i][0] * (cross >> 15) : 0; /* 3 2^14 2^14 at most */
        }
    }
    for (int i = 0; i < 9 && size < 0; i++) { /* what looks outwards does so in the mirror image, too */
        mean->rows[i / 3].turn[i % 3] = -mean->rows[i / 3].turn[i % 3];
    }
}

/* Whether two vertices follow the same joints by the same shares. What does not count is not read: a word of a slow
 * flash takes longer than the rest of this. */
static bool is_same(const struct ph_influence *a, const struct ph_influence *b)
{
    uint32_t sum = 0;
    for (int k = 0; k < 4 && sum < PH_INFLUENCE_ONE; k++) {
        if (a->weights[k] != b->weights[k] || (a->weights[k] != 0 && a->joints[k] != b->joints[k])) {
            return false;
        }
        if (a->weights[k] == 0) {
            break;
        }
        sum += a->weights[k];
    }
    return true;
}

/* A position in Q16.16. high p is in 2^-12 LSB of p, |high p| <= 2^28, and low p in 2^-26 LSB, |low p| < 2^29.
 * down: from 2^-12 LSB of p to Q9.23. */
static void place(const struct mean *mean, const int16_t p[3], int down, struct fx_vec3 *to)
{
    const int32_t x = p[0], y = p[1], z = p[2];
    for (int i = 0; i < 3; i++) {
        const int32_t *const h = mean->rows[i].high, *const l = mean->rows[i].low;
        const int32_t high = h[0] * x + h[1] * y + h[2] * z, low = l[0] * x + l[1] * y + l[2] * z;
        (&to->x)[i] = (mean->rows[i].t + ((high + (low >> 14)) >> down) + 64) >> 7;
    }
}

/* A normal in Q4.28: 2^15 2^14 three times; one that is longer than 1 may wrap. */
static void turn(const struct mean *mean, const int16_t n[3], int32_t to[3])
{
    for (int i = 0; i < 3; i++) {
        const int32_t *const r = mean->rows[i].turn;
        to[i] = (int32_t)((uint32_t)(r[0] * n[0]) + (uint32_t)(r[1] * n[1]) + (uint32_t)(r[2] * n[2]));
    }
}

/* Length one in Q1.14. The components are brought to 14 bits. */
static void normalise(const int32_t v[3], int16_t out[3])
{
    const uint32_t bits = (uint32_t)((v[0] ^ v[0] >> 31) | (v[1] ^ v[1] >> 31) | (v[2] ^ v[2] >> 31));
    const int zeros = fx_clz32(bits), down = zeros < 18 ? 18 - zeros : 0;
    const int32_t x = v[0] >> down, y = v[1] >> down, z = v[2] >> down; /* -2^14 .. 2^14 - 1 */
    const uint32_t sum = (uint32_t)(x * x) + (uint32_t)(y * y) + (uint32_t)(z * z);
    if (sum == 0) {
        out[0] = out[1] = out[2] = 0;
        return;
    }
    const int even = fx_clz32(sum) & ~1, shift = 17 - even / 2; /* of an even number of bits the root has half */
    const int32_t over = (int32_t)fx_rsqrt16(sum << even);      /* 2^31 / root */
    const int32_t half = 1 << (shift - 1);
    out[0] = (int16_t)((x * over + half) >> shift);
    out[1] = (int16_t)((y * over + half) >> shift);
    out[2] = (int16_t)((z * over + half) >> shift);
}

/* Neighbours in a mesh often follow the same joints by the same shares. */
PH_TIER(figure)
void ph_skin_vertices(const struct ph_bound *from, const struct ph_xform *matrices, struct fx_vec3 *positions,
                      int16_t (*normals)[3])
{
    const struct ph_influence *const in = from->influences, *last = NULL;
    const bool lit = normals && from->normals;
    struct mean mean;
    for (uint32_t v = 0; v < from->vertex_count; v++) {
        if (v == 0 || (last && !is_same(&in[v], last))) {
            last = in ? &in[v] : NULL;
            set_mean(&mean, matrices, last);
            if (lit && from->scales_axes) {
                set_cofactors(&mean);
            }
        }
        place(&mean, from->positions[v], from->frac - 11, &positions[v]);
        if (lit) {
            int32_t n[3];
            turn(&mean, from->normals[v], n);
            normalise(n, normals[v]);
        }
    }
}

/* ---- morph targets ---------------------------------------------------------------------------------------------- */

static int16_t clamp16(int32_t v)
{
    return (int16_t)(v < INT16_MIN ? INT16_MIN : v > INT16_MAX ? INT16_MAX : v);
}

/* A weight in Q3.12, at most 2^15. */
static int32_t weight_q12(int32_t weight)
{
    const int32_t w = (weight >> 12) + (weight >> 11 & 1);
    return w < -(1 << 15) ? -(1 << 15) : w > 1 << 15 ? 1 << 15 : w;
}

/* Sums are in 2^-4 of an LSB: at most 2^22 for a target. */
static void morph(const int16_t (*base)[3], const int16_t (*d)[3], const struct ph_morph *m, const int32_t *weights,
                  int16_t (*out)[3])
{
    for (uint32_t i = 0; i < 3 * m->vertex_count; i++) {
        int32_t sum = 8;
        for (uint32_t k = 0; d && k < m->target_count; k++) {
            sum += (weight_q12(weights[k]) * (&d[0][0])[3 * k * m->vertex_count + i]) >> 8;
        }
        (&out[0][0])[i] = clamp16((&base[0][0])[i] + (sum >> 4));
    }
}

void ph_morph_vertices(const struct ph_morph *m, const int32_t *weights, int16_t (*positions)[3], int16_t (*normals)[3])
{
    morph(m->positions, m->d_positions, m, weights, positions);
    if (m->normals && normals) {
        morph(m->normals, m->d_normals, m, weights, normals);
    }
}
