/*
 * Depth of surfaces at every slope. Random triangles, from tiny to larger than the picture, facing the camera to seen
 * nearly edge-on, are drawn in every format and shading. The code of each pixel is compared with the exact plane
 * through the projected corners, in integers of 128 bits, and with the code in the other shadings, which must be the
 * same. Then the scenes that once went wrong: floors in front of walls, and a sphere drawn twice.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "clip.h"
#include "ref_random.h"
#include "ref_rig.h"
#include "vertex.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define WIDTH     160
#define HEIGHT    120
#define TRIANGLES 2000
#define SHADINGS  (PH_SHADE_TEXTURE_LIT + 1)
#define GENTLE    .25 /* of the range of N/w per pixel: up to here a slope is exact */

__extension__ typedef __int128 int128;

struct lens {
    double near_z, far_z;
};

/* ---- drawing ------------------------------------------------------------------------------------------------------
 */

static void begin(struct rig *rig, const struct lens *lens)
{
    struct ph_projection projection;
    assert_int_equal(ph_projection_perspective(&projection, FX_INT(60), ref_q16((double)rig->width / rig->height),
                                               ref_q16(lens->near_z), ref_q16(lens->far_z)),
                     PH_OK);
    assert_int_equal(ph_frame_begin(&rig->r, &ph_xform_identity, &projection, NULL, 0), PH_OK);
}

static struct ph_material material_of(int shading, const uint16_t ramp[PH_RAMP_SIZE], uint16_t colour)
{
    static const uint16_t texels[4] = {1, 2, 3, 4};
    static const struct ph_texture texture = {.texels = texels, .log2_width = 1, .log2_height = 1};
    return (struct ph_material){.shading = (uint8_t)shading,
                                .two_sided = 1,
                                .ambient = FX_ONE,
                                .diffuse = FX_ONE,
                                .colour = colour,
                                .ramp = ramp,
                                .texture = &texture};
}

/* Three or four corners as one or two triangles. */
static void draw_polygon(struct rig *rig, const struct fx_vec3 *p, int corners, const struct ph_material *material)
{
    static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const int16_t normals[4][3] = {{0, 0, 16384}, {16384, 0, 0}, {0, 16384, 0}, {0, 0, 16384}};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {0, FX_ONE}, {FX_ONE, FX_ONE}};
    const struct ph_part part = {0, (uint32_t)corners - 2, 0};
    const struct ph_mesh mesh = {.positions = p,
                                 .normals = normals,
                                 .uvs = uvs,
                                 .vertex_count = (uint32_t)corners,
                                 .triangles = faces,
                                 .triangle_count = (uint32_t)corners - 2,
                                 .parts = &part,
                                 .part_count = 1,
                                 .materials = material};
    assert_int_equal(ph_draw_mesh(&rig->r, &mesh, &ph_xform_identity), PH_OK);
}

/* ---- the exact plane ----------------------------------------------------------------------------------------------
 */

struct plane {
    struct ph_vertex v[3];
    int128 over_w[3]; /* N/w of the corners, 2^-56 */
    int64_t area;
    double low, high; /* N/w of the corners */
};

static int64_t cross(int64_t ax, int64_t ay, int64_t bx, int64_t by)
{
    return ax * by - ay * bx;
}

/* The head room of d: see depth.h. */
static int head_of(const struct rig *rig)
{
    return rig->r.stats.depth_exponent > 4 ? 13 - rig->r.stats.depth_exponent : 9;
}

/* The triangle that was drawn last, at `at`. False if it was clipped or has no area. */
static bool plane_open(struct plane *p, const struct rig *rig, const struct fx_vec3 at[3])
{
    const int128 n = (int128)rig->r.lens.near_z * (512 - (512 >> head_of(rig))); /* times 2^-9 */
    memcpy(p->v, rig->vertices, sizeof p->v);
    p->low = 2;
    p->high = 0;
    for (int i = 0; i < 3; i++) {
        if (p->v[i].code & PH_CLIP) {
            return false;
        }
        p->over_w[i] = (n << 47) / -at[i].z;
        p->low = fmin(p->low, ldexp((double)p->over_w[i], -56));
        p->high = fmax(p->high, ldexp((double)p->over_w[i], -56));
    }
    p->area = cross(p->v[1].x - p->v[0].x, p->v[1].y - p->v[0].y, p->v[2].x - p->v[0].x, p->v[2].y - p->v[0].y);
    return p->area != 0;
}

/* N/w at the centre of a pixel; *outside: the centre lies outside the triangle. */
static double plane_at(const struct plane *p, int x, int y, bool *outside)
{
    const int64_t px = 256 * x + 128, py = 256 * y + 128;
    int128 sum = 0;
    *outside = false;
    for (int i = 0; i < 3; i++) {
        const struct ph_vertex *a = &p->v[(i + 1) % 3], *b = &p->v[(i + 2) % 3];
        const int64_t share = cross(a->x - px, a->y - py, b->x - px, b->y - py);
        *outside |= share != 0 && (share < 0) != (p->area < 0);
        sum += share * p->over_w[i];
    }
    return ldexp((double)(sum / p->area), -56);
}

/* The steepest of the slopes right and down, of N/w per pixel. */
static double plane_slope(const struct plane *p)
{
    bool outside;
    const double here = plane_at(p, 0, 0, &outside);
    return fmax(fabs(plane_at(p, 1, 0, &outside) - here), fabs(plane_at(p, 0, 1, &outside) - here));
}

/* The value of which the code is the floor: see depth.h. */
static double code_exact(const struct rig *rig, double over_w)
{
    const struct ph_lens *lens = &rig->r.lens;
    const enum ph_depth_format format = (enum ph_depth_format)rig->r.stats.depth_format;
    const double d = fmax(over_w - lens->near_z * (1 - ldexp(1, -head_of(rig))) / lens->far_z, 0);
    const double unit = ph_depth_bytes(format) == 4 ? 256 : 1;
    if (format == PH_DEPTH_FIXED16 || format == PH_DEPTH_FIXED24) {
        return unit * (65536 * d + 16.25);
    }
    const int bits = rig->r.stats.depth_exponent, top = 1 << bits;
    const int exponent = d < ldexp(1, 1 - top) ? 1 : ilogb(d) + top;
    return unit * (ldexp(d, 16 - bits + top - exponent) + ldexp(exponent - 1, 16 - bits) + 8);
}

/* ---- random triangles ---------------------------------------------------------------------------------------------
 */

/* Any size, thin or not, anywhere in the picture, its corners at distances that are alike or far apart. */
static void random_triangle(const struct lens *lens, struct fx_vec3 p[3])
{
    const double size = pow(2, ref_uniform(0, 9)), thin = pow(2, ref_uniform(-9, 0)), turn = ref_uniform(0, 6.283);
    const double steep = pow(2, ref_uniform(-12, 0)), middle = ref_uniform(0, 1);
    const double x = ref_uniform(0, WIDTH), y = ref_uniform(0, HEIGHT), focal = HEIGHT / 2. * sqrt(3);
    for (int i = 0; i < 3; i++) {
        const double u = ref_uniform(-.5, .5) * size, v = ref_uniform(-.5, .5) * size * thin;
        const double share = fmin(fmax(middle + ref_uniform(-.5, .5) * steep, 0), 1);
        const double w = lens->near_z * 1.001 * pow(lens->far_z / lens->near_z / 1.002, share);
        p[i].x = ref_q16((x + u * cos(turn) - v * sin(turn) - WIDTH / 2.) * w / focal);
        p[i].y = ref_q16((HEIGHT / 2. - y - u * sin(turn) - v * cos(turn)) * w / focal);
        p[i].z = -ref_q16(w);
    }
}

struct result {
    double worst;        /* codes off the exact plane, of gentle triangles */
    double beyond;       /* codes outside the range of the corners, of all */
    long pixels, unlike; /* unlike: code differs from that of the first shading */
};

static void compare(const struct rig *rig, const struct plane *plane, const uint32_t *first, struct result *result)
{
    const bool gentle = plane_slope(plane) <= GENTLE;
    const double low = code_exact(rig, plane->low), high = code_exact(rig, plane->high);
    for (int at = 0; at < WIDTH * HEIGHT; at++) {
        const uint32_t code = rig->depth[at];
        result->unlike += code != first[at];
        if (code == 0) {
            continue;
        }
        bool outside;
        const double over_w = plane_at(plane, at % WIDTH, at / WIDTH, &outside);
        const double within = fmin(fmax(over_w, plane->low), plane->high);
        const double off = fabs(code + .5 - code_exact(rig, over_w)),
                     off_within = fabs(code + .5 - code_exact(rig, within));
        result->pixels++;
        result->worst = gentle ? fmax(result->worst, outside ? fmin(off, off_within) : off) : result->worst;
        result->beyond = fmax(result->beyond, fmax(low - (code + 1), code - high));
    }
}

static void every_slope_is_right_and_the_same_in_all_shadings(void **state)
{
    static const struct lens lenses[] = {{.5, 100}, {.1, 1000}, {1, 3}};
    static const struct {
        enum ph_depth_format format;
        uint8_t exponent;
        double worst; /* codes, with 3 bits of exponent twice as fine as with 4; 0: not held */
        long unlike;  /* of 1,000,000 pixels: float16 and float24 at octaves' borders, textured */
    } bounds[] = {{PH_DEPTH_FIXED16, 0, 2.5, 0},     {PH_DEPTH_FLOAT16, 0, 5, 20},     {PH_DEPTH_FIXED24, 0, 2.5, 0},
                  {PH_DEPTH_FLOAT24, 0, 128, 10000}, {PH_DEPTH_LINEAR_W, 0, 0, 0},     {PH_DEPTH_FLOAT16, 3, 5, 20},
                  {PH_DEPTH_FLOAT16, 4, 2.5, 20},    {PH_DEPTH_FLOAT16, 5, 2.5, 20},   {PH_DEPTH_FLOAT16, 6, 2.5, 20},
                  {PH_DEPTH_FLOAT24, 3, 128, 10000}, {PH_DEPTH_FLOAT24, 4, 64, 10000}, {PH_DEPTH_FLOAT24, 5, 64, 10000},
                  {PH_DEPTH_FLOAT24, 6, 64, 10000}};
    static uint16_t ramp[PH_RAMP_SIZE];
    static uint32_t first[WIDTH * HEIGHT];
    (void)state;
    ref_seed(13);
    for (size_t i = 0; i < sizeof bounds / sizeof bounds[0]; i++) {
        struct rig rig;
        struct result result = {0};
        rig_open(&rig, WIDTH, HEIGHT, 16, bounds[i].format, 3, 1);
        rig.r.config.depth_exponent = bounds[i].exponent;
        for (int n = 0; n < TRIANGLES; n++) {
            const struct lens *lens = &lenses[n % 3];
            struct fx_vec3 p[3];
            random_triangle(lens, p);
            for (int shading = 0; shading < SHADINGS; shading++) {
                const struct ph_material material = material_of(shading, ramp, 1);
                struct plane plane;
                begin(&rig, lens);
                draw_polygon(&rig, p, 3, &material);
                assert_true(rig_finish(&rig));
                if (shading == 0) {
                    memcpy(first, rig.depth, sizeof first);
                }
                if (bounds[i].worst > 0 && plane_open(&plane, &rig, p)) {
                    compare(&rig, &plane, first, &result);
                } else {
                    result.unlike += memcmp(first, rig.depth, sizeof first) != 0;
                }
            }
        }
        printf("# format %d e%d: %ld pixels, at most %.2f codes off, %.2f beyond the corners, %ld unlike\n",
               bounds[i].format, bounds[i].exponent, result.pixels, result.worst, result.beyond, result.unlike);
        assert_true(bounds[i].worst == 0 || result.worst <= bounds[i].worst);
        assert_true(result.beyond <= 1);
        assert_true(result.unlike <= bounds[i].unlike);
        rig_close(&rig);
    }
}

/* ---- floors and walls ---------------------------------------------------------------------------------------------
 */

/* Pixels in which a floor more than `margin` metres behind a wall covers it. The eye is 1.6 m above the floor. */
static int floor_before_wall(enum ph_depth_format format, const struct lens *lens, double from, double to, double wall,
                             double margin)
{
    enum { SIDE = 240, FLOOR = 1, WALL = 2 };
    const double wide = 2 * wall;
    const struct fx_vec3 floor[4] = {{ref_q16(-wide), ref_q16(-1.6), ref_q16(-from)},
                                     {ref_q16(wide), ref_q16(-1.6), ref_q16(-from)},
                                     {ref_q16(wide), ref_q16(-1.6), ref_q16(-to)},
                                     {ref_q16(-wide), ref_q16(-1.6), ref_q16(-to)}};
    const struct fx_vec3 face[4] = {{ref_q16(-wide), ref_q16(-3), ref_q16(-wall)},
                                    {ref_q16(wide), ref_q16(-3), ref_q16(-wall)},
                                    {ref_q16(wide), ref_q16(3), ref_q16(-wall)},
                                    {ref_q16(-wide), ref_q16(3), ref_q16(-wall)}};
    const struct ph_material materials[2] = {material_of(PH_SHADE_UNLIT, NULL, FLOOR),
                                             material_of(PH_SHADE_UNLIT, NULL, WALL)};
    struct rig rig;
    int wrong = 0;
    rig_open(&rig, SIDE, SIDE, 16, format, 4, 16);
    begin(&rig, lens);
    draw_polygon(&rig, floor, 4, &materials[0]);
    draw_polygon(&rig, face, 4, &materials[1]);
    assert_true(rig_finish(&rig));
    for (int y = SIDE / 2; y < SIDE; y++) {
        const double distance = 1.6 * (SIDE / 2. * sqrt(3)) / (y + .5 - SIDE / 2.);
        for (int x = 0; x < SIDE && distance > wall + margin && distance < to; x++) {
            wrong += rig.pixels[y * SIDE + x] == FLOOR;
        }
    }
    rig_close(&rig);
    return wrong;
}

static void no_floor_covers_a_wall_in_front_of_it(void **state)
{
    (void)state;
    for (unsigned format = PH_DEPTH_FIXED16; format <= PH_DEPTH_LINEAR_W; format++) {
        assert_int_equal(floor_before_wall(format, &(struct lens){.5, 100}, 60, 80, 66.67, 1), 0);
        if (format != PH_DEPTH_FIXED16) { /* which cannot tell these distances apart: see depth.h */
            assert_int_equal(floor_before_wall(format, &(struct lens){.1, 1000}, 30, 1000, 60, 2), 0);
        }
        for (int tile = 0; tile < 15; tile++) {
            const double from = 5 + 5. * tile;
            assert_int_equal(floor_before_wall(format, &(struct lens){.5, 100}, from, from + 20, from + 8, .5), 0);
        }
    }
}

/* ---- a sphere drawn twice -----------------------------------------------------------------------------------------
 */

enum { SEGMENTS = 24, RINGS = 12, CORNERS = (RINGS + 1) * (SEGMENTS + 1), FACES = 2 * RINGS * SEGMENTS };

struct sphere {
    struct fx_vec3 positions[CORNERS];
    int16_t normals[CORNERS][3];
    fx_t uvs[CORNERS][2];
    uint16_t faces[FACES][3];
};

static void sphere_build(struct sphere *s)
{
    for (int j = 0; j <= RINGS; j++) {
        for (int i = 0; i <= SEGMENTS; i++) {
            const double u = 2 * acos(-1) * i / SEGMENTS, v = acos(-1) * j / RINGS;
            const double n[3] = {sin(v) * sin(u), cos(v), sin(v) * cos(u)};
            const int at = j * (SEGMENTS + 1) + i;
            s->positions[at] = (struct fx_vec3){ref_q16(n[0]), ref_q16(n[1]), ref_q16(n[2] - 3)};
            for (int k = 0; k < 3; k++) {
                s->normals[at][k] = (int16_t)lrint(16384 * n[k]);
            }
            s->uvs[at][0] = ref_q16((double)i / SEGMENTS);
            s->uvs[at][1] = ref_q16((double)j / RINGS);
        }
    }
    for (int f = 0; f < FACES / 2; f++) {
        const int a = f / SEGMENTS * (SEGMENTS + 1) + f % SEGMENTS, b = a + SEGMENTS + 1;
        const uint16_t quad[2][3] = {{(uint16_t)a, (uint16_t)b, (uint16_t)(b + 1)},
                                     {(uint16_t)a, (uint16_t)(b + 1), (uint16_t)(a + 1)}};
        memcpy(s->faces[2 * f], quad, sizeof quad);
    }
}

static void of_a_sphere_drawn_twice_only_the_first_shows(void **state)
{
    static struct sphere s;
    static uint16_t dark[PH_RAMP_SIZE], bright[PH_RAMP_SIZE];
    const struct ph_part part = {0, FACES, 0};
    struct ph_mesh mesh = {.positions = s.positions,
                           .normals = s.normals,
                           .uvs = s.uvs,
                           .vertex_count = CORNERS,
                           .triangles = s.faces,
                           .triangle_count = FACES,
                           .parts = &part,
                           .part_count = 1};
    (void)state;
    sphere_build(&s);
    for (int i = 0; i < PH_RAMP_SIZE; i++) {
        dark[i] = 0x1000;
        bright[i] = 0x2000;
    }
    for (unsigned format = PH_DEPTH_FIXED16; format <= PH_DEPTH_LINEAR_W; format++) {
        for (int shading = 0; shading < SHADINGS; shading++) {
            const struct ph_material first = material_of(PH_SHADE_GOURAUD, dark, 0x1000);
            const struct ph_material second = material_of(shading, bright, 0x2000);
            struct rig rig;
            int shown = 0, drawn = 0;
            rig_open(&rig, WIDTH, HEIGHT, 16, format, CORNERS, 2 * FACES);
            begin(&rig, &(struct lens){.5, 100});
            mesh.materials = &first;
            assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
            mesh.materials = &second;
            assert_int_equal(ph_draw_mesh(&rig.r, &mesh, &ph_xform_identity), PH_OK);
            assert_true(rig_finish(&rig));
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                drawn += rig.pixels[i] != 0;
                shown += rig.pixels[i] != 0 && rig.pixels[i] != 0x1000;
            }
            assert_true(drawn > 2000);
            if (shown != 0) {
                printf("# format %u shading %d: %d of %d\n", format, shading, shown, drawn);
            }
            assert_true(shown == 0 || (format == PH_DEPTH_FLOAT24 && shading >= PH_SHADE_TEXTURE));
            rig_close(&rig);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_slope_is_right_and_the_same_in_all_shadings),
        cmocka_unit_test(no_floor_covers_a_wall_in_front_of_it),
        cmocka_unit_test(of_a_sphere_drawn_twice_only_the_first_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
