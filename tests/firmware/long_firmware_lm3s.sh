#!/usr/bin/env bash
# The image of the Stellaris kit runs in QEMU. QEMU's own panel shows pinhole-sim's frames, byte for byte, for every demo that
# fits the kit. Buttons work, faults are told, and an unknown command to the panel is a failure.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
board=lm3s6965evb
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
each=4 # frames a demo

firmware() { make_image firmware BOARD="$board" "$@"; }
emulate() { # app, pinhole-emulate's arguments...
    timeout 2000 "$B/pinhole-emulate" --machine lm3s6965evb --board "$board" "${@:2}" "$B/firmware/$board-$1.elf" "$dir/out" "$frames"
}

builds() { make -s -j2 B="$B" "$B/pinhole-emulate" "$B/pinhole-sim" && firmware; }

# Select takes the next demo that fits; in between the other buttons move the camera.
script() {
    local i
    for i in $(seq 0 "$demos"); do
        [ "$i" = 0 ] || echo "$((i * each)) select"
        echo "$((i * each + 2)) left+up"
        echo "$((i * each + 3)) right+down"
    done
}

every_demo_is_the_simulators() {
    demos=$("$B/pinhole-sim" --list | grep -c '^demo') && frames=$((each * (demos + 1))) && script >"$dir/keys" || return 1
    emulate demos --keys "$dir/keys" --log >"$dir/seen" 2>"$dir/log" || { tail -n 3 "$dir/log" && return 1; }
    "$B/pinhole-sim" --board "$board" --frames "$frames" --keys "$dir/keys" --crc >"$dir/expected" 2>/dev/null || return 1
    [ "$(wc -l <"$dir/seen")" = "$frames" ] && cmp "$dir/seen" "$dir/expected"
}

demos_were_changed_by_the_button() { # but fill, to each that the simulator draws on this board, and to no other
    local demo
    while read -r demo; do
        "$B/pinhole-sim" --board "$board" --demo "$demo" --crc >/dev/null 2>&1 && echo "demo $demo"
    done < <("$B/pinhole-sim" --list | sed -n '/; by name only$/d; s/^demo *\([^ ]*\) .*/\1/p') | sort >"$dir/drawn"
    [ "$(wc -l <"$dir/drawn")" -ge 10 ] && grep '^demo ' "$dir/log" | tr -d '\r' | sort -u | diff - "$dir/drawn"
}

other_buttons_have_an_effect() { # without them other frames come
    frames=$((2 * each)) && echo "$each select" >"$dir/bare"
    "$B/pinhole-sim" --board "$board" --frames "$frames" --keys "$dir/bare" --crc >"$dir/other" 2>/dev/null
    head -n "$frames" "$dir/seen" | cmp -s - "$dir/other" && return 1
    emulate demos --keys "$dir/bare" | cmp - "$dir/other"
}

pictures_are_written() {
    "$B/pinhole-sim" --board "$board" --frames 2 --out "$dir/sim" && frames=2 && emulate demos &&
        cmp "$dir/out/frame-0001.ppm" "$dir/sim/frame-0001.ppm"
}

make_emulate_writes_pictures() {
    make_image emulate BOARD="$board" FRAMES=3 >"$dir/said" && grep -q '^frame 2 crc32' "$dir/said" && [ -s "$B/emulate/$board/frame-0002.ppm" ]
}

stack_stays_below_its_bound() { # the most that was used, measured; the deepest path, computed
    local used bound
    used=$(grep -o 'stack [0-9]*' "$dir/log" | awk '$2 > m { m = $2 } END { print m + 0 }')
    bound=$(firmware | awk '/^stack/ { print $2 }')
    echo "# $used used, at most $bound"
    [ "$used" -gt 1000 ] && [ "$used" -le "$bound" ]
}

drops_are_logged() { # as the simulator counts them
    local said counted frames
    frames=$(wc -l <"$dir/seen")
    said=$(sed -n 's/^frame [0-9]*,.*left out \([0-9]*\) triangles.*/\1/p' "$dir/log" | tr '\n' ' ')
    counted=$("$B/pinhole-sim" --board "$board" --frames "$frames" --keys "$dir/keys" --stats 2>&1 >/dev/null |
        sed -n 's/^frame .*triangles in.* dropped \([0-9]*\); vertices dropped.*/\1/p' | tr '\n' ' ')
    [ "${#said}" -gt "$frames" ] && [ "$said" = "$counted" ] && return
    echo "$said"
    echo "$counted"
    return 1
}

a_demo_of_ones_own_is_the_first() { # one of Pinhole's under another name
    mkdir -p "$dir/demos" && sed 's/demo_parallel\b/demo_mine/; s/"parallel"/"mine"/' firmware/app/demos/parallel.c >"$dir/demos/mine.c"
    firmware DEMO_DIR="$dir/demos" && frames=3 && emulate demos >"$dir/own" || return 1
    "$B/pinhole-sim" --board "$board" --demo parallel --frames 3 --crc | cmp - "$dir/own"
}

greys() { [ -s "$dir/screen.ppm" ] && tail -c 393216 "$dir/screen.ppm" | od -An -v -tu1 -w3 | sort -u | wc -l; } # of QEMU's 512x256 window
the_starter_draws() { # it writes no log, so QEMU is asked for its window until the model's greys are there
    firmware APP=starter && [ "$(wc -l <firmware/app/images/starter.c)" -le 40 ] || return 1
    {
        for _ in $(seq 100); do
            echo "screendump $dir/screen.ppm" && sleep 2
            [ "$(greys)" -ge 4 ] 2>/dev/null && break
        done
        echo quit
    } | timeout 600 qemu-system-arm -M lm3s6965evb -display none -monitor stdio -serial null -nic none -icount shift=5,sleep=off \
        -semihosting-config enable=on,target=native -kernel "$B/firmware/$board-starter.elf" >/dev/null 2>&1
    echo "$(greys) greys" && [ "$(greys)" -ge 4 ]
}

image_of() { # name, C text: the body of main after the kit was opened and a frame was shown
    cat >"$dir/$1.c" <<EOT
#include "runner.h"
#include "image.h"
#include "port.h"
static inline void overrun(void) { for (;;) { __asm volatile("push {r0-r7}"); } }
int main(void)
{
    static struct runner runner;
    const struct hal hal = port_hal();
    hal.ops->open(hal.context, board_here);
    const struct runner_config config = {.board = board_here, .depth_format = PH_DEPTH_AUTO, .band_height = board_here->band_height, .budget_bytes = board_here->scene_bytes,
        .demo = demo_find("cube"), .memory = image_memory, .memory_bytes = image_memory_bytes};
    if (runner_open(&runner, &hal, &config) != 0 || runner_frame(&runner, 0) != 0 || runner_finish(&runner) != 0) { return 1; }
    port_log("frame 0,\\n");
    $2
    for (;;) { }
}
EOT
    rm -f "$B/firmware/$board-$1.elf"
    firmware APP="$dir/$1.c" >"$dir/said" 2>&1
    [ -s "$B/firmware/$board-$1.elf" ] || { cat "$dir/said" && return 1; } # recursion is refused after linking
}

fails_with() { # name, pattern, C text
    image_of "$1" "$3" && frames=4
    emulate "$1" --log >"$dir/said" 2>&1 && echo "passes" && return 1
    grep -q "$2" "$dir/said" || { cat "$dir/said" && return 1; }
}

fault_names_its_place() { # the address in the message is in the function that did it
    fails_with fault 'the image says: fault [0-9A-F]*: pc' '__builtin_trap();' || return 1
    local pc
    pc=$(sed -n 's/.*fault [0-9A-F]*: pc 0*\([0-9A-F]*\).*/\1/p' "$dir/said" | head -n 1)
    arm-none-eabi-addr2line -f -e "$B/firmware/$board-fault.elf" "0x$pc" | grep -qx main
}

# The exit status that QEMU passes on is the image's.
exit_status_is_passed_on() {
    image_of leave 'port_exit(7);' || return 1
    timeout 600 qemu-system-arm -M lm3s6965evb -display none -monitor none -serial null -nic none -icount shift=5,sleep=off \
        -semihosting-config enable=on,target=native -kernel "$B/firmware/$board-leave.elf" 2>/dev/null
    [ $? = 7 ]
}

arenas_are_those_of_a_target() { # as `make budgets` writes them
    firmware/tools/budgets.sh arenas 2>"$dir/said" | diff firmware/app/arenas.inc - || { cat "$dir/said" && return 1; }
}

refused() { # pattern of its one line, file
    timeout 600 "$B/pinhole-emulate" --machine lm3s6965evb --board "$board" "$2" "$dir/none" >"$dir/said" 2>&1
    [ $? = 1 ] && grep -q "^pinhole-emulate: .*$1" "$dir/said" && [ "$(wc -l <"$dir/said")" = 1 ] && [ ! -e "$dir/none" ] && return
    cat "$dir/said"
    return 1
}

what_is_no_image_is_refused() { # before QEMU, which would run anything
    local whole=$B/firmware/$board-demos.elf
    head -c 20000 /dev/urandom >"$dir/garbage" && head -c 100 "$whole" >"$dir/head" && head -c 20000 "$whole" >"$dir/half" && mkfifo "$dir/pipe" || return 1
    { head -c 18 "$whole" && printf '\276\0' && tail -c +21 "$whole"; } >"$dir/other-cpu"
    refused 'not the ELF of an Arm image' "$dir/garbage" && refused 'not the ELF of an Arm image' /bin/sh && refused 'not the ELF of an Arm image' "$dir/other-cpu" &&
        refused 'only a part' "$dir/head" && refused 'only a part' "$dir/half" && refused 'not a file' /dev/null && refused 'not a file' "$dir" && refused 'not a file' "$dir/pipe" &&
        refused 'No such file' "$dir/nowhere" || return 1
    timeout 600 "$B/pinhole-emulate" --machine netduinoplus2 --board feather-stm32f405 "$whole" "$dir/none" 2>&1 | grep -q "an image for another chip: this one's flash is at 08000000"
}

interrupted() { # no QEMU goes on
    rm -f "$dir/said" # so that what an earlier case wrote is not taken for a first frame
    "$B/pinhole-emulate" --machine lm3s6965evb --board "$board" "$B/firmware/$board-demos.elf" "$dir/cut" 100000 >"$dir/said" 2>"$dir/log" &
    local emulator=$! qemu tries=0
    until [ -s "$dir/said" ] || [ $((tries++)) = 6000 ]; do sleep 0.1; done
    qemu=$(ps -eo pid,ppid | awk -v of="$emulator" '$2 == of { print $1 }')
    [ -n "$qemu" ] && kill "$emulator" && ! wait "$emulator" && ! kill -0 "$qemu" 2>/dev/null &&
        grep -qx 'pinhole-emulate: interrupted' "$dir/log" && return
    echo "QEMU '$qemu' after $tries tenths of a second: $(tail -n 3 "$dir/log")"
    return 1
}

check "the_image_builds" builds
check "every_demo_that_fits_shows_the_simulators_frames" every_demo_is_the_simulators
check "the_select_button_changed_the_demo" demos_were_changed_by_the_button
check "the_other_buttons_move_the_camera" other_buttons_have_an_effect
check "what_was_left_out_is_logged_as_the_simulator_counts_it" drops_are_logged
check "pictures_are_the_simulators" pictures_are_written
check "make_emulate_writes_pictures" make_emulate_writes_pictures
check "a_demo_of_ones_own_is_the_first" a_demo_of_ones_own_is_the_first
check "the_starter_draws" the_starter_draws
check "the_stack_used_stays_below_the_computed_bound" stack_stays_below_its_bound
check "a_fault_names_its_place" fault_names_its_place
check "a_stack_that_runs_over_is_a_fault" fails_with over 'the image says: fault.*the stack ran over' 'overrun();'
check "an_access_to_nowhere_is_a_failure" fails_with nowhere 'QEMU says: Invalid write' 'static volatile uint32_t *volatile nowhere = (uint32_t *)0xA0000000; *nowhere = 1; port_log("frame 1,\\n");'
check "a_command_that_the_panel_does_not_know_is_a_failure" fails_with unknown 'QEMU says: .*0x99' 'const uint8_t wrong = 0x99; hal.ops->bus_write(hal.context, HAL_COMMAND, &wrong, 1);'
check "an_image_that_says_no_more_is_a_failure" fails_with silent 'logs nothing more\|QEMU' 'port_exit(0);'
check "a_file_that_is_no_image_is_refused_in_one_line" what_is_no_image_is_refused
check "an_interrupted_emulator_leaves_no_QEMU" interrupted
check "the_exit_status_is_the_images" exit_status_is_passed_on
check "arenas_are_those_of_a_target" arenas_are_those_of_a_target
tap_end
