#include "model_camera.h"

#include "model_places.h"

#include <assimp/camera.h>

#include <math.h>
#include <string.h>

#define EYE_MAX  10000.0 /* in radii of the model: keeps all coordinates well inside Q16.16 */
#define CLEAR    1.001   /* a little more than the sphere that holds the model */
#define NEAR_MIN (1 / 1024.0)

/* Finds the node of the camera and its place in the world. */
static bool find_node(const struct aiNode *node, const char *name, double parent[3][4], double place[3][4])
{
    double here[3][4];
    model_places_multiply(here, parent, &node->mTransformation);
    if (strcmp(node->mName.data, name) == 0) {
        memcpy(place, here, sizeof here);
        return true;
    }
    for (unsigned i = 0; i < node->mNumChildren; i++) {
        if (find_node(node->mChildren[i], name, here, place)) {
            return true;
        }
    }
    return false;
}

static void turn(double to[3], double place[3][4], const struct aiVector3D *v)
{
    for (int row = 0; row < 3; row++) {
        to[row] = place[row][0] * v->x + place[row][1] * v->y + place[row][2] * v->z;
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

/* World to view, with right, up and backwards as rows. False: the camera has no direction, or is too far away. */
static bool read_view(const struct aiCamera *from, double place[3][4], const struct model_fit *fit,
                      struct ph_xform *view)
{
    double forward[3], up[3], eye[3], axes[3][3];
    turn(forward, place, &from->mLookAt);
    turn(up, place, &from->mUp);
    turn(eye, place, &from->mPosition);
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

/* 0 where it does not fit. */
static int32_t q20(double value)
{
    return value > 0 && value < 2047 ? (int32_t)lround(value * (1 << 20)) : 0;
}

/* Reads the scales of the picture, and puts near and far plane as close to the model as possible. */
static bool read_lens(const struct aiCamera *from, const struct model_fit *fit, double centre,
                      struct ph_projection *lens)
{
    const bool is_ortho = from->mOrthographicWidth > 0;
    const double across_x =
        is_ortho ? 1 / (from->mOrthographicWidth * fit->scale) : 1 / tan((double)from->mHorizontalFOV / 2);
    const double aspect = from->mAspect > 0 ? (double)from->mAspect : 1; /* assimp takes 1 where there is none */
    const double file_near = from->mClipPlaneNear * fit->scale, file_far = from->mClipPlaneFar * fit->scale;
    const double near_z = fmax(fmax(file_near, centre - CLEAR), NEAR_MIN);
    const double far_z = fmin(file_far > 0 ? file_far : HUGE_VAL, centre + CLEAR);
    lens->kind = is_ortho ? PH_ORTHOGRAPHIC : PH_PERSPECTIVE;
    lens->scale_x_q20 = from->mAspect > 0 ? q20(across_x) : 0;
    lens->scale_y_q20 = q20(across_x * aspect);
    lens->near_z = (fx_t)lround(fmin(near_z, 2 * EYE_MAX) * FX_ONE);
    lens->far_z = (fx_t)lround(far_z * FX_ONE);
    return lens->scale_y_q20 > 0 && (lens->scale_x_q20 > 0 || !(from->mAspect > 0)) && lens->far_z > lens->near_z;
}

void model_camera_read(struct model_shared *shared, const struct aiScene *scene, const struct model_fit *fit)
{
    double world[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}, place[3][4];
    struct model *model = &shared->model;
    if (scene->mNumCameras == 0) {
        return;
    }
    const struct aiCamera *from = scene->mCameras[0];
    if (scene->mNumCameras > 1) {
        model_shared_note(shared, "of %u cameras the first is used", scene->mNumCameras);
    }
    if (!find_node(scene->mRootNode, from->mName.data, world, place)) {
        model_shared_note(shared, "camera %.100s stands in no node and is ignored", from->mName.data);
        return;
    }
    model->camera = (struct demo_eye){.lens = {.kind = PH_PERSPECTIVE}};
    model->has_camera = read_view(from, place, fit, &model->camera.view) &&
                        read_lens(from, fit, -model->camera.view.t.z / (double)FX_ONE, &model->camera.lens);
    if (!model->has_camera) {
        model_shared_note(shared, "camera %.100s does not see the model, and is ignored", from->mName.data);
    }
}
