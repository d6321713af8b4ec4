/*
 * Scene S6: the torus of S1 with the texture of S2, which repeats 4 x 2 times around it; S7: the same in the light of
 * S1; S8: the same with a filter, and with maps for it. See bench.h.
 */
#include "bench.h"

#include "models.h"

#include <string.h>

enum { MAJOR = 32, MINOR = 16, VERTICES = (MAJOR + 1) * (MINOR + 1), TRIANGLES = 2 * MAJOR * MINOR };
enum { SIDE_LOG2 = 6, MAP_TEXELS = 5461 };

struct textured {
    struct ph_texture texture;
    struct ph_material material;
    struct ph_part part;
    int16_t normals[VERTICES][3];
    uint16_t texels[MAP_TEXELS];
    struct fx_vec3 positions[VERTICES];
    fx_t uvs[VERTICES][2];
    uint16_t triangles[TRIANGLES][3];
};

/* Vertices are doubled at the seams: number i * 17 + j, and triangles in the order of S1. */
static void build(struct textured *t, const struct fx_vec3 *positions, const int16_t (*normals)[3])
{
    for (uint32_t n = 0; n < VERTICES; n++) {
        const uint32_t i = n / (MINOR + 1), j = n % (MINOR + 1);
        t->positions[n] = positions[i % MAJOR * MINOR + j % MINOR];
        memcpy(t->normals[n], normals[i % MAJOR * MINOR + j % MINOR], sizeof t->normals[n]);
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

static uint32_t channel(const uint16_t *texel, unsigned down, uint32_t mask)
{
    const uint8_t *const bytes = (const uint8_t *)texel;
    return ((uint32_t)bytes[0] << 8 | bytes[1]) >> down & mask;
}

/* The mean of four texels, rounded to nearest. */
static uint32_t mean(const uint16_t *from, uint32_t width, unsigned down, uint32_t mask)
{
    return (channel(from, down, mask) + channel(from + 1, down, mask) + channel(from + width, down, mask) +
            channel(from + width + 1, down, mask) + 2) /
           4;
}

/* The texture, and its levels behind it. */
static void build_maps(uint16_t *texels, const uint16_t *base)
{
    memcpy(texels, base, sizeof *texels << (2 * SIDE_LOG2));
    for (uint32_t width = 1u << SIDE_LOG2; width > 1; width /= 2) {
        uint16_t *const to = texels + width * width;
        for (uint32_t i = 0; i < width * width / 4; i++) {
            const uint16_t *const from = texels + i / (width / 2) * 2 * width + i % (width / 2) * 2;
            const uint32_t red = mean(from, width, 11, 31), green = mean(from, width, 5, 63);
            to[i] = ph_rgb565((uint8_t)((red * 255 + 15) / 31), (uint8_t)((green * 255 + 31) / 63),
                              (uint8_t)((mean(from, width, 0, 31) * 255 + 15) / 31));
        }
        texels = to;
    }
}

/* The demos' states begin with their mesh. That of the torus becomes the textured one. */
static int init_with(struct demo_context *context, const struct ph_shading *shading, const struct ph_filter *filter)
{
    struct textured *const t = demo_alloc(&context->arena, sizeof *t);
    if (t == NULL || demo_find("cube")->init(context) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    t->texture = *((const struct ph_mesh *)context->state)->materials->texture;
    t->texture.wrap = PH_WRAP_REPEAT;
    build_maps(t->texels, t->texture.texels);
    t->texture.texels = t->texels;
    t->texture.filter = filter;
    t->texture.levels = SIDE_LOG2;
    t->part = (struct ph_part){.count = TRIANGLES};
    if (demo_find("torus")->init(context) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    struct ph_mesh *const mesh = context->state;
    t->material = mesh->materials[0];
    t->material.shading = shading;
    t->material.texture = &t->texture;
    build(t, mesh->positions, mesh->normals);
    *mesh = (struct ph_mesh){.positions = t->positions,
                             .normals = (const int16_t(*)[3])t->normals,
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

static int s6_init(struct demo_context *context)
{
    return init_with(context, PH_SHADE_TEXTURE, PH_FILTER_NEAREST);
}

static int s7_init(struct demo_context *context)
{
    return init_with(context, PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_NEAREST);
}

static int s8_init(struct demo_context *context)
{
    return init_with(context, PH_SHADE_TEXTURE_GOURAUD, PH_FILTER_MIPMAP);
}

const struct demo bench_textured_tori[3] = {
    {.name = "textured torus", .init = s6_init, .frame = textured_torus_frame},
    {.name = "lit textured torus", .init = s7_init, .frame = textured_torus_frame},
    {.name = "filtered textured torus", .init = s8_init, .frame = textured_torus_frame},
};
