PORT = rp2040
CHIP_FLASH_BYTES = 2097152 # of its 16 MB: what the linker script takes
CHIP_RAM_BYTES = 270336
