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

check "hal_linux_in_the_kit" linux_in_the_kit --
check "hal_linux_with_a_bufsiz_of_64" linux_in_the_kit --bufsiz 64 --
check "hal_linux_with_a_bufsiz_of_65536_on_two_processors" linux_in_the_kit --bufsiz 65536 --cpus 2 --
check "hal_linux_where_lines_have_no_names_on_a_pi_5" linux_in_the_kit -- label=pinctrl-rp1 names=none
tap_end
