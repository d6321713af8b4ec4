/*
 * status: what a function returns. 0 is done, a negative value is an error, a positive value is a count.
 *
 * Every layer uses the same numbers, which are Linux's errno values negated. hal.h, which knows nothing of this
 * folder, gives some of them names of its own; firmware/app/runner.c asserts that equal names have equal values.
 */
#ifndef PH_STATUS_H
#define PH_STATUS_H

enum ph_status {
    PH_OK = 0,
    PH_ERR_NOMEM = -12,  /* a caller's buffer is too small */
    PH_ERR_INVAL = -22,  /* an argument makes no sense */
    PH_ERR_RANGE = -34,  /* an argument does not fit the number format */
    PH_ERR_STATE = -77,  /* a call out of turn: see the order of a frame in render.h */
    PH_ERR_FORMAT = -95, /* no depth format is named */
};

#endif
