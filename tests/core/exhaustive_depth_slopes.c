/* The long run of test_depth_slopes.c: 40,000 triangles in every format and shading. */
#define TRIANGLES 40000

#include "test_depth_slopes.c" /* NOLINT(bugprone-suspicious-include) */
