/* Status codes: 0 done, negative is an error (Linux errno values), positive is a count. */
#ifndef PH_STATUS_H
#define PH_STATUS_H

enum ph_status {
    PH_OK = 0,
    PH_ERR_NOMEM = -12, /* a caller's buffer is too small */
    PH_ERR_INVAL = -22, /* an argument makes no sense */
    PH_ERR_RANGE = -34, /* an argument does not fit the number format */
};

#endif
