#!/usr/bin/env bash
# The ports' and panels' writes are tested: each line of tests/hal/wrong_writes/*.txt breaks one write in a copy of the tree on
# purpose. Its board's image must then fail in its emulator (of panels.txt: the simulator must), with an objection that names
# the register or the command. A line that changes nothing any more fails, too: the code has moved on, the line should follow.
#
#   what is wrong | board [VARIABLE=value of make ...] | file, from the top of the tree | sed expression
#
# Environment: B (build directory), SHARE (tap.sh), LISTS (rp2040 panels: only these).
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
here=$PWD built=$(realpath -m "${B:-build}")
tree=$built/wrong-writes
for tool in arm-none-eabi-gcc riscv64-unknown-elf-gcc node; do
    command -v "$tool" >/dev/null || { echo "no $tool here" && exit 77; }
done

# A copy of the tree with a build folder of its own; it is always at the same place, for ccache.
trap 'rm -rf "$tree"' EXIT
rm -rf "$tree" && mkdir -p "$tree/build" && cp -a Makefile firmware hal boards host-sim "$tree/" || exit 1
[ ! -e "$built/rp2040js" ] || cp -a "$built/rp2040js" "$tree/build/"
cd "$tree" || exit 1
unset B
make -s -j2 build/pinhole-sim build/pinhole-wire build/rp2350-emulate build/rp2040-registers >build/log 2>&1 || { cat build/log && exit 1; }

NOT_BUILT=99
runs() { # list, board and variables of make
    local words
    read -ra words <<<"$2"
    if [ "$1" = panels ]; then
        make -s -j2 build/pinhole-sim || return "$NOT_BUILT"
        timeout 300 build/pinhole-sim --board "${words[0]}" --demo testcard --frames 1 --crc
    else
        make -s -j2 firmware BOARD="${words[0]}" "${words[@]:1}" || return "$NOT_BUILT"
        EVENTS_ONLY=1 timeout 300 make -s emulate BOARD="${words[0]}" "${words[@]:1}" FRAMES=2
    fi
}

# A register is named with its address, as host-sim/emulate/registers does; an emulator says when it objects; a panel's command is named.
objection() { # list
    if [ "$1" = panels ]; then
        grep -E '\b[0-9A-Fa-f]{2}h\b|command' run.log
    else
        grep -E '\([0-9a-f]{8}\) (=|reads) [0-9a-f]{8}: |^emulate: at [0-9.]+ ms: ' run.log | grep -v 'locks up$\|the watchdog resets the chip$'
    fi
}

seen() { # list, board, file, sed expression
    local status=0
    cp -p "$here/$3" original && sed -i "$4" "$3" || return 1
    if cmp -s original "$3"; then
        echo "changes nothing: $4"
        return 1
    fi
    runs "$1" "$2" >run.log 2>&1 || status=$?
    cp -p original "$3" && touch "$3"
    [ "$status" != 0 ] || { echo "nobody objected" && return 1; }
    if [ "$status" = "$NOT_BUILT" ] || ! objection "$1"; then
        tail -n 5 run.log
        return 1
    fi
}

unbroken=' '
for list in "$here"/tests/hal/wrong_writes/*.txt; do
    name=$(basename "$list" .txt)
    [[ " ${LISTS:-$name} " == *" $name "* ]] || continue
    while IFS= read -r line; do
        case $line in '#'* | '') continue ;; esac
        in_share || continue
        what=${line%% | *} line=${line#* | }
        board=${line%% | *} line=${line#* | }
        file=${line%% | *} change=${line#* | }
        if [[ $unbroken != *" $name $board "* ]]; then
            check "$name: ${board}_is_not_objected_to" runs "$name" "$board"
            unbroken+="$name $board "
        fi
        check "$name: $what" seen "$name" "$board" "$file" "$change"
    done <"$list"
done
tap_end
