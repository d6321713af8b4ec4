/*
 * The fisheye is the equidistant projection: a point at the angle theta from the view direction lies r = f theta from
 * the centre of the picture. See fisheye.h.
 *
 * A vertex is its direction, a unit vector (x, y, c), and 1 / distance. Its place is f g (x, y) from the centre, where
 * g = theta / sin theta is a smooth function of c = cos theta, and comes from a table: no angle and no root is taken.
 *
 * Depth is the distance from the eye, so the near and the far plane are spheres.
 */
/* Kits on armv6m: -O2. */
#include "fisheye.h"
#include "fisheye_ray.h"

#define LONG        20           /* edges longer than this part of a turn are divided always */
#define SET_UP_MAX  (2048 * 256) /* set-up takes coordinates up to here from the centre, 1/256 px */
#define PART_Q32(v) ((uint32_t)((v)*4294967296.0))
#define G_SHIFT     23 /* from c in Q29 to a step of the table: 64 steps from 0 to 1 */

/* theta / sin theta at c = cos theta = i / 64 (above 1: arcosh c / sinh arcosh c), Q30. */
PH_TIER(few)
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

/* theta / sin theta behind the viewer, Q26: octave k, 34 entries, is at 1 + c = 2^-(k + 1) (1 + i / 32). */
PH_TIER(few)
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

PH_TIER(few) void ph_fisheye_unit(const int32_t v[3], int32_t unit[3], struct ph_inverse *inverse)
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
        *inverse = (struct ph_inverse){((uint32_t)1 << 31) - 1, 62};
        return;
    }
    const int half = square >> 30 == 0;
    const uint32_t root = fx_rsqrt_norm(square << 2 * half), most = (uint32_t)1 << 30;
    const uint32_t y = root < most ? root : most - 1;
    for (int i = 0; i < 3; i++) {
        unit[i] = ph_high_product(scaled[i], (int32_t)(y << half));
    }
    *inverse = (struct ph_inverse){2 * y, up + half};
}

/* Quadratic interpolation between g[0] and g[1]; both falls are positive, the second is the smaller one. */
static inline uint32_t between(const uint32_t *g, uint32_t part_q32)
{
    const uint32_t fall = g[0] - g[1], bend = fall - (g[1] - g[2]), part = part_q32 >> 16;
    return g[0] - fx_mulhi_u32(fall, part_q32) - ((bend >> 8) * (part * (65536 - part) >> 17) >> 8);
}

/* g = theta / sin theta at c = cos theta, Q26, 2^-18 off at most. */
PH_TIER(few) static uint32_t g_of(int32_t c)
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

/* 1/256 px, rounded to nearest: the low word's top bit says whether it is a half or more. */
static inline int32_t offset(int32_t direction, uint32_t g, int32_t focal)
{
    const int32_t radians = ph_high_product(direction * 2, (int32_t)g); /* Q24 */
    return ph_high_product(radians, focal) + (int32_t)((uint32_t)radians * (uint32_t)focal >> 31);
}

PH_TIER(scenery) unsigned ph_fisheye_zone(const struct ph_lens *lens, uint32_t size)
{
    const uint32_t aside = fx_mulhi_u32((uint32_t)lens->radian_px, PART_Q32(1.851 / 256)); /* 5 pi / 6 / sqrt 2 */
    return size >= aside ? 0 : size < aside - (aside >> 2) + (aside >> 5) ? PH_RAY_BEFORE | PH_RAY_ASIDE : PH_RAY_ASIDE;
}

/* Compares the distance with both spheres. */
PH_TIER(few) static unsigned spheres_of(const struct ph_lens *lens, struct ph_inverse inverse)
{
    const struct ph_inverse near = {lens->near_over, lens->near_zeros}, far = {lens->far_over, lens->far_zeros};
    return (ph_inverse_is_less(near, inverse) ? PH_RAY_NEAR : 0u) |
           (ph_inverse_is_less(inverse, far) ? PH_RAY_FAR : 0u);
}

PH_TIER(few) void ph_fisheye_place(const struct ph_lens *lens, struct ph_ray *v)
{
    const uint32_t g = g_of(v->direction[2]);
    const int32_t focal = lens->radian_px, x = offset(v->direction[0], g, focal), y = offset(v->direction[1], g, focal);
    const uint32_t size = fx_magnitude(x) > fx_magnitude(y) ? fx_magnitude(x) : fx_magnitude(y);
    v->at.x = lens->centre_x + x;
    v->at.y = lens->centre_y + y;
    v->flags =
        (uint16_t)((v->direction[2] < PH_FISHEYE_BLIND ? PH_RAY_BLIND : 0u) | (size > SET_UP_MAX ? PH_RAY_BEYOND : 0u) |
                   ph_fisheye_zone(lens, size) | spheres_of(lens, v->inverse));
}

PH_TIER(few) void ph_fisheye_lens(struct ph_lens *lens, const struct ph_projection *p, int32_t height)
{
    lens->focal_x = lens->focal_y = FX_Q30_ONE; /* x and y of the clip matrix are lengths */
    const uint32_t turn_px = (uint32_t)((fx_mul_wide(p->scale_y_q20, height) * 205887) >> 20); /* pi half heights */
    lens->radian_px = (int32_t)fx_mulhi_u32(turn_px, PART_Q32(.15915494309));
    lens->chord_min2 = turn_px / 19 * 3; /* f square pixels: over 2 pi */
    const uint32_t quarter_radian = turn_px / (LONG * 256);
    lens->chord_max = (int32_t)(quarter_radian < 65536 ? quarter_radian : 65536);
    int zeros;
    lens->near_over = fx_rcp_norm((uint32_t)p->near_z, &zeros);
    lens->near_zeros = (int16_t)zeros;
    lens->far_over = fx_rcp_norm((uint32_t)p->far_z, &zeros);
    lens->far_zeros = (int16_t)zeros;
}

PH_TIER(scenery) static struct ph_quotient depth_of(const struct ph_lens *lens, const struct ph_ray *v)
{
    return ph_depth_quotient_of(lens, v->inverse.m, v->inverse.s);
}

PH_TIER(few) void ph_fisheye_vertex(const struct ph_lens *lens, int32_t x, int32_t y, int32_t w, struct ph_vertex *v)
{
    struct ph_ray to;
    ph_fisheye_unit((const int32_t[3]){x, y, w}, to.direction, &to.inverse);
    ph_fisheye_place(lens, &to);
    v->code = (to.flags & PH_RAY_NEAR) != 0 ? PH_NEAR : (to.flags & (PH_RAY_CUT | PH_RAY_BEYOND)) != 0 ? PH_GUARD : 0;
    v->x = to.at.x;
    v->y = to.at.y;
    ph_vertex_depth(v, depth_of(lens, &to));
}

struct ph_corner ph_ray_corner(const struct ph_lens *lens, const struct ph_ray *v)
{
    const struct ph_quotient depth = depth_of(lens, v);
    return (struct ph_corner){{v->at.x, v->at.y, depth.q, depth.s, 0, v->light}, {v->uv[0], v->uv[1]}};
}

PH_TIER(scenery) void ph_fisheye_ray(const struct ph_lens *lens, const struct ph_clip_vertex *in, struct ph_ray *v)
{
    ph_fisheye_unit((const int32_t[3]){in->x, in->y, in->w}, v->direction, &v->inverse);
    v->light = (uint16_t)in->light;
    v->uv[0] = in->uv[0];
    v->uv[1] = in->uv[1];
    ph_fisheye_place(lens, v);
}
