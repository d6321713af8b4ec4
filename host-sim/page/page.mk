# The simulator and the asset tool in a browser. The Makefile includes this file.
#
#   make page                      build/page/index.html: one file, which needs no server and asks for nothing
#   make page-kits [BOARD=x]       build/page/kits/: the images that it saves or flashes, of all boards or of one
#
# Another make compiles their sources to wasm32, in a build folder of its own, into two modules: page.wasm draws, and
# model.wasm reads models and writes scenes.
PAGE := host-sim/page
PAGE_HOST := $(wildcard host-sim/controllers/sim*.c host-sim/controllers/*_table.c) \
             $(patsubst %,host-sim/common/%.c,complain json_text nearest nearest_kits option_camera option_table option_text) $(PAGE)/progress.c \
             $(filter-out %/pinhole_sim.c,$(wildcard host-sim/sim/*.c)) \
             $(filter-out %/model_open.c %/model_folder.c,$(wildcard host-sim/model/*.c host-sim/model/formats/*.c host-sim/model/gltf/*.c)) \
             $(filter-out %/pinhole_asset.c %/asset_check.c %/asset_options.c,$(wildcard host-sim/asset/*.c)) host-sim/picture/picture_in.c \
             $(filter-out %/pinhole_flash.c,$(wildcard host-sim/flash/*.c))
PAGE_CC := clang --target=wasm32-wasi -fvisibility=hidden -D_WASI_EMULATED_SIGNAL
PAGE_NEEDS := clang lld wasi-libc libclang-rt-dev-wasm32 libstb-dev

.PHONY: page page-kits FORCE
page: $(B)/page/index.html ## simulator and asset tool as one HTML file for any browser: build/page/index.html

page-kits: page ## [BOARD=x]: the images that the page saves and flashes, for boards with an RP2040 or RP2350
	+$(Q)B='$(B)' MAKEFLAGS= $(PAGE)/kits.sh '$(B)/page/kits' $(or $(BOARD),$(MCU_BOARDS))

# The scripts in the order in which they stand in the page, and in its worker.
PAGE_SCRIPTS := $(patsubst %,$(PAGE)/page_%.mjs,wasi core address buttons glass player facts files usb flash send kit reader boards beside model tabs) \
                $(patsubst %,$(PAGE)/lesson/lesson_%.mjs,state algebra numbers world controls code fraction exercise exercise_haw exercise_pipeline exercise_kaist exercise_eece exercise_lmu exercises chapters exercise_view tab) $(PAGE)/page_main.mjs
PAGE_WORKER := $(patsubst %,$(PAGE)/page_%.mjs,wasi worker)
PAGE_WASM := $(B)/wasm/page.wasm $(B)/wasm/model.wasm
$(B)/page/index.html: $(PAGE_WASM) $(addprefix $(PAGE)/page.,sh html css) $(PAGE)/kits.sh $(PAGE_SCRIPTS) $(PAGE_WORKER)
	@mkdir -p $(@D)
	$(Q)$(PAGE)/kits.sh list >$(@D)/kits.json
	$(Q)$(PAGE)/page.sh $(PAGE)/page.html kits='$(@D)/kits.json' style=$(PAGE)/page.css wasm='$(B)/wasm/page.wasm' model_wasm='$(B)/wasm/model.wasm' \
	    modules='$(PAGE_SCRIPTS)' worker='$(PAGE_WORKER)' >$@.part && mv $@.part $@
	@echo '$@: '$$(wc -c <$@) bytes

$(PAGE_WASM) &: FORCE
	@echo 'int main(void) { return 0; }' | $(PAGE_CC) -x c - -o /dev/null 2>/dev/null && test -e /usr/include/stb/stb_image.h || \
	    { echo 'make page: no compiler for WebAssembly here, or no stb_image: apt-get install $(PAGE_NEEDS)' >&2; exit 1; }
	+$(Q)$(MAKE) --no-print-directory B='$(B)/wasm' CC='$(PAGE_CC)' AR=llvm-ar CPU=portable CFLAGS=-O2 HOST='$(PAGE_HOST)' \
	    '$(B)/wasm/page.wasm' '$(B)/wasm/model.wasm'

page_link = $(CC) $(CFLAGS) -mexec-model=reactor -Wl,--export-dynamic,--strip-all,-z,stack-size=$(1) $(filter %.o %.a,$^) -o $@
PAGE_SIM_O := $(patsubst %,$(B)/$(PAGE)/%.o,page page_flash guard)
$(B)/page.wasm: $(PAGE_SIM_O) $(LIBS)
	$(call say,LD $@)
	$(Q)$(call page_link,262144) -lc-printscan-long-double $(foreach pair,$(PAGE_WRAPPED),-Wl,--wrap=$(firstword $(subst =, ,$(pair))))

# What pinhole-sim replaces at link time, as NAME=REPLACEMENT: the linker for WebAssembly has no --defsym, so that the replacements are
# compiled under the names that it looks for.
PAGE_WRAPPED := $(shell sed -n 's/^.(B).pinhole-sim: .*--wrap=\([a-z_]*\),--defsym=__wrap_[a-z_]*=\([a-z_]*\).*/\1=\2/p' Makefile)
$(if $(findstring wasm32,$(CC)),$(eval $$(B)/host-sim/sim/%.o: DEFS += $(foreach pair,$(PAGE_WRAPPED),-D$(lastword $(subst =, ,$(pair)))=__wrap_$(firstword $(subst =, ,$(pair))))))

# A hostile model may ask for memory: 1.5 GiB are the most that the module gets.
PAGE_MODEL_O := $(call objects,$(wildcard $(PAGE)/model/*.c))
$(B)/model.wasm: $(PAGE_MODEL_O) $(LIBS)
	$(call say,LD $@)
	$(Q)$(call page_link,4194304) -Wl,--max-memory=1610612736

$(PAGE_SIM_O): INC = $(INC_HOST) $(call rooms,host-sim,sim controllers flash model asset)
$(B)/$(PAGE)/model/%.o: INC = $(INC_HOST) $(call rooms,host-sim,model model/gltf asset) -isystem /usr/include/stb
-include $(PAGE_SIM_O:.o=.d) $(PAGE_MODEL_O:.o=.d)
