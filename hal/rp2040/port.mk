# RP2040; firmware/firmware.mk explains these variables. CORES=2 gives the second core half of the work.
PORT_CPU = armv6m
PORT_FLAGS = -mcpu=cortex-m0plus -mthumb -DCODE_TIERS
PORT_SRC = $(if $(filter 2,$(CORES)),hal/chips/rp2/cores2.c,hal/chips/cortexm/one_core.c) \
           $(addprefix hal/chips/rp2/,start.c guard.c clocks.c facts.c rp2.c $(or $(PORT_BUS),spi).c pins.c uart.c entry.S) $(addprefix hal/rp2040/,divide.c flash.c boot2.S vectors.S) firmware/bare/armv6m/memory.S
PORT_CORES = 1 2
PORT_RAM_CODES = small
PORT_INFO = hal/chips/rp2/binary_info.c
PORT_TILES_BYTES = 1216 # 320x240 in bands of 16 lines
PORT_SCENE = 524288 # FLASH_SCENE of host-sim/flash/flash_scene.h
PORT_LD = hal/rp2040/rp2040.ld
PORT_TIERS = interrupt bus loop mesh figure scenery few seldom
# One core has no use for the shares of two, and keeps to 60 % of the chip's RAM. Two cores have no RAM for `bus`.
PORT_RAM_TIERS_cores1 = interrupt bus loop mesh scenery
PORT_RAM_TIERS_cores2 = interrupt loop mesh figure scenery few
PORT_RAM_TIERS_small = interrupt bus loop mesh figure
PORT_RAM_TIERS = $(PORT_RAM_TIERS_$(RAM_CODE))
PORT_AHEAD_BYTES = $(if $(filter 2,$(CORES)),$(if $(filter small,$(RAM_CODE)),0,53248))
PORT_STACK_EXTRA = 32 # one interrupt puts 8 words on the stack; the handlers take none
PORT_CORE1 = $(if $(filter 2,$(CORES)),hal/chips/rp2/cores2.c:serve)
PORT_CORE1_EXTRA = $(PORT_STACK_EXTRA) + 256 # of its guard, see cores2.c
PORT_FINISH = hal/rp2040/boot2_seal.sh '$(HOSTCC)' '$(CROSS)' "$$1"
UF2_FAMILY = 0xe48bff56
UF2_BASE = 0x10000000
EMULATE = B='$(B)' CORES='$(CORES)' BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' host-sim/emulate/emulate_rp2.sh
SPEED = B='$(B)' host-sim/emulate/speed_rp2.sh '$(BOARD)'
FLASH = '$(B)/pinhole-flash' $(if $(filter %.phs,$(SCENE)),'$(SCENE)' --at-scene,'$(IMAGE).uf2') $(if $(SERIAL),--serial '$(SERIAL)')
FLASH_NEEDS = $(B)/pinhole-flash
$(B)/hal/chips/rp2/%.o $(B)/hal/rp2040/%.o: INC = -Ihal -Ihal/rp2040 # its registers.h and cpu.h; an RP2350 has its own
