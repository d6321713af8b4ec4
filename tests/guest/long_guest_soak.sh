#!/usr/bin/env bash
# 10,000 frames of pinhole-panel in the virtual board: each one on the wire is pinhole-sim's, memory and descriptors stay
# as they are. As many with --diff on: the last one is.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/panel_in_guest.sh
guest_begin "pinhole-panel shows 10,000 frames"
FRAMES=${FRAMES:-10000}
changed=$FRAMES
make -s B="$B" all && guest_build || exit 1
guest_out=$dir

# While it runs, once the panel has had .8 s to wake up, a hundred times a second and without a process of its own: kB of its
# own memory (RssAnon; VmRSS would count the pages of the program's file, too, which come in whenever a rare branch is first
# taken) and open descriptors.
watch='
    . tests/guest/panel_in_guest.sh
    look() { # process
        local name kb _ resident= files=(/proc/$1/fd/*)
        while read -r name kb _; do [ "$name" != RssAnon: ] || resident=$kb; done </proc/$1/status
        [ -n "$resident" ] && echo "$resident ${#files[@]}" # an ended one has no memory
    }
    soak() { # name, argument...
        "$B/pinhole-panel" "${@:2}" >"$GUEST/$1.out" 2>"$GUEST/$1.err" 9<&- &
        pid=$!
        read -rt .8 -u 9
        while look $pid; do read -rt .01 -u 9; done >"$GUEST/$1.memory" 2>/dev/null
        wait $pid
        echo $? >"$GUEST/$1.status"
    }
    fresh
    mkfifo /tmp/events /tmp/never
    exec 9<>/tmp/never
    "$B/pinhole-wire" --board rpi-waveshare-1in44 /tmp/events >"$GUEST/spi.seen" 2>"$GUEST/spi.wire" &
    wire=$!
    board_follow /tmp/events
    soak spi --board rpi-waveshare-1in44 --demo torus --frames '$FRAMES'
    board_follow_end
    wait $wire
    echo $? >"$GUEST/spi.wire-status"
    fresh
    "$B/pinhole-wire" --board rpi-waveshare-1in44 --last --out "$GUEST/diff.ppm" /tmp/events >/dev/null 2>"$GUEST/diff.wire" &
    wire=$!
    board_follow /tmp/events
    soak diff --board rpi-waveshare-1in44 --demo torus --diff on --frames '$changed'
    board_follow_end
    wait $wire
    echo $? >"$GUEST/diff.wire-status"
'

shows_every_frame() {
    ended spi 0 "" && [ "$(cat "$guest_out/spi.wire-status")" = 0 ] || { cat "$guest_out/spi.wire" && return 1; }
    "$B/pinhole-sim" --board rpi-waveshare-1in44 --demo torus --frames "$FRAMES" --crc | cmp - "$guest_out/spi.seen"
}

shows_the_last_frame() {
    ended diff 0 "" && [ "$(cat "$guest_out/diff.wire-status")" = 0 ] || { cat "$guest_out/diff.wire" && return 1; }
    "$B/pinhole-sim" --board rpi-waveshare-1in44 --demo torus --start $((changed - 1)) --frames 1 --out "$guest_out/sim" &&
        cmp "$guest_out"/sim/*.ppm "$guest_out/diff.ppm"
}

# The first half of the looks is the start, which a slow machine draws out; after it nothing grows. 64 KB are
# 13 bytes a frame.
stays_flat() { # name
    awk '{ kb[NR] = $1; files[NR] = $2 }
        END {
            from = int(NR / 2) + 1
            least = kb[from]
            for (i = from; i <= NR; i++) { least = kb[i] < least ? kb[i] : least; more = more || files[i] > files[from] }
            printf "# %d looks, %d to %d kB, %d descriptors\n", NR, least, kb[NR], files[from]
            exit !(NR >= 20 && kb[NR] <= least + 64 && !more)
        }' "$guest_out/$1.memory" || { cat "$guest_out/$1.memory" && return 1; }
}

tests/guest/guest.sh --timeout 4000 --cpus 2 --bufsiz 65536 --out "$guest_out" -- bash -c "$watch" >"$guest_out/log" 2>&1 ||
    cat "$guest_out/log"
check "each of $FRAMES frames on the wire is the simulator's" shows_every_frame
check "memory and descriptors stay as they are" stays_flat spi
check "with --diff on the last of $changed frames is the simulator's" shows_the_last_frame
check "... memory and descriptors stay as they are" stays_flat diff
tap_end
