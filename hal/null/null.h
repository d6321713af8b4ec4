/* null: a backend that drives nothing; it does not use its context. Copy it to begin a backend for a computer. */
#ifndef HAL_NULL_H
#define HAL_NULL_H

#include "hal.h"

extern const struct hal_ops null_ops;

#endif
