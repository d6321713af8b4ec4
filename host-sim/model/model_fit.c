/* See model_fit.h. Goes through all points twice: for their box, and for what lies around its middle. */
#include "model_fit.h"

#include "model_rig_range.h"

#include <math.h>

#define PI 3.14159265358979323846

struct extent {
    double low[3], high[3], centre[3];
    double most; /* the square of the largest distance from the centre */
    bool has_centre;
    struct {
        double direction[2], most, point[2];
    } outline[MODEL_OUTLINE];
};

/* What lies around the middle. */
static void extend_outline(struct extent *e, const double point[3])
{
    const double x = point[0] - e->centre[0], y = point[1] - e->centre[1], z = point[2] - e->centre[2];
    const double away = sqrt(x * x + z * z);
    e->most = fmax(e->most, x * x + y * y + z * z);
    for (int i = 0; i < MODEL_OUTLINE; i++) {
        const double reach = e->outline[i].direction[0] * away + e->outline[i].direction[1] * y;
        if (reach > e->outline[i].most) {
            e->outline[i].most = reach;
            e->outline[i].point[0] = away;
            e->outline[i].point[1] = y;
        }
    }
}

static void extend(void *context, const double point[3])
{
    struct extent *e = context;
    if (e->has_centre) {
        extend_outline(e, point);
        return;
    }
    for (int axis = 0; axis < 3; axis++) {
        const double p = point[axis];
        e->low[axis] = p < e->low[axis] || !isfinite(p) ? p : e->low[axis];
        e->high[axis] = p > e->high[axis] || !isfinite(p) ? p : e->high[axis];
    }
}

/* Extends it by all points: those that move are wherever they get. False: no memory. */
static bool extend_all(struct model_rig *rig, const struct model_places *places, struct extent *e)
{
    double point[3];
    for (size_t k = 0; k < places->count; k++) {
        const bool moves = model_rig_mover(rig, places->list[k].node) != MODEL_NONE;
        for (unsigned i = 0; !moves && i < places->list[k].mesh->vertex_count; i++) {
            model_places_point(&places->list[k], i, point);
            extend(e, point);
        }
    }
    return rig == NULL || model_rig_visit(rig, places, extend, e);
}

bool model_fit_find(struct model_shared *shared, const struct model_places *places, struct model_fit *fit,
                    struct model_outline *outline)
{
    struct extent e = {.low = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    bool done = extend_all(shared->rig, places, &e), is_finite = true;
    for (int axis = 0; axis < 3; axis++) {
        e.centre[axis] = fit->centre[axis] = (e.low[axis] + e.high[axis]) / 2;
        is_finite = is_finite && isfinite(e.centre[axis]);
    }
    for (int i = 0; i < MODEL_OUTLINE; i++) {
        const double angle = PI * i / (MODEL_OUTLINE - 1) - PI / 2;
        e.outline[i].direction[0] = cos(angle);
        e.outline[i].direction[1] = sin(angle);
        e.outline[i].most = -HUGE_VAL;
    }
    e.has_centre = true;
    done = done && (!is_finite || extend_all(shared->rig, places, &e));
    fit->scale = 1 / sqrt(e.most);
    for (int i = 0; i < 2 * MODEL_OUTLINE; i++) {
        outline->points[i / 2][i % 2] = e.outline[i / 2].point[i % 2] * fit->scale;
    }
    if (!done) {
        return model_shared_failed(shared, "needs too much memory");
    }
    return (is_finite && isfinite(e.most) && isfinite(fit->scale)) ||
           model_shared_failed(shared, "has coordinates that are no numbers, or all points in one place");
}

bool model_fit_outline(struct model_shared *shared, const struct model_outline *outline)
{
    struct model_motion *to = shared->model.motion;
    if (to == NULL) {
        return true;
    }
    struct fx_vec3 *points = demo_alloc(&shared->arena, MODEL_OUTLINE * sizeof *points);
    for (int i = 0; points != NULL && i < MODEL_OUTLINE; i++) {
        points[i] = (struct fx_vec3){(fx_t)lround(outline->points[i][0] * FX_ONE),
                                     (fx_t)lround(outline->points[i][1] * FX_ONE), 0};
    }
    to->animation.outline = points;
    to->animation.outline_count = MODEL_OUTLINE;
    return points != NULL || model_shared_failed(shared, "needs too much memory");
}
