/* Writes torus_mesh.h: 12 x 8 vertices on a ring, and a ramp of greys. It runs on the computer. */
#include "render.h"

#include <stdio.h>

enum { AROUND = 12, ACROSS = 8 };

static int32_t turned(uint32_t i, uint32_t n, int is_sine)
{
    int32_t sine, cosine;
    fx_sincos_q30((uint32_t)(((uint64_t)i << 32) / n), &sine, &cosine);
    return is_sine ? sine : cosine;
}

static int32_t times(int32_t a, int32_t b)
{
    return (int32_t)((int64_t)a * b >> 30);
}

int main(void)
{
    uint16_t ramp[PH_RAMP_SIZE];
    ph_material_ramp(ramp, 255, 255, 255, 0);
    printf("static const uint16_t torus_ramp[PH_RAMP_SIZE] = {");
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        printf("%u, ", (unsigned)ramp[i]);
    }
    printf("};\nstatic const struct fx_vec3 torus_positions[] = {");
    for (uint32_t i = 0; i < AROUND * ACROSS; i++) {
        const int32_t far = FX_ONE + FX_ONE / 4 + times(FX_HALF, turned(i % ACROSS, ACROSS, 0));
        printf("{%d, %d, %d}, ", times(far, turned(i / ACROSS, AROUND, 0)), times(far, turned(i / ACROSS, AROUND, 1)),
               times(FX_HALF, turned(i % ACROSS, ACROSS, 1)));
    }
    printf("};\nstatic const int16_t torus_normals[][3] = {");
    for (uint32_t i = 0; i < AROUND * ACROSS; i++) {
        const int32_t out = turned(i % ACROSS, ACROSS, 0);
        printf("{%d, %d, %d}, ", times(out, turned(i / ACROSS, AROUND, 0)) >> 16,
               times(out, turned(i / ACROSS, AROUND, 1)) >> 16, turned(i % ACROSS, ACROSS, 1) >> 16);
    }
    printf("};\nstatic const uint16_t torus_triangles[][3] = {");
    for (int i = 0; i < AROUND * ACROSS; i++) {
        const int row = i / ACROSS * ACROSS, next = (row + ACROSS) % (AROUND * ACROSS), at = i % ACROSS,
                  right = (at + 1) % ACROSS;
        printf("{%d, %d, %d}, {%d, %d, %d}, ", row + at, next + at, next + right, row + at, next + right, row + right);
    }
    printf("};\n");
    return 0;
}
