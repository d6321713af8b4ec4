# No chip; firmware/firmware.mk explains these variables. A chip that can be emulated and flashed has EMULATE and FLASH.
PORT_CPU := armv7m
PORT_FLAGS := -mcpu=cortex-m3 -mthumb
PORT_SRC := hal/template/template.c hal/chips/cortexm/start.c hal/chips/cortexm/one_core.c
PORT_LD := hal/template/template.ld
PORT_STACK_EXTRA := 40 # SysTick: the frame and its handler
EMULATE = echo 'make emulate: hal/template drives no chip' >&2; exit 1; \#
FLASH = echo 'make flash: hal/template drives no chip' >&2; exit 1
