/*
 * proof: what the harnesses for CBMC share. A harness calls a function of the core with every input at once: nondet_
 * stands for all values of a type, ASSUME keeps those that the function's header allows, CLAIM must hold for all that
 * are left. proof.sh has the table of the proofs.
 */
#ifndef PROOF_H
#define PROOF_H

#include <stdint.h>

int32_t nondet_i32(void);
int64_t nondet_i64(void);
uint32_t nondet_u32(void);

void __CPROVER_assume(int condition);
void __CPROVER_assert(int condition, const char *claim);

#define ASSUME(condition) __CPROVER_assume(condition)
#define CLAIM(condition)  __CPROVER_assert(condition, #condition)
#define POWER(n)          ((int64_t)1 << (n))

static inline int32_t i32_between(int32_t least, int32_t most)
{
    const int32_t v = nondet_i32();
    ASSUME(v >= least && v <= most);
    return v;
}

static inline int64_t i64_between(int64_t least, int64_t most)
{
    const int64_t v = nondet_i64();
    ASSUME(v >= least && v <= most);
    return v;
}

static inline uint32_t u32_between(uint32_t least, uint32_t most)
{
    const uint32_t v = nondet_u32();
    ASSUME(v >= least && v <= most);
    return v;
}

#endif
