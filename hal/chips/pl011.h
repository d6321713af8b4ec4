/*
 * pl011: what the data register of Arm's UART PL011 says of a byte that was received. The RP2040, the RP2350 and the
 * LM3S6965 have this unit. Source: PL011 Technical Reference Manual (DDI 0183), 3.3.1, UARTDR.
 */
#ifndef CHIPS_PL011_H
#define CHIPS_PL011_H

#include <stdint.h>

#define PL011_FRAMING (1U << 8) /* the stop bit was 0 */
#define PL011_PARITY  (1U << 9)
#define PL011_BREAK   (1U << 10) /* the line was 0 for longer than a byte takes */
#define PL011_OVERRUN (1U << 11) /* bytes before this one were lost; this one is whole */

/* The byte of a value that was read from UARTDR, or -1 if it is damaged. */
static inline int pl011_byte(uint32_t dr)
{
    return (dr & (PL011_FRAMING | PL011_PARITY | PL011_BREAK)) != 0 ? -1 : (int)(dr & 0xff);
}

#endif
