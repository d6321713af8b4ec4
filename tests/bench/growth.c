/*
 * How the cost of a frame grows: with triangles, fragments, the height of bands and the picture's size. Each line of
 * output is
 *
 *   KIND FORMAT STAGE X COUNT
 *
 * STAGE frame is all of it, bins the sorting of the list into bands. Kinds:
 *
 * - triangles: a torus of X triangles that covers the same pixels
 * - fragments: X pixels in full-screen quads, each in front of the last
 * - visible, hidden: X full-screen quads in bands of 16 lines, each in front of the last or behind it
 * - points, discs, sparks: X points of one pixel or of two, opaque squares and discs, and squares that are added, in
 *   bands of 16 lines; of 0 points the call, too, is left out
 * - draws, materials, keyed: X small quads that are drawn one by one, with one material, with as many, or with a keyed
 *   texture, in bands of 16 lines
 * - outside: the quads of draws, with bounds, off the picture: a quarter of them each beyond the left side, above,
 *   behind the camera and beyond the far plane
 * - glass, letters: a picture of X pixels without alpha, 16 lines high, and a text of X letters with an outline, over a
 *   band of 16 lines; the frame is the overlay alone
 * - band: the torus of 4096 triangles in bands of X lines
 * - pixels: the same torus in pictures of 128x64 .. 320x480 = X pixels
 */
#include "bench.h"

#include "demo_scene.h"
#include "models.h"
#include "overlay.h"
#include "render.h"

#define WIDTH      320
#define HEIGHT     480
#define ARENA      (5 * 1024 * 1024)
#define VERTICES   41000
#define TRIANGLES  41000
#define QUADS_LAST 16

/* A torus has 4 n^2 triangles: 64 .. 65536, and 4096 where bands and sizes are measured. */
#define ACROSS_LAST  128
#define ACROSS_BANDS 32

static uint64_t arena[ARENA / 8], vertices[VERTICES * 5], triangles[TRIANGLES * 16];
static uint32_t bins[HEIGHT];
static uint16_t depth[WIDTH * HEIGHT], pixels[WIDTH * HEIGHT];

static const struct ph_scene_light sun = {
    .ambient = FX_ONE,
    .count = 1,
    .lights = {{.kind = PH_LIGHT_DIRECTIONAL, .intensity = FX_ONE, .to_light_q30 = {511886330, 614263596, 716640862}}},
};

struct picture {
    uint16_t width, height, band_height;
};

/* What a frame shows: a mesh at so many places, with a material of its own at each, or
 * (NULL) with that of the mesh. */
struct drawing {
    struct ph_mesh mesh;
    const struct ph_xform *places;
    const struct ph_material *materials;
    uint32_t count;
    const struct ph_points *points; /* or NULL; with the material `materials` */
};

static void list_frame(struct ph_renderer *r, const struct ph_projection *projection, const struct drawing *drawing)
{
    struct ph_mesh mesh = drawing->mesh;
    ph_frame_begin(r, &ph_xform_identity, projection, &sun, 0);
    if (drawing->points != NULL && drawing->points->count > 0) {
        ph_draw_points(r, drawing->points, drawing->places, drawing->materials);
    }
    for (uint32_t i = 0; i < drawing->count; i++) {
        mesh.materials = drawing->materials != NULL ? &drawing->materials[i] : mesh.materials;
        ph_draw_mesh(r, &mesh, &drawing->places[i]);
    }
}

/* One frame. What is left out is left out of the count, too: then the result says so. */
static void measure_drawing(const char *kind, uint32_t x, const struct picture *picture, const struct drawing *drawing)
{
    const struct ph_config config = {.width = picture->width,
                                     .height = picture->height,
                                     .band_height = picture->band_height,
                                     .depth_format = PH_DEPTH_FIXED16,
                                     .occlusion = PH_COARSE_DEPTH,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = (uint32_t)(sizeof vertices / ph_vertex_bytes),
                                     .triangles = triangles,
                                     .triangle_max = (uint32_t)(sizeof triangles / ph_triangle_bytes),
                                     .bins = bins,
                                     .bin_max = HEIGHT,
                                     .depth = depth};
    const struct demo_context context = {.width = picture->width, .height = picture->height};
    const struct ph_projection projection = demo_perspective(&context, DEMO_SCALE_60_Q20, FX_HALF, FX_INT(32));
    struct ph_renderer r;
    if (ph_renderer_init(&r, &config) != 0) {
        machine_print("growth: the renderer refuses a picture\n");
        return;
    }
    const char *what[3] = {kind, "fixed16", "frame"};
    machine_start();
    list_frame(&r, &projection, drawing);
    const uint32_t bands = ph_frame_bands(&r);
    for (uint32_t band = 0; band < bands; band++) {
        ph_draw_band(&r, band, pixels);
    }
    machine_stop(what, x);
    if (r.stats.triangles_dropped + r.stats.vertices_dropped > 0) {
        machine_print("growth: the scene does not fit\n");
    }
    what[2] = "bins"; /* once more, for its share alone */
    list_frame(&r, &projection, drawing);
    machine_start();
    ph_frame_bands(&r);
    machine_stop(what, x);
}

static void measure(const char *kind, uint32_t x, const struct picture *picture, const struct ph_mesh *mesh,
                    const struct ph_xform *place)
{
    const struct drawing drawing = {*mesh, place, NULL, 1};
    measure_drawing(kind, x, picture, &drawing);
}

static const uint16_t band_heights[] = {5, 10, 15, 30, 60, 120, 240};
static const struct picture sizes[] = {{128, 64, 64},   {160, 128, 128}, {240, 135, 135},
                                       {240, 240, 240}, {320, 240, 240}, {320, 480, 480}};

static void bands_and_sizes(const struct ph_mesh *mesh, const struct ph_xform *place)
{
    for (unsigned i = 0; i < sizeof band_heights / sizeof band_heights[0]; i++) {
        const struct picture bands = {320, 240, band_heights[i]};
        measure("band", band_heights[i], &bands, mesh, place);
    }
    for (unsigned i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        measure("pixels", (uint32_t)sizes[i].width * sizes[i].height, &sizes[i], mesh, place);
    }
}

static void tori(const struct ph_material *material)
{
    struct ph_xform place = ph_xform_rotate_x(1u << 29);
    place.t.z = FX_INT(-3);
    for (uint32_t across = 4; across <= ACROSS_LAST; across *= 2) {
        struct demo_arena memory = {.base = (uint8_t *)arena, .size = sizeof arena};
        struct ph_mesh mesh;
        if (model_torus(&memory, &mesh, 2 * across, across, 1 << 28, 107374182) != 0 ||
            model_material(&memory, &mesh, material) != 0) {
            machine_print("growth: a torus does not fit\n");
            return;
        }
        const struct picture whole = {320, 240, 240};
        measure("triangles", mesh.triangle_count, &whole, &mesh, &place);
        if (across == ACROSS_BANDS) {
            bands_and_sizes(&mesh, &place);
        }
    }
}

/* Quads larger than the picture, from far to near or from near to far. */
static struct ph_mesh make_quads(struct fx_vec3 corners[QUADS_LAST][4], uint16_t faces[2 * QUADS_LAST][3], bool nearer)
{
    for (uint16_t i = 0; i < QUADS_LAST; i++) {
        const fx_t z = FX_INT(-20 + (nearer ? i : QUADS_LAST - 1 - i)), x = FX_INT(30), y = FX_INT(30);
        const struct fx_vec3 four[4] = {{-x, -y, z}, {x, -y, z}, {x, y, z}, {-x, y, z}};
        for (uint16_t k = 0; k < 4; k++) {
            corners[i][k] = four[k];
        }
        for (uint16_t k = 0; k < 2; k++) {
            faces[2 * i + k][0] = (uint16_t)(4 * i);
            faces[2 * i + k][1] = (uint16_t)(4 * i + 1 + k);
            faces[2 * i + k][2] = (uint16_t)(4 * i + 2 + k);
        }
    }
    return (struct ph_mesh){.positions = corners[0], .triangles = (const uint16_t(*)[3])faces, .part_count = 1};
}

static void measure_quads(const char *kind, const struct picture *picture, const struct ph_material *material,
                          bool nearer)
{
    static struct fx_vec3 corners[QUADS_LAST][4];
    static uint16_t faces[2 * QUADS_LAST][3];
    struct ph_mesh mesh = make_quads(corners, faces, nearer);
    mesh.materials = material;
    for (uint32_t count = 1; count <= QUADS_LAST; count *= 2) {
        const struct ph_part part = {.count = 2 * count};
        mesh.parts = &part;
        mesh.vertex_count = 4 * count;
        mesh.triangle_count = 2 * count;
        measure(kind, kind[0] == 'f' ? count * 320 * 240 : count, picture, &mesh, &ph_xform_identity);
    }
}

static void quads(const struct ph_material *material)
{
    static const struct picture whole = {320, 240, 240}, bands = {320, 240, 16};
    measure_quads("fragments", &whole, material, true);
    measure_quads("visible", &bands, material, true);
    measure_quads("hidden", &bands, material, false);
}

#define DRAWS_LAST 1024

/* Quads of some 6 px in 32 columns. */
static void draws(const struct ph_material *one)
{
    static const struct fx_vec3 corners[4] = {{-6000, -6000, 0}, {6000, -6000, 0}, {6000, 6000, 0}, {-6000, 6000, 0}};
    static const uint16_t faces[2][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct ph_part part = {.count = 2};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {FX_ONE, FX_ONE}, {0, FX_ONE}};
    static const uint16_t texels[8 * 8] = {[9] = 0xf81f, [10] = 0xf81f, [17] = 0xf81f, [18] = 0xf81f};
    static const struct ph_texture texture = {.texels = texels, .log2_width = 3, .log2_height = 3};
    static const struct ph_blend key = {.kind = PH_BLEND_KEY, .draw = &ph_blending, .key = 0xf81f};
    static const struct ph_material keyed = {.shading = PH_SHADE_TEXTURE, .texture = &texture, .blend = &key};
    static struct ph_xform places[DRAWS_LAST], off[DRAWS_LAST];
    static struct ph_material materials[DRAWS_LAST];
    const struct picture bands = {320, 240, 16};
    const struct ph_mesh quad = {.positions = corners,
                                 .uvs = uvs,
                                 .vertex_count = 4,
                                 .triangles = faces,
                                 .triangle_count = 2,
                                 .parts = &part,
                                 .part_count = 1};
    static struct ph_sphere bounds;
    struct drawing all[4] = {
        {quad, places, NULL, 0}, {quad, places, materials, 0}, {quad, places, NULL, 0}, {quad, off, NULL, 0}};
    static const char *const kinds[4] = {"draws", "materials", "keyed", "outside"};
    all[0].mesh.materials = one;
    all[2].mesh.materials = &keyed;
    all[3].mesh.materials = one;
    ph_mesh_bounds(&all[3].mesh, &bounds);
    for (uint32_t i = 0; i < DRAWS_LAST; i++) {
        places[i] = ph_xform_identity;
        places[i].t = (struct fx_vec3){(fx_t)(i % 32 * 20000) - 310000, (fx_t)(i / 32 * 14000) - 220000, FX_INT(-8)};
        static const struct fx_vec3 away[4] = {
            {-FX_INT(20), 0, 0}, {0, FX_INT(20), 0}, {0, 0, FX_INT(16)}, {0, 0, -FX_INT(40)}};
        off[i] = places[i];
        off[i].t = fx_vec3_add_sat(places[i].t, away[i % 4]);
        materials[i] = *one;
        materials[i].colour = (uint16_t)i;
    }
    for (unsigned k = 0; k < 4; k++) {
        for (uint32_t count = 64; count <= DRAWS_LAST; count *= 2) {
            all[k].count = count;
            measure_drawing(kinds[k], count, &bands, &all[k]);
        }
    }
}

#define POINTS_LAST 1000

/* Points all over the picture, near and far ones. */
static void points(void)
{
    static struct fx_vec3 positions[POINTS_LAST];
    static uint16_t colours[POINTS_LAST];
    static const struct ph_blend added = {.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 24};
    static const struct ph_material plain, spark = {.blend = &added};
    const struct picture bands = {320, 240, 16};
    const struct ph_xform place = ph_xform_translate(0, 0, FX_INT(-3));
    struct ph_points all = {.positions = positions, .colours = colours, .size = FX_ONE};
    static const char *const kinds[3] = {"points", "sparks", "discs"};
    uint32_t random = 1;
    for (uint32_t i = 0; i < POINTS_LAST; i++) {
        fx_t at[3];
        for (int k = 0; k < 3; k++) {
            random = random * 1664525 + 1013904223;
            at[k] = (fx_t)(random >> 15) - 65536; /* -1 .. 1 */
        }
        positions[i] = (struct fx_vec3){at[0], at[1], at[2]};
        colours[i] = (uint16_t)random;
    }
    for (unsigned k = 0; k < 3; k++) {
        all.round = k == 2;
        all.size = k == 2 ? FX_INT(2) : FX_ONE;
        for (uint32_t count = 0; count <= POINTS_LAST; count = count == 0 ? 125 : 2 * count) {
            const struct drawing drawing = {.points = &all, .places = &place, .materials = k == 1 ? &spark : &plain};
            all.count = count;
            measure_drawing(kinds[k], count, &bands, &drawing);
        }
    }
}

static void overlays(void)
{
    enum { WIDE = 320, LINES = 16 };
    static const char text[] = "THE QUICK BROWN FOX JUMPS OVER 0123456789, AND AGAIN OVER 0.1234";
    static const struct ph_overlay_style style = {.colour = 0xffff, .outline = 0, .scale = 1};
    const struct ph_overlay_band band = {.pixels = pixels, .width = WIDE, .lines = LINES};
    for (uint32_t width = WIDE / 8; width <= WIDE; width *= 2) {
        const struct ph_sprite picture = {
            .pixels = pixels + WIDE * LINES, .width = (uint16_t)width, .height = LINES, .alpha = 32};
        machine_start();
        ph_overlay_sprite(&band, 0, 0, &picture);
        machine_stop((const char *const[3]){"glass", "-", "frame"}, width * LINES);
    }
    for (uint32_t count = 8; count < sizeof text; count *= 2) {
        machine_start();
        ph_overlay_text(&band, 0, 4, text + sizeof text - 1 - count, &style);
        machine_stop((const char *const[3]){"letters", "-", "frame"}, count);
    }
}

int main(void)
{
    static const char *const loop[3] = {"known-loop", "-", "-"};
    static uint16_t ramp[PH_RAMP_SIZE];
    machine_start();
    machine_known_loop();
    machine_stop(loop, 0);
    ph_material_ramp(ramp, 255, 160, 64, 0);
    const struct ph_material lit = {
        .shading = PH_SHADE_GOURAUD, .ambient = FX_ONE / 5, .diffuse = FX_ONE / 5 * 4, .ramp = ramp};
    const struct ph_material plain = {.shading = PH_SHADE_UNLIT, .colour = 0x1234};
    tori(&lit);
    quads(&plain);
    draws(&plain);
    points();
    overlays();
    return 0;
}
