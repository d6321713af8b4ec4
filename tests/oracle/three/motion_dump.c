/*
 * Usage: motion_dump FILE.gltf CLIP FRAMES STEP
 * Prints where the middle of the model is in the file, how it is scaled, and for every STEP-th of the frames the
 * vertices of each mesh that moves, and their normals: fit x y z scale FRAME MESH x y z nx ny nz ...     in LSB of
 * Q16.16, and of Q1.14
 */
#include "model.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char *argv[])
{
    static uint64_t memory[1 << 16];
    struct demo_arena arena = {.base = (uint8_t *)memory, .size = sizeof memory};
    struct model *model = NULL;
    if (argc != 5 || model_open(&model, argv[1], NULL) != 0 || model_play(model, argv[2]) != 0) {
        return EXIT_FAILURE;
    }
    const struct animation *a = &model->motion->animation;
    const struct animation_stage *stage = animation_begin(&arena, a, model->meshes, model->mesh_count);
    if (stage == NULL) {
        return EXIT_FAILURE;
    }
    const double *centre = model->motion->centre;
    printf("fit %.17g %.17g %.17g %.17g\n", centre[0], centre[1], centre[2], model->scale);
    const uint32_t frames = (uint32_t)strtoul(argv[3], NULL, 10), step = (uint32_t)strtoul(argv[4], NULL, 10);
    for (uint32_t frame = 0; frame < frames; frame += step) {
        animation_move(stage, NULL, frame);
        for (uint32_t i = 0; i < a->mesh_count; i++) {
            printf("%u %u", (unsigned)frame, (unsigned)i);
            for (uint32_t v = 0; v < a->meshes[i].bound.vertex_count; v++) {
                const struct ph_mesh *mesh = &stage->meshes[a->meshes[i].mesh];
                const struct fx_vec3 *p = &mesh->positions[v];
                const int16_t *n = mesh->normals[v];
                printf(" %d %d %d %d %d %d", (int)p->x, (int)p->y, (int)p->z, n[0], n[1], n[2]);
            }
            printf("\n");
        }
    }
    model_close(model);
    return EXIT_SUCCESS;
}
