#!/usr/bin/env bash
# Images for a Pico 2 run on the emulated RP2350 (hal/rp2350/emulate). Frames are pinhole-sim's, byte for byte, with one
# core and with two; the wires obey the panel; requests and faults have their effect. Any complaint of the emulator fails,
# and what an image must not do is complained about. tests/firmware/long_firmware_rp2350.sh takes every board.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build} CHIP=rp2350
board=pico2-display
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }

builds() { make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" "$B/rp2350-emulate" && image "$board" 1 && image "$board" 2; }

every_demo() { # cores
    sweep 2
    emulate "$board" "$1" $((2 * demos)) "$dir/keys" && expect "$board" $((2 * demos)) "$dir/keys" && same $((2 * demos)) || return 1
    [ "$1" != 1 ] || cp "$dir/log" "$dir/every.log"
}

any_delays() { # each frame has delays of its own between the cores. By hand a thousand: FRAMES=1000 SEED=1
    local frames=${FRAMES:-40}
    sweep 2
    awk -v frames="$frames" '$1 < frames' "$dir/keys" >"$dir/some"
    emulate "$board" 2 "$frames" "$dir/some" --delays "${SEED:-1}" --limit-ms 1000000 && expect "$board" "$frames" "$dir/some" && same "$frames"
}

both_cores_work() { # the second one a tenth of the time at least
    awk '{ load += $6 } END { print "# core 1: " load / NR " %"; exit !(load / NR >= 10) }' "$dir/out/report"
}

check "images_are_within_their_budgets" builds
check "every_demo_is_the_simulators" every_demo 1
check "two_cores_draw_the_same" every_demo 2
check "both_cores_work" both_cores_work
check "they_do_with_any_delays_between_them" any_delays
tap_end
