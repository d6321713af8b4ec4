#!/usr/bin/env bash
# Like tests/firmware/long_firmware_rp2040.sh for every RP2040 board, with one core and with two: every demo for some frames,
# with buttons pressed. A demo that the cores draw in the time of a whole frame on the bus takes at most 1.03 times as long.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here

every_demo() { # board, cores
    image "$1" "$2" && sweep 4 && emulate "$1" "$2" $((4 * demos)) "$dir/keys" && expect "$1" $((4 * demos)) "$dir/keys" && same $((4 * demos))
}

on_the_bus() { awk '{ us += $3 } END { printf "%.0f\n", us / NR }' "$dir/out/report"; } # us a frame

# CHANGES=0 sends whole frames of the same pictures; CHANGES=1 sends less.
whole_frames() {
    local bus whole less
    bus=$("$B/pinhole-sim" --board pico-display --demo cube --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')
    sweep 4 && CHANGES=0 image pico-display 1 && CHANGES=0 emulate pico-display 1 $((4 * demos)) "$dir/keys" &&
        expect pico-display $((4 * demos)) "$dir/keys" && same $((4 * demos)) && whole=$(on_the_bus) || return 1
    image pico-display 1 && emulate pico-display 1 $((4 * demos)) "$dir/keys" && less=$(on_the_bus) || return 1
    echo "# a frame takes $bus us on the bus; $whole with CHANGES=0, $less with CHANGES=1"
    [ $((100 * whole)) -ge $((97 * bus)) ] && [ $((100 * whole)) -le $((103 * bus)) ] && [ $((100 * less)) -le $((85 * bus)) ]
}

within_the_bar() { IDEAL=0 host-sim/emulate/speed_rp2.sh "$1" 2 >"$dir/speed" 2>&1 || { cat "$dir/speed" && return 1; }; }

# Some of the demos, with one core and with two, are as fast as the table in tests/bench/README.md says, and it has all.
as_in_the_table() { speed_agrees $# pico-display 6 "$@"; }

# shellcheck disable=SC2016 # backquotes of Markdown
the_table_has_all() { listed | diff - <(sed -n 's/^| `\([a-z]*\)` |.*%.*/\1/p' tests/bench/README.md); }

listed() { "$B/pinhole-sim" --list | awk '$1 == "demo" && !/; by name only$/ { print $2 }'; }

# In a copy D/C and chip select move when the DMA is done, while the last words are still in the FIFO. The pictures change.
# Only the slow clock of the panel's start shows a D/C line that moves early, for a handler takes longer than 8 words at 62.5 MHz.
a_dc_line_that_moves_early_is_seen() {
    local copy=$dir/copy
    mkdir "$copy" && cp -r Makefile firmware hal boards host-sim tests "$copy" || return 1
    sed -i '/static void wait_for_last_bit/,/^}/ s/while (.*SSPSR_BSY.*/while (false) {/' "$copy/hal/chips/rp2/spi.c"
    ! cmp -s hal/chips/rp2/spi.c "$copy/hal/chips/rp2/spi.c" && expect pico-display 2 || return 1
    mkdir -p "$copy/$B" && cp -r "$B/rp2040js" "$copy/$B" && cp "$B/pinhole-wire" "$copy/$B" || return 1
    (cd "$copy" && image pico-display 1) || return 1
    (cd "$copy" && emulate pico-display 1 2) || return 0
    ! same 2 >/dev/null
}

make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1
# What takes long takes turns.
boards=()
for mk in boards/*/board.mk; do
    ! grep -q 'families/pico.mk' "$mk" || boards+=("$(basename "$(dirname "$mk")")")
done
for board in "${boards[@]}"; do
    for cores in 1 2; do
        ! in_share || check "every_demo_is_the_simulators_on_${board}_with_$cores" every_demo "$board" $cores
    done
done
for board in "${boards[@]}"; do
    [ "$board" = pico-display ] || ! in_share || check "a_demo_that_fits_the_time_of_the_bus_takes_no_longer_on_$board" within_the_bar "$board"
done
check "the_table_has_a_row_for_each_demo" the_table_has_all
for ((i = 0; i < 12; i++)); do # every twelfth demo, for the slow ones stand side by side
    mapfile -t group < <(listed | awk -v i=$i '(NR - 1) % 12 == i')
    ! in_share || check "$(tr ' ' _ <<<"${group[*]}")_are_as_in_the_table" as_in_the_table "${group[@]}"
done
! in_share || check "without_CHANGES_frames_are_whole" whole_frames
! in_share || check "a_dc_line_that_moves_early_is_seen" a_dc_line_that_moves_early_is_seen
tap_end
