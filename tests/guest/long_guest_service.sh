#!/usr/bin/env bash
# The systemd unit under a real systemd, in the guest with the virtual board: with all that the unit forbids pinhole-panel draws what
# pinhole-sim draws, a stop leaves the panel dark, a wrong option is not started again, a display that is absent is.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/virtual_board.sh
name="pinhole-panel draws under its systemd unit"
[ -x /lib/systemd/systemd ] || { skip "$name" "no systemd" && tap_end; }
guest_begin "$name" libgpiod
make -s -j2 B="$B" "$B/pinhole-panel" "$B/pinhole-sim" "$B/pinhole-wire" && guest_build || exit 1

ran() { tests/guest/guest.sh --timeout 2000 --out "$dir" -- env UNIT="${UNIT:-boards/systemd/pinhole.service}" tests/guest/service_in_guest.sh; }
says() { # name, line...
    local line
    for line in "${@:2}"; do grep -qx "$line" "$dir/$1.show" || { cat "$dir/$1.show" && return 1; }; done
}

draws_as_simulated() { # name, board, option of pinhole-sim...
    says "$1" Result=success && "$B/pinhole-sim" --board "$2" --frames 2 --crc "${@:3}" >"$dir/expected" &&
        "$B/pinhole-wire" --board "$2" "$dir/$1.events" | diff "$dir/expected" -
}

# The last bytes of commands are display off and sleep in (28h, 10h), and all lines are free again.
stops_dark() {
    says stopped Result=success ActiveState=inactive && grep ' spi ' "$dir/stopped.events" | tail -n 2 | awk '{ print $NF }' | tr '\n' ' ' | tee "$dir/last" | grep -qx '28 10 ' &&
        grep -q ' note release 24$' "$dir/stopped.events" || { cat "$dir/last" && return 1; }
}

check "the guest runs the unit" ran
check "under the unit's restrictions the wires carry what pinhole-sim draws" draws_as_simulated frames rpi-waveshare-1in3
printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >"$dir/one.obj"
check "so they do of a model file" draws_as_simulated model rpi-waveshare-1in3 --model "$dir/one.obj"
check "so they do of an FT232H on USB" draws_as_simulated usb ft232h-st7789
check "systemctl stop leaves the panel dark" stops_dark
check "a wrong option is exit 2, and is not started again" says wrong ExecMainStatus=2 NRestarts=0 ActiveState=failed
check "a display that is absent is tried again" says absent ExecMainStatus=1 'NRestarts=[1-9].*'
tap_end
