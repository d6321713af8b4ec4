#!/bin/sh
# Usage: firmware/tools/budget.sh IMAGE.elf OBJECTS MAIN flash=BYTES ram=BYTES chip_ram=BYTES stack=BYTES extra=BYTES
# Prints how much an image takes of its board's flash, its budget of RAM, and its stack. Exits 1 if one of them is too
# small, or if the image has floating point, a heap or files. firmware.mk calls it. Environment: CROSS (tools' prefix).
set -eu
elf=$1 objects=$2 main=$3 # OBJECTS may hold the mains of several images; MAIN is this one's
shift 3
for pair; do
    case $pair in
    flash=* | ram=* | chip_ram=* | stack=* | extra=*) eval "${pair%%=*}=${pair#*=}" ;;
    *) echo "budget: '$pair'?" >&2 && exit 2 ;;
    esac
done
: "${flash:?}" "${ram:?}" "${chip_ram:?}" "${stack:?}" "${extra:=0}"
CROSS=${CROSS:-arm-none-eabi-}

# An image must not contain soft floating point, the heap or files.
bad=$("${CROSS}nm" "$elf" | awk '$3 ~ /^(__aeabi_[fd][a-z0-9]*|__aeabi_(ui|i|l|ul)2[fd]|__(add|sub|mul|div|float|fix|extend|trunc)[a-z]*[sd]f[a-z0-9]*|_?(malloc|calloc|realloc|free|sbrk)(_r)?|_?(printf|fopen|write|puts)(_r)?)$/ { print $3 }' | sort -u | tr '\n' ' ')
[ -z "$bad" ] || { echo "$elf: floating point, heap or files are in it: $bad" >&2 && exit 1; }

# A compiler through ccache leaves no call graph when it finds the object. Without one a function would seem to need little.
graphs=$(find "$objects" -name '*.ci' ! -name 'main-*' && find "$objects" -name "$main.ci")
lacking=$(find "$objects" -name '*.o' ! -name 'main-*' | while read -r object; do
    source=${object#"$objects/"}
    source=${source%.o}.c
    [ ! -e "$source" ] || [ -e "${object%.o}.ci" ] || echo "$source"
done | head -n 1)
[ -z "$lacking" ] || { echo "$elf: no call graph of $lacking, so the stack has no bound; make clean, then CCACHE_DISABLE=1 make ..." >&2 && exit 1; }
# shellcheck disable=SC2086 # one file a word
faults=$(awk -v library=96 -v list=1 -f "$(dirname "$0")/stack.awk" $graphs)
worst=$(echo "$faults" | awk '/^worst / { print $2 }')
if echo "$faults" | grep -qv '^worst '; then
    echo "$elf: the stack has no bound:" >&2
    echo "$faults" | grep -v '^worst ' >&2
    exit 1
fi

# Scenes are given what the rest leaves of a board's budget, so that next to nothing of it is free in a sound image.
scene=$("${CROSS}nm" -S "$elf" | awk '$4 == "image_memory" { print $2 }')
scene=$((0x${scene:-0}))

# Sections that the image occupies have the flag A. RAM starts at 0x20000000 on every Cortex-M. A section that begins within
# an earlier one borrows its memory.
"${CROSS}readelf" -SW "$elf" | sed -n 's/^ *\[ *[0-9]*\] //p' | awk -v elf="$elf" -v flash="$flash" -v ram="$ram" -v chip="$chip_ram" -v stack="$stack" -v worst="$((worst + extra))" -v scene="$scene" '
    function line(what, used, of, rest) {
        printf("%-6s %7d of %7d bytes, %d %s%s\n", what, used, of, used > of ? used - of : of - used, used > of ? "too many" : "free", rest)
        if (used > of) { over = over " " what }
    }
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
        line("flash", code, flash, "")
        line("RAM", memory, ram, (scene > 0 ? ": scenes have " scene ", the stack " stack : "") "; the chip has " chip)
        line("stack", worst, stack, " on the deepest path")
        if (ram > chip) { print elf ": the board asks for " ram " bytes of RAM, but the chip has " chip > "/dev/stderr"; exit 1 }
        if (over != "") { print elf ": over the budget of" over > "/dev/stderr"; exit 1 }
    }'
