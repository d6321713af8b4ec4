#!/usr/bin/env bash
# Usage: tests/tools/program_size.sh PROGRAM.c...
# The bytes of code and constants of a program that draws with firmware/core, module by module, on a Cortex-M0+ at -Os: with
# libgcc and libc, without the chip's start code. `make size PROGRAM=FILE.c` calls it.
# Environment: B (build directory), CROSS (tool prefix), PROFILE (whole or small).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} CROSS=${CROSS:-arm-none-eabi-}
[ $# -gt 0 ] || { echo "Usage: tests/tools/program_size.sh PROGRAM.c..." >&2 && exit 2; }
command -v "${CROSS}gcc" >/dev/null || { echo "size: no ${CROSS}gcc here; apt-get install gcc-arm-none-eabi" >&2 && exit 1; }

flags=(-mcpu=cortex-m0plus -mthumb -Os -ffunction-sections -fdata-sections)
to=$B/m0plus-os cpu=(CPU=armv6m) more=(-Ifirmware/core/kernels/armv6m)
[ "${PROFILE:-whole}" = whole ] || { to=$to-$PROFILE && cpu=("PROFILE=$PROFILE") && more=(-DPH_PROFILE_SMALL -Ifirmware/core/render/small); }
make -s -j"$(nproc)" B="$to" CC="${CROSS}gcc" "${cpu[@]}" KIT= CFLAGS="${flags[*]} -ffreestanding" "$to/libpinhole.a" >&2
"${CROSS}gcc" -std=c11 "${flags[@]}" -Wall -Wextra -Ifirmware/core "${more[@]}" -Ifirmware/core/kernels/portable \
    -nostartfiles --specs=nano.specs -Wl,-e,main,--gc-sections,--fatal-warnings,-Map,"$to/program.map" "$@" "$to/libpinhole.a" \
    -o "$to/program.elf"
firmware/tools/modules.sh "$to/program.map"
