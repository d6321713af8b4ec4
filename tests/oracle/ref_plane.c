/* A plane in front of the camera: see ref_plane.h. */
#include "ref_plane.h"

#include "ref_random.h"

#include <math.h>
#include <stdlib.h>

void ref_plane_place(struct ref_plane *p, double distance, double side, double turn)
{
    double r[3][3], t[3];
    ref_rotation(turn, r);
    t[0] = ref_uniform(-side, side);
    t[1] = ref_uniform(-side, side);
    t[2] = -distance;
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            p->xform.r[i][k] = ref_q30(r[i][k]);
            p->r[i][k] = ldexp(p->xform.r[i][k], -30);
        }
        p->t[i] = ref_q16(t[i]) / 65536.;
    }
    p->xform.t = (struct fx_vec3){ref_q16(t[0]), ref_q16(t[1]), ref_q16(t[2])};
}

bool ref_plane_at(const struct ref_plane *p, const struct ref_lens *lens, double sx, double sy, double *u, double *v,
                  double *z)
{
    double focal = lens->height / 2. * sqrt(3), above = 0, along = 0;
    const double q[3] = {(sx - lens->width / 2.) / focal, (lens->height / 2. - sy) / focal, -1};
    for (int k = 0; k < 3; k++) {
        above += p->r[k][2] * p->t[k];
        along += p->r[k][2] * q[k];
    }
    *z = along != 0 ? above / along : 0;
    *u = 0;
    *v = 0;
    for (int k = 0; k < 3; k++) {
        double hit = *z * q[k] - p->t[k];
        *u += p->r[k][0] * hit;
        *v += p->r[k][1] * hit;
    }
    return *z > lens->near_z && *z < lens->far_z && along < 0;
}

void ref_lens_projection(const struct ref_lens *lens, struct ph_projection *out)
{
    fx_t aspect = ref_q16((double)lens->width / lens->height);
    if (ph_projection_perspective(out, FX_INT(60), aspect, ref_q16(lens->near_z), ref_q16(lens->far_z)) != 0) {
        abort();
    }
}
