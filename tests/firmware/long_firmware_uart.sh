#!/usr/bin/env bash
# The images of the two kits in QEMU obey their UART: hold, step, go on, buttons, boot loader. long_firmware_boot.sh tests
# the RP2040.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
declare -A machine=([lm3s6965evb]="lm3s6965evb" [feather-stm32f405]="netduinoplus2 -serial null -serial null") # the log is USART3

start() { # board
    # shellcheck disable=SC2086 # words
    coproc UART { exec timeout 2000 qemu-system-arm -M ${machine[$1]} -serial stdio -display none -monitor none -nic none \
        -icount shift=5,sleep=off -semihosting-config enable=on,target=native -kernel "$B/firmware/$1-demos.elf" 2>/dev/null; }
    to=${UART[1]} from=${UART[0]}
}

send() { printf '%s' "$1" >&"$to"; }
now_ms() { echo $((${EPOCHREALTIME/[.,]/} / 1000)); }
slowest_ms=0 # answer so far
hears() { # pattern of the next line about something
    local before
    before=$(now_ms)
    line=
    while [ -z "$line" ]; do
        read -rt 600 line <&"$from" || { echo "nothing, where '$1' should be" && return 1; }
        line=${line%$'\r'}
    done
    [ $(($(now_ms) - before)) -le "$slowest_ms" ] || slowest_ms=$(($(now_ms) - before))
    is_frame
    [[ $line =~ $1 ]] || { echo "'$line', where '$1' should be" && return 1; }
}
holds() { # what is under way still comes, then nothing for much longer than an answer takes on this machine
    local lines=0
    while read -rt $((1 + slowest_ms * 5 / 1000)).5 line <&"$from"; do
        [ $((lines++)) -lt 20 ] || { echo "goes on: $line" && return 1; }
        is_frame
    done
}
number= # of the last frame that it told of
is_frame() { [[ ! $line =~ ^frame\ ([0-9]+), ]] || number=${BASH_REMATCH[1]}; }

obeys() { # board; a line a frame while it holds, else a line a second
    local held
    start "$1"
    hears '^Pinhole on ' && hears '^demo turntable$' && send H && hears '^frame [0-9]+, ' && holds || return 1
    held=$number # on a slow machine it has drawn some frames before it is told to hold
    send HH && hears "^frame $((held + 1)), " && hears "^frame $((held + 2)), " && holds || return 1
    send G && hears '^frame [0-9]+, ' && hears '^frame [0-9]+, [1-9]' || return 1
    [ "$number" -gt $((held + 4)) ] || { echo "$line" && return 1; }
    send H && holds && send sH && hears '^demo testcard$' && hears '^frame ' && holds || return 1
    send uH && hears '^frame ' && holds && send B || return 1
    case $1 in
    feather*) hears '^fault .*address 1FFF0000$' ;; # where QEMU has no boot loader: see long_firmware_wires.sh
    *) holds && send H && hears '^frame ' ;;        # this chip has none: it goes on
    esac
}

obeys_and_ends() {
    obeys "$1"
    local status=$?
    kill "$UART_PID" && wait "$UART_PID"
    return "$status"
}

for board in lm3s6965evb feather-stm32f405; do
    check "the_image_of_${board}_builds" make_image firmware BOARD="$board"
    check "${board}_holds_steps_goes_on_and_takes_buttons_and_B" obeys_and_ends "$board"
done
tap_end
