# shellcheck shell=bash
# The virtual board of tests/guest/board, for scripts on both sides: `. tests/guest/virtual_board.sh`. Environment: B.
#
# On the host:
#   guest_begin NAME [PKG]    starts a test that sources tests/tools/tap.sh: where there can be no guest, or no library that
#                             pkg-config calls PKG, it skips NAME and ends; else $dir is a directory of its own
#   guest_why                 why there can be no guest with a virtual board here; nothing when there can
#   guest_build               builds the board's kernel module for the guest's kernel (once), and the USB devices
#   guest_run OPTION... -- COMMAND...   tests/guest/guest.sh
# In the guest, COMMAND being a script that has this file as well:
#   board_plug [PARAMETER=VALUE...]     plugs the board in (board/board.h has the parameters)
#   board_do COMMAND                    a fault or an input: board_do set 5 0; board_do spi-error 100 5 (board/board.h)
#   board_events                        the events so far (for pinhole-wire), to stdout
#   board_follow FILE / board_follow_end    writes events to FILE while they come (for runs longer than the log)
#   usb_try VID:PID SERIAL ACTION...    talks to a USB device (tests/guest/try_usb.c)
#   usb_plug ft232h|bootsel OPTION...   plugs a USB device in and waits for its node; sets usb_device to its daemon's pid
#                                       (tests/guest/usb_main.c has the options); `kill $usb_device` unplugs it
#   usb_gone                            waits until the kernel has let go of the last device that was plugged in
# Typically:
#   tests/guest/guest.sh --bufsiz 4096 --out DIR -- bash -c '. tests/guest/virtual_board.sh; board_plug; PROGRAM; board_events >$GUEST/events'
#   pinhole-wire --board rpi-waveshare-1in3 --order DIR/events
B=$(realpath -m "${B:-build}") # a guest also works elsewhere
guest_home=$(dirname "${BASH_SOURCE[0]}")

guest_run() { "$guest_home/guest.sh" "$@"; }

guest_kernel() { "$guest_home/guest.sh" --kernel; }

guest_why() {
    "$guest_home/guest.sh" --why || return 0
    [ -e "/lib/modules/$(guest_kernel)/build/Makefile" ] || echo "no headers for kernel $(guest_kernel) (linux-headers-amd64)"
}

# shellcheck disable=SC2034 # the caller's
guest_begin() {
    local why
    unset MAKEFLAGS
    export B
    why=$(guest_why)
    [ -n "$why" ] || [ -z "${2-}" ] || pkg-config --exists "${@:2}" || why="pkg-config finds not all of ${*:2}"
    [ -z "$why" ] || { skip "$1" "$why" && tap_end; }
    dir=$(mktemp -d) || exit 1
    trap 'rm -rf "$dir"' EXIT
}

board_module() { echo "${B:-build}/guest/board-$(guest_kernel)/virtual_board.ko"; }

build_board_module() {
    local module folder new
    module=$(board_module)
    folder=$(dirname "$module")
    [ -z "$(find "$guest_home/board" -newer "$module" 2>&1)" ] && return
    mkdir -p "$folder"
    new=$(mktemp -d "$folder/new.XXXXXX") || return 1
    cp "$guest_home"/board/* "$new"
    make -s -C "/lib/modules/$(guest_kernel)/build" M="$(cd "$new" && pwd)" KCFLAGS=-Werror modules >"$new/log" 2>&1 || {
        cat "$new/log" >&2
        rm -rf "$new"
        return 1
    }
    touch "$new/virtual_board.ko"
    mv "$new/virtual_board.ko" "$module"
    rm -rf "$new"
}

build_usb_devices() {
    local program=${B:-build}/guest/usb
    [ -e "$guest_home/usb_main.c" ] || return 0
    [ -x "$program" ] && [ -z "$(find "$guest_home" -maxdepth 1 -name 'usb*' -newer "$program")" ] && return
    gcc -std=c11 -O2 -g -Wall -Wextra -Werror -o "$program.$$" "$guest_home"/usb_*.c && mv "$program.$$" "$program"
}

build_usb_try() {
    local program=${B:-build}/guest/try_usb
    [ "$program" -nt "$guest_home/try_usb.c" ] && return
    pkg-config --exists libusb-1.0 || return 0
    gcc -std=c11 -O2 -g -Wall -Wextra -Werror -o "$program.$$" "$guest_home/try_usb.c" -lusb-1.0 && mv "$program.$$" "$program"
}

# One script at a time.
guest_build() {
    mkdir -p "${B:-build}/guest" && (flock 9 && build_board_module && build_usb_devices && build_usb_try) 9>"${B:-build}/guest/lock"
}

board_plug() { modprobe -q i2c-dev && insmod "$(board_module)" "$@"; }

board_do() { printf '%s\n' "$*" >/dev/virtual-board; }

board_events() { cat /dev/virtual-board; }

board_follow() {
    board_do follow
    cat /dev/virtual-board >"$1" &
    follower=$!
}

board_follow_end() {
    board_do end
    wait "$follower"
}

usb_nodes() { find /dev/bus/usb -type c | sort; }

usb_plug() {
    local ready i before
    ready=$(mktemp -u)
    modprobe vhci-hcd || return 1
    before=$(usb_nodes)
    "${B:-build}/guest/usb" "$@" --ready "$ready" &
    # shellcheck disable=SC2034 # the caller's
    usb_device=$!
    for ((i = 0; i < 12000; i++)); do
        # A slow kernel makes the node some time after it has configured the device.
        usb_node=$(usb_nodes | grep -vxF "$before" | head -n 1)
        [ -e "$ready" ] && [ -n "$usb_node" ] && rm "$ready" && sleep 0.1 && return
        sleep 0.05
    done
    echo "usb_plug: the kernel does not take the device" >&2
    return 1
}

usb_gone() {
    local i
    for ((i = 0; i < 1200; i++)); do
        [ -e "$usb_node" ] || return 0
        sleep 0.05
    done
}

usb_try() { "${B:-build}/guest/try_usb" "$@"; }
