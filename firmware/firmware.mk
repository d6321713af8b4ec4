# Images for microcontroller kits. Included by the Makefile.
#
#   make firmware BOARD=pico-display              build/firmware/pico-display-demos.elf .bin .uf2 .map, and what they take
#   make firmware BOARD=lm3s6965evb APP=depth     another program: firmware/app/images/depth.c; or a file, APP=mine.c
#   make firmware BOARD=pico-display SCENE=my.glb  a model first, through pinhole-asset: build/firmware/pico-display-my.elf
#                                                 SCENE_TRIANGLES=N|all|fit, SCENE_TEXTURE=N, SCENE_FLAGS=--turntable
#   make size BOARD=pico-display                  the image's size by module
#   make flash BOARD=pico-display                 the same, and into the board's flash (SERIAL=S: of several boards)
#   make emulate BOARD=lm3s6965evb FRAMES=8       runs the image in its emulator: build/emulate/lm3s6965evb/frame-0000.ppm ..
#
# A board of this kind has, beside board.c (its data), a boards/NAME/board.mk with
#   PORT              folder below hal/
#   CHIP_FLASH_BYTES  of the board
#   CHIP_RAM_BYTES    of the chip; what an image may take of it is board.c's ram_bytes, stack included
# and a port has, beside its C and assembler files, a hal/PORT/port.mk with
#   PORT_CPU          firmware/core's folder: armv6m, armv7m
#   PORT_FLAGS        for compiler and linker: -mcpu=... -mthumb
#   PORT_SRC          its .c and .S files; those of a shared folder too, e.g. hal/cortexm
#   PORT_LD           linker script; -L hal/PORT and -L hal/cortexm are searched for what it includes
#   PORT_STACK_BYTES  reserved; the linker script gets it as the symbol stack_bytes
#   PORT_RAM_BYTES    optional: RAM that the port takes beside the board's ram_bytes (code that runs from RAM, say)
#   PORT_CORES        optional: what CORES may be; 1
#   PORT_TILES_BYTES  optional: signatures of what changed (hal/panel_tiles.h); without it CHANGES is 0
#   PORT_STACK_EXTRA  bytes that the call graph does not show: frames of interrupts
#   PORT_FINISH       optional shell command between linking and objcopy; finds the ELF in "$1" (a checksum, e.g.)
#   UF2_FAMILY        number of the chip's family, empty: there is none; UF2_BASE: address of the BIN's first byte
#   EMULATE           command of `make emulate`, called with the ELF, an empty folder for frames, and FRAMES
#   EMULATE_NEEDS     what is made for it first, on the computer
#   SPEED             optional: command of `make speed`
#   FLASH             command of `make flash`, for $(IMAGE).elf, .bin or .uf2; firmware/tools/flash_with.sh runs a tool from elsewhere
#   FLASH_NEEDS       what is made for it first, on the computer
# A port's operations are functions named <port>_<operation of struct hal_ops>: the check of the stack finds them so.
# All code of a port goes through -Wconversion. The image's main() is in the APP's file; see hal/port.h and firmware/app/runner.h.
#
# The build gives each image board_here and image_memory (hal/port.h; ram_bytes less RUNNER_OTHER_BYTES). CORES (make's
# CORES=1|2) is for a port's make lines. CHANGES=0
# sends every frame whole, CHANGES=1 only what changed, which is what ports that can do.

CROSS ?= arm-none-eabi-
HOSTCC ?= cc
APP ?= demos
FRAMES ?= 4
CORES ?= 1
SCENE ?=
SCENE_TRIANGLES ?= fit
SCENE_TEXTURE ?= 256
SCENE_FLAGS ?=
SCENE_PROGRAM_BYTES ?= 147456 # of the flash for all but the scene's data
BOARD_HOME := $(firstword $(wildcard $(BOARD_DIR:%=%/$(BOARD))) boards/$(BOARD))

.PHONY: firmware flash emulate speed image image-size

MCU_BOARDS := $(patsubst boards/%/board.mk,%,$(wildcard boards/*/board.mk))

ifneq ($(BOARD),)
$(if $(or $(word 2,$(BOARD)),$(findstring /,$(BOARD))),$(error BOARD='$(BOARD)': no such board; microcontroller boards are: $(MCU_BOARDS)))
ifeq ($(wildcard $(BOARD_HOME)/board.mk),)
$(error BOARD=$(BOARD): no $(BOARD_HOME)/board.mk; microcontroller boards are: $(MCU_BOARDS))
endif
NO_SUCH_NAME = make takes no names with spaces or other special characters; rename or copy the file
include $(BOARD_HOME)/board.mk
include hal/$(PORT)/port.mk
APP_FILE := $(if $(filter %.c,$(APP)),$(APP),firmware/app/images/$(APP).c)
APP_NAME := $(basename $(notdir $(APP)))
$(if $(filter $(CORES),$(or $(PORT_CORES),1)),,$(error CORES=$(CORES): $(BOARD) has $(or $(PORT_CORES),1)))
$(if $(call odd,$(APP)),$(error APP='$(APP)': $(NO_SUCH_NAME)))
$(if $(call odd,$(SCENE)),$(error SCENE='$(SCENE)': $(NO_SUCH_NAME)))
$(if $(wildcard $(APP_FILE)),,$(error APP=$(APP): there is no $(APP_FILE); take demos, depth or a file NAME.c))
CHANGES ?= $(if $(PORT_TILES_BYTES),1,0)
$(if $(filter $(CHANGES),$(if $(PORT_TILES_BYTES),0 1,0)),,$(error CHANGES=$(CHANGES): $(BOARD) has $(if $(PORT_TILES_BYTES),0 1,0)))
IMAGE_CORES := $(if $(filter-out 1,$(CORES)),-cores$(CORES))$(if $(PORT_TILES_BYTES),$(if $(filter 0,$(CHANGES)),-whole))
SCENE_NAME := $(basename $(notdir $(SCENE)))
IMAGE_NAME := $(BOARD)-$(or $(SCENE_NAME),$(APP_NAME))$(IMAGE_CORES)
IMAGE := $(B)/firmware/$(IMAGE_NAME)
SCENE_C := $(if $(SCENE),$(IMAGE).scene.c)
RAM_BYTES := $(shell sed -n 's/^ *\.ram_bytes = \([^,]*\),.*/\1/p' $(BOARD_HOME)/board.c)

# The image is built by a make of its own, which has the target's compiler where this one has the computer's.
image_make = $(if $(shell command -v '$(CROSS)gcc'),,$(error no $(CROSS)gcc here: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi))\
             $(MAKE) --no-print-directory B='$(B)/firmware/$(BOARD)$(IMAGE_CORES)$(if $(SCENE),-scene)-objects' OUT='$(IMAGE)' CC='$(CROSS)gcc' \
             CPU='$(PORT_CPU)' BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' CORES='$(CORES)' CHANGES='$(CHANGES)' APP='$(APP)' SCENE='$(SCENE)' SCENE_C='$(SCENE_C)' \
             CFLAGS='$(PORT_FLAGS) -O2 -g -ffreestanding -ffunction-sections -fdata-sections -fcallgraph-info=su'
else
NO_BOARD = @echo 'BOARD= is missing; microcontroller boards are: $(MCU_BOARDS)' >&2; exit 2 \#
image_make = $(NO_BOARD)
endif

firmware: $(SCENE_C) ## BOARD=x [APP=demos|depth|FILE.c] [SCENE=FILE.glb]: an image for a microcontroller kit, and what it takes of flash, RAM, stack
	+$(Q)$(image_make) image

ifneq ($(if $(OUT),,$(SCENE_C)),)
$(SCENE_C): $(B)/pinhole-asset FORCE
	@mkdir -p $(@D)
	$(SAY) ASSET '$(SCENE)'
	$(Q)$(B)/pinhole-asset '$(SCENE)' --out '$@.new' --board $(BOARD) --flash "$$(($(CHIP_FLASH_BYTES) - $(SCENE_PROGRAM_BYTES)))" \
	    --max-triangles $(SCENE_TRIANGLES) --texture-size $(SCENE_TEXTURE) $(SCENE_FLAGS)
	@if cmp -s '$@.new' '$@'; then rm '$@.new'; else mv '$@.new' '$@'; fi
endif

flash: firmware $(FLASH_NEEDS) ## BOARD=x [APP=..] [SCENE=..] [SERIAL=S]: an image, and into the flash of the board that is plugged in
	$(Q)$(FLASH)

emulate: firmware $(EMULATE_NEEDS) ## BOARD=x [APP=..] [SCENE=..] [FRAMES=n]: runs it in the board's emulator, frames to build/emulate/x/
	@case '$(FRAMES)' in '' | 0* | *[!0-9]* | ???????*) echo "make emulate: FRAMES='$(FRAMES)': a whole number, 1 .. 999999" >&2; exit 2 ;; esac
	$(Q)rm -rf '$(B)/emulate/$(BOARD)'; mkdir -p '$(B)/emulate/$(BOARD)'
	$(Q)$(EMULATE) '$(IMAGE).elf' '$(B)/emulate/$(BOARD)' '$(FRAMES)'

speed: ## BOARD=x of an RP2040: frames/s and load of each core for every demo, with one core and with two, emulated
	$(Q)$(NO_BOARD)$(or $(SPEED),echo 'make speed: BOARD=$(BOARD): only the boards of an RP2040 have an emulator whose bus takes time' >&2; exit 2)

# ---- within that make -----------------------------------------------------------------------------------------------
ifneq ($(OUT),)
IMAGE_SRC := $(CORE) $(APP_SRC) $(wildcard hal/panel/*.c) $(PORT_SRC) $(BOARD_HOME)/board.c
IMAGE_OBJ := $(patsubst %,$(B)/%.o,$(basename $(IMAGE_SRC))) $(B)/main-$(APP_NAME).o $(B)/board_here.o $(if $(SCENE_C),$(B)/scene-$(SCENE_NAME).o)
LD_SEARCH := -L hal/$(PORT) -L hal/cortexm

image: $(OUT).bin $(if $(UF2_FAMILY),$(OUT).uf2)
	$(Q)firmware/tools/budget.sh '$(OUT).elf' '$(B)' 'main-$(APP_NAME)' flash='$(CHIP_FLASH_BYTES)' ram="$$(($(RAM_BYTES) + $(or $(PORT_RAM_BYTES),0)))" chip_ram='$(CHIP_RAM_BYTES)' \
	    stack='$(PORT_STACK_BYTES)' extra='$(PORT_STACK_EXTRA)' || { rm -f '$(OUT).bin' '$(OUT).uf2'; exit 1; } # nothing to be flashed

image-size: $(OUT).elf
	$(Q)firmware/tools/modules.sh '$(OUT).map'

# The renderer's loops are worth the bytes; frames are the same at every level.
$(B)/firmware/core/%.o: override CFLAGS += -O3

$(B)/main-$(APP_NAME).o: $(APP_FILE) $(B)/flags
	@mkdir -p $(@D)
	$(SAY) CC $<
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(INC_APP) -Ifirmware/app/depthlab -Iboards \
	    -MMD -MP -c $< -o $@
	$(Q)sed 's:$(subst #,\\#,$(APP_FILE))::' $(@:.o=.d) >$(@:.o=.d.part) && mv $(@:.o=.d.part) $(@:.o=.d) # a file of one's own may move

$(B)/scene-$(SCENE_NAME).o: $(SCENE_C) $(B)/flags
	@mkdir -p $(@D)
	$(SAY) CC $<
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(INC_CORE) -Ifirmware/app -MMD -MP -c $< -o $@

define BOARD_HERE
#include "runner.h"
#include "port.h"
extern const struct board board_$(subst -,_,$(BOARD));
const struct board *const board_here = &board_$(subst -,_,$(BOARD));
uint64_t image_memory[(($(RAM_BYTES)) - RUNNER_OTHER_BYTES) / 8];
const size_t image_memory_bytes = sizeof image_memory;
uint32_t image_tiles[$(if $(filter 1,$(CHANGES)),$(PORT_TILES_BYTES),4) / 4];
const size_t image_tiles_bytes = $(if $(filter 1,$(CHANGES)),sizeof image_tiles,0);
$(if $(SCENE_C),const struct demo *const demo_here = &demo_scene;,extern const struct demo demo_turntable;
const struct demo *const demo_here = &demo_turntable;)
endef
export BOARD_HERE

$(B)/board_here.c: FORCE
	@mkdir -p $(@D)
	@printf '%s\n' "$$BOARD_HERE" | cmp -s - $@ || printf '%s\n' "$$BOARD_HERE" >$@

$(B)/board_here.o: $(B)/board_here.c
	$(Q)$(CC) $(STD) $(CFLAGS) $(INC_APP) -MMD -MP -c $< -o $@

$(OUT).elf: $(IMAGE_OBJ) $(PORT_LD) $(wildcard hal/cortexm/*.ld)
	@mkdir -p $(@D)
	$(SAY) LD $@
	$(Q)firmware/tools/link.sh '$@' '$(OUT).map' $(CC) $(CFLAGS) -nostartfiles --specs=nano.specs $(LD_SEARCH) -T $(PORT_LD) -Wl,--gc-sections,--fatal-warnings \
	    -Wl,--defsym=stack_bytes=$(PORT_STACK_BYTES) $(IMAGE_OBJ)
	$(Q)$(if $(PORT_FINISH),set -- '$@.part'; $(PORT_FINISH))
	$(Q)mv $@.part $@

$(OUT).bin: $(OUT).elf
	$(Q)$(CROSS)objcopy -O binary $< $@

$(B)/image-uf2: firmware/tools/image_uf2.c
	@mkdir -p $(@D)
	$(Q)$(HOSTCC) -O2 -o $@ $<

$(OUT).uf2: $(OUT).bin $(B)/image-uf2
	$(Q)$(B)/image-uf2 '$(UF2_FAMILY)' '$(UF2_BASE)' $< $@

-include $(IMAGE_OBJ:.o=.d)
endif
