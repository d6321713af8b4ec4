#!/usr/bin/env bash
# The image of a kit on I2C in the emulated RP2040: its frames are the simulator's, and what a wire or a display may do wrong
# ends with a line.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here
board=pico-oled-0in96-i2c

frames_are_the_simulators() { image "$board" 1 && emulate "$board" 1 8 && expect "$board" 8 && same 8; }

# The bus rests neither in a frame nor between two: the simulator counts its messages alone.
frames_come_as_fast_as_the_bus() {
    local bus
    bus=$("$B/pinhole-sim" --board "$board" --demo testcard --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')
    awk -v bus="$bus" '$1 >= 4 { us += $2; n++ } END { print "# " us / n " us, the bus " bus; exit !(us / n > 0.99 * bus && us / n < 1.01 * bus) }' "$dir/out/report"
}

# What a wire or a display does wrong ends with one line, within 0.6 s, and with no access that silicon would not take.
fails() { # fault, line, us from which on it is wrong
    if ! EVENTS_ONLY=1 emulate "$board" 1 99 - --i2c-fault "$1" --limit-ms $((600 + $3 / 1000)) || [ "$(grep -c '^I2C: ' "$dir/log")" != 1 ] ||
        ! grep -q "$2" "$dir/log" || ! grep -q 'exit with an error' "$dir/log"; then
        cat "$dir/log"
        return 1
    fi
}

starts() { emulate "$board" 1 2 - --i2c-fault "$1" && expect "$board" 2 && same 2; }

make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" || exit 1
check "frames are the simulator's" frames_are_the_simulators
check "frames come as fast as the bus" frames_come_as_fast_as_the_bus
check "a display that resets itself for 100 ms is waited for" starts answers=100000
check "a display that holds the data line from before is freed" starts held=9
check "no display: a line says so" fails answers=9000000 'I2C: no display answers' 60000
check "a display that is unplugged while frames are sent: a line says so" fails gone=150000 'I2C: no display answers' 150000
check "a display that never lets go of the data line: a line says so" fails held=9999 'I2C: a line stays low' 60000
check "a clock line that stays low from the start on: a line says so" fails stuck=0 'I2C: a line stays low' 60000
check "a clock line that stays low while frames are sent: a line says so" fails stuck=150000 'I2C: a line stays low' 150000
tap_end
