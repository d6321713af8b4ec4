#!/usr/bin/env bash
# Usage: tests/tools/size.sh
# Code size of firmware/core for a Cortex-M0+, module by module: what an image links of it that has everything of firmware/app,
# and all that there is. Exits 1 when what is linked is over the budget. `make size` calls it.
# Environment: B (build directory), BUDGET (bytes of code and constants), CROSS (tool prefix).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} CROSS=${CROSS:-arm-none-eabi-} BUDGET=${BUDGET:?bytes}
command -v "${CROSS}gcc" >/dev/null || { echo "size: no ${CROSS}gcc here; apt-get install gcc-arm-none-eabi" >&2 && exit 1; }

make -s -j"$(nproc)" B="$B/m0plus" CC="${CROSS}gcc" CPU=armv6m \
    CFLAGS="-mcpu=cortex-m0plus -mthumb -Os -ffreestanding -ffunction-sections -fdata-sections" firmware-objects >&2
mapfile -t core < <(find "$B/m0plus/firmware/core" -name '*.o' | sort)
mapfile -t app < <(find "$B/m0plus/firmware/app" -name '*.o')

# The linker keeps what firmware/app calls of the core, and what that calls.
mapfile -t called < <(comm -12 <("${CROSS}nm" -u "${app[@]}" | awk 'NF == 2 { print $2 }' | sort -u) \
    <("${CROSS}nm" -g --defined-only "${core[@]}" | awk 'NF == 3 { print $3 }' | sort -u))
"${CROSS}ld" -r --gc-sections "${called[@]/#/-u}" "${core[@]}" -Map "$B/m0plus/core.map" -o "$B/m0plus/core.o"
"${CROSS}size" "${core[@]}" | awk -v budget="$BUDGET" '
    function module(path) { sub(/.*firmware\/core\//, "", path); sub(/\.o$/, "", path); return path }
    function hex(text,    i, n) {
        for (i = 3; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }
        return n
    }
    FILENAME != "-" {
        if (/^Linker script and memory map/) { kept = 1 }
        if (NF == 1) { name = $1; getline; $0 = name " " $0 }
        if (kept && $1 ~ /^\.(text|rodata|data|bss)/ && $3 ~ /^0x/ && NF == 4) { linked[module($4)] += hex($3) }
        next
    }
    FNR == 1 { printf "%-24s %6s %6s %6s %6s\n", "firmware/core, M0+ -Os", "linked", "all", "data", "bss"; next }
    {
        name = module($6)
        printf "%-24s %6d %6d %6d %6d\n", name, linked[name], $1, $2, $3
        code += linked[name]; all += $1; written += $2 + $3
    }
    END {
        printf "%-24s %6d of %d bytes linked, %d in all\n", "all", code, budget, all
        if (written > 0) { print "size: something in the core is mutable at file scope" > "/dev/stderr"; exit 1 }
        if (code > budget) { print "size: over the budget" > "/dev/stderr"; exit 1 }
    }' "$B/m0plus/core.map" -
