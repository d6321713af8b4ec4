/* null: a backend that compiles and does nothing. Copy it to begin a new one. Its context is not used. */
#ifndef HAL_NULL_H
#define HAL_NULL_H

#include "hal.h"

extern const struct hal_ops null_ops;

#endif
