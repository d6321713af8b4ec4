/* See sim_frustum.h. */
#include "sim_frustum.h"

#include "camera.h"
#include "sim_fraction.h"

#include <math.h>

/* The height that fills the picture at a distance of `scale`, in the Q20 of the scales. */
#define HEIGHT_2 (2 << 20)

/* The field of view that a height fills at a distance. */
static void put_fov(FILE *file, const char *name, fx_t height, fx_t distance)
{
    const long double half = atan2l(height, 2 * (long double)distance);
    sim_decimal_print(file, name, 2 * half * 180 / acosl(-1), ph_fov_of(height, distance));
}

int sim_frustum_print(FILE *file, const struct ph_projection *p, fx_t distance, fx_t height)
{
    if (p->kind == PH_FISHEYE) {
        return PH_ERR_INVAL;
    }
    const bool parallel = p->kind == PH_ORTHOGRAPHIC;
    const struct sim_fraction x = sim_fraction_of(p->scale_x_q20, 20), y = sim_fraction_of(p->scale_y_q20, 20);
    const struct sim_fraction aspect = sim_fraction_divide(y, x), z = sim_fraction_of(distance, 16),
                              two = sim_fraction_of(2, 0);
    const struct sim_fraction whole = parallel ? two : sim_fraction_times(two, z);
    fx_t size[2];
    ph_projection_size_at(p, distance, &size[0], &size[1]);
    if (!parallel) {
        put_fov(file, "fov.x", HEIGHT_2, p->scale_x_q20);
        put_fov(file, "fov.y", HEIGHT_2, p->scale_y_q20);
    }
    sim_fraction_print(file, "aspect", aspect, sim_fraction_code(aspect));
    sim_fraction_print(file, "size.x", sim_fraction_divide(whole, x), size[0]);
    sim_fraction_print(file, "size.y", sim_fraction_divide(whole, y), size[1]);
    if (!parallel && height > 0) {
        const struct sim_fraction half = sim_fraction_divide(sim_fraction_of(height, 16), two);
        put_fov(file, "fill.fov", height, distance);
        sim_fraction_print(file, "fill.distance", sim_fraction_times(half, y),
                           ph_distance_of(height, ph_fov_of(HEIGHT_2, p->scale_y_q20)));
    }
    return 0;
}
