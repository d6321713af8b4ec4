#!/bin/sh
# Usage: firmware/tools/budget.sh IMAGE.elf BOARD flash=BYTES ram=BYTES chip_ram=BYTES stack=BYTES
# Prints how much an image takes of its board's flash and of the RAM that the board allows (0: all of the chip's). Exits 1
# if one of them is too small, or if the image has floating point, a heap or files. firmware.mk calls it.
# Environment: CROSS (prefix of the tools' names).
set -eu
elf=$1 board=$2
shift 2
for pair; do
    case $pair in
    flash=* | ram=* | chip_ram=* | stack=*) eval "${pair%%=*}=${pair#*=}" ;;
    *) echo "budget: '$pair'?" >&2 && exit 2 ;;
    esac
done
: "${flash:?}" "${ram:?}" "${chip_ram:?}" "${stack:?}"
CROSS=${CROSS:-arm-none-eabi-}

# An image must not contain soft floating point, the heap or files.
bad=$("${CROSS}nm" "$elf" | awk '$3 ~ /^(__aeabi_[fd][a-z0-9]*|__aeabi_(ui|i|l|ul)2[fd]|__(add|sub|mul|div|float|fix|extend|trunc)[a-z]*[sd]f[a-z0-9]*|_?(malloc|calloc|realloc|free|sbrk)(_r)?|_?(printf|fopen|write|puts)(_r)?)$/ { print $3 }' | sort -u | tr '\n' ' ')
[ -z "$bad" ] || { echo "$elf: floating point, heap or files are in it: $bad" >&2 && exit 1; }

scene=$("${CROSS}nm" -S "$elf" | awk '$4 == "image_memory" { print $2 }')
scene=$((0x${scene:-0}))

# Sections that the image occupies have the flag A. RAM starts at 0x20000000 on every Cortex-M. A section that begins within
# an earlier one borrows its memory.
"${CROSS}readelf" -SW "$elf" | sed -n 's/^ *\[ *[0-9]*\] //p' | awk -v elf="$elf" -v board="$board" -v flash="$flash" -v ram="$ram" -v chip="$chip_ram" -v stack="$stack" -v scene="$scene" '
    function line(what, used, of, rest) { printf("%-6s %7d of %7d bytes, %d %s%s\n", what, used, of, used > of ? used - of : of - used, used > of ? "too many" : "free", rest) }
    function over(what, bytes, cure) { printf("%s: %d bytes over the %s of %s: %s\n", elf, bytes, what, board, cure) > "/dev/stderr"; wrong = 1 }
    function hex(text,    i, n) { n = 0; for (i = 1; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }; return n }
    $7 !~ /A/ { next }
    $2 != "NOBITS" { code += hex($5) }
    hex($3) >= 536870912 && hex($5) > 0 {
        for (i = 0; i < n; i++) { if (hex($3) >= from[i] && hex($3) < to[i]) { next } }
        from[n] = hex($3)
        to[n++] = hex($3) + hex($5)
        memory += hex($5)
    }
    END {
        if (ram == 0) { ram = chip }
        line("flash", code, flash, "")
        line("RAM", memory, ram, ": " (scene > 0 ? "scenes have " scene ", " : "") "the stack " stack "; the chip has " chip)
        printf("stack  %7d bytes: those of the deepest path\n", stack)
        if (ram > chip) { printf("%s: %s allows %d bytes of RAM, but the chip has %d: correct image_ram of its board.c, or CHIP_RAM_BYTES of its board.mk\n", elf, board, ram, chip) > "/dev/stderr"; exit 1 }
        if (code > flash) { over("flash", code - flash, "take less into the image, such as a model with fewer triangles (SCENE_TRIANGLES) or a smaller texture (SCENE_TEXTURE)") }
        if (memory > ram) {
            over("RAM", memory - ram, scene > memory - ram ? "give scenes so much less, in scene_bytes of its board.c or by `make budgets`: that is about " int((memory - ram + 23) / 24) " triangles of 24 bytes" : "take fewer variables and buffers into the program")
        }
        exit wrong
    }'
