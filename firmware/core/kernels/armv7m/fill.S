@ ph_fill of kernels.h for ARMv7-M: the form of ARMv6-M stores as much at a time as the bus takes.
#include "../armv6m/fill.S"
