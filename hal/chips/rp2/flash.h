/*
 * flash: the flash that the image runs from. hal/rp2040/flash.c is for the RP2040, hal/rp2350/flash.c for the RP2350.
 */
#ifndef RP2_FLASH_H
#define RP2_FLASH_H

#include <stdint.h>

/*
 * Sets up the fastest read of the flash that board_here allows and that has the margin of flash_margin.h at the clock
 * that rp2_clocks_init() sets. Call it once, before that, with interrupts off and without core 1.
 */
void rp2_flash_open(void);

struct rp2_flash_facts {
    uint8_t id[3];        /* what the flash answers to 9Fh: maker, kind, log2 of its bytes */
    uint8_t command;      /* that reads it: EBh or 6Bh on four lines, 0Bh or 03h on one */
    uint8_t divider;      /* of clk_sys */
    uint8_t delay;        /* of the sample, see flash_margin.h: RX_SAMPLE_DLY, or RXDELAY */
    uint32_t good_delays; /* bit n: with sample delay n the image's first bytes were read right */
};

/*
 * Finds out the facts, and leaves flash as it was. It takes less than 10 ms, in which it takes no interrupt and keeps
 * the other core out of flash. No write to the bus may be under way.
 */
void rp2_flash_measure(struct rp2_flash_facts *facts);

#endif
