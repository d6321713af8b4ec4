#!/usr/bin/env bash
# Usage: tests/tools/size.sh
# Code size of firmware/core for a Cortex-M0+ with the flags of its kits, module by module; exits 1 over the budget. `make size` calls it.
# Environment: B (build directory), BUDGET (bytes of code and constants), CROSS (tool prefix).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} CROSS=${CROSS:-arm-none-eabi-} BUDGET=${BUDGET:?bytes}
command -v "${CROSS}gcc" >/dev/null || { echo "size: no ${CROSS}gcc here; apt-get install gcc-arm-none-eabi" >&2 && exit 1; }

make -s -j"$(nproc)" B="$B/m0plus" CC="${CROSS}gcc" CPU=armv6m KIT=1 \
    CFLAGS="-mcpu=cortex-m0plus -mthumb -O2 -ffreestanding -ffunction-sections -fdata-sections" core-objects >&2
find "$B/m0plus/firmware/core" -name '*.o' | sort | xargs "${CROSS}size" | awk -v budget="$BUDGET" '
    NR == 1 { printf "%-24s %6s %6s %6s\n", "firmware/core, M0+", "code", "data", "bss"; next }
    {
        name = $6
        sub(/.*firmware\/core\//, "", name)
        sub(/\.o$/, "", name)
        printf "%-24s %6d %6d %6d\n", name, $1, $2, $3
        code += $1; written += $2 + $3
    }
    END {
        printf "%-24s %6d of %d bytes\n", "all", code, budget
        if (written > 0) { print "size: something in the core is mutable at file scope" > "/dev/stderr"; exit 1 }
        if (code > budget) { print "size: over the budget" > "/dev/stderr"; exit 1 }
    }'
