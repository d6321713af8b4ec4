/* See depth_plot_curves.h. */
#include "depth_plot_curves.h"

#include "complain.h"
#include "depth_budget_terms.h"

#include <string.h>

#define CURVE 400 /* points of a curve, less one */

/* The third rows of a camera's real matrices, their elements in Q16.16: GL's depth from -1 to 1, and the depth from 0
 * to 1 of course 4600. */
struct curve {
    double n, f, gl[2], d3d[2];
};

static int curve_of(struct curve *curve, fx_t near_z, fx_t far_z)
{
    struct ph_projection projection = {.kind = PH_PERSPECTIVE};
    struct ph_mat4 gl, d3d;
    if (ph_projection_perspective(&projection, FX_INT(60), FX_ONE, near_z, far_z) != 0 ||
        ph_matrix_projection(&gl, &projection, PH_GL) != 0 || ph_matrix_projection(&d3d, &projection, PH_D3D) != 0) {
        return complain_usage("--near, --far: this camera's matrix does not fit Q16.16; move them apart");
    }
    *curve = (struct curve){depth_metres(near_z),
                            depth_metres(far_z),
                            {depth_metres(gl.m[2][2]), depth_metres(gl.m[2][3])},
                            {depth_metres(d3d.m[2][2]), depth_metres(d3d.m[2][3])}};
    return 0;
}

/* A point of the curves: at i = 0 on the far plane, at CURVE on the near one. */
static double curve_z(const struct curve *c, int i)
{
    return -c->f + (c->f - c->n) * i / CURVE;
}

static double gl_depth(const struct curve *c, double z)
{
    return (c->gl[0] * z + c->gl[1]) / -z;
}

static double d3d_depth(const struct curve *c, double z)
{
    return (c->d3d[0] * -z + c->d3d[1]) / -z;
}

/* Writes the curves as data block $c<tag>: z and both depths. */
static int put_curve(FILE *script, int tag, fx_t near_z, fx_t far_z)
{
    struct curve c;
    const int status = curve_of(&c, near_z, far_z);
    if (status != 0) {
        return status;
    }
    fprintf(script, "$c%d << EOD\n", tag);
    for (int i = 0; i <= CURVE; i++) {
        const double z = curve_z(&c, i);
        fprintf(script, "%.6f %.6f %.6f\n", z, gl_depth(&c, z), d3d_depth(&c, z));
    }
    fputs("EOD\n", script);
    return 0;
}

/* Half of all depth values lie between the near plane and this distance. */
static double half_of(double n, double f)
{
    return 2 * f * n / (f + n);
}

static void put_half(FILE *script, double half, const char *colour)
{
    fprintf(script, "set arrow from %g,-1.05 to %g,0 nohead dt 3 lw 1.5 lc '%s'\n", -half, -half, colour);
}

/* Writes one curve for each near plane. */
static int write_curves(FILE *script, const char *name, const fx_t nears[], int count, fx_t far_z)
{
    static const char *const colours[DEPTH_NEAR_MAX] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7"};
    int status = 0;
    fprintf(script,
            "set xlabel 'z [m]: the camera is at 0 and looks along -z'\nset ylabel '%s'\nset xrange [%g:0]\n"
            "set yrange [-1.05:1.05]\nset ytics 0.5\nset key bottom left Left reverse width 2 height 0.5\n",
            name, -depth_metres(far_z));
    for (int i = 0; i < count && status == 0; i++) {
        put_half(script, half_of(depth_metres(nears[i]), depth_metres(far_z)), colours[i]);
        status = put_curve(script, i, nears[i], far_z);
    }
    fputs("plot 0 lc '#888888' notitle", script);
    for (int i = 0; i < count; i++) {
        fprintf(script, ", $c%d with lines lw 2.5 dt %d lc '%s' title 'n = %.4g m, f = %.4g m: half before %.2f m'", i,
                i + 1, colours[i], depth_metres(nears[i]), depth_metres(far_z),
                half_of(depth_metres(nears[i]), depth_metres(far_z)));
    }
    for (int i = 0; i < count; i++) {
        fprintf(script, ", $c%d using 1:3 with lines lw 1.2 dt %d lc '%s' title 'the same from 0 to 1 (course 4600)'",
                i, i + 1, colours[i]);
    }
    fputc('\n', script);
    return status;
}

/* The planes of a plot: those that were asked for, or the document's. */
struct planes {
    fx_t nears[DEPTH_NEAR_MAX], far_z;
    int count;
};

static struct planes planes_of(const struct depth_lab *lab, const struct planes *document)
{
    struct planes p = *document;
    p.far_z = lab->far_set ? lab->far_z : p.far_z;
    if (lab->near_set) {
        p.count = (int)lab->near_count;
        memcpy(p.nears, lab->nears, sizeof p.nears);
    }
    while (!lab->near_set && p.count > 1 && p.nears[p.count - 1] >= p.far_z) { /* nothing lies behind it */
        p.count--;
    }
    return p;
}

/* The first near plane is the one that stays where --far leaves no room for the others. */
static struct planes ndc_planes(const struct depth_lab *lab)
{
    return planes_of(lab, &(struct planes){{FX_HALF, FX_ONE}, FX_INT(10), 2});
}

static struct planes g_planes(const struct depth_lab *lab)
{
    return planes_of(lab, &(struct planes){{FX_ONE}, FX_INT(3), 1});
}

int depth_plot_ndc(const struct depth_lab *lab, FILE *script)
{
    const struct planes p = ndc_planes(lab);
    fputs(
        "set title 'z_{ndc}(z_c): -1 (thin: 0) at the near plane, 1 at the far plane; half of all values lie right of "
        "the dotted line'\n",
        script);
    return write_curves(script, "z_{ndc}", p.nears, p.count, p.far_z);
}

int depth_plot_g(const struct depth_lab *lab, FILE *script)
{
    const struct planes p = g_planes(lab);
    fputs("set title 'g(z) = (f + n) / (f - n) + 2 n f / (f - n) / z, half of it before the dotted line'\n", script);
    return write_curves(script, "g(z)", p.nears, p.count, p.far_z);
}

/* The curves as CSV, at the points of the picture or those of --at. */
static int put_rows(const struct depth_lab *lab, const struct planes *p)
{
    fputs("near_m,far_m,z_m,z_ndc,z_0_to_1\n", lab->rows);
    for (int k = 0; k < p->count; k++) {
        struct curve c;
        const int status = curve_of(&c, p->nears[k], p->far_z);
        if (status != 0) {
            return status;
        }
        const int last = lab->at_count > 0 ? (int)lab->at_count - 1 : CURVE;
        for (int i = 0; i <= last; i++) {
            const double z = lab->at_count > 0 ? -depth_metres(lab->at[i]) : curve_z(&c, i);
            fprintf(lab->rows, "%.9g,%.9g,%.9g,%.9g,%.9g\n", c.n, c.f, z, gl_depth(&c, z), d3d_depth(&c, z));
        }
    }
    return 0;
}

int depth_plot_ndc_rows(const struct depth_lab *lab)
{
    const struct planes p = ndc_planes(lab);
    return put_rows(lab, &p);
}

int depth_plot_g_rows(const struct depth_lab *lab)
{
    const struct planes p = g_planes(lab);
    return put_rows(lab, &p);
}
