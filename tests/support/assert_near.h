/* assert_near: what the tests of cameras share: Q16.16 from double and back, and what is near enough. */
#ifndef ASSERT_NEAR_H
#define ASSERT_NEAR_H

#include "geom.h"

/* Exact. */
double real(fx_t v);

/* A vector in Q16.16, rounded to nearest. */
struct fx_vec3 vec(double x, double y, double z);

/* Fails the test (cmocka), and says by how much, where got is farther than tolerance from want, or not a number. */
void assert_near(double got, double want, double tolerance);

#endif
