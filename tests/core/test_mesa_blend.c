/*
 * Mesa's software renderer (OSMesa) draws a cut-out before a leaning wall, two panes of glass and fog: a second
 * opinion, by other people, on what render.h says of blending, cut-outs and fog. Pixels at which texels or edges meet
 * may differ; all others agree within two steps of 1/31.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "mesa.h"
#include "ref_rig.h"

#include <math.h>
#include <stdio.h>

enum { W = 128, H = 96, SIDE = 16, QUADS = 4 };

#define KEY     0x1ff8
#define NEAR_Z  .5
#define FAR_Z   16.
#define TANGENT .5

/* Corners counter-clockwise from the lower left; colour; how it is drawn. */
struct quad {
    double p[4][3];
    uint8_t rgb[3];
    const struct ph_blend *blend;
};

static const struct ph_blend cut = {.draw = ph_draw_blended, .kind = PH_BLEND_KEY, .key = KEY};
static const struct ph_blend glass = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 12};
static const struct ph_blend glow = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 16};

static const struct quad quads[QUADS] = {
    {{{-5, -4, -6}, {5, -4, -6}, {5, 4, -12}, {-5, 4, -12}}, {206, 130, 66}, NULL},
    {{{-2, -1, -4}, {.5, -1, -3}, {.5, 1, -3}, {-2, 1, -4}}, {255, 255, 255}, &cut},
    {{{-1, -.8, -3.5}, {1.2, -.8, -5}, {1.2, 1, -5}, {-1, 1, -3.5}}, {66, 130, 255}, &glass},
    {{{-1.5, -2, -4.2}, {2, -2, -4.2}, {2, .5, -5.5}, {-1.5, .5, -5.5}}, {99, 32, 16}, &glow},
};
static const double uv[4][2] = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
static const uint8_t fog_rgb[3] = {99, 101, 123};
static const double fog_start = 2.5, fog_end = 10;

/* A texel is the key, or a colour. */
static bool texel(int i, uint8_t rgb[3])
{
    rgb[0] = (uint8_t)(i * 37);
    rgb[1] = (uint8_t)(i * 91);
    rgb[2] = (uint8_t)(i * 13);
    return (i / SIDE / 2 + i % SIDE / 3) % 2 == 0;
}

/* ---- Mesa ------------------------------------------------------------------------------------------------------- */

static void gl_begin(bool fogged)
{
    static uint8_t texels[SIDE * SIDE][4];
    const float fog[4] = {fog_rgb[0] / 255.f, fog_rgb[1] / 255.f, fog_rgb[2] / 255.f, 1};
    for (int i = 0; i < SIDE * SIDE; i++) {
        texels[i][3] = texel(i, texels[i]) ? 255 : 0;
    }
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, SIDE, SIDE, 0, GL_RGBA, GL_UNSIGNED_BYTE, texels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
    glMatrixMode(GL_PROJECTION);
    glLoadIdentity();
    glFrustum(-NEAR_Z * TANGENT * W / H, NEAR_Z * TANGENT * W / H, -NEAR_Z * TANGENT, NEAR_Z * TANGENT, NEAR_Z, FAR_Z);
    glClearColor(fog[0], fog[1], fog[2], 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glFogi(GL_FOG_MODE, GL_LINEAR);
    glFogf(GL_FOG_START, (float)fog_start);
    glFogf(GL_FOG_END, (float)fog_end);
    glHint(GL_FOG_HINT, GL_NICEST);
    (fogged ? glEnable : glDisable)(GL_FOG);
}

static void gl_quad(const struct quad *q)
{
    static const float black[4] = {0, 0, 0, 1};
    const float fog[4] = {fog_rgb[0] / 255.f, fog_rgb[1] / 255.f, fog_rgb[2] / 255.f, 1};
    const bool cuts = q->blend == &cut, blends = q->blend != NULL && !cuts, adds = q->blend == &glow;
    (cuts ? glEnable : glDisable)(GL_ALPHA_TEST);
    (cuts ? glEnable : glDisable)(GL_TEXTURE_2D);
    (blends ? glEnable : glDisable)(GL_BLEND);
    glAlphaFunc(GL_GREATER, .5f);
    glBlendFunc(GL_SRC_ALPHA, adds ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    glDepthMask(blends ? GL_FALSE : GL_TRUE);
    glFogfv(GL_FOG_COLOR, adds ? black : fog);
    glColor4f(q->rgb[0] / 255.f, q->rgb[1] / 255.f, q->rgb[2] / 255.f, blends ? (float)q->blend->alpha / 32.f : 1);
    glBegin(GL_QUADS);
    for (int i = 0; i < 4; i++) {
        glTexCoord2d(uv[i][0], uv[i][1]);
        glVertex3dv(q->p[i]);
    }
    glEnd();
}

/* ---- ours ------------------------------------------------------------------------------------------------------- */

static fx_t q16(double v)
{
    return (fx_t)lrint(v * 65536);
}

static void draw_quad(struct ph_renderer *r, const struct quad *q)
{
    static const uint16_t triangles[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part all = {.count = 2};
    static uint16_t texels[SIDE * SIDE];
    static const struct ph_texture texture = {.texels = texels, .log2_width = 4, .log2_height = 4};
    static struct ph_material materials[QUADS];
    static fx_t uvs[4][2];
    struct fx_vec3 p[4];
    for (int i = 0; i < 4; i++) {
        p[i] = (struct fx_vec3){q16(q->p[i][0]), q16(q->p[i][1]), q16(q->p[i][2])};
        uvs[i][0] = q16(uv[i][0]);
        uvs[i][1] = q16(uv[i][1]);
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        uint8_t rgb[3];
        texels[i] = texel(i, rgb) ? ph_rgb565(rgb[0], rgb[1], rgb[2]) : KEY;
    }
    materials[q - quads] = (struct ph_material){.shading = q->blend == &cut ? PH_SHADE_TEXTURE : PH_SHADE_UNLIT,
                                                .colour = ph_rgb565(q->rgb[0], q->rgb[1], q->rgb[2]),
                                                .texture = &texture,
                                                .blend = q->blend};
    const struct ph_mesh mesh = {.positions = p,
                                 .uvs = (const fx_t(*)[2])uvs,
                                 .triangles = triangles,
                                 .parts = &all,
                                 .materials = &materials[q - quads],
                                 .vertex_count = 4,
                                 .triangle_count = 2,
                                 .part_count = 1};
    assert_int_equal(ph_draw_mesh(r, &mesh, &ph_xform_identity), PH_OK);
}

static void draw(struct rig *rig, bool fogged)
{
    struct ph_projection lens;
    const uint16_t colour = ph_rgb565(fog_rgb[0], fog_rgb[1], fog_rgb[2]);
    const struct ph_fog fog = {colour, q16(fog_start), q16(fog_end)};
    ph_projection_frustum(&lens, q16(-NEAR_Z * TANGENT * W / H), q16(NEAR_Z * TANGENT * W / H), q16(-NEAR_Z * TANGENT),
                          q16(NEAR_Z * TANGENT), q16(NEAR_Z), q16(FAR_Z));
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &lens, NULL, colour), PH_OK);
    assert_true(!fogged || ph_frame_fog(&rig->r, &fog) == PH_OK);
    for (int i = 0; i < QUADS; i++) {
        draw_quad(&rig->r, &quads[i]);
    }
    assert_true(rig_finish(rig));
}

/* Per cent of the pixels that differ by more than two steps of 1/31. */
static double difference(bool fogged)
{
    static float depth[W * H];
    static uint8_t rgb[W * H][3];
    struct mesa gl;
    struct rig rig;
    int differ = 0;
    if (!mesa_open(&gl, W, H)) {
        skip();
    }
    gl_begin(fogged);
    for (int i = 0; i < QUADS; i++) {
        gl_quad(&quads[i]);
    }
    mesa_read(&gl, depth, rgb);
    mesa_close(&gl);
    rig_open(&rig, W, H, 16, PH_DEPTH_FLOAT16, 64, 128);
    draw(&rig, fogged);
    for (int i = 0; i < W * H; i++) {
        double ours[3];
        rig_rgb(&rig, i % W, i / W, ours);
        bool off = false;
        for (int k = 0; k < 3; k++) {
            off |= fabs(ours[k] - rgb[i][k]) > 2 * 255 / 31. + .5;
        }
        differ += off;
    }
    rig_close(&rig);
    printf("    %.3f %% of the pixels differ\n", 100. * differ / (W * H));
    return 100. * differ / (W * H);
}

static void cut_outs_and_glass_are_those_of_mesa(void **state)
{
    (void)state;
    assert_true(difference(false) <= .3);
}

static void fog_is_that_of_mesa(void **state)
{
    (void)state;
    assert_true(difference(true) <= .3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_outs_and_glass_are_those_of_mesa),
        cmocka_unit_test(fog_is_that_of_mesa),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
