/* See sim_factors.h. */
#include "sim_factors.h"

#include "sim_fraction.h"

static void put(FILE *file, const char *factor, int row, int column, struct sim_fraction exact, fx_t code)
{
    char name[24];
    snprintf(name, sizeof name, "%s.%d.%d", factor, row, column);
    sim_fraction_print(file, name, exact, code);
}

static void put_nearest(FILE *file, const char *factor, int row, int column, struct sim_fraction exact)
{
    put(file, factor, row, column, exact, sim_fraction_code(exact));
}

static struct sim_fraction signed_as(bool other_sign, struct sim_fraction a)
{
    return other_sign ? sim_fraction_minus(a) : a;
}

/* Coordinate i of the eye: -r^T t. */
static struct sim_fraction eye_at(const struct ph_xform *view, int i)
{
    const fx_t t[3] = {view->t.x, view->t.y, view->t.z};
    struct sim_fraction sum = sim_fraction_of(0, 0);
    for (int k = 0; k < 3; k++) {
        sum = sim_fraction_add(sum, sim_fraction_times(sim_fraction_of(view->r[k][i], 30), sim_fraction_of(t[k], 16)));
    }
    return sim_fraction_minus(sum);
}

static void put_view(FILE *file, const struct ph_xform *view, struct sim_matrix_writing writing)
{
    const struct ph_mat4 matrix = sim_matrix_of_view(view, writing);
    const struct ph_xform node = ph_xform_inverse_rigid(view);
    const fx_t codes[3] = {node.t.x, node.t.y, writing.left_world ? fx_neg_sat(node.t.z) : node.t.z};
    struct sim_fraction eye[3], turn[3][3];
    for (int i = 0; i < 3; i++) {
        eye[i] = signed_as(i == 2 && writing.left_world, eye_at(view, i));
        for (int j = 0; j < 3; j++) {
            const bool left_camera = i == 2 && writing.convention == PH_D3D, left_world = j == 2 && writing.left_world;
            turn[i][j] = signed_as(left_camera != left_world, sim_fraction_of(view->r[i][j], 30));
        }
    }
    for (int i = 0; i < 9; i++) {
        put(file, "R", i / 3, i % 3, turn[i / 3][i % 3], matrix.m[i / 3][i % 3]);
    }
    for (int i = 0; i < 3; i++) {
        put(file, "T", i, 3, sim_fraction_minus(eye[i]), fx_neg_sat(codes[i]));
    }
    for (int i = 0; i < 12; i++) {
        const int row = i / 4, column = i % 4;
        put(file, "camera", row, column, column == 3 ? eye[row] : turn[column][row],
            column == 3 ? codes[row] : matrix.m[column][row]);
    }
}

/* By how much the depth grows from the near to the far plane. */
static const int spans[] = {[PH_GL] = 2, [PH_D3D] = 1, [PH_LMU] = -2, [PH_REVERSED] = -1};

/* scale and shift, which take the box between near and far plane to normalised device coordinates. n, f: as coordinates
 * along z. to_unit: what an element of the projection's x and y is divided by. */
static void put_box(FILE *file, const struct ph_projection *p, enum ph_convention convention, struct sim_fraction n,
                    struct sim_fraction f, struct sim_fraction to_unit)
{
    const struct sim_fraction range = sim_fraction_add(f, sim_fraction_minus(n)), sum = sim_fraction_add(n, f);
    const struct sim_fraction half = sim_fraction_of(1, 1);
    const struct sim_fraction scale[2] = {sim_fraction_of(p->scale_x_q20, 20), sim_fraction_of(p->scale_y_q20, 20)};
    const fx_t shift[2] = {p->shift_x, p->shift_y};
    for (int i = 0; i < 2; i++) {
        put_nearest(file, "scale", i, i, sim_fraction_divide(scale[i], to_unit));
    }
    put_nearest(file, "scale", 2, 2, sim_fraction_divide(sim_fraction_of(spans[convention], 0), range));
    for (int i = 0; i < 2; i++) {
        const struct sim_fraction off = sim_fraction_times(sim_fraction_of(shift[i], 16), to_unit);
        put_nearest(file, "shift", i, 3,
                    sim_fraction_is_0(scale[i]) ? scale[i] : sim_fraction_minus(sim_fraction_divide(off, scale[i])));
    }
    const struct sim_fraction middle = convention == PH_D3D        ? n
                                       : convention == PH_REVERSED ? f
                                                                   : sim_fraction_times(sum, half);
    put_nearest(file, "shift", 2, 3, sim_fraction_minus(middle));
}

void sim_factors_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection,
                       struct sim_matrix_writing writing)
{
    const enum ph_convention convention = writing.convention;
    const struct sim_fraction near = sim_fraction_of(projection->near_z, 16),
                              far = sim_fraction_of(projection->far_z, 16), one = sim_fraction_of(1, 0);
    const bool back = convention != PH_D3D; /* what is visible has z < 0 */
    const struct sim_fraction n = signed_as(back, near), f = signed_as(back, far);
    put_view(file, view, writing);
    if (projection->kind == PH_ORTHOGRAPHIC) {
        put_box(file, projection, convention, n, f, one);
    } else if (projection->kind == PH_PERSPECTIVE) {
        /* LMU's w is z, which is below 0, and so its n is the coordinate; elsewhere w is the distance */
        const bool by_z = convention == PH_D3D || convention == PH_LMU;
        const struct sim_fraction on = by_z ? n : near, off = by_z ? f : far;
        const struct sim_fraction w1 = sim_fraction_add(on, off);
        const struct sim_fraction w2 = signed_as(by_z, sim_fraction_times(near, far));
        put_box(file, projection, convention, n, f, near);
        put_nearest(file, "persp", 0, 0, on);
        put_nearest(file, "persp", 1, 1, on);
        sim_fraction_print(file, "w1", w1, sim_fraction_code(w1));
        sim_fraction_print(file, "w2", w2, sim_fraction_code(w2));
        put_nearest(file, "persp", 3, 2, sim_fraction_of(by_z ? 1 : -1, 0));
        put_nearest(file, "persp", 3, 3, sim_fraction_of(0, 0));
    }
}
