# Firmware images for microcontroller kits. The Makefile includes this file.
#
#   make firmware BOARD=pico-display              build/firmware/pico-display-demos.elf .bin .uf2 .map; prints their sizes
#   make firmware BOARD=lm3s6965evb APP=depth     another program: firmware/app/images/depth.c; or a file, APP=mine.c
#   make firmware BOARD=pico-display DEMO_DIR=d   d/NAME.c as a demo of one's own, with which the image begins; PANEL_DIR=d: a panel
#   make firmware BOARD=pico-display SCENE=my.glb a model, through pinhole-asset: build/firmware/pico-display-my.elf
#                                                 SCENE_TRIANGLES=N|all|fit, SCENE_TEXTURE=N, SCENE_FLAGS=--turntable
#   make size BOARD=pico-display                  the image's size by module
#   make flash BOARD=pico-display SCENE=my.phs    writes a binary scene (RP2040, RP2350) behind the image that is there already
#   make flash BOARD=pico-display                 builds the image and writes it into the flash (SERIAL=S: of which board)
#   make emulate BOARD=lm3s6965evb FRAMES=8       runs the image in an emulator: build/emulate/lm3s6965evb/frame-0000.ppm ..
#   CHANGES=0|1                                   frames are sent whole | only their changes are (default, if the port can)
#   CLIP_FPS=N                                    each frame is 1/N s of a clip (24, 25, 30, ..); by default clips run by the kit's clock
#   DITHER=N                                      light without bands (ph_dither), with room for N ramps of 2 KB; 0: with bands, the default
#   CORES=1|2                                     how many cores the image uses
#   RAM_CODE=small                                RP2040: only what small triangles of a mesh need runs from RAM; 27 KB are left for APP, or a larger scene_bytes
#   ISA=arm|riscv                                 which cores of an RP2350 it is for
#   VERSION=1.0                                   what picotool info shows as its version; Pinhole's by default
#
# A microcontroller board has, beside board.c (its data), a boards/NAME/board.mk with
#   PORT              a folder of hal/
#   CHIP_FLASH_BYTES  the board's flash
#   DITHER            optional: DITHER=N of this kit, where the command line says nothing else
#   CHIP_RAM_BYTES    the chip's RAM; an image may take board.c's image_ram of it, stack included
# A port has, beside its C and assembler files, a hal/PORT/port.mk with
#   PORT_CPU          a folder of firmware/core/kernels: armv6m, armv7m, rv32
#   PORT_FLAGS        for compiler and linker: -mcpu=... -mthumb
#   PORT_CROSS        optional: the prefix of the compiler's name; without it arm-none-eabi-
#   PORT_LIBS         optional: what is linked last; without it --specs=nano.specs
#   PORT_SRC          its .c and .S files, and those of a shared folder, e.g. hal/chips/cortexm
#   PORT_LD           the linker script; it finds what it includes in hal/PORT and hal/chips/cortexm
#   PORT_STACK_EXTRA  stack that the call graph does not show: frames of interrupts. The linker script gets the symbol
#                     stack_bytes: what the call graph's deepest path takes, and this
#   PORT_CORE1        the function, FILE:NAME, with which another core begins; its stack has stack_core1_bytes, as above, and
#                     PORT_CORE1_EXTRA of stack that its call graph does not show. None: they are 0
#   PORT_AHEAD_BYTES  optional: memory in which a second core makes the scene of the next frame
#   PORT_CORES        optional: the values that CORES may have; without it 1
#   PORT_TIERS        optional: the tiers of functions that PORT_LD tells apart (hal/README.md); PORT_FLAGS have -DCODE_TIERS then
#   PORT_RAM_TIERS    optional: those of them that run from RAM, by RAM_CODE. PORT_LD includes ram_tiers.ld, and for the rest flash_tiers.ld
#   PORT_RAM_CODES    optional: other values of RAM_CODE than coresN, the default
#   PORT_ISAS         optional: the values that ISA may have, the default first
#   PORT_TILES_BYTES  optional: memory for the signatures of tiles (hal/panel_tiles.h); without it CHANGES is 0
#   PORT_SCENE        optional: offset in flash of a binary scene, behind every image; it may fill the rest of the flash
#   PORT_INFO         optional: a .c file that tells about the image; it gets macros BOARD_... (firmware/tools/board_facts.c)
#                     and IMAGE_NAME, IMAGE_VERSION, IMAGE_ATTRIBUTES, IMAGE_ISA; IMAGE_SCENE, an address, if the image
#                     looks for a scene there
#   PORT_FINISH       optional: a shell command between linking and objcopy, e.g. for a checksum; "$1" is the ELF file
#   UF2_FAMILY        the number of the chip's family; empty: no UF2 file. UF2_BASE: the address of the BIN's first byte
#   UF2_APP_BASE      optional: where the boot loader that takes the UF2 file starts images, if it lies in the same flash. Then the UF2 file is
#                     of a second link, at that address (the linker script gets it as the symbol flash_base); ELF and BIN begin at UF2_BASE
#   EMULATE           the command of `make emulate`; its arguments are the ELF, an empty folder for frames, and FRAMES
#   EMULATE_NEEDS     what is made for it first, on the computer
#   SPEED             optional: the command of `make speed`
#   FLASH             the command of `make flash`, for $(IMAGE).elf, .bin or .uf2; firmware/tools/flash_with.sh runs others' tools
#   FLASH_NEEDS       what is made for it first, on the computer
# The check of the stack finds a port's operations where its struct hal_ops names them (.bus_write = ..): firmware/tools/stack.awk.
# All code of a port is compiled with -Wconversion. APP's file has the image's main(); see hal/port.h, firmware/app/image.h
# and firmware/app/runner.h. board_here.c gives each image its board and its memory.

HOSTCC ?= cc
APP ?= demos
FRAMES ?= 4
CORES ?= 1
VERSION ?= $(PINHOLE_VERSION)
SCENE ?=
SCENE_TRIANGLES ?= fit
SCENE_TEXTURE ?= 256
SCENE_FLAGS ?=
SCENE_PROGRAM_BYTES ?= 192512 # flash for everything but the scene's data
BOARD_HOME := $(firstword $(wildcard $(BOARD_DIR:%=%/$(BOARD))) boards/$(BOARD))

.PHONY: firmware flash emulate budgets speed image image-size

MCU_BOARDS := $(patsubst boards/%/board.mk,%,$(wildcard boards/*/board.mk))

ifneq ($(BOARD),)
$(if $(or $(word 2,$(BOARD)),$(findstring /,$(BOARD))),$(error BOARD='$(BOARD)': no such board; microcontroller boards are: $(MCU_BOARDS)))
ifeq ($(wildcard $(BOARD_HOME)/board.mk),)
$(error BOARD=$(BOARD): no $(BOARD_HOME)/board.mk; microcontroller boards are: $(MCU_BOARDS))
endif
NO_SUCH_NAME = make takes no names with spaces or other special characters; rename or copy the file
include $(BOARD_HOME)/board.mk
include hal/$(PORT)/port.mk
CROSS ?= $(or $(PORT_CROSS),arm-none-eabi-)
APP_FILE := $(if $(filter %.c,$(APP)),$(APP),firmware/app/images/$(APP).c)
APP_NAME := $(basename $(notdir $(APP)))
$(if $(filter $(CORES),$(or $(PORT_CORES),1)),,$(error CORES=$(CORES): $(BOARD) has $(or $(PORT_CORES),1)))
$(if $(call misread,$(APP)),$(error APP='$(APP)': $(NO_SUCH_NAME)))
$(if $(call misread,$(SCENE)),$(error SCENE='$(SCENE)': $(NO_SUCH_NAME)))
$(if $(call misread,$(VERSION)),$(error VERSION='$(VERSION)': a version has no spaces or other special characters))
$(if $(wildcard $(APP_FILE)),,$(error APP=$(APP): there is no $(APP_FILE); take demos, depth or a file NAME.c))
ISA ?= $(firstword $(PORT_ISAS))
$(if $(filter $(or $(ISA),none),$(or $(PORT_ISAS),none)),,$(error ISA=$(ISA): $(BOARD) has $(or $(PORT_ISAS),no other ISA)))
CHANGES ?= $(if $(PORT_TILES_BYTES),1,0)
$(if $(filter $(CHANGES),$(if $(PORT_TILES_BYTES),0 1,0)),,$(error CHANGES=$(CHANGES): $(BOARD) has $(if $(PORT_TILES_BYTES),0 1,0)))
$(if $(CLIP_FPS),$(if $(filter 1 2 3 4 5 6 7 8 9 10 12 15 20 24 25 30 48 50 60 100 120 1000,$(CLIP_FPS)),,$(error CLIP_FPS=$(CLIP_FPS): a usual rate, such as 24, 25, 30 or 60)))
DITHER ?= 0
$(if $(filter 0 1 2 3 4 5 6 7 8,$(DITHER)),,$(error DITHER=$(DITHER): ramps that are dithered, 0 .. 8))
RAM_CODE ?= cores$(CORES)
$(if $(filter $(RAM_CODE),cores$(CORES) $(PORT_RAM_CODES)),,$(error RAM_CODE=$(RAM_CODE): $(BOARD) has $(or $(PORT_RAM_CODES),no other)))
IMAGE_CORES := $(if $(filter-out $(firstword $(PORT_ISAS)),$(ISA)),-$(ISA))$(if $(filter-out 1,$(CORES)),-cores$(CORES))$(if $(PORT_TILES_BYTES),$(if $(filter 0,$(CHANGES)),-whole))$(CLIP_FPS:%=-fps%)$(patsubst %,-dither%,$(filter-out 0,$(DITHER)))
IMAGE_RAM := $(if $(filter-out cores%,$(RAM_CODE)),-$(RAM_CODE))
SCENE_NAME := $(basename $(notdir $(SCENE)))
IMAGE_NAME := $(BOARD)-$(or $(SCENE_NAME),$(APP_NAME))$(IMAGE_CORES)$(IMAGE_RAM)
IMAGE := $(B)/firmware/$(IMAGE_NAME)
EMULATE_DIR := $(B)/emulate/$(IMAGE_NAME:$(BOARD)-demos%=$(BOARD)%)
SCENE_C := $(if $(SCENE),$(IMAGE).scene.c)
IMAGE_FLASH_BYTES = $(CHIP_FLASH_BYTES)$(if $(UF2_APP_BASE), - ($(UF2_APP_BASE) - $(UF2_BASE)))# an image fits wherever it begins
BOARD_SYMBOL := board_$(subst -,_,$(BOARD))

# FORCE, because BOARD and BOARD_DIR may be others than last time.
$(B)/board-facts: FORCE
	@mkdir -p $(@D)
	$(Q)$(HOSTCC) $(INC) $(PANELS_DEF) -DBOARD_HERE=$(BOARD_SYMBOL) -o $@ firmware/tools/board_facts.c '$(BOARD_HOME)/board.c' $(wildcard hal/panel/*.c) $(PANELS_MORE:%='$(PANEL_DIR)/%.c')
$(B)/board-facts: INC = -Ihal -Iboards

# A make of its own builds the image, with the target's compiler in place of the computer's.
image_make = $(if $(shell command -v '$(CROSS)gcc'),,$(error no $(CROSS)gcc here: apt-get install $(if $(PORT_CROSS),gcc-$(PORT_CROSS:%-=%),gcc-arm-none-eabi libnewlib-arm-none-eabi)))\
             $(MAKE) --no-print-directory B='$(B)/firmware/$(BOARD)$(IMAGE_CORES)$(if $(SCENE),-scene)-objects' OUT='$(IMAGE)' CC='$(CROSS)gcc' \
             CPU='$(PORT_CPU)' KIT=1 BOARD='$(BOARD)' BOARD_HOME='$(BOARD_HOME)' CORES='$(CORES)' ISA='$(ISA)' CHANGES='$(CHANGES)' CLIP_FPS='$(CLIP_FPS)' DITHER='$(DITHER)' RAM_CODE='$(RAM_CODE)' VERSION='$(VERSION)' APP='$(APP)' SCENE='$(SCENE)' SCENE_C='$(SCENE_C)' \
             CFLAGS='$(PORT_FLAGS) -O2 -g -ffreestanding -ffunction-sections -fdata-sections -fcallgraph-info=su'
else
NO_BOARD = @echo 'BOARD= is missing; microcontroller boards are: $(MCU_BOARDS)' >&2; exit 2 \#
image_make = $(NO_BOARD)
endif

firmware: $(SCENE_C) ## BOARD=x [APP=demos|depth|FILE.c] [SCENE=FILE.glb]: an image for a microcontroller kit; prints what it takes of flash, RAM, stack
	+$(Q)$(image_make) image

ifneq ($(if $(OUT),,$(SCENE_C)),)
$(SCENE_C): $(B)/pinhole-asset FORCE
	@mkdir -p $(@D)
	$(call say,ASSET $(SCENE))
	$(Q)$(B)/pinhole-asset '$(SCENE)' --out '$(@:.c=.new.c)' --board $(BOARD) --flash "$$(($(IMAGE_FLASH_BYTES) - $(SCENE_PROGRAM_BYTES)))" \
	    --max-triangles $(SCENE_TRIANGLES) --texture-size $(SCENE_TEXTURE) $(SCENE_FLAGS)
	@if cmp -s '$(@:.c=.new.c)' '$@'; then rm '$(@:.c=.new.c)'; else mv '$(@:.c=.new.c)' '$@'; fi
endif

flash: $(if $(and $(PORT_SCENE),$(filter %.phs,$(SCENE))),,firmware) $(FLASH_NEEDS) ## BOARD=x [APP=..] [SCENE=..] [SERIAL=S]: builds an image and writes it into the flash of the board that is plugged in
	$(Q)$(FLASH)

emulate: firmware $(EMULATE_NEEDS) ## BOARD=x [APP=..] [SCENE=..] [FRAMES=n]: runs it in an emulator; frames go to build/emulate/x/ (CORES=2: x-cores2/)
	@case '$(FRAMES)' in '' | 0* | *[!0-9]* | ???????*) echo "make emulate: FRAMES='$(FRAMES)': a whole number, 1 .. 999999" >&2; exit 2 ;; esac
	$(Q)rm -rf '$(EMULATE_DIR)'; mkdir -p '$(EMULATE_DIR)'
	$(Q)$(EMULATE) '$(IMAGE).elf' '$(EMULATE_DIR)' '$(FRAMES)'

budgets: ## [BOARD=x]: how much memory kits can give to scenes, from what their images take; writes boards/budgets.h
	+$(Q)B='$(B)' firmware/tools/budgets.sh $(BOARD)

speed: ## BOARD=x of an RP2040 or RP2350: frames/s and load of each core for every demo, with one core and with two, emulated
	$(Q)$(NO_BOARD)$(or $(SPEED),echo 'make speed: BOARD=$(BOARD): only the boards of an RP2040 or RP2350 have an emulator whose bus takes time' >&2; exit 2)

# ---- in the make that builds the image -----------------------------------------------------------------------------------------------
ifneq ($(OUT),)
IMAGE_SRC := $(CORE) $(APP_SRC) $(wildcard hal/panel/*.c) $(PORT_SRC) $(PORT_INFO) $(BOARD_HOME)/board.c
IMAGE_OBJ := $(patsubst %,$(B)/%.o,$(basename $(IMAGE_SRC))) $(B)/main-$(APP_NAME).o $(B)/board_here.o $(DEMOS_MORE_O) $(PANELS_MORE_O) $(if $(SCENE_C),$(B)/scene-$(SCENE_NAME).o)
LD_SEARCH := -L hal/$(PORT) -L hal/chips/cortexm -L $(B)/$(RAM_CODE)

image: $(OUT).bin $(if $(UF2_FAMILY),$(OUT).uf2)
	$(Q)CROSS='$(CROSS)' firmware/tools/budget.sh '$(OUT).elf' '$(BOARD)' flash="$$(($(IMAGE_FLASH_BYTES)))" ram="$$($(B)/board-facts image_ram $(CORES))" \
	    chip_ram='$(CHIP_RAM_BYTES)' stack="$$(cat '$(STACK)')" || { rm -f '$(OUT).bin' '$(OUT).uf2'; exit 1; } # so that nobody flashes it

image-size: $(OUT).elf
	$(Q)firmware/tools/modules.sh '$(OUT).map'

$(B)/main-$(APP_NAME).o: $(APP_FILE) $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC $<)
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(INC_APP) -Ifirmware/app/depthlab -Iboards \
	    -MMD -MP -c $< -o $@
	$(Q)sed 's:$(subst #,\\#,$(APP_FILE))::' $(@:.o=.d) >$(@:.o=.d.part) && mv $(@:.o=.d.part) $(@:.o=.d) # a user's file may move

$(B)/scene-$(SCENE_NAME).o: $(SCENE_C) $(B)/flags
	@mkdir -p $(@D)
	$(call say,CC $<)
	$(Q)$(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(INC_CORE) -Ifirmware/app -MMD -MP -c $< -o $@

BOARD_DEFS = -DBOARD_HERE=$(BOARD_SYMBOL) -DDEMO_HERE=demo_$(if $(SCENE_C),scene,$(or $(FIRST_DEMO),$(firstword $(DEMOS_MORE)),turntable)) \
             -DTILES_BYTES=$(if $(filter 1,$(CHANGES)),$(PORT_TILES_BYTES),0) -DAHEAD_BYTES=$(or $(PORT_AHEAD_BYTES),0) \
             -DCLIP_FPS=$(or $(CLIP_FPS),DEMO_CLIPS_BY_CLOCK) -DDITHERED_RAMPS=$(DITHER) \
             $(if $(or $(SCENE_C),$(if $(PORT_SCENE),,none)),-DSCENE_AT=0 -DSCENE_BYTES=0,-DSCENE_AT=$(UF2_BASE)+$(PORT_SCENE) -DSCENE_BYTES=$(CHIP_FLASH_BYTES)-$(PORT_SCENE))

BUILD_TEXT = $(or $(SCENE_NAME),$(APP_NAME)) for $(BOARD), CORES=$(CORES) CHANGES=$(CHANGES)$(if $(ISA), ISA=$(ISA))$(if $(IMAGE_RAM), RAM_CODE=$(RAM_CODE))

$(B)/board_here.flags: $(B)/board-facts
	@echo "$(BOARD_DEFS) -DMEMORY_BYTES=$$($< scene_bytes) '-DIMAGE_BUILD=\"$(BUILD_TEXT)\"'" >$@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@

# What a port may tell about an image (PORT_INFO). An image looks for a scene if its main() asks board_here.c where one is.
$(B)/image_info.h: $(B)/board-facts $(B)/main-$(APP_NAME).o
	@{ $< pins && echo '#define IMAGE_NAME "$(or $(SCENE_NAME),$(APP_NAME))"' && echo '#define IMAGE_VERSION "$(VERSION)"' && \
	   echo '#define IMAGE_ATTRIBUTES "CORES=$(CORES) CHANGES=$(CHANGES)"' && echo '#define IMAGE_ISA "$(ISA)"' && \
	   if [ '$(if $(SCENE_C),,$(PORT_SCENE))' ] && $(CROSS)nm $(B)/main-$(APP_NAME).o | grep -q ' U image_scene$$'; then printf '#define IMAGE_SCENE "0x%08x"\n' "$$(($(UF2_BASE) + $(or $(PORT_SCENE),0)))"; fi; } >$@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@
$(PORT_INFO:%.c=$(B)/%.o): $(B)/image_info.h
$(PORT_INFO:%.c=$(B)/%.o): private override CPPFLAGS += -include $(B)/image_info.h

$(B)/board_here.o: firmware/app/images/board_here.c $(B)/board_here.flags
	$(Q)$(CC) $(STD) $(CFLAGS) $(INC_APP) @$(B)/board_here.flags -MMD -MP -c $< -o $@

STACK := $(B)/$(APP_NAME).stack
STACK_CORE1 := $(B)/$(APP_NAME).stack_core1
$(STACK): stack_of = '$(PORT_STACK_EXTRA)' ''
$(STACK_CORE1): stack_of = '$(PORT_CORE1_EXTRA)' '$(PORT_CORE1)'
$(STACK) $(if $(PORT_CORE1),$(STACK_CORE1)): $(IMAGE_OBJ) firmware/tools/stack.sh firmware/tools/stack.awk
	$(Q)firmware/tools/stack.sh '$(OUT).elf' $(stack_of) '$(B)' $(IMAGE_OBJ:%='%') >'$@.new' && mv '$@.new' '$@'
$(if $(PORT_CORE1),,$(STACK_CORE1)):
	@mkdir -p $(@D) && echo 0 >$@

# What the linker script includes: the tiers of functions that this image runs from RAM, and those that it runs from flash.
tier_sections = $(foreach tier,$(1),*(.tier.$(tier).*))
$(B)/$(RAM_CODE)/ram_tiers.ld: FORCE
	@mkdir -p $(@D); echo '$(call tier_sections,$(filter-out $(PORT_RAM_TIERS),$(PORT_TIERS)))' >$(@D)/flash_tiers.ld
	@echo '$(call tier_sections,$(PORT_RAM_TIERS))' >$@.new; cmp -s $@.new $@ && rm $@.new || mv $@.new $@

UF2_ELF := $(if $(UF2_APP_BASE),$(B)/uf2-$(notdir $(OUT)).elf,$(OUT).elf)
$(filter-out $(OUT).elf,$(UF2_ELF)): $(OUT).elf
$(sort $(OUT).elf $(UF2_ELF)): $(IMAGE_OBJ) $(STACK) $(STACK_CORE1) $(PORT_LD) $(wildcard hal/chips/cortexm/*.ld) $(if $(PORT_TIERS),$(B)/$(RAM_CODE)/ram_tiers.ld)
	@mkdir -p $(@D)
	$(call say,LD $@)
	$(Q)firmware/tools/link.sh '$@' '$(@:.elf=.map)' $(CC) $(CFLAGS) -nostartfiles $(LD_SEARCH) -T $(PORT_LD) -Wl,--gc-sections,--fatal-warnings \
	    -Wl,--defsym=stack_bytes=$$(cat '$(STACK)'),--defsym=stack_core1_bytes=$$(cat '$(STACK_CORE1)'),--defsym=flash_base=$(or $(if $(filter $(OUT).elf,$@),$(UF2_BASE),$(UF2_APP_BASE)),0) $(IMAGE_OBJ) $(or $(PORT_LIBS),--specs=nano.specs)
	$(Q)$(if $(PORT_FINISH),set -- '$@.part'; $(PORT_FINISH))
	$(Q)mv $@.part $@

$(sort $(OUT).bin $(UF2_ELF:.elf=.bin)): %.bin: %.elf
	$(Q)$(CROSS)objcopy -O binary $< $@

$(B)/image-uf2: firmware/tools/image_uf2.c
	@mkdir -p $(@D)
	$(Q)$(HOSTCC) -O2 -o $@ $<

$(OUT).uf2: $(UF2_ELF:.elf=.bin) $(B)/image-uf2
	$(Q)$(B)/image-uf2 '$(UF2_FAMILY)' '$(or $(UF2_APP_BASE),$(UF2_BASE))' $< $@

-include $(IMAGE_OBJ:.o=.d)
endif
