#!/usr/bin/env bash
# The wires of the QEMU kits are right when an image starts, ends, fails or enters the boot loader. QEMU's trace of stores
# becomes events (host-sim/wire/wire_events.h), which pinhole-wire gives to the controller's model. long_firmware_rp2040.sh
# does so for the RP2040.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# Stores in the order in which they were made; a SysTick interrupt is a millisecond. Registers: LM3S6965 data sheet and
# RM0090, as hal/lm3s6965 and hal/stm32f4 use them; D/C and chip select become the lines 0 and 1.
events() { # board
    awk -v stellaris="$([ "$1" = lm3s6965evb ] && echo 1)" '
        function hex(text,    i, n) { n = 0; for (i = 3; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }; return n }
        function flush() { if (bytes != "") { print at " spi - " hz " " hz " 0 8 " levels " " levels " " at " " bytes } bytes = "" }
        function line(bit, high) { flush(); dc = bit == 0 ? high : dc; select = bit == 1 ? high : select; levels = dc + 2 * select; print at " level " levels }
        BEGIN { at = levels = dc = select = 0; hz = 1000000; print "0 name 0 dc\n0 name 1 select" }
        /^nvic_acknowledge/ { flush(); at += 1000000 }
        !/^memory_region_ops_write/ { next }
        { address = value = ""; for (i = 1; i < NF; i++) { if ($i == "addr") { address = $(i + 1) } if ($i == "value") { value = $(i + 1) } } }
        stellaris && address == "0x40006200" { line(0, value != "0x0") }
        stellaris && address == "0x40004020" { line(1, value != "0x0") }
        stellaris && address == "0x40008010" { flush(); prescale = hex(value) }
        stellaris && address == "0x40008000" { flush(); hz = int(50000000 / prescale / (1 + int(hex(value) / 256))) }
        !stellaris && address == "0x40003800" { flush(); hz = int(16000000 / 2 ^ (1 + int(hex(value) / 8) % 8)) }
        !stellaris && address == "0x40020418" && value == "0x200" { line(0, 1) }
        !stellaris && address == "0x40020418" && value == "0x2000000" { line(0, 0) }
        !stellaris && address == "0x40020418" && value == "0x100" { line(1, 1) }
        !stellaris && address == "0x40020418" && value == "0x1000000" { line(1, 0) }
        address == (stellaris ? "0x40008008" : "0x4000380c") { bytes = bytes substr("0" substr(value, 3), length(value) - 2, 2); if (length(bytes) >= 8192) { flush() } }
        END { flush() }'
}

# An image that opens its kit, shows a frame, and then does this; its events in $dir/NAME.BOARD.events.
runs() { # board, name, C text
    local machine=lm3s6965evb null=() image=$B/firmware/$1-$2.elf
    cat >"$dir/$2.c" <<EOT
#include "runner.h"
#include "image.h"
#include "port.h"
static struct runner runner;
int main(void)
{
    const struct hal hal = port_hal();
    const struct runner_config config = {.board = board_here, .depth_format = PH_DEPTH_AUTO, .rotation = board_here->rotation, .band_height = board_here->band_height,
        .budget_bytes = board_here->scene_bytes, .demo = demo_find("cube"), .memory = image_memory, .memory_bytes = image_memory_bytes};
    ${4-}
    if (hal.ops->open(hal.context, board_here) != 0 || runner_open(&runner, &hal, &config) != 0 || runner_frame(&runner, 0) != 0 || runner_finish(&runner) != 0) { return 1; }
    $3
    return 1;
}
EOT
    make_image firmware BOARD="$1" APP="$dir/$2.c" >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
    [ "$1" = lm3s6965evb ] || { machine=netduinoplus2 && null=(-serial null -serial null); }
    timeout 10 qemu-system-arm -M "$machine" -display none -monitor none -nic none "${null[@]}" -serial "file:$dir/$2.$1.log" \
        -icount shift=5,sleep=off -semihosting-config enable=on,target=native -d guest_errors \
        -trace memory_region_ops_write -trace nvic_acknowledge_irq -D "$dir/trace" -kernel "$image" >/dev/null 2>&1
    events "$1" <"$dir/trace" >"$dir/$2.$1.events"
    grep -v '^memory_region_ops_write\|^nvic_acknowledge' "$dir/trace" >"$dir/$2.$1.errors"
    return 0
}

order() { "$B/pinhole-wire" --board "$1" --order "$2" | sed -n 's/^order \(.*\) [0-9.]* ms$/\1/p' | tr '\n' ';'; }

builds() { make -s -j2 B="$B" "$B/pinhole-wire" "$B/pinhole-sim" && runs lm3s6965evb once 'port_exit(0);' && runs feather-stm32f405 once 'port_exit(0);'; }

starts_and_ends_in_order() { # board. The model rejects what comes too early after a reset, in sleep, or with a short wait.
    local seen
    seen=$(order "$1" "$dir/once.$1.events") || return 1
    [ "$seen" = "init;first frame;display on;display off;" ] || { echo "$seen" && return 1; }
    "$B/pinhole-wire" --board "$1" "$dir/once.$1.events" | cmp - <("$B/pinhole-sim" --board "$1" --demo cube --crc)
}

waits_are_seen() { # the same stores without any time between them are rejected
    sed 's/^[0-9]* /0 /; s/ [0-9]* \([0-9a-f]*\)$/ 0 \1/' "$dir/once.feather-stm32f405.events" >"$dir/hurried"
    "$B/pinhole-wire" --board feather-stm32f405 "$dir/hurried" >"$dir/said" 2>&1 && return 1
    grep -q 'command 11h within 5 ms of reset\|SLPOUT (11h) within 120 ms of reset' "$dir/said" || { cat "$dir/said" && return 1; }
}

clock_is_the_simulators() { # the LM3S6965's; QEMU's STM32 has no crystal, so it runs at another clock
    local hz
    hz=$("$B/pinhole-sim" --board lm3s6965evb --demo cube --stats 2>&1 >/dev/null | sed -n 's/.* at \([0-9]*\) Hz.*/\1/p')
    [ "$hz" = 3125000 ] && grep -q "^[0-9]* spi - $hz $hz " "$dir/once.lm3s6965evb.events"
}

ends_asleep() { # board, events: the last commands are display off and, where there is one, sleep
    local last
    last=$(awk '$2 == "level" { dc = $3 % 2 } $2 == "spi" && !dc { print $NF }' "$2" | tr -d '\n')
    case $1 in
    lm3s6965evb) [ "${last: -2}" = ae ] ;;
    *) [ "${last: -4}" = 2810 ] ;;
    esac || { echo "${last: -16}" && return 1; }
}

fault_is_told() { # board, name, function in which it was
    local pc
    pc=$(sed -n 's/.*fault [0-9A-F]*: pc 0*\([0-9A-F]*\).*/\1/p' "$dir/$2.$1.log" | tr -d '\r' | head -n 1)
    [ -n "$pc" ] && arm-none-eabi-addr2line -f -e "$B/firmware/$1-$2.elf" "0x$pc" | grep -qx "$3" && return
    cat "$dir/$2.$1.log"
    return 1
}

fault_leaves_the_panel_dark() { # board
    runs "$1" idle '__builtin_trap();' && fault_is_told "$1" idle main && ends_asleep "$1" "$dir/idle.$1.events" &&
        [ "$(order "$1" "$dir/idle.$1.events")" = "init;first frame;display on;display off;" ]
}

fault_within_a_frame_leaves_it_dark() { # board; half of its rows are out
    runs "$1" rows 'uint16_t *rows = runner.bands[0]; if (panel_frame_begin(&runner.driver) == 0 && panel_rows(&runner.driver, rows, board_here->band_height) == 0) { __builtin_trap(); }' &&
        fault_is_told "$1" rows main && ends_asleep "$1" "$dir/rows.$1.events" &&
        [ "$(order "$1" "$dir/rows.$1.events")" = "init;first frame;display on;display off;" ]
}

fault_before_the_panel_is_open() { # board: nothing is ever shown, the display is told to be off all the same
    runs "$1" early '' '__builtin_trap();' && fault_is_told "$1" early main && ends_asleep "$1" "$dir/early.$1.events" || return 1
    ! order "$1" "$dir/early.$1.events" 2>/dev/null | grep 'display on'
}

# QEMU has no boot loader: the jump to its address, after the reset, is a fault.
boot_loader_on_request() {
    runs feather-stm32f405 boot 'port_boot_loader();' && ends_asleep feather-stm32f405 "$dir/boot.feather-stm32f405.events" || return 1
    grep -q 'address 1FFF0000' "$dir/boot.feather-stm32f405.log" && fault_is_told feather-stm32f405 boot enter_boot_loader || return 1
    grep -o 'addr 0xe000ed0c .*0x5fa0004\|addr 0xe000ed94 value 0x[05]\|addr 0x40013800 value 0x1' "$dir/trace" |
        sed 's/addr 0xe000ed0c .*/reset/; s/addr 0xe000ed94 value 0x5/guard/; s/addr 0xe000ed94 value 0x0/no guard/; s/addr 0x40013800 .*/remapped/' |
        tr '\n' ';' | tee "$dir/said" | grep -qx 'guard;reset;guard;no guard;remapped;' || { cat "$dir/said" && return 1; }
}

check "images_are_built_and_run" builds
for board in lm3s6965evb feather-stm32f405; do
    check "the_panel_of_${board}_is_dark_until_its_first_frame_and_after_the_end" starts_and_ends_in_order "$board"
    check "the_panel_of_${board}_sleeps_at_the_end" ends_asleep "$board" "$dir/once.$board.events"
    check "a_fault_on_${board}_names_its_place_and_leaves_the_panel_dark" fault_leaves_the_panel_dark "$board"
    check "a_fault_within_a_frame_on_${board}_leaves_the_panel_dark" fault_within_a_frame_leaves_it_dark "$board"
    check "a_fault_on_${board}_before_the_panel_is_open_leaves_it_dark" fault_before_the_panel_is_open "$board"
done
check "the_clock_of_lm3s6965evb_is_the_simulators" clock_is_the_simulators
check "the_boot_loader_of_the_STM32_is_entered_right_after_a_reset" boot_loader_on_request
check "stores_without_waits_would_be_rejected" waits_are_seen
tap_end
