/*
 * spy_hal: a backend between the driver and the simulator that writes down what it is asked, and holds every buffer as
 * long as hal.h allows: bytes go out only when the next bus_write or bus_wait comes. A driver that reuses a buffer too
 * early shows a wrong picture.
 */
#ifndef SPY_HAL_H
#define SPY_HAL_H

#include "sim.h"

enum spy_event_kind { SPY_CLOCK, SPY_COMMAND, SPY_DATA, SPY_RESET, SPY_BACKLIGHT, SPY_DELAY };

struct spy_event {
    enum spy_event_kind kind;
    uint32_t value; /* Hz, first byte, number of bytes, level, us */
};

#define SPY_EVENTS_MAX 8192

struct spy {
    struct hal sim;
    enum hal_dc dc;
    const uint8_t *held;
    size_t held_bytes;
    uint32_t count;
    struct spy_event events[SPY_EVENTS_MAX];
};

extern const struct hal_ops spy_ops;

/* Number of the first event of this kind and value at or after `from`; the test fails if there is none. */
uint32_t spy_find(const struct spy *spy, uint32_t from, enum spy_event_kind kind, uint32_t value);

uint32_t spy_count(const struct spy *spy, enum spy_event_kind kind, uint32_t value);

#endif
