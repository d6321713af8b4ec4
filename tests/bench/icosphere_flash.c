/*
 * Writes the icosphere of benchmark 4 to stdout as C: const arrays, which an image keeps in its flash, and a struct
 * ph_mesh icosphere of them without parts. It is the demo's own mesh, so that the pictures are the demo's.
 */
#include <stdio.h>

#include "models.h"

#define LEVELS    4
#define VERTICES  MODEL_ICOSPHERE_VERTICES(LEVELS)
#define TRIANGLES MODEL_ICOSPHERE_TRIANGLES(LEVELS)

int main(void)
{
    static uint64_t memory[MODEL_BYTES(VERTICES, TRIANGLES) / 8];
    struct demo_arena arena = {.base = (uint8_t *)memory, .size = sizeof memory};
    struct ph_mesh mesh;
    if (model_icosphere(&arena, &mesh, LEVELS) != PH_OK) {
        return 1;
    }
    printf("#include \"models.h\"\nstatic const struct fx_vec3 positions[] = {\n");
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        printf("{%d, %d, %d},\n", (int)mesh.positions[i].x, (int)mesh.positions[i].y, (int)mesh.positions[i].z);
    }
    printf("};\nstatic const int16_t normals[][3] = {\n");
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        printf("{%d, %d, %d},\n", mesh.normals[i][0], mesh.normals[i][1], mesh.normals[i][2]);
    }
    printf("};\nstatic const uint16_t triangles[][3] = {\n");
    for (uint32_t i = 0; i < mesh.triangle_count; i++) {
        printf("{%u, %u, %u},\n", mesh.triangles[i][0], mesh.triangles[i][1], mesh.triangles[i][2]);
    }
    printf("};\nstatic const struct ph_mesh icosphere = {.positions = positions, .normals = normals, .triangles = "
           "triangles, .vertex_count = %u, .triangle_count = %u};\n",
           (unsigned)mesh.vertex_count, (unsigned)mesh.triangle_count);
    return fflush(stdout) != 0;
}
