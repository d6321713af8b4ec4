# Pinhole as a module of MicroPython's ports that are built by make (unix, stm32, samd, ..):
#
#     make -C ports/unix USER_C_MODULES=path/to/pinhole           # then: import pinhole
#
# USER_C_MODULES names the folder above this one. Ports that are built by CMake (rp2, esp32) take micropython.cmake of
# firmware/package/micropython. PINHOLE_CPU=armv6m, armv7m, rv32 or x86_64 takes that CPU's files of core/kernels in place of the
# portable ones: the same pictures, up to twice as fast.
PINHOLE_HERE := $(USERMOD_DIR)
PINHOLE_CPU ?= portable

pinhole_kernels := $(wildcard $(PINHOLE_HERE)/core/kernels/$(PINHOLE_CPU)/*.[cS])
pinhole_portable := $(wildcard $(PINHOLE_HERE)/core/kernels/portable/*.c)
pinhole_replaced := $(basename $(notdir $(pinhole_kernels)))
pinhole_app := $(addprefix $(PINHOLE_HERE)/app/,$(addsuffix .c,$(shell cat $(PINHOLE_HERE)/package/micropython/app.txt)))

SRC_USERMOD_C += $(wildcard $(PINHOLE_HERE)/package/micropython/*.c)
SRC_USERMOD_LIB_C += $(wildcard $(PINHOLE_HERE)/core/fx/*.c $(PINHOLE_HERE)/core/geom/*.c $(PINHOLE_HERE)/core/render/*.c $(PINHOLE_HERE)/core/effects/*.c) \
    $(filter %.c,$(pinhole_kernels)) $(foreach file,$(pinhole_portable),$(if $(filter $(basename $(notdir $(file))),$(pinhole_replaced)),,$(file))) $(pinhole_app)
SRC_USERMOD_LIB_ASM += $(filter %.S,$(pinhole_kernels))
CFLAGS_USERMOD += $(addprefix -I$(PINHOLE_HERE)/,core/kernels/$(PINHOLE_CPU) core/kernels/portable core core/render core/kernels core/fx app app/demos) -I$(PINHOLE_HERE)/../hal
