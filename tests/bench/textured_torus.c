/* Scene S6: the torus of S1 with the texture of S2, which repeats 4 x 2 times around it. See bench.h. */
#include "bench.h"

#include "models.h"

enum { MAJOR = 32, MINOR = 16, VERTICES = (MAJOR + 1) * (MINOR + 1), TRIANGLES = 2 * MAJOR * MINOR };

struct textured {
    struct ph_texture texture;
    struct ph_material material;
    struct ph_part part;
    struct fx_vec3 positions[VERTICES];
    fx_t uvs[VERTICES][2];
    uint16_t triangles[TRIANGLES][3];
};

/* Vertices are doubled at the seams: number i * 17 + j, and triangles in the order of S1. */
static void build(struct textured *t, const struct fx_vec3 *positions)
{
    for (uint32_t n = 0; n < VERTICES; n++) {
        const uint32_t i = n / (MINOR + 1), j = n % (MINOR + 1);
        t->positions[n] = positions[i % MAJOR * MINOR + j % MINOR];
        t->uvs[n][0] = (fx_t)(4 * FX_ONE / MAJOR * i);
        t->uvs[n][1] = (fx_t)(2 * FX_ONE / MINOR * j);
    }
    for (uint32_t n = 0; n < TRIANGLES; n++) {
        const uint32_t a = n / (2 * MINOR) * (MINOR + 1) + n / 2 % MINOR, b = a + MINOR + 1;
        t->triangles[n][0] = (uint16_t)a;
        t->triangles[n][1] = (uint16_t)(n % 2 == 0 ? b : b + 1);
        t->triangles[n][2] = (uint16_t)(n % 2 == 0 ? b + 1 : a + 1);
    }
}

/* The demos' states begin with their mesh. That of the torus becomes the textured one. */
static int textured_torus_init(struct demo_context *context)
{
    struct textured *const t = demo_alloc(&context->arena, sizeof *t);
    if (t == NULL || demo_find("cube")->init(context) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    t->texture = *((const struct ph_mesh *)context->state)->materials->texture;
    t->texture.wrap = PH_WRAP_REPEAT;
    t->material = (struct ph_material){.shading = PH_SHADE_TEXTURE, .texture = &t->texture};
    t->part = (struct ph_part){.count = TRIANGLES};
    if (demo_find("torus")->init(context) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    struct ph_mesh *const mesh = context->state;
    build(t, mesh->positions);
    *mesh = (struct ph_mesh){.positions = t->positions,
                             .uvs = (const fx_t(*)[2])t->uvs,
                             .triangles = (const uint16_t(*)[3])t->triangles,
                             .parts = &t->part,
                             .materials = &t->material,
                             .vertex_count = VERTICES,
                             .triangle_count = TRIANGLES,
                             .part_count = 1};
    return PH_OK;
}

static int textured_torus_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    return demo_find("torus")->frame(context, r, frame);
}

const struct demo bench_textured_torus = {
    .name = "textured torus",
    .init = textured_torus_init,
    .frame = textured_torus_frame,
};
