/*
 * bench: what the benchmark (bench.c) needs of a machine: machine_arm.c is an emulated Cortex-M that counts
 * instructions, machine_riscv.c an emulated RV32, machine_xtensa.c an emulated lx106 (ESP8266), machine_host.c this
 * computer under callgrind.
 */
#ifndef BENCH_H
#define BENCH_H

#include "demo.h"

#include <stdint.h>

/* Scenes S6, S7 and S8, of which only init and frame are set. */
extern const struct demo bench_textured_tori[3];

/* The instructions between the two are counted; stop reports them as one line: the words of `what`, the count. */
void machine_start(void);
void machine_stop(const char *const what[3], uint32_t frame);

/* A loop of a million turns, two instructions each where the machine is emulated. */
void machine_known_loop(void);

void machine_print(const char *text);

/* Words of the command line; "" past the last. */
const char *machine_word(unsigned i);

#endif
