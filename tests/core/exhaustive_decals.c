/* The long run of test_decals.c: 10,000 other scenes in every format. */
#define SCENES 10000
#define SEED   4712

#include "test_decals.c" /* NOLINT(bugprone-suspicious-include) */
