/* See figure.h. */
#include "figure.h"

#include "fx_math.h"

#define COUNT(a) ((uint32_t)(sizeof(a) / sizeof((a)[0])))

/* ---- the rig, in thousandths ------------------------------------------------------------------------------------- */

#define NODE(parent, x, y, z)                                                                                          \
    {                                                                                                                  \
        parent,                                                                                                        \
        {                                                                                                              \
            {FX_Q30_ONE, 0, 0, 0}, {FIGURE_MM(x), FIGURE_MM(y), FIGURE_MM(z)},                                         \
            {                                                                                                          \
                PH_MOTION_ONE, PH_MOTION_ONE, PH_MOTION_ONE                                                            \
            }                                                                                                          \
        }                                                                                                              \
    }

static const struct ph_rig_node nodes[FIGURE_NODES] = {
    NODE(-1, 0, 950, 0),
    NODE(FIGURE_HIPS, 0, 120, 0),
    NODE(FIGURE_SPINE, 0, 160, 0),
    NODE(FIGURE_CHEST, 0, 210, 0),
    NODE(FIGURE_NECK, 0, 70, 0),
    NODE(FIGURE_CHEST, 184, 122, 0),
    NODE(FIGURE_ARM, 0, -270, 0),
    NODE(FIGURE_ARM + 1, 0, -250, 0),
    NODE(FIGURE_CHEST, -184, 122, 0),
    NODE(FIGURE_ARM + 3, 0, -270, 0),
    NODE(FIGURE_ARM + 4, 0, -250, 0),
    NODE(FIGURE_HIPS, 95, -45, 0),
    NODE(FIGURE_LEG, 0, -420, 0),
    NODE(FIGURE_LEG + 1, 0, -400, 0),
    NODE(FIGURE_LEG + 2, 0, -60, 110),
    NODE(FIGURE_HIPS, -95, -45, 0),
    NODE(FIGURE_LEG + 4, 0, -420, 0),
    NODE(FIGURE_LEG + 5, 0, -400, 0),
    NODE(FIGURE_LEG + 6, 0, -60, 110),
};
const struct ph_rig figure_rig = {nodes, FIGURE_NODES};

static const struct figure_ring body_rings[] = {
    {-110, 0, 0, 0},    {-70, 140, 100, 0}, {-20, 162, 112, 0}, {50, 148, 100, 0}, {110, 126, 84, 0},
    {240, 150, 100, 4}, {310, 166, 108, 6}, {380, 172, 104, 4}, {430, 152, 92, 0}, {465, 96, 70, 0},
    {505, 50, 53, 2},   {552, 60, 70, 14},  {590, 80, 94, 14},  {640, 95, 111, 8}, {735, 100, 116, 0},
    {785, 90, 106, 0},  {825, 66, 78, 0},   {846, 34, 42, 0},   {852, 0, 0, 0},
};
static const struct figure_ring arm_rings[] = {
    {-680, 0, 0, 6},   {-674, 14, 22, 6}, {-650, 24, 38, 6}, {-610, 31, 47, 4}, {-560, 31, 44, 0}, {-520, 27, 30, 0},
    {-480, 33, 32, 0}, {-400, 42, 40, 0}, {-320, 46, 45, 0}, {-270, 45, 46, 0}, {-220, 48, 47, 0}, {-150, 55, 52, 0},
    {-80, 61, 58, 0},  {-20, 69, 66, 0},  {30, 60, 60, 0},   {52, 34, 34, 0},   {60, 0, 0, 0},
};
static const struct figure_ring leg_rings[] = {
    {-905, 0, 0, 70},  {-904, 46, 128, 70}, {-890, 52, 136, 70}, {-860, 49, 124, 62}, {-825, 42, 84, 28},
    {-780, 36, 42, 0}, {-700, 41, 44, -4},  {-620, 52, 56, -10}, {-540, 56, 62, -8},  {-470, 55, 58, 0},
    {-420, 57, 60, 4}, {-340, 65, 67, 2},   {-250, 77, 80, 0},   {-150, 87, 92, 0},   {-50, 92, 98, 0},
    {25, 80, 84, 0},   {50, 0, 0, 0},
};

_Static_assert(COUNT(body_rings) == FIGURE_BODY_RINGS && COUNT(arm_rings) == FIGURE_ARM_RINGS &&
                   COUNT(leg_rings) == FIGURE_LEG_RINGS,
               "figure.h");

#define TOES_Z    110
#define TOES_SOFT 40

#define BIND(y, z)                                                                                                     \
    {                                                                                                                  \
        {{FX_Q30_ONE, 0, 0}, {0, FX_Q30_ONE, 0}, {0, 0, FX_Q30_ONE}},                                                  \
        {                                                                                                              \
            0, -FIGURE_MM(y), -FIGURE_MM(z)                                                                            \
        }                                                                                                              \
    }
static const struct ph_xform body_bind[] = {BIND(0, 0), BIND(120, 0), BIND(280, 0), BIND(490, 0), BIND(560, 0)};
static const struct ph_xform arm_bind[] = {BIND(0, 0), BIND(-270, 0), BIND(-520, 0)};
static const struct ph_xform leg_bind[] = {BIND(0, 0), BIND(-420, 0), BIND(-820, 0), BIND(-880, TOES_Z)};

const struct figure_tube figure_tubes[FIGURE_TUBES] = {
    {body_rings, COUNT(body_rings), 5, {0, 120, 280, 490, 560}, 70, true, false, 0, 72, 1, {FIGURE_HIPS}, body_bind},
    {arm_rings,
     COUNT(arm_rings),
     3,
     {0, -270, -520},
     55,
     false,
     false,
     72,
     28,
     2,
     {FIGURE_ARM, FIGURE_ARM + 3},
     arm_bind},
    {leg_rings,
     COUNT(leg_rings),
     4,
     {0, -420, -820, -880},
     70,
     false,
     true,
     100,
     28,
     2,
     {FIGURE_LEG, FIGURE_LEG + 4},
     leg_bind},
};

/* ---- the clips: degrees in eight moments of a cycle, which begins when the left heel touches the ground ---------- */

struct swing {
    uint8_t left, right; /* nodes; right 0: none */
    bool is_turn;        /* about y, else about x */
    int8_t degrees[FIGURE_MOMENTS];
};

static const struct swing swings[2][FIGURE_SWINGS] = {
    {
        {FIGURE_LEG, FIGURE_LEG + 4, false, {-25, -19, -7, 7, 18, 8, -15, -27}},
        {FIGURE_LEG + 1, FIGURE_LEG + 5, false, {5, 16, 11, 7, 20, 54, 58, 22}},
        {FIGURE_LEG + 2, FIGURE_LEG + 6, false, {-5, 4, -4, -9, 4, 18, 2, -6}},
        {FIGURE_LEG + 3, FIGURE_LEG + 7, false, {0, 0, 0, -8, -28, -6, 0, 0}},
        {FIGURE_ARM, FIGURE_ARM + 3, false, {24, 19, 6, -9, -23, -18, -5, 10}},
        {FIGURE_ARM + 1, FIGURE_ARM + 4, false, {-14, -14, -17, -24, -33, -30, -23, -17}},
        {FIGURE_HIPS, 0, true, {-8, -6, 0, 6, 8, 6, 0, -6}},
        {FIGURE_CHEST, 0, true, {15, 11, 0, -11, -15, -11, 0, 11}},
        {FIGURE_SPINE, 0, false, {3, 3, 3, 3, 3, 3, 3, 3}},
    },
    {
        {FIGURE_LEG, FIGURE_LEG + 4, false, {-34, -18, 4, 22, 16, -18, -48, -50}},
        {FIGURE_LEG + 1, FIGURE_LEG + 5, false, {16, 36, 26, 16, 52, 98, 88, 38}},
        {FIGURE_LEG + 2, FIGURE_LEG + 6, false, {-4, -6, -12, 12, 20, 6, 0, -4}},
        {FIGURE_LEG + 3, FIGURE_LEG + 7, false, {0, 0, -5, -24, -10, 0, 0, 0}},
        {FIGURE_ARM, FIGURE_ARM + 3, false, {44, 32, 4, -24, -38, -28, -2, 26}},
        {FIGURE_ARM + 1, FIGURE_ARM + 4, false, {-70, -76, -86, -94, -98, -92, -84, -74}},
        {FIGURE_HIPS, 0, true, {-10, -7, 0, 7, 10, 7, 0, -7}},
        {FIGURE_CHEST, 0, true, {20, 14, 0, -14, -20, -14, 0, 14}},
        {FIGURE_SPINE, 0, false, {12, 13, 14, 13, 12, 13, 14, 13}},
    },
};

/* The hips' place when the figure runs: it flies twice a cycle. x, y, z in Q2.14. */
#define HIPS_Y 15565
#define FLIGHT 1000
static const int16_t flight[FIGURE_MOMENTS + 1][3] = {{0, HIPS_Y, 0},          {0, HIPS_Y, 0},          {0, HIPS_Y, 0},
                                                      {0, HIPS_Y + FLIGHT, 0}, {0, HIPS_Y, 0},          {0, HIPS_Y, 0},
                                                      {0, HIPS_Y, 0},          {0, HIPS_Y + FLIGHT, 0}, {0, HIPS_Y, 0}};
static const fx_t moments[FIGURE_MOMENTS + 1] = {0, 8192, 16384, 24576, 32768, 40960, 49152, 57344, 65536};

static void set_value(const struct swing *swing, uint32_t moment, int16_t to[4])
{
    const struct fx_vec3 axis = {swing->is_turn ? 0 : FX_ONE, swing->is_turn ? FX_ONE : 0, 0};
    const uint32_t turn32 = fx_turn32_from_deg(swing->degrees[moment % FIGURE_MOMENTS] * FX_ONE);
    const struct fx_quat q = fx_quat_axis(axis, turn32);
    const int32_t key[4] = {q.x, q.y, q.z, q.w};
    for (uint32_t i = 0; i < 4; i++) { /* of the two quaternions of a rotation that with w > 0 */
        to[i] = (int16_t)((q.w < 0 ? -key[i] : key[i]) >> 16);
    }
}

/* Smooth splines: a tangent is half of the way from the moment before to the moment behind. */
static void make_keys(const struct swing *swing, int16_t keys[FIGURE_KEYS][3][4])
{
    for (uint32_t k = 0; k < FIGURE_KEYS; k++) {
        int16_t before[4], behind[4];
        set_value(swing, k, keys[k][1]);
        set_value(swing, k + FIGURE_MOMENTS - 1, before);
        set_value(swing, k + 1, behind);
        for (uint32_t i = 0; i < 4; i++) {
            keys[k][0][i] = keys[k][2][i] = (int16_t)((behind[i] - before[i]) / 2);
        }
    }
}

void figure_make_gait(struct figure_gait *gait, uint32_t which)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < FIGURE_SWINGS; i++) {
        const struct swing *const swing = &swings[which][i];
        struct ph_track track = {.node = swing->left,
                                 .path = PH_PATH_ROTATION,
                                 .interpolation = PH_KEYS_CUBIC,
                                 .width = 4,
                                 .frac = 14,
                                 .key_count = FIGURE_MOMENTS + 1,
                                 .times = moments,
                                 .keys = &gait->keys[i][0][0][0]};
        make_keys(swing, gait->keys[i]);
        gait->tracks[count++] = track;
        if (swing->right) {
            track.node = swing->right;
            track.keys = &gait->keys[i][FIGURE_MOMENTS / 2][0][0];
            gait->tracks[count++] = track;
        }
    }
    if (which == 1) {
        gait->tracks[count++] = (struct ph_track){.node = FIGURE_HIPS,
                                                  .path = PH_PATH_TRANSLATION,
                                                  .interpolation = PH_KEYS_LINEAR,
                                                  .width = 3,
                                                  .frac = 14,
                                                  .key_count = FIGURE_MOMENTS + 1,
                                                  .times = moments,
                                                  .keys = flight[0]};
    }
    gait->clip = (struct ph_clip){which ? "run" : "walk", gait->tracks, count, FX_ONE};
}

/* ---- the tubes --------------------------------------------------------------------------------------------------- */

bool figure_make_grid(struct demo_arena *arena, uint16_t (**grid)[3], struct figure_detail detail)
{
    const uint32_t sides = detail.sides, n = FIGURE_GRID(sides, detail.every);
    *grid = demo_alloc(arena, n * sizeof **grid);
    for (uint32_t i = 0; *grid && i < n; i++) {
        const uint32_t square = i / 2, a = square / sides * (sides + 1) + square % sides, c = a + sides + 2;
        (*grid)[i][0] = (uint16_t)a;
        (*grid)[i][1] = (uint16_t)(i % 2 ? c : c - 1);
        (*grid)[i][2] = (uint16_t)(i % 2 ? a + 1 : c);
    }
    return *grid != NULL;
}

bool figure_make_uvs(struct demo_arena *arena, fx_t (**uvs)[2], const struct figure_tube *tube,
                     struct figure_detail detail)
{
    const uint32_t points = detail.sides + 1U, n = points * FIGURE_RINGS_OF(tube->count, detail.every);
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
static struct ph_influence influence_at(const struct figure_tube *tube, int32_t y, int32_t z)
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

/*
 * A point is (a sin, y, z - b cos) of its angle. Its normal is the product of the way from the ring below to that above
 * and of the way around the ring, (a cos, 0, b sin); ph_skin_vertices() brings it to length one.
 */
void figure_make_loop(struct figure_loop *loop, const struct figure_tube *tube, uint32_t ring,
                      struct figure_detail detail)
{
    const struct figure_ring *const r = &tube->rings[ring];
    const struct figure_ring *const below = ring > 0 ? r - detail.every : r;
    const struct figure_ring *const above = ring + 1 < tube->count ? r + detail.every : r;
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

void figure_skin_tube(const struct figure_tube *tube, struct figure_detail detail, const struct ph_xform *joints,
                      struct fx_vec3 *positions, int16_t (*normals)[3])
{
    struct figure_loop loop;
    const uint32_t points = detail.sides + 1U;
    const struct ph_bound bound = {.positions = (const int16_t(*)[3])loop.positions,
                                   .normals = (const int16_t(*)[3])loop.normals,
                                   .influences = loop.influences,
                                   .vertex_count = points,
                                   .frac = FIGURE_FRAC};
    for (uint32_t ring = 0, v = 0; ring < tube->count; ring += detail.every, v += points) {
        figure_make_loop(&loop, tube, ring, detail);
        ph_skin_vertices(&bound, joints, positions + v, normals ? normals + v : NULL);
    }
}

/* ---- the texture ------------------------------------------------------------------------------------------------- */

struct patch {
    uint8_t row, rows, column, columns; /* from the top; from the back over the left */
    uint8_t red, green, blue;
};

/* Patches of the texture; each lies over those before it. */
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

int figure_make_texture(struct demo_arena *arena, struct ph_texture *texture, uint32_t down)
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
    *texture = (struct ph_texture){.texels = texels,
                                   .log2_width = (uint8_t)(5 - down),
                                   .log2_height = (uint8_t)(7 - down),
                                   .wrap = PH_WRAP_REPEAT};
    return texels ? PH_OK : PH_ERR_NOMEM;
}
