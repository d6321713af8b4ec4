/* Longest plateaus and inversions: see lab_search.h. */
#include "lab_search.h"

struct plateau {
    fx_t first, last;
};

/* The last distance up to high that has this code; low has it. Codes of a monotone format never rise. */
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
 * The plateau of a monotone format on which w lies. The codes never rise, so "still the same code" is true up to the
 * plateau's end and false behind it: bisection finds the end.
 */
static struct plateau plateau_at(struct lab_probe *p, fx_t w)
{
    const uint32_t code = lab_code(p, w);
    struct plateau found = {p->near_z, w};
    for (fx_t high = w; found.first < high;) { /* first: the smallest distance with this code */
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

/* The longest of a few plateaus that are spread over the range. */
static uint32_t some_plateau(struct lab_probe *p)
{
    const uint32_t count = 64, depth = (uint32_t)(p->far_z - p->near_z);
    uint32_t best = 0;
    for (uint32_t i = 0; i <= count; i++) {
        best = larger(best, length_of(plateau_at(p, p->far_z - (fx_t)(depth / count * i))));
    }
    return best;
}

/* The last distance that has the code of w; it looks near w first. */
static fx_t last_behind(struct lab_probe *p, uint32_t code, fx_t w)
{
    uint32_t stride = 1;
    for (; (uint32_t)(p->far_z - w) >= stride && lab_code(p, w + (fx_t)stride) == code; stride *= 2) {
        w += (fx_t)stride;
    }
    return last_with(p, code, w, (uint32_t)(p->far_z - w) < stride ? p->far_z : w + (fx_t)(stride - 1));
}

/* No plateau of log that begins before w is longer than this: w ln(f / n) / S rounded up, plus one. */
static uint32_t longest_of_log(const struct lab_probe *p, fx_t w)
{
    const uint64_t range = (p->log_range >> 29) + 1;                    /* log2(f / n) in 2^-27, below 2^32 */
    const uint64_t natural = ((uint64_t)w * range >> 27) * 45427 >> 16; /* times ln 2 */
    return (uint32_t)(natural / p->largest) + 2;
}

/*
 * Goes from far to near in steps of half the longest plateau so far (rounded up), so that two neighbouring steps hit
 * every longer one. If two steps hit a plateau its end is searched: if the distance `best` before the end is no longer
 * on it, the next step is from there. some_plateau() makes the steps long from the beginning.
 */
static uint32_t longest_plateau(struct lab_probe *p)
{
    uint32_t best = some_plateau(p), before = lab_code(p, p->far_z);
    for (fx_t w = p->far_z; w > p->near_z;) {
        const fx_t behind = w;
        if (p->format->kind == LAB_LOG && longest_of_log(p, w) <= best) {
            return best;
        }
        const uint32_t left = (uint32_t)(w - p->near_z), step = (best + 1) / 2;
        w -= (fx_t)(step < left ? step : left);
        uint32_t code = lab_code(p, w);
        if (code == before) {
            const fx_t last = last_behind(p, code, behind);
            if ((uint32_t)(last - p->near_z) < best) {
                return best;
            }
            w = last - (fx_t)best;
            code = lab_code(p, w);
        }
        if (code == before) {
            const struct plateau found = plateau_at(p, w);
            best = length_of(found);
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

/* The last distance of a block that begins at `first`. */
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

/* The distances of a block, or those of them between two bounds. */
struct span {
    fx_t first, last;
};

static uint32_t part_size(struct span span)
{
    return (uint32_t)(span.last - span.first) / LAB_PARTS + 1;
}

static fx_t part_end(struct span span, uint32_t part)
{
    const uint32_t offset = (part + 1) * part_size(span) - 1, last = (uint32_t)(span.last - span.first);
    return span.first + (fx_t)(offset < last ? offset : last);
}

/* For each part of `to`: the largest code from that part on. */
static void read_suffix(struct lab_search *s, struct lab_probe *p, struct span to)
{
    uint32_t most = 0, size = part_size(to);
    for (fx_t w = to.last; w >= to.first; w--) {
        most = larger(most, lab_code(p, w));
        s->suffix[(uint32_t)(w - to.first) / size] = most;
    }
}

/* The last j in part `part` of `to` whose code is not below `code`; the distance before the part if there is none. */
static fx_t last_above(struct lab_probe *p, struct span to, uint32_t part, uint32_t code)
{
    const fx_t first = to.first + (fx_t)(part * part_size(to));
    fx_t w = part_end(to, part);
    while (w >= first && lab_code(p, w) < code) {
        w--;
    }
    return w;
}

/*
 * The largest j - i > best that is ordered wrongly, with i in `from` and j in `to`, or best. An i can only improve on
 * those before it if its code is below all of theirs, and then its j is not before theirs.
 */
static uint32_t refine(struct lab_search *s, struct lab_probe *p, struct span from, struct span to, uint32_t best)
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

/* A length that is certain from the blocks' extreme codes. With it longest_wrong() need not look into most blocks. */
static uint32_t surely_wrong(const struct lab_search *s, const struct lab_probe *p, struct span i, fx_t j_min)
{
    const uint32_t blocks = block_count(s, p);
    uint32_t best = 0;
    for (uint32_t a = 0; a < blocks; a++) {
        const fx_t a_first = start_of(s, p, a), a_last = end_of(p, a_first, s->size);
        for (uint32_t b = blocks; a_first >= i.first && a_last <= i.last && b-- > a + 1;) {
            const fx_t b_first = start_of(s, p, b);
            if (b_first < j_min || (uint32_t)(b_first - a_last) <= best) {
                break;
            }
            if (s->most[b] >= s->least[a]) {
                best = (uint32_t)(b_first - a_last);
            }
        }
    }
    return best;
}

/* The largest j - i that is ordered wrongly, for j from j_min on. */
static uint32_t longest_wrong(struct lab_search *s, struct lab_probe *p, struct span i, fx_t j_min)
{
    const uint32_t blocks = block_count(s, p);
    uint32_t best = surely_wrong(s, p, i, j_min);
    for (uint32_t a = blocks; a-- > 0;) { /* from far, where the longest are; then the others end soon */
        const fx_t first = start_of(s, p, a), last = end_of(p, first, s->size);
        const struct span from = {first > i.first ? first : i.first, last < i.last ? last : i.last};
        for (uint32_t b = blocks; b-- > a && from.first <= from.last;) {
            const fx_t b_first = start_of(s, p, b), b_last = end_of(p, b_first, s->size);
            if (b_last < j_min || (uint32_t)(b_last - from.first) <= best) {
                break;
            }
            if (s->most[b] >= s->least[a]) {
                best = refine(s, p, from, (struct span){b_first > j_min ? b_first : j_min, b_last}, best);
            }
        }
    }
    return best;
}

uint32_t lab_search_at(struct lab_search *s, struct lab_probe *p, fx_t z)
{
    return lab_is_monotone(p->format) ? plateau_length(p, z) : longest_wrong(s, p, (struct span){p->near_z, z}, z) + 1;
}

uint32_t lab_search_worst(struct lab_search *s, struct lab_probe *p)
{
    return lab_is_monotone(p->format) ? longest_plateau(p)
                                      : longest_wrong(s, p, (struct span){p->near_z, p->far_z}, p->near_z) + 1;
}
