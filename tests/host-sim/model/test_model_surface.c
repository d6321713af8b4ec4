/* model_surface: which ramp, texture, blend and glow a material gets, for what files can say of one. Colours are summed
 * here from the bits of the wire. */
#include "model_surface.h"
#include "files.h"
#include "png_out.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static uint8_t memory[1 << 16];
static struct model_shared shared;
static struct model_surface surface;
static struct model_material made;

static int fresh(void **state)
{
    (void)state;
    memset(&shared, 0, sizeof shared);
    shared.arena = (struct demo_arena){.base = memory, .size = sizeof memory};
    surface = (struct model_surface){.colour = {200, 100, 50}, .name = "a.png", .alpha = 1, .cutoff = .5};
    return 0;
}

/* A picture of one row whose pixels are as bright as alphas says; alphas may be the alphas of it. */
static struct picture_in row_of(const uint8_t *alphas, uint32_t n, bool has_alpha)
{
    struct picture_in p = {.width = n, .height = 1, .picture = {n, 1, malloc(3 * (size_t)n)}};
    p.alpha = has_alpha ? malloc(n) : NULL;
    assert_true(p.picture.rgb != NULL && (p.alpha != NULL || !has_alpha));
    for (uint32_t i = 0; i < n; i++) {
        memset(p.picture.rgb + 3 * i, alphas[i], 3);
        if (has_alpha) {
            p.alpha[i] = alphas[i];
        }
    }
    return p;
}

static const uint8_t greys[4] = {0, 64, 128, 255};

static void make(void)
{
    assert_true(model_surface_make(&shared, &surface, &made));
}

static void a_channel_is_rounded_and_clamped(void **state)
{
    static const struct {
        float from;
        int to;
    } cases[] = {{NAN, 0}, {-1, 0},  {0, 0},      {1 / 255.f, 1}, {.2f, 51},      {.5f, 128},
                 {1, 255}, {2, 255}, {.0019f, 0}, {.002f, 1},     {INFINITY, 255}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        assert_int_equal(model_surface_channel(cases[i].from), cases[i].to);
    }
}

/* Alphas of 17 to 238 are between nothing and all; up to one in 16 of a mask's may be. */
static void a_mask_cuts_out_what_is_seldom_between(void **state)
{
    static const struct {
        uint8_t first, second;
        double alpha;
        uint8_t mode;
    } cases[] = {{0, 255, 1, MODEL_MASK},    {100, 255, 1, MODEL_MASK}, {100, 100, 1, MODEL_BLEND},
                 {17, 238, 1, MODEL_BLEND},  {16, 238, 1, MODEL_MASK},  {17, 239, 1, MODEL_MASK},
                 {0, 255, .99, MODEL_BLEND}, {0, 255, 1.5, MODEL_MASK}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0] * 2; i++) {
        uint8_t alphas[16] = {cases[i / 2].first, cases[i / 2].second, 255};
        surface.mask = row_of(alphas, 16, i % 2 == 0);
        surface.mask.picture.width = 8, surface.mask.picture.height = 2;
        surface.alpha = cases[i / 2].alpha, surface.cutoff = .2, surface.mode = MODEL_OPAQUE;
        model_surface_mask(&surface);
        assert_int_equal(surface.mode, cases[i / 2].mode);
        assert_true(surface.cutoff == .5);
        assert_memory_equal(surface.mask.alpha, alphas, 16);
        picture_in_free(&surface.mask);
    }
    surface.mask = (struct picture_in){.picture = {1, 2, calloc(6, 1)}};
    memcpy(surface.mask.picture.rgb, (uint8_t[]){10, 20, 60, 255, 255, 1}, 6);
    model_surface_mask(&surface);
    assert_true(surface.mask.alpha[0] == 30 && surface.mask.alpha[1] == 170);
    picture_in_free(&surface.mask);
}

/* Bits of a texel on the wire: 5, 6 and 5. */
static void channels_of(uint16_t wire, unsigned c[3])
{
    uint8_t b[2];
    memcpy(b, &wire, 2);
    c[0] = b[0] >> 3, c[1] = (b[0] & 7U) << 3 | b[1] >> 5, c[2] = b[1] & 31;
}

static void a_plain_surface_is_lit_by_its_ramp(void **state)
{
    uint16_t ramp[PH_RAMP_SIZE];
    (void)state;
    surface.two_sided = true;
    make();
    const struct ph_material *m = &made.surface;
    assert_ptr_equal(m->shading, PH_SHADE_GOURAUD);
    assert_true(m->two_sided && m->texture == NULL && m->blend == NULL && !made.glows);
    /* 1/2, 13/20 and 1/4 of 65536: what is lit straight on has its own colour, and its highlight is above it */
    assert_true(m->ambient == 32768 && m->diffuse == 42598 && m->specular == 16384 && m->shininess_log2 == 5);
    assert_int_equal(m->colour, ph_rgb565(200, 100, 50));
    ph_material_ramp(ramp, 200, 100, 50, 16384);
    assert_memory_equal(m->ramp, ramp, sizeof ramp);
    surface.two_sided = false;
    make();
    assert_false(made.surface.two_sided);
    shared.options.two_sided = true;
    surface.is_unlit = true;
    memcpy(surface.glow, (uint8_t[3]){9, 9, 9}, 3); /* an unlit surface has none */
    make();
    assert_true(made.surface.two_sided && made.surface.shading == PH_SHADE_UNLIT && !made.glows);
    assert_memory_equal(made.surface.ramp, ramp, sizeof ramp);
}

static void emission_is_added_to_the_ramp(void **state)
{
    static const unsigned top[3] = {31, 63, 31};
    (void)state;
    for (unsigned g = 1; g < 256; g++) {
        const uint8_t glow[3] = {(uint8_t)g, (uint8_t)(7 * g), (uint8_t)(13 * g)};
        uint16_t ramp[PH_RAMP_SIZE];
        ph_material_ramp(ramp, 200, 100, 50, 16384);
        fresh(NULL);
        memcpy(surface.glow, glow, 3);
        make();
        assert_false(made.glows);
        for (int i = 0; i < PH_RAMP_SIZE; i++) {
            unsigned before[3], after[3];
            channels_of(ramp[i], before);
            channels_of(made.surface.ramp[i], after);
            for (int k = 0; k < 3; k++) {
                const double sum = fmin(255, floor(before[k] * 255.0 / top[k]) + glow[k]);
                assert_int_equal(after[k], (unsigned)(sum * top[k] / 255 + .4999));
            }
        }
    }
}

static void any_channel_glows(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        fresh(NULL);
        surface.picture = row_of(greys, 4, false);
        surface.glow[k] = 1;
        make();
        assert_true(made.glows);
    }
}

static void the_option_or_the_file_chooses_the_filter(void **state)
{
    static const struct {
        const char *option;
        const struct ph_filter *file, *filter;
        bool is_noted;
    } cases[] = {{NULL, PH_FILTER_NEAREST, PH_FILTER_NEAREST, false},
                 {NULL, PH_FILTER_MIPMAP, PH_FILTER_NEAREST, true},
                 {"file", PH_FILTER_MIPMAP, PH_FILTER_MIPMAP, false},
                 {"file", PH_FILTER_BILINEAR, PH_FILTER_BILINEAR, false},
                 {"mipmap", PH_FILTER_NEAREST, PH_FILTER_MIPMAP, false},
                 {"nearest", PH_FILTER_MIPMAP, PH_FILTER_NEAREST, false},
                 {"bilinear", PH_FILTER_MIPMAP, PH_FILTER_BILINEAR, false}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        fresh(NULL);
        shared.options.filter = cases[i].option;
        surface.filter = cases[i].file;
        surface.wrap = i & 3;
        surface.picture = row_of(greys, 4, false);
        make();
        assert_non_null(made.surface.texture);
        assert_ptr_equal(made.surface.texture->filter, cases[i].filter);
        assert_int_equal(made.surface.texture->wrap, i & 3);
        assert_true(made.can_tint && made.tint.blend->kind == PH_BLEND_TIMES && made.tint.blend->alpha == 32);
        assert_true(made.tint.shading == PH_SHADE_UNLIT && made.tint.depth_bias >= 8 && made.tint.texture == NULL);
        assert_int_equal(shared.note[0] != '\0', cases[i].is_noted);
        assert_true(surface.picture.picture.rgb == NULL && surface.picture.alpha == NULL); /* they are freed */
    }
}

static void what_a_texture_loses_is_noted(void **state)
{
    (void)state;
    surface.picture = row_of(greys, 3, false);
    make();
    assert_string_equal(shared.note, "texture a.png is resized from 3x1 to 4x1");
    fresh(NULL);
    surface.picture = row_of(greys, 4, false);
    surface.picture.height = 3; /* of the file */
    make();
    assert_string_equal(shared.note, "texture a.png is resized from 4x3 to 4x1");
    fresh(NULL);
    shared.arena.size = PH_RAMP_SIZE * 2 + sizeof(struct ph_texture) + 8;
    surface.picture = row_of(greys, 4, false);
    make();
    assert_null(made.surface.texture);
    assert_string_equal(shared.note, "texture a.png is left out: no memory");
    surface.mode = MODEL_BLEND, surface.alpha = .5; /* and no room for a blend */
    shared.arena.used = 0;
    surface.picture = row_of(greys, 4, false);
    assert_false(model_surface_make(&shared, &surface, &made));
    shared.arena.size = 0; /* nor for a ramp */
    assert_false(model_surface_make(&shared, &surface, &made));
}

/* Alphas 0, 64, 128, 255 of a texture: its green of 63 parts, times what is asked for. */
static const struct {
    uint8_t mode;
    double alpha, cutoff;
    enum { NONE, WHOLE, LAST, VARIES, BY_MASK } picture;
    int kind, strength; /* kind -1: none */
    int green;          /* of the second pixel; -1: no alphas */
} blends[] = {
    {MODEL_OPAQUE, .5, .5, VARIES, -1, 0, -1},
    {MODEL_BLEND, 1, .5, NONE, -1, 0, -1},
    {MODEL_BLEND, .5, .5, NONE, PH_BLEND_ALPHA, 16, -1},
    {MODEL_BLEND, -1, .5, NONE, PH_BLEND_ALPHA, 0, -1},
    {MODEL_BLEND, 1, .5, WHOLE, -1, 0, -1},
    {MODEL_BLEND, 1, .5, VARIES, PH_BLEND_ALPHA, 32, 16}, /* 64 of 255 of 63 */
    {MODEL_BLEND, 1.5, .5, VARIES, PH_BLEND_ALPHA, 32, 16},
    {MODEL_BLEND, .25, .5, VARIES, PH_BLEND_ALPHA, 8, 16},
    {MODEL_BLEND, 1, .5, BY_MASK, PH_BLEND_ALPHA, 32, 16},
    {MODEL_BLEND, 1, .5, LAST, PH_BLEND_ALPHA, 32, 63},
    {MODEL_MASK, 1, .5, NONE, -1, 0, -1},
    {MODEL_MASK, .5, .5, NONE, -1, 0, -1},
    {MODEL_MASK, .4, .5, NONE, PH_BLEND_ALPHA, 0, -1}, /* cut out as a whole */
    {MODEL_MASK, 1, .5, VARIES, PH_BLEND_MASK, 0, 16},
    {MODEL_MASK, 1, .25, VARIES, PH_BLEND_MASK, 0, 32}, /* what just shows becomes one half */
    {MODEL_MASK, .5, .25, VARIES, PH_BLEND_MASK, 0, 16},
    {MODEL_MASK, 1, 0, VARIES, -1, 0, -1},
};

static void alpha_chooses_the_blend(void **state)
{
    static const uint8_t pixels[][8] = {{0},
                                        {255, 255, 255, 255, 255, 255, 255, 255},
                                        {255, 255, 255, 255, 255, 255, 255, 251},
                                        {0, 64, 128, 255, 0, 0, 0, 255},
                                        {0, 64, 128, 255, 0, 0, 0, 255}};
    (void)state;
    for (size_t i = 0; i < sizeof blends / sizeof blends[0]; i++) {
        fresh(NULL);
        surface.mode = blends[i].mode, surface.alpha = blends[i].alpha, surface.cutoff = blends[i].cutoff;
        surface.wrap = PH_WRAP_CLAMP, surface.filter = PH_FILTER_BILINEAR;
        shared.options.filter = "file";
        if (blends[i].picture != NONE) {
            surface.picture = row_of(pixels[blends[i].picture % BY_MASK], 8, true);
            surface.picture.picture.width = 4, surface.picture.picture.height = 2;
        }
        if (blends[i].picture == BY_MASK) {
            surface.mask = row_of(pixels[BY_MASK], 8, true);
        }
        make();
        const struct ph_blend *b = made.surface.blend;
        assert_int_equal(b != NULL ? b->kind : -1, blends[i].kind);
        assert_int_equal(b != NULL ? b->alpha : 0, blends[i].strength);
        assert_int_equal(b != NULL && b->alphas != NULL, blends[i].green >= 0);
        assert_int_equal(made.can_tint, b == NULL && made.surface.texture != NULL);
        assert_true(b == NULL || b->draw == (b->alphas != NULL ? ph_draw_blended_alphas : ph_draw_blended));
        if (blends[i].green >= 0) {
            unsigned c[3];
            channels_of(b->alphas->texels[1], c);
            assert_int_equal(c[1], blends[i].green);
            assert_true(c[0] == c[1] / 2 && c[2] == c[0]);
            channels_of(b->alphas->texels[7], c);
            assert_int_equal(c[1], blends[i].picture == LAST ? 62 : 63);
            assert_true(b->alphas->wrap == PH_WRAP_CLAMP && b->alphas->filter == PH_FILTER_BILINEAR);
        }
    }
}

static void emission_of_what_has_a_texture_is_drawn_over_it(void **state)
{
    (void)state;
    memcpy(surface.glow, (uint8_t[3]){8, 16, 0}, 3);
    surface.two_sided = true, surface.mode = MODEL_BLEND;
    surface.picture = row_of(greys, 4, true);
    make();
    assert_true(made.glows && made.glow.shading == PH_SHADE_UNLIT && made.glow.two_sided && made.glow.texture == NULL);
    assert_int_equal(made.glow.colour, ph_rgb565(8, 16, 0));
    assert_int_equal(made.glow.depth_bias, 8);
    assert_ptr_equal(made.glow.ramp, made.surface.ramp);
    assert_true(made.glow.blend->kind == PH_BLEND_ADD && made.glow.blend->alpha == 32);
    assert_ptr_equal(made.glow.blend->draw, ph_draw_blended_alphas);
    assert_ptr_equal(made.glow.blend->alphas, made.surface.blend->alphas);
    fresh(NULL);
    surface.glow[2] = 1;
    surface.glowing = row_of(greys, 4, false); /* a picture of emission, and no other */
    make();
    assert_true(made.glows && made.glow.texture->log2_width == 2 && made.glow.blend->alphas == NULL);
    assert_null(made.surface.texture);
    assert_null(surface.glowing.picture.rgb);
    fresh(NULL);
    surface.picture = row_of(greys, 4, false); /* it emits nothing */
    make();
    assert_false(made.glows);
}

static void a_picture_of_the_options_takes_the_place_of_the_files(void **state)
{
    uint8_t rgb[] = {255, 0, 0, 0, 255, 0};
    const struct ppm two = {2, 1, rgb};
    size_t n;
    uint8_t *bytes = png_out_bytes(&two, &n);
    (void)state;
    assert_true(model_surface_take_texture(&shared));
    assert_null(shared.texture);
    shared.options.texture = file_bytes("two.png", bytes, n);
    free(bytes);
    if (!model_surface_take_texture(&shared) && strstr(shared.error, "without libpng") != NULL) {
        skip();
    }
    assert_true(shared.texture->log2_width == 1 && shared.texture->texels[1] == ph_rgb565(0, 255, 0));
    surface.mode = MODEL_BLEND;
    surface.picture = row_of(greys, 4, true); /* its alpha does not count */
    make();
    assert_ptr_equal(made.surface.texture, shared.texture);
    assert_null(made.surface.blend);
    shared.texture = NULL;
    shared.arena.size = shared.arena.used + sizeof(struct ph_texture);
    assert_false(model_surface_take_texture(&shared));
    assert_non_null(strstr(shared.error, "two.png: it is too large"));
    shared.options.texture = file_path("no.png");
    assert_false(model_surface_take_texture(&shared));
    assert_non_null(strstr(shared.error, "no.png: it cannot be opened"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_channel_is_rounded_and_clamped),
        cmocka_unit_test_setup(a_mask_cuts_out_what_is_seldom_between, fresh),
        cmocka_unit_test_setup(a_plain_surface_is_lit_by_its_ramp, fresh),
        cmocka_unit_test_setup(emission_is_added_to_the_ramp, fresh),
        cmocka_unit_test(any_channel_glows),
        cmocka_unit_test_setup(the_option_or_the_file_chooses_the_filter, fresh),
        cmocka_unit_test_setup(what_a_texture_loses_is_noted, fresh),
        cmocka_unit_test_setup(alpha_chooses_the_blend, fresh),
        cmocka_unit_test_setup(emission_of_what_has_a_texture_is_drawn_over_it, fresh),
        cmocka_unit_test_setup(a_picture_of_the_options_takes_the_place_of_the_files, fresh),
    };
    return cmocka_run_group_tests(tests, files_begin, files_end);
}
