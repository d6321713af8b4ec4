#!/usr/bin/env bash
# The image of the Feather STM32F405 runs in QEMU, which has the chip but no display. Its stores to SPI and pins, read from
# QEMU's trace, go to a controller's model, which shows pinhole-sim's frames, byte for byte, for every demo.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
board=feather-stm32f405
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

builds() {
    make -s -j2 B="$B" "$B/pinhole-emulate" "$B/pinhole-sim" && make_image firmware BOARD="$board" >"$dir/built"
}

# Select is pressed in every second frame; the frames between show the demo move.
script() { seq 2 2 $((2 * demos)) | sed 's/$/ select/'; }

every_demo_is_the_simulators() {
    demos=$("$B/pinhole-sim" --list | grep -c '^demo') && frames=$((2 * demos + 2)) || return 1
    script >"$dir/keys"
    timeout 2000 "$B/pinhole-emulate" --machine netduinoplus2 --board "$board" --keys "$dir/keys" --log "$B/firmware/$board-demos.elf" "$dir/out" \
        "$frames" >"$dir/seen" 2>"$dir/log" || { tail -n 3 "$dir/log" && return 1; }
    "$B/pinhole-sim" --board "$board" --frames "$frames" --keys "$dir/keys" --crc >"$dir/expected" 2>/dev/null || return 1
    [ "$(wc -l <"$dir/seen")" = "$frames" ] && cmp "$dir/seen" "$dir/expected"
}

many_demos_were_seen() {
    [ "$(grep '^demo ' "$dir/log" | sort -u | wc -l)" -ge 15 ] || { grep '^demo' "$dir/log" && return 1; }
}

stack_stays_below_its_bound() {
    local used bound
    used=$(grep -o 'stack [0-9]*' "$dir/log" | awk '$2 > m { m = $2 } END { print m + 0 }') bound=$(awk '/^stack/ { print $2 }' "$dir/built")
    [ "$used" -gt 1000 ] && [ "$used" -le "$bound" ] && return
    echo "$used used, at most $bound"
    return 1
}

pictures_are_written() { cmp "$dir/out/frame-0001.ppm" <("$B/pinhole-sim" --board "$board" --start 1 --out -); }

# An image whose kit sends a command that no ILI9341 has.
what_the_panel_rejects_is_a_failure() {
    cat >"$dir/wrong.c" <<EOT
#include "board.h"
#include "port.h"
int main(void)
{
    const uint8_t wrong = 0xEE;
    const struct hal hal = port_hal();
    hal.ops->open(hal.context, board_here);
    hal.ops->bus_clock(hal.context, 1000000);
    hal.ops->delay_us(hal.context, 150000);
    port_log("demo none\\n");
    hal.ops->bus_write(hal.context, HAL_COMMAND, &wrong, 1);
    hal.ops->bus_wait(hal.context);
    for (;;) { }
}
EOT
    make_image firmware BOARD="$board" APP="$dir/wrong.c" >/dev/null || return 1
    timeout 600 "$B/pinhole-emulate" --machine netduinoplus2 --board "$board" "$B/firmware/$board-wrong.elf" >"$dir/said" 2>&1 && return 1
    cat "$dir/said"
    [ "$(wc -l <"$dir/said")" = 1 ] && grep -qi '^pinhole-emulate: .*EEh' "$dir/said"
}

check "the_image_builds" builds
check "every_demo_shows_the_simulators_frames" every_demo_is_the_simulators
check "all_demos_were_seen" many_demos_were_seen
check "the_stack_used_stays_below_the_computed_bound" stack_stays_below_its_bound
check "pictures_are_the_simulators" pictures_are_written
check "a_command_that_the_panel_does_not_know_is_told_at_once" what_the_panel_rejects_is_a_failure
tap_end
