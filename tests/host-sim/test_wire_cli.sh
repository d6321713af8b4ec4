#!/usr/bin/env bash
# pinhole-wire on the command line: a stream written by hand, as a panel's datasheet has it, and what may go wrong.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
wire=$B/pinhole-wire
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT

# Line 0 is D/C, 1 reset, 2 the backlight. $1: the bytes of a pixel, as often as the panel has pixels.
stream() {
    local ms=0 on
    step() { # ms later, event without its time and END_TIME
        ms=$((ms + $1))
        printf "%d %s\n" $((ms * 1000000)) "${2//END/$((ms * 1000000))}"
    }
    on='spi - 1000000 1000000 0 8'
    printf '0 name 0 dc\n0 name 1 reset\n0 name 2 backlight\n0 level 0\n'
    step 1 'level 2'
    step 120 "$on 2 2 END 11"
    step 120 "$on 2 2 END 3A"
    step 0 "$on 3 3 END 55"
    step 0 "$on 2 2 END 36"
    step 0 "$on 3 3 END 00"
    step 0 "$on 2 2 END B0"
    step 0 "$on 3 3 END 00E0"
    step 0 "$on 2 2 END 21"
    step 0 "$on 2 2 END 2A"
    step 0 "$on 3 3 END 000000ef"
    step 0 "$on 2 2 END 2B"
    step 0 "$on 3 3 END 000000ef"
    step 0 "$on 2 2 END 2C"
    step 0 "$on 3 3 END $(head -c 57600 /dev/zero | tr '\0' x | sed "s/x/$1/g")"
    step 1000 "$on 2 2 END 29"
    step 0 'level 6'
}

says() { # status, stdout, stderr, command...
    local status=0
    "${@:4}" >"$dir/o" 2>"$dir/e" || status=$?
    [ "$status" = "$1" ] && [ "$(cat "$dir/o")" = "$2" ] && [ "$(cat "$dir/e")" = "$3" ] && return
    echo "status $status instead of $1" && head -c 2000 "$dir/o" "$dir/e" && false
}

# The CRC of a picture of one colour, computed elsewhere.
crc() { # bytes of a pixel for printf
    local i
    for ((i = 0; i < 57600; i++)); do printf '%b' "$1"; done | gzip -c | tail -c 8 | head -c 4 | od -An -tx4 | tr -d ' \n' | tr a-f A-F
}

board='rpi-waveshare-1in3'
stream f800 >"$dir/red"
red=$(crc '\xff\0\0')

# shellcheck disable=SC2086 # words
{
    check "a red picture is red" says 0 "frame 0 crc32 $red" '' "$wire" --board $board "$dir/red"
    check "... from stdin, with lines by other names" says 0 "frame 0 crc32 $red" '' \
        sh -c "sed 's/ dc\$/ GPIO25/' '$dir/red' | '$wire' --board $board --dc GPIO25 --reset reset"
    check "a note before the first command shows a dark panel" says 0 "frame 0 crc32 $(crc '\0\0\0')" '' sh -c "echo '0 note frame' | '$wire' --board $board --notes"
    check "the steps and their times" says 0 "order reset begins 0.000 ms
order reset ends 1.000 ms
order init 121.000 ms
order first frame 241.000 ms
order display on 1241.000 ms
order backlight on 1241.000 ms
frame 0 crc32 $red" '' "$wire" --board $board --order "$dir/red"
    check "--last is the same here" says 0 "frame 0 crc32 $red" '' "$wire" --board $board --last "$dir/red"
    check "--out writes the picture" says 0 "frame 0 crc32 $red" '' "$wire" --board $board --out "$dir/out" "$dir/red"
    check "... which is red" test "$(tail -c 172800 "$dir/out/frame-0000.ppm" | od -An -tx1 -v | tr -d ' \n' | sed 's/\(ff0000\)*//')" = ''
    sed 's/ 3 3 \([0-9]*\) f800/ 2 3 \1 f800/' "$dir/red" >"$dir/race"
    check "a D/C race is told, and is an error" says 1 "frame 0 crc32 $red" \
        "pinhole-wire: 241.000 ms: D/C moved during a transfer of 115200 bytes
pinhole-wire: $dir/race: a panel would not accept 1 thing" "$wire" --board $board --dc dc "$dir/race"
    check "no picture is an error" says 1 '' "pinhole-wire: $dir/none: no complete picture was seen" \
        sh -c "head -n 8 '$dir/red' >'$dir/none'; '$wire' --board $board '$dir/none'"
    sed '5s/level/leve/' "$dir/red" >"$dir/broken"
    check "a broken line is named" says 1 '' "pinhole-wire: $dir/broken, line 5: no such kind of event" "$wire" --board $board "$dir/broken"
    check "a file without lines" says 1 '' "pinhole-wire: /dev/zero, line 1: a byte of zero" sh -c "ulimit -v 4000000; '$wire' --board $board /dev/zero"
    { head -n 5 "$dir/red" && printf '1 level 0\0\n'; } >"$dir/zero"
    check "a byte of zero" says 1 '' "pinhole-wire: $dir/zero, line 6: a byte of zero" "$wire" --board $board "$dir/zero"
    check "a file that is not there" says 1 '' "pinhole-wire: $dir/no: cannot be opened: No such file or directory" "$wire" --board $board "$dir/no"
    check "a full disk" says 1 '' "pinhole-wire: stdout cannot be written: No space left on device" \
        sh -c "'$wire' --board $board '$dir/red' >/dev/full"
    check "no board" says 2 '' 'pinhole-wire: --board NAME is needed; see --help' "$wire" "$dir/red"
    check "an unknown board" says 2 '' "pinhole-wire: --board 'x': must be a name that pinhole-sim --list shows" "$wire" --board x
    check "a mistyped board" says 2 '' "pinhole-wire: --board 'pico-dispay': must be a name that pinhole-sim --list shows; did you mean pico-display?" "$wire" --board pico-dispay
    check "a wrong value" says 2 '' "pinhole-wire: --rotate '45': must be 0, 90, 180 or 270 degrees" "$wire" --board $board --rotate 45
    check "two files" says 2 '' "pinhole-wire: 'b': a word too many; see --help" "$wire" --board $board a b
    check "every option is in --help" sh -c "'$wire' --help | grep -c -e '^  --\\(board\\|rotate\\|out\\|last\\|idle\\|order\\|select\\|panel\\|dc\\|reset\\|backlight\\|help\\)\\b' | grep -qx 12"
}
tap_end
