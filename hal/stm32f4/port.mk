# STM32F405; firmware/firmware.mk explains these variables.
PORT_CPU := armv7m
PORT_FLAGS := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
PORT_SRC := hal/stm32f4/stm32f4.c hal/chips/cortexm/start.c hal/chips/cortexm/one_core.c
PORT_LD := hal/stm32f4/stm32f4.ld
PORT_STACK_EXTRA := 40 # SysTick: the frame and its handler
UF2_FAMILY := 0x57755a57
UF2_BASE := 0x08000000
# TinyUF2, the boot loader that takes UF2 files, lies before it (BOARD_FLASH_APP_START in its ports/stm32f4/boards.h).
UF2_APP_BASE := 0x08010000
EMULATE = $(B)/pinhole-emulate --machine netduinoplus2 --board $(BOARD)
EMULATE_NEEDS = $(B)/pinhole-emulate
FLASH = firmware/tools/flash_with.sh 'start the chip in its boot loader (0483:df11): BOOT0 high while it is reset, or send B to its UART' \
    dfu-util --device 0483:df11 --alt 0 $(if $(SERIAL),--serial '$(SERIAL)') --dfuse-address '$(UF2_BASE):leave' --download '$(IMAGE).bin'
