@ ph_fill of kernels.h for ARMv7-M: that of ARMv6-M, which stores as much at a time as the bus takes.
#include "../armv6m/fill.S"
