/* cpu: the RP2040's cores; hal/rp2350/arm and hal/rp2350/riscv have the RP2350's. */
#ifndef RP2040_CPU_H
#define RP2040_CPU_H

#include "chips/rp2/arm.h"

/* ARMv6-M Architecture Reference Manual B3.5 (MPU). */
#define MPU_CTRL 0xe000ed94
#define MPU_RNR  0xe000ed98
#define MPU_RBAR 0xe000ed9c
#define MPU_RASR 0xe000eda0

/* Forbids access to a region by the MPU; elsewhere access is as without one. */
static inline void guard_stack(uint32_t from, uint32_t bytes_log2)
{
    REG(MPU_RNR) = 0;
    REG(MPU_RBAR) = from;
    REG(MPU_RASR) = (bytes_log2 - 1) << 1 | 1;
    REG(MPU_CTRL) = 5;
}

typedef void *lookup_fn(const uint16_t *table, uint32_t code);
typedef void reset_usb_boot_fn(uint32_t activity_pins, uint32_t disabled_interfaces);

/* Reads a halfword from the ROM's first words. The asm hides the address: compilers expect no object so near to 0. */
static inline uintptr_t rom_word(uintptr_t address)
{
    __asm("" : "+r"(address));
    return *(const uint16_t *)address;
}

/* Calls the ROM's reset_usb_boot(), which the ROM finds by two letters (RP2040 datasheet 2.8.3). */
static inline void start_boot_loader(void)
{
    lookup_fn *const lookup = (lookup_fn *)rom_word(0x18);
    ((reset_usb_boot_fn *)lookup((const uint16_t *)rom_word(0x14), 'U' | 'B' << 8))(0, 0); /* calls rom */
}

#endif
