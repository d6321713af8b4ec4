#!/usr/bin/env bash
# As tests/test_firmware_rp2040.sh: every RP2040 board, with one core and with two, every demo for some frames with its
# buttons pressed.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/.." || exit 1
. tests/tap.sh
. tests/rp2040/kit.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here

every_demo() { # board, cores
    image "$1" "$2" && sweep 4 && emulate "$1" "$2" $((4 * demos)) "$dir/keys" && expect "$1" $((4 * demos)) "$dir/keys" && same $((4 * demos))
}

# In a copy, where D/C and chip select move when DMA is done and the last words are still in the FIFO, other pictures come.
# (Only the slow clock of the panel's start shows it: a handler takes longer than 8 words at 62.5 MHz.)
a_dc_line_that_moves_early_is_seen() {
    local copy=$dir/copy
    mkdir "$copy" && cp -r Makefile firmware hal boards host-sim tests "$copy" || return 1
    sed -i '/^static void wait_for_last_bit/,/^}/ s/while (.*SSPSR_BSY.*/while (false) {/' "$copy/hal/rp2040/spi.c"
    ! cmp -s hal/rp2040/spi.c "$copy/hal/rp2040/spi.c" && expect pico-display 2 || return 1
    mkdir -p "$copy/$B" && cp -r "$B/rp2040js" "$copy/$B" && cp "$B/pinhole-wire" "$copy/$B" || return 1
    (cd "$copy" && image pico-display 1) || return 1
    (cd "$copy" && emulate pico-display 1 2) || return 0
    ! same 2 >/dev/null
}

make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1
for mk in boards/*/board.mk; do
    grep -q '^PORT = rp2040' "$mk" || continue
    board=$(basename "$(dirname "$mk")")
    for cores in 1 2; do
        check "every_demo_is_the_simulators_on_${board}_with_$cores" every_demo "$board" $cores
    done
done
check "a_dc_line_that_moves_early_is_seen" a_dc_line_that_moves_early_is_seen
tap_end
