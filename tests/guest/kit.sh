# shellcheck shell=bash
# The virtual board of tests/guest/board, for scripts on both sides: `. tests/guest/kit.sh`. Environment: B.
#
# On the host:
#   kit_begin NAME [PKG]     starts a test that sources tests/tools/tap.sh: where there can be no virtual board, or no library
#                            that pkg-config calls PKG, it skips NAME and ends; else $dir is a directory of its own
#   kit_why                  why there can be no virtual board here; nothing when there can
#   kit_build                builds the kernel module for the guest's kernel (once), and the device daemons
#   kit_guest OPTION... -- COMMAND...   tests/guest/guest.sh
# In the guest, COMMAND being a script that has this file as well:
#   kit_board [PARAMETER=VALUE...]      plugs the board in (board/kit.h has the parameters)
#   kit_do COMMAND                      a fault or an input: kit_do set 5 0; kit_do spi-error 100 5 (board/kit.h)
#   kit_events                          the events so far (for pinhole-wire), to stdout
#   kit_follow FILE / kit_follow_end    writes events to FILE while they come (for runs longer than the log)
#   kit_try VID:PID SERIAL ACTION...    talks to a USB device (tests/guest/try_usb.c)
#   kit_usb ft232h|bootsel OPTION...    plugs a USB device in and waits for it; sets kit_device to its daemon's pid
#                                       (tests/guest/usb_main.c has the options); `kill $kit_device` unplugs it
# Typically:
#   tests/guest/guest.sh --bufsiz 4096 --out DIR -- bash -c '. tests/guest/kit.sh; kit_board; PROGRAM; kit_events >$KIT/events'
#   pinhole-wire --board rpi-waveshare-1in3 --order DIR/events
B=$(realpath -m "${B:-build}") # a guest also works elsewhere
kit_tests=$(dirname "${BASH_SOURCE[0]}")

kit_guest() { "$kit_tests/guest.sh" "$@"; }

kit_kernel() { "$kit_tests/guest.sh" --kernel; }

kit_why() {
    "$kit_tests/guest.sh" --why || return 0
    [ -e "/lib/modules/$(kit_kernel)/build/Makefile" ] || echo "no headers for kernel $(kit_kernel) (linux-headers-amd64)"
}

# shellcheck disable=SC2034 # the caller's
kit_begin() {
    local why
    unset MAKEFLAGS
    export B
    why=$(kit_why)
    [ -n "$why" ] || [ -z "${2-}" ] || pkg-config --exists "$2" || why="pkg-config finds no $2"
    [ -z "$why" ] || { skip "$1" "$why" && tap_end; }
    dir=$(mktemp -d) || exit 1
    trap 'rm -rf "$dir"' EXIT
}

kit_module() { echo "${B:-build}/kit/board-$(kit_kernel)/pinhole_kit.ko"; }

kit_build_module() {
    local module folder new
    module=$(kit_module)
    folder=$(dirname "$module")
    [ -z "$(find "$kit_tests/board" -newer "$module" 2>&1)" ] && return
    mkdir -p "$folder"
    new=$(mktemp -d "$folder/new.XXXXXX") || return 1
    cp "$kit_tests"/board/* "$new"
    make -s -C "/lib/modules/$(kit_kernel)/build" M="$(cd "$new" && pwd)" KCFLAGS=-Werror modules >"$new/log" 2>&1 || {
        cat "$new/log" >&2
        rm -rf "$new"
        return 1
    }
    touch "$new/pinhole_kit.ko"
    mv "$new/pinhole_kit.ko" "$module"
    rm -rf "$new"
}

kit_build_usb() {
    local program=${B:-build}/kit/usb
    [ -e "$kit_tests/usb_main.c" ] || return 0
    [ -x "$program" ] && [ -z "$(find "$kit_tests" -maxdepth 1 -name 'usb*' -newer "$program")" ] && return
    gcc -std=c11 -O2 -g -Wall -Wextra -Werror -o "$program.$$" "$kit_tests"/usb_*.c && mv "$program.$$" "$program"
}

kit_build_try() {
    local program=${B:-build}/kit/try_usb
    [ "$program" -nt "$kit_tests/try_usb.c" ] && return
    pkg-config --exists libusb-1.0 || return 0
    gcc -std=c11 -O2 -g -Wall -Wextra -Werror -o "$program.$$" "$kit_tests/try_usb.c" -lusb-1.0 && mv "$program.$$" "$program"
}

# One script at a time.
kit_build() {
    mkdir -p "${B:-build}/kit" && (flock 9 && kit_build_module && kit_build_usb && kit_build_try) 9>"${B:-build}/kit/lock"
}

kit_board() { insmod "$(kit_module)" "$@"; }

kit_do() { printf '%s\n' "$*" >/dev/pinhole-kit; }

kit_events() { cat /dev/pinhole-kit; }

kit_follow() {
    kit_do follow
    cat /dev/pinhole-kit >"$1" &
    kit_follower=$!
}

kit_follow_end() {
    kit_do end
    wait "$kit_follower"
}

kit_usb() {
    local ready i
    ready=$(mktemp -u)
    modprobe vhci-hcd || return 1
    "${B:-build}/kit/usb" "$@" --ready "$ready" &
    # shellcheck disable=SC2034 # the caller's
    kit_device=$!
    for ((i = 0; i < 600; i++)); do
        # The kernel makes the device's node right after.
        [ -e "$ready" ] && rm "$ready" && sleep 0.1 && return
        sleep 0.05
    done
    echo "kit_usb: the kernel does not take the device" >&2
    return 1
}

kit_try() { "${B:-build}/kit/try_usb" "$@"; }
