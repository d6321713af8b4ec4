#!/usr/bin/env bash
# Prints the table of firmware/README.md, "A chip of 32 KB of flash": what a Gouraud program takes on a Cortex-M0+ with the
# whole library and with the small profile, in bytes. test_small.sh compares.
set -eu
cd "$(dirname "$0")/../.."
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT

flash_of() { PROFILE=$1 tests/tools/program_size.sh tests/size/gouraud.c | awk '$1 == "all" { print $2 }'; } # profile

sizes_of() { # flags...: struct ph_renderer, a vertex, a reference
    echo '#include "list.h"
char renderer[sizeof(struct ph_renderer)], vertex[PH_VERTEX_BYTES_32], reference[PH_REFERENCE_BYTES];' >"$dir/sizes.c"
    arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb "$@" -Ifirmware/core -Ifirmware/core/kernels{,/portable} -Ifirmware/core/render -fno-common -c "$dir/sizes.c" -o "$dir/sizes.o"
    for name in renderer vertex reference; do arm-none-eabi-nm -S "$dir/sizes.o" | awk -v name=$name '$4 == name { printf "%d\n", "0x" $2 }'; done
}
# shellcheck disable=SC2046 # words are numbers
set -- $(sizes_of) $(sizes_of -DPH_PROFILE_SMALL -Ifirmware/core/render/small)
echo "| \`tests/size/small_table.sh\` | whole | \`PROFILE=small\` |"
echo "|---|---|---|"
echo "| code and tables of tests/size/gouraud.c on a Cortex-M0+ | $(flash_of whole) | $(flash_of small) |"
echo "| \`struct ph_renderer\` | $1 | $4 |"
echo "| a vertex | $2 | $5 |"
echo "| a triangle that can be seen | $3 | 0 |"
