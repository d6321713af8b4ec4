/*
 * Cut-outs, blending, fog and vertex colours against a reference in double precision: rays through pixel centres meet
 * quads that lean any way. What is left out, how colours mix and in which order, and which distance fog sees, are
 * computed there from the definitions in render.h; nothing of firmware/ is used but its inputs.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "ref_random.h"
#include "ref_rig.h"
#include "surface_row.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { W = 96, H = 80, TEXELS = 16, QUADS = 6 };

#define NEAR_Z  .5
#define FAR_Z   24.
#define TANGENT .8 /* of half the field of view, vertically */

/* A quad o + u U + v V, u and v in 0 .. 1; in view space, the camera looks along -z. */
struct quad {
    double o[3], u[3], v[3];
    bool two_sided, textured, coloured;
    uint16_t colour;              /* as a number */
    uint16_t corners[4];          /* coloured: at (0, 0), (1, 0), (1, 1), (0, 1), as numbers */
    const struct ph_blend *blend; /* NULL: opaque */
};

struct scene {
    struct quad quads[QUADS];
    int count;
    bool fogged, without_linear_w;
    uint16_t background, fog_colour;
    double fog_start, fog_end;
    uint16_t texels[TEXELS * TEXELS], alphas[TEXELS * TEXELS]; /* as numbers */
    uint16_t wire[2][TEXELS * TEXELS];
    struct ph_texture texture, alpha_texture;
};

static uint16_t wire(uint16_t v)
{
    return (uint16_t)(v << 8 | v >> 8);
}

static uint16_t any_colour(void)
{
    return (uint16_t)(ref_uniform(0, 1) * 65535);
}

/* ---- the reference ---------------------------------------------------------------------------------------------- */

struct hit {
    double z, rgb[3], key[3];
    bool front, sure; /* not on a border of quad, texel or corner's triangle */
};

static void channels(uint16_t v, double rgb[3])
{
    rgb[0] = (v >> 11) / 31.;
    rgb[1] = (v >> 5 & 63) / 63.;
    rgb[2] = (v & 31) / 31.;
}

static double det(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Colour by the corners of the half of the quad in which (u, v) lies. */
static void corner_colour(const struct quad *q, double u, double v, double rgb[3])
{
    double c[4][3];
    for (int i = 0; i < 4; i++) {
        channels(q->corners[i], c[i]);
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = u > v ? c[0][k] + u * (c[1][k] - c[0][k]) + v * (c[2][k] - c[1][k])
                       : c[0][k] + v * (c[3][k] - c[0][k]) + u * (c[2][k] - c[3][k]);
    }
}

/* Where the ray q through a pixel meets a quad. */
static bool meet(const struct scene *s, const struct quad *q, const double ray[3], struct hit *h)
{
    const double minus[3] = {-ray[0], -ray[1], -ray[2]}, volume = det(q->u, q->v, minus);
    const double from[3] = {-q->o[0], -q->o[1], -q->o[2]};
    const double u = det(from, q->v, minus) / volume, v = det(q->u, from, minus) / volume;
    const double t = det(q->u, q->v, from) / volume, margin = .02;
    h->z = t;
    h->front = volume > 0;
    h->sure = u > margin && v > margin && u < 1 - margin && v < 1 - margin;
    if (u < -margin || v < -margin || u > 1 + margin || v > 1 + margin || (!h->front && !q->two_sided) ||
        t < NEAR_Z - .05 || t > FAR_Z + .5) {
        return false;
    }
    h->sure &= fabs(t - NEAR_Z) > .05 && fabs(t - FAR_Z) > .5;
    channels(q->colour, h->rgb);
    if (q->coloured) {
        corner_colour(q, u, v, h->rgb);
        h->sure &= fabs(u - v) > margin;
    }
    if (q->textured || (q->blend != NULL && q->blend->alphas != NULL)) {
        const double x = u * TEXELS, y = v * TEXELS, border = .12;
        const int at = ((int)floor(y) & (TEXELS - 1)) * TEXELS + ((int)floor(x) & (TEXELS - 1));
        h->sure &= fabs(x - round(x)) > border && fabs(y - round(y)) > border;
        if (q->textured) {
            channels(s->texels[at], h->rgb);
        }
        channels(q->blend != NULL && q->blend->kind == PH_BLEND_KEY ? s->texels[at] : s->alphas[at], h->key);
    }
    return true;
}

static double alpha_of(const struct quad *q, const struct hit *h)
{
    const struct ph_blend *const b = q->blend;
    double key[3];
    channels(wire(b->key), key);
    switch (b->kind) {
    case PH_BLEND_KEY:
        return q->textured && key[0] == h->key[0] && key[1] == h->key[1] && key[2] == h->key[2] ? 0 : 1;
    case PH_BLEND_MASK:
        return b->alphas != NULL && h->key[1] < .5 ? 0 : 1;
    default:
        return b->alpha / 32. * (b->alphas != NULL ? h->key[1] : 1);
    }
}

static double fog_at(const struct scene *s, double z)
{
    const double share = (z - s->fog_start) / (s->fog_end - s->fog_start);
    return !s->fogged || share < 0 ? 0 : share > 1 ? 1 : share;
}

/* A pixel's colour; false where it is not sure. layers: how many roundings it takes. */
static bool expected(const struct scene *s, int x, int y, double rgb[3], int *layers)
{
    const double ray[3] = {(x + .5 - W / 2.) / (H / 2.) * TANGENT, (H / 2. - y - .5) / (H / 2.) * TANGENT, -1};
    double fog[3], depth = INFINITY;
    bool sure = true;
    channels(s->background, rgb);
    channels(s->fog_colour, fog);
    *layers = 1;
    for (int pass = 0; pass < 6; pass++) { /* opaque; cut-outs; fog; blended, far sides and near sides quad by quad */
        if (pass == 2 && depth < INFINITY) {
            for (int k = 0; k < 3; k++) {
                rgb[k] += fog_at(s, depth) * (fog[k] - rgb[k]);
            }
        }
        for (int i = 0; i < s->count && (pass < 2 || pass == 3); i++) {
            const struct quad *const q = &s->quads[i];
            const int kind = q->blend == NULL ? 0 : q->blend->kind < PH_BLEND_ALPHA ? 1 : 3;
            struct hit h;
            if (kind != pass || !meet(s, q, ray, &h)) {
                continue;
            }
            const bool times = pass == 1 && q->blend->kind == PH_BLEND_TIMES, same = times && fabs(h.z - depth) < 1e-6;
            sure &= h.sure && (same || fabs(h.z - depth) > .05);
            const double a = pass == 0 ? 1 : alpha_of(q, &h), f = fog_at(s, h.z);
            if ((h.z > depth && !same) || a == 0) {
                continue;
            }
            depth = pass < 2 && !times ? h.z : depth;
            for (int k = 0; k < 3 && pass < 2; k++) {
                rgb[k] = times ? rgb[k] * (1 - a + a * h.rgb[k]) : h.rgb[k];
            }
            for (int k = 0; k < 3 && pass == 3; k++) {
                const bool adds = q->blend->kind == PH_BLEND_ADD;
                const double colour = h.rgb[k] + f * ((adds ? 0 : fog[k]) - h.rgb[k]);
                rgb[k] = adds ? fmin(rgb[k] + a * colour, 1) : rgb[k] + a * (colour - rgb[k]);
            }
            *layers += pass == 3 || times;
        }
    }
    return sure;
}

/* ---- the renderer ----------------------------------------------------------------------------------------------- */

static void draw_quad(struct scene *s, struct rig *rig, const struct quad *q)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int along[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    struct fx_vec3 p[4];
    uint16_t colours[4];
    static fx_t uvs[4][2];
    for (int i = 0; i < 4; i++) {
        double at[3];
        for (int k = 0; k < 3; k++) {
            at[k] = q->o[k] + along[i][0] * q->u[k] + along[i][1] * q->v[k];
        }
        p[i] = (struct fx_vec3){ref_q16(at[0]), ref_q16(at[1]), ref_q16(at[2])};
        uvs[i][0] = along[i][0] * FX_ONE;
        uvs[i][1] = along[i][1] * FX_ONE;
        colours[i] = wire(q->corners[i]);
    }
    static struct ph_material materials[QUADS]; /* they stay until the bands are drawn */
    struct ph_material *const m = &materials[q - s->quads];
    *m = (struct ph_material){.shading = q->textured ? PH_SHADE_TEXTURE : PH_SHADE_UNLIT,
                              .two_sided = q->two_sided,
                              .colour = wire(q->colour),
                              .texture = &s->texture,
                              .blend = q->blend};
    const struct ph_part part = {.count = 2};
    const struct ph_mesh mesh = {.positions = p,
                                 .uvs = (const fx_t(*)[2])uvs,
                                 .triangles = triangles,
                                 .parts = &part,
                                 .materials = m,
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1,
                                 .colours = q->coloured ? colours : NULL};
    const struct ph_xform place = ph_xform_translate(0, 0, 0);
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &place), PH_OK);
}

static void draw(struct scene *s, struct rig *rig)
{
    struct ph_projection lens;
    const struct ph_xform view = ph_xform_translate(0, 0, 0);
    const struct ph_fog fog = {wire(s->fog_colour), ref_q16(s->fog_start), ref_q16(s->fog_end)};
    assert_int_equal(ph_projection_frustum(&lens, ref_q16(-NEAR_Z * TANGENT * W / H), ref_q16(NEAR_Z * TANGENT * W / H),
                                           ref_q16(-NEAR_Z * TANGENT), ref_q16(NEAR_Z * TANGENT), ref_q16(NEAR_Z),
                                           ref_q16(FAR_Z)),
                     PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &view, &lens, NULL, wire(s->background)), PH_OK);
    if (s->fogged) {
        assert_int_equal(ph_frame_fog(&rig->r, &fog), PH_OK);
    }
    for (int i = 0; i < s->count; i++) {
        draw_quad(s, rig, &s->quads[i]);
    }
    assert_true(rig_finish(rig));
    assert_int_equal(rig->r.stats.triangles_dropped, 0);
}

static void set_texels(struct scene *s)
{
    for (int i = 0; i < TEXELS * TEXELS; i++) {
        s->texels[i] = ref_uniform(0, 1) < .4 ? 0xf81f : any_colour();
        s->alphas[i] = any_colour();
        s->wire[0][i] = wire(s->texels[i]);
        s->wire[1][i] = wire(s->alphas[i]);
    }
    s->texture = (struct ph_texture){.texels = s->wire[0], .log2_width = 4, .log2_height = 4};
    s->alpha_texture = (struct ph_texture){.texels = s->wire[1], .log2_width = 4, .log2_height = 4};
}

/* A quad that fills much of the picture and leans any way. */
static void lean(struct quad *q, double distance)
{
    const double size = distance * 1.4;
    for (int k = 0; k < 3; k++) {
        const double more = k == 2 ? .35 : .1;
        q->u[k] = size * ((k == 0) + ref_uniform(-more, more));
        q->v[k] = size * ((k == 1) + ref_uniform(-more, more));
    }
    for (int k = 0; k < 3; k++) {
        q->o[k] = (k == 2 ? -distance : 0) - .5 * (q->u[k] + q->v[k]) + (k == 2 ? 0 : ref_uniform(-.2, .2) * distance);
    }
}

/* Largest difference in steps of a channel (31 or 63); counts the pixels that are compared, and those of one picture
 * with others'. */
static double compare(struct scene *s, const struct rig *rig, double *share, int *most_layers)
{
    double worst = 0;
    int sure = 0;
    for (int y = 0; y < H; y++) {
        for (int x = 0; x < W; x++) {
            double rgb[3], got[3];
            int layers;
            if (!expected(s, x, y, rgb, &layers)) {
                continue;
            }
            sure++;
            *most_layers = layers > *most_layers ? layers : *most_layers;
            channels(wire(rig->pixels[y * W + x]), got);
            for (int k = 0; k < 3; k++) {
                const double steps = fabs(got[k] - rgb[k]) * 31 / layers;
                worst = steps > worst ? steps : worst;
            }
        }
    }
    *share = (double)sure / (W * H);
    return worst;
}

static void check(const char *surface, struct scene *s, double bound)
{
    double worst = 0, least = 1;
    int layers = 0;
    for (int f = 1; f < PH_DEPTH_FORMATS; f++) {
        const struct ph_depth_format *const format = ph_depth_formats[f];
        if (s->without_linear_w && format == PH_DEPTH_LINEAR_W) {
            continue;
        }
        for (int band = 0; band < 2; band++) {
            struct rig rig;
            double share;
            rig_open(&rig, W, H, band == 0 ? 7 : H, format, 64, 128);
            draw(s, &rig);
            const double error = compare(s, &rig, &share, &layers);
            worst = error > worst ? error : worst;
            least = share < least ? share : least;
            rig_close(&rig);
        }
    }
    printf("    %d layers, %.0f %% of the pixels compared\n", layers, 100 * least);
    assert_true(surface_row(surface, "most, of 31, a layer", worst, bound));
    assert_true(least > .2 && layers > 0);
}

/* ---- the tests -------------------------------------------------------------------------------------------------- */

static void begin(struct scene *s, int seed)
{
    (void)seed;
    memset(s, 0, sizeof *s);
    set_texels(s);
    s->background = 0x2945;
    s->count = 1;
    s->quads[0].colour = 0x3e0f;
    lean(&s->quads[0], 9);
}

static void cut_outs_show_what_is_behind_their_key_and_hide_it_elsewhere(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend key = {.draw = ph_draw_blended, .kind = PH_BLEND_KEY},
                           mask = {.draw = ph_draw_blended_alphas, .kind = PH_BLEND_MASK};
    for (int i = 0; i < 4; i++) {
        begin(&s, i);
        key.key = wire(0xf81f);
        mask.alphas = &s.alpha_texture;
        s.count = 4;
        lean(&s.quads[1], 3);
        lean(&s.quads[2], 5);
        lean(&s.quads[3], 7); /* opaque, drawn last: it is hidden where they are not cut out */
        s.quads[1].textured = true;
        s.quads[2].textured = i % 2 == 0; /* a colour has a mask, too */
        s.quads[1].blend = &key;
        s.quads[2].blend = &mask;
        s.quads[3].colour = 0xffff;
        check("cut-out by key and by mask", &s, .51);
    }
}

static void blended_quads_mix_with_what_is_behind_in_the_order_of_the_calls(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend blends[4];
    for (int i = 0; i < 4; i++) {
        begin(&s, i);
        s.count = 6;
        for (int k = 0; k < 4; k++) {
            struct quad *const q = &s.quads[k + 1];
            blends[k] = (struct ph_blend){.draw = ph_draw_blended_alphas,
                                          .kind = k == 2 ? PH_BLEND_ADD : PH_BLEND_ALPHA,
                                          .alpha = (uint8_t)(k == 1 ? 32 : 8 + 5 * k),
                                          .alphas = k == 1 || k == 2 ? &s.alpha_texture : NULL};
            lean(q, 7 - k * 1.3);
            q->textured = (k == 1 || k == 2) && i % 2 == 0; /* a colour has alphas, too: so a sprite glows */
            q->colour = any_colour();
            q->blend = &blends[k];
        }
        lean(&s.quads[5], 4.5); /* opaque, among them and drawn last */
        s.quads[5].colour = 0x8410;
        check("blending: alpha, per texel, additive", &s, .8);
    }
}

static void fog_hides_by_distance_in_every_depth_format(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16},
                           glow = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 30};
    for (int i = 0; i < 4; i++) {
        begin(&s, i);
        s.fogged = true;
        s.fog_colour = any_colour();
        s.fog_start = ref_uniform(1, 4);
        s.fog_end = ref_uniform(8, 14);
        s.count = 4;
        lean(&s.quads[1], 8);
        s.quads[1].colour = any_colour();
        lean(&s.quads[2], 4);
        s.quads[2].blend = &glass;
        s.quads[2].colour = any_colour();
        lean(&s.quads[3], 6.5);
        s.quads[3].blend = &glow;
        s.quads[3].colour = any_colour();
        check("fog, on opaque and blended", &s, 1.1);
    }
}

/* A quad that faces the camera: on the screen its colours are linear. */
static void corners_give_their_colours(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 20};
    for (int i = 0; i < 4; i++) {
        begin(&s, i);
        s.count = 3;
        for (int q = 1; q < 3; q++) {
            const double distance = 6 - q, size = i == 3 ? 500 : 2 + i; /* 3: it leaves the guard band */
            const double o[3] = {-size * (i == 3 ? .7 : .5) + q * .3, -size / 2, -distance}, u[3] = {size, 0, 0},
                         v[3] = {0, size, 0};
            memcpy(s.quads[q].o, o, sizeof o);
            memcpy(s.quads[q].u, u, sizeof u);
            memcpy(s.quads[q].v, v, sizeof v);
            s.quads[q].coloured = true;
            for (int k = 0; k < 4; k++) {
                s.quads[q].corners[k] = any_colour();
            }
        }
        s.quads[2].blend = i % 2 != 0 ? &glass : NULL;
        for (int k = 1; k < PH_DEPTH_FORMATS - 1; k++) { /* all but linear-w */
            struct rig rig;
            double share;
            int layers = 0;
            rig_open(&rig, W, H, 11, ph_depth_formats[k], 64, 128);
            draw(&s, &rig);
            const double worst = compare(&s, &rig, &share, &layers);
            assert_true(share > .2);
            assert_true(surface_row("vertex colours, opaque and blended", "most, of 31", worst, .8));
            rig_close(&rig);
        }
    }
}

/* The quad q with its texture, and once more with these colours. */
static void colour_texture(struct scene *s, const struct quad *q, const struct ph_blend *times,
                           const uint16_t corners[4])
{
    s->quads[1] = s->quads[2] = *q;
    s->quads[1].textured = true;
    s->quads[2].textured = false;
    s->quads[2].coloured = true;
    s->quads[2].blend = times;
    memcpy(s->quads[2].corners, corners, sizeof s->quads[2].corners);
}

/* The colours of a square that faces the camera are linear on the screen. One that leans has the same colour at all
 * corners: so it is seen whether both have the same depth. Glass comes after the fog. */
static void colours_of_corners_multiply_textures(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend times = {.draw = ph_draw_blended, .kind = PH_BLEND_TIMES},
                           glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 8};
    for (int i = 0; i < 8; i++) {
        const double size = 4 + .5 * i;
        struct quad q = {.o = {-size * .45, -size * .55, -5}, .u = {size, 0, 0}, .v = {0, size, 0}};
        uint16_t corners[4] = {any_colour(), any_colour(), any_colour(), any_colour()};
        begin(&s, i);
        times.alpha = (uint8_t)(i % 4 == 2 ? 19 : 32);
        s.count = 4;
        s.fogged = i % 2 != 0;
        s.fog_colour = any_colour();
        s.fog_start = 2;
        s.fog_end = 14;
        s.without_linear_w = i < 4;
        if (i >= 4) {
            lean(&q, 5);
            corners[1] = corners[2] = corners[3] = corners[0];
        }
        colour_texture(&s, &q, &times, corners);
        lean(&s.quads[3], 2.5);
        s.quads[3].blend = &glass;
        s.quads[3].colour = any_colour();
        check("texture times vertex colours, also in fog", &s, .8);
    }
    static const uint16_t white[4] = {0xffff, 0xffff, 0xffff, 0xffff};
    const struct quad far_one = s.quads[1];
    begin(&s, 0);
    s.count = 3;
    times.alpha = 32;
    colour_texture(&s, &far_one, &times, white);
    check("texture times white", &s, 0);
}

/* A cube of glass, drawn in one call: of each ray the far side comes first. */
static void convex_mesh_is_blended_from_its_far_side_to_its_near_side(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    static const uint16_t faces[2][3] = {{0, 1, 2}, {3, 5, 4}}; /* near one first, then a far one that faces away */
    static const struct fx_vec3 p[6] = {{-FX_ONE, -FX_ONE, -FX_INT(3)}, {FX_ONE, -FX_ONE, -FX_INT(3)},
                                        {0, FX_ONE, -FX_INT(3)},        {-FX_ONE, -FX_ONE, -FX_INT(4)},
                                        {FX_ONE, -FX_ONE, -FX_INT(4)},  {0, FX_ONE, -FX_INT(4)}};
    static const uint16_t colours[6] = {0x00f8, 0x00f8, 0x00f8, 0x1f00, 0x1f00, 0x1f00}; /* red before blue */
    struct rig rig;
    begin(&s, 0);
    s.count = 0;
    s.background = 0;
    rig_open(&rig, W, H, H, PH_DEPTH_FIXED16, 64, 128);
    draw(&s, &rig);
    const struct ph_material m = {.two_sided = 1, .blend = &glass};
    const struct ph_part part = {.count = 2};
    const struct ph_mesh mesh = {.positions = p,
                                 .triangles = faces,
                                 .parts = &part,
                                 .materials = &m,
                                 .vertex_count = 6,
                                 .triangle_count = 2,
                                 .part_count = 1,
                                 .colours = colours};
    const struct ph_xform place = ph_xform_translate(0, 0, 0), view = place;
    struct ph_projection lens;
    ph_projection_perspective(&lens, FX_INT(60), FX_ONE * W / H, FX_HALF, FX_INT(20));
    assert_int_equal(ph_frame_begin(&rig.r, &view, &lens, NULL, 0), PH_OK);
    assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &place), PH_OK);
    assert_true(rig_finish(&rig));
    double rgb[3];
    channels(wire(rig.pixels[(H / 2) * W + W / 2]), rgb);
    printf("    red %.2f, blue %.2f\n", rgb[0], rgb[2]);
    assert_true(fabs(rgb[0] - .5) < .03 && fabs(rgb[2] - .25) < .03);
    rig_close(&rig);
}

/* A quad of any size, anywhere, also beyond the picture; or one that faces the camera, as wide as small triangles are.
 */
static void scatter(struct quad *q, const struct ph_blend *blend)
{
    const double distance = ref_uniform(2, 12), size = distance * exp(ref_uniform(-4, .5)), px = 2 * TANGENT / H;
    const bool faces = ref_uniform(0, 1) < .5;
    for (int k = 0; k < 3; k++) {
        q->u[k] = faces ? (k == 0) * ref_uniform(30.5, 32) * px * distance : size * ref_uniform(-1, 1);
        q->v[k] = faces ? (k == 1) * ref_uniform(8, 32) * px * distance : size * ref_uniform(-1, 1);
        q->o[k] = k == 2 ? -distance : ref_uniform(-.9, .9) * distance;
    }
    q->blend = blend;
    q->two_sided = true;
    q->textured = ref_uniform(0, 1) < .5;
    q->coloured = !q->textured && ref_uniform(0, 1) < .5;
    q->colour = any_colour();
    for (int i = 0; i < 4; i++) {
        q->corners[i] = any_colour();
    }
}

/* Blended triangles are drawn in the same way whether all of one fits into the memory for its rows or one row does. */
static void the_memory_for_rows_changes_no_byte(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend blends[PH_BLEND_ADD + 1];
    static const int bands[3] = {H, 16, 5}, triangles[3] = {4096, 1200, 60};
    uint32_t rows_seen = 0;
    for (int round = 0; round < 600; round++) {
        struct rig rig[3];
        begin(&s, round);
        s.count = QUADS;
        s.fogged = ref_uniform(0, 1) < .4;
        s.fog_start = 2;
        s.fog_end = 10;
        s.texture.wrap = s.alpha_texture.wrap = (uint8_t)(round & 3); /* enum ph_wrap */
        for (int i = 1; i < QUADS; i++) {
            const int kind = (int)ref_uniform(0, PH_BLEND_ADD + .999);
            blends[kind] = (struct ph_blend){
                .draw = ph_draw_blended_alphas, .kind = (uint8_t)kind, .alpha = 20, .key = wire(0xf81f)};
            blends[kind].alphas = kind != PH_BLEND_KEY && ref_uniform(0, 1) < .5 ? &s.alpha_texture : NULL;
            scatter(&s.quads[i], &blends[kind]);
        }
        for (int i = 0; i < 3; i++) {
            rig_open(&rig[i], W, H, bands[i], ph_depth_formats[round % PH_DEPTH_FORMATS], 64, triangles[i]);
            memset(rig[i].triangles, 0x55 * i, (size_t)triangles[i] * ph_triangle_bytes); /* what it held before */
            draw(&s, &rig[i]);
            rows_seen |= 1u << rig[i].r.rows;
            assert_memory_equal(rig[i].pixels, rig[0].pixels, W * H * sizeof(uint16_t));
            assert_memory_equal(rig[i].depth, rig[0].depth, W * H * sizeof(uint32_t));
        }
        for (int i = 0; i < 3; i++) {
            rig_close(&rig[i]);
        }
    }
    assert_int_equal(rows_seen, 1 << 1 | 1 << 2 | 1 << 4);
}

/* Without room for its rows a blended triangle is left out and counted; all else is drawn. */
static void without_room_it_is_left_out_and_counted(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
    struct rig rig;
    begin(&s, 0);
    s.count = 2;
    lean(&s.quads[1], 3);
    s.quads[1].blend = &glass;
    rig_open(&rig, 2 * W, H, H, PH_DEPTH_FIXED16, 8, 14);
    const struct ph_xform view = ph_xform_translate(0, 0, 0);
    struct ph_projection lens;
    ph_projection_perspective(&lens, FX_INT(60), FX_ONE, FX_HALF, FX_INT(20));
    assert_int_equal(ph_frame_begin(&rig.r, &view, &lens, NULL, 0), PH_OK);
    draw_quad(&s, &rig, &s.quads[0]);
    draw_quad(&s, &rig, &s.quads[1]);
    assert_int_equal(rig.r.stats.triangles_drawn + rig.r.stats.triangles_dropped, 4);
    assert_int_equal(rig.r.stats.triangles_dropped, 2);
    assert_true(rig_finish(&rig));
    rig_close(&rig);
}

/* A blend that does not name the function that draws it is left out, too, whatever is drawn before and after it. */
static void without_its_function_it_is_left_out_and_counted(void **state)
{
    (void)state;
    static struct scene s;
    static struct ph_blend mask, forgotten = {.kind = PH_BLEND_ALPHA, .alpha = 16};
    const struct ph_blend textured = {.draw = ph_draw_blended, .kind = PH_BLEND_MASK, .alphas = &s.alpha_texture};
    struct rig with, without;
    begin(&s, 0);
    lean(&s.quads[1], 3);
    lean(&s.quads[2], 2);
    lean(&s.quads[3], 2.5); /* a colour, whose alphas take the other one */
    mask = textured;
    s.quads[1].textured = true;
    s.quads[1].blend = s.quads[3].blend = &mask;
    s.quads[2].blend = &forgotten;
    rig_open(&with, W, H, 8, PH_DEPTH_FIXED16, 64, 128);
    rig_open(&without, W, H, 8, PH_DEPTH_FIXED16, 64, 128);
    const struct ph_xform view = ph_xform_translate(0, 0, 0);
    struct ph_projection lens;
    ph_projection_perspective(&lens, FX_INT(60), FX_ONE, FX_HALF, FX_INT(20));
    assert_int_equal(ph_frame_begin(&with.r, &view, &lens, NULL, 0), PH_OK);
    assert_int_equal(ph_frame_begin(&without.r, &view, &lens, NULL, 0), PH_OK);
    for (int i = 0; i < 4; i++) {
        draw_quad(&s, &with, &s.quads[i]);
    }
    mask.draw = ph_draw_blended_alphas;
    for (int i = 0; i < 2; i++) {
        draw_quad(&s, &without, &s.quads[i]);
    }
    mask.draw = ph_draw_blended;
    assert_int_equal(with.r.stats.triangles_dropped, 4);
    assert_int_equal(without.r.stats.triangles_dropped, 0);
    assert_true(rig_finish(&with) && rig_finish(&without));
    assert_memory_equal(with.pixels, without.pixels, W * H * sizeof(uint16_t));
    rig_close(&with);
    rig_close(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_outs_show_what_is_behind_their_key_and_hide_it_elsewhere),
        cmocka_unit_test(blended_quads_mix_with_what_is_behind_in_the_order_of_the_calls),
        cmocka_unit_test(fog_hides_by_distance_in_every_depth_format),
        cmocka_unit_test(corners_give_their_colours),
        cmocka_unit_test(colours_of_corners_multiply_textures),
        cmocka_unit_test(convex_mesh_is_blended_from_its_far_side_to_its_near_side),
        cmocka_unit_test(the_memory_for_rows_changes_no_byte),
        cmocka_unit_test(without_room_it_is_left_out_and_counted),
        cmocka_unit_test(without_its_function_it_is_left_out_and_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
