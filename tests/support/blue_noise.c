/* See blue_noise.h. Columns and rows wrap around; the filter is a Gaussian of 1.5 pixels, as the paper has it. */
#include "blue_noise.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { SIDE = 8, CELLS = SIDE * SIDE, FIRST = 8 };

static double weight(unsigned a, unsigned b)
{
    double square = 0;
    const unsigned apart[2] = {(a % SIDE - b % SIDE) % SIDE, (a / SIDE - b / SIDE) % SIDE};
    for (int i = 0; i < 2; i++) {
        const double d = fmin(apart[i], SIDE - apart[i]);
        square += d * d;
    }
    return exp(-square / (2 * 1.5 * 1.5));
}

/* The dot in the tightest cluster (set: true), or the empty cell in the largest void. Of equal ones the first. */
static unsigned extreme(const bool *dots, bool set)
{
    unsigned found = CELLS;
    double best = 0;
    for (unsigned i = 0; i < CELLS; i++) {
        double sum = 0;
        for (unsigned k = 0; k < CELLS; k++) {
            sum += dots[k] ? weight(i, k) : 0;
        }
        if (dots[i] == set && (found == CELLS || (set ? sum > best + 1e-9 : sum < best - 1e-9))) {
            found = i;
            best = sum;
        }
    }
    return found;
}

static void make(unsigned *ranks)
{
    static const unsigned start[FIRST] = {0, 1, 11, 22, 34, 47, 52, 29};
    bool dots[CELLS] = {false}, rest[CELLS];
    for (int i = 0; i < FIRST; i++) {
        dots[start[i]] = true;
    }
    for (unsigned from = 0, to = CELLS; from != to;) { /* the first dots move until they lie evenly */
        from = extreme(dots, true);
        dots[from] = false;
        to = extreme(dots, false);
        dots[to] = true;
    }
    memcpy(rest, dots, sizeof rest);
    for (unsigned rank = FIRST; rank-- > 0;) {
        const unsigned cell = extreme(rest, true);
        ranks[cell] = rank;
        rest[cell] = false;
    }
    for (unsigned rank = FIRST; rank < CELLS; rank++) {
        const unsigned cell = extreme(dots, false);
        ranks[cell] = rank;
        dots[cell] = true;
    }
}

unsigned blue_noise_rank(unsigned x, unsigned y)
{
    static unsigned ranks[CELLS];
    static bool made;
    if (!made) {
        make(ranks);
        made = true;
    }
    return ranks[y % SIDE * SIDE + x % SIDE];
}
