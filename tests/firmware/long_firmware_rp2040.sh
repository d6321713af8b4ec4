#!/usr/bin/env bash
# Images for RP2040 kits run on the emulated chip (rp2040js with SPI time, see host-sim/emulate/rp2040). Frames are pinhole-sim's,
# byte for byte, with one core and with two; the wires obey the panel; requests and faults have their effect. Any warning
# of the emulator fails. tests/firmware/long_boards_rp2040.sh takes every board.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
board=pico-display
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here

builds() { make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" && image "$board" 1 && image "$board" 2 && image waveshare-pico-lcd-0in96 1; }

every_demo() { # cores
    sweep 2
    emulate "$board" "$1" $((2 * demos)) "$dir/keys" && expect "$board" $((2 * demos)) "$dir/keys" && same $((2 * demos)) || return 1
    [ "$1" != 1 ] || cp "$dir/log" "$dir/every.log"
}

# Two frames of every demo, each with delays of its own between the cores. By hand a thousand: FRAMES=1000 SEED=1
# tests/firmware/long_firmware_rp2040.sh
any_delays() {
    local frames
    sweep 2
    frames=${FRAMES:-$((2 * demos))}
    [ "$frames" -le $((2 * demos)) ] || sweep $((frames / demos))
    awk -v frames="$frames" '$1 < frames' "$dir/keys" >"$dir/some"
    emulate "$board" 2 "$frames" "$dir/some" --delays "${SEED:-1}" --limit-ms 10000000 && expect "$board" "$frames" "$dir/some" && same "$frames"
}

both_cores_work() { # the second one a tenth of the time at least
    awk '{ load += $6 } END { print "# core 1: " load / NR " %"; exit !(load / NR >= 10) }' "$dir/out/report"
}

order_is() { # the steps of power-on in pinhole-wire --order
    "$B/pinhole-wire" --board "$1" --order "$dir/out/events" | awk '$1 == "order" { print $2, $3 }' | tr '\n' ';' | grep -q "$2"
}

# Two cores draw the turntable in less than a whole frame takes on this board's bus, and it does not take longer.
overlap() {
    local alone us bus
    image pico-display-2 2 >/dev/null || return 1
    bus=$("$B/pinhole-sim" --board pico-display-2 --demo turntable --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')
    alone=$(frame_us pico-display-2 2 --free-wire) && us=$(frame_us pico-display-2 2) || return 1
    echo "# the cores alone $alone us a frame, a whole frame on the bus $bus us, both $us us"
    [ "$alone" -le "$bus" ] && [ $((100 * us)) -le $((103 * bus)) ]
}

# Two demos with one core, as `make speed` measures them, are as in the table of tests/bench/README.md.
speed_is_that_of_the_paper() { CORES=1 speed_agrees 2 "$board" 6 turntable cube && grep -q '^{"demo": "cube", "cores": 1, "fps": [0-9]' "$B/speed/$board.json"; }

other_speeds_are_seen() { # frame rates of 4 % more, or a demo too few
    awk -F, -v OFS=, 'NR > 1 { $3 *= 1.04 } { print }' "$B/speed/$board.csv" >"$dir/faster"
    speed_as_in tests/bench/README.md 2 <"$B/speed/$board.csv" && ! speed_as_in tests/bench/README.md 2 <"$dir/faster" &&
        ! speed_as_in tests/bench/README.md 3 <"$B/speed/$board.csv"
}

a_pin_is_a_button() { # GP14, left on this kit, from frame 3 to 4
    echo '3 left 2' >"$dir/keys"
    emulate "$board" 1 7 - --press 2:14 --press 4: && expect "$board" 7 "$dir/keys" && same 7 && expect "$board" 7 && ! same 7
}

ended() { grep -q "^emulate: ended in frame $1: $2\$" "$dir/log" || { tail -n 5 "$dir/log" && return 1; }; }

boot_loader_on_request() { emulate "$board" 1 9 - --send 1:B && ended 1 'boot loader' && dark; }

boot_loader_by_a_button() { EVENTS_ONLY=1 emulate "$board" 1 9 - --press=-1:12 && ended -1 'boot loader'; }

dark() { # the backlight, GP20, is off at the end
    local last
    last=$(awk '$2 == "level" { print $3 }' "$dir/out/events" | tail -n 1)
    [ $((0x$last >> 20 & 1)) = 0 ]
}

fault_is_told() {
    emulate "$board" 1 9 - --fault 2 && ended 2 'every core sleeps for ever' && grep -q '^fault at 0x[12]00[0-9a-f]*, called from 0x' "$dir/log" && dark
}

# An image that shows a frame and then does this; its name is $1, its number of cores $2, the C text $3.
image_that() {
    cat >"$dir/$1.c" <<EOT
#include "runner.h"
#include "image.h"
#include "port.h"
static struct runner runner;
static void overrun(void *nothing) /* called as run */ { (void)nothing; for (;;) { __asm volatile("push {r0-r7}"); } }
static void busy(void *us) /* called as run */ { const struct hal hal = port_hal(); const uint32_t from = hal.ops->time_us(hal.context); while (hal.ops->time_us(hal.context) - from < (uint32_t)us) { } }
int main(void)
{
    const struct hal hal = port_hal();
    const struct runner_config config = {.board = board_here, .depth_format = PH_DEPTH_AUTO, .rotation = board_here->rotation, .band_height = board_here->band_height,
        .budget_bytes = board_here->scene_bytes, .demo = demo_find("cube"), .memory = image_memory, .memory_bytes = image_memory_bytes};
    if (hal.ops->open(hal.context, board_here) != 0 || runner_open(&runner, &hal, &config) != 0 || runner_frame(&runner, 0) != 0 || runner_finish(&runner) != 0) { return 1; }
    (void)overrun;
    (void)busy;
    $3
    return 0;
}
EOT
    make_image firmware BOARD="$board" APP="$dir/$1.c" CORES="$2" >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
    local elf=$B/firmware/$board-$1.elf
    [ "$2" = 1 ] || elf=$B/firmware/$board-$1-cores$2.elf
    rm -rf "$dir/out"
    EVENTS_ONLY=1 BOARD="$board" CORES="$2" host-sim/emulate/emulate_rp2.sh "$elf" "$dir/out" 9 --limit-ms 3000 >/dev/null 2>"$dir/log"
}

overrun_ends_dark() { # core, cores, C text; the panel is lit until then, and 0.8 s later it is dark for good
    image_that "over$1" "$2" "$3" && ended 0 'every core sleeps for ever' && dark && ends_at_the_reset && return
    cat "$dir/log"
    return 1
}

ends_at_the_reset() {
    grep -q '^the watchdog bit' "$dir/log" && awk '
        / locks up$/ { split($0, word, "[: ]+"); locked = word[3] }
        / resets the chip$/ { split($0, word, "[: ]+"); if (word[3] - locked > 750) { exit 1 } resets++ }
        END { exit !(resets == 1 && locked > 0) }' "$dir/log"
}

work_is_no_lockup() { # 0.8 s without a call of the port, on both cores
    image_that busy 2 'port_core_run(busy, (void *)800000); busy((void *)800000); port_core_join();' && ended 0 exit && ! grep -q watchdog "$dir/log"
}

stack_stays_below_its_bound() { # the lowest that a stack pointer was, in the run of every demo; reserved: see port.mk
    local top lowest bound
    top=$(arm-none-eabi-nm "$B/firmware/$board-demos.elf" | awk '$3 == "ld_stack_top" { print $1 }')
    lowest=$(sed -n 's/^emulate: core 0: lowest stack //p' "$dir/every.log")
    bound=$(image "$board" 1 | awk '/^stack/ { print $2 }')
    echo "# $((0x$top - 0x$lowest)) used, at most $bound"
    [ $((0x$top - 0x$lowest)) -gt 1000 ] && [ $((0x$top - 0x$lowest)) -le "$bound" ]
}

flipped_bit_in_boot2_is_refused() {
    cp "$B/firmware/$board-demos.elf" "$dir/bad.elf" && cp "$B/firmware/$board-demos.bin" "$dir/bad.bin" &&
        printf '\001' | dd of="$dir/bad.bin" bs=1 seek=200 conv=notrunc status=none
    BOARD="$board" host-sim/emulate/emulate_rp2.sh "$dir/bad.elf" "$dir/out" 1 >"$dir/said" 2>&1 && return 1
    grep -q 'checksum of boot2' "$dir/said"
}

uf2_is_the_same_image() {
    cp "$B/firmware/$board-demos.elf" "$dir/uf2.elf" && cp "$B/firmware/$board-demos.uf2" "$dir/uf2.bin" # emulate.mjs tells by the magic
    emulate "$board" 1 2 && expect "$board" 2 && same 2 || return 1
    BOARD="$board" host-sim/emulate/emulate_rp2.sh "$dir/uf2.elf" "$dir/out" 2 2>/dev/null | grep '^frame' | diff "$dir/expected" -
}

frames_from_ram() { # flash is slow, see rp2040.ld
    local symbol
    for symbol in ph_draw_band ph_draw_fast_rows draw_other ph_fill ph_small_gouraud ph_span_flat ph_texture_tile ph_texture_small \
        ph_draw_small_texels ph_vertices ph_draw_mesh ph_transform_points ph_cull setup_front ph_setup_small __aeabi_uidiv __muldi3 memset 'sign_of[.a-z0-9]*' 'go_on[.a-z0-9]*' \
        rp2_bus_interrupt; do
        arm-none-eabi-nm "$B/firmware/$board-demos.elf" | grep -q "^2000.* $symbol\$" || { echo "$symbol" && return 1; }
    done
}

node_of() { ps -eo pid,args | awk -v dir="$1" '$2 == "node" && index($0, dir) { print $1 }'; }

interrupted() { # no node goes on, nothing half-written stays
    BOARD="$board" host-sim/emulate/emulate_rp2.sh "$B/firmware/$board-demos.elf" "$dir/cut" 1000 >/dev/null 2>"$dir/log" &
    local script=$! tries=0
    until [ -s "$dir/cut/events" ] || [ $((tries++)) = 6000 ]; do sleep 0.1; done
    [ -n "$(node_of "$dir/cut")" ] && kill "$script" && ! wait "$script" || return 1
    grep -qx 'emulate: interrupted' "$dir/log" && [ -z "$(ls "$dir/cut")" ] || return 1
    for ((tries = 0; tries < 6000; tries++)); do [ -n "$(node_of "$dir/cut")" ] || return 0; sleep 0.1; done
    return 1
}

small_panel() { emulate waveshare-pico-lcd-0in96 1 3 && expect waveshare-pico-lcd-0in96 3 && same 3; }

# The first frame is whole. The emulated chip divides its clock by the registers, the simulator by hal/chips/spi_clock.h.
bus_is_the_simulators() {
    local bus
    bus=$("$B/pinhole-sim" --board waveshare-pico-lcd-0in96 --demo turntable --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')
    awk -v bus="$bus" '{ print "# " $3 " us, in the simulator " bus; exit !($3 > bus - 3 && $3 < bus + 3) }' "$dir/out/report"
}

make_emulate() {
    make_image emulate BOARD="$board" FRAMES=1 >"$dir/said" 2>/dev/null && grep -q '^frame 0 crc32' "$dir/said" &&
        [ -s "$B/emulate/$board/frame-0000.ppm" ] && grep -q 'frames/s.*load of core 0' "$dir/said"
}

# What one core drew stays beside what two draw, to compare them.
images_have_folders_of_their_own() {
    local crc
    crc=$(cksum <"$B/emulate/$board/frame-0000.ppm") && make_image emulate BOARD="$board" CORES=2 FRAMES=2 >"$dir/said" 2>/dev/null &&
        [ -s "$B/emulate/$board-cores2/frame-0001.ppm" ] && [ "$(cksum <"$B/emulate/$board/frame-0000.ppm")" = "$crc" ] && [ ! -e "$B/emulate/$board/frame-0001.ppm" ]
}

check "images_are_within_their_budgets" builds
check "every_demo_is_the_simulators" every_demo 1
check "the_panel_is_dark_until_its_first_frame" order_is "$board" 'init [^;]*;first frame;display on;backlight [^;]*;$'
check "two_cores_draw_the_same" every_demo 2
check "both_cores_work" both_cores_work
check "they_do_with_any_delays_between_them" any_delays
check "a_frame_that_fits_the_bus_takes_no_longer" overlap
check "the_speed_is_that_of_the_paper" speed_is_that_of_the_paper
check "another_speed_than_that_of_the_paper_is_seen" other_speeds_are_seen
check "the_stack_stays_below_its_bound" stack_stays_below_its_bound
check "a_pin_is_a_button" a_pin_is_a_button
check "B_on_the_UART_reboots_into_the_boot_loader" boot_loader_on_request
check "a_button_held_at_power_up_does_so_too" boot_loader_by_a_button
check "a_fault_is_told_and_the_panel_is_dark" fault_is_told
check "a_stack_that_runs_over_leaves_the_panel_dark" overrun_ends_dark 0 1 'overrun(NULL);'
check "it_does_with_two_cores_too" overrun_ends_dark 0 2 'overrun(NULL);'
check "so_does_the_stack_of_core_1" overrun_ends_dark 1 2 'port_core_run(overrun, NULL); port_core_join();'
check "long_work_is_no_lockup" work_is_no_lockup
check "a_flipped_bit_in_boot2_is_refused" flipped_bit_in_boot2_is_refused
check "the_UF2_file_holds_the_same_image" uf2_is_the_same_image
check "frames_of_an_ST7735S_at_8.9_MHz_are_the_simulators" small_panel
check "a_frame_is_on_its_bus_for_as_long_as_in_the_simulator" bus_is_the_simulators
check "what_a_frame_needs_runs_from_RAM" frames_from_ram
check "an_interrupted_emulator_leaves_nothing_behind" interrupted
check "make_emulate_writes_pictures" make_emulate
check "images_of_one_core_and_of_two_have_folders_of_their_own" images_have_folders_of_their_own
tap_end
