#!/usr/bin/env bash
# The backends that need hardware keep hal.h's contract in the virtual kit: real kernel, real libgpiod and libusb.
# What they put on the wires is checked in test_kit_panel.sh.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/.." || exit 1
. tests/tap.sh
. tests/kit/kit.sh
unset MAKEFLAGS
export B=${B:-build}

why=$(kit_why)
[ -z "$why" ] || { echo "$why" && exit 77; }
make -s -j2 B="$B" "$B/tests/test_hal" || exit 1
kit_build || exit 1

# test_hal tries hal/linux where it finds the board.
# shellcheck disable=SC2016 # $B and $@ are the guest's shell's
linux_in_the_kit() { # guest.sh's options, --, parameters of the board
    local options=()
    while [ "$1" != -- ]; do options+=("$1") && shift; done
    kit_guest --timeout 90 "${options[@]}" -- bash -c '. tests/kit/kit.sh; kit_board "$@" && $B/tests/test_hal' - "${@:2}"
}

# In one guest: works and gives the kernel's driver its device back; then every fault with its line and its end in time.
# shellcheck disable=SC2016 # as above
usb_in_the_kit() {
    kit_guest --timeout 120 -- bash -c '
        . tests/kit/kit.sh
        modprobe ftdi_sio
        expect() { # status, line, what was done, command...
            local said status
            said=$("${@:4}" 2>&1)
            status=$?
            [ "$status" = "$1" ] && [ "$said" = "$2" ] || { echo "$3: $status: $said" && failed=1; }
        }
        send() { timeout 20 "$B/tests/test_hal" usb-send "$@"; }
        fault() { # option, status, line
            kit_usb ft232h --serial PH001 $1 || failed=1
            expect "$2" "$3" "$1" send
            kill $kit_device 2>/dev/null
            wait $kit_device 2>/dev/null
            sleep 0.2
        }
        failed=0
        expect 19 "no FT232H (0403:6014) on USB; plug it in, lsusb lists what is there" "nothing there" send
        kit_usb ft232h --serial PH001 && one=$kit_device
        ls /dev/ttyUSB0 && "$B/tests/test_hal" usb && ls /dev/ttyUSB0 || failed=1
        expect 0 "" "one device" send
        kit_usb ft232h --serial PH002
        expect 22 "2 FT232Hs on USB; say which by its serial number: PH002, PH001" "two devices" send
        expect 0 "" "one of two" send PH001
        chmod 600 /dev/bus/usb/*/*
        said=$(setpriv --reuid=65534 --clear-groups "$B/tests/test_hal" usb-send PH002)
        [[ $said = *": no permission; copy boards/udev/60-pinhole.rules to /etc/udev/rules.d and plug it in again" ]] ||
            { echo "as nobody: $said" && failed=1; }
        kill $one $kit_device
        wait $one $kit_device 2>/dev/null
        sleep 0.2
        fault "--unplug-after 3" 19 "FT232H: unplugged while waiting for an answer; plug it in and start again"
        fault "--unplug-after 100000" 19 "FT232H: unplugged while sending; plug it in and start again"
        fault "--stall-after 0" 5 "FT232H: endpoint stalled while sending; plug it in again"
        fault "--stall-after 100000" 5 "FT232H: endpoint stalled while sending; plug it in again"
        fault "--hang-after 100000" 110 "FT232H: no answer within 1034 ms while sending; plug it in again"
        fault "--short-after 100000" 5 "FT232H: Input/Output Error while sending; plug it in again"
        exit $failed'
}

check "hal_linux_in_the_kit" linux_in_the_kit --
check "hal_linux_with_a_bufsiz_of_64" linux_in_the_kit --bufsiz 64 --
check "hal_linux_with_a_bufsiz_of_65536_on_two_processors" linux_in_the_kit --bufsiz 65536 --cpus 2 --
check "hal_linux_where_lines_have_no_names_on_a_pi_5" linux_in_the_kit -- label=pinctrl-rp1 names=none
check "hal_ft232h_in_the_kit_with_every_fault" usb_in_the_kit
tap_end
