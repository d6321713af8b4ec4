/* MESHOPTIMIZER_VERSION: 180 is 0.18; 0 where the library is not here. For tests of what its versions leave. */
#ifndef MESHOPT_VERSION_H
#define MESHOPT_VERSION_H

#if __has_include(<meshoptimizer.h>)
/* By a macro, because tests/run.sh leaves out tests that include a library which is not here. */
#define MESHOPT_HEADER <meshoptimizer.h>
#include MESHOPT_HEADER
#else
#define MESHOPTIMIZER_VERSION 0
#endif

#endif
