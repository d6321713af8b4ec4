#!/usr/bin/env bash
# 10,000 frames of pinhole-panel in the virtual kit: each one on the wire is pinhole-sim's, memory and descriptors stay
# as they are. A fifth as many with --diff on, whose choice takes its time in a guest: the last one is.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/kit_panel.sh
kit_begin "pinhole-panel shows 10,000 frames"
FRAMES=${FRAMES:-10000}
changed=$((FRAMES / 5))
make -s B="$B" all && kit_build || exit 1
kit_out=$dir

# While it runs, five times a second and without a process of its own: resident kB and open descriptors.
watch='
    . tests/guest/kit_panel.sh
    look() { # process
        local name kb _ resident= files=(/proc/$1/fd/*)
        while read -r name kb _; do [ "$name" != VmRSS: ] || resident=$kb; done </proc/$1/status
        [ -n "$resident" ] && echo "$resident ${#files[@]}" # an ended one has no memory
    }
    soak() { # name, argument...
        "$B/pinhole-panel" "${@:2}" >"$KIT/$1.out" 2>"$KIT/$1.err" 9<&- &
        pid=$!
        while look $pid; do read -rt .2 -u 9; done >"$KIT/$1.memory" 2>/dev/null
        wait $pid
        echo $? >"$KIT/$1.status"
    }
    fresh
    mkfifo /tmp/events /tmp/never
    exec 9<>/tmp/never
    "$B/pinhole-wire" --board rpi-waveshare-1in44 /tmp/events >"$KIT/spi.seen" 2>"$KIT/spi.wire" &
    wire=$!
    kit_follow /tmp/events
    soak spi --board rpi-waveshare-1in44 --demo torus --frames '$FRAMES'
    kit_follow_end
    wait $wire
    echo $? >"$KIT/spi.wire-status"
    fresh
    "$B/pinhole-wire" --board rpi-waveshare-1in44 --last --out "$KIT/diff.ppm" /tmp/events >/dev/null 2>"$KIT/diff.wire" &
    wire=$!
    kit_follow /tmp/events
    soak diff --board rpi-waveshare-1in44 --demo torus --diff on --frames '$changed'
    kit_follow_end
    wait $wire
    echo $? >"$KIT/diff.wire-status"
'

shows_every_frame() {
    ended spi 0 "" && [ "$(cat "$kit_out/spi.wire-status")" = 0 ] || { cat "$kit_out/spi.wire" && return 1; }
    "$B/pinhole-sim" --board rpi-waveshare-1in44 --demo torus --frames "$FRAMES" --crc | cmp - "$kit_out/spi.seen"
}

shows_the_last_frame() {
    ended diff 0 "" && [ "$(cat "$kit_out/diff.wire-status")" = 0 ] || { cat "$kit_out/diff.wire" && return 1; }
    "$B/pinhole-sim" --board rpi-waveshare-1in44 --demo torus --start $((changed - 1)) --frames 1 --out "$kit_out/sim" &&
        cmp "$kit_out"/sim/*.ppm "$kit_out/diff.ppm"
}

# The first tenth of the looks, a second at least, is the start; after it nothing grows.
stays_flat() { # name
    awk '{ kb[NR] = $1; files[NR] = $2 }
        END {
            from = NR / 10 > 5 ? int(NR / 10) + 1 : 6
            least = kb[from]
            for (i = from; i <= NR; i++) { least = kb[i] < least ? kb[i] : least; more = more || files[i] > files[from] }
            printf "# %d looks, %d to %d kB, %d descriptors\n", NR, least, kb[NR], files[from]
            exit !(NR >= 20 && kb[NR] <= least + 128 && !more)
        }' "$kit_out/$1.memory" || { cat "$kit_out/$1.memory" && return 1; }
}

tests/guest/guest.sh --timeout 1400 --cpus 2 --bufsiz 65536 --out "$kit_out" -- bash -c "$watch" >"$kit_out/log" 2>&1 ||
    cat "$kit_out/log"
check "each of $FRAMES frames on the wire is the simulator's" shows_every_frame
check "memory and descriptors stay as they are" stays_flat spi
check "with --diff on the last of $changed frames is the simulator's" shows_the_last_frame
check "... memory and descriptors stay as they are" stays_flat diff
tap_end
