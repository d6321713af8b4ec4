#!/bin/sh
# Usage: firmware/tools/modules.sh IMAGE.map
# Prints the bytes of an image by module, the largest last, from the linker's map. What no module has of a section is the
# stack, or alignment of the next module. Objects of libgcc that do one kind of arithmetic share a row, for nobody knows
# their names. `make size` calls it.
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
        module = name_of(module)
        if (part ~ /^\.(bss|stack|noinit|scratch)/) { ram[module] += bytes } else { flash[module] += bytes }
        if (part ~ /^\.(data|ram_?text)/ || (part == ".ARM.exidx" && at >= 536870912)) { ram[module] += bytes }
        kept[part] += bytes
        all[module]
    }
    function name_of(object) {
        if (object in name_of_object) { return name_of_object[object] }
        return name_of_object[object] = known_name(object)
    }
    function known_name(object) {
        sub(/.*-objects\//, "", object)
        sub(/\.o\)?$/, "", object)
        if (object ~ /\.a\(/) { sub(/.*\//, "", object) }
        if (object ~ /^(main-[^\/]*|(.*\/)?cc[A-Za-z0-9]+)$/) { return "the program itself" } # gcc calls its object so
        if (object == "linker") { return "linker: calls between flash and RAM" }
        if (object ~ /^libgcc\.a\(/) { return "libgcc: " arithmetic(substr(object, 10)) }
        if (sub(/^lib[cg](_nano)?\.a\((lib_a-)?/, "libc: ", object)) { sub(/-.*/, "", object) } # of its variants
        sub(/^libpinhole\.a\(/, "", object)
        return object
    }
    function arithmetic(object) { # what an object of libgcc does
        if (object ~ /^_?(bpabi|_aeabi_u?ldivmod|u?(div|mod|divmod)di[34])$/) { return "64-bit division" }
        if (object ~ /^_(u?(div|mod|divmod)si[34]|dvmd_tls)$/) { return "32-bit division" }
        if (object ~ /^_(muldi3|aeabi_lmul)$/) { return "64-bit multiplication" }
        if (object ~ /^_(ashl|ashr|lshr)di3$/) { return "64-bit shifts" }
        if (object ~ /^_c[lt]z[sd]i2$/) { return "leading and trailing zeros" }
        if (object ~ /^_thumb1_case_/) { return "tables of switches" }
        if (object ~ /[sd]f/) { return "floating point" } # as in addsf3, fixdfsi
        return object
    }
    function fill(    s) {
        for (s in size) {
            at = 0
            bytes = size[s] - kept[s]
            module = s == ".stack" ? "stack" : "alignment"
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
        for (m in all) { print flash[m] + 0, ram[m] + 0, m; f += flash[m]; r += ram[m] }
        print f + 0, r + 0, "all"
    }' "$1" | sort -k1,1n -k2,2n |
    awk '
        function row(name, flash, ram) { printf "%-48s %8s %8s\n", name, flash, ram }
        BEGIN { row("module", "flash", "RAM") }
        { bytes = $1; ram = $2; sub(/^[0-9]+ [0-9]+ /, ""); row($0, bytes, ram) }'
