/*
 * Writes the walker to stdout as C: const arrays, which an image keeps in its flash. It is the figure of the demo
 * character with more sides: rp2040_walker.sh says why.
 */
#include "demos/figure.h"

#include <stdio.h>

#define SIDES 31

static const struct figure_detail fine = {SIDES, 1};

static void print_bound(const struct figure_tube *tube, const char *name)
{
    struct figure_loop loop;
    static const char *const what[] = {"int16_t %s_positions[][3]", "int16_t %s_normals[][3]",
                                       "struct ph_influence %s_influences[]"};
    for (uint32_t k = 0; k < 3; k++) {
        printf("static const ");
        printf(what[k], name);
        printf(" = {\n");
        for (uint32_t ring = 0; ring < tube->count; ring++) {
            figure_make_loop(&loop, tube, ring, fine);
            for (uint32_t i = 0; i <= SIDES; i++) {
                const int16_t *const v = k == 0 ? loop.positions[i] : loop.normals[i];
                const struct ph_influence *const in = &loop.influences[i];
                if (k < 2) {
                    printf("{%d, %d, %d},\n", v[0], v[1], v[2]);
                } else {
                    printf("{{%u, %u}, {%u, %u}},\n", in->joints[0], in->joints[1], in->weights[0], in->weights[1]);
                }
            }
        }
        printf("};\n");
    }
}

/* Triangles with an area: a ring that is a point has one on each side. */
static void print_triangles(const struct figure_tube *tube, const char *name, uint16_t (*grid)[3])
{
    printf("static const uint16_t %s_triangles[][3] = {\n", name);
    for (uint32_t i = 0; i < 2 * SIDES * (tube->count - 1); i++) {
        const uint32_t ring = i / 2 / SIDES;
        if (i % 2 == 0 ? ring + 2 < tube->count : ring > 0) {
            printf("{%u, %u, %u},\n", grid[i][0], grid[i][1], grid[i][2]);
        }
    }
    printf("};\n");
}

int main(void)
{
    static const char *const names[FIGURE_TUBES] = {"body", "arm", "leg"};
    static uint64_t memory[16384];
    struct demo_arena arena = {.base = (uint8_t *)memory, .size = sizeof memory};
    struct ph_texture texture;
    uint16_t(*grid)[3];
    if (!figure_make_grid(&arena, &grid, fine) || figure_make_texture(&arena, &texture, 0) != PH_OK) {
        return 1;
    }
    for (uint32_t i = 0; i < FIGURE_TUBES; i++) {
        fx_t(*uvs)[2];
        if (!figure_make_uvs(&arena, &uvs, &figure_tubes[i], fine)) {
            return 1;
        }
        print_bound(&figure_tubes[i], names[i]);
        print_triangles(&figure_tubes[i], names[i], grid);
        printf("static const fx_t %s_uvs[][2] = {\n", names[i]);
        for (uint32_t v = 0; v < figure_tubes[i].count * (SIDES + 1); v++) {
            printf("{%d, %d},\n", (int)uvs[v][0], (int)uvs[v][1]);
        }
        printf("};\n");
    }
    printf("static const uint16_t texels[] = {\n");
    for (uint32_t i = 0; i < 32 * 128; i++) {
        printf("%u,\n", texture.texels[i]);
    }
    printf("};\n");
    return 0;
}
