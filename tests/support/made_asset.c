/* See made_asset.h. */
#include "made_asset.h"

#include <string.h>

enum { VERTICES = 5, TRIANGLES = 3, TARGETS = 2 };

static struct made {
    struct asset asset;
    struct ph_mesh meshes[MADE_MESHES];
    struct ph_material materials[MADE_MESHES];
    struct ph_part parts[MADE_MESHES];
    struct ph_blend blended, added;
    struct ph_texture texture, alphas;
    uint16_t texels[21], alpha_texels[8]; /* 4 x 4 and two levels; 2 x 4 */
    uint16_t ramps[MADE_MESHES][PH_RAMP_SIZE];
    uint32_t first_ramps[MADE_MESHES];
    struct fx_vec3 positions[MADE_MESHES][VERTICES];
    int16_t normals[MADE_MESHES][VERTICES][3];
    fx_t uvs[MADE_MESHES][VERTICES][2];
    uint16_t triangles[MADE_MESHES][TRIANGLES][3], colours[VERTICES];

    struct model_motion motion;
    struct animation_mesh moving[MADE_MOVING];
    int16_t bound[MADE_MOVING][VERTICES][3], targets[MADE_MOVING][TARGETS * VERTICES][3];
    int16_t target_normals[TARGETS * VERTICES][3];
    struct ph_influence influences[VERTICES];
    struct ph_rig_node nodes[MADE_NODES];
    int32_t weights[MADE_WEIGHTS];
    uint16_t joints[MADE_MOVING][3];
    struct ph_xform binds[MADE_MOVING][3];
    struct ph_clip clips[MADE_CLIPS];
    struct ph_track tracks[4];
    fx_t times[3][7];
    int16_t keys[4][24];
} made;

/* Numbers from `first` on into n things of two bytes. */
static void count_up(void *to, size_t n, uint16_t first)
{
    for (size_t i = 0; i < n; i++) {
        ((uint16_t *)to)[i] = (uint16_t)(first + 7 * i);
    }
}

static void make_mesh(uint32_t m, uint32_t vertices, uint32_t triangles)
{
    for (uint32_t i = 0; i < vertices; i++) {
        const int32_t n = (int32_t)(1000 * m + 10 * i);
        made.positions[m][i] = (struct fx_vec3){-70000 - n, 1 + n, 40000 + 3 * n};
        made.uvs[m][i][0] = 65536 - n;
        made.uvs[m][i][1] = 2 * n - 3000;
    }
    count_up(made.normals[m], (size_t)vertices * 3, (uint16_t)(65000 + 100 * m));
    for (uint32_t i = 0; i < triangles * 3; i++) {
        made.triangles[m][i / 3][i % 3] = (uint16_t)((i / 3 + i % 3) % vertices);
    }
    count_up(made.ramps[m], PH_RAMP_SIZE, (uint16_t)(m < 2 ? 500 : 3000 * m));
    made.first_ramps[m] = m == 1 ? 0 : m;
    made.parts[m] = (struct ph_part){.count = triangles};
    made.materials[m] = (struct ph_material){.shading = PH_SHADE_GOURAUD,
                                             .shininess_log2 = (uint8_t)(m + 1),
                                             .depth_bias = (uint8_t)(5 * m),
                                             .ambient = (fx_t)(100 + m),
                                             .diffuse = (fx_t)(2000 + m),
                                             .specular = (fx_t)(30000 + m),
                                             .colour = (uint16_t)(0x1234 * (m + 1)),
                                             .ramp = made.ramps[m]};
    made.meshes[m] = (struct ph_mesh){.positions = made.positions[m],
                                      .normals = (const int16_t(*)[3])made.normals[m],
                                      .triangles = (const uint16_t(*)[3])made.triangles[m],
                                      .parts = &made.parts[m],
                                      .materials = &made.materials[m],
                                      .vertex_count = vertices,
                                      .triangle_count = triangles,
                                      .part_count = 1,
                                      .material_count = 1};
}

static void make_surfaces(void)
{
    count_up(made.texels, 21, 0x4321);
    count_up(made.alpha_texels, 8, 0x0765);
    count_up(made.colours, VERTICES, 0xABCD);
    made.texture = (struct ph_texture){.texels = made.texels,
                                       .log2_width = 2,
                                       .log2_height = 2,
                                       .wrap = PH_WRAP_REPEAT,
                                       .filter = PH_FILTER_MIPMAP,
                                       .levels = 2};
    made.alphas = (struct ph_texture){.texels = made.alpha_texels,
                                      .log2_width = 1,
                                      .log2_height = 2,
                                      .wrap = PH_WRAP_CLAMP,
                                      .filter = PH_FILTER_BILINEAR};
    made.blended =
        (struct ph_blend){.draw = ph_draw_blended_alphas, .kind = PH_BLEND_ALPHA, .alpha = 20, .alphas = &made.alphas};
    made.added = (struct ph_blend){.draw = ph_draw_blended, .kind = PH_BLEND_ADD, .alpha = 30};
    made.materials[1].shading = PH_SHADE_TEXTURE_LIT;
    made.materials[1].blend = &made.blended;
    made.materials[2].shading = PH_SHADE_TEXTURE;
    made.materials[2].blend = &made.added;
    made.materials[1].texture = made.materials[2].texture = &made.texture;
    made.materials[3].shading = PH_SHADE_UNLIT;
    made.materials[3].blend = &made.blended;
    made.materials[3].two_sided = true;
    made.meshes[3].colours = made.colours;
    for (uint32_t m = 1; m < MADE_MESHES; m++) {
        made.meshes[m].uvs = (const fx_t(*)[2])made.uvs[m];
    }
}

static void make_moving_mesh(uint32_t i, uint32_t mesh, uint32_t joints, uint32_t targets, uint32_t first_weight)
{
    const struct ph_mesh *const m = &made.meshes[mesh];
    count_up(made.bound[i], (size_t)m->vertex_count * 3, (uint16_t)(300 * i + 11));
    count_up(made.targets[i], (size_t)targets * m->vertex_count * 3, (uint16_t)(400 * i + 64990));
    made.moving[i] = (struct animation_mesh){.mesh = mesh,
                                             .bound = {.positions = (const int16_t(*)[3])made.bound[i],
                                                       .normals = m->normals,
                                                       .vertex_count = m->vertex_count,
                                                       .frac = (uint8_t)(14 + i)},
                                             .skin = {made.joints[i], made.binds[i], joints},
                                             .first_weight = first_weight};
    if (targets > 0) {
        made.moving[i].morph = (struct ph_morph){.positions = (const int16_t(*)[3])made.bound[i],
                                                 .normals = m->normals,
                                                 .d_positions = (const int16_t(*)[3])made.targets[i],
                                                 .vertex_count = m->vertex_count,
                                                 .target_count = targets};
    }
}

static struct ph_xform matrix(int32_t x)
{
    const int32_t one = 1 << 30;
    return (struct ph_xform){.r = {{one, 0, 0}, {0, one, 0}, {0, 0, one}}, .t = {x, x + 1, -x}};
}

static void make_rig(void)
{
    for (uint32_t i = 0; i < MADE_NODES; i++) {
        const int32_t n = (int32_t)i;
        made.nodes[i] = (struct ph_rig_node){.parent = (int16_t)(n - 1),
                                             .rest = {.r = {.w = 1 << 30},
                                                      .t = {100 + n, 200 + n, -300 - n},
                                                      .s = {PH_MOTION_ONE, PH_MOTION_ONE - n, PH_MOTION_ONE + n}}};
        made.weights[i] = 1000 - 700 * n;
    }
    for (uint32_t i = 0; i < MADE_MOVING; i++) { /* the skins of 0 and 2 are equal, and lie apart */
        made.joints[i][0] = i == 1 ? 0 : 1;
        made.joints[i][1] = 2;
        made.binds[i][0] = matrix(i == 1 ? 40 : 50);
        made.binds[i][1] = matrix(60);
        made.binds[i][2] = matrix(70);
    }
    for (uint32_t v = 0; v < VERTICES; v++) {
        made.influences[v] = (struct ph_influence){{(uint8_t)(v % 2), (uint8_t)((v + 1) % 2), 0, 0},
                                                   {(uint16_t)(20000 + v), (uint16_t)(12768 - v), 0, 0}};
    }
    make_moving_mesh(0, 0, 3, 0, 0);
    make_moving_mesh(1, 2, 1, 2, 1);
    make_moving_mesh(2, 3, 3, 1, 0);
    made.moving[0].bound.influences = made.influences;
    count_up(made.target_normals, sizeof made.target_normals / 2, 65200);
    made.moving[1].morph.d_normals = (const int16_t(*)[3])made.target_normals;
}

static void make_clips(void)
{
    static const struct ph_track tracks[] = {
        {.node = 2, .path = PH_PATH_SCALE, .interpolation = PH_KEYS_STEP, .width = 3, .frac = 12, .key_count = 1},
        {.node = 1,
         .path = PH_PATH_TRANSLATION,
         .interpolation = PH_KEYS_LINEAR,
         .width = 3,
         .frac = 13,
         .key_count = 2},
        {.node = 0, .path = PH_PATH_ROTATION, .interpolation = PH_KEYS_CUBIC, .width = 4, .frac = 14, .key_count = 2},
        {.node = 1, .path = PH_PATH_WEIGHTS, .interpolation = PH_KEYS_LINEAR, .width = 2, .frac = 10, .key_count = 7}};
    for (uint32_t i = 0; i < 21; i++) {
        made.times[i / 7][i % 7] = (fx_t)(100000 * (i / 7) + 7 * (i % 7));
    }
    for (uint32_t i = 0; i < 4; i++) {
        made.tracks[i] = tracks[i];
        count_up(made.keys[i], 24, (uint16_t)(1000 * i + 65000));
        made.tracks[i].times = made.times[i < 2 ? i : i - 1]; /* two share theirs */
        made.tracks[i].keys = made.keys[i];
    }
    made.clips[0] = (struct ph_clip){.name = "stand", .tracks = made.tracks, .track_count = 1, .duration = 32768};
    made.clips[1] =
        (struct ph_clip){.name = "walk \"2/3\"", .tracks = made.tracks + 1, .track_count = 3, .duration = 3 << 16};
}

static void make_motion(void)
{
    make_rig();
    make_clips();
    made.motion = (struct model_motion){.animation = {.rig = {made.nodes, MADE_NODES},
                                                      .root = matrix(-9),
                                                      .clip = &made.clips[1],
                                                      .clips = made.clips,
                                                      .clip_count = MADE_CLIPS,
                                                      .cross_fade = 12345,
                                                      .meshes = made.moving,
                                                      .mesh_count = MADE_MOVING,
                                                      .weight_count = MADE_WEIGHTS,
                                                      .rest_weights = made.weights}};
    made.asset.model.motion = &made.motion;
}

struct asset *made_asset(bool moves)
{
    memset(&made, 0, sizeof made);
    make_mesh(0, 3, 1);
    make_mesh(1, 4, 2);
    make_mesh(2, 5, 3);
    make_mesh(3, 3, 1);
    make_surfaces();
    made.asset = (struct asset){
        .model = {.meshes = made.meshes, .mesh_count = MADE_MESHES, .vertex_max = 5, .triangle_count = 7},
        .materials = made.materials,
        .first_ramps = made.first_ramps,
        .name = "made-by_hand",
        .triangles_read = 9,
        .vertices_read = 20,
        .listed = 77};
    if (moves) {
        make_motion();
    }
    return &made.asset;
}

struct ph_material *made_material(uint32_t mesh)
{
    return &made.materials[mesh];
}

struct ph_blend *made_blend(uint32_t mesh)
{
    return mesh == 2 ? &made.added : &made.blended;
}

struct animation_mesh *made_moving(uint32_t i)
{
    return &made.moving[i];
}
