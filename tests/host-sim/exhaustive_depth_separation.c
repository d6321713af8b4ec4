/* The long run of test_depth_separation.c: 120 other lenses, 600,000 triangles, 300,000 pairs. */
#define TRIANGLES 1000
#define PAIRS     500
#define LENSES    120
#define SEED      4711

#include "test_depth_separation.c" /* NOLINT(bugprone-suspicious-include) */
