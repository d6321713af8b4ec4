/* See fx_inputs.h. */
#include "fx_inputs.h"

int32_t edges[EDGES_MOST];
size_t edge_count;

void add_edge(int64_t v)
{
    if (v >= INT32_MIN && v <= INT32_MAX && edge_count < EDGES_MOST) {
        edges[edge_count++] = (int32_t)v;
    }
}

void add_bit_edges(void)
{
    add_edge(0);
    for (int bit = 0; bit <= 31; bit++) {
        for (int64_t off = -1; off <= 1; off++) {
            add_edge(((int64_t)1 << bit) + off);
            add_edge(-((int64_t)1 << bit) - off);
        }
    }
}

uint32_t noise(void)
{
    static uint32_t state = 1;
    state ^= state << 13;
    state ^= state >> 17;
    state ^= state << 5;
    return state;
}

int32_t noise_any(void)
{
    const int32_t v = (int32_t)noise();
    return v >> (noise() % 32);
}
