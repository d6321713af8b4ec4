#!/usr/bin/env bash
# Work that takes over two seconds says how far it is, also without a terminal. Each command here works for long; it is ended
# when it has said so.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || C` is meant
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset PINHOLE_PROGRESS
B=$(realpath "${B:-build}") || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# Starts the command, waits for its first line on stderr, and ends it.
tells() { # pattern of the line, command...
    local pattern=$1 line='' pid
    shift
    mkfifo "$dir/lines" || return 1
    "$@" 2>"$dir/lines" >/dev/null &
    pid=$!
    read -rt 600 line <"$dir/lines"
    kill "$pid" 2>/dev/null
    wait "$pid"
    rm "$dir/lines"
    [[ $line =~ ^pinhole-[a-z]+:\ $pattern:\ [0-9]+\ of\ [1-9][0-9]*$ ]] || { echo "'$line'" && return 1; }
}

large=(--size 1024x1024 --near .1 --far 1000)
depth() { # command, option...
    "${how-long}" "pinhole-depth $1 says how far it is" tells "${what-$1}" "$B/pinhole-depth" "$@"
}

# No more than the first line and one every 5 s, each whole.
few_lines_come() {
    local start=$SECONDS lines
    timeout -s INT 9 "$B/pinhole-depth" slopes "${large[@]}" >/dev/null 2>"$dir/said"
    lines=$(wc -l <"$dir/said")
    [ "$lines" -ge 1 ] && [ "$lines" -le $(((SECONDS - start) / 5 + 1)) ] && ! grep -v '^pinhole-depth: slopes: [0-9]* of 150$' "$dir/said" || { cat "$dir/said" && return 1; }
}

short_work_says_nothing() { "$B/pinhole-depth" pairs --count 10 2>&1 >/dev/null | cmp - /dev/null; }
nothing_is_said_where_it_is_not_wanted() { PINHOLE_PROGRESS=off timeout -s INT 4 "$B/pinhole-depth" slopes "${large[@]}" 2>&1 >/dev/null | cmp - /dev/null; }

how=short depth resolve --near .1 --far 1000
depth pairs --near .1 --far 1000 --count 1000000
how=short depth slopes "${large[@]}"
depth planes "${large[@]}" --at 100
depth scenes "${large[@]}"
depth budget "${large[@]}"
depth anchors
depth advise "${large[@]}" --at 100 --separate .01
what='[a-z]+' depth advise --demo solar --frames 1000 --size 1024x1024
what='[a-z0-9-]+' depth monotone --near .1 --far 1000
what=resolve depth plot resolve --near .1 --far 1000 --out "$dir/plot.svg"
what='[a-z]+' depth all "${large[@]}" --out "$dir/report"
long "pinhole-sim says how far it is" tells frames "$B/pinhole-sim" --demo cube --size 512x512 --frames 1000000 --out "$dir/frames"
short "pinhole-sim with CRCs in a file says how far it is" tells frames "$B/pinhole-sim" --demo cube --size 512x512 --frames 1000000 --crc
long "lines are few and whole" few_lines_come
short "short work says nothing" short_work_says_nothing
short "PINHOLE_PROGRESS=off keeps it quiet" nothing_is_said_where_it_is_not_wanted
tap_end
