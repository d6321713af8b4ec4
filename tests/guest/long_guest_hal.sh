#!/usr/bin/env bash
# The backends in the virtual board under valgrind (memory, descriptors) and under ThreadSanitizer.
# shellcheck disable=SC2317 # functions are called by check
# shellcheck disable=SC2016 # $B is the guest's shell's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/virtual_board.sh
guest_begin "the backends keep hal.h's contract in the virtual board" libusb-1.0
make -s -j2 B="$B" "$B/tests/hal/test_hal" && guest_build || exit 1

in_the_guest() { # shell text, guest.sh's option...
    guest_run --timeout 4000 --memory 1024 --cpus 2 "${@:2}" -- bash -c "
        . tests/guest/virtual_board.sh
        memcheck='valgrind -q --leak-check=full --track-fds=yes --suppressions=tests/tools/valgrind.suppress --error-exitcode=9'
        $1"
}

under_thread_sanitizer() {
    make -s -j2 B="$B/tsan" CFLAGS='-O1 -g -fsanitize=thread' "$B/tsan/tests/hal/test_hal" || return 1
    in_the_guest 'board_plug && setarch -R "$B/tsan/tests/hal/test_hal"'
}

check "hal_linux_with_a_bufsiz_of_65536_on_two_processors" in_the_guest 'board_plug && "$B/tests/hal/test_hal"' --bufsiz 65536
if command -v valgrind >/dev/null; then
    check "hal_linux_under_valgrind" in_the_guest 'board_plug && $memcheck "$B/tests/hal/test_hal"'
    check "hal_ft232h_under_valgrind" in_the_guest 'usb_plug ft232h && $memcheck "$B/tests/hal/test_hal" usb && $memcheck "$B/tests/hal/test_hal" usb-send'
    check "hal_ft232h_unplugged_under_valgrind" in_the_guest \
        'usb_plug ft232h --unplug-after 100000 && $memcheck "$B/tests/hal/test_hal" usb-send; [ $? = 19 ]'
else
    skip "the_backends_under_valgrind" "no valgrind"
fi
check "hal_linux_under_thread_sanitizer" under_thread_sanitizer
tap_end
