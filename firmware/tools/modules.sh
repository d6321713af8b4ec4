#!/bin/sh
# Usage: firmware/tools/modules.sh IMAGE.map
# Prints the bytes of an image by module, the largest last, from the linker's map. What no module has of a section is the
# stack, or fill: it brings the next module to its alignment. `make size BOARD=x` calls it.
set -eu
awk '
    /^Linker script and memory map/ { map = 1 }
    !map { next }
    /^\.[A-Za-z]/ { count(hex($2)); bytes = 0; section = $1; size[section] = hex($3) }
    /^ [.*]/ && NF == 1 && !/\(/ { name = $1; getline; $0 = " " name " " $0 }
    /^ \.?[A-Za-z*_.]/ && $2 ~ /^0x/ && $3 ~ /^0x/ && $4 != "" {
        count(hex($2))
        at = hex($2); bytes = hex($3); module = $4; part = section
    }
    # The section before this address. Merged strings may stand with their size before: they end where the next begins.
    function count(end) {
        if (end >= at && end < at + bytes) { bytes = end - at }
        if (bytes == 0 || part ~ /^\.(debug|comment|[A-Za-z]*\.attributes|stab)/) { return }
        sub(/.*-objects\//, "", module)
        sub(/\.o$/, "", module)
        if (module ~ /\.a\(/) { sub(/.*\//, "", module) }
        if (part ~ /^\.(bss|stack|noinit|scratch)/) { ram[module] += bytes } else { flash[module] += bytes }
        if (part ~ /^\.(data|ram_?text)/ || (part == ".ARM.exidx" && at >= 536870912)) { ram[module] += bytes }
        kept[part] += bytes
        all[module]
    }
    function fill(    s) {
        for (s in size) {
            at = 0
            bytes = size[s] - kept[s]
            module = s == ".stack" ? "stack" : "fill"
            part = s
            count(bytes)
        }
    }
    function hex(text,    i, n) {
        n = 0
        for (i = 3; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }
        return n
    }
    END {
        count(0)
        fill()
        for (m in all) { printf "%-32s %8d %8d\n", m, flash[m], ram[m]; f += flash[m]; r += ram[m] }
        printf "%-32s %8d %8d\n", "all", f, r
    }' "$1" | sort -k2,2n -k3,3n | { printf '%-32s %8s %8s\n' module flash RAM; cat; }
