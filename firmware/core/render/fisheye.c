/*
 * The fisheye is the equidistant projection: a point at the angle theta from the view direction lies r = f theta from
 * the centre of the picture. See fisheye.h.
 *
 * A vertex is its direction, a unit vector (x, y, c), and 1 / distance. Its place is f g (x, y) from the centre, where
 * g = theta / sin theta is a smooth function of c = cos theta, and comes from a table: no angle and no root is taken.
 *
 * A straight edge becomes a curve. So triangles and lines are subdivided until their edges are straight enough, and the
 * pieces are drawn like all triangles. An edge is divided where the bisector of the angle between its ends meets it:
 * there the direction is a + b, made a unit vector again, and 1 / distance, which is linear in direction, is the sum of
 * both over |a + b|. An edge is divided when its ends are more than 1/20 turn apart in the picture, or when the
 * dividing point is more than 1/2 px off the straight line. A chord of L px is at most k L^2 / 8 f px off, with k below
 * .96 where theta < 120 degrees, below 1.72 where it is < 150, and below 4.6 elsewhere; edges that are short enough by
 * that are not tested; edges below 2^-5 radian are never divided. All of this depends on the ends of the edge alone, so
 * two triangles that share an edge divide it alike and no crack opens. The longest edge is divided first: the triangle
 * becomes two, and one of them waits on a stack.
 *
 * Depth is the distance from the eye, so the near and the far plane are spheres. N/distance is interpolated linearly
 * over a piece, as N/w is in a perspective; over 1/20 turn its error is below 1/80. The point straight behind the eye
 * would become a circle in the picture: pieces are clipped 10 degrees before it.
 */
#include "fisheye.h"

#include "edge.h"
#include "list.h"

#define LONG        20                  /* edges longer than this part of a turn are divided always */
#define SHORT       ((uint32_t)1 << 16) /* shorter edges, below 2^-5 radian, never are; squared Q26 */
#define DEPTH       20                  /* pieces that wait on the stack */
#define POOL        (DEPTH + 3)         /* vertices in use at a time */
#define SPLITS_MAX  4096                /* divisions of one triangle */
#define REACH       (2048 * 256)        /* set-up takes coordinates up to here from the centre, 1/256 px */
#define BLIND       (-528715000)        /* cos 170 degrees, Q29 */
#define PART_Q32(v) ((uint32_t)((v)*4294967296.0))
#define G_SHIFT     23 /* of c in Q29: 64 steps from 0 to 1 */

/* theta / sin theta at c = cos theta = i / 64 (above 1: arcosh c / sinh arcosh c), Q30. */
static const uint32_t g_ahead[67] = {
    1686629713, 1670055691, 1653877572, 1638080253, 1622649420, 1607571492, 1592833580, 1578423437, 1564329419,
    1550540449, 1537045982, 1523835971, 1510900837, 1498231444, 1485819073, 1473655393, 1461732446, 1450042622,
    1438578639, 1427333530, 1416300618, 1405473507, 1394846067, 1384412416, 1374166909, 1364104129, 1354218869,
    1344506128, 1334961098, 1325579154, 1316355845, 1307286888, 1298368158, 1289595682, 1280965629, 1272474307,
    1264118154, 1255893737, 1247797737, 1239826954, 1231978296, 1224248776, 1216635506, 1209135695, 1201746645,
    1194465743, 1187290463, 1180218359, 1173247064, 1166374284, 1159597796, 1152915448, 1146325153, 1139824886,
    1133412686, 1127086648, 1120844925, 1114685724, 1108607304, 1102607974, 1096686094, 1090840067, 1085068344,
    1079369418, 1073741824, 1068184139, 1062694977,
};

/* The same behind the viewer, Q26: octave k, 34 entries, is at 1 + c = 2^-(k + 1) (1 + i / 32). */
static const uint32_t g_behind[7 * 34] = {
    162296020,  159280097,  156402440,  153652987,  151022669,  148503284,  146087397,  143768247,  141539672,
    139396045,  137332210,  135343440,  133425387,  131574045,  129785716,  128056984,  126384682,  124765873,
    123197830,  121678012,  120204055,  118773751,  117385037,  116035983,  114724782,  113449738,  112209261,
    111001854,  109826111,  108680704,  107564385,  106475974,  105414357,  104378481,  245415114,  241034419,
    236852325,  232854448,  229027818,  225360705,  221842469,  218463434,  215214781,  212088450,  209077059,
    206173834,  203372543,  200667445,  198053239,  195525024,  193078259,  190708728,  188412517,  186185981,
    184025722,  181928571,  179891562,  177911925,  175987060,  174114530,  172292048,  170517461,  168788745,
    167103992,  165461403,  163859281,  162296020,  160770104,  365433112,  359134446,  353119122,  347366679,
    341858664,  336578383,  331510694,  326641826,  321959221,  317451403,  313107861,  308918944,  304875777,
    300970179,  297194597,  293542045,  290006049,  286580603,  283260124,  280039412,  276913624,  273878235,
    270929020,  268062021,  265273530,  262560069,  259918372,  257345367,  254838161,  252394032,  250010409,
    247684867,  245415114,  243198982,  537312397,  528317087,  519724396,  511505297,  503633612,  496085656,
    488839943,  481876930,  475178796,  468729252,  462513378,  456517476,  450728943,  445136167,  439728421,
    434495786,  429429068,  424519735,  419759857,  415142051,  410659432,  406305576,  402074475,  397960508,
    393958405,  390063222,  386270317,  382575323,  378974130,  375462865,  372037875,  368695710,  365433112,
    362246996,  782164709,  769372387,  757150881,  745459079,  734259896,  723519782,  713208299,  703297759,
    693762915,  684580688,  675729937,  667191250,  658946773,  650980047,  643275871,  635820188,  628599967,
    621603116,  614818393,  608235333,  601844179,  595635821,  589601743,  583733975,  578025046,  572467948,
    567056095,  561783297,  556643726,  551631888,  546742604,  541970981,  537312397,  532762479,  1129852895,
    1111706249, 1094367902, 1077779666, 1061889053, 1046648574, 1032015145, 1017949576, 1004416127, 991382131,
    978817658,  966695232,  954989575,  943677387,  932737149,  922148957,  911894364,  901956250,  892318697,
    882966889,  873887009,  865066160,  856492283,  848154090,  840041004,  832143100,  824451054,  816956097,
    809649976,  802524912,  795573568,  788789016,  782164709,  775694454,  1622649420, 1596943874, 1572382187,
    1548882037, 1526369161, 1504776372, 1484042713, 1464112734, 1444935871, 1426465901, 1408660478, 1391480725,
    1374890873, 1358857955, 1343351523, 1328343412, 1313807521, 1299719622, 1286057194, 1272799268, 1259926294,
    1247420019, 1235263381, 1223440406, 1211936126, 1200736493, 1189828314, 1179199179, 1168837408, 1158731993,
    1148872549, 1139249272, 1129852895, 1120674654,
};

/* 1 / distance: m 2^(s - 62), m in 2^30 .. 2^31, for a distance in units of Q16.16. */
struct inverse {
    uint32_t m;
    int s;
};

struct screen {
    int32_t x, y; /* 1/256 px */
};

/* Flags of a vertex; CUT: it cannot be drawn as it is. */
enum { NEAR = 1, FAR = 2, BLIND_SPOT = 4, CUT = 7, BEYOND = 8, BEFORE = 16, ASIDE = 32 };

/* A vertex of the subdivision. */
struct vertex {
    int32_t direction[3]; /* unit vector: x, y, along the view; Q2.29 */
    struct inverse inverse;
    struct screen at;
    int32_t light;
    fx_t uv[2];
    unsigned flags; /* NEAR, FAR: beyond that sphere; BLIND_SPOT: behind 170 degrees; BEYOND: set-up cannot take the
                       position; BEFORE, ASIDE: less than 120 or 150 degrees from the axis */
};

/* The signed product's high word. */
static inline int32_t high_product(int32_t a, int32_t b)
{
    return (int32_t)(fx_mul_wide(a, b) >> 32);
}

/* The unit vector of v, Q29, which is 2^-25 off; zero gives the view direction. *inverse: 1 / |v|. */
static void unit_of(const int32_t v[3], int32_t unit[3], struct inverse *inverse)
{
    const uint32_t all = fx_magnitude(v[0]) | fx_magnitude(v[1]) | fx_magnitude(v[2]);
    const int up = fx_clz32(all) - 1; /* largest to 31 bits */
    int32_t scaled[3];
    uint32_t square = 0;
    for (int i = 0; i < 3; i++) {
        scaled[i] = up >= 0 ? (int32_t)((uint32_t)v[i] << (up & 31)) : v[i] >> 1;
        const uint32_t size = fx_magnitude(scaled[i]);
        square += fx_mulhi_u32(size, size); /* 2^28 .. 3 2^30 */
    }
    if (all == 0) {
        unit[0] = unit[1] = 0;
        unit[2] = 1 << 29;
        *inverse = (struct inverse){((uint32_t)1 << 31) - 1, 62};
        return;
    }
    const int half = square >> 30 == 0;
    const uint32_t root = fx_rsqrt_norm(square << 2 * half), most = (uint32_t)1 << 30;
    const uint32_t y = root < most ? root : most - 1;
    for (int i = 0; i < 3; i++) {
        unit[i] = high_product(scaled[i], (int32_t)(y << half));
    }
    *inverse = (struct inverse){2 * y, up + half};
}

/* Quadratic interpolation between g[0] and g[1]; both falls are positive, the second is the smaller one. */
static inline uint32_t between(const uint32_t *g, uint32_t part_q32)
{
    const uint32_t fall = g[0] - g[1], bend = fall - (g[1] - g[2]), part = part_q32 >> 16;
    return g[0] - fx_mulhi_u32(fall, part_q32) - ((bend >> 8) * (part * (65536 - part) >> 17) >> 8);
}

/* g of c, Q26, 2^-18 off at most. */
static uint32_t g_of(int32_t c)
{
    if (c >= 0) {
        const int32_t i = c >> G_SHIFT < 64 ? c >> G_SHIFT : 64;
        return between(&g_ahead[i], (uint32_t)c << (32 - G_SHIFT)) >> 4;
    }
    const int32_t most = c + (1 << 29), least = 1 << 22; /* nobody looks further behind */
    const uint32_t z = (uint32_t)(most > least ? most : least);
    const int octave = fx_clz32(z) - 3;
    const uint32_t scaled = z << octave; /* 2^28 .. 2^29 */
    return between(&g_behind[34 * octave + (int32_t)(scaled >> G_SHIFT & 31)], scaled << (32 - G_SHIFT));
}

/* f in 16.16 px a radian. */
static inline int32_t focal_of(const struct ph_lens *lens)
{
    return (int32_t)fx_mulhi_u32(lens->turn_px, PART_Q32(.15915494309));
}

static inline int32_t offset(int32_t direction, uint32_t g, int32_t focal)
{
    const int32_t radians = high_product(direction * 2, (int32_t)g); /* Q24 */
    return (int32_t)((fx_mul_wide(radians, focal) + ((int64_t)1 << 31)) >> 32);
}

/* BEFORE and ASIDE, from the larger coordinate of a point from the centre, 1/256 px. */
static unsigned zone_of(uint32_t size, int32_t focal)
{
    const uint32_t aside = fx_mulhi_u32((uint32_t)focal, PART_Q32(1.851 / 256)); /* 5 pi / 6 / sqrt 2 */
    return size >= aside ? 0 : size < aside - (aside >> 2) + (aside >> 5) ? BEFORE | ASIDE : ASIDE;
}

/* Sets the place in the picture and its flags. */
static void place(const struct ph_lens *lens, struct vertex *v)
{
    const uint32_t g = g_of(v->direction[2]);
    const int32_t focal = focal_of(lens), x = offset(v->direction[0], g, focal), y = offset(v->direction[1], g, focal);
    const uint32_t size = fx_magnitude(x) > fx_magnitude(y) ? fx_magnitude(x) : fx_magnitude(y);
    v->at = (struct screen){lens->centre_x + x, lens->centre_y + y};
    v->flags = (v->direction[2] < BLIND ? BLIND_SPOT : 0u) | (size > REACH ? BEYOND : 0u) | zone_of(size, focal);
}

static inline bool is_less(struct inverse a, struct inverse b)
{
    return a.s != b.s ? a.s < b.s : a.m < b.m;
}

/* Compares the distance with both spheres. */
static void set_spheres(const struct ph_lens *lens, struct vertex *v)
{
    const struct inverse near = {lens->near_over, lens->near_zeros}, far = {lens->far_over, lens->far_zeros};
    v->flags |= (is_less(near, v->inverse) ? NEAR : 0u) | (is_less(v->inverse, far) ? FAR : 0u);
}

void ph_fisheye_lens(struct ph_lens *lens, const struct ph_projection *p, int32_t height)
{
    lens->focal_x = lens->focal_y = FX_Q30_ONE; /* x and y of the clip matrix are lengths */
    lens->turn_px = (uint32_t)((fx_mul_wide(p->scale_y_q20, height) * 205887) >> 20); /* pi half heights */
    lens->chord_min2 = lens->turn_px / 19 * 3;                                        /* f square pixels: over 2 pi */
    const uint32_t quarter_radian = lens->turn_px / (LONG * 256);
    lens->chord_max = (int32_t)(quarter_radian < 65536 ? quarter_radian : 65536);
    int zeros;
    lens->near_over = fx_rcp_norm((uint32_t)p->near_z, &zeros);
    lens->near_zeros = (int16_t)zeros;
    lens->far_over = fx_rcp_norm((uint32_t)p->far_z, &zeros);
    lens->far_zeros = (int16_t)zeros;
}

static struct ph_quotient depth_of(const struct ph_lens *lens, const struct vertex *v)
{
    return ph_depth_quotient_of(lens, v->inverse.m, v->inverse.s);
}

void ph_fisheye_vertex(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v)
{
    struct vertex to;
    unit_of((const int32_t[3]){x, y, w}, to.direction, &to.inverse);
    place(lens, &to);
    set_spheres(lens, &to);
    v->code = (to.flags & NEAR) != 0 ? PH_NEAR : (to.flags & (CUT | BEYOND)) != 0 ? PH_GUARD : 0;
    v->x = to.at.x;
    v->y = to.at.y;
    ph_vertex_depth(v, depth_of(lens, &to));
}

/* ---- edges ---------------------------------------------------------------------------------------------------- */

/* The square of a chord, (1/128 px)^2; UINT32_MAX from 256 px along an axis on. Both ways it is the same. */
static inline uint32_t chord2(int32_t ax, int32_t ay, int32_t bx, int32_t by)
{
    const uint32_t dx = fx_magnitude(bx - ax) >> 1, dy = fx_magnitude(by - ay) >> 1;
    return (dx | dy) >> 15 != 0 ? UINT32_MAX : dx * dx + dy * dy;
}

/* Longer chords are divided always. */
static inline uint32_t longest2(const struct ph_lens *lens)
{
    const uint32_t half = (uint32_t)lens->chord_max >> 1;
    return half * half;
}

/* Shorter ones never are: they are less than 1/2 px off. `zones`: what both ends have of BEFORE and ASIDE. */
static inline uint32_t shortest2(const struct ph_lens *lens, unsigned zones)
{
    const uint32_t f = lens->chord_min2, least = (zones & BEFORE) != 0 ? f : (zones & ASIDE) != 0 ? f / 2 : f / 4;
    return least < longest2(lens) ? least : longest2(lens);
}

static unsigned zone_at(const struct ph_lens *lens, const struct ph_vertex *v)
{
    const uint32_t x = fx_magnitude(v->x - lens->centre_x), y = fx_magnitude(v->y - lens->centre_y);
    return zone_of(x > y ? x : y, focal_of(lens));
}

bool ph_fisheye_is_small(const struct ph_lens *lens, const struct ph_vertex *a, const struct ph_vertex *b,
                         const struct ph_vertex *c)
{
    const uint32_t limit = shortest2(lens, zone_at(lens, a) & zone_at(lens, b) & zone_at(lens, c));
    return chord2(a->x, a->y, b->x, b->y) <= limit && chord2(b->x, b->y, c->x, c->y) <= limit &&
           chord2(c->x, c->y, a->x, a->y) <= limit;
}

/* The square of the distance between two unit vectors, Q26, rounded down; below 2^29. For a small angle it is the
 * square of the angle. */
static uint32_t apart2(const struct vertex *a, const struct vertex *b)
{
    uint32_t sum = 0;
    for (int i = 0; i < 3; i++) {
        const uint32_t d = fx_magnitude(a->direction[i] - b->direction[i]);
        sum += fx_mulhi_u32(d, d);
    }
    return sum;
}

/* 1/distance of the dividing point of an edge whose ends' directions differ by the angle A: mean / cos(A / 2). more_q32
 * is 1 / cos(A / 2) - 1. */
static struct inverse inverse_between(struct inverse a, struct inverse b, uint32_t more_q32)
{
    const struct inverse far = is_less(a, b) ? a : b, near = is_less(a, b) ? b : a;
    const int down = near.s - far.s;
    const uint32_t mean = (near.m + (down < 32 ? far.m >> down : 0)) >> 1, m = mean + fx_mulhi_u32(mean, more_q32);
    return m < (uint32_t)1 << 30 ? (struct inverse){2 * m, near.s - 1}
           : m >> 31 != 0        ? (struct inverse){m >> 1, near.s + 1}
                                 : (struct inverse){m, near.s};
}

/* 1 / cos(A / 2) - 1 in Q32, from (2 sin(A / 2))^2 / 4 = e in Q28, e <= 1/16: (1 - e)^-1/2 - 1 to e^5. */
static inline uint32_t over_cosine(uint32_t e_q28)
{
    const uint32_t e = e_q28 << 4, e16 = e >> 16;
    const uint32_t high = 24576 + (e16 * (20480 + (e16 * (17920 + (e16 * 16128 >> 16)) >> 16)) >> 16);
    return fx_mulhi_u32(e, ((uint32_t)1 << 31) + fx_mulhi_u32(e, high << 16));
}

/* Light and texture of the dividing point: at t = |a| / (|a| + |b|). */
static void divide_attributes(const struct vertex *a, const struct vertex *b, struct vertex *m)
{
    int shift;
    const struct inverse of_a = a->inverse, of_b = b->inverse;
    const int s = of_a.s > of_b.s ? of_a.s : of_b.s;
    const uint32_t part_a = s - of_a.s < 32 ? of_a.m >> (s - of_a.s) : 0;
    const uint32_t part_b = s - of_b.s < 32 ? of_b.m >> (s - of_b.s) : 0;
    const uint32_t reciprocal = fx_rcp_norm(part_a + part_b, &shift);
    const int32_t t = (int32_t)fx_mulhi_u32(part_b << shift, reciprocal);
    const struct ph_clip_vertex from = {.light = a->light, .uv = {a->uv[0], a->uv[1]}};
    const struct ph_clip_vertex to = {.light = b->light, .uv = {b->uv[0], b->uv[1]}};
    const struct ph_clip_vertex middle = ph_clip_between(&from, &to, t);
    m->light = middle.light;
    m->uv[0] = middle.uv[0];
    m->uv[1] = middle.uv[1];
}

/* Sets the dividing point of an edge. The order of the two ends does not change its place. */
static void divide(const struct ph_lens *lens, const struct vertex *a, const struct vertex *b, struct vertex *m)
{
    const uint32_t e_q28 = apart2(a, b);
    if (e_q28 <= (uint32_t)1 << 24) {
        const uint32_t more = over_cosine(e_q28);
        for (int i = 0; i < 3; i++) {
            const int32_t half = (a->direction[i] + b->direction[i]) >> 1;
            m->direction[i] = half + high_product(half, (int32_t)more);
        }
        m->inverse = inverse_between(a->inverse, b->inverse, more);
    } else {
        struct inverse over; /* 1 / |a + b|, where a and b are 2^29 long: it is 2 or more of its unit, 2^-30 */
        const int32_t sum[3] = {a->direction[0] + b->direction[0], a->direction[1] + b->direction[1],
                                a->direction[2] + b->direction[2]};
        unit_of(sum, m->direction, &over);
        const struct inverse mean = inverse_between(a->inverse, b->inverse, 0);
        const uint32_t product = fx_mulhi_u32(mean.m << 1, over.m); /* 2^29 .. 2^31 */
        const int low = product >> 30 == 0;
        m->inverse = (struct inverse){product << low, mean.s + over.s - 1 - low};
    }
    m->light = a->light;
    m->uv[0] = a->uv[0];
    m->uv[1] = a->uv[1];
    if (a->light != b->light || a->uv[0] != b->uv[0] || a->uv[1] != b->uv[1]) {
        divide_attributes(a, b, m);
    }
    place(lens, m);
    set_spheres(lens, m);
}

static uint32_t chord_of(const struct vertex *a, const struct vertex *b)
{
    return chord2(a->at.x, a->at.y, b->at.x, b->at.y);
}

/* The angle of an edge that has to be divided because it is long, squared as in apart2; else 0. */
static uint32_t long_angle(const struct ph_lens *lens, const struct vertex *a, const struct vertex *b, uint32_t chord)
{
    const uint32_t angle = chord > longest2(lens) ? apart2(a, b) : 0;
    return angle >= SHORT ? angle : 0;
}

/* The same of an edge that is not long, but bends: its dividing point *m, which is set then, is over 1/2 px off the
 * chord. */
static uint32_t bent_angle(const struct ph_lens *lens, const struct vertex *a, const struct vertex *b, uint32_t chord,
                           struct vertex *m)
{
    const uint32_t angle = chord > shortest2(lens, a->flags & b->flags) ? apart2(a, b) : 0;
    if (angle < SHORT) {
        return 0;
    }
    divide(lens, a, b, m);
    const int32_t dx = b->at.x - a->at.x, dy = b->at.y - a->at.y;
    const int64_t area = fx_mul_wide(m->at.x - a->at.x, dy) - fx_mul_wide(dx, m->at.y - a->at.y);
    const int64_t most = (int64_t)(fx_magnitude(dx) > fx_magnitude(dy) ? fx_magnitude(dx) : fx_magnitude(dy)) << 7;
    return area > most || area < -most ? angle : 0;
}

/* The sides of the picture beyond which a point lies by more than the margin: an edge between two such points that is
 * at most twice as long does not reach the picture, however it bends. */
static unsigned sides_of(const struct ph_renderer *r, int32_t x, int32_t y, int32_t margin)
{
    const int32_t right = r->config.width * 256 + margin, bottom = r->config.height * 256 + margin;
    return (x < -margin ? PH_LEFT : 0u) | (x > right ? PH_RIGHT : 0u) | (y < -margin ? PH_TOP : 0u) |
           (y > bottom ? PH_BOTTOM : 0u);
}

/* Whether all vertices are beyond one side of the picture. Edges are at most twice as long as the longest that are
 * drawn; if they are short, chords may be 17/32 f behind the viewer: over half of these is the margin. */
static bool misses_picture(const struct ph_renderer *r, const struct vertex *const v[], int n)
{
    const int32_t margin = r->lens.chord_max;
    unsigned outside = PH_LEFT | PH_RIGHT | PH_TOP | PH_BOTTOM;
    for (int i = 0; i < n && outside != 0; i++) {
        outside &= sides_of(r, v[i]->at.x, v[i]->at.y, margin);
    }
    return outside != 0;
}

bool ph_fisheye_misses(const struct ph_renderer *r, const struct ph_vertex *const v[3])
{
    const int32_t margin = r->lens.chord_max;
    unsigned outside = PH_LEFT | PH_RIGHT | PH_TOP | PH_BOTTOM;
    for (int i = 0; i < 3 && outside != 0; i++) {
        outside &= sides_of(r, v[i]->x, v[i]->y, margin);
    }
    const uint32_t most = 4 * longest2(&r->lens);
    return outside != 0 && chord2(v[0]->x, v[0]->y, v[1]->x, v[1]->y) <= most &&
           chord2(v[1]->x, v[1]->y, v[2]->x, v[2]->y) <= most && chord2(v[2]->x, v[2]->y, v[0]->x, v[0]->y) <= most;
}

static struct ph_corner corner_of(const struct ph_lens *lens, const struct vertex *v)
{
    const struct ph_quotient depth = depth_of(lens, v);
    return (struct ph_corner){{v->at.x, v->at.y, depth.q, depth.s, 0, (uint16_t)v->light}, {v->uv[0], v->uv[1]}};
}

static void set_vertex(const struct ph_lens *lens, const struct ph_clip_vertex *in, struct vertex *v)
{
    unit_of((const int32_t[3]){in->x, in->y, in->w}, v->direction, &v->inverse);
    v->light = in->light;
    v->uv[0] = in->uv[0];
    v->uv[1] = in->uv[1];
    place(lens, v);
    set_spheres(lens, v);
}

/* ---- clipping ------------------------------------------------------------------------------------------------- */

/* The distance that belongs to an inverse, in units of 2^up of Q16.16. */
static int32_t distance_of(struct inverse inverse, int up)
{
    int shift;
    const uint32_t r = fx_rcp_norm(inverse.m, &shift); /* 2^61 / m */
    const int down = inverse.s - 1 + up;
    return down <= 0 ? FX_MAX : down < 32 ? (int32_t)(r >> down) : 0;
}

/* A sphere's distance in units of 2^up. */
static int32_t scaled(fx_t distance, int up)
{
    return up >= 32 ? 0 : up >= 0 ? distance >> up : fx_sat64((int64_t)((uint64_t)distance << (up > -31 ? -up : 31)));
}

static int32_t along(int32_t direction, int32_t distance)
{
    return (int32_t)(fx_mul_wide(direction, distance) >> 29);
}

/* A vertex as a corner, with its distance between both spheres: that is not linear along an edge, and a point that
 * clipping has made may be 1/80 off its sphere. */
static struct ph_corner cut_corner(const struct ph_lens *lens, const struct vertex *v)
{
    const struct inverse near = {lens->near_over, lens->near_zeros}, far = {lens->far_over, lens->far_zeros};
    struct vertex corner = *v;
    corner.inverse = is_less(near, v->inverse) ? near : is_less(v->inverse, far) ? far : v->inverse;
    return corner_of(lens, &corner);
}

/* Clips a polygon to the cone that is visible, as to a far plane: z is -cosine. Returns the corners left. */
static int clip_cone(const struct ph_lens *lens, struct ph_clip_vertex *in, int n, struct ph_clip_vertex *out)
{
    static const struct ph_lens cone = {.kind = PH_FISHEYE, .near_z = FX_MIN, .far_z = -BLIND};
    struct vertex at;
    for (int i = 0; i < n; i++) {
        set_vertex(lens, &in[i], &at);
        in[i].z = -at.direction[2];
    }
    return ph_clip(&cone, in, n, out);
}

/* Clips n = 2 or 3 vertices to near and far sphere and to the cone. Returns the corners left. Coordinates are scaled so
 * that the farthest has 29 bits: the cut is as fine where the scene is tiny. */
static int clip_pieces(const struct ph_lens *lens, const struct vertex *const v[3], int n, struct ph_corner *out,
                       bool *beyond)
{
    struct ph_clip_vertex in[3], cut[PH_CLIP_MAX], polygon[PH_CLIP_MAX];
    int least = v[0]->inverse.s;
    for (int i = 1; i < n; i++) {
        least = ph_min(least, v[i]->inverse.s);
    }
    const int up = 3 - least;
    for (int i = 0; i < n; i++) {
        const int32_t distance = distance_of(v[i]->inverse, up), *const d = v[i]->direction;
        const struct ph_clip_vertex scaled_to = {along(d[0], distance), along(d[1], distance),
                                                 along(d[2], distance), distance,
                                                 v[i]->light,           {v[i]->uv[0], v[i]->uv[1]}};
        in[i] = scaled_to;
    }
    const struct ph_lens spheres = {
        .kind = PH_FISHEYE, .near_z = scaled(lens->near_z, up), .far_z = scaled(lens->far_z, up)};
    const int count = clip_cone(lens, cut, ph_clip(&spheres, in, n, cut), polygon);
    for (int i = 0; i < count; i++) {
        struct vertex at;
        const struct vertex *from = &at;
        set_vertex(lens, &polygon[i], &at);
        at.inverse.s -= up;
        for (int k = 0; k < n; k++) { /* a corner that was one before keeps its place to the last bit */
            const bool same = polygon[i].x == in[k].x && polygon[i].y == in[k].y && polygon[i].w == in[k].w;
            from = same ? v[k] : from;
        }
        *beyond |= (from->flags & BEYOND) != 0;
        out[i] = cut_corner(lens, from);
    }
    return count;
}

/* ---- triangles ------------------------------------------------------------------------------------------------ */

/* A piece of a triangle that waits on the stack. */
struct piece {
    uint8_t corner[3]; /* indices into the pool */
    uint8_t straight;  /* bit k: the edge opposite corner k need not be divided */
    uint8_t used;      /* the piece needs the first `used` vertices of the pool */
};

struct division {
    struct ph_renderer *r;
    const struct ph_material *material;
    uint32_t kind; /* enum ph_draw_kind */
    struct vertex pool[POOL];
    int32_t number[POOL]; /* of the pool's vertices as corners on the list, -1: not there yet */
    uint32_t base;        /* from which they count */
    struct piece stack[DEPTH + 1];
    bool any, clipped;
};

static const uint8_t next_corner[4] = {1, 2, 0, 1};

/* Divides a piece at `middle`, which is in the pool. *p becomes one half; the other half is returned. */
static struct piece divide_piece(struct division *d, struct piece *p, int edge)
{
    const int from = next_corner[edge], to = next_corner[edge + 1];
    const uint8_t middle = p->used++;
    d->number[middle] = -1;
    struct piece other = *p;
    p->corner[to] = middle;
    p->straight &= (uint8_t)(1 << to);
    other.corner[from] = middle;
    other.straight &= (uint8_t)(1 << from);
    return other;
}

static void clip_piece(struct division *d, const struct vertex *const v[3])
{
    struct ph_corner corners[PH_CLIP_MAX];
    bool beyond = false;
    const int n = clip_pieces(&d->r->lens, v, 3, corners, &beyond);
    d->clipped = true;
    if (n >= 3 && !beyond) {
        d->any |= ph_list_fan(d->r, d->material, d->kind, corners, (uint32_t)n);
    }
}

/* If corners count from elsewhere now, those on the list have lost their numbers. */
static bool has_moved(struct division *d)
{
    if (ph_list_base(d->r) == d->base) {
        return false;
    }
    for (int i = 0; i < POOL; i++) {
        d->number[i] = -1;
    }
    d->base = ph_list_base(d->r);
    return true;
}

/* Puts the corners of a piece on the list, unless they are there. False: there is no room. */
static bool list_corners(struct division *d, const uint8_t corner[3], uint16_t number[3])
{
    const uint32_t kind = d->kind | (ph_has_uvs(d->material) ? PH_DRAW_UVS : 0);
    has_moved(d);
    for (int i = 0; i < 3; i++) {
        int32_t *const known = &d->number[corner[i]];
        if (*known < 0) {
            const struct ph_corner to = corner_of(&d->r->lens, &d->pool[corner[i]]);
            const int32_t first = ph_list_corners(d->r, d->material, kind, &to, 1);
            if (first < 0) {
                return false;
            }
            i = has_moved(d) ? -1 : i; /* then all three are listed again */
            *known = first;
        }
        if (i >= 0) {
            number[i] = (uint16_t)*known;
        }
    }
    return true;
}

/* Lists a piece if it can be seen. */
static void list_piece(struct division *d, const struct vertex *const v[3], const uint8_t corner[3])
{
    struct ph_vertex at[3];
    for (int i = 0; i < 3; i++) {
        at[i].x = v[i]->at.x;
        at[i].y = v[i]->at.y;
    }
    const struct ph_vertex *const place[3] = {&at[0], &at[1], &at[2]};
    const int32_t area = ph_sides(&at[0], &at[1], &at[2]).area;
    const int32_t row = ph_first_row_of(d->r, place);
    uint16_t number[3];
    if (area == 0 || (area < 0 && d->material->two_sided == 0) || row < 0) {
        return;
    }
    d->any = true;
    if (!list_corners(d, corner, number)) {
        d->r->stats.triangles_dropped++;
        return;
    }
    struct ph_ref *const ref = ph_list_next(d->r);
    if (ref != NULL) {
        *ref = (struct ph_ref){{number[0], number[area > 0 ? 1 : 2], number[area > 0 ? 2 : 1]}, ph_band_of(d->r, row)};
    }
}

/* The edge of a piece to be divided, or -1; its dividing point becomes *middle. */
static int edge_to_divide(const struct ph_renderer *r, struct piece *p, const struct vertex *const v[3],
                          struct vertex *middle)
{
    uint32_t chord[3], most = 0, longest = 0;
    int edge = -1;
    for (int k = 0; k < 3; k++) {
        const struct vertex *const from = v[next_corner[k]], *const to = v[next_corner[k + 1]];
        chord[k] = chord_of(from, to);
        longest = chord[k] > longest ? chord[k] : longest;
        const uint32_t angle = (p->straight >> k & 1) == 0 ? long_angle(&r->lens, from, to, chord[k]) : 0;
        edge = angle > most ? k : edge;
        most = angle > most ? angle : most;
    }
    if ((edge < 0 || longest <= 4 * longest2(&r->lens)) && misses_picture(r, v, 3)) {
        return -1;
    }
    if (edge >= 0) {
        divide(&r->lens, v[next_corner[edge]], v[next_corner[edge + 1]], middle);
        return edge;
    }
    for (int k = 0; k < 3; k++) {
        const struct vertex *const from = v[next_corner[k]], *const to = v[next_corner[k + 1]];
        struct vertex m;
        const uint32_t angle = (p->straight >> k & 1) == 0 ? bent_angle(&r->lens, from, to, chord[k], &m) : 0;
        if (angle > most) {
            edge = k;
            most = angle;
            *middle = m;
        }
        p->straight |= (uint8_t)((angle == 0) << k);
    }
    return edge;
}

/* Draws the piece on top of the stack, or divides it into top[0] and top[1]; then it returns true. */
static bool take_piece(struct division *d, struct piece *top)
{
    const struct vertex *const v[3] = {&d->pool[top->corner[0]], &d->pool[top->corner[1]], &d->pool[top->corner[2]]};
    const unsigned all = v[0]->flags & v[1]->flags & v[2]->flags, any = v[0]->flags | v[1]->flags | v[2]->flags;
    if ((all & (NEAR | BLIND_SPOT)) != 0) {
        return false;
    }
    const int edge = top->used < POOL ? edge_to_divide(d->r, top, v, &d->pool[top->used]) : -1;
    if (edge >= 0) {
        top[1] = divide_piece(d, top, edge);
        return true;
    }
    if ((all & FAR) == 0 && (any & CUT) != 0) {
        clip_piece(d, v);
    } else if ((all & FAR) == 0 && (any & BEYOND) == 0) {
        list_piece(d, v, top->corner);
    }
    return false;
}

/*
 * Whether the triangle is a back face: the sign of the volume of its directions. It is decided for the whole triangle,
 * because rounding may turn pieces of one seen edge-on either way.
 */
static bool faces_away(const struct vertex v[3])
{
    int32_t e[2][3];
    int64_t volume = 0;
    for (int i = 0; i < 3; i++) {
        e[0][i] = v[1].direction[i] - v[0].direction[i];
        e[1][i] = v[2].direction[i] - v[0].direction[i];
    }
    for (int i = 0; i < 3; i++) {
        const int k = next_corner[i], l = next_corner[i + 1];
        const int64_t cross = fx_mul_wide(e[0][k], e[1][l]) - fx_mul_wide(e[0][l], e[1][k]);
        volume += fx_mul_wide(v[0].direction[i], (int32_t)(cross >> 31));
    }
    return volume >= 0; /* y points down */
}

void ph_fisheye_triangle(struct ph_renderer *r, const struct ph_material *material, uint32_t kind,
                         const struct ph_clip_vertex in[3])
{
    struct division d;
    d.r = r;
    d.material = material;
    d.kind = kind;
    d.base = ph_list_base(r);
    d.any = d.clipped = false;
    for (int i = 0; i < 3; i++) {
        set_vertex(&r->lens, &in[i], &d.pool[i]);
        d.number[i] = -1;
    }
    if (material->two_sided == 0 && faces_away(d.pool)) {
        r->stats.triangles_culled++;
        return;
    }
    const struct ph_mark mark = ph_list_mark(r);
    d.stack[0] = (struct piece){{0, 1, 2}, 0, 3};
    int waiting = 1, left = SPLITS_MAX;
    while (waiting > 0 && left > 0) {
        const bool divided = take_piece(&d, &d.stack[waiting - 1]);
        left -= divided;
        waiting += divided ? 1 : -1;
    }
    ph_list_rewind(r, &mark);
    r->stats.triangles_dropped += waiting > 0;
    r->stats.triangles_clipped += d.clipped;
    r->stats.triangles_culled += !d.any;
}

/* ---- lines ---------------------------------------------------------------------------------------------------- */

static void draw_line_piece(struct ph_renderer *r, const struct ph_material *material, const struct vertex *a,
                            const struct vertex *b)
{
    const struct vertex *const ends[3] = {a, b, b};
    struct ph_corner corners[PH_CLIP_MAX];
    bool beyond = false;
    if (((a->flags | b->flags) & CUT) == 0) {
        corners[0] = corner_of(&r->lens, a);
        corners[1] = corner_of(&r->lens, b);
        beyond = ((a->flags | b->flags) & BEYOND) != 0;
    } else if (clip_pieces(&r->lens, ends, 2, corners, &beyond) != 2) {
        return;
    }
    if (!beyond) {
        ph_list_segment(r, material, corners);
    }
}

/* The ends still to be reached wait on a stack. A piece is drawn, or its dividing point is pushed onto the stack. */
void ph_fisheye_line(struct ph_renderer *r, const struct ph_material *material, const struct ph_clip_vertex ends[2])
{
    const struct ph_lens *lens = &r->lens;
    struct vertex stack[DEPTH], from;
    set_vertex(lens, &ends[0], &from);
    set_vertex(lens, &ends[1], &stack[0]);
    for (int top = 0; top >= 0;) {
        const struct vertex *to = &stack[top], *const both[2] = {&from, to};
        const uint32_t chord = chord_of(&from, to);
        struct vertex middle;
        const bool is_long = long_angle(lens, &from, to, chord) > 0, misses = !is_long && misses_picture(r, both, 2);
        if (is_long) {
            divide(lens, &from, to, &middle);
        }
        if ((is_long || (!misses && bent_angle(lens, &from, to, chord, &middle) > 0)) && top + 1 < DEPTH) {
            stack[++top] = middle;
            continue;
        }
        if (!misses) {
            draw_line_piece(r, material, &from, to);
        }
        from = *to;
        top--;
    }
}
