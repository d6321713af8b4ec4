#!/usr/bin/env bash
# pinhole-panel in the virtual board, for tests/guest/long_guest_panel.sh and tests/long_guest_*.sh: sourced on the host, run in the
# guest as `tests/guest/panel_in_guest.sh FUNCTION ARGUMENT...`. What a run leaves in $GUEST: NAME.status, NAME.out, NAME.err,
# NAME.events; of test_hal NAME.hal. Environment: B.
# shellcheck source-path=SCRIPTDIR
# shellcheck disable=SC2015,SC2034,SC2119,SC2120,SC2154 # names and arguments for those who source it
pi_boards='rpi-waveshare-1in3 rpi-waveshare-1in44 rpi-waveshare-3in5a rpi-pirate-audio rpi-display-hat-mini rpi-pitft-2in8 rpi-pitft-3in5
rpi-mini-pitft-1in14 rpi-mini-pitft-1in3 rpi-oled-bonnet sbc-generic'
usb_boards='ft232h-st7789 ft232h-ili9341'
. "$(dirname "${BASH_SOURCE[0]}")/virtual_board.sh"
guest_wrap=${guest_wrap-} # valgrind, say

# ---- in the guest --------------------------------------------------------------------------------

# A board that nobody has touched.
fresh() { # parameter=value...
    rmmod virtual_board 2>/dev/null
    board_plug "$@" && udevadm settle 2>/dev/null
    until [ -e /dev/virtual-board ]; do sleep 0.1; done
}

# One run; the board must be there.
run() { # name, argument...
    # shellcheck disable=SC2086 # words of guest_wrap
    timeout "${guest_limit:-1000}" $guest_wrap "$B/pinhole-panel" "${@:2}" >"$GUEST/$1.out" 2>"$GUEST/$1.err"
    echo $? >"$GUEST/$1.status"
}

run_fresh() { # name, argument...
    fresh && run "$@" && board_events >"$GUEST/$1.events"
}

# The conformance test of the backends. Unplugged boards stay half there, so only a guest's last one may be.
run_hal() { # name, stays|unplugged, the board's parameter=value...
    fresh "${@:3}" && timeout 1000 "$B/tests/hal/test_hal" "$2" >"$GUEST/$1.hal" 2>&1
    echo $? >"$GUEST/$1.status"
}

# One run that gets a signal when it has shown frames for a second. (A script's `&` ignores SIGINT.)
run_signalled() { # name, signal, argument...
    local pid i
    env --default-signal=INT "$B/pinhole-panel" --stats "${@:3}" >"$GUEST/$1.out" 2>"$GUEST/$1.err" &
    pid=$!
    for ((i = 0; i < 10000; i++)); do
        { ! grep -q frames/s "$GUEST/$1.err" && kill -0 $pid; } || break
        sleep 0.1
    done
    kill "-$2" $pid
    wait $pid
    echo $? >"$GUEST/$1.status"
}

# shellcheck disable=SC2154 # usb_device is usb_plug's
run_usb() { # name, options of the device, argument...
    # shellcheck disable=SC2086 # words of $2
    usb_plug ft232h --events "$GUEST/$1.events" $2 && run "$1" "${@:3}"
    kill "$usb_device" 2>/dev/null
    wait "$usb_device" 2>/dev/null
}

guest_usb_rotations() { # frames, rotations, board...
    local board rotation
    for board in "${@:3}"; do
        for rotation in $2; do
            run_usb "$board-$rotation" '' --board "$board" --rotate "$rotation" --frames "$1"
        done
    done
}

guest_rotations() { # frames, rotations, board...
    local board rotation
    for board in "${@:3}"; do
        for rotation in $2; do
            run_fresh "$board-$rotation" --board "$board" --rotate "$rotation" --frames "$1"
        done
    done
}

# ---- on the host ---------------------------------------------------------------------------------

# The run ended with this status and these words on stderr ("" for none).
ended() { # name, status, text
    local status
    status=$(cat "$guest_out/$1.status" 2>&1)
    [ "$status" = "$2" ] || { echo "status $status, not $2"; cat "$guest_out/$1.err"; return 1; }
    if [ -z "$3" ]; then
        [ ! -s "$guest_out/$1.err" ] || { cat "$guest_out/$1.err"; return 1; }
    else
        grep -qF -- "$3" "$guest_out/$1.err" || { echo "no '$3' in"; cat "$guest_out/$1.err"; return 1; }
    fi
    ! grep -qE 'runtime error|Sanitizer|ERROR SUMMARY: [1-9]' "$guest_out/$1.err"
}

hal_passed() { # name
    [ "$(cat "$guest_out/$1.status")" = 0 ] || { cat "$guest_out/$1.status" "$guest_out/$1.hal"; return 1; }
}

one_line() { # name
    [ "$(wc -l <"$guest_out/$1.err")" = 1 ] || { cat "$guest_out/$1.err"; return 1; }
}

# The run ended with this status and exactly this line, or one of these, on stderr. Numbers that depend on when something
# happened are N.
told() { # name, status, line...
    local said line
    said=$(sed -E 's/frame [0-9]+:/frame N:/; s/sending [0-9]+ bytes/sending N bytes/; s/within [0-9]+ ms/within N ms/' "$guest_out/$1.err")
    for line in "${@:3}"; do
        [ "$said" != "pinhole-panel: $line" ] || [ "$(cat "$guest_out/$1.status")" != "$2" ] || return 0
    done
    echo "status $(cat "$guest_out/$1.status"): $said"
    return 1
}

# A report (NAME.out) that can be pasted: every line has less than 80 characters, and these lines are there.
report_has() { # name, line...
    local line
    ended "$1" 0 "" && awk 'length($0) >= 80 { print "too long: " $0; bad = 1 } END { exit bad }' "$guest_out/$1.out" || return 1
    for line in '---- Pinhole report: copy from here ----' "${@:2}" 'self-test: passed' '---- Pinhole report: to here ----'; do
        grep -qxF -- "$line" "$guest_out/$1.out" || { echo "no '$line' in" && cat "$guest_out/$1.out"; return 1; }
    done
}

# The frames on the wire, first of all what the panel would have rejected, are those of pinhole-sim.
frames_as_sim() { # name, board, rotation, pinhole-sim's option...
    "$B/pinhole-sim" --board "$2" --rotate "$3" --crc "${@:4}" >"$guest_out/$1.expected" &&
        "$B/pinhole-wire" --board "$2" --rotate "$3" "$guest_out/$1.events" >"$guest_out/$1.seen" &&
        diff "$guest_out/$1.expected" "$guest_out/$1.seen"
}

rotations_are_as_simulated() { # board, rotations
    local rotation
    for rotation in $2; do
        ended "$1-$rotation" 0 "" && frames_as_sim "$1-$rotation" "$1" "$rotation" --frames 2 &&
            released "$1-$rotation" || { echo "rotation $rotation"; return 1; }
    done
}

# Reset, its waits (pinhole-wire measures them), init, first frame, display on, backlight, and back.
in_order() { # name, board, steps of this board
    "$B/pinhole-wire" --board "$2" --order "$guest_out/$1.events" | sed -n 's/^order \(.*\) [0-9.]* ms$/\1/p' | uniq |
        tr '\n' ',' >"$guest_out/$1.order"
    [ "$(cat "$guest_out/$1.order")" = "$3" ] || { echo "is:        $(cat "$guest_out/$1.order")"; echo "should be: $3"; return 1; }
}

# Every line that was taken is free again.
released() { # name
    awk '/ note request /{ held[$4] = 1 } / note release /{ delete held[$4] }
        END { delete held[7]; delete held[8] # the chip selects are the SPI controller'"'"'s
              for (line in held) { print "line " line " is held"; bad = 1 }
              exit bad }' "$guest_out/$1.events"
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
    "$@"
fi
