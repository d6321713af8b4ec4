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
    image "$1" "$2" && sweep 6 && emulate "$1" "$2" $((6 * demos)) "$dir/keys" && expect "$1" $((6 * demos)) "$dir/keys" && same $((6 * demos))
}

make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1
for mk in boards/*/board.mk; do
    grep -q '^PORT = rp2040' "$mk" || continue
    board=$(basename "$(dirname "$mk")")
    for cores in 1 2; do
        check "every_demo_is_the_simulators_on_${board}_with_$cores" every_demo "$board" $cores
    done
done
tap_end
