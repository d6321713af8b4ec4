/* The offsets that the assembly of this CPU takes, held to the structs. See offsets.inc. */
#include "offsets.inc"
#include "matvec_offsets.inc"
