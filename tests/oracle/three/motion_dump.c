/*
 * Usage: motion_dump FILE.gltf CLIP FRAMES
 * Prints how far the model is moved and scaled, and for each frame of the clip the vertices of each mesh that moves:
 *   fit x y z scale
 *   FRAME MESH x y z ...     in LSB of Q16.16
 */
#include "model.h"

#include <stdio.h>
#include <stdlib.h>

int main(int argc, char *argv[])
{
    struct model *model = NULL;
    if (argc != 4 || model_open(&model, argv[1], NULL) != 0 || !model_play(model, argv[2])) {
        return EXIT_FAILURE;
    }
    const struct model_motion *m = model->motion;
    printf("fit %d %d %d %.17g\n", (int)m->root.t.x, (int)m->root.t.y, (int)m->root.t.z, m->scale);
    for (uint32_t frame = 0; frame < (uint32_t)atoi(argv[3]); frame++) {
        model_move(model, frame);
        for (uint32_t i = 0; i < m->moving_count; i++) {
            printf("%u %u", (unsigned)frame, (unsigned)i);
            for (uint32_t v = 0; v < m->moving[i].bound.vertex_count; v++) {
                const struct fx_vec3 *p = &m->moving[i].positions[v];
                printf(" %d %d %d", (int)p->x, (int)p->y, (int)p->z);
            }
            printf("\n");
        }
    }
    model_close(model);
    return EXIT_SUCCESS;
}
