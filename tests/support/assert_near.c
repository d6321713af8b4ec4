/* See assert_near.h. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "assert_near.h"

#include "ref_random.h"

#include <math.h>

double real(fx_t v)
{
    return v / 65536.;
}

struct fx_vec3 vec(double x, double y, double z)
{
    return (struct fx_vec3){ref_q16(x), ref_q16(y), ref_q16(z)};
}

void assert_near(double got, double want, double tolerance)
{
    if (!(fabs(got - want) <= tolerance)) {
        fail_msg("got %.9g, want %.9g, off by %.3g, allowed %.3g", got, want, fabs(got - want), tolerance);
    }
}
