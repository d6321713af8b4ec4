#include "model_surface.h"

#include "png_in.h"

#include <stdlib.h>
#include <string.h>

/* How a material takes the light of the turntable; files give reliable colours only. */
#define AMBIENT        (FX_ONE / 6)
#define DIFFUSE        (FX_ONE * 3 / 4)
#define GLOSS          (FX_ONE / 4)
#define SHININESS_LOG2 5

const char *model_surface_why(const uint8_t *bytes, size_t n)
{
    if (n >= 2 && bytes[0] == 0xFF && bytes[1] == 0xD8) {
        return "is JPEG: only PNG is read";
    }
    return n >= 4 && memcmp(bytes, "\x89PNG", 4) == 0 ? png_in_reason : "is no PNG: only PNG is read";
}

/* Returns the texture of the picture, or NULL; a note says why. */
static const struct ph_texture *make_texture(struct model_shared *shared, const struct model_surface *from)
{
    struct ph_texture *texture = demo_alloc(&shared->arena, sizeof *texture);
    if (texture == NULL || model_texture_make(&shared->arena, &from->picture, texture) != 0) {
        model_shared_note(shared, "texture %s is left out: no memory", from->name);
        return NULL;
    }
    const unsigned width = 1u << texture->log2_width, height = 1u << texture->log2_height;
    if (width != from->picture.width || height != from->picture.height) {
        model_shared_note(shared, "texture %s is resized from %ux%u to %ux%u", from->name,
                          (unsigned)from->picture.width, (unsigned)from->picture.height, width, height);
    }
    if (from->wrap[0] != from->wrap[1]) {
        model_shared_note(shared, "texture %s wraps both ways as along u", from->name);
    }
    texture->wrap = from->wrap[0];
    return texture;
}

static uint8_t add(unsigned a, unsigned b)
{
    return (uint8_t)(a + b < 255 ? a + b : 255);
}

/* Adds what the surface emits to each colour of the ramp. */
static void add_glow(uint16_t ramp[PH_RAMP_SIZE], const uint8_t glow[3])
{
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        uint8_t wire[2];
        memcpy(wire, &ramp[i], sizeof wire);
        const unsigned c = (unsigned)wire[0] << 8 | wire[1];
        ramp[i] = ph_rgb565(add((c >> 11) * 255 / 31, glow[0]), add((c >> 5 & 63) * 255 / 63, glow[1]),
                            add((c & 31) * 255 / 31, glow[2]));
    }
}

bool model_surface_make(struct model_shared *shared, struct model_surface *from, struct ph_material *to)
{
    const uint8_t *c = from->colour, *glow = from->glow;
    uint16_t *ramp = demo_alloc(&shared->arena, sizeof *ramp * PH_RAMP_SIZE);
    if (ramp == NULL) {
        return false;
    }
    const bool glows = (glow[0] | glow[1] | glow[2]) != 0 && !from->is_unlit;
    const struct ph_texture *texture = from->picture.rgb != NULL ? make_texture(shared, from) : NULL;
    free(from->picture.rgb);
    ph_material_ramp(ramp, c[0], c[1], c[2], GLOSS);
    if (glows) {
        add_glow(ramp, glow);
    }
    if (from->is_transparent) {
        model_shared_note(shared, "transparency is ignored");
    }
    if (glows && texture != NULL) {
        model_shared_note(shared, "emission of textured materials is ignored");
    }
    *to = (struct ph_material){.shading = from->is_unlit ? PH_SHADE_UNLIT : PH_SHADE_GOURAUD,
                               .two_sided = from->two_sided,
                               .shininess_log2 = SHININESS_LOG2,
                               .ambient = AMBIENT,
                               .diffuse = DIFFUSE,
                               .specular = GLOSS,
                               .colour = ph_rgb565(c[0], c[1], c[2]),
                               .ramp = ramp,
                               .texture = texture};
    return true;
}
