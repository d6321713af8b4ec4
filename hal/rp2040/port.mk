# RP2040; firmware/firmware.mk explains these variables. CORES=2 gives the second core half of the work.
PORT_CPU = armv6m
PORT_FLAGS = -mcpu=cortex-m0plus -mthumb
PORT_SRC = $(if $(filter 2,$(CORES)),hal/rp2040/cores2.c,hal/cortexm/one_core.c) \
           $(addprefix hal/rp2040/,start.c guard.c clocks.c rp2040.c spi.c pins.c uart.c divide.c flash.c facts.c boot2.S vectors.S entry.S) firmware/bare/armv6m/memory.S
PORT_CORES = 1 2
PORT_RAM_CODES = small
PORT_INFO = hal/rp2040/binary_info.c
PORT_TILES_BYTES = 1216 # 320x240 in bands of 16 lines
PORT_SCENE = 524288 # FLASH_SCENE of host-sim/flash/flash_scene.h
PORT_LD = hal/rp2040/rp2040.ld
PORT_AHEAD_BYTES = $(if $(filter 2,$(CORES)),$(if $(filter small,$(RAM_CODE)),0,53248))
PORT_STACK_EXTRA = 32 # one interrupt puts 8 words on the stack; the handlers take none
PORT_FINISH = hal/rp2040/boot2_seal.sh '$(HOSTCC)' '$(CROSS)' "$$1"
UF2_FAMILY = 0xe48bff56
UF2_BASE = 0x10000000
EMULATE = B='$(B)' CORES='$(CORES)' BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' host-sim/emulate/emulate_rp2.sh
SPEED = B='$(B)' host-sim/emulate/speed_rp2.sh '$(BOARD)'
FLASH = '$(B)/pinhole-flash' $(if $(filter %.phs,$(SCENE)),'$(SCENE)' --at-scene,'$(IMAGE).uf2') $(if $(SERIAL),--serial '$(SERIAL)')
FLASH_NEEDS = $(B)/pinhole-flash
$(B)/hal/rp2040/%.o: INC = -Ihal -Ihal/rp2040 # registers.h: the RP2350, which has these sources, too, has its own
