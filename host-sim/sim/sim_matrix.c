/* See sim_matrix.h. */
#include "sim_matrix.h"

#include "option_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

bool sim_matrix_read(const char *text, struct sim_matrix *out)
{
    struct sim_matrix read;
    for (int i = 0; i < 16; i++) {
        char *end;
        if ((i > 0 && *text++ != ',') || strchr("+-.0123456789", *text) == NULL || *text == '\0') {
            return false;
        }
        read.m[i / 4][i % 4] = strtod(text, &end);
        if (end == text || strcspn(text, "xXiInN") < (size_t)(end - text) || !(fabs(read.m[i / 4][i % 4]) < 32768)) {
            return false;
        }
        text = end;
    }
    *out = *text == '\0' ? read : *out;
    return *text == '\0';
}

bool sim_matrix_flat(const char *text, struct ph_mat4 *out)
{
    fx_t v[4];
    struct ph_mat4 flat = {{{FX_ONE}, {0, FX_ONE}, {0}, {0, 0, FX_ONE, 0}}};
    if (strcmp(text, "kaist-4.7") == 0) {
        flat.m[3][2] = 0;
        flat.m[3][3] = FX_ONE;
    } else if (strncmp(text, "eece=", 5) == 0) {
        if (!option_text_fx(text + 5, v, &text) || *text != '\0' || v[0] == 0) {
            return false;
        }
        flat.m[2][2] = FX_ONE;
        flat.m[3][2] = fx_div_sat(FX_ONE, v[0]);
    } else if (strncmp(text, "plane=", 6) == 0) {
        if (!option_text_fx_list(text + 6, v, 4, &text) || *text != '\0' || (v[0] | v[1] | v[2]) == 0 || v[3] == 0) {
            return false;
        }
        struct fx_vec3 normal;
        fx_vec3_direction_q30((struct fx_vec3){v[0], v[1], v[2]}, &normal);
        flat = ph_matrix_plane(normal, v[3]);
    } else if (strcmp(text, "kaist-4.11") != 0) {
        return false;
    }
    *out = flat;
    return true;
}

static bool is_zero(double x)
{
    return fabs(x) < 1e-6;
}

/* Rounds x times 2^bits. False if that does not fit. */
static bool fixed(double x, int bits, int32_t *out)
{
    x = round(ldexp(x, bits));
    *out = fabs(x) <= INT32_MAX ? (int32_t)x : 0;
    return fabs(x) <= INT32_MAX;
}

/* The determinant of rows that have unit length and are at right angles to one another, 1 or -1; of others 0. */
static int hand_of(double r[3][4])
{
    bool good = true;
    double turned = 0;
    for (int i = 0; i < 3; i++) {
        const double *const a = r[i], *const b = r[(i + 1) % 3], *const c = r[(i + 2) % 3];
        good = good && fabs(a[0] * a[0] + a[1] * a[1] + a[2] * a[2] - 1) < 1e-4;
        good = good && fabs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) < 1e-4;
        turned += a[0] * (b[1] * c[2] - b[2] * c[1]);
    }
    return !good ? 0 : turned > 0 ? 1 : -1;
}

int sim_matrix_view(const struct sim_matrix *from, enum ph_convention convention, struct ph_xform *view,
                    bool *left_world)
{
    struct sim_matrix a = *from;
    const int hand = hand_of(a.m);
    *left_world = convention == PH_D3D && hand > 0;
    for (int j = 0; j < 4 && convention == PH_D3D; j++) {
        a.m[2][j] = -a.m[2][j];
    }
    for (int i = 0; i < 3 && *left_world; i++) {
        a.m[i][2] = -a.m[i][2];
    }
    bool good = (hand > 0 || (hand < 0 && convention == PH_D3D)) && is_zero(a.m[3][0]) && is_zero(a.m[3][1]) &&
                is_zero(a.m[3][2]) && is_zero(a.m[3][3] - 1);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            good = fixed(a.m[i][j], 30, &view->r[i][j]) && good;
        }
    }
    good = fixed(a.m[0][3], 16, &view->t.x) && fixed(a.m[1][3], 16, &view->t.y) && fixed(a.m[2][3], 16, &view->t.z) &&
           good;
    return good ? 0 : PH_ERR_INVAL;
}

/* Turns the matrix into one that takes z as OpenGL does and whose w is -z, or 1. False if it has no such form. */
static bool normalise(struct sim_matrix *a, enum ph_convention convention)
{
    for (int i = 0; i < 4 && convention == PH_D3D; i++) {
        a->m[i][2] = -a->m[i][2];
    }
    const double *const w = a->m[3];
    const bool parallel = is_zero(w[2]);
    const double scale = parallel ? w[3] : convention == PH_LMU ? w[2] : -w[2];
    if (!is_zero(w[0]) || !is_zero(w[1]) || (!parallel && !is_zero(w[3])) || scale < 1e-6) {
        return false;
    }
    const double by = convention == PH_LMU && !parallel ? -scale : scale;
    for (int i = 0; i < 16; i++) {
        a->m[i / 4][i % 4] /= by;
    }
    return true;
}

int sim_matrix_projection(const struct sim_matrix *from, enum ph_convention convention, struct ph_projection *p)
{
    static const double ends[][2] = {[PH_GL] = {-1, 1}, [PH_D3D] = {0, 1}, [PH_LMU] = {1, -1}, [PH_REVERSED] = {1, 0}};
    struct sim_matrix a = *from;
    if (!normalise(&a, convention)) {
        return PH_ERR_INVAL;
    }
    const bool parallel = is_zero(a.m[3][2]);
    const int shift = parallel ? 3 : 2, none = parallel ? 2 : 3;
    const double slope = a.m[2][2], at_0 = a.m[2][3];
    double planes[2];
    for (int i = 0; i < 2; i++) { /* where z / w is that of the near plane, of the far plane */
        planes[i] = parallel ? (at_0 - ends[convention][i]) / slope : at_0 / (ends[convention][i] + slope);
    }
    p->kind = parallel ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE;
    bool good = is_zero(a.m[0][1]) && is_zero(a.m[0][none]) && is_zero(a.m[1][0]) && is_zero(a.m[1][none]) &&
                is_zero(a.m[2][0]) && is_zero(a.m[2][1]);
    good = good && fixed(a.m[0][0], 20, &p->scale_x_q20) && fixed(a.m[1][1], 20, &p->scale_y_q20);
    good = good && fixed(parallel ? -a.m[0][shift] : a.m[0][shift], 16, &p->shift_x);
    good = good && fixed(parallel ? -a.m[1][shift] : a.m[1][shift], 16, &p->shift_y);
    good = good && fixed(planes[0], 16, &p->near_z) && fixed(planes[1], 16, &p->far_z);
    return good && p->scale_x_q20 > 0 && p->scale_y_q20 > 0 && p->far_z > p->near_z && (parallel || p->near_z > 0)
               ? 0
               : PH_ERR_INVAL;
}

void sim_matrix_print_one(FILE *file, const char *name, const struct ph_mat4 *matrix)
{
    fprintf(file, "%s\n", name);
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            char text[FX_TEXT_SIZE];
            fx_to_text(matrix->m[i][j], text);
            fprintf(file, "%s%c", text, j < 3 ? ' ' : '\n');
        }
    }
}

struct ph_mat4 sim_matrix_of_view(const struct ph_xform *view, struct sim_matrix_writing writing)
{
    struct ph_mat4 m = ph_matrix_view(view, writing.convention);
    for (int i = 0; i < 3 && writing.left_world; i++) {
        m.m[i][2] = fx_neg_sat(m.m[i][2]);
    }
    return m;
}

int sim_matrix_print(FILE *file, const struct ph_xform *view, const struct ph_projection *projection, uint16_t width,
                     uint16_t height, struct sim_matrix_writing writing)
{
    struct ph_mat4 to_clip;
    const int status = ph_matrix_projection(&to_clip, projection, writing.convention);
    if (status != 0) {
        return status;
    }
    const struct ph_mat4 to_camera = sim_matrix_of_view(view, writing);
    const struct ph_mat4 to_pixels = ph_matrix_viewport(width, height, writing.convention);
    sim_matrix_print_one(file, "view", &to_camera);
    sim_matrix_print_one(file, "projection", &to_clip);
    sim_matrix_print_one(file, "viewport", &to_pixels);
    return 0;
}
