/* See model_camera.h. */
#include "model_camera.h"

#include "model_places.h"

#include <math.h>

#define EYE_MAX  10000.0 /* in radii of the model: keeps all coordinates well inside Q16.16 */
#define CLEAR    1.001   /* a little more than the sphere that holds the model */
#define NEAR_MIN (1 / 1024.0)

static void turn(double to[3], double place[3][4], const float v[3])
{
    for (int row = 0; row < 3; row++) {
        to[row] = place[row][0] * (double)v[0] + place[row][1] * (double)v[1] + place[row][2] * (double)v[2];
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* to = a x b with length one; false: they have no direction between them. */
static bool across(double to[3], const double a[3], const double b[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[i] = a[j] * b[k] - a[k] * b[j];
    }
    const double length = sqrt(dot(to, to));
    for (int i = 0; i < 3; i++) {
        to[i] /= length;
    }
    return length > 1e-9 * sqrt(dot(a, a) * dot(b, b)) && isfinite(length);
}

/* Reads the transform from world to view, with right, up and backwards as rows. False: the camera has no direction, or
 * is too far away. */
static bool read_view(const struct model_camera *from, double place[3][4], const struct model_fit *fit,
                      struct ph_xform *view)
{
    double forward[3], up[3], eye[3], axes[3][3];
    turn(forward, place, from->forward);
    turn(up, place, from->up);
    turn(eye, place, from->position);
    const double size = sqrt(dot(forward, forward));
    for (int i = 0; i < 3; i++) {
        eye[i] = (eye[i] + place[i][3] - fit->centre[i]) * fit->scale;
        axes[2][i] = -forward[i] / size;
    }
    const bool is_sound = across(axes[0], forward, up) && across(axes[1], axes[2], axes[0]);
    if (!is_sound || !(sqrt(dot(eye, eye)) < EYE_MAX)) {
        return false;
    }
    fx_t *const t[3] = {&view->t.x, &view->t.y, &view->t.z};
    for (int row = 0; row < 3; row++) {
        for (int i = 0; i < 3; i++) {
            view->r[row][i] = (int32_t)lround(axes[row][i] * (1 << 30));
        }
        *t[row] = (fx_t)lround(-dot(axes[row], eye) * FX_ONE);
    }
    return true;
}

/* Converts to Q12.20; 0 where it does not fit. */
static int32_t q20(double value)
{
    return value > 0 && value < 2047 ? (int32_t)lround(value * (1 << 20)) : 0;
}

/* Reads the scales of the picture, and puts near and far plane as close to the model as possible. */
static bool read_lens(const struct model_camera *from, const struct model_fit *fit, double centre,
                      struct ph_projection *lens)
{
    const bool is_ortho = from->half_width > 0;
    const double across_x = is_ortho ? 1 / ((double)from->half_width * fit->scale) : 1 / tan((double)from->fov_x / 2);
    const double aspect = from->aspect > 0 ? (double)from->aspect : 1; /* readers take 1 where there is none */
    const double file_near = (double)from->near_z * fit->scale, file_far = (double)from->far_z * fit->scale;
    const double near_z = fmax(fmax(file_near, centre - CLEAR), NEAR_MIN);
    const double far_z = fmin(file_far > 0 ? file_far : HUGE_VAL, centre + CLEAR);
    lens->kind = is_ortho ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE;
    lens->scale_x_q20 = from->aspect > 0 ? q20(across_x) : 0;
    lens->scale_y_q20 = q20(across_x * aspect);
    lens->near_z = (fx_t)lround(fmin(near_z, 2 * EYE_MAX) * FX_ONE);
    lens->far_z = (fx_t)lround(far_z * FX_ONE);
    return lens->scale_y_q20 > 0 && (lens->scale_x_q20 > 0 || !(from->aspect > 0)) && lens->far_z > lens->near_z;
}

void model_camera_read(struct model_shared *shared, const struct model_scene *scene, const struct model_places *places,
                       const struct model_fit *fit)
{
    const struct model_camera *from = &scene->camera;
    struct model *model = &shared->model;
    if (scene->camera_count == 0) {
        return;
    }
    if (scene->camera_count > 1) {
        model_shared_note(shared, "of %u cameras the first is used", scene->camera_count);
    }
    if (from->node == MODEL_NONE) {
        model_shared_note(shared, "camera %.100s stands in no node and is ignored", from->name);
        return;
    }
    model->camera = (struct demo_eye){.lens = {.kind = PH_PERSPECTIVE}};
    model->has_camera = read_view(from, places->nodes[from->node], fit, &model->camera.view) &&
                        read_lens(from, fit, -model->camera.view.t.z / (double)FX_ONE, &model->camera.lens);
    if (!model->has_camera) {
        model_shared_note(shared, "camera %.100s does not see the model, and is ignored", from->name);
    }
}
