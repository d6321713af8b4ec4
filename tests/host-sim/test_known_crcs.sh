#!/usr/bin/env bash
# The table of known CRCs, with which people's reports are compared (firmware/app/self_test.c), is what pinhole-sim draws,
# and has the size of every board.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
make -s -j2 B="$B" "$B/pinhole-sim" || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# "240 135 E7B4F73C 99FF17F2" a row: width, height, cube, testcard.
grep -oE '\{[0-9]+, +[0-9]+, +\{0x[0-9A-F]{8}, +0x[0-9A-F]{8}\}\}' firmware/app/self_test.c | sed 's/0x//g' | tr -cs '0-9A-F\n' ' ' |
    sed 's/^ //; s/ $//' >"$dir/known"

crc() { "$B/pinhole-sim" --size "$1" --demo "$2" --frames 1 --crc | cut -d' ' -f4; }

rows_are_drawn() { # file
    local width height cube card
    [ "$(wc -l <"$1")" -ge 18 ] || { echo "$(wc -l <"$1") rows" && return 1; }
    while read -r width height cube card; do
        [ "$(crc "${width}x$height" cube) $(crc "${width}x$height" testcard)" = "$cube $card" ] || { echo "${width}x$height" && return 1; }
    done <"$1"
}

a_wrong_row_is_seen() { sed '3s/.$/x/' "$dir/known" >"$dir/wrong" && ! rows_are_drawn "$dir/wrong"; }

every_board_has_its_size() {
    local board size
    for board in $("$B/pinhole-sim" --list | awk '$1 == "board" { print $2 }'); do
        size=$("$B/pinhole-sim" --board "$board" --demo cube --frames 1 --out - | head -n 2 | tail -n 1)
        grep -q "^$size " "$dir/known" || { echo "$board: no $size" && return 1; }
    done
}

check "the known CRCs are those of pinhole-sim" rows_are_drawn "$dir/known"
check "... a wrong one is seen" a_wrong_row_is_seen
check "every board's size is there" every_board_has_its_size
tap_end
