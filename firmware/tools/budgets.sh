#!/usr/bin/env bash
# Usage: firmware/tools/budgets.sh [BOARD|arenas]
# Calculates how much RAM microcontroller kits can give to scenes: what their demos' images leave of image_ram, in steps of
# 512 bytes, but for a reserve into which code and variables may grow. Without BOARD it links the images of one board for
# each line of boards/budgets.h and writes their scene_bytes there; with BOARD (and BOARD_DIR in the environment) it says
# what that board can give. It writes what the demos' arenas take into firmware/app/arenas.inc, too, as an image in QEMU says;
# with `arenas` it prints this alone. `make budgets` calls it. Environment: B.
set -euo pipefail
cd "$(dirname "$0")/../.."
B=${B:-build} file=boards/budgets.h list=firmware/app/arenas.inc
unset MAKEFLAGS

values() { make -s -np BOARD="$1" help 2>/dev/null | sed -n "s/^$2 :*= *//p" | tail -n 1; } # of a make variable

# The least that an image of the board leaves for scenes, for any number of cores and instruction set.
scene_of() { # board
    local cores isa cores_all isas said used limit has reserve least='' elf
    cores_all=$(values "$1" PORT_CORES) isas=$(values "$1" PORT_ISAS)
    for cores in ${cores_all:-1}; do
        for isa in ${isas:-''}; do
            echo "budgets: the image of $1, cores: $cores${isa:+, $isa}" >&2
            said=$(make -s B="$B" firmware BOARD="$1" CORES="$cores" ${isa:+ISA=$isa} 2>&1 || true)
            read -r used limit has < <(sed -n 's/^RAM *\([0-9]*\) of *\([0-9]*\) bytes.*scenes have \([0-9]*\),.*/\1 \2 \3/p' <<<"$said") || { echo "$said" >&2 && return 1; }
            elf=$B/firmware/$1-demos$([ "$isa" = "${isas%% *}" ] || echo "-$isa")$([ "$cores" = 1 ] || echo "-cores$cores").elf
            reserve=768 # what runs from RAM grows with the code
            ! readelf -SW "$elf" | grep -q ' \.ram_text ' || reserve=3072 # 2 KB of code brings veneers and constants of its own
            has=$(((limit - (used - has) - reserve) / 512 * 512))
            [ -n "$least" ] && [ "$least" -lt "$has" ] || least=$has
        done
    done
    echo "$least"
}

arenas() {
    command -v qemu-system-arm >/dev/null || { echo "budgets: no qemu-system-arm: apt-get install qemu-system-arm" >&2 && return 1; }
    make -s B="$B" firmware BOARD=lm3s6965evb APP=arenas >&2 && head -n 1 "$list"
    timeout 60 qemu-system-arm -M lm3s6965evb -display none -monitor none -serial stdio -nic none -semihosting-config enable=on,target=native \
        -kernel "$B/firmware/lm3s6965evb-arenas.elf" 2>/dev/null | tr -d '\r' | grep '^{.*},$'
}

if [ "${1-}" = arenas ]; then
    arenas
    exit
fi
if [ $# = 1 ]; then
    bytes=$(scene_of "$1")
    echo "$1: scene_bytes may be $bytes"
    exit
fi
new=$(mktemp) && trap 'rm -f "$new"' EXIT
arenas >"$new"
cmp -s "$new" "$list" || cat "$new" >"$list"
cp "$file" "$new"
while read -r name was; do
    board=$(basename "$(dirname "$(grep -l "[ ,]$name," boards/*/board.c | head -n 1)")")
    bytes=$(scene_of "$board")
    units=$((bytes / 512)) change=$((bytes - was * 512))
    echo "$name: scenes have $bytes bytes$([ $change = 0 ] || printf ', %+d: about %d triangles of 24 bytes' $change $((change / 24)))"
    sed -i "s/^\(#define $name .*scene_bytes = \)[0-9]*/\1$units/" "$new"
done < <(sed -n 's/^#define \(BUDGET_[A-Z0-9]*\) .*scene_bytes = \([0-9]*\) \* 512$/\1 \2/p' "$file")
cmp -s "$new" "$file" || cat "$new" >"$file"
