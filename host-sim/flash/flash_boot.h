/*
 * flash_boot: an RP2040 or RP2350 in its USB boot loader (BOOTSEL), over the PICOBOOT interface: commands of 32 bytes
 * and their data on two bulk endpoints. A command that the board refuses is repeated once after a reset of the
 * interface, which clears what another program or a disturbance left behind.
 *
 * Results are 0 or more, or a negative status. Nothing waits for longer than FLASH_WAIT_MS.
 *
 * Sources: RP2040 datasheet, section 2.8.5, RP2350 datasheet, section 5.6 (USB PICOBOOT interface).
 */
#ifndef FLASH_BOOT_H
#define FLASH_BOOT_H

#include "hal.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FLASH_WAIT_MS 3000 /* a sector is erased within 400 ms by all flash chips of RP2040 boards */

/* Status values beside those of hal.h: HAL_ENODEV unplugged, HAL_ETIMEDOUT no answer, HAL_EIO any other error on the
 * wire. */
enum flash_status {
    FLASH_STOPPED = -4,  /* EINTR: the user stopped it */
    FLASH_STALL = -32,   /* EPIPE: the board refuses */
    FLASH_DIFFERS = -84, /* EILSEQ: other bytes were read back, or the flash is too small */
};

/* The USB side. */
struct flash_link_ops {
    int (*out)(void *context, const void *bytes, size_t n); /* all n bytes */
    int (*in)(void *context, void *bytes, size_t n);        /* exactly n; 0: an empty packet */
    int (*status)(void *context, uint8_t answer[16]);       /* GET_COMMAND_STATUS */
    int (*reset)(void *context);                            /* INTERFACE_RESET, and no endpoint is halted any more */
};

struct flash_boot {
    const struct flash_link_ops *ops;
    void *context;
    bool is_rp2350; /* it knows another command for a reboot */
    uint32_t token;
    uint32_t refusal; /* after FLASH_STALL: why, see flash_boot_refusal */
};

/* Takes the board from its own disk drive and makes the flash ready for commands. */
int flash_boot_begin(struct flash_boot *boot);

/* Addresses are those of the chip. Erase one FLASH_SECTOR; write n bytes (n and address are multiples of FLASH_PAGE);
 * read n bytes. */
int flash_boot_erase(struct flash_boot *boot, uint32_t address);
int flash_boot_write(struct flash_boot *boot, uint32_t address, const uint8_t *bytes, uint32_t n);
int flash_boot_read(struct flash_boot *boot, uint32_t address, uint8_t *bytes, uint32_t n);

/* Starts the program in the flash; the board leaves the bus. */
int flash_boot_reboot(struct flash_boot *boot);

/* Gives the board back to its drive; it stays in its boot loader. */
void flash_boot_end(struct flash_boot *boot);

#define FLASH_REFUSED_ADDRESS 4

/* Returns the datasheet's name for the refusal. */
const char *flash_boot_refusal(const struct flash_boot *boot);

#endif
