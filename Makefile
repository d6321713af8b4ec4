# Pinhole. `make help` lists what there is to make.
CC ?= cc
CFLAGS ?= -O2 -g
CPU ?= portable
B ?= build
V ?= 0
Q = $(if $(filter 1,$(V)),,@)

WARN = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wundef -Wcast-qual -Wwrite-strings -Wpointer-arith -Wvla
STD = -std=c11 $(WARN)

# A file under firmware/core/$(CPU)/ replaces the portable one of the same name.
CORE_CPU := $(wildcard firmware/core/$(CPU)/*.c)
CORE := $(filter-out $(patsubst firmware/core/$(CPU)/%,firmware/core/%,$(CORE_CPU)),$(wildcard firmware/core/*.c)) $(CORE_CPU)
APP := $(wildcard firmware/app/*.c)
HAL := $(wildcard hal/*.c hal/null/*.c)
BOARDS := $(wildcard boards/*.c boards/*/*.c)
SIM := $(filter-out host-sim/pinhole_%.c,$(wildcard host-sim/*.c))
INCLUDE = -Ifirmware/core/$(CPU) -Ifirmware/core -Ifirmware/app -Ihal -Iboards -Ihost-sim

LIB := $(CORE) $(APP) $(HAL) $(BOARDS) $(SIM)
OBJ = $(LIB:%.c=$(B)/%.o)
TESTS := $(patsubst tests/%.c,%,$(wildcard tests/test_*.c))

.PHONY: all demo test lint clean help
all: $(B)/pinhole-sim

$(B)/%.o: %.c
	@mkdir -p $(@D)
	$(Q)$(CC) $(STD) $(CFLAGS) $(INCLUDE) $(DEFS) -MMD -c $< -o $@

$(B)/libpinhole.a: $(OBJ)
	$(Q)rm -f $@; $(AR) rcs $@ $^

$(B)/pinhole-sim: $(B)/host-sim/pinhole_sim.o $(B)/libpinhole.a
	$(Q)$(CC) $(CFLAGS) $^ $(SIM_LIBS) -lm -o $@

$(B)/tests/%: tests/%.c $(B)/libpinhole.a
	@mkdir -p $(@D)
	$(Q)$(CC) $(STD) $(CFLAGS) $(INCLUDE) -Itests -MMD $< $(B)/libpinhole.a $(TEST_LIBS) -lcmocka -lmpfr -lgmp -lm -o $@

clean:
	rm -rf build

-include $(OBJ:.o=.d)
