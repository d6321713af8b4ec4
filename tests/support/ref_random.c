/* See ref_random.h. */
#include "ref_random.h"

#include <math.h>

static uint64_t state;

void ref_seed(uint64_t seed)
{
    state = seed;
}

/* Knuth's 64-bit linear congruence; its upper 53 bits. */
double ref_uniform(double low, double high)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.;
}

void ref_direction(double out[3])
{
    double square;
    do {
        for (int k = 0; k < 3; k++) {
            out[k] = ref_uniform(-1, 1);
        }
        square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
    } while (square < .01 || square > 1);
    for (int k = 0; k < 3; k++) {
        out[k] /= sqrt(square);
    }
}

void ref_rotation(double turn, double r[3][3])
{
    double axis[3], angle = ref_uniform(-turn, turn), c = cos(angle), s = sin(angle);
    ref_direction(axis);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            double turned = i == k ? c : ((k - i + 3) % 3 == 1 ? -1 : 1) * s * axis[3 - i - k];
            r[i][k] = turned + (1 - c) * axis[i] * axis[k];
        }
    }
}

int32_t ref_q16(double v)
{
    return (int32_t)lrint(v * 65536);
}

int32_t ref_q30(double v)
{
    return (int32_t)lrint(ldexp(v, 30));
}
