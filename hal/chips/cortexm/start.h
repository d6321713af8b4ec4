/*
 * cortexm: the part that ports to Cortex-M3 and M4 chips share: start, time from SysTick, faults, the end. SysTick is
 * the only interrupt. A fault writes to the log UART where it happened, turns the panel off and stops. sections.ld is
 * the common part of the linker scripts.
 */
#ifndef CORTEXM_START_H
#define CORTEXM_START_H

#include "hal.h"

#define REG32(address) (*(volatile uint32_t *)(address))

/* Given by the port: starts clocks and log UART; .data and .bss are ready. Returns the CPU's clock in Hz. */
uint32_t port_start(void);

/* Given by the port: stops whatever runs on the bus, so that bus_write works. A fault may call it at any moment. */
void port_bus_stop(void);

/* Turns the display off and puts it to sleep, whatever state its driver was in. */
void cortexm_dark(void);

/* Operations of struct hal_ops; they ignore their context. */
uint32_t cortexm_time_us(void *context);
void cortexm_delay_us(void *context, uint32_t us);

#endif
