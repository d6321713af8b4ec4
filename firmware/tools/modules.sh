#!/bin/sh
# Usage: firmware/tools/modules.sh IMAGE.map
# Prints the bytes of an image by module, the largest last, from the linker's map. `make size BOARD=x` calls it.
set -eu
awk '
    /^Linker script and memory map/ { map = 1 }
    !map { next }
    /^\.[a-z]/ { section = $1 }
    /^ [.*]/ && NF == 1 { name = $1; getline; $0 = " " name " " $0 }
    /^ \.?[A-Za-z*_.]/ && $2 ~ /^0x/ && $3 ~ /^0x/ && $4 != "" {
        bytes = hex($3)
        if (bytes == 0 || section ~ /^\.(debug|comment|ARM\.attributes|stab)/) { next }
        module = $4
        sub(/.*-objects\//, "", module)
        sub(/\.o$/, "", module)
        if (module ~ /\.a\(/) { sub(/.*\//, "", module) }
        if (section ~ /^\.(bss|stack|noinit|scratch)/) { ram[module] += bytes } else { flash[module] += bytes }
        if (section ~ /^\.(data|ram_?text)/) { ram[module] += bytes }
        all[module]
    }
    function hex(text,    i, n) {
        n = 0
        for (i = 3; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }
        return n
    }
    END {
        for (m in all) { printf "%-32s %8d %8d\n", m, flash[m], ram[m]; f += flash[m]; r += ram[m] }
        printf "%-32s %8d %8d\n", "all", f, r
    }' "$1" | sort -k2,2n -k3,3n | { printf '%-32s %8s %8s\n' module flash RAM; cat; }
