# RP2350 with its Cortex-M33 cores: the sources of the RP2040, with other registers, vectors and memory.
PORT_CPU = armv7m
PORT_FLAGS = -mcpu=cortex-m33 -mthumb -mfloat-abi=soft
PORT_SRC = $(if $(filter 2,$(CORES)),hal/rp2040/cores2.c,hal/cortexm/one_core.c) \
           $(addprefix hal/rp2040/,start.c guard.c clocks.c rp2040.c spi.c pins.c uart.c entry.S) hal/rp2350/vectors.S
PORT_CORES = 1 2
PORT_ISAS = arm
PORT_INFO = hal/rp2040/binary_info.c
PORT_TILES_BYTES = 1216 # 320x240 in bands of 16 lines
PORT_SCENE = 524288 # FLASH_SCENE of host-sim/flash/flash_scene.h
PORT_LD = hal/rp2350/rp2350.ld
PORT_STACK_BYTES = 6656
PORT_AHEAD_BYTES = $(if $(filter 2,$(CORES)),53248)
PORT_RAM_BYTES := $(if $(filter 2,$(CORES)),215040,155648) # the code that runs from RAM, and what the RP2040 has here, too
PORT_STACK_EXTRA = 32 # one interrupt puts 8 words on the stack; the handlers take none
UF2_FAMILY = 0xe48bff59
UF2_BASE = 0x10000000
EMULATE = CHIP=rp2350 B='$(B)' CORES='$(CORES)' BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' hal/rp2040/emulate/emulate.sh
EMULATE_NEEDS = $(B)/rp2350-emulate
SPEED = CHIP=rp2350 B='$(B)' hal/rp2040/emulate/speed.sh '$(BOARD)'
FLASH = firmware/tools/flash_with.sh 'hold BOOTSEL while the board is plugged in' picotool load -x '$(IMAGE).uf2'
$(B)/hal/rp2040/%.o: INC = -Ihal -Ihal/rp2350
