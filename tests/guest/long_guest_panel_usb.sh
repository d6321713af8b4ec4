#!/usr/bin/env bash
# pinhole-panel on a virtual FT232H (tests/guest): the real program, libusb and kernel, down to the bytes of USB. What comes
# out of its pins is what pinhole-sim draws; what goes wrong is one line.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/panel_in_guest.sh
guest_begin "pinhole-panel drives a display over virtual USB" libusb-1.0
guest_build || exit 1

usb='
    . tests/guest/panel_in_guest.sh
    guest_usb_rotations 2 "0 270" $usb_boards
    run_usb usb-report "" report --board ft232h-st7789
    run_usb usb-mode3 "" --board ft232h-st7789 --mode 3 --frames 2
    run_usb usb-diff "" --board ft232h-st7789 --frames 9 --diff on
    usb_plug ft232h --serial ONE --events $GUEST/one.events && one=$usb_device
    usb_plug ft232h --serial TWO --events $GUEST/serial.events && two=$usb_device
    run which --board ft232h-st7789 --frames 2
    run doctor-which doctor --board ft232h-st7789
    run doctor-other doctor --board ft232h-st7789 --usb THREE
    run serial --board ft232h-st7789 --usb TWO --frames 2
    run other --board ft232h-st7789 --usb THREE --frames 2
    kill $one $two
    wait $one $two
    run none --board ft232h-st7789 --frames 2
    for fault in unplug stall hang short; do
        run_usb $fault "--$fault-after 150000" --board ft232h-st7789 --frames 9
    done
    usb_plug ft232h --events $GUEST/usb-TERM.events
    run_signalled usb-TERM TERM --board ft232h-st7789 --fps 5
    kill $usb_device
    chmod 600 /dev/bus/usb/*/*
    usb_plug ft232h && chmod 600 /dev/bus/usb/*/*
    guest_wrap="setpriv --reuid 65534 --clear-groups" run usb-nouser --board ft232h-st7789 --frames 2
    kill $usb_device
'

tests/guest/guest.sh --icount --timeout 2500 --out "$dir/usb" -- bash -c "$usb" >"$dir/usb.log" 2>&1 ||
    { cat "$dir/usb.log"; exit 1; }

guest_out=$dir/usb
usb_hz=$(sed -n 's/.*spi_hz = \([0-9]*\).*/\1/p' boards/families/ft232h.h)
usb_shows_what_changed() {
    ended usb-diff 0 "" || return 1
    "$B/pinhole-sim" --board ft232h-st7789 --frames 9 --out "$dir/sim-usb" &&
        "$B/pinhole-wire" --board ft232h-st7789 --last --out "$dir/usb.ppm" "$guest_out/usb-diff.events" >/dev/null &&
        cmp "$dir/sim-usb/frame-0008.ppm" "$dir/usb.ppm"
}

usb_in_mode_3() {
    ended usb-mode3 0 "" && frames_as_sim usb-mode3 ft232h-st7789 0 --frames 2 &&
        awk '$2 == "spi" && $6 != 3 { print; exit 1 }' "$guest_out/usb-mode3.events"
}

usb_is_dark() {
    "$B/pinhole-wire" --board ft232h-st7789 --order "$guest_out/usb-TERM.events" >"$dir/term.seen" &&
        sed -n 's/^order \(.*\) [0-9.]* ms$/\1/p' "$dir/term.seen" | tail -n 1 | grep -qx 'display off'
}

the_serial_number_selects() {
    ended which 1 "serial" && one_line which && ended other 1 "THREE" && one_line other &&
        ended doctor-which 1 "" && grep -q '^FAIL  FT232H: there are 2: say which' "$guest_out/doctor-which.out" &&
        ended doctor-other 1 "" && grep -q "^FAIL  FT232H: none has the serial number 'THREE': give --usb" "$guest_out/doctor-other.out" &&
        ended serial 0 "" && frames_as_sim serial ft232h-st7789 0 --frames 2 && ! grep -q ' spi ' "$guest_out/one.events"
}

for board in $usb_boards; do
    check "on $board the wire carries what pinhole-sim draws" rotations_are_as_simulated "$board" "0 270"
done
check "a report over USB tells of libusb and the clock" report_has usb-report "device FT232H on USB, libusb $(pkg-config --modversion libusb-1.0)" \
    "bus asked for $usb_hz Hz, SPI mode 0" 'TE: not wired'
check "over USB with --diff on the last picture is the simulator's" usb_shows_what_changed
check "the serial number says which FT232H; without it two are refused" the_serial_number_selects
check "in SPI mode 3 the wire carries the same, the clock resting high" usb_in_mode_3
check "no FT232H is told" told none 1 "ft232h-st7789: no FT232H (0403:6014) on USB; plug it in, lsusb lists what is there"
frame='ft232h-st7789: frame N: FT232H:'
check "an unplugged FT232H is told" told unplug 1 "$frame unplugged while sending; plug it in and start again" \
    "$frame unplugged while waiting for an answer; plug it in and start again"
check "a stall is told" told stall 1 "$frame endpoint stalled while sending; plug it in again"
check "a time-out is told" told hang 1 "$frame no answer within N ms while sending; plug it in again"
check "a short transfer is told" told short 1 "$frame Input/Output Error while sending; plug it in again"
check "SIGTERM over USB leaves the panel dark and exits 143" eval 'ended usb-TERM 143 frames/s && usb_is_dark'
check "no permission on USB names the rule" eval 'ended usb-nouser 1 "60-pinhole.rules" && one_line usb-nouser'
tap_end
