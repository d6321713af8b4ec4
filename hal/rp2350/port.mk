# RP2350 with its Cortex-M33 or its Hazard3 cores: the sources that it shares with the RP2040 (hal/chips/rp2), with
# its own registers and memory, and what differs by instruction set (ISA) in a folder. firmware/firmware.mk explains these variables.
$(if $(PORT_BUS),$(error PORT_BUS=$(PORT_BUS): $(BOARD) has an RP2350, whose port has no I2C yet; that of the RP2040 has))
PORT_ISAS = arm riscv
PORT_CPU = $(if $(filter riscv,$(ISA)),rv32,armv7m)
PORT_SRC = $(if $(filter 2,$(CORES)),hal/chips/rp2/cores2.c,hal/chips/cortexm/one_core.c) \
           $(addprefix hal/chips/rp2/,start.c guard.c clocks.c facts.c rp2.c spi.c pins.c uart.c) hal/rp2350/flash.c \
           $(if $(filter riscv,$(ISA)),$(addprefix hal/rp2350/riscv/,entry.S trap.c) firmware/bare/memory.c,hal/chips/rp2/entry.S hal/rp2350/arm/vectors.S)
ifeq ($(ISA),riscv)
PORT_CROSS = riscv64-unknown-elf-
RV32 = -march=rv32imac_zicsr_zifencei_zba_zbb_zbkb -mabi=ilp32 # all that Hazard3 has and gcc 12 knows
PORT_FLAGS = $(RV32) -msmall-data-limit=0 -DCODE_TIERS -isystem firmware/bare/include
PORT_LIBS = -nostdlib "$$($(CROSS)gcc -march=rv32imac -mabi=ilp32 -print-libgcc-file-name)" # there is none for more
else
PORT_FLAGS = -mcpu=cortex-m33 -mthumb -mfloat-abi=soft -DCODE_TIERS
endif
PORT_CORES = 1 2
PORT_INFO = hal/chips/rp2/binary_info.c
PORT_TILES_BYTES = 1216 # 320x240 in bands of 16 lines
PORT_SCENE = 524288 # FLASH_SCENE of host-sim/flash/flash_scene.h
PORT_LD = hal/rp2350/rp2350.ld
PORT_AHEAD_BYTES = $(if $(filter 2,$(CORES)),53248)
PORT_STACK_EXTRA = $(if $(filter riscv,$(ISA)),160,32) # an interrupt's registers, and its handler's on RISC-V
PORT_CORE1 = $(if $(filter 2,$(CORES)),hal/chips/rp2/cores2.c:serve)
PORT_CORE1_EXTRA = $(PORT_STACK_EXTRA) + 256 # of its guard, see cores2.c
UF2_FAMILY = $(if $(filter riscv,$(ISA)),0xe48bff5a,0xe48bff59)
UF2_BASE = 0x10000000
EMULATE = CHIP=rp2350 B='$(B)' CORES='$(CORES)' BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' host-sim/emulate/emulate_rp2.sh
EMULATE_NEEDS = $(B)/rp2350-emulate
SPEED = CHIP=rp2350 ISA='$(ISA)' B='$(B)' host-sim/emulate/speed_rp2.sh '$(BOARD)'
FLASH = '$(B)/pinhole-flash' $(if $(filter %.phs,$(SCENE)),'$(SCENE)' --at-scene,'$(IMAGE).uf2') $(if $(SERIAL),--serial '$(SERIAL)')
FLASH_NEEDS = $(B)/pinhole-flash
$(B)/hal/chips/rp2/%.o $(B)/hal/rp2350/%.o: INC = -Ihal -Ihal/rp2350/$(or $(ISA),arm) -Ihal/rp2350
