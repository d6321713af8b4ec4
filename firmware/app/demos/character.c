/*
 * character: a figure that walks, and runs, in a circle. It is made of three tubes of elliptic rings: the body, an arm
 * and a leg; both arms are the same mesh that follows other joints, and so are the legs. The two clips have one length,
 * so that a cross-fade between them keeps step. The lowest sole stands on the ground.
 */
#include "demo_scene.h"
#include "fx_math.h"
#include "models.h"
#include "motion.h"
#include "shadow.h"

#define LOOP_FRAMES       256
#define CYCLE_FRAMES      32 /* two steps */
#define FADE_FRAMES       16
#define WALK              93000 /* Q16.16: the way of a cycle */
#define RUN               131000
#define MM(v)             ((v) * (PH_MOTION_ONE / 1000))
#define FRAC              15      /* of the positions */
#define RADIUS            135660  /* 2.07 */
#define DEMO_SCALE_39_Q20 2950000 /* 1 / tan(19.57 degrees) */

/* ---- the rig, in thousandths ------------------------------------------------------------------------------------- */

enum {
    HIPS,
    SPINE,
    CHEST,
    NECK,
    HEAD,
    ARM,             /* upper arm, forearm, hand; left, then right */
    LEG = ARM + 6,   /* thigh, shin, foot, toes; left, then right */
    NODES = LEG + 8, /* 19 */
};

#define NODE(parent, x, y, z)                                                                                          \
    {                                                                                                                  \
        parent,                                                                                                        \
        {                                                                                                              \
            {FX_Q30_ONE, 0, 0, 0}, {MM(x), MM(y), MM(z)},                                                              \
            {                                                                                                          \
                PH_MOTION_ONE, PH_MOTION_ONE, PH_MOTION_ONE                                                            \
            }                                                                                                          \
        }                                                                                                              \
    }

static const struct ph_rig_node nodes[NODES] = {
    NODE(-1, 0, 950, 0),       NODE(HIPS, 0, 120, 0),     NODE(SPINE, 0, 160, 0),     NODE(CHEST, 0, 210, 0),
    NODE(NECK, 0, 70, 0),      NODE(CHEST, 184, 122, 0),  NODE(ARM, 0, -270, 0),      NODE(ARM + 1, 0, -250, 0),
    NODE(CHEST, -184, 122, 0), NODE(ARM + 3, 0, -270, 0), NODE(ARM + 4, 0, -250, 0),  NODE(HIPS, 95, -45, 0),
    NODE(LEG, 0, -420, 0),     NODE(LEG + 1, 0, -400, 0), NODE(LEG + 2, 0, -60, 110), NODE(HIPS, -95, -45, 0),
    NODE(LEG + 4, 0, -420, 0), NODE(LEG + 5, 0, -400, 0), NODE(LEG + 6, 0, -60, 110),
};
static const struct ph_rig rig = {nodes, NODES};

struct ring {
    int16_t y, half_x, half_z, z;
};

static const struct ring body_rings[] = {
    {-110, 0, 0, 0},    {-70, 140, 100, 0}, {-20, 162, 112, 0}, {50, 148, 100, 0}, {110, 126, 84, 0},
    {240, 150, 100, 4}, {310, 166, 108, 6}, {380, 172, 104, 4}, {430, 152, 92, 0}, {465, 96, 70, 0},
    {505, 50, 53, 2},   {552, 60, 70, 14},  {590, 80, 94, 14},  {640, 95, 111, 8}, {735, 100, 116, 0},
    {785, 90, 106, 0},  {825, 66, 78, 0},   {846, 34, 42, 0},   {852, 0, 0, 0},
};
static const struct ring arm_rings[] = {
    {-680, 0, 0, 6},   {-674, 14, 22, 6}, {-650, 24, 38, 6}, {-610, 31, 47, 4}, {-560, 31, 44, 0}, {-520, 27, 30, 0},
    {-480, 33, 32, 0}, {-400, 42, 40, 0}, {-320, 46, 45, 0}, {-270, 45, 46, 0}, {-220, 48, 47, 0}, {-150, 55, 52, 0},
    {-80, 61, 58, 0},  {-20, 69, 66, 0},  {30, 60, 60, 0},   {52, 34, 34, 0},   {60, 0, 0, 0},
};
static const struct ring leg_rings[] = {
    {-905, 0, 0, 70},  {-904, 46, 128, 70}, {-890, 52, 136, 70}, {-860, 49, 124, 62}, {-825, 42, 84, 28},
    {-780, 36, 42, 0}, {-700, 41, 44, -4},  {-620, 52, 56, -10}, {-540, 56, 62, -8},  {-470, 55, 58, 0},
    {-420, 57, 60, 4}, {-340, 65, 67, 2},   {-250, 77, 80, 0},   {-150, 87, 92, 0},   {-50, 92, 98, 0},
    {25, 80, 84, 0},   {50, 0, 0, 0},
};

#define COUNT(a)  ((uint32_t)(sizeof(a) / sizeof((a)[0])))
#define JOINTS    5
#define TOES_Z    110
#define TOES_SOFT 40

#define BIND(y, z)                                                                                                     \
    {                                                                                                                  \
        {{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}},                                                  \
        {                                                                                                              \
            0, -MM(y), -MM(z)                                                                                          \
        }                                                                                                              \
    }
static const struct ph_xform body_bind[] = {BIND(0, 0), BIND(120, 0), BIND(280, 0), BIND(490, 0), BIND(560, 0)};
static const struct ph_xform arm_bind[] = {BIND(0, 0), BIND(-270, 0), BIND(-520, 0)};
static const struct ph_xform leg_bind[] = {BIND(0, 0), BIND(-420, 0), BIND(-820, 0), BIND(-880, TOES_Z)};

/* A tube from its lowest ring to its highest; joint k bends it around joint_y[k], `soft` up and down. */
static const struct tube {
    const struct ring *rings;
    uint32_t count;
    int16_t joints, joint_y[JOINTS], soft;
    bool is_upwards, has_toes; /* the way in which joints follow each other; the last one is in front */
    uint8_t rows_from, rows;   /* of the texture, of 128, from the top */
    uint8_t places, nodes[2];  /* first joint of each place that it is drawn at */
    const struct ph_xform *inverse_bind;
} tubes[] = {
    {body_rings, COUNT(body_rings), 5, {0, 120, 280, 490, 560}, 70, true, false, 0, 72, 1, {HIPS}, body_bind},
    {arm_rings, COUNT(arm_rings), 3, {0, -270, -520}, 55, false, false, 72, 28, 2, {ARM, ARM + 3}, arm_bind},
    {leg_rings, COUNT(leg_rings), 4, {0, -420, -820, -880}, 70, false, true, 100, 28, 2, {LEG, LEG + 4}, leg_bind},
};

#define TUBES COUNT(tubes)

/* ---- the clips: degrees in eight moments of a cycle, which begins when the left heel touches the ground ---------- */

#define MOMENTS 8
#define KEYS    (MOMENTS + MOMENTS / 2 + 1) /* the right side begins half a cycle later */

struct swing {
    uint8_t left, right; /* nodes; right 0: none */
    bool is_turn;        /* about y, else about x */
    int8_t degrees[MOMENTS];
};

#define SWINGS 9
static const struct swing swings[2][SWINGS] = {
    {
        {LEG, LEG + 4, false, {-25, -19, -7, 7, 18, 8, -15, -27}},
        {LEG + 1, LEG + 5, false, {5, 16, 11, 7, 20, 54, 58, 22}},
        {LEG + 2, LEG + 6, false, {-5, 4, -4, -9, 4, 18, 2, -6}},
        {LEG + 3, LEG + 7, false, {0, 0, 0, -8, -28, -6, 0, 0}},
        {ARM, ARM + 3, false, {24, 19, 6, -9, -23, -18, -5, 10}},
        {ARM + 1, ARM + 4, false, {-14, -14, -17, -24, -33, -30, -23, -17}},
        {HIPS, 0, true, {-8, -6, 0, 6, 8, 6, 0, -6}},
        {CHEST, 0, true, {15, 11, 0, -11, -15, -11, 0, 11}},
        {SPINE, 0, false, {3, 3, 3, 3, 3, 3, 3, 3}},
    },
    {
        {LEG, LEG + 4, false, {-34, -18, 4, 22, 16, -18, -48, -50}},
        {LEG + 1, LEG + 5, false, {16, 36, 26, 16, 52, 98, 88, 38}},
        {LEG + 2, LEG + 6, false, {-4, -6, -12, 12, 20, 6, 0, -4}},
        {LEG + 3, LEG + 7, false, {0, 0, -5, -24, -10, 0, 0, 0}},
        {ARM, ARM + 3, false, {44, 32, 4, -24, -38, -28, -2, 26}},
        {ARM + 1, ARM + 4, false, {-70, -76, -86, -94, -98, -92, -84, -74}},
        {HIPS, 0, true, {-10, -7, 0, 7, 10, 7, 0, -7}},
        {CHEST, 0, true, {20, 14, 0, -14, -20, -14, 0, 14}},
        {SPINE, 0, false, {12, 13, 14, 13, 12, 13, 14, 13}},
    },
};

/* The hips' place when the figure runs: it flies twice a cycle. x, y, z in Q2.14. */
#define HIPS_Y 15565
#define FLIGHT 1000
static const int16_t flight[MOMENTS + 1][3] = {{0, HIPS_Y, 0},          {0, HIPS_Y, 0},          {0, HIPS_Y, 0},
                                               {0, HIPS_Y + FLIGHT, 0}, {0, HIPS_Y, 0},          {0, HIPS_Y, 0},
                                               {0, HIPS_Y, 0},          {0, HIPS_Y + FLIGHT, 0}, {0, HIPS_Y, 0}};
static const uint16_t moments[MOMENTS + 1] = {0, 4096, 8192, 12288, 16384, 20480, 24576, 28672, 32768};

#define TRACKS (2 * 6 + 3 + 1)
struct gait {
    struct ph_clip clip;
    struct ph_track tracks[TRACKS];
    int16_t keys[SWINGS][KEYS][3][4];
};

static void set_value(const struct swing *swing, uint32_t moment, int16_t to[4])
{
    const struct fx_vec3 axis = {swing->is_turn ? 0 : FX_ONE, swing->is_turn ? FX_ONE : 0, 0};
    const uint32_t turn32 = fx_turn32_from_deg(swing->degrees[moment % MOMENTS] * FX_ONE);
    const struct fx_quat q = fx_quat_axis(axis, turn32);
    const int32_t key[4] = {q.x, q.y, q.z, q.w};
    for (uint32_t i = 0; i < 4; i++) { /* of the two quaternions of a rotation that with w > 0 */
        to[i] = (int16_t)((q.w < 0 ? -key[i] : key[i]) >> 16);
    }
}

/* Smooth splines: a tangent is half of the way from the moment before to the moment behind. */
static void make_keys(const struct swing *swing, int16_t keys[KEYS][3][4])
{
    for (uint32_t k = 0; k < KEYS; k++) {
        int16_t before[4], behind[4];
        set_value(swing, k, keys[k][1]);
        set_value(swing, k + MOMENTS - 1, before);
        set_value(swing, k + 1, behind);
        for (uint32_t i = 0; i < 4; i++) {
            keys[k][0][i] = keys[k][2][i] = (int16_t)((behind[i] - before[i]) / 2);
        }
    }
}

static void make_gait(struct gait *gait, uint32_t which)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < SWINGS; i++) {
        const struct swing *const swing = &swings[which][i];
        struct ph_track track = {.node = swing->left,
                                 .path = PH_PATH_ROTATION,
                                 .interpolation = PH_KEYS_CUBIC,
                                 .width = 4,
                                 .frac = 14,
                                 .key_count = MOMENTS + 1,
                                 .times = moments,
                                 .keys = &gait->keys[i][0][0][0]};
        make_keys(swing, gait->keys[i]);
        gait->tracks[count++] = track;
        if (swing->right) {
            track.node = swing->right;
            track.keys = &gait->keys[i][MOMENTS / 2][0][0];
            gait->tracks[count++] = track;
        }
    }
    if (which == 1) {
        gait->tracks[count++] = (struct ph_track){.node = HIPS,
                                                  .path = PH_PATH_TRANSLATION,
                                                  .interpolation = PH_KEYS_LINEAR,
                                                  .width = 3,
                                                  .frac = 14,
                                                  .key_count = MOMENTS + 1,
                                                  .times = moments,
                                                  .keys = flight[0]};
    }
    gait->clip = (struct ph_clip){which ? "run" : "walk", gait->tracks, count, FX_ONE, 1};
}

/* ---- the tubes --------------------------------------------------------------------------------------------------- */

/* How fine a tube is: its sides, and each ring or each second. */
struct mesh_detail {
    uint8_t sides, every;
};

/* A level: of the figure, of its shadow (sides 0: none), sides of the ground; 128 >> this rows of the texture. */
struct detail {
    struct mesh_detail figure, shadow;
    uint8_t ground, texture_down;
    bool runs;
};

#define LEVELS     4
#define SIDES_MOST 31

#define RINGS_OF(count, every) (((count)-1) / (every) + 1)
#define RINGS_MOST(every)      RINGS_OF(COUNT(body_rings), every)
#define RINGS(every)           (RINGS_MOST(every) + RINGS_OF(COUNT(arm_rings), every) + RINGS_OF(COUNT(leg_rings), every))
#define RINGS_DRAWN(every)     (2 * RINGS(every) - RINGS_MOST(every))
#define GRID(sides, every)     (2 * (sides) * (RINGS_MOST(every) - 1)) /* triangles */

/* Triangles between rings of sides + 1 vertices, from the lowest on. All tubes take as many of them as they have. */
static bool make_grid(struct demo_arena *arena, uint16_t (**grid)[3], struct mesh_detail detail)
{
    const uint32_t sides = detail.sides, n = GRID(sides, detail.every);
    *grid = demo_alloc(arena, n * sizeof **grid);
    for (uint32_t i = 0; *grid && i < n; i++) {
        const uint32_t square = i / 2, a = square / sides * (sides + 1) + square % sides, c = a + sides + 2;
        (*grid)[i][0] = (uint16_t)a;
        (*grid)[i][1] = (uint16_t)(i % 2 ? c : c - 1);
        (*grid)[i][2] = (uint16_t)(i % 2 ? a + 1 : c);
    }
    return *grid != NULL;
}

/* From the back over the left, and from the highest ring down. */
static bool make_uvs(struct demo_arena *arena, fx_t (**uvs)[2], const struct tube *tube, struct mesh_detail detail)
{
    const uint32_t points = detail.sides + 1U, n = points * RINGS_OF(tube->count, detail.every);
    const int32_t top = tube->rings[tube->count - 1].y, height = top - tube->rings[0].y;
    *uvs = demo_alloc(arena, n * sizeof **uvs);
    for (uint32_t v = 0; *uvs && v < n; v++) {
        const int32_t down = top - tube->rings[v / points * detail.every].y, row = FX_ONE / 128;
        (*uvs)[v][0] = (fx_t)(v % points * 65536 / detail.sides);
        (*uvs)[v][1] = tube->rows_from * row + row / 2 + down * (tube->rows - 1) * (row / 4) / height * 4;
    }
    return *uvs != NULL;
}

/* Shares of the two joints around a height, and of the toes where the point is in front of them. */
static struct ph_influence influence_at(const struct tube *tube, int32_t y, int32_t z)
{
    int32_t share = PH_INFLUENCE_ONE, joint = 0, other = 0;
    for (int32_t k = 1; k < tube->joints - tube->has_toes; k++) {
        const int32_t past = (tube->is_upwards ? y - tube->joint_y[k] : tube->joint_y[k] - y) + tube->soft;
        if (past > 0) {
            other = k - 1;
            joint = k;
            share = fx_min(past * PH_INFLUENCE_ONE / (2 * tube->soft), PH_INFLUENCE_ONE);
        }
    }
    if (tube->has_toes && z > TOES_Z - TOES_SOFT) {
        other = joint;
        joint = tube->joints - 1;
        share = fx_min((z - TOES_Z + TOES_SOFT) * PH_INFLUENCE_ONE / (2 * TOES_SOFT), PH_INFLUENCE_ONE);
    }
    const bool is_first = share >= PH_INFLUENCE_ONE / 2;
    const int32_t greater = is_first ? share : PH_INFLUENCE_ONE - share;
    return (struct ph_influence){{(uint8_t)(is_first ? joint : other), (uint8_t)(is_first ? other : joint)},
                                 {(uint16_t)greater, (uint16_t)(PH_INFLUENCE_ONE - greater)}};
}

/* A ring in the bind pose. */
struct loop {
    int16_t positions[SIDES_MOST + 1][3], normals[SIDES_MOST + 1][3];
    struct ph_influence influences[SIDES_MOST + 1];
};

/*
 * A point is (a sin, y, z - b cos) of its angle. Its normal is the product of the way from the ring below to that above
 * and of the way around the ring, (a cos, 0, b sin); ph_skin_vertices() brings it to length one.
 */
static void make_loop(struct loop *loop, const struct tube *tube, uint32_t ring, struct mesh_detail detail)
{
    const struct ring *const r = &tube->rings[ring];
    const struct ring *const below = ring > 0 ? r - detail.every : r;
    const struct ring *const above = ring + 1 < tube->count ? r + detail.every : r;
    const int32_t end = ring > 0 ? 1 : -1; /* the normal where a ring is a point */
    const int32_t a = r->half_x, b = r->half_z, dy = above->y - below->y, dz = above->z - below->z,
                  da = above->half_x - below->half_x, db = above->half_z - below->half_z;
    for (uint32_t k = 0; k <= detail.sides; k++) {
        const fx_t turns = (fx_t)(k * 65536 / detail.sides);
        const int32_t sin = fx_sin(turns) >> 2, cos = fx_cos(turns) >> 2; /* Q1.14 */
        const int32_t z = r->z - ((b * cos) >> 14);
        const int32_t rise = (((dz - ((db * cos) >> 14)) * a * cos) >> 14) - (((((da * sin) >> 14) * b) * sin) >> 14);
        const int16_t position[3] = {(int16_t)(a * sin * 2 / 1000), (int16_t)(r->y * 32768 / 1000),
                                     (int16_t)((r->z * 32768 - b * cos * 2) / 1000)};
        const int16_t normal[3] = {(int16_t)((dy * b * sin) >> 16), (int16_t)(a > 0 ? rise / 4 : end),
                                   (int16_t)(-(dy * a * cos) >> 16)};
        for (uint32_t i = 0; i < 3; i++) {
            loop->positions[k][i] = position[i];
            loop->normals[k][i] = normal[i];
        }
        loop->influences[k] = influence_at(tube, r->y, z);
    }
}

/* The tube's vertices as its joints are now. */
static void skin_tube(const struct tube *tube, struct mesh_detail detail, const struct ph_xform *joints,
                      struct fx_vec3 *positions, int16_t (*normals)[3])
{
    struct loop loop;
    const uint32_t points = detail.sides + 1U;
    const struct ph_bound bound = {(const int16_t(*)[3])loop.positions, (const int16_t(*)[3])loop.normals,
                                   loop.influences, points, FRAC};
    for (uint32_t ring = 0, v = 0; ring < tube->count; ring += detail.every, v += points) {
        make_loop(&loop, tube, ring, detail);
        ph_skin_vertices(&bound, joints, positions + v, normals ? normals + v : NULL);
    }
}

/* ---- the texture: 32 x 128 texels, rows 0 .. 71 of the body, 72 .. 99 of an arm, 100 .. 127 of a leg ------------- */

struct patch {
    uint8_t row, rows, column, columns; /* from the top; from the back over the left */
    uint8_t red, green, blue;
};

/* Each lies over those before it. */
static const struct patch patches[] = {
    {0, 31, 0, 32, 236, 186, 148}, /* head and neck */
    {0, 9, 0, 32, 92, 52, 28},     /* hair */
    {9, 11, 0, 9, 92, 52, 28},      {9, 11, 23, 9, 92, 52, 28},     {9, 3, 9, 14, 92, 52, 28},
    {13, 3, 13, 2, 250, 250, 250},  {13, 3, 17, 2, 250, 250, 250}, /* eyes */
    {13, 3, 14, 1, 36, 60, 120},    {13, 3, 17, 1, 36, 60, 120},    {12, 1, 12, 3, 70, 40, 24},
    {12, 1, 17, 3, 70, 40, 24},     {20, 1, 14, 4, 190, 80, 80}, /* mouth */
    {28, 44, 0, 32, 222, 74, 52},                                /* shirt */
    {38, 4, 0, 32, 250, 236, 210},  {40, 1, 0, 32, 222, 74, 52},    {57, 2, 0, 32, 60, 44, 40},
    {57, 2, 15, 2, 230, 200, 90},                                   /* belt */
    {59, 13, 0, 32, 58, 74, 128},                                   /* trousers */
    {72, 11, 0, 32, 222, 74, 52},   {82, 1, 0, 32, 250, 236, 210},  /* sleeve */
    {83, 17, 0, 32, 236, 186, 148}, {93, 1, 0, 32, 40, 40, 48},     /* arm, watch */
    {100, 25, 0, 32, 58, 74, 128},  {121, 1, 0, 32, 240, 240, 240}, /* leg, sock */
    {122, 6, 0, 32, 52, 150, 96},   {126, 2, 0, 32, 240, 240, 240}, /* shoe */
};

static int make_texture(struct demo_arena *arena, struct ph_texture *texture, uint32_t down)
{
    const uint32_t width = 32U >> down, height = 128U >> down;
    uint16_t *const texels = demo_alloc(arena, width * height * sizeof *texels);
    for (uint32_t i = 0; texels && i < width * height; i++) {
        const uint32_t column = i % width << down, row = i / width << down;
        for (uint32_t k = 0; k < COUNT(patches); k++) {
            const struct patch *const p = &patches[k];
            if (row - p->row < p->rows && column - p->column < p->columns) {
                texels[i] = ph_rgb565(p->red, p->green, p->blue);
            }
        }
    }
    *texture = (struct ph_texture){
        .texels = texels, .log2_width = (uint8_t)(5 - down), .log2_height = (uint8_t)(7 - down), .wrap = PH_WRAP_REPEAT};
    return texels ? PH_OK : PH_ERR_NOMEM;
}

/* ---- the ground: rings of tiles around a pond -------------------------------------------------------------------- */

#define TILE_RINGS          3
#define GROUND_VERTICES(n)  ((TILE_RINGS + 1) * (n))
#define GROUND_TRIANGLES(n) (2 * TILE_RINGS * (n) + (n)-2)

static int make_ground(struct demo_arena *arena, struct ph_mesh *mesh, uint32_t n, const struct ph_material *tiles)
{
    static const int32_t radius[TILE_RINGS + 1] = {1080, 1740, 2400, 3060};
    struct fx_vec3 *const positions = demo_alloc(arena, GROUND_VERTICES(n) * sizeof *positions);
    uint16_t(*const triangles)[3] = demo_alloc(arena, GROUND_TRIANGLES(n) * sizeof *triangles);
    struct ph_part *const parts = demo_alloc(arena, 3 * sizeof *parts);
    if (!parts || !positions || !triangles) {
        return PH_ERR_NOMEM;
    }
    for (uint32_t v = 0; v < GROUND_VERTICES(n); v++) {
        const fx_t turns = (fx_t)(v % n * 65536 / n), r = radius[v / n] * FX_ONE / 1000;
        positions[v] = (struct fx_vec3){fx_mul_sat(r, fx_sin(turns)), 0, fx_mul_sat(r, fx_cos(turns))};
    }
    uint32_t at = 0;
    for (uint32_t i = 0; i < TILE_RINGS * n * 2; i++) { /* the tiles of one colour, then those of the other */
        const uint32_t tile = i % (TILE_RINGS * n), ring = tile / n, k = tile % n;
        if ((ring + k) % 2 == i / (TILE_RINGS * n)) {
            const uint16_t a = (uint16_t)(ring * n + k), b = (uint16_t)(ring * n + (k + 1) % n);
            const uint16_t pair[2][3] = {{a, (uint16_t)(a + n), (uint16_t)(b + n)}, {a, (uint16_t)(b + n), b}};
            for (uint32_t c = 0; c < 6; c++) {
                triangles[at + c / 3][c % 3] = pair[c / 3][c % 3];
            }
            at += 2;
        }
    }
    parts[0] = (struct ph_part){0, at / 2, 0};
    parts[1] = (struct ph_part){at / 2, at / 2, 1};
    parts[2] = (struct ph_part){at, n - 2, 2};
    for (uint32_t k = 1; k < n - 1; k++, at++) {
        triangles[at][0] = 0;
        triangles[at][1] = (uint16_t)k;
        triangles[at][2] = (uint16_t)(k + 1);
    }
    *mesh = (struct ph_mesh){.positions = positions,
                             .triangles = (const uint16_t(*)[3])triangles,
                             .parts = parts,
                             .materials = tiles,
                             .vertex_count = GROUND_VERTICES(n),
                             .triangle_count = at,
                             .part_count = 3};
    return PH_OK;
}

/* ---- the demo ---------------------------------------------------------------------------------------------------- */

struct character {
    struct ph_mesh ground;
    struct ph_texture texture;
    struct ph_material skin, tiles[3], shade;
    const struct detail *detail;
    uint16_t (*grids[2])[3]; /* of the figure, of its shadow */
    fx_t (*uvs[TUBES])[2];
    struct gait *gaits[2];     /* walk, run; NULL where memory is small */
    struct fx_vec3 *positions; /* of one tube, skinned */
    int16_t (*normals)[3];
    struct ph_xform joints[JOINTS]; /* of the tube that is drawn */
    struct ph_pose pose[NODES];
    union {
        struct ph_pose other[NODES]; /* which pose fades to */
        struct ph_xform places[NODES];
    };
};

static const struct detail details[LEVELS] = {
    {{14, 1}, {8, 2}, 32, 0, true},
    {{10, 1}, {5, 2}, 16, 1, true},
    {{8, 2}, {5, 2}, 16, 1, true},
    {{6, 2}, {0, 2}, 12, 2, false},
};

#define UV_BYTES(s, count, every) MODEL_ROUND8(8 * ((s) + 1) * RINGS_OF(COUNT(count), every))
#define ARENA(s, every, shadow, ground, down, gaits)                                                                   \
    (MODEL_ROUND8(sizeof(struct character)) + (gaits)*MODEL_ROUND8(sizeof(struct gait)) +                              \
     UV_BYTES(s, body_rings, every) + UV_BYTES(s, arm_rings, every) + UV_BYTES(s, leg_rings, every) +                  \
     MODEL_ROUND8(6 * GRID(s, every)) + MODEL_ROUND8(6 * GRID(shadow, 2)) +                                            \
     MODEL_ROUND8(12 * ((s) + 1) * RINGS_MOST(every)) + MODEL_ROUND8(6 * ((s) + 1) * RINGS_MOST(every)) +              \
     (8192U >> 2 * (down)) + MODEL_ROUND8(12 * GROUND_VERTICES(ground)) + MODEL_ROUND8(6 * GROUND_TRIANGLES(ground)) + \
     MODEL_ROUND8(3 * sizeof(struct ph_part)))
#define ARENAS                                                                                                         \
    {                                                                                                                  \
        ARENA(14, 1, 8, 32, 0, 2), ARENA(10, 1, 5, 16, 1, 2), ARENA(8, 2, 5, 16, 1, 2), ARENA(6, 2, 0, 12, 2, 1)       \
    }

static void make_materials(struct character *c)
{
    c->skin = (struct ph_material){.shading = PH_SHADE_TEXTURE_GOURAUD,
                                   .ambient = FX_ONE * 2 / 5,
                                   .diffuse = FX_ONE * 13 / 20,
                                   .texture = &c->texture};
    c->tiles[0] = demo_unlit(112, 158, 88);
    c->tiles[1] = demo_unlit(96, 142, 78);
    c->tiles[2] = demo_unlit(104, 164, 200);
    c->shade = demo_unlit(58, 92, 54);
    c->shade.depth_bias = 16;
}

static bool make_figure(struct demo_arena *arena, struct character *c)
{
    const struct detail *const detail = c->detail;
    const uint32_t most = RINGS_MOST(detail->figure.every) * (detail->figure.sides + 1U);
    bool fits = make_grid(arena, &c->grids[0], detail->figure) &&
                (detail->shadow.sides == 0 || make_grid(arena, &c->grids[1], detail->shadow));
    for (uint32_t i = 0; i < TUBES; i++) {
        fits = fits && make_uvs(arena, &c->uvs[i], &tubes[i], detail->figure);
    }
    for (uint32_t i = 0; i < (detail->runs ? 2 : 1); i++) {
        c->gaits[i] = fits ? demo_alloc(arena, sizeof **c->gaits) : NULL;
        fits = c->gaits[i] != NULL;
        if (fits) {
            make_gait(c->gaits[i], i);
        }
    }
    c->positions = demo_alloc(arena, most * sizeof *c->positions);
    c->normals = demo_alloc(arena, most * sizeof *c->normals);
    return fits && c->positions && c->normals;
}

static int character_init(struct demo_context *context)
{
    static const size_t arenas[LEVELS] = ARENAS;
    struct demo_arena *const arena = &context->arena;
    uint32_t level = 0;
    while (level + 1 < LEVELS && arena->size < arenas[level]) {
        level++;
    }
    struct character *const c = demo_alloc(arena, sizeof(*c));
    if (!c) {
        return PH_ERR_NOMEM;
    }
    *c = (struct character){.detail = &details[level]};
    context->state = c;
    make_materials(c);
    if (!make_figure(arena, c) || make_texture(arena, &c->texture, c->detail->texture_down) != PH_OK) {
        return PH_ERR_NOMEM;
    }
    return make_ground(arena, &c->ground, c->detail->ground, c->tiles);
}

/* 0: it walks; FX_ONE: it runs; between them it fades. */
static fx_t running_at(const struct character *c, uint32_t frame)
{
    const uint32_t half = LOOP_FRAMES / 2, in = frame % half, steady = half - FADE_FRAMES;
    const fx_t up = in < steady ? 0 : (fx_t)((in - steady) * (FX_ONE / FADE_FRAMES));
    return !c->gaits[1] ? 0 : frame % LOOP_FRAMES < half ? up : FX_ONE - up;
}

/* The angle on the circle, which is as long as the way of a whole loop. */
static uint32_t angle_at(const struct character *c, uint32_t frame)
{
    uint32_t way = 0, whole = 0;
    for (uint32_t i = 0; i < LOOP_FRAMES; i++) {
        const uint32_t step = (uint32_t)fx_lerp_sat(WALK, RUN, running_at(c, i)) / CYCLE_FRAMES;
        way += i < frame % LOOP_FRAMES ? step : 0;
        whole += step;
    }
    return (uint32_t)(((uint64_t)way << 32) / whole);
}

static fx_t sole_height(const struct ph_xform *place, int32_t y, int32_t z)
{
    return ph_xform_point(place, (struct fx_vec3){0, MM(y), MM(z)}).y >> 8;
}

/* Sets the places of the nodes: the lowest sole is on the ground, but when the figure flies. */
static void pose_figure(struct character *c, uint32_t frame, uint32_t heading)
{
    const fx_t time = (fx_t)(frame % CYCLE_FRAMES * (FX_ONE / CYCLE_FRAMES)), running = running_at(c, frame);
    const struct ph_xform root = ph_xform_rotate_y(heading);
    ph_rig_rest(&rig, c->pose);
    ph_clip_sample(&c->gaits[0]->clip, time, c->pose, NULL);
    if (running > 0) {
        ph_rig_rest(&rig, c->other);
        ph_clip_sample(&c->gaits[1]->clip, time, c->other, NULL);
        ph_pose_blend(c->pose, c->other, NODES, running);
    }
    ph_rig_places(&rig, c->pose, &root, c->places);
    fx_t lowest = FX_MAX;
    for (uint32_t side = 0; side < 2; side++) {
        const struct ph_xform *const foot = &c->places[LEG + 4 * side + 2], *const toes = foot + 1;
        lowest = fx_min(lowest, fx_min(sole_height(foot, -85, -55), sole_height(foot, -85, 100)));
        lowest = fx_min(lowest, sole_height(toes, -25, 85));
    }
    const int32_t lift = c->pose[HIPS].t.y - nodes[HIPS].rest.t.y - lowest * 256;
    for (uint32_t i = 0; i < NODES; i++) {
        c->places[i].t.y += lift;
    }
}

/* A tube, or its shadow. */
static int draw_tube(const struct character *c, struct ph_renderer *r, uint32_t which, bool is_shadow)
{
    const struct ph_plane_equation plane = {{0, FX_Q30_ONE, 0}, 0};
    const struct fx_vec3 sun = {FX_INT(-5), FX_INT(9), FX_INT(4)};
    const struct mesh_detail detail = is_shadow ? c->detail->shadow : c->detail->figure;
    const uint32_t rings = RINGS_OF(tubes[which].count, detail.every), triangles = 2 * detail.sides * (rings - 1);
    const struct ph_part part = {.count = triangles};
    const struct ph_mesh mesh = {.positions = c->positions,
                                 .normals = (const int16_t(*)[3])c->normals,
                                 .uvs = (const fx_t(*)[2])c->uvs[which],
                                 .triangles = (const uint16_t(*)[3])c->grids[is_shadow],
                                 .parts = &part,
                                 .materials = &c->skin,
                                 .vertex_count = rings * (detail.sides + 1U),
                                 .triangle_count = triangles,
                                 .part_count = 1};
    if (detail.sides == 0) {
        return PH_OK;
    }
    skin_tube(&tubes[which], detail, c->joints, c->positions, is_shadow ? NULL : c->normals);
    return is_shadow ? ph_draw_shadow(r, &mesh, &ph_xform_identity, sun, &plane, &c->shade)
                     : ph_draw_mesh(r, &mesh, &ph_xform_identity);
}

static int draw_figure(struct character *c, struct ph_renderer *r)
{
    int status = PH_OK;
    for (uint32_t i = 0; i < 2 * TUBES && status == PH_OK; i++) {
        const struct tube *const tube = &tubes[i / 2];
        uint16_t numbers[JOINTS];
        for (uint32_t k = 0; k < JOINTS; k++) {
            numbers[k] = (uint16_t)(tube->nodes[i % 2] + k);
        }
        if (i % 2 < tube->places) {
            const struct ph_skin skin = {numbers, tube->inverse_bind, (uint32_t)tube->joints};
            ph_skin_matrices(&skin, c->places, c->joints);
            status = draw_tube(c, r, i / 2, false);
            status = status ? status : draw_tube(c, r, i / 2, true);
        }
    }
    return status;
}

/* The figure stays at the origin, and the ground moves. */
static int character_frame(struct demo_context *context, struct ph_renderer *r, uint32_t frame)
{
    struct character *const c = context->state;
    const uint32_t angle = angle_at(c, frame);
    int32_t sin, cos;
    fx_sincos_q30(angle, &sin, &cos);
    const struct ph_xform ground =
        ph_xform_translate(-fx_mul_sat(RADIUS, sin >> 14), 0, -fx_mul_sat(RADIUS, cos >> 14));
    struct ph_xform view = demo_look(0, FX_ONE * 14 / 10, FX_ONE * 33 / 10, 0, FX_ONE * 86 / 100, 0);
    struct ph_projection projection = demo_perspective(context, DEMO_SCALE_39_Q20, FX_ONE, FX_INT(12));
    demo_orbit(context, &view, &projection);
    const int status = demo_begin(context, r, &view, &projection, &demo_two_lamps, ph_rgb565(150, 190, 222));
    pose_figure(c, frame, angle + (1u << 30));
    return status || draw_figure(c, r) ? PH_ERR_NOMEM : ph_draw_mesh(r, &c->ground, &ground);
}

/* Up to 47 % of the triangles were listed in any frame: those that face the viewer, and of the shadow the lamp. */
#define TRIANGLES(s, every) (2 * (s) * (RINGS_DRAWN(every) - 5))
#define LEVEL(s, every, shadow, ground, down, gaits, on_32)                                                            \
    DEMO_ARENA(ARENA(s, every, shadow, ground, down, gaits), on_32),                                                   \
        .vertex_max =                                                                                                  \
            ((s) + 1) * RINGS_DRAWN(every) + ((shadow) ? (shadow) + 1 : 0) * RINGS_DRAWN(2) + GROUND_VERTICES(ground), \
        .triangle_max = (TRIANGLES(s, every) + TRIANGLES(shadow, 2)) / 2 + GROUND_TRIANGLES(ground), .corner_max = 24

static const struct demo_level coarser[LEVELS - 1] = {
    {LEVEL(10, 1, 5, 16, 1, 2, 23000), .enough_px = 128},
    {LEVEL(8, 2, 5, 16, 1, 2, 16912), .enough_px = 80},
    {LEVEL(6, 2, 0, 12, 2, 1, 10360)},
};

const struct demo demo_character = {
    .name = "character",
    .summary = "a figure that walks and runs in a circle",
    .loop_frames = LOOP_FRAMES,
    LEVEL(14, 1, 8, 32, 0, 2, 34832),
    .coarser = coarser,
    .coarser_count = LEVELS - 1,
    .init = character_init,
    .frame = character_frame,
};
