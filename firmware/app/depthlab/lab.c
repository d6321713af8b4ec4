/* Adjacent pairs and smallest separations as CSV: see lab.h. */
#include "lab.h"
#include "lab_num.h"
#include "lab_search.h"

/* The state of a measurement, which lies in the caller's memory. */
struct work {
    struct lab_probe probe;
    struct lab_search search;
    uint32_t codes[]; /* pairs: two for each distance */
};

size_t lab_bytes(const struct lab *lab)
{
    return sizeof(struct work) + 2 * sizeof(uint32_t) * ((size_t)lab->count + 1);
}

static int open_lab(const struct lab *lab)
{
    const bool possible = lab->near_z > 0 && lab->near_z < lab->far_z && lab->count >= 1 && lab->count <= LAB_COUNT_MAX;
    return !possible ? PH_ERR_INVAL : lab->memory_bytes < lab_bytes(lab) ? PH_ERR_NOMEM : PH_OK;
}

static void put_field(const struct lab *lab, const char *text)
{
    lab->put(lab->context, ",");
    lab->put(lab->context, text);
}

static void put_u32(const struct lab *lab, uint32_t v)
{
    char text[LAB_TEXT_SIZE];
    lab_u32_text(v, text);
    put_field(lab, text);
}

static void put_fx(const struct lab *lab, fx_t v)
{
    char text[LAB_TEXT_SIZE];
    lab_fx_text(v, text);
    put_field(lab, text);
}

static void put_num(const struct lab *lab, struct lab_num v)
{
    char text[LAB_TEXT_SIZE];
    lab_num_text(v, text);
    put_field(lab, text);
}

static void put_length(const struct lab *lab, uint32_t lsbs)
{
    char text[LAB_TEXT_SIZE];
    lab_length_text(lsbs, text);
    put_field(lab, text);
}

/* Writes the columns format,bits,near,far of a row. */
static void put_head(const struct lab *lab, const struct lab_format *format)
{
    lab->put(lab->context, format->name);
    put_u32(lab, format->bits);
    put_fx(lab, lab->near_z);
    put_fx(lab, lab->far_z);
}

/* ---- pairs ---------------------------------------------------------------------------------------------- */

/* Distance i of 0 .. count. Linear: rounded to the nearest LSB; log: the smallest that is not below the ideal one. */
static fx_t distance_of(const struct lab *lab, uint32_t i)
{
    const int64_t depth = (int64_t)lab->far_z - lab->near_z, n = lab->count;
    if (lab->spacing == LAB_LINEAR_SPACED) {
        return (fx_t)(lab->near_z + (depth * i + n / 2) / n);
    }
    const uint64_t near_log = lab_log2_q56((uint32_t)lab->near_z);
    const uint64_t range = lab_log2_q56((uint32_t)lab->far_z) - near_log;
    const uint64_t log = near_log + range / lab->count * i + range % lab->count * i / lab->count;
    fx_t low = lab->near_z;
    for (fx_t high = lab->far_z; low < high;) {
        const fx_t middle = low + (high - low) / 2;
        if (lab_log2_q56((uint32_t)middle) >= log) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/*
 * The largest distance that is ordered wrongly, in LSBs, over all i < j with most[j] >= least[i]. least[i] is the least
 * code up to distance i, most[j] the largest from distance j on.
 */
static uint32_t widest(const struct lab *lab, const uint32_t *least, const uint32_t *most)
{
    uint32_t best = 0;
    for (uint32_t i = 0, j = 0; j <= lab->count && i <= lab->count; i++) {
        const uint32_t before = j;
        while (j <= lab->count && most[j] >= least[i]) {
            j++;
        }
        if (j > before && j - 1 > i) {
            const uint32_t apart = (uint32_t)(distance_of(lab, j - 1) - distance_of(lab, i));
            best = apart > best ? apart : best;
        }
    }
    return best;
}

static void pairs_row(const struct lab *lab, struct work *work)
{
    uint32_t *least = work->codes, *most = work->codes + lab->count + 1, equal = 0, swap = 0;
    for (uint32_t i = 0; i <= lab->count; i++) {
        const uint32_t code = lab_code(&work->probe, distance_of(lab, i));
        equal += i > 0 && code == most[i - 1];
        swap += i > 0 && code > most[i - 1];
        most[i] = code;
        least[i] = i > 0 && least[i - 1] < code ? least[i - 1] : code;
    }
    for (uint32_t i = lab->count; i-- > 0;) {
        most[i] = most[i] < most[i + 1] ? most[i + 1] : most[i];
    }
    put_head(lab, work->probe.format);
    put_field(lab, lab->spacing == LAB_LINEAR_SPACED ? "linear" : "log");
    put_u32(lab, lab->count);
    put_u32(lab, equal);
    put_u32(lab, swap);
    put_length(lab, widest(lab, least, most));
    lab->put(lab->context, "\n");
}

/* ---- resolve -------------------------------------------------------------------------------------------- */

static bool is_linear(const struct lab_format *format)
{
    return format->kind == LAB_LINEAR || (format->kind == LAB_DRAWN && format->format->coding == PH_DEPTH_IS_LINEAR);
}

/* A float format holds d = N/w - F (depth.h). near512 is N in units of 2^-9 LSBs; complement: F is not 0. */
struct mapping {
    uint64_t near512;
    bool complement;
    int mantissa; /* bits; 0: no float */
    int lowest;   /* octave, which reaches down to 0 */
};

static struct mapping mapping_of(const struct lab *lab, const struct lab_format *format)
{
    const bool complement = format->kind == LAB_DRAWN;
    const int exponent = lab_exponent(format, lab->near_z, lab->far_z),
              mantissa = exponent ? format->bits - exponent : 0;
    const uint64_t head_room = !complement ? 0 : exponent > 4 ? (uint64_t)1 << (exponent - 4) : 1;
    return (struct mapping){(uint64_t)lab->near_z * (512 - head_room), complement, mantissa, (1 << exponent) - 2};
}

/* The octave of d at w; octave 0 is d in 1/2 .. 1. */
static int octave_of(const struct lab *lab, struct mapping mapping, fx_t w)
{
    const struct lab_num near = lab_num_scaled(mapping.near512, 60 - 9); /* d in 2^-60 */
    const struct lab_num at = lab_num_div(near, lab_num_of((uint64_t)w));
    const struct lab_num far = lab_num_div(near, lab_num_of((uint64_t)lab->far_z));
    uint64_t d = (at.e <= -64 ? 0 : at.m >> -at.e) - (far.e <= -64 || !mapping.complement ? 0 : far.m >> -far.e);
    int octave = 0;
    for (; octave < mapping.lowest && d < (uint64_t)1 << 59; d <<= 1) {
        octave++;
    }
    return octave;
}

/* The last bit of d times z^2 / N, all in LSBs. */
static struct lab_num float_step(struct mapping mapping, struct lab_num z, int octave)
{
    const struct lab_num bit = lab_num_scaled(512, -(mapping.mantissa + 1 + octave));
    return lab_num_div(lab_num_mul(lab_num_mul(z, z), bit), lab_num_of(mapping.near512));
}

/* The ideal step at w, in LSBs; see lab.h. */
static struct lab_num ideal_step(const struct lab *lab, const struct lab_format *format, fx_t w)
{
    const uint64_t n = (uint64_t)lab->near_z, f = (uint64_t)lab->far_z;
    const struct lab_num largest = lab_num_of(((uint32_t)1 << format->bits) - 1), z = lab_num_of((uint64_t)w);
    if (format->kind == LAB_LOG) {
        const uint64_t log2 = lab_log2_q56((uint32_t)f) - lab_log2_q56((uint32_t)n);
        const struct lab_num ln2 = {0xB17217F7D1CF79ABu, -64};
        return lab_num_div(lab_num_mul(lab_num_mul(z, ln2), lab_num_scaled(log2, -56)), largest);
    }
    if (is_linear(format)) {
        return lab_num_div(lab_num_of(f - n), largest);
    }
    const struct mapping mapping = mapping_of(lab, format);
    if (mapping.mantissa != 0) {
        return float_step(mapping, z, octave_of(lab, mapping, w));
    }
    const struct lab_num range = lab_num_mul(lab_num_mul(z, z), lab_num_of(f - n));
    return lab_num_div(range, lab_num_mul(lab_num_of(f * n), largest));
}

static struct lab_num larger(struct lab_num a, struct lab_num b)
{
    return a.m != 0 && (b.m == 0 || a.e > b.e || (a.e == b.e && a.m > b.m)) ? a : b;
}

/* The largest ideal step. It is at the far plane or, for floats, where an octave ends, at d = 2^-(k + 1). */
static struct lab_num ideal_worst(const struct lab *lab, const struct lab_format *format)
{
    const struct mapping mapping = mapping_of(lab, format);
    const uint64_t f = (uint64_t)lab->far_z, n = mapping.near512 << 15; /* 2^-24 LSBs */
    struct lab_num worst = ideal_step(lab, format, lab->far_z);
    const int first = octave_of(lab, mapping, lab->near_z), last = octave_of(lab, mapping, lab->far_z);
    for (int k = first; mapping.mantissa != 0 && k < last; k++) {
        const uint64_t d = k < 23 ? f << (23 - k) : f >> (k - 23),
                       below = d + (mapping.complement ? n : 0); /* f (d + N/f) */
        const struct lab_num z = lab_num_div(lab_num_mul(lab_num_of(f), lab_num_of(n)), lab_num_of(below));
        worst = larger(worst, float_step(mapping, z, k));
    }
    return worst;
}

/* Prints z_m, ideal_m, measured_m, ratio; z = 0 stands for S_worst. */
static void resolve_row(const struct lab *lab, struct work *work, fx_t z)
{
    const struct lab_format *format = work->probe.format;
    const uint32_t measured =
        z != 0 ? lab_search_at(&work->search, &work->probe, z) : lab_search_worst(&work->search, &work->probe);
    const struct lab_num ideal = z != 0 ? ideal_step(lab, format, z) : ideal_worst(lab, format);
    put_head(lab, format);
    if (z != 0) {
        put_fx(lab, z);
    } else {
        put_field(lab, "S_worst");
    }
    put_num(lab, (struct lab_num){ideal.m, ideal.e - 16});
    put_length(lab, measured);
    put_num(lab, lab_num_div(lab_num_of(measured), ideal));
    lab->put(lab->context, "\n");
}

/* The next distance after z that is 1, 2 or 5 times a power of ten, in LSBs; the first is 0.001. */
static int64_t next_distance(int64_t z)
{
    static const uint8_t steps[] = {1, 2, 5};
    for (int64_t thousandths = 1; thousandths <= 10000000; thousandths *= 10) {
        for (int i = 0; i < 3; i++) {
            const int64_t at = (thousandths * steps[i] * FX_ONE + 500) / 1000;
            if (at > z) {
                return at;
            }
        }
    }
    return INT64_MAX;
}

static void resolve_format(const struct lab *lab, struct work *work)
{
    lab_search_open(&work->search, &work->probe);
    for (uint32_t i = 0; lab->at != NULL && i < lab->at_count; i++) {
        resolve_row(lab, work, lab->at[i]);
    }
    if (lab->at == NULL) {
        for (int64_t z = lab->near_z; z < lab->far_z; z = next_distance(z)) {
            resolve_row(lab, work, (fx_t)z);
        }
        resolve_row(lab, work, lab->far_z);
    }
    resolve_row(lab, work, 0);
}

/* ---- both ----------------------------------------------------------------------------------------------- */

/* Measures the formats that are asked for, one after the other. */
static int measure(const struct lab *lab, bool pairs)
{
    struct work *work = lab->memory;
    int status = PH_OK;
    for (uint32_t i = 0; i < lab_format_count && status == PH_OK; i++) {
        if ((lab->formats >> i & 1) == 0) {
            continue;
        }
        status = lab_probe_open(&work->probe, &lab_formats[i], lab->near_z, lab->far_z);
        if (status == PH_OK) {
            pairs ? pairs_row(lab, work) : resolve_format(lab, work);
        }
    }
    return status;
}

int lab_pairs(const struct lab *lab)
{
    const int status = open_lab(lab);
    if (status == PH_OK) {
        lab->put(lab->context, "format,bits,near,far,spacing,count,equal,swap,max_wrong_m\n");
    }
    return status == PH_OK ? measure(lab, true) : status;
}

int lab_resolve(const struct lab *lab)
{
    int status = open_lab(lab);
    for (uint32_t i = 0; lab->at != NULL && i < lab->at_count && status == 0; i++) {
        status = lab->at[i] < lab->near_z || lab->at[i] > lab->far_z ? PH_ERR_INVAL : PH_OK;
    }
    if (status == 0) {
        lab->put(lab->context, "format,bits,near,far,z_m,ideal_m,measured_m,ratio\n");
    }
    return status == 0 ? measure(lab, false) : status;
}
