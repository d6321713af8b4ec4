/* See offsets.inc. */
#include "../armv6m/offsets.c"
