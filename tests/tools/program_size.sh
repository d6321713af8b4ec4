#!/usr/bin/env bash
# Usage: tests/tools/program_size.sh PROGRAM.c...
# The bytes of code and constants of a program that draws with firmware/core, module by module, on a Cortex-M0+ at -Os: with
# libgcc and libc, without the chip's start code. `make size PROGRAM=FILE.c` calls it.
# Environment: B (build directory), CROSS (tool prefix).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} CROSS=${CROSS:-arm-none-eabi-}
[ $# -gt 0 ] || { echo "Usage: tests/tools/program_size.sh PROGRAM.c..." >&2 && exit 2; }
command -v "${CROSS}gcc" >/dev/null || { echo "size: no ${CROSS}gcc here; apt-get install gcc-arm-none-eabi" >&2 && exit 1; }

flags=(-mcpu=cortex-m0plus -mthumb -Os -ffunction-sections -fdata-sections)
make -s -j"$(nproc)" B="$B/m0plus-os" CC="${CROSS}gcc" CPU=armv6m KIT= CFLAGS="${flags[*]} -ffreestanding" "$B/m0plus-os/libpinhole.a" >&2
"${CROSS}gcc" -std=c11 "${flags[@]}" -Wall -Wextra -Ifirmware/core -Ifirmware/core/kernels/armv6m -Ifirmware/core/kernels/portable \
    -nostartfiles --specs=nano.specs -Wl,-e,main,--gc-sections,--fatal-warnings,-Map,"$B/m0plus-os/program.map" "$@" "$B/m0plus-os/libpinhole.a" \
    -o "$B/m0plus-os/program.elf"
firmware/tools/modules.sh "$B/m0plus-os/program.map"
