/* Longest plateaus and inversions: see lab_search.h. */
#include "lab_search.h"

struct plateau {
    fx_t first, last;
};

/* The last distance up to high that has this code, which low has: codes of a monotone format never rise. */
static fx_t last_with(struct lab_probe *p, uint32_t code, fx_t low, fx_t high)
{
    while (low < high) {
        const fx_t middle = high - (high - low) / 2;
        if (lab_code(p, middle) == code) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

/*
 * The plateau of a monotone format on which w lies. Its codes never rise, so that "still the same code" is true up to
 * its end and false behind it: bisection finds the end.
 */
static struct plateau plateau_at(struct lab_probe *p, fx_t w)
{
    const uint32_t code = lab_code(p, w);
    struct plateau found = {p->near_z, w};
    for (fx_t high = w; found.first < high;) { /* first: the smallest with this code */
        const fx_t middle = found.first + (high - found.first) / 2;
        if (lab_code(p, middle) == code) {
            high = middle;
        } else {
            found.first = middle + 1;
        }
    }
    found.last = last_with(p, code, w, p->far_z);
    return found;
}

static uint32_t length_of(struct plateau plateau)
{
    return (uint32_t)(plateau.last - plateau.first) + 1;
}

static uint32_t larger(uint32_t a, uint32_t b)
{
    return a > b ? a : b;
}

static uint32_t plateau_length(struct lab_probe *p, fx_t z)
{
    const struct plateau here = plateau_at(p, z);
    uint32_t length = length_of(here);
    if (here.last == p->far_z && here.first > p->near_z) {
        length = larger(length, length_of(plateau_at(p, here.first - 1)));
    }
    if (here.first == p->near_z && here.last < p->far_z) {
        length = larger(length, length_of(plateau_at(p, here.last + 1)));
    }
    return length;
}

/* The longest of a few plateaus spread over the range. */
static uint32_t some_plateau(struct lab_probe *p)
{
    const uint32_t count = 64, depth = (uint32_t)(p->far_z - p->near_z);
    uint32_t best = 0;
    for (uint32_t i = 0; i <= count; i++) {
        best = larger(best, length_of(plateau_at(p, p->far_z - (fx_t)(depth / count * i))));
    }
    return best;
}

/* Whether the plateau of w, which ends less than `step` behind it, may be longer than best. */
static bool may_be_longer(struct lab_probe *p, fx_t w, uint32_t code, uint32_t step, uint32_t best)
{
    const fx_t high = (uint32_t)(p->far_z - w) < step ? p->far_z : w + (fx_t)step;
    const fx_t last = last_with(p, code, w, high);
    return (uint32_t)(last - p->near_z) >= best && lab_code(p, last - (fx_t)best) == code;
}

/*
 * From far to near in steps of half the longest plateau so far (rounded up): a longer one has two neighbouring steps
 * on it. What some_plateau() finds makes the steps long from the beginning.
 */
static uint32_t longest_plateau(struct lab_probe *p)
{
    uint32_t best = some_plateau(p), before = lab_code(p, p->far_z), step = (best + 1) / 2;
    for (fx_t w = p->far_z; w > p->near_z;) {
        const uint32_t left = (uint32_t)(w - p->near_z);
        w -= (fx_t)(step < left ? step : left);
        const uint32_t code = lab_code(p, w);
        if (code == before && may_be_longer(p, w, code, 2 * step, best)) {
            const struct plateau found = plateau_at(p, w);
            best = larger(best, length_of(found));
            step = (best + 1) / 2;
            w = found.first;
        }
        before = code;
    }
    return best;
}

static fx_t start_of(const struct lab_search *s, const struct lab_probe *p, uint32_t block)
{
    return (fx_t)((uint32_t)p->near_z + block * s->size);
}

/* Last distance of a block of size LSBs from first on. */
static fx_t end_of(const struct lab_probe *p, fx_t first, uint32_t size)
{
    return (uint32_t)(p->far_z - first) < size ? p->far_z : (fx_t)((uint32_t)first + size - 1);
}

static uint32_t block_count(const struct lab_search *s, const struct lab_probe *p)
{
    return (uint32_t)(p->far_z - p->near_z) / s->size + 1;
}

void lab_search_open(struct lab_search *s, struct lab_probe *p)
{
    s->size = (uint32_t)(p->far_z - p->near_z) / LAB_BLOCKS + 1;
    if (lab_is_monotone(p->format)) {
        return;
    }
    for (uint32_t block = 0; block < block_count(s, p); block++) {
        const fx_t first = start_of(s, p, block), last = end_of(p, first, s->size);
        s->least[block] = UINT32_MAX;
        s->most[block] = 0;
        for (uint32_t w = (uint32_t)first; w <= (uint32_t)last; w++) { /* unsigned: last may be FX_MAX */
            const uint32_t code = lab_code(p, (fx_t)w);
            s->least[block] = code < s->least[block] ? code : s->least[block];
            s->most[block] = larger(s->most[block], code);
        }
    }
}

/* The distances of one block, or what is left of it between two bounds. */
struct reach {
    fx_t first, last;
};

static uint32_t part_size(struct reach reach)
{
    return (uint32_t)(reach.last - reach.first) / LAB_PARTS + 1;
}

static fx_t part_end(struct reach reach, uint32_t part)
{
    const uint32_t offset = (part + 1) * part_size(reach) - 1, last = (uint32_t)(reach.last - reach.first);
    return reach.first + (fx_t)(offset < last ? offset : last);
}

/* Largest code from each part of `to` on. */
static void read_suffix(struct lab_search *s, struct lab_probe *p, struct reach to)
{
    uint32_t most = 0, size = part_size(to);
    for (fx_t w = to.last; w >= to.first; w--) {
        most = larger(most, lab_code(p, w));
        s->suffix[(uint32_t)(w - to.first) / size] = most;
    }
}

/* Last j of part `part` of `to` whose code is not below code; before its first where there is none. */
static fx_t last_above(struct lab_probe *p, struct reach to, uint32_t part, uint32_t code)
{
    const fx_t first = to.first + (fx_t)(part * part_size(to));
    fx_t w = part_end(to, part);
    while (w >= first && lab_code(p, w) < code) {
        w--;
    }
    return w;
}

/*
 * The largest j - i > best with i in `from`, j in `to`, that is not ordered, or best. Only an i whose code is below all
 * before it can do better than these, and its j lies no further left than theirs.
 */
static uint32_t refine(struct lab_search *s, struct lab_probe *p, struct reach from, struct reach to, uint32_t best)
{
    const uint32_t last_part = (uint32_t)(to.last - to.first) / part_size(to);
    uint32_t least = UINT32_MAX, part = 0;
    read_suffix(s, p, to);
    for (uint32_t w = (uint32_t)from.first; w <= (uint32_t)from.last; w++) {
        const fx_t i = (fx_t)w;
        const uint32_t code = lab_code(p, i);
        if (code >= least || s->suffix[0] < code) {
            continue;
        }
        least = code;
        while (part < last_part && s->suffix[part + 1] >= code) {
            part++;
        }
        const fx_t end = part_end(to, part);
        if (end > i && (uint32_t)(end - i) > best) {
            const fx_t j = last_above(p, to, part, code);
            best = j > i ? larger(best, (uint32_t)(j - i)) : best;
        }
    }
    return best;
}

static fx_t lesser_fx(fx_t a, fx_t b)
{
    return a < b ? a : b;
}

/* The largest j - i that is not ordered, i up to i_max, j from j_min on. */
static uint32_t longest_wrong(struct lab_search *s, struct lab_probe *p, fx_t i_max, fx_t j_min)
{
    const uint32_t blocks = block_count(s, p);
    uint32_t best = 0;
    for (uint32_t a = blocks; a-- > 0;) { /* from far, where the longest are: then the others end soon */
        const fx_t a_first = start_of(s, p, a);
        const struct reach from = {a_first, lesser_fx(end_of(p, a_first, s->size), i_max)};
        for (uint32_t b = blocks; b-- > a && a_first <= i_max;) {
            const fx_t b_first = start_of(s, p, b), b_last = end_of(p, b_first, s->size);
            if (b_last < j_min || (uint32_t)(b_last - a_first) <= best) {
                break;
            }
            if (s->most[b] >= s->least[a]) {
                best = refine(s, p, from, (struct reach){b_first > j_min ? b_first : j_min, b_last}, best);
            }
        }
    }
    return best;
}

uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z)
{
    return lab_is_monotone(p->format) ? plateau_length(p, z) : longest_wrong(s, p, z, z) + 1;
}

uint32_t lab_search_worst(struct lab_search *s, struct lab_probe *p)
{
    return lab_is_monotone(p->format) ? longest_plateau(p) : longest_wrong(s, p, p->far_z, p->near_z) + 1;
}
