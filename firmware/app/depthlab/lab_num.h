/*
 * lab_num: the few numbers of the depth lab that do not fit fixed point (ideal steps from 6e-9 m to 700 m). They have a
 * 64-bit mantissa and an exponent and are calculated with integers, so that every machine prints the same digits. They
 * are positive or 0. Results are rounded down to 64 bits: the relative error is below 2^-62.
 */
#ifndef LAB_NUM_H
#define LAB_NUM_H

#include "fx.h"

#include <stdbool.h>

/* A number m 2^e, m in 2^63 .. 2^64 - 1; zero: m = 0. */
struct lab_num {
    uint64_t m;
    int e;
};

#define LAB_TEXT_SIZE 24

struct lab_num lab_num_of(uint64_t v);            /* v */
struct lab_num lab_num_scaled(uint64_t v, int e); /* v 2^e */
struct lab_num lab_num_mul(struct lab_num a, struct lab_num b);
struct lab_num lab_num_div(struct lab_num a, struct lab_num b); /* b is not 0 */

/* log2(v) in 2^-56, rounded down at each step, hence never decreasing; v > 0. */
uint64_t lab_log2_q56(uint32_t v);

/* Writes six significant digits, the last rounded to nearest: "0.0742188", "181", "5.96046e-08" below 1e-4. */
void lab_num_text(struct lab_num v, char text[LAB_TEXT_SIZE]);

/* Writes a length in LSBs of Q16.16 as metres with ten digits, which tell every two lengths apart: "0.07421875". */
void lab_length_text(uint32_t lsbs, char text[LAB_TEXT_SIZE]);

/* Writes the shortest decimal that stands for v in Q16.16: "0.1" for 6554. v >= 0. */
void lab_fx_text(fx_t v, char text[LAB_TEXT_SIZE]);

void lab_u32_text(uint32_t v, char text[LAB_TEXT_SIZE]);

/* High 64 bits of the product. */
uint64_t lab_mulhi_u64(uint64_t a, uint64_t b);

#endif
