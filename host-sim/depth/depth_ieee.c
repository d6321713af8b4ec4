/* See depth_ieee.h. */
#include "depth_ieee.h"

#include <math.h>
#include <stdlib.h>

struct ieee {
    const char *name;
    bool infinite, reversed, gl, int24;
};

static const struct ieee formats[DEPTH_IEEE_FORMATS] = {
    {"ieee32-standard", false, false, false, false}, {"ieee32-infinite", true, false, false, false},
    {"ieee32-reversed", false, true, false, false},  {"ieee32-infinite-reversed", true, true, false, false},
    {"ieee32-gl", false, false, true, false},        {"ieee32-gl-infinite", true, false, true, false},
    {"int24-standard", false, false, false, true},   {"int24-infinite", true, false, false, true},
    {"int24-reversed", false, true, false, true},    {"int24-infinite-reversed", true, true, false, true},
    {"int24-gl", false, false, true, true},          {"int24-gl-infinite", true, false, true, true},
};

const char *depth_ieee_name(uint32_t format)
{
    return formats[format].name;
}

/* Scale and bias of z, so that d = (z scale + bias) / z; in double, for one rounding. */
static void constants(const struct ieee *p, double n, double f, float *scale, float *bias)
{
    double s = p->infinite ? 1 : f / (f - n), b = p->infinite ? -n : -f * n / (f - n);
    if (p->gl) {
        s = p->infinite ? 1 : (f + n) / (f - n);
        b = p->infinite ? -2 * n : -2 * f * n / (f - n);
    }
    if (p->reversed) {
        s = p->infinite ? 0 : -n / (f - n);
        b = -b;
    }
    *scale = (float)s;
    *bias = (float)b;
}

/* Goes through memory after each operation, so that the value is a float32 on any machine. */
static float rounded(float value)
{
    volatile float stored = value;
    return stored;
}

/* The 24-bit code nearest to d in 0 .. 1: in double, which holds each step exactly. A float32 above 2^23 has no half.
 */
static float int24_of(float d)
{
    return (float)floor((double)d * 16777215 + 0.5);
}

/* Converts clip z and w to the number that is stored and compared; larger is farther. */
static float stored_of(const struct ieee *p, float z, float w)
{
    float d = rounded(z / w);
    if (p->gl) {
        d = rounded(rounded(d * 0.5f) + 0.5f);
    }
    if (p->int24) {
        d = int24_of(d);
    }
    return p->reversed ? -d : d;
}

static float depth_of(const struct ieee *p, float z, float scale, float bias)
{
    return stored_of(p, rounded(rounded(z * scale) + bias), z);
}

static float distance_of(double n, double f, uint8_t spacing, uint32_t i, uint32_t count)
{
    const float near_z = (float)n, far_z = (float)f;
    if (spacing == LAB_LOG_SPACED) {
        return (float)(n * pow(f / n, (double)i / count));
    }
    return rounded(near_z + rounded(rounded(far_z - near_z) * rounded((float)i / (float)count)));
}

/* The largest z[j] - z[i], i < j, that is not ordered: d[j] <= d[i]. most: the largest d so far, least: from there on.
 */
static double widest(const float *z, const float *most, const float *least, uint32_t count)
{
    double best = 0;
    for (uint32_t i = 0, j = 0; j <= count; j++) {
        while (i < j && most[i] < least[j]) {
            i++;
        }
        while (j < count && most[i] >= least[j + 1]) {
            j++;
        }
        const double apart = (double)z[j] - z[i];
        best = i < j && apart > best ? apart : best;
    }
    return best;
}

int depth_ieee_pairs(uint32_t format, double near_z, double far_z, uint8_t spacing, uint32_t count,
                     struct depth_ieee_count *out)
{
    const struct ieee *p = &formats[format];
    float *z = malloc(3 * sizeof *z * ((size_t)count + 1));
    if (z == NULL) {
        return PH_ERR_NOMEM;
    }
    float *most = z + count + 1, *least = most + count + 1, scale, bias;
    constants(p, near_z, far_z, &scale, &bias);
    *out = (struct depth_ieee_count){0, 0, 0};
    for (uint32_t i = 0; i <= count; i++) {
        z[i] = distance_of(near_z, far_z, spacing, i, count);
        const float d = depth_of(p, z[i], scale, bias);
        out->equal += i > 0 && d == least[i - 1];
        out->swap += i > 0 && d < least[i - 1];
        least[i] = d;
        most[i] = i > 0 && most[i - 1] > d ? most[i - 1] : d;
    }
    for (uint32_t i = count; i-- > 0;) {
        least[i] = least[i] > least[i + 1] ? least[i + 1] : least[i];
    }
    out->max_wrong = widest(z, most, least, count);
    free(z);
    return 0;
}

/* ---- with a view ------------------------------------------------------------------------------------------ */

/* View space to world: v -> v r + t, turned about x, then about y. */
struct view {
    double r[3][3], t[3];
};

static struct view reed_view(void)
{
    const double pitch = 0.474747, yaw = 1.23123123;
    const double sp = sin(pitch), cp = cos(pitch), sy = sin(yaw), cy = cos(yaw);
    return (struct view){{{cy, 0, sy}, {-sp * sy, cp, sp * cy}, {-cp * sy, -sp, cp * cy}},
                         {14.9914, 0.832148, 29.7142128}};
}

/* A random number in -1 .. 1, the same on every machine. */
static double next_signed(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 4503599627370496.0 - 1;
}

/* A point in float32, times a column of a matrix in float32; its fourth coordinate is 1. Summed in pairs, as vector
 * units do: one sum after the other would give z and w the same errors where the scale is 1. */
static float column_mul(const float point[3], const float column[4])
{
    const float xy = rounded(rounded(point[0] * column[0]) + rounded(point[1] * column[1]));
    return rounded(xy + rounded(rounded(point[2] * column[2]) + column[3]));
}

void depth_ieee_view_pairs(uint32_t format, double near_z, double far_z, uint32_t count, bool composed,
                           struct depth_ieee_count *out)
{
    const struct ieee *p = &formats[format];
    const struct view view = reed_view();
    const double half_y = tan(0.65), half_x = half_y * 16 / 9;
    float scale, bias, distance[4], clip[4]; /* columns: w, and z of view and projection in one */
    uint64_t random = 1;
    constants(p, near_z, far_z, &scale, &bias);
    distance[3] = (float)-(view.t[0] * view.r[2][0] + view.t[1] * view.r[2][1] + view.t[2] * view.r[2][2]);
    for (int i = 0; i < 3; i++) {
        distance[i] = (float)view.r[2][i];
        clip[i] = rounded(distance[i] * scale);
    }
    clip[3] = rounded(rounded(distance[3] * scale) + bias);
    *out = (struct depth_ieee_count){0, 0, 0};
    float before = 0;
    for (uint32_t i = 0; i <= count; i++) {
        const double z = near_z + (far_z - near_z) * i / count;
        const double at[3] = {next_signed(&random) * half_x * z, next_signed(&random) * half_y * z, z};
        float point[3];
        for (int k = 0; k < 3; k++) {
            point[k] = (float)(at[0] * view.r[0][k] + at[1] * view.r[1][k] + at[2] * view.r[2][k] + view.t[k]);
        }
        const float w = column_mul(point, distance);
        const float d = composed ? stored_of(p, column_mul(point, clip), w) : depth_of(p, w, scale, bias);
        out->equal += i > 0 && d == before;
        out->swap += i > 0 && d < before;
        before = d;
    }
}
