# A Raspberry Pi Pico 2, or a board with an RP2350 and at least as much flash: the linker script takes 4 MB.
PORT = rp2350
CHIP_FLASH_BYTES = 4194304
CHIP_RAM_BYTES = 532480
