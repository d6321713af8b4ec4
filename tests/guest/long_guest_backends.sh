#!/usr/bin/env bash
# The backends that need hardware keep hal.h's contract in the virtual board: real kernel, real libgpiod and libusb.
# What they put on the wires is checked in long_guest_panel.sh, whose guests try hal/linux with bufsiz 4096 and 65536:
# a guest's start takes longer than the test.
# shellcheck disable=SC2317,SC2016 # functions are called by check; $B and $@ are the guest's shell's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/panel_in_guest.sh
guest_begin "the backends keep hal.h's contract in the virtual board" libusb-1.0
make -s -j2 B="$B" "$B/tests/hal/test_hal" && guest_build || exit 1

in_guest='
    . tests/guest/panel_in_guest.sh
    run_hal names stays
    run_hal pi-5 unplugged label=pinctrl-rp1 names=none

    # Works and gives the kernel its driver back; then every fault with its line and its end in time.
    try_usb() {
        modprobe ftdi_sio
        expect() { # status, line, what was done, command...
            local said status
            said=$("${@:4}" 2>&1)
            status=$?
            [ "$status" = "$1" ] && [ "$said" = "$2" ] || { echo "$3: $status: $said" && failed=1; }
        }
        send() { timeout 1000 "$B/tests/hal/test_hal" usb-send "$@"; }
        fault() { # option, status, line
            usb_plug ft232h --serial PH001 $1 || failed=1
            expect "$2" "$3" "$1" send
            kill $usb_device 2>/dev/null
            wait $usb_device 2>/dev/null
            sleep 0.2
        }
        failed=0
        expect 19 "no FT232H (0403:6014) on USB; plug it in, lsusb lists what is there" "nothing there" send
        usb_plug ft232h --serial PH001 && one=$usb_device
        ls /dev/ttyUSB0 && "$B/tests/hal/test_hal" usb && ls /dev/ttyUSB0 || failed=1
        expect 0 "" "one device" send
        usb_plug ft232h --serial PH002
        expect 22 "2 FT232Hs on USB; say which by its serial number: PH002, PH001" "two devices" send
        expect 0 "" "one of two" send PH001
        chmod 600 /dev/bus/usb/*/*
        said=$(setpriv --reuid=65534 --clear-groups "$B/tests/hal/test_hal" usb-send PH002)
        [[ $said = *": no permission; copy boards/udev/60-pinhole.rules to /etc/udev/rules.d and plug it in again" ]] ||
            { echo "as nobody: $said" && failed=1; }
        kill $one $usb_device
        wait $one $usb_device 2>/dev/null
        sleep 0.2
        fault "--unplug-after 3" 19 "FT232H: unplugged while waiting for an answer; plug it in and start again"
        fault "--unplug-after 100000" 19 "FT232H: unplugged while sending; plug it in and start again"
        fault "--stall-after 0" 5 "FT232H: endpoint stalled while sending; plug it in again"
        fault "--stall-after 100000" 5 "FT232H: endpoint stalled while sending; plug it in again"
        fault "--hang-after 100000" 110 "FT232H: no answer within 1034 ms while sending; plug it in again"
        fault "--short-after 100000" 5 "FT232H: Input/Output Error while sending; plug it in again"
        return $failed
    }
    try_usb >$GUEST/usb.hal 2>&1
    echo $? >$GUEST/usb.status
'
guest_out=$dir
guest_run --icount --timeout 2500 --bufsiz 64 --out "$guest_out" -- bash -c "$in_guest" >"$guest_out/log" 2>&1 || cat "$guest_out/log"

check "hal_linux_with_a_bufsiz_of_64" hal_passed names
check "hal_linux_where_lines_have_no_names_on_a_pi_5" hal_passed pi-5
check "hal_ft232h_in_the_guest_with_every_fault" hal_passed usb
tap_end
