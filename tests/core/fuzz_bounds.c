/*
 * Random meshes in front of, beside and behind random cameras are drawn with bounds and without. Both pictures must
 * have the same bytes, and the statistics that both have must be the same. Meshes are turned, scaled and sheared, and
 * fill the sphere around them; cameras are perspectives, also with a shifted principal point, parallel projections and
 * fisheyes. Sides of the picture often cut a mesh, or just miss it.
 *
 * A reference in doubles says which spheres lie off the picture by a tenth of their distance from the eye: such meshes
 * must be culled.
 *
 * Usage: fuzz_bounds [quick | long | FRAMES [SEED]]
 * quick (the default) is 1,000 frames, long 20,000. A frame that fails prints its seed; `fuzz_bounds 1 SEED` repeats
 * it.
 */
#include "ref_random.h"
#include "render.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define QUICK     1000
#define LONG      20000
#define WIDTH     40
#define HEIGHT    30
#define MESHES    8
#define VERTICES  15
#define TRIANGLES 24
#define EDGES     12
#define PARTS     3
#define ROOM      40000

/* ---- what is drawn ----------------------------------------------------------------------------------------------- */

struct body {
    struct fx_vec3 positions[VERTICES];
    int16_t normals[VERTICES][3];
    fx_t uvs[VERTICES][2];
    uint16_t triangles[TRIANGLES][3], edges[EDGES][2];
    struct ph_part parts[PARTS];
    struct ph_sphere bounds[PH_BOUNDS(PARTS)];
    struct ph_mesh mesh;
    struct ph_xform to_world;
};

struct scene {
    struct ph_xform view;
    struct ph_projection lens;
    struct body bodies[MESHES];
    const struct ph_depth_format *depth_format;
    bool antialiased;
};

static uint16_t ramp[PH_RAMP_SIZE], texels[16];
static const struct ph_texture texture = {.texels = texels, .log2_width = 2, .log2_height = 2};
static const struct ph_blend half = {.draw = ph_draw_blended, .kind = PH_BLEND_ALPHA, .alpha = 16};
static const struct ph_material materials[] = {
    {.shading = PH_SHADE_UNLIT, .colour = 0x1234},
    {.shading = PH_SHADE_GOURAUD, .ambient = FX_ONE / 4, .diffuse = FX_ONE, .ramp = ramp, .two_sided = 1},
    {.shading = PH_SHADE_TEXTURE, .texture = &texture},
    {.shading = PH_SHADE_WIRE, .colour = 0x8765},
    {.shading = PH_SHADE_UNLIT, .colour = 0x4321, .blend = &half, .two_sided = 1},
};
#define MATERIALS (sizeof materials / sizeof materials[0])

static uint32_t below(uint32_t n)
{
    return (uint32_t)ref_uniform(0, n);
}

static fx_t q16(double v)
{
    return ref_q16(fmax(fmin(v, 32767), -32767));
}

/* A number between low and high, whose logarithm is uniform. */
static double magnitude(double low, double high)
{
    return low * pow(high / low, ref_uniform(0, 1));
}

/* A turn, in a fourth of the cases with a scale below 2 and a shear. */
static struct ph_xform any_xform(double reach)
{
    struct ph_xform x;
    double r[3][3];
    const bool scaled = below(4) == 0, sheared = scaled && below(2) == 0;
    const double scale = scaled ? magnitude(.05, 1.9) : 1;
    ref_rotation(3.14159265, r);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            const double shear = sheared && j == 2 ? scale * ref_uniform(-.9, .9) * r[i][0] : 0;
            x.r[i][j] = ref_q30(fmax(fmin(scale * r[i][j] + shear, 1.99), -1.99));
        }
    }
    x.t = (struct fx_vec3){q16(ref_uniform(-reach, reach)), q16(ref_uniform(-reach, reach)),
                           q16(ref_uniform(-reach, reach))};
    return x;
}

/* A mesh of one to three parts, whose vertices lie on as many spheres side by side. */
static void make_body(struct body *b, double reach)
{
    const double radius = magnitude(reach / 50, reach), off = below(2) ? 0 : reach / 2;
    const double centre[3] = {ref_uniform(-off, off), ref_uniform(-off, off), ref_uniform(-off, off)};
    const uint16_t parts = (uint16_t)(1 + below(PARTS));
    for (int i = 0; i < VERTICES; i++) {
        const double along = centre[0] + i % parts * 1.5 * radius;
        double d[3];
        ref_direction(d);
        b->positions[i] = (struct fx_vec3){q16(along + radius * d[0]), q16(centre[1] + radius * d[1]),
                                           q16(centre[2] + radius * d[2])};
        for (int k = 0; k < 3; k++) {
            b->normals[i][k] = (int16_t)lrint(d[k] * 16384);
        }
        b->uvs[i][0] = (fx_t)below(FX_ONE);
        b->uvs[i][1] = (fx_t)below(FX_ONE);
    }
    for (int i = 0; i < EDGES * 2; i++) {
        b->edges[i / 2][i % 2] = (uint16_t)below(VERTICES);
    }
    for (uint16_t i = 0; i < parts; i++) {
        const uint32_t each = TRIANGLES / parts;
        for (uint32_t k = 0; k < each * 3; k++) {
            b->triangles[i * each + k / 3][k % 3] = (uint16_t)(below(VERTICES / parts) * parts + i);
        }
        b->parts[i] = (struct ph_part){i * each, each, (uint16_t)below(MATERIALS)};
    }
    b->mesh = (struct ph_mesh){.positions = b->positions,
                               .normals = (const int16_t(*)[3])b->normals,
                               .uvs = (const fx_t(*)[2])b->uvs,
                               .triangles = (const uint16_t(*)[3])b->triangles,
                               .edges = (const uint16_t(*)[2])b->edges,
                               .parts = b->parts,
                               .materials = materials,
                               .vertex_count = VERTICES,
                               .triangle_count = TRIANGLES,
                               .edge_count = EDGES,
                               .part_count = parts};
    b->to_world = any_xform(reach);
}

static struct ph_projection any_lens(double reach)
{
    struct ph_projection lens;
    const fx_t near_z = q16(magnitude(1. / 4096, reach / 8)),
               far_z = q16(near_z / 65536. + magnitude(reach / 4, 8 * reach));
    const double side = magnitude(reach / 10, reach), x = ref_uniform(-1, 1) * side, y = ref_uniform(-1, 1) * side;
    int status;
    switch (below(4)) {
    case 0:
        status = ph_projection_ortho(&lens, q16(x - side), q16(x + side), q16(y - side), q16(y + side),
                                     near_z - q16(reach / 2), far_z);
        break;
    case 1:
        status = ph_projection_fisheye(&lens, q16(ref_uniform(10, 240)), near_z, far_z);
        lens.shift_x = below(2) ? 0 : q16(ref_uniform(-2, 2));
        break;
    case 2: {
        const double size = magnitude(.01, 4) * near_z / 65536;
        status = ph_projection_frustum(&lens, q16(-size), q16(size * ref_uniform(.1, 3)), q16(-size),
                                       q16(size * ref_uniform(.1, 3)), near_z, far_z);
        break;
    }
    default:
        status = ph_projection_perspective(&lens, q16(magnitude(4, 170)), FX_ONE * WIDTH / HEIGHT, near_z, far_z);
    }
    if (status != PH_OK) { /* a frustum of a few LSB */
        ph_projection_perspective(&lens, FX_INT(60), FX_ONE * WIDTH / HEIGHT, near_z, far_z);
    }
    return lens;
}

static void transform(const struct ph_xform *x, const double from[3], double to[3])
{
    const double t[3] = {x->t.x / 65536., x->t.y / 65536., x->t.z / 65536.};
    for (int i = 0; i < 3; i++) {
        to[i] = t[i];
        for (int j = 0; j < 3; j++) {
            to[i] += ldexp(x->r[i][j], -30) * from[j];
        }
    }
}

/* Adds a vector, or subtracts it. */
static void move(struct fx_vec3 *t, int sign, const double by[3])
{
    *t = (struct fx_vec3){q16(t->x / 65536. + sign * by[0]), q16(t->y / 65536. + sign * by[1]),
                          q16(t->z / 65536. + sign * by[2])};
}

/* In half of the scenes all is moved away from the origin, the camera as well. */
static void make_scene(struct scene *s)
{
    const double reach = magnitude(.5, below(8) ? 500 : 30000), far_away = below(2) ? 0 : ref_uniform(0, 3000);
    const double offset[3] = {far_away, ref_uniform(-far_away, far_away), -far_away};
    s->lens = any_lens(reach);
    s->view = any_xform(reach / 4);
    s->depth_format = ph_depth_formats[below(PH_DEPTH_FORMATS)];
    s->antialiased = below(8) == 0;
    for (int i = 0; i < MESHES; i++) {
        make_body(&s->bodies[i], reach);
        move(&s->bodies[i].to_world.t, 1, offset);
    }
    double moved[3];
    transform(&s->view, offset, moved);
    move(&s->view.t, -1,
         (const double[3]){moved[0] - s->view.t.x / 65536., moved[1] - s->view.t.y / 65536.,
                           moved[2] - s->view.t.z / 65536.});
}

/* ---- the reference ----------------------------------------------------------------------------------------------- */

/* By how much points are away from the middle of a picture of `size` px before they leave it, in widths at distance 1.
 */
static double reach_of(int32_t scale_q20, fx_t shift, int sign, int size)
{
    return (1 + sign * shift / 65536. + 2. / size) * 1048576 / scale_q20;
}

/* Whether a sphere lies beyond a plane through the eye by a tenth of its distance; at is its place in the view. */
static bool is_far_off(const struct scene *s, const double at[3], double radius)
{
    const struct ph_projection *const lens = &s->lens;
    const double w = -at[2], slack = sqrt(at[0] * at[0] + at[1] * at[1] + w * w) / 10 + radius * .1;
    if (lens->kind == PH_FISHEYE) {
        const double half_width = WIDTH / 2. * (1 + fabs(lens->shift_x / 65536.));
        const double corner = hypot(half_width + 4, HEIGHT / 2. + 4) / (HEIGHT / 2.) * 1048576 / lens->scale_y_q20;
        const double cone = fmin(corner * 1.1, 2.99), across = hypot(at[0], at[1]), apart = hypot(across, w);
        return across * cos(cone) - w * sin(cone) > radius + slack || 2 * apart + radius < lens->near_z / 65536. ||
               apart / 2 - radius - slack > lens->far_z / 65536.;
    }
    bool off = w + radius + slack < lens->near_z / 65536. || w - radius - slack > lens->far_z / 65536.;
    for (int side = 0; side < 4; side++) {
        const int sign = side & 1 ? -1 : 1;
        const double limit = side < 2 ? reach_of(lens->scale_x_q20, lens->shift_x, sign, WIDTH)
                                      : reach_of(lens->scale_y_q20, lens->shift_y, sign, HEIGHT);
        const double along = sign * at[side / 2];
        off = off || (lens->kind == PH_ORTHOGRAPHIC ? along - limit > radius + slack
                                                    : (along - limit * w) / hypot(1, limit) > radius + slack);
    }
    return off;
}

/* The norm of a matrix, by its Frobenius norm: for a turn and a scale that is sqrt 3 times too much. */
static double norm_above(const struct ph_xform *x)
{
    double sum = 0;
    for (int i = 0; i < 9; i++) {
        sum += pow(ldexp(x->r[i / 3][i % 3], -30), 2);
    }
    return sqrt(sum);
}

static double sum_of(const double v[3])
{
    return fabs(v[0]) + fabs(v[1]) + fabs(v[2]);
}

/* Whether the translation is within the range of the test. */
static bool fits(const struct ph_xform *x)
{
    return sum_of((const double[3]){x->t.x / 65536., x->t.y / 65536., x->t.z / 65536.}) < 4000;
}

/* Whether a mesh is so far off the picture that it must be culled. */
static bool must_be_culled(const struct scene *s, const struct body *b)
{
    const struct ph_sphere *const sphere = &b->bounds[0];
    const double centre[3] = {sphere->centre.x / 65536., sphere->centre.y / 65536., sphere->centre.z / 65536.};
    double world[3], at[3];
    transform(&b->to_world, centre, world);
    transform(&s->view, world, at);
    const double one = norm_above(&b->to_world), other = norm_above(&s->view), norm = one * other;
    const double far_away = fmax(sum_of(centre), sum_of(world));
    const bool near = far_away < 4000 && sum_of(at) < 4000 && fits(&b->to_world) && fits(&s->view) &&
                      sphere->radius < 1 << 27 && s->lens.scale_x_q20 > 1 << 14 && s->lens.scale_y_q20 > 1 << 14;
    return near && fmax(norm, fmax(one, other)) < 1.8 &&
           is_far_off(s, at, norm * sphere->radius / 65536. + 3 * far_away / 2048);
}

/* ---- both pictures ----------------------------------------------------------------------------------------------- */

struct picture {
    uint16_t pixels[WIDTH * HEIGHT];
    struct ph_stats stats;
};

static void fail(uint64_t seed, const char *what)
{
    fprintf(stderr, "fuzz_bounds: %s; repeat with: fuzz_bounds 1 %" PRIu64 "\n", what, seed);
    exit(1);
}

static void draw(const struct scene *s, bool bounded, uint64_t seed, struct picture *to)
{
    static uint64_t vertices[ROOM], triangles[ROOM];
    static uint32_t depth[4 * WIDTH * HEIGHT], bins[HEIGHT], samples[2 * WIDTH * HEIGHT];
    static const struct ph_scene_light sun = {
        .ambient = FX_ONE,
        .count = 1,
        .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {0, FX_Q30_ONE, 0}}}};
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = HEIGHT,
                                     .depth_format = s->depth_format,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = sizeof vertices / ph_vertex_bytes,
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth,
                                     .samples = s->antialiased ? (uint16_t *)samples : NULL,
                                     .antialiasing = s->antialiased ? PH_ANTIALIAS_2X2 : NULL};
    static struct ph_renderer r;
    bool drawn =
        ph_renderer_init(&r, &config) == PH_OK && ph_frame_begin(&r, &s->view, &s->lens, &sun, 0x2222) == PH_OK;
    for (int i = 0; i < MESHES && drawn; i++) {
        struct ph_mesh mesh = s->bodies[i].mesh;
        const uint32_t culled = r.stats.meshes_culled;
        mesh.bounds = bounded ? mesh.bounds : NULL;
        drawn = ph_draw_mesh(&r, &mesh, &s->bodies[i].to_world) == PH_OK;
        if (bounded && r.stats.meshes_culled == culled && must_be_culled(s, &s->bodies[i])) {
            fail(seed, "a mesh that is far off the picture is not culled");
        }
    }
    if (!drawn || ph_frame_bands(&r) != 1 || ph_draw_band(&r, 0, to->pixels) != HEIGHT) {
        fail(seed, "a frame is refused");
    }
    to->stats = r.stats;
}

/* Draws one scene. Adds to how many meshes and parts were culled, and of how many some was drawn. */
static void compare(uint64_t seed, uint64_t counts[3])
{
    static struct scene s;
    static struct picture with, without;
    ref_seed(seed);
    make_scene(&s);
    for (int i = 0; i < MESHES; i++) {
        if (ph_mesh_bounds(&s.bodies[i].mesh, s.bodies[i].bounds) != PH_OK) {
            fail(seed, "a mesh is refused");
        }
    }
    draw(&s, true, seed, &with);
    draw(&s, false, seed, &without);
    const struct ph_stats *const a = &with.stats, *const b = &without.stats;
    if (b->vertices_dropped != 0) {
        fail(seed, "a mesh does not fit");
    }
    if (memcmp(with.pixels, without.pixels, sizeof with.pixels) != 0 || a->fragments != b->fragments) {
        fail(seed, "bounds change the picture");
    }
    if (a->triangles_in != b->triangles_in || a->vertices + a->meshes_culled * VERTICES != b->vertices ||
        b->meshes_culled + b->parts_culled != 0) {
        fail(seed, "bounds change the statistics");
    }
    counts[0] += a->meshes_culled;
    counts[1] += a->parts_culled;
    counts[2] += a->triangles_drawn != 0;
}

int main(int argc, char *argv[])
{
    const char *const kind = argc > 1 ? argv[1] : "quick";
    const uint64_t frames = strcmp(kind, "quick") == 0  ? QUICK
                            : strcmp(kind, "long") == 0 ? LONG
                                                        : strtoull(kind, NULL, 10);
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    uint64_t counts[3] = {0};
    ph_material_ramp(ramp, 255, 160, 64, 0);
    for (uint16_t i = 0; i < 16; i++) {
        texels[i] = (uint16_t)(i * 4097 + 1);
    }
    for (uint64_t i = 0; i < frames; i++) {
        compare(seed + i, counts);
    }
    printf("fuzz_bounds: %" PRIu64 " frames, %" PRIu64 " meshes and %" PRIu64
           " parts culled, something drawn in %" PRIu64 "\n",
           frames, counts[0], counts[1], counts[2]);
    if (frames >= QUICK && (counts[0] < frames || counts[1] < frames / 10 || counts[2] < frames / 4)) {
        fail(seed, "too little is culled or drawn to prove anything");
    }
    return 0;
}
