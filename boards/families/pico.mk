# A Raspberry Pi Pico, or a board with an RP2040 and at least as much flash: the linker script takes 2 MB.
PORT = rp2040
CHIP_FLASH_BYTES = 2097152
CHIP_RAM_BYTES = 270336
