#!/usr/bin/env bash
# An RP2040 kit enters its boot loader when the UART asks for it at any moment, or when a button is held at power-up. The
# chip is emulated; its ROM finds the function by two letters (RP2040 datasheet 2.8.3).
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
board=pico-display

builds() { make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" && image "$board" 1 && image "$board" 2; }

ended_in_the_boot_loader() { # frame
    grep -qx "emulate: ended in frame $1: boot loader" "$dir/log" || { tail -n 5 "$dir/log" && return 1; }
}

dark() { # the last levels of backlight (GP20) and reset (GP21)
    local last
    last=$(awk '$2 == "level" { last = $3 } END { print last }' "$dir/out/events")
    [ $((0x$last >> 20 & 3)) = 0 ] || { echo "levels $last" && return 1; }
}

asked_for() { # cores, frame
    EVENTS_ONLY=1 emulate "$board" "$1" 9 - --send "$2:B" && ended_in_the_boot_loader "$2" && dark
}

asked_for_while_it_holds() { EVENTS_ONLY=1 emulate "$board" 1 9 - --send 0:HB && ended_in_the_boot_loader 1; }

held_at_power_up() { # each button of the kit; the panel gets no byte
    local pin pins=
    while read -r pin; do
        EVENTS_ONLY=1 emulate "$board" 1 9 - --press="-1:$pin" && ended_in_the_boot_loader -1 || return 1
        ! grep -q ' spi ' "$dir/out/events" || { echo "GP$pin: bytes to the panel" && return 1; }
        pins+="$pin "
    done < <(cc -E -P -Ihal -Iboards "boards/$board/board.c" | grep -o 'HAL_BUTTON_[A-Z]*, *{ *1, *1, *([0-9]*)' | tr -dc '0-9(\n' | cut -d'(' -f2)
    [ "$pins" = "12 13 14 15 " ] || { echo "buttons: $pins" && return 1; }
}

not_without_a_reason() { # a pin that is no button; a button pressed later
    EVENTS_ONLY=1 emulate "$board" 1 3 - --press=-1:22 && EVENTS_ONLY=1 emulate "$board" 1 3 - --press 0:12+15 && ! grep -q 'boot loader' "$dir/log"
}

not_while_its_line_is_charged() { # 15 ms; a line that takes 40 ms counts as held
    EVENTS_ONLY=1 emulate "$board" 1 2 - --charge 15000 && ! grep -q 'boot loader' "$dir/log" &&
        EVENTS_ONLY=1 emulate "$board" 1 2 - --charge 40000 && ended_in_the_boot_loader -1
}

holds_steps_and_goes_on() { # a line a frame while it holds, then none within the second
    emulate "$board" 1 12 - --send 0:HHHG && expect "$board" 12 && same 12 || return 1
    sed -n 's/^frame \([0-9]*\),.*/\1/p' "$dir/log" | tr -d '\r' | tr '\n' ' ' | tee "$dir/lines" | grep -qx '1 2 3 ' || { cat "$dir/lines" && return 1; }
}

stack_of_core_1_stays_below_its_bound() { # six demos; of its stack 256 bytes are the guard's, 32 for the frame of its tick
    local top lowest size bound
    printf '%s select\n' 1 3 5 7 9 >"$dir/keys"
    emulate "$board" 2 12 "$dir/keys" || return 1
    symbol() { arm-none-eabi-nm "$B/firmware/$board-demos-cores2.elf" | awk -v name="$1" '$3 == name { print $1 }'; }
    top=$((0x$(symbol ld_stack_core1_top))) lowest=$((0x$(sed -n 's/^emulate: core 1: lowest stack //p' "$dir/log")))
    size=$((0x$(symbol stack_core1_bytes)))
    bound=$(find "$B/firmware/$board-cores2-objects" -name '*.ci' -exec cat {} + | awk -v library=96 -v list=1 -v of=hal/chips/rp2/cores2.c:serve -f firmware/tools/stack.awk | awk '/^worst/ { print $2 }')
    echo "$((top - lowest)) used, at most $bound of $size"
    [ $((top - lowest)) -gt 200 ] && [ $((top - lowest)) -le $((bound + 32)) ] && [ $((bound + 32 + 256)) -le "$size" ]
}

two_buttons_change_the_demo() { # GP12 and GP13, up and down, from frame 2 to 3: this kit has no select
    echo '2 up+down' >"$dir/keys"
    emulate "$board" 1 5 - --press 1:12+13 --press 2: && expect "$board" 5 "$dir/keys" && same 5 && grep -q '^demo testcard' "$dir/log"
}

no_chip_select_is_told() {
    mkdir -p "$dir/home" && sed 's/PICO_DISPLAY_PACK/.pins = {.dc = BOARD_PIN(16)}/' "boards/$board/board.c" >"$dir/home/board.c" || return 1
    ! BOARD=bare BOARD_HOME="$dir/home" host-sim/emulate/emulate_rp2.sh "$B/firmware/$board-demos.elf" "$dir/none" 1 2>"$dir/log" || return 1
    grep -qx 'emulate: bare: has no chip select (.*' "$dir/log" && [ ! -e "$dir/none" ]
}

check "images_are_built" builds
check "B_on_the_UART_reboots_into_the_boot_loader" asked_for 1 1
check "it_reboots_before_the_second_frame_too" asked_for 1 0
check "it_reboots_with_two_cores_too" asked_for 2 3
check "it_reboots_while_it_holds_too" asked_for_while_it_holds
check "each_button_held_at_power_up_does_so" held_at_power_up
check "other_pins_and_later_moments_do_not" not_without_a_reason
check "a_button_with_a_capacitor_does_not_either" not_while_its_line_is_charged
check "H_holds_and_steps_G_goes_on" holds_steps_and_goes_on
check "two_buttons_held_together_change_the_demo" two_buttons_change_the_demo
check "the_stack_of_core_1_stays_below_its_bound" stack_of_core_1_stays_below_its_bound
check "a_board_without_chip_select_is_one_clear_line" no_chip_select_is_told
tap_end
