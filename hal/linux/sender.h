/*
 * sender: a thread that sends what bus_write has collected. Private to hal/linux.
 *
 * Written bytes are copied into a ring. Bytes in a row with the same D/C are a run. The thread sends a run in messages
 * that are as long as spidev takes; the rest of a run goes out when the next run begins, or when linux_sender_flush or
 * linux_sender_idle is called. So lines, bands and windows share messages, whatever pieces they come in.
 */
#ifndef HAL_LINUX_SENDER_H
#define HAL_LINUX_SENDER_H

#include "linux_types.h"

/* Starts the thread that sends; the device must be open. */
int linux_sender_start(struct linux_hal *h);

/* Sends the rest, then ends the thread. */
void linux_sender_stop(struct linux_hal *h);

/* Copies the bytes; waits only while the ring is full. Returns the error of an earlier write, once. */
int linux_sender_write(struct linux_hal *h, enum hal_dc dc, const uint8_t *bytes, size_t n);

/* Lets the thread send what is there, and does not wait. */
void linux_sender_flush(struct linux_hal *h);

/* Waits until the last bit is out. The wait ends, for the kernel's SPI drivers time out. */
void linux_sender_wait(struct linux_hal *h);

/* Waits as linux_sender_wait does, and returns the error of an earlier write, once. */
int linux_sender_idle(struct linux_hal *h);

/* Puts D/C at this level. Only while the bus is idle. */
int linux_sender_dc(struct linux_hal *h, enum hal_dc dc);

/* The mean time of a short write (0: none yet) after one more: the last ones count most, and one late write counts
 * little. */
uint32_t linux_write_mean(uint32_t mean_ns, uint64_t took_ns);

#endif
