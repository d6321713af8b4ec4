/*
 * cortexm: what the ports to Cortex-M3 and M4 chips share: start, time from SysTick, faults, the end. SysTick is the
 * only interrupt. A fault writes where it happened to the log UART, turns the panel off and stops.
 */
#ifndef START_H
#define START_H

#include "hal.h"

#define REG32(address) (*(volatile uint32_t *)(address))

/* Given by the port: clocks and log UART. Runs before main, .data and .bss are ready. Returns the CPU's clock in Hz. */
uint32_t port_start(void);

/* Given by the port: stops whatever runs on the bus, so that writing works. After a fault, at any moment. */
void port_bus_stop(void);

/* The display off and asleep, whatever state the driver was in. */
void cortexm_dark(void);

uint32_t cortexm_time_us(void);
void cortexm_delay_us(uint32_t us);

#endif
