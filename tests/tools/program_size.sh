#!/usr/bin/env bash
# Usage: tests/tools/program_size.sh PROGRAM.c...
# The bytes of code and constants of a program that draws with firmware/core, module by module, on a Cortex-M0+ at -Os: with
# libgcc and libc, without the chip's start code. `make size PROGRAM=FILE.c` calls it.
# Environment: B (build directory), CROSS (tool prefix), PROFILE (whole or small), CORE (m0plus; m3, m33 or rv32).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} CORE=${CORE:-m0plus} library=(--specs=nano.specs)
case $CORE in
m0plus) cpu=armv6m flags=(-mcpu=cortex-m0plus -mthumb) ;;
m3) cpu=armv7m flags=(-mcpu=cortex-m3 -mthumb) ;;
m33) cpu=armv7m flags=(-mcpu=cortex-m33 -mthumb) ;;
rv32) cpu=rv32 flags=(-march=rv32imac -mabi=ilp32) CROSS=${CROSS:-riscv64-unknown-elf-} library=(-nostdlib '-Wl,--no-warn-rwx-segments' firmware/bare/memory.c -lgcc) ;;
*) echo "size: CORE=$CORE: take m0plus, m3, m33 or rv32" >&2 && exit 2 ;;
esac
CROSS=${CROSS:-arm-none-eabi-}
[ $# -gt 0 ] || { echo "Usage: tests/tools/program_size.sh PROGRAM.c..." >&2 && exit 2; }
command -v "${CROSS}gcc" >/dev/null || { echo "size: no ${CROSS}gcc here; apt-get install gcc-${CROSS%-}" >&2 && exit 1; }

flags+=(-Os -ffunction-sections -fdata-sections)
to=$B/$CORE-os make=("CPU=$cpu") more=("-Ifirmware/core/kernels/$cpu")
[ "${PROFILE:-whole}" = whole ] || { to=$to-$PROFILE && make=("PROFILE=$PROFILE") && more=(-DPH_PROFILE_SMALL -Ifirmware/core/render/small); }
[ "$CORE" != rv32 ] || flags+=(-isystem firmware/bare/include -ffreestanding)
make -s -j"$(nproc)" B="$to" CC="${CROSS}gcc" "${make[@]}" KIT= CFLAGS="${flags[*]} -ffreestanding" "$to/libpinhole.a" >&2
"${CROSS}gcc" -std=c11 "${flags[@]}" -Wall -Wextra -Ifirmware/core "${more[@]}" -Ifirmware/core/kernels/portable \
    -nostartfiles -Wl,-e,main,--gc-sections,--fatal-warnings,-Map,"$to/program.map" "$@" "$to/libpinhole.a" "${library[@]}" \
    -o "$to/program.elf"
firmware/tools/modules.sh "$to/program.map"
