# Stellaris LM3S6965; firmware/firmware.mk explains these variables. The chip has no UF2 family.
PORT_CPU := armv7m
PORT_FLAGS := -mcpu=cortex-m3 -mthumb
PORT_SRC := hal/lm3s6965/lm3s6965.c hal/chips/cortexm/start.c hal/chips/cortexm/one_core.c
PORT_LD := hal/lm3s6965/lm3s6965.ld
PORT_STACK_EXTRA := 40 # SysTick: the frame and its handler
UF2_BASE := 0x0
EMULATE = $(B)/pinhole-emulate --machine lm3s6965evb --board $(BOARD)
EMULATE_NEEDS = $(B)/pinhole-emulate
FLASH = firmware/tools/flash_with.sh 'plug the debugger of the board (its USB) in; it must be free, and you must be allowed to use it' \
    openocd -f board/ek-lm3s6965.cfg $(if $(SERIAL),-c 'adapter serial $(SERIAL)') -c 'program {$(IMAGE).elf} verify reset exit'
