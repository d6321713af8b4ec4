# The simulator in a browser. The Makefile includes this file.
#
#   make page                      build/page/index.html: one file, which needs no server and asks for nothing
#
# Another make compiles the simulator's sources to wasm32, in a build folder of its own.
PAGE := host-sim/page
PAGE_HOST := $(wildcard host-sim/controllers/sim*.c host-sim/controllers/*_table.c) \
             $(patsubst %,host-sim/common/%.c,complain json_text option_text) $(PAGE)/progress.c host-sim/sim/sim_list.c host-sim/sim/sim_player.c
PAGE_CC := clang --target=wasm32-wasi -fvisibility=hidden -D_WASI_EMULATED_SIGNAL

.PHONY: page FORCE
page: $(B)/page/index.html ## the simulator as one HTML file for any browser: build/page/index.html

# The scripts in the order in which they stand in the page.
PAGE_SCRIPTS := $(patsubst %,$(PAGE)/page_%.mjs,core address buttons glass player kit tabs main)
$(B)/page/index.html: $(B)/wasm/page.wasm $(PAGE)/page.sh $(PAGE)/page.html $(PAGE)/page.css $(PAGE_SCRIPTS)
	@mkdir -p $(@D)
	$(Q)$(PAGE)/page.sh $(PAGE)/page.html $(PAGE)/page.css '$<' $(PAGE_SCRIPTS) >$@.part && mv $@.part $@
	@echo '$@: '$$(wc -c <$@) bytes

$(B)/wasm/page.wasm: FORCE
	@echo 'int main(void) { return 0; }' | $(PAGE_CC) -x c - -o /dev/null 2>/dev/null || \
	    { echo 'make page: no compiler for WebAssembly here: apt-get install clang lld wasi-libc libclang-rt-dev-wasm32' >&2; exit 1; }
	+$(Q)$(MAKE) --no-print-directory B='$(B)/wasm' CC='$(PAGE_CC)' AR=llvm-ar CPU=portable CFLAGS=-O2 HOST='$(PAGE_HOST)' '$(B)/wasm/page.wasm'

$(B)/page.wasm: $(B)/$(PAGE)/page.o $(LIBS)
	$(SAY) LD $@
	$(Q)$(CC) $(CFLAGS) -mexec-model=reactor -Wl,--export-dynamic,--strip-all,-z,stack-size=262144 $^ -o $@.part && mv $@.part $@

$(B)/$(PAGE)/%.o: INC = $(INC_HOST) $(call rooms,host-sim,sim controllers)
-include $(B)/$(PAGE)/page.d
