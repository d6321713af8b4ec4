/*
 * Changed binary scenes into scene_file: each is refused with a reason, or all that it names can be made, moved and
 * drawn in the memory that it says. The scene is made by hand: a mesh with a skin, morph targets, texture, mask and two
 * clips, and one that stands still with a colour for each vertex. Numbers are changed with the checksum set right.
 *
 *   fuzz_scene [quick | long | INPUTS [SEED]]
 *
 * It needs nothing but firmware/, so that long_scene_m32.sh builds it for 32 bits, too.
 */
#include "crc32.h"
#include "fuzz.h"
#include "scene_file.h"

#include <stdlib.h>
#include <string.h>

enum { ROOM = 8192, WIDTH = 40, HEIGHT = 30, BAND = 8, VERTICES = 600, TRIANGLES = 900 };

#define ARENA_MOST ((size_t)1 << 22)

static union {
    struct scene_file_head head;
    uint8_t bytes[ROOM];
    uint64_t aligned;
} right;

static uint32_t size;

/* ---- a right scene ---------------------------------------------------------------------------------------------- */

/* Appends n bytes, 4-byte aligned; NULL: zeros. Returns their offset. */
static uint32_t put(const void *from, size_t n)
{
    const uint32_t at = size;
    if (from != NULL) {
        memcpy(right.bytes + at, from, n);
    }
    size += (uint32_t)((n + 3) & ~(size_t)3);
    return at;
}

static uint32_t put_ramp(void)
{
    uint16_t ramp[PH_RAMP_SIZE];
    ph_material_ramp(ramp, 200, 100, 50, FX_ONE / 4);
    return put(ramp, sizeof ramp);
}

static struct scene_file_texture put_texture(void)
{
    uint16_t texels[4 * 8 + 2 * 4 + 2];
    for (uint32_t i = 0; i < sizeof texels / sizeof *texels; i++) {
        texels[i] = (uint16_t)(i * 0x1234);
    }
    return (struct scene_file_texture){.texels = put(texels, sizeof texels),
                                       .log2_width = 3,
                                       .log2_height = 2,
                                       .filter = SCENE_FILE_MIPMAP,
                                       .levels = 2};
}

static void put_track(uint8_t path, uint8_t interpolation, uint8_t width, struct scene_file_track *track)
{
    static const fx_t times[3] = {0, 1600, 64000};
    int16_t keys[3 * 3 * 4];
    for (uint32_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        keys[i] = (int16_t)(i * 1000);
    }
    *track = (struct scene_file_track){.times = put(times, sizeof times),
                                       .keys = put(keys, sizeof keys),
                                       .key_count = 3,
                                       .path = path,
                                       .interpolation = interpolation,
                                       .width = width,
                                       .frac = 12};
}

static uint32_t put_clips(void)
{
    struct scene_file_track tracks[4];
    put_track(PH_PATH_ROTATION, PH_KEYS_LINEAR, 4, &tracks[0]);
    put_track(PH_PATH_TRANSLATION, PH_KEYS_CUBIC, 3, &tracks[1]);
    put_track(PH_PATH_SCALE, PH_KEYS_STEP, 3, &tracks[2]);
    put_track(PH_PATH_WEIGHTS, PH_KEYS_LINEAR, 2, &tracks[3]);
    const uint32_t all = put(tracks, sizeof tracks);
    const struct scene_file_clip clips[2] = {{.name = "run", .tracks = all, .track_count = 4, .duration = FX_ONE},
                                             {.name = "stand", .tracks = all, .track_count = 1, .duration = 0}};
    return put(clips, sizeof clips);
}

static uint32_t put_motion(void)
{
    static const struct ph_pose rest = {.r = {1 << 30, 0, 0, 0}, .t = {0, 0, 0}, .s = {1 << 24, 1 << 24, 1 << 24}};
    const struct ph_rig_node nodes[2] = {{-1, rest}, {0, rest}};
    const int32_t weights[2] = {0, 1 << 23};
    static const struct fx_vec3 outline[2] = {{-FX_ONE, -FX_ONE, 0}, {FX_ONE, FX_ONE, 0}};
    struct scene_file_motion motion = {.outline = put(outline, sizeof outline),
                                       .outline_count = 2,
                                       .nodes = put(nodes, sizeof nodes),
                                       .rest_weights = put(weights, sizeof weights),
                                       .clips = put_clips(),
                                       .node_count = 2,
                                       .weight_count = 2,
                                       .clip_count = 2};
    memcpy(motion.r, ph_xform_identity.r, sizeof motion.r);
    return put(&motion, sizeof motion);
}

static uint32_t put_moving(void)
{
    static const uint16_t joints[2] = {0, 1};
    static const int16_t targets[2 * 4][3] = {{100, 0, 0}, {0, 900, 0}, {0, 0, -400}};
    const struct ph_xform bind[2] = {ph_xform_identity, ph_xform_identity};
    struct ph_influence influences[4];
    for (uint32_t i = 0; i < 4; i++) {
        influences[i] = (struct ph_influence){{0, 1, 0, 0}, {20000, 12768, 0, 0}};
    }
    const struct scene_file_moving moving = {.joints = put(joints, sizeof joints),
                                             .inverse_bind = put(bind, sizeof bind),
                                             .influences = put(influences, sizeof influences),
                                             .targets = put(targets, sizeof targets),
                                             .target_normals = put(targets, sizeof targets),
                                             .joint_count = 2,
                                             .target_count = 2,
                                             .frac = 14};
    return put(&moving, sizeof moving);
}

static void make_mesh(struct scene_file_mesh *mesh, bool moves)
{
    static const int16_t small[4][3] = {{-9000, -9000, 0}, {9000, -9000, 0}, {0, 9000, 0}, {0, 0, 9000}};
    static const uint16_t triangles[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                          colours[4] = {1, 900, 7, 65535};
    static const fx_t uvs[4][2] = {{0, 0}, {FX_ONE, 0}, {0, FX_ONE}, {FX_ONE, FX_ONE}};
    struct fx_vec3 positions[4];
    for (uint32_t i = 0; i < 4; i++) {
        positions[i] = (struct fx_vec3){small[i][0] * 4, small[i][1] * 4, small[i][2] * 4};
    }
    *mesh = (struct scene_file_mesh){.positions = moves ? put(small, sizeof small) : put(positions, sizeof positions),
                                     .normals = put(small, sizeof small),
                                     .triangles = put(triangles, sizeof triangles),
                                     .ramp = put_ramp(),
                                     .vertex_count = 4,
                                     .triangle_count = 4,
                                     .ambient = FX_ONE / 4,
                                     .diffuse = FX_ONE / 2,
                                     .two_sided = 1,
                                     .shininess_log2 = 3,
                                     .shading = moves ? SCENE_FILE_TEXTURE_GOURAUD : SCENE_FILE_GOURAUD,
                                     .alpha = 16};
    if (moves) {
        mesh->uvs = put(uvs, sizeof uvs);
        mesh->texture = put_texture();
        mesh->alphas = put_texture();
        mesh->blend = SCENE_FILE_MASK;
        mesh->moving = put_moving();
    } else {
        mesh->colours = put(colours, sizeof colours);
        mesh->blend = SCENE_FILE_ALPHA;
    }
}

static void make_right(void)
{
    struct scene_file_mesh meshes[2];
    struct scene_file_head head = {.magic = SCENE_FILE_MAGIC,
                                   .version = SCENE_FILE_VERSION,
                                   .mesh_count = 2,
                                   .flags = SCENE_FILE_CAMERA,
                                   .vertex_max = 100,
                                   .triangle_max = 100,
                                   .name = "fuzz",
                                   .t = {0, 0, FX_INT(-3)},
                                   .lens_kind = PH_PERSPECTIVE,
                                   .scale_x_q20 = 2 << 20,
                                   .scale_y_q20 = 2 << 20,
                                   .near_z = FX_ONE,
                                   .far_z = FX_INT(8)};
    memcpy(head.r, ph_xform_identity.r, sizeof head.r);
    size = sizeof head + sizeof meshes;
    make_mesh(&meshes[0], true);
    make_mesh(&meshes[1], false);
    head.motion = put_motion();
    head.bytes = size;
    memcpy(right.bytes, &head, sizeof head);
    memcpy(right.bytes + sizeof head, meshes, sizeof meshes);
}

/* ---- what is taken ---------------------------------------------------------------------------------------------- */

static void draw(const struct demo *demo, struct demo_context *context)
{
    static uint64_t vertices[VERTICES * 16 / 8], triangles[TRIANGLES * 24 / 8];
    static uint16_t depth[WIDTH * BAND], pixels[WIDTH * BAND];
    static uint32_t bins[(HEIGHT + BAND - 1) / BAND];
    const struct ph_config config = {.width = WIDTH,
                                     .height = HEIGHT,
                                     .band_height = BAND,
                                     .depth_format = PH_DEPTH_AUTO,
                                     .colouring = PH_COLOURS,
                                     .vertices = vertices,
                                     .vertex_max = VERTICES,
                                     .triangles = triangles,
                                     .triangle_max = TRIANGLES,
                                     .bins = bins,
                                     .bin_max = sizeof bins / sizeof *bins,
                                     .depth = depth};
    struct ph_renderer r;
    if (ph_renderer_init(&r, &config) != PH_OK) {
        fuzz_fail("no renderer");
    }
    for (uint32_t frame = 0; frame < 90; frame += 41) {
        const int status = demo->frame(context, &r, frame);
        if (status != PH_OK && status != PH_ERR_NOMEM) {
            fuzz_fail("a scene that was taken cannot be drawn");
        }
        for (uint32_t band = 0, bands = ph_frame_bands(&r); band < bands; band++) {
            if (demo_draw_band(demo, context, &r, band, pixels) == 0) {
                fuzz_fail("a band is missing");
            }
        }
    }
}

static void play(const void *bytes)
{
    const struct demo demo = scene_file_demo(bytes);
    struct demo_context context = {
        .arena = {.size = demo.arena_bytes}, .state = (void *)(uintptr_t)bytes, .width = WIDTH, .height = HEIGHT};
    if (demo.arena_bytes > ARENA_MOST) { /* all meshes share one long list of vertices */
        return;
    }
    context.arena.base = malloc(demo.arena_bytes);
    if (context.arena.base == NULL || demo.init(&context) != PH_OK) {
        fuzz_fail("a scene takes more memory than it says");
    }
    draw(&demo, &context);
    free(context.arena.base);
}

/* Half of the numbers that change are near what they were. */
static void change_numbers(uint8_t *bytes, uint32_t n)
{
    for (uint32_t i = 1 + fuzz_below(3); i > 0; i--) {
        const uint32_t at = 16 + 4 * fuzz_below((n - 16) / 4);
        uint32_t number;
        memcpy(&number, bytes + at, 4);
        number = fuzz_below(2) != 0 ? number + fuzz_below(17) - 8 : fuzz_number();
        if (fuzz_below(3) == 0) {
            memcpy(bytes + at + fuzz_below(4), &number, 1);
        } else {
            memcpy(bytes + at, &number, fuzz_below(3) == 0 ? 2 : 4);
        }
    }
}

static void seal(uint8_t *bytes, size_t n)
{
    const uint32_t crc = crc32_update(0, bytes + 16, n - 16), all = (uint32_t)n;
    memcpy(bytes + 8, &all, 4);
    memcpy(bytes + 12, &crc, 4);
}

static bool one(void)
{
    static uint8_t bytes[ROOM];
    memcpy(bytes, right.bytes, size);
    size_t n = size;
    if (fuzz_below(4) != 0) {
        change_numbers(bytes, size);
    } else {
        n = fuzz_change(bytes, n, ROOM);
    }
    if (n > 16 && fuzz_below(20) != 0) {
        seal(bytes, n);
    }
    uint8_t *const exact = malloc(n > 0 ? n : 1); /* the sanitizer sees a byte too far */
    if (exact == NULL) {
        fuzz_fail("out of memory");
    }
    memcpy(exact, bytes, n);
    const char *const why = scene_file_wrong(exact, n);
    if (why == NULL) {
        play(exact);
    }
    free(exact);
    return why == NULL;
}

int main(int argc, char **argv)
{
    make_right();
    seal(right.bytes, size);
    if (scene_file_wrong(right.bytes, size) != NULL) {
        fuzz_fail(scene_file_wrong(right.bytes, size));
    }
    play(right.bytes);
    return fuzz_main(&(struct fuzz){"fuzz_scene", 4000, 400000, one}, argc, argv);
}
