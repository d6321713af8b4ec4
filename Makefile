# Pinhole. `make help` lists what there is to make; every variable below may be given on the command line.
# No rules of make's own: looking through them is half of what a make with nothing to do takes.
MAKEFLAGS += -r
CC ?= cc
AR ?= ar
CFLAGS ?= -O2 -g
CPU ?= $(if $(findstring __x86_64__,$(shell $(CC) $(CFLAGS) -dM -E -x c /dev/null 2>/dev/null)),x86_64,portable)
B ?= build
V ?= 0
PROFILE ?= whole
$(if $(filter whole small,$(PROFILE)),,$(error PROFILE=$(PROFILE): take whole or small))
$(if $(strip $(B)),,$(error B= is empty: it names the build directory))
BOARD_DIR ?=
DEMO_DIR ?=
PANEL_DIR ?=
PINHOLE_VERSION := $(shell sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)
BUDGET_CORE_BYTES ?= 112640

# Returns the characters of $(1) that make or the shell would misread, or its second word; nothing if the name is safe.
OPEN := (
CLOSE := )
misread = $(strip $(word 2,$(1))$(foreach c,' " ` ; & < > | * ? [ ] { } : % ! \ $(OPEN) $(CLOSE),$(findstring $(c),$(1))))
$(if $(call misread,$(B)),$(error B='$(B)': make takes no folder with spaces or other special characters in its name))

Q = $(if $(filter 1,$(V)),,@)
# make prints it itself: a process for each object takes longer.
say = $(if $(filter 1,$(V))$(findstring s,$(firstword -$(MAKEFLAGS))),,$(info $()  $(1)))

WARN = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wundef -Wcast-qual -Wwrite-strings \
       -Wpointer-arith -Wvla -Wformat=2
STD = -std=c11 $(WARN)

# A target is chosen by path: a file under firmware/core/kernels/$(CPU)/ replaces the portable one of the same name, and a
# library that this machine lacks is replaced by the folder that does without it.
# They are asked for at once: processes are most of what a make with nothing to do takes. (An image needs none of them.)
LIBRARIES := $(if $(OUT),,$(shell for l in assimp libpng libjpeg libwebp sdl2 libgpiod libdrm libusb-1.0 cmocka mpfr gmp osmesa glu; do \
    pkg-config --exists $$l && echo $$l; done 2>/dev/null))
have = $(filter $(1),$(LIBRARIES))
package_libs = $(if $(strip $(1)),$(shell pkg-config --libs $(1)))
ASSIMP ?= $(if $(call have,assimp),assimp,noassimp)
PNG ?= $(if $(call have,libpng),png,nopng)
JPEG ?= $(if $(and $(filter png,$(PNG)),$(call have,libjpeg)),jpeg,nojpeg)
JPEG := $(JPEG)
WEBP ?= $(if $(and $(filter png,$(PNG)),$(call have,libwebp)),webp,nowebp)
WEBP := $(WEBP)
GIF ?= $(if $(wildcard /usr/include/gif_lib.h /usr/local/include/gif_lib.h),gif,nogif)
GIF := $(GIF)
SDL ?= $(if $(call have,sdl2),sdl,nosdl)
ASSIMP := $(ASSIMP)
PNG := $(PNG)
SDL := $(SDL)
GPIOD ?= $(if $(call have,libgpiod),$(if $(shell pkg-config --exists 'libgpiod >= 2' && echo y),gpiod2,gpiod1),nogpiod)
USB ?= $(if $(call have,libusb-1.0),usb,nousb)
DRM ?= $(if $(call have,libdrm),libdrm,nolibdrm)
GPIOD := $(GPIOD)
USB := $(USB)
DRM := $(DRM)
DRM_CFLAGS := $(if $(filter libdrm,$(DRM)),$(shell pkg-config --cflags libdrm))
GPIOD_CFLAGS := $(if $(filter-out nogpiod,$(GPIOD)),$(shell pkg-config --cflags libgpiod))
# meshoptimizer has no pkg-config file (giflib has none, either).
MESHOPT ?= $(if $(wildcard /usr/include/meshoptimizer.h /usr/local/include/meshoptimizer.h),meshopt,nomeshopt)
MESHOPT := $(MESHOPT)
SPIDEV := $(shell $(CC) $(CPPFLAGS) $(CFLAGS) -E -include linux/spi/spidev.h -x c /dev/null >/dev/null 2>&1 && echo y)
SIM_LIBS := $(call package_libs,$(filter assimp,$(ASSIMP)) $(if $(filter png,$(PNG)),libpng) $(if $(filter jpeg,$(JPEG)),libjpeg) $(if $(filter webp,$(WEBP)),libwebp) \
                                $(if $(filter sdl,$(SDL)),sdl2) $(if $(filter-out nogpiod,$(GPIOD)),libgpiod) $(filter libdrm,$(DRM)) \
                                $(if $(filter usb,$(USB)),libusb-1.0)) \
            $(if $(filter meshopt,$(MESHOPT)),-lmeshoptimizer) $(if $(filter gif,$(GIF)),-lgif) $(if $(SPIDEV),-pthread)
TEST_LIBS := $(call package_libs,$(call have,cmocka mpfr gmp osmesa glu assimp))

CPU := $(CPU)

# Assembly replaces C where the compiler makes Thumb or RV32 code; a computer tries a microcontroller's C files without it.
KERNELS := firmware/core/kernels
CPU_S := $(wildcard $(KERNELS)/$(CPU)/*.S)
CPU_S := $(if $(CPU_S),$(if $(shell $(CC) $(CFLAGS) -dM -E -x c /dev/null 2>/dev/null | grep -E '__thumb__|__riscv_xlen 32'),$(CPU_S)))
CPU_SRC := $(wildcard $(KERNELS)/$(CPU)/*.c) $(CPU_S)
CORE := $(wildcard $(patsubst %,firmware/core/%/*.c,fx geom render effects)) $(CPU_SRC) \
        $(filter-out $(patsubst $(KERNELS)/$(CPU)/%,$(KERNELS)/portable/%.c,$(basename $(CPU_SRC))),$(wildcard $(KERNELS)/portable/*.c))
# The small profile is a folder that stands in place of the rest of render/, of the kernels and of what builds upon them.
SMALL := firmware/core/render/small
ifeq ($(PROFILE),small)
CORE := $(wildcard $(patsubst %,firmware/core/%/*.c,fx geom render/small))
CPU := portable
endif
APP_SRC := $(wildcard firmware/app/*.c firmware/app/demos/*.c firmware/app/models/*.c firmware/app/depthlab/*.c)
HAL := $(wildcard hal/panel/*.c hal/null/*.c $(if $(SPIDEV),hal/linux/*.c hal/linux/$(GPIOD)/*.c hal/kms/*.c hal/kms/$(DRM)/*.c) \
                  hal/ft232h/*.c hal/ft232h/$(USB)/*.c)
BOARDS := $(wildcard boards/*.c boards/*/*.c)
BOARD_NAMES := $(sort $(patsubst boards/%/board.c,%,$(wildcard boards/*/board.c)))
# Boards from elsewhere: BOARD_DIR/NAME/board.c defines board_NAME (with _ for -), as a folder of boards/ does.
BOARDS_MORE := $(if $(BOARD_DIR),$(patsubst $(BOARD_DIR)/%/board.c,%,$(wildcard $(BOARD_DIR)/*/board.c)))
$(if $(BOARD_DIR),$(if $(BOARDS_MORE),,$(error BOARD_DIR=$(BOARD_DIR): there is no NAME/board.c in it)))
BOARDS_REFUSED := $(if $(BOARDS_MORE),$(shell printf '%s\n' '$(BOARDS_MORE)' | tr ' ' '\n' | grep -v '^[a-z0-9-]*$$'))
$(if $(BOARDS_REFUSED),$(error BOARD_DIR=$(BOARD_DIR): $(BOARDS_REFUSED): a board's name has a-z, 0-9 and - only))
$(foreach b,$(BOARDS_MORE),$(if $(wildcard boards/$(b)/board.c),$(error BOARD_DIR=$(BOARD_DIR): $(b) is a board of Pinhole: take another name)))
# Demos and panels from elsewhere: DEMO_DIR/NAME.c defines demo_NAME, PANEL_DIR/NAME.c panel_NAME. NAME.glass beside a panel is its
# row of `glasses` in host-sim/controllers/sim_glass.c. $(1) is DEMO or PANEL, $(2) the header that lists Pinhole's own.
more_refused = $(if $(shell echo '$(3)' | grep -x '[a-z][a-z0-9_]*'),$(if $(filter %($(3)),$(shell grep -o '[DP]([a-z0-9_]*)' $(2))),$(3) is one of Pinhole: take another name),$(3): a name has a-z, 0-9 and _ only)
more = $(foreach n,$(patsubst $($(1)_DIR)/%.c,%,$(wildcard $($(1)_DIR)/*.c)),$(n)$(if $(call more_refused,$(1),$(2),$(n)),$(error $(1)_DIR=$($(1)_DIR): $(call more_refused,$(1),$(2),$(n)))))
more_of = $(if $($(1)_DIR),$(or $(call more,$(1),$(2)),$(error $(1)_DIR=$($(1)_DIR): there is no NAME.c in it)))
DEMOS_MORE := $(call more_of,DEMO,firmware/app/demos/demo_scene.h)
PANELS_MORE := $(call more_of,PANEL,hal/panels.h)
$(foreach p,$(PANELS_MORE),$(if $(wildcard $(PANEL_DIR)/$(p).glass),,$(error PANEL_DIR=$(PANEL_DIR): there is no $(p).glass, which is what the simulator knows of it)))
more_list = $(if $(2),-D$(1)_MORE\(P\)=$(subst $() ,,$(2:%=P\(%\))))
DEMOS_DEF := $(call more_list,DEMOS,$(DEMOS_MORE))
PANELS_DEF := $(call more_list,PANELS,$(PANELS_MORE)) $(if $(PANELS_MORE),-DGLASSES_MORE)
DEMOS_MORE_O = $(DEMOS_MORE:%=$(B)/demos_more/%.o)
PANELS_MORE_O = $(PANELS_MORE:%=$(B)/panels_more/%.o)
# host-sim has one room a program, and common/ and controllers/ for all; a program's main() is in its pinhole_*.c.
MAINS := $(wildcard host-sim/*/pinhole_*.c)
ROOMS := common controllers model picture $(patsubst host-sim/%/,%,$(dir $(MAINS)))
HOST := $(wildcard $(ROOMS:%=host-sim/%/*.c) $(patsubst %,host-sim/%/*.c,model/formats model/gltf model/$(ASSIMP) model/$(MESHOPT) picture/$(PNG) picture/$(JPEG) picture/$(WEBP) picture/$(GIF) sim/$(SDL) flash/$(USB)))
# emulate/ has a room a chip. Those of the RP2040 and RP2350 are programs; what chips take as accesses to their registers is for tests, too.
REGISTERS := $(wildcard host-sim/emulate/registers/registers.c)
HOST := $(filter-out $(MAINS),$(HOST)) $(REGISTERS) $(wildcard host-sim/emulate/*/registers_table.c host-sim/emulate/*/emulate_*.c)
PROGRAMS := $(patsubst %.c,$(B)/%,$(subst _,-,$(notdir $(if $(SPIDEV),$(MAINS),$(filter-out %/pinhole_panel.c,$(MAINS))))))

# Rooms of programs that `make demo` does not run: a library of their own, for which it does not wait.
TOOLS := $(filter $(patsubst %,host-sim/%/%,depth emulate flash panel wire),$(HOST))
SHOWING := $(B)/pinhole-sim $(B)/pinhole-sheet

# The libraries, in the order in which they are linked: each uses those that come after it.
objects = $(patsubst %,$(B)/%.o,$(basename $(1)))
LIBS := $(B)/libpinhole-tools.a $(B)/libpinhole-host.a $(B)/libpinhole-app.a $(B)/libpinhole-hal.a $(B)/libpinhole.a
LIB := $(CORE) $(APP_SRC) $(HAL) $(BOARDS) $(HOST)
OBJ = $(call objects,$(LIB)) $(BOARDS_MORE:%=$(B)/boards_more/%/board.o) $(DEMOS_MORE_O) $(PANELS_MORE_O)

# Programs in tests/ are named after what runs them; what support/ and oracle/ hold they share. A folder of tests may have a
# room for each room of what it tests.
TESTS := $(patsubst %.c,$(B)/%,$(wildcard tests/*/test_*.c tests/*/*/test_*.c))
FUZZ := $(patsubst %.c,$(B)/%,$(wildcard tests/*/fuzz_*.c))
LONG := $(patsubst %.c,$(B)/%,$(wildcard tests/*/exhaustive_*.c)) $(FUZZ) $(B)/tests/oracle/three/motion_dump
TEST_LACKS := $(if $(call have,mpfr),,tests/support/exhaustive.c) $(if $(call have,osmesa),,tests/oracle/mesa.c)
TEST_OBJ := $(patsubst %.c,$(B)/%.o,$(filter-out $(TEST_LACKS),$(wildcard tests/support/*.c tests/oracle/*.c)))

# Includes run one way: what a folder may not know about, it does not find.
# Headers at the top of firmware/core, firmware/app, hal and boards are public; those of a room are its own, and of the
# rooms that are named here beside it. (A source finds its own room without a flag.)
INC_CPU = $(if $(filter-out portable,$(CPU)),-I$(KERNELS)/$(CPU)) -I$(KERNELS)/portable
INC_CORE = $(if $(filter small,$(PROFILE)),-DPH_PROFILE_SMALL -I$(SMALL)) $(INC_CPU) -Ifirmware/core
INC_MORE = -I$(B)/boards_all
INC_APP = $(INC_CORE) -Ifirmware/app -Ihal
INC_HOST = $(INC_APP) -Iboards $(INC_MORE) -Ihost-sim/common -Ihost-sim/picture
rooms = $(patsubst %,-I$(1)/%,$(2))
INC_ALL = $(INC_HOST) $(call rooms,firmware/core,fx geom render effects kernels) $(call rooms,firmware/app,demos models depthlab) \
          $(call rooms,hal,panel chips/rp2 rp2040) $(call rooms,host-sim,$(filter-out common,$(ROOMS)) model/formats model/gltf) $(call rooms,tests,support oracle) $(if $(call have,cmocka),,-Itests/support/bare) $(DRM_CFLAGS)
INC = $(INC_ALL)
$(B)/firmware/%.o $(B)/hal/%.o $(B)/boards/%.o $(B)/host-sim/emulate/%.o: private WARN += -Wconversion -Wno-sign-conversion
$(B)/firmware/core/%.o: INC = $(INC_CORE)
$(B)/firmware/core/render/%.o: INC = $(INC_CORE) $(call rooms,firmware/core,render kernels)
$(B)/firmware/core/effects/%.o: INC = $(INC_CORE) $(call rooms,firmware/core,render kernels)
$(KERNELS:%=$(B)/%)/%.o: INC = $(INC_CORE) $(call rooms,firmware/core,kernels render)
$(B)/firmware/app/%.o: INC = $(INC_APP)
$(B)/demos_more/%.o: INC = $(INC_APP) -Ifirmware/app/demos
$(B)/hal/%.o $(B)/panels_more/%.o: INC = -Ihal
$(B)/hal/linux/$(GPIOD)/%.o: INC = -Ihal $(GPIOD_CFLAGS)
$(B)/hal/kms/$(DRM)/%.o: INC = -Ihal $(DRM_CFLAGS)
$(B)/boards/%.o $(B)/boards_more/%.o: INC = -Ihal -Iboards $(INC_MORE)
$(B)/host-sim/%.o: INC = $(INC_HOST)
$(B)/host-sim/sim/%.o: INC = $(INC_HOST) $(call rooms,host-sim,sim controllers model asset)
$(B)/host-sim/sim/sim_point.o $(B)/host-sim/sim/sim_fraction.o: INC = $(INC_HOST) $(call rooms,firmware/app,depthlab)
$(B)/host-sim/sim/sim_fisheye.o: INC = $(INC_HOST) $(call rooms,firmware/core,render kernels)
$(B)/host-sim/model/%.o: INC = $(INC_HOST) $(call rooms,host-sim,model model/formats model/gltf)
$(B)/host-sim/asset/%.o: INC = $(INC_HOST) $(call rooms,host-sim,asset model)
$(B)/host-sim/panel/%.o: INC = $(INC_HOST) $(call rooms,host-sim,model)
$(B)/host-sim/depth/%.o: INC = $(INC_HOST) $(call rooms,firmware/app,depthlab)
$(B)/host-sim/depth/depth_budget_measure.%: INC = $(INC_HOST) $(call rooms,firmware/app,depthlab) $(call rooms,firmware/core,render kernels)
$(B)/host-sim/depth/depth_layers.% $(B)/host-sim/depth/depth_options.%: INC = $(INC_HOST) $(call rooms,firmware/app,depthlab) $(call rooms,host-sim,model)
$(B)/host-sim/flash/%.o: INC = $(INC_HOST) $(call rooms,host-sim,flash)
$(B)/host-sim/emulate/%.o: INC = $(INC_HOST) $(call rooms,host-sim,emulate controllers)
$(patsubst %,$(B)/host-sim/emulate/%.o,rp2040/% rp2350/% registers/% stm32f4/registers_table lm3s6965/registers_table): INC = -Ihost-sim/emulate # a chip knows neither hal nor firmware
$(B)/host-sim/wire/%.o: INC = $(INC_HOST) $(call rooms,host-sim,controllers)

# Optimization in kits, in the bench and in `make size` (KIT=1; the default unless CFLAGS are given; frames are the same at every
# level). On a Cortex-M0+ most of the core runs from RAM, and its inner loops are assembly: only what -Os makes over 2 % slower
# in some demo is compiled for speed. Other CPUs have their code in flash that is fast. A source that takes another level than
# the rest says so itself, in a line that begins with `/* Kits: -Os` or, for one CPU, `/* Kits on armv6m: -O2`.
KIT ?= $(if $(filter file,$(origin CFLAGS)),1)
ifneq ($(KIT),)
KIT_LEVELS := $(shell grep -rE --include='*.c' '^/\* Kits( on $(CPU))?: -O[0-9s]' firmware/core hal 2>/dev/null | sed 's|:/[*] Kits[^:]*: *\(-O.\).*|=\1|')
kit_level = $(patsubst $<=%,%,$(filter $<=%,$(KIT_LEVELS)))
$(B)/firmware/core/%.o: override CFLAGS += $(or $(kit_level),$(if $(filter armv6m,$(CPU)),-Os,-O3))
$(B)/hal/%.o: override CFLAGS += $(kit_level)
endif

# CHECKED=1: the library looks at the indices of meshes (firmware/core/render/check.h). The default but on bare metal.
CHECKED ?= $(if $(findstring -ffreestanding,$(CFLAGS)),,1)
$(B)/firmware/core/render/check.o: DEFS += $(if $(CHECKED),-DPH_CHECKED=1)

ALL_FLAGS = $(if $(CHECKED),checked) $(if $(KIT),kit) $(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(DEFS) $(INC_ALL) $(GPIOD_CFLAGS) $(LDFLAGS) $(SIM_LIBS) $(CORE) $(APP_SRC) $(BOARDS_MORE) $(if $(OUT),$(BOARD_HOME))
COMPILE = $(CC) $(STD) $(CFLAGS) $(CPPFLAGS) $(DEFS) $(INC) -MMD -MP

.PHONY: all demo check test test-exhaustive proof lint bench size depth gallery golden clean help core-objects firmware-objects test-programs long-programs FORCE
.DELETE_ON_ERROR:
.SECONDARY:

all: $(PROGRAMS) $(B)/rp2350-emulate $(B)/rp2040-registers ## the programs, under build/

# What was built with other flags is built again (but while tests run in it: BUILT, of tests/run.sh). So is all where core or
# app have other files, because the bench links all objects of them that it finds; other files make the libraries again.
differs = $(if $(filter $(B),$(BUILT)),test -e $@ || )echo '$(1)' | cmp -s - $@ || { mkdir -p $(@D); $(2)echo '$(1)' >$@; }
$(B)/flags: FORCE
	@$(call differs,$(ALL_FLAGS),rm -rf $(B)/firmware/core $(B)/firmware/app; ) && mkdir -p $(FOLDERS)

$(B)/files: FORCE
	@$(call differs,$(LIB))

# Folders of objects are made with $(B)/flags, at once: a process for each object takes longer.
FOLDERS = $(sort $(dir $(if $(OUT),$(IMAGE_OBJ),$(OBJ) $(TEST_OBJ) $(TESTS))))
folder = @$(if $(filter $(@D)/,$(FOLDERS)),,mkdir -p $(@D))

$(B)/%.o: %.c $(B)/flags
	$(folder)
	$(call say,CC $<)
	$(Q)$(COMPILE) -c $< -o $@

$(B)/%.o: %.S $(B)/flags
	$(folder)
	$(call say,AS $<)
	$(Q)$(CC) $(CFLAGS) $(INC) -MMD -MP -c $< -o $@

# The registry of boards: every folder of boards/ with a board.c, and those of BOARD_DIR. It is there before any object.
BOARD_IDS := $(patsubst %,board_%,$(subst -,_,$(BOARD_NAMES) $(BOARDS_MORE)))
$(B)/flags: $(B)/boards_all/boards_all.h
$(B)/boards_all/boards_all.h: FORCE
	@mkdir -p $(@D); new=$@.$$$$; \
	{ printf 'extern const struct board %s;\n' $(BOARD_IDS); printf '#define BOARDS_ALL'; printf ' &%s,' $(BOARD_IDS); echo; } >$$new; \
	if cmp -s $$new $@; then rm $$new; else mv $$new $@; fi # a name of its own: another make may write it, too
	$(if $(PANELS_MORE),@set -- $(PANELS_MORE:%='$(PANEL_DIR)/%.glass'); cat "$$@" | cmp -s - $(@D)/glasses_more.inc || cat "$$@" >$(@D)/glasses_more.inc)

# These list demos and panels, so they are compiled again when DEMO_DIR or PANEL_DIR brings others.
MORE_O := $(B)/firmware/app/demos/list.o $(B)/hal/panel/panels.o $(B)/host-sim/controllers/sim_glass.o
$(B)/more: FORCE
	@$(call differs,$(DEMOS_DEF) $(PANELS_DEF))
$(MORE_O): $(B)/more
$(MORE_O) $(B)/boards_more/%.o $(if $(BOARD_HOME),$(B)/$(BOARD_HOME)/board.o): DEFS += $(DEMOS_DEF) $(PANELS_DEF)

# $(1): boards, demos or panels, $(2): the folder, $(3): what a file must define
define rule_of_more
$(B)/$(1)_more/%.o: $(2)/%.c $(B)/flags
	@mkdir -p $$(@D)
	@grep -qw '$(3)' '$$<' || { echo '$$<: defines no $(3)' >&2; exit 1; }
	$$(call say,CC $$<)
	$$(Q)$$(COMPILE) -c $$< -o $$@
	$$(Q)sed 's:$$<::' $$(@:.o=.d) >$$@.d && mv $$@.d $$(@:.o=.d) # a user's file may move
endef
$(if $(BOARDS_MORE),$(eval $(call rule_of_more,boards,$(BOARD_DIR),board_$$(subst -,_,$$(patsubst %/,%,$$(dir $$*))))))
$(if $(DEMOS_MORE),$(eval $(call rule_of_more,demos,$(DEMO_DIR),demo_$$*)))
$(if $(PANELS_MORE),$(eval $(call rule_of_more,panels,$(PANEL_DIR),panel_$$*)))

$(B)/libpinhole.a: $(call objects,$(CORE))
$(B)/libpinhole-hal.a: $(call objects,$(HAL) $(BOARDS)) $(BOARDS_MORE:%=$(B)/boards_more/%/board.o) $(PANELS_MORE_O)
$(B)/libpinhole-app.a: $(call objects,$(APP_SRC)) $(DEMOS_MORE_O)
$(B)/libpinhole-host.a: $(call objects,$(filter-out $(TOOLS),$(HOST)))
$(B)/libpinhole-tools.a: $(call objects,$(TOOLS))
$(LIBS): $(B)/files
	$(call say,AR $@)
	$(Q)rm -f $@.part; $(AR) rcs $@.part $(filter %.o,$^) && mv $@.part $@

$(B)/libtests.a: $(TEST_OBJ) $(B)/flags
	$(call say,AR $@)
	$(Q)rm -f $@.part; $(AR) rcs $@.part $(TEST_OBJ) && mv $@.part $@

$(PROGRAMS): $(filter-out %-tools.a,$(LIBS))
$(filter-out $(SHOWING),$(PROGRAMS)): $(B)/libpinhole-tools.a
$(PROGRAMS):
	$(call say,LD $@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $(filter %.o,$^) $(filter $^,$(LIBS)) -Wl,--as-needed $(SIM_LIBS) -lm -o $@.part && mv $@.part $@
$(foreach p,$(PROGRAMS:$(B)/pinhole-%=%),$(eval $(B)/pinhole-$(p): $(B)/host-sim/$(p)/pinhole_$(p).o))
$(B)/pinhole-depth: override LDFLAGS += -Wl,--wrap=ph_draw_mesh,--defsym=__wrap_ph_draw_mesh=depth_layers_draw_mesh # depth_layers.c records what a demo draws
$(B)/pinhole-sim: override LDFLAGS += -Wl,--wrap=ph_frame_begin,--defsym=__wrap_ph_frame_begin=sim_cameras_frame_begin # sim_cameras.c records
$(B)/pinhole-sim: override LDFLAGS += -Wl,--wrap=ph_frame_camera,--defsym=__wrap_ph_frame_camera=sim_cameras_frame_camera # what cameras a demo has
$(B)/pinhole-sim: override LDFLAGS += -Wl,--wrap=ph_draw_mesh,--defsym=__wrap_ph_draw_mesh=sim_cameras_draw_mesh # and where its meshes are
$(B)/pinhole-sim: override LDFLAGS += -Wl,--wrap=ph_blur_begin,--defsym=__wrap_ph_blur_begin=sim_focus_blur_begin # sim_focus.c sets the depth of field
$(B)/pinhole-sim: override LDFLAGS += -Wl,--wrap=demo_draw_band,--defsym=__wrap_demo_draw_band=sim_show_draw_band # sim_show.c shows the depth buffer

$(TESTS) $(LONG): $(B)/tests/%: $(B)/tests/%.o $(B)/libtests.a $(LIBS)
	$(call say,LD $@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -Wl,--as-needed $(TEST_LIBS) $(SIM_LIBS) -lm -o $@.part && mv $@.part $@

$(B)/tests/app/test_labels: override LDFLAGS += -Wl,--wrap=ph_overlay_text,--defsym=__wrap_ph_overlay_text=labels_overlay_text # it looks at
$(B)/tests/app/test_labels: override LDFLAGS += -Wl,--wrap=ph_text,--defsym=__wrap_ph_text=labels_text # what labels cover
$(B)/tests/hal/test_hal: $(B)/hal/template/template.o # a port, so it is in no library
# Nor is the emulator of an RP2350: a test of one of its files links that file alone, and plays the others.
$(foreach f,$(wildcard host-sim/emulate/rp2350/*.c),$(eval $(B)/tests/host-sim/emulate/test_$(basename $(notdir $(f))): $(f:%.c=$(B)/%.o)))

$(B)/rp2350-emulate: $(call objects,$(wildcard host-sim/emulate/rp2350/*.c) $(REGISTERS)) # for firmware/firmware.mk
	$(call say,LD $@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -o $@.part && mv $@.part $@

$(B)/rp2040-registers: $(call objects,$(wildcard host-sim/emulate/rp2040/*.c) $(REGISTERS)) # for its emulator, too
	$(call say,LD $@)
	$(Q)$(CC) $(CFLAGS) $(LDFLAGS) $^ -o $@.part && mv $@.part $@

core-objects: $(call objects,$(CORE))
firmware-objects: core-objects $(call objects,$(APP_SRC) $(wildcard hal/panel/*.c))
test-programs: $(TESTS) $(FUZZ)
long-programs: $(LONG)

-include firmware/firmware.mk firmware/package/package.mk host-sim/page/page.mk

demo: ## renders the demonstration into build/demo (needs nothing but cc and make)
	+$(Q)$(MAKE) --no-print-directory $(if $(filter -j%,$(MAKEFLAGS)),,-j$$(getconf _NPROCESSORS_ONLN || echo 1)) $(SHOWING:%='%')
	$(Q)B='$(B)' sh host-sim/demo.sh

check: ## the unit tests and the quick scripts, for every edit; installs nothing (under 90 seconds on 2 cores)
	$(Q)B='$(B)' tests/run.sh check $(MAKEOVERRIDES)

test: ## installs what the tests need, runs all of them (under 10 minutes on 2 idle cores)
	$(Q)B='$(B)' tests/run.sh test $(MAKEOVERRIDES)

test-exhaustive: ## the long tests: every input of the unary functions, long fuzzing, soaks, sweeps of boards. SHARE=1/24: one of 24 shares
	$(Q)B='$(B)' tests/run.sh long $(MAKEOVERRIDES)

proof: ## proves by CBMC and Gappa that no sum overflows, and how far results are off (about 10 minutes on 2 idle cores)
	$(Q)B='$(B)' CC='$(CC)' tests/proof/proof.sh

lint: $(B)/boards_all/boards_all.h ## clang-format, clang-tidy, cppcheck, shellcheck, strict warnings of gcc and clang as errors
	$(Q)B='$(B)' INCLUDE='$(INC_ALL)' tests/tools/lint.sh

bench: ## instructions a frame of the eight scenes on Cortex-M0+, M3, M4F, M33, RV32, Xtensa lx106 and x86-64, and the pictures' quality
	$(Q)B='$(B)' tests/bench/bench.sh

size: ## code size on a Cortex-M0+ of what images link of the core, by module; fails over the budget. BOARD=x: of its image; PROGRAM=FILE.c [PROFILE=small]: of a program
	+$(Q)$(if $(PROGRAM),B='$(B)' PROFILE='$(PROFILE)' tests/tools/program_size.sh $(PROGRAM),$(if $(BOARD),$(image_make) image-size,B='$(B)' BUDGET=$(BUDGET_CORE_BYTES) tests/tools/size.sh))

depth: all ## measures what depth resolves for the default camera: a report in build/depth/ (plots need gnuplot)
	$(Q)'$(B)/pinhole-depth' all --out '$(B)/depth' && echo '$(B)/depth/report.md'

gallery: all ## makes the README's pictures again
	$(Q)B='$(B)' host-sim/gallery.sh

golden: all ## writes the frame CRCs that the tests compare with again (look at the pictures first)
	$(Q)B='$(B)' tests/tools/golden.sh

clean: ## removes build/
	rm -rf '$(B)'

help: ## this list
	@sed -n 's/^\([a-z-]*\):[^#]*## /\1\t/p' $(filter %Makefile %.mk,$(MAKEFILE_LIST)) | awk -F'\t' '{ printf "make %-16s %s\n", $$1, $$2 }'
	@echo 'Variables: CC CFLAGS CPU=portable|x86_64|armv6m|armv7m|rv32 PROFILE=whole|small B=build CHECKED=1 V=1 PREFIX DESTDIR LIBDIR BOARD_DIR DEMO_DIR PANEL_DIR'

-include $(patsubst %.o,%.d,$(OBJ) $(TEST_OBJ) $(B)/hal/template/template.o) $(TESTS:=.d) $(LONG:=.d) $(MAINS:%.c=$(B)/%.d) $(patsubst %.c,$(B)/%.d,$(wildcard host-sim/emulate/rp2350/*.c host-sim/emulate/rp2040/*.c))
