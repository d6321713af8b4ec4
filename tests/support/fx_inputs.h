/* fx_inputs: raw inputs on which functions of fx.h and fx_math.h are compared with an oracle. */
#ifndef FX_INPUTS_H
#define FX_INPUTS_H

#include <stddef.h>
#include <stdint.h>

#define EDGES_MOST 256
extern int32_t edges[EDGES_MOST];
extern size_t edge_count;

/* Adds a value; none that does not fit. */
void add_edge(int64_t v);

/* Adds 0 and each power of two with its neighbours, of both signs. */
void add_bit_edges(void);

uint32_t noise(void);

/* A random number of any magnitude: as many small ones as large ones. */
int32_t noise_any(void);

#endif
