/* Sprites in the scene: trees that face the camera, cut out of a texture by its key colour. */
#include "example.h"
#include "shapes.h"

/* A tree of 16 x 16 texels: # leaves, | trunk. */
static const char tree[16][17] = {"......###.......", "....#######.....", "...##########...", "..############..",
                                  ".#############..", ".##############.", "..#############.", ".##############.",
                                  ".#############..", "..###########...", "....#######.....", "......||........",
                                  "......||........", "......||........", "......||........", ".....||||......."};

static int draw(struct ph_renderer *r, uint32_t frame)
{
    static struct shape ground;
    static uint16_t texels[256], grass[256];
    static struct ph_texture picture, checks;
    static struct ph_blend cut = {.draw = ph_draw_blended, .kind = PH_BLEND_KEY};
    for (int i = 0; i < 256; i++) {
        const char c = tree[i / 16][i % 16];
        const uint8_t shade = (uint8_t)(90 + (i * 37 % 64));
        texels[i] = c == '#' ? ph_rgb565(30, shade, 40) : c == '|' ? ph_rgb565(100, 70, 40) : cut.key;
    }
    picture = (struct ph_texture){.texels = texels, .log2_width = 4, .log2_height = 4, .wrap = PH_WRAP_CLAMP};
    checks = shape_checks(grass, ph_rgb565(90, 150, 70), ph_rgb565(100, 165, 80));
    const struct ph_material turf = {.shading = PH_SHADE_TEXTURE, .texture = &checks},
                             leaves = {.shading = PH_SHADE_TEXTURE, .texture = &picture, .blend = &cut};
    const struct ph_mesh meadow = shape_floor(&ground, &turf);
    const fx_t turns = (fx_t)(frame << 8);
    int status = example_look(r, (struct fx_vec3){6 * fx_cos(turns), FX_ONE, 6 * fx_sin(turns)},
                              (struct fx_vec3){0, -FX_ONE / 4, 0}, NULL, ph_rgb565(150, 200, 240));
    status = status != 0 ? status : ph_draw_mesh(r, &meadow, &ph_xform_identity);
    for (int32_t i = 0; i < 14 && status == 0; i++) {
        const struct fx_vec3 at = {FX_INT(i * 5 % 11 - 5), FX_ONE / 5, FX_INT(i * 7 % 11 - 5)};
        status = ph_draw_billboard(r, at, FX_ONE * 2, FX_ONE * 12 / 5, &leaves);
    }
    return status;
}

int main(int argc, char *argv[])
{
    const struct ph_config config = example_config();
    return example_run(argc, argv, &config, draw);
}
