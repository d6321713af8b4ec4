/* sim_types: what a simulated kit (sim.h) counts, complains of and can be made to do wrong. */
#ifndef SIM_TYPES_H
#define SIM_TYPES_H

#include <stdint.h>

struct sim_counters {
    uint64_t bytes;         /* on the wire since power-on */
    uint64_t command_bytes; /* of them with D/C low */
    uint64_t bus_ns;        /* time they took */
    uint64_t pixels;        /* written into the controller's memory */
    uint32_t writes;        /* calls of bus_write */
    uint32_t clock_hz;      /* now */
};

enum sim_complaint_kind {
    SIM_UNKNOWN_COMMAND,   /* the controller has not, or the model does not know */
    SIM_BAD_PARAMETER,     /* a bit or value that the register has not (sim_table.h), or a register that is locked */
    SIM_PARAMETER_COUNT,   /* too few or too many parameters */
    SIM_EARLY_COMMAND,     /* sent before the wait that the datasheet wants after reset or sleep */
    SIM_SHORT_RESET,       /* reset pulse too short */
    SIM_PIXELS_ASLEEP,     /* pixels before sleep-out (or in sleep) */
    SIM_WINDOW_OUTSIDE,    /* a window outside of the memory, or its end before its start */
    SIM_TOO_MANY_PIXELS,   /* more pixels than the window has */
    SIM_PIXELS_NOWHERE,    /* data without a command that takes it */
    SIM_SPLIT_PIXEL,       /* a command in the middle of a pixel */
    SIM_DC_MOVED,          /* D/C changed inside of a byte */
    SIM_OVER_CLOCK,        /* clock above the datasheet's write limit (a note only, if board->over_limit) */
    SIM_ON_WITHOUT_FRAME,  /* display on before a complete frame was written */
    SIM_LIT_WITHOUT_FRAME, /* backlight on before a complete frame was written */
    SIM_WRONG_MODE,        /* the controller does not take this SPI mode */
    SIM_SELECT_TIME,       /* SCS rose too late before the clock's first edge, or fell too early after its last */
    SIM_CUT_MESSAGE,       /* SCS fell before a message's end */
    SIM_VCOM_STILL,        /* VCOM was not toggled for more than a second */
    SIM_COMPLAINT_KINDS
};

#define SIM_PARAMETERS_MAX 34 /* of a command */

#define SIM_COMPLAINTS_KEPT 32

enum sim_fault {
    SIM_FAULT_NONE,
    SIM_FAULT_OPEN,        /* open fails with HAL_EACCES */
    SIM_FAULT_WRITE,       /* the n-th bus_write from now (1 = next) fails with HAL_EIO, nothing is sent */
    SIM_FAULT_SHORT_WRITE, /* ... fails after half of its bytes are out */
    SIM_FAULT_CLOCK,       /* bus_clock fails with HAL_EINVAL */
    SIM_FAULT_DC_EARLY, /* D/C changes half-way in the last byte of the n-th bus_write, as a backend does that does not
                           wait */
    SIM_FAULT_DELAY,    /* delay_us does not wait */
    SIM_FAULT_STUCK,    /* bus_wait fails with HAL_ETIMEDOUT */
};

#endif
