@ ph_halve of kernels.h for ARMv7-M: the form of ARMv6-M.
#include "../armv6m/halve.S"
