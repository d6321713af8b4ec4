/*
 * Every Q16.16 distance from the near to the far plane goes through the renderer's own steps for a vertex
 * (depth_chain.h). No code may rise with the distance, and each must be the floor of the exact value. test_depth.c
 * checks that these steps are those that draw.
 */
#include "depth_chain.h"
#include "render.h"

#include <stdio.h>
#include <stdlib.h>

struct camera {
    fx_t near_z, far_z;
    int exact_every; /* every so many distances the exact value is compared, too */
};

/* The lens of a frame, as the renderer makes it. */
static int lens_of(const struct camera *camera, const struct ph_depth_format *format, int exponent,
                   struct ph_lens *lens)
{
    struct ph_renderer r;
    struct ph_projection p;
    uint32_t bin;
    uint32_t depth;
    const struct ph_config config = {.width = 1,
                                     .height = 1,
                                     .band_height = 1,
                                     .depth_format = format,
                                     .depth_exponent = (uint8_t)exponent,
                                     .vertices = &r,
                                     .triangles = &r,
                                     .bins = &bin,
                                     .bin_max = 1,
                                     .depth = &depth};
    if (ph_renderer_init(&r, &config) != PH_OK ||
        ph_projection_perspective(&p, FX_INT(60), FX_ONE, camera->near_z, camera->far_z) != PH_OK ||
        ph_frame_begin(&r, &ph_xform_identity, &p, NULL, 0) != PH_OK) {
        return 1;
    }
    *lens = r.lens;
    return 0;
}

static int check(const struct camera *camera, const struct ph_depth_format *format, int exponent)
{
    struct ph_lens lens;
    if (lens_of(camera, format, exponent, &lens) != 0) {
        fprintf(stderr, "exhaustive_depth: the renderer refuses the camera\n");
        return 1;
    }
    uint32_t before = UINT32_MAX, codes = 0;
    for (uint32_t w = (uint32_t)camera->near_z; w <= (uint32_t)camera->far_z; w++) {
        const uint32_t code = depth_chain(&lens, format, (fx_t)w);
        if (code > before ||
            (w % (uint32_t)camera->exact_every == 0 && !depth_is_right(&lens, format, (fx_t)w, code))) {
            fprintf(stderr, "exhaustive_depth: %s: code %u at distance %u/65536, %u just before it, exact %.4f\n",
                    format->name, (unsigned)code, (unsigned)w, (unsigned)before, depth_exact(&lens, format, (fx_t)w));
            return 1;
        }
        codes += code != before;
        before = code;
    }
    printf("%-8s e%d near %.6g far %.8g: %u distances, %u codes, none rises\n", format->name, exponent,
           camera->near_z / 65536., camera->far_z / 65536., (unsigned)camera->far_z - (unsigned)camera->near_z + 1,
           (unsigned)codes);
    fflush(stdout);
    return 0;
}

int main(void)
{
    static const struct camera cameras[] = {
        {6554, FX_INT(1000), 1}, {FX_HALF, FX_INT(100), 1}, {FX_ONE, FX_INT(1000), 1}, {1, FX_MAX, 61}};
    for (size_t i = 0; i < sizeof cameras / sizeof cameras[0]; i++) {
        for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
            const struct ph_depth_format *const format = ph_depth_formats[f];
            const bool is_float = format->coding == PH_DEPTH_IS_FLOAT;
            for (int exponent = is_float ? 3 : 0; exponent <= (is_float ? 6 : 0); exponent++) {
                if (check(&cameras[i], format, exponent) != 0) {
                    return EXIT_FAILURE;
                }
            }
        }
    }
    return EXIT_SUCCESS;
}
