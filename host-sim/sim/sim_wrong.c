/* See sim_wrong.h. A lens is mended by trial: the transpose, other conventions, other signs, zeros. What mends it was
 * wrong with it. */
#include "sim_wrong.h"

#include <math.h>
#include <string.h>

static const char *const convention_names[] = {
    [PH_GL] = "gl", [PH_D3D] = "d3d", [PH_LMU] = "lmu", [PH_REVERSED] = "reversed"};

/* The depth of the near and of the far plane. */
static const double ends[][2] = {[PH_GL] = {-1, 1}, [PH_D3D] = {0, 1}, [PH_LMU] = {1, -1}, [PH_REVERSED] = {1, 0}};

static bool is_zero(double x)
{
    return fabs(x) < 1e-6;
}

static struct sim_matrix transpose(const struct sim_matrix *a)
{
    struct sim_matrix t;
    for (int i = 0; i < 16; i++) {
        t.m[i / 4][i % 4] = a->m[i % 4][i / 4];
    }
    return t;
}

static struct sim_matrix product(const struct sim_matrix *a, const struct sim_matrix *b)
{
    struct sim_matrix p;
    for (int i = 0; i < 16; i++) {
        double sum = 0;
        for (int k = 0; k < 4; k++) {
            sum += a->m[i / 4][k] * b->m[k][i % 4];
        }
        p.m[i / 4][i % 4] = sum;
    }
    return p;
}

static double minor_of(const struct sim_matrix *a, int row, int column)
{
    double r[3][3];
    for (int i = 0; i < 9; i++) {
        r[i / 3][i % 3] = a->m[i / 3 + (i / 3 >= row)][i % 3 + (i % 3 >= column)];
    }
    return r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1]) - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0]) +
           r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0]);
}

static double determinant(const struct sim_matrix *a)
{
    double sum = 0;
    for (int j = 0; j < 4; j++) {
        sum += (j % 2 == 0 ? 1 : -1) * a->m[0][j] * minor_of(a, 0, j);
    }
    return sum;
}

/* ---- views -------------------------------------------------------------------------------------------------- */

static double dot(const double a[4], const double b[4])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Says which row of the rotation is not of unit length, or which two are not at right angles. */
static void tell_axes(const struct sim_matrix *m, char text[SIM_WRONG_TEXT])
{
    double length[3];
    for (int i = 0; i < 3; i++) {
        length[i] = sqrt(dot(m->m[i], m->m[i]));
    }
    if (fabs(length[0] - 1) > 1e-4 && fabs(length[0] - length[1]) < 1e-4 && fabs(length[0] - length[2]) < 1e-4) {
        snprintf(text, SIM_WRONG_TEXT, "scales by %g: a camera's rows have the length 1", length[0]);
        return;
    }
    for (int i = 0; i < 3; i++) {
        if (fabs(length[i] * length[i] - 1) >= 1e-4) {
            snprintf(text, SIM_WRONG_TEXT, "row %d has the length %g, not 1", i, length[i]);
            return;
        }
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, low = i < j ? i : j, high = i < j ? j : i;
        const double cosine = dot(m->m[i], m->m[j]);
        if (fabs(cosine) >= 1e-4) {
            snprintf(text, SIM_WRONG_TEXT, "shears: rows %d and %d are not at right angles, their product is %g, not 0",
                     low, high, cosine);
            return;
        }
    }
    snprintf(text, SIM_WRONG_TEXT, "an element of column 3 does not fit: it must be less than 32768");
}

void sim_wrong_view(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT])
{
    struct ph_xform view;
    bool left_world;
    const struct sim_matrix turned = transpose(m);
    const double turn = minor_of(m, 3, 3);
    if (is_zero(turn)) {
        snprintf(text, SIM_WRONG_TEXT, "flattens: the determinant of its rotation is 0");
    } else if (sim_matrix_view(&turned, convention, &view, &left_world) == 0) {
        snprintf(text, SIM_WRONG_TEXT, "transposed: the way to the eye stands in row 3; it belongs in column 3");
    } else if (!is_zero(m->m[3][0]) || !is_zero(m->m[3][1]) || !is_zero(m->m[3][2]) || !is_zero(m->m[3][3] - 1)) {
        snprintf(text, SIM_WRONG_TEXT, "row 3 is %g,%g,%g,%g, not 0,0,0,1", m->m[3][0], m->m[3][1], m->m[3][2],
                 m->m[3][3]);
    } else if (fabs(turn + 1) < 1e-3 && convention != PH_D3D) {
        snprintf(text, SIM_WRONG_TEXT,
                 "handedness: determinant -1, so it mirrors; a camera of this convention has 1. With d3d both hands "
                 "are cameras");
    } else {
        tell_axes(m, text);
    }
}

/* ---- lenses ------------------------------------------------------------------------------------------------- */

static bool is_lens(const struct sim_matrix *m, enum ph_convention convention, struct ph_projection *p)
{
    return sim_matrix_projection(m, convention, p) == 0 && p->near_z > 0;
}

/* The depth that a point on the view's axis gets. */
static double depth_at(const struct sim_matrix *m, enum ph_convention convention, double distance)
{
    const double z = convention == PH_D3D ? distance : -distance;
    return (m->m[2][2] * z + m->m[2][3]) / (m->m[3][2] * z + m->m[3][3]);
}

/* Tells what the wrong sign of one element does. p: the mended lens. */
static void tell_sign(const struct sim_matrix *m, enum ph_convention convention, const struct ph_projection *p, int row,
                      int column, char *text, size_t room)
{
    const double n = p->near_z / (double)FX_ONE, f = p->far_z / (double)FX_ONE;
    const int length = snprintf(text, room, "row %d, column %d has the other sign: ", row, column);
    text += length, room -= (size_t)length;
    if (row == 2) {
        snprintf(text, room, "near goes to %g, not %g, and far to %g, not %g", depth_at(m, convention, n),
                 ends[convention][0], depth_at(m, convention, f), ends[convention][1]);
    } else if (row == 3) {
        snprintf(text, room, "w is %s 0 for what lies before the camera",
                 convention == PH_LMU && p->kind == PH_PERSPECTIVE ? "above" : "below");
    } else {
        snprintf(text, room, "the picture is %s", row == 0 ? "mirrored left to right" : "upside down");
    }
}

/* Tries other signs of up to `left` elements from number `from` on. Returns the set of those that make it a lens, or 0.
 */
static unsigned mend_signs(struct sim_matrix *m, enum ph_convention convention, struct ph_projection *p, int from,
                           int left)
{
    for (int i = from; i < 16; i++) {
        double *const element = &m->m[i / 4][i % 4];
        if (is_zero(*element)) {
            continue;
        }
        *element = -*element;
        const unsigned more = left == 1 ? 0 : mend_signs(m, convention, p, i + 1, left - 1);
        const bool mended = left == 1 ? is_lens(m, convention, p) : more != 0;
        *element = -*element;
        if (mended) {
            return 1u << i | more;
        }
    }
    return 0;
}

static bool tell_signs(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT])
{
    struct sim_matrix tried = *m;
    struct ph_projection p;
    unsigned wrong = 0;
    for (int count = 1; count <= 3 && wrong == 0; count++) {
        wrong = mend_signs(&tried, convention, &p, 0, count);
    }
    size_t used = 0;
    for (int i = 0; i < 16; i++) {
        if ((wrong >> i & 1) != 0) {
            used += (size_t)snprintf(text + used, SIM_WRONG_TEXT - used, "%s", used > 0 ? "; " : "");
            tell_sign(m, convention, &p, i / 4, i % 4, text + used, SIM_WRONG_TEXT - used);
            used = strlen(text);
        }
    }
    if (wrong == 1u << 11 && p.kind == PH_ORTHOGRAPHIC && (!is_zero(m->m[0][3]) || !is_zero(m->m[1][3]))) {
        snprintf(text + used, SIM_WRONG_TEXT - used, "; rows 0 and 1 may have it, too: EECE 478 prints all three so");
    }
    return wrong != 0;
}

/* Tries a zero in place of each element. */
static bool tell_zeros(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT])
{
    struct ph_projection p;
    for (int i = 0; i < 16; i++) {
        struct sim_matrix tried = *m;
        tried.m[i / 4][i % 4] = 0;
        if (!is_zero(m->m[i / 4][i % 4]) && is_lens(&tried, convention, &p)) {
            snprintf(text, SIM_WRONG_TEXT, "row %d, column %d is %g and must be 0", i / 4, i % 4, m->m[i / 4][i % 4]);
            return true;
        }
    }
    return false;
}

/* Whether row 2 is a multiple of row 3, or all zeros. */
static bool depth_is_constant(const struct sim_matrix *m, double *depth)
{
    const double *const z = m->m[2], *const w = m->m[3];
    bool constant = true;
    *depth = 0;
    for (int i = 0; i < 4; i++) {
        *depth = is_zero(w[i]) ? *depth : z[i] / w[i];
    }
    for (int i = 0; i < 4; i++) {
        constant = constant && is_zero(z[i] - *depth * w[i]);
    }
    return constant;
}

/* The distances whose depth is that of the near and of the far plane. */
static void planes_of(const struct sim_matrix *m, enum ph_convention convention, double planes[2])
{
    const double side = convention == PH_D3D ? 1 : -1;
    for (int i = 0; i < 2; i++) {
        const double e = ends[convention][i];
        planes[i] = side * (e * m->m[3][3] - m->m[2][3]) / (m->m[2][2] - e * m->m[3][2]);
    }
}

/* The matrix with the depths of near and far plane swapped. */
static struct sim_matrix swap_planes(const struct sim_matrix *m, enum ph_convention convention)
{
    struct sim_matrix s = *m;
    for (int j = 0; j < 4; j++) {
        s.m[2][j] = (ends[convention][0] + ends[convention][1]) * m->m[3][j] - m->m[2][j];
    }
    return s;
}

void sim_wrong_lens(const struct sim_matrix *m, enum ph_convention convention, char text[SIM_WRONG_TEXT])
{
    struct ph_projection p;
    const struct sim_matrix turned = transpose(m), swapped = swap_planes(m, convention);
    double depth, planes[2];
    planes_of(m, convention, planes);
    if (depth_is_constant(m, &depth)) {
        snprintf(text, SIM_WRONG_TEXT, "flattens: no depth, every point gets %g", depth);
    } else if (is_zero(determinant(m))) {
        snprintf(text, SIM_WRONG_TEXT, "flattens: its determinant is 0, so that no depth is left");
    } else if (is_lens(&turned, convention, &p)) {
        snprintf(text, SIM_WRONG_TEXT, "transposed: row 3 must have what column 3 has, and column 3 what row 3 has");
    } else if (is_lens(&swapped, convention, &p)) {
        snprintf(text, SIM_WRONG_TEXT, "near and far are swapped: near would be at %g and far at %g", planes[0],
                 planes[1]);
    } else {
        for (int c = PH_GL; c <= PH_REVERSED; c++) {
            if (is_lens(m, (enum ph_convention)c, &p)) {
                snprintf(text, SIM_WRONG_TEXT, "is a lens as another convention writes it; give --convention %s",
                         convention_names[c]);
                return;
            }
        }
        if (!isfinite(planes[1]) && planes[0] > 0) {
            snprintf(text, SIM_WRONG_TEXT, "the far plane is infinitely far away, and Pinhole's is not");
        } else if (!tell_signs(m, convention, text) && !tell_zeros(m, convention, text)) {
            snprintf(text, SIM_WRONG_TEXT,
                     "is not a lens of the --convention, which gives w its sign and the depth its range; see camera.h");
        }
    }
}

/* ---- what they draw ----------------------------------------------------------------------------------------- */

static double length_of(const double row[4])
{
    const double length = sqrt(dot(row, row));
    return length < 1e-9 ? 1 : length;
}

static bool fixed(double x, int bits, int32_t *out)
{
    x = round(ldexp(x, bits));
    *out = fabs(x) <= INT32_MAX ? (int32_t)x : 0;
    return fabs(x) <= INT32_MAX;
}

/* Sets row i of a view to a row of a matrix times `by`. */
static bool set_row(struct ph_xform *view, int i, const double row[4], double by)
{
    fx_t *const t[3] = {&view->t.x, &view->t.y, &view->t.z};
    bool good = fixed(row[3] * by, 16, t[i]);
    for (int j = 0; j < 3; j++) {
        good = fixed(row[j] * by, 30, &view->r[i][j]) && good;
    }
    return good;
}

/* Where depth = a + b / w is in its range, for w > 0. False: nowhere. */
static bool visible_range(double a, double b, const double end[2], double range[2])
{
    const double low = fmin(end[0], end[1]), high = fmax(end[0], end[1]);
    double found[2];
    int count = 0;
    for (int i = 0; i < 2; i++) {
        const double w = b / (end[i] - a);
        if (isfinite(w) && w > 0) {
            found[count++] = w;
        }
    }
    if (count == 0) {
        return false;
    }
    range[0] = count == 2 ? fmin(found[0], found[1]) : found[0];
    range[1] = count == 2 ? fmax(found[0], found[1]) : INFINITY;
    return count == 2 || (a >= low && a <= high);
}

/* The third row of the view, and the planes. Returns 0, 1 or PH_ERR_RANGE, as sim_wrong_camera. */
static int set_depth(const struct sim_matrix *m, enum ph_convention convention, struct ph_xform *view,
                     struct ph_projection *p)
{
    const double *const z = m->m[2], *const w = m->m[3], *const end = ends[convention];
    const double unit = length_of(w);
    double range[2] = {0.1 * unit, 1000 * unit};
    if (p->kind == PH_ORTHOGRAPHIC) { /* the depth itself is the distance */
        const double length = length_of(z), side = end[1] > end[0] ? 1 : -1;
        const double row[4] = {z[0], z[1], z[2], z[3] - end[0] + side * length};
        const bool good = set_row(view, 2, row, -side / length) && fixed(1, 16, &p->near_z) &&
                          fixed(1 + fabs(end[1] - end[0]) / length, 16, &p->far_z);
        return good && p->far_z > p->near_z ? 0 : PH_ERR_RANGE;
    }
    double a = 0;
    for (int i = 0; i < 3; i++) {
        a = fabs(w[i]) > unit / 2 ? z[i] / w[i] : a;
    }
    const bool by_w = is_zero(z[0] - a * w[0]) && is_zero(z[1] - a * w[1]) && is_zero(z[2] - a * w[2]);
    const double b = z[3] - a * w[3];
    if (by_w && !is_zero(b) && !visible_range(a, b, end, range)) {
        return 1;
    }
    const double most = 32767;
    const bool good = set_row(view, 2, w, -1 / unit) && fixed(fmin(range[0] / unit, most), 16, &p->near_z) &&
                      fixed(fmin(range[1] / unit, most), 16, &p->far_z);
    return good && p->near_z > 0 && p->far_z > p->near_z ? 0 : PH_ERR_RANGE;
}

int sim_wrong_camera(const struct sim_matrix *view_matrix, const struct sim_matrix *lens_matrix,
                     enum ph_convention convention, struct ph_xform *view, struct ph_projection *projection)
{
    struct sim_matrix m = product(lens_matrix, view_matrix);
    const double *const w = m.m[3];
    const bool parallel = is_zero(w[0]) && is_zero(w[1]) && is_zero(w[2]);
    const double divide = parallel ? w[3] : convention == PH_LMU ? -1 : 1; /* LMU's w is below 0 for what is visible */
    if (parallel && w[3] < 1e-6) {
        return 1;
    }
    for (int i = 0; i < 16; i++) {
        m.m[i / 4][i % 4] /= divide;
    }
    *projection = (struct ph_projection){.kind = parallel ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE};
    const double x = length_of(m.m[0]), y = length_of(m.m[1]), unit = parallel ? 1 : length_of(w);
    const bool good = set_row(view, 0, m.m[0], 1 / x) && set_row(view, 1, m.m[1], 1 / y) &&
                      fixed(x / unit, 20, &projection->scale_x_q20) && fixed(y / unit, 20, &projection->scale_y_q20);
    const int status = set_depth(&m, convention, view, projection);
    return good ? status : PH_ERR_RANGE;
}
