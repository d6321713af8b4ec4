#!/usr/bin/env bash
# pinhole-panel's command line: what can be said without a display.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
panel=$B/pinhole-panel
[ -x "$panel" ] || { skip "pinhole-panel has a command line" "it is not built here (no linux/spi/spidev.h)" && tap_end; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# pinhole-panel ends with this status, nothing on stdout and one line on stderr, which has this text.
refuses() { # status, text, argument...
    local status=0
    timeout 600 "$panel" "${@:3}" >"$dir/out" 2>"$dir/err" || status=$?
    [ "$status" = "$1" ] && [ ! -s "$dir/out" ] && [ "$(wc -l <"$dir/err")" = 1 ] && grep -qF -- "$2" "$dir/err" ||
        { echo "status $status:" && cat "$dir/out" "$dir/err" && return 1; }
}

wrong_usage() { refuses 2 "$@"; }

help_names_every_option() {
    "$panel" --help >"$dir/help" 2>"$dir/err" && [ ! -s "$dir/err" ] || return 1
    local option
    for option in board panel spi usb drm dc reset backlight te mode speed rotate demo view model frames start fps diff \
        refresh band depth overlay stats help; do
        grep -q -- "^  --$option\b" "$dir/help" || { echo "no --$option" && return 1; }
    done
    for option in list doctor probe testcard speedtest report identify; do
        grep -q "^  $option " "$dir/help" || { echo "no $option" && return 1; }
    done
    "$panel" -h | cmp - "$dir/help"
}

list_has_what_it_can_drive() {
    "$panel" list >"$dir/list" || return 1
    local board
    for board in rpi-waveshare-1in3 rpi-waveshare-1in44 rpi-pirate-audio rpi-display-hat-mini rpi-pitft-2in8 \
        rpi-mini-pitft-1in14 rpi-mini-pitft-1in3 sbc-generic ft232h-st7789 ft232h-ili9341; do
        grep -q "^board  $board " "$dir/list" || { echo "no $board" && return 1; }
    done
    ! grep -q '^board  \(pico\|sim-\|lm3s\)' "$dir/list" && grep -q '^panel  gc9a01-240x240 *GC9A01 *at most 100.0 MHz$' "$dir/list"
}

options_are_checked() {
    wrong_usage "'shine': no such command" shine &&
        wrong_usage "--lamp: no such option" --lamp &&
        wrong_usage "--board needs a value" --board &&
        wrong_usage "--board 'moon': no such board" --board moon &&
        wrong_usage "--board 'pico-display': no kit for this machine's SPI bus or USB" --board pico-display &&
        wrong_usage "--panel 'glass': no such panel" --panel glass &&
        wrong_usage "--rotate '45': must be 0, 90, 180 or 270" --board sbc-generic --rotate 45 &&
        wrong_usage "--diff 'yes': must be on or off" --board sbc-generic --diff yes &&
        wrong_usage "--frames '0': must be" --board sbc-generic --frames 0 &&
        wrong_usage "--speed '1e6': must be" --board sbc-generic --speed 1e6 &&
        wrong_usage "--mode '1': must be 0 or 3" --board sbc-generic --mode 1 &&
        wrong_usage "--depth '24': must be" --board sbc-generic --depth 24 &&
        wrong_usage "--dc '-': must be a line" --board sbc-generic --dc - &&
        wrong_usage "--stats takes no value" --board sbc-generic --stats=2 &&
        wrong_usage "at most 4 times" --board a --board b --board c --board d --board e
}

what_does_not_fit_together_is_refused() {
    wrong_usage "no display: give --board NAME" &&
        wrong_usage "no display: give --board NAME" testcard &&
        wrong_usage "--demo and --model exclude each other" --board sbc-generic --demo testcard --model x.obj &&
        wrong_usage "--refresh is for --diff on" --board sbc-generic --refresh 3 &&
        wrong_usage "not for this command" testcard --board sbc-generic --demo ball &&
        wrong_usage "one display at a time" probe --board sbc-generic --board rpi-pirate-audio &&
        wrong_usage "one display at a time" speedtest &&
        wrong_usage "one display at a time" report --board sbc-generic --board rpi-pirate-audio &&
        wrong_usage "one display at a time" identify &&
        wrong_usage "not for this command" identify --drm &&
        wrong_usage "--drm: the kernel has this display's wires" --drm --board sbc-generic &&
        wrong_usage "--drm: the kernel has this display's wires" --drm card0 --speed 1000000 &&
        wrong_usage "--drm and --diff exclude each other" --drm --diff on &&
        wrong_usage "not for this command" speedtest --drm &&
        wrong_usage "'sbc-generic' is no kit for an FT232H" --board sbc-generic --usb &&
        wrong_usage "a pin of the FT232H is AD0" --usb --dc GPIO25 &&
        wrong_usage "--te: an FT232H has no line" --board ft232h-st7789 --te AC3 &&
        wrong_usage "is on USB" --board ft232h-st7789 --spi /dev/spidev0.0 &&
        wrong_usage "--demo 'none': no such demo" --board sbc-generic --demo none &&
        wrong_usage "--view 'none': turntable has no such view" --board sbc-generic --view none
}

two_lines_on_a_pin_are_refused() {
    refuses 1 "reset cannot be pin AC0 of an FT232H: another line has it" --board ft232h-st7789 --reset AC0 &&
        refuses 1 "backlight cannot be pin AD3 of an FT232H: another line has it" --usb --panel ili9341-240x320 --backlight AD3
}

what_is_not_there_is_one_line() {
    refuses 1 "sbc-generic: $dir/spidev is not there" --board sbc-generic --spi "$dir/spidev" &&
        refuses 1 ": longer than 63 characters; give a /dev/spidev" --board sbc-generic --spi "/dev/$(printf '%0300d' 5)" &&
        refuses 1 "st7735s-80x160: $dir/spidev is not there" testcard --panel st7735s-80x160 --spi "$dir/spidev" &&
        refuses 1 "$dir/none.obj" --board sbc-generic --model "$dir/none.obj" &&
        refuses 1 "rpi-pirate-audio: this kit has no data line back (MISO)" probe --board rpi-pirate-audio
}

the_doctor_names_what_is_missing() {
    "$panel" doctor --board sbc-generic --spi "$dir/spidev" >"$dir/doctor" 2>"$dir/err"
    [ $? = 1 ] && [ ! -s "$dir/err" ] && grep -q "^FAIL  $dir/spidev is not there" "$dir/doctor" &&
        ! grep -qv '^\(ok   \|FAIL \) ' "$dir/doctor" || { cat "$dir/doctor" "$dir/err" && return 1; }
}

identify_asks_and_needs_a_display() {
    local status=0
    "$panel" identify --board sbc-generic --spi "$dir/spidev" </dev/null >"$dir/out" 2>"$dir/err" || status=$?
    [ "$status" = 1 ] && [ ! -s "$dir/out" ] && grep -q '^Which card is white on black' "$dir/err" &&
        tail -n 1 "$dir/err" | grep -qF "$dir/spidev is not there"
}

a_full_disk_is_told() {
    local status=0
    "$panel" list 2>"$dir/err" >/dev/full || status=$?
    [ "$status" = 1 ] && grep -q 'stdout cannot be written' "$dir/err"
}

check "--help names every option and command" help_names_every_option
check "list has the boards of this machine's buses and all panels" list_has_what_it_can_drive
check "a wrong option is one line and exit 2" options_are_checked
check "what does not fit together is one line and exit 2" what_does_not_fit_together_is_refused
check "what is not there is one line and exit 1" what_is_not_there_is_one_line
check "two lines on one pin of an FT232H are one line and exit 1" two_lines_on_a_pin_are_refused
check "doctor names what is missing, a line a check" the_doctor_names_what_is_missing
check "identify asks, and says which device is missing" identify_asks_and_needs_a_display
check "a list that cannot be written is exit 1" a_full_disk_is_told
tap_end
