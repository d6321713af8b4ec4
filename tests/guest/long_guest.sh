#!/usr/bin/env bash
# The virtual board itself (tests/guest): what the guest gives back, and that its board is what Debian's own tools for GPIO,
# SPI and USB take for hardware.
# shellcheck disable=SC2317,SC2016 # functions are called by check; $GUEST and $i are the guest's
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/virtual_board.sh
guest_begin "the virtual board"

# Exit status, stdout and stderr of a command are as given.
gives() { # status, stdout, pattern in stderr, command...
    local status=0
    "${@:4}" >"$dir/o" 2>"$dir/e" || status=$?
    [ "$status" = "$1" ] && [ "$(cat "$dir/o")" = "$2" ] && grep -q -e "$3" "$dir/e" && return
    echo "status $status instead of $1" && cat "$dir/o" "$dir/e" && false
}

# A file has lines that match these patterns, in this order.
in_order() { # file, pattern...
    local at=0 next pattern
    for pattern in "${@:2}"; do
        next=$(tail -n +$((at + 1)) "$1" | grep -n -m 1 -e "$pattern" | cut -d: -f1)
        [ -n "$next" ] || { echo "$1 has no '$pattern' after line $at" && cut -c1-200 "$1" && return 1; }
        at=$((at + next))
    done
}

# Repeats a command until it succeeds, ten minutes at most.
patiently() {
    local i
    for ((i = 0; i < 6000; i++)); do "$@" && return; sleep 0.1; done
    false
}

no_orphan() { ! pgrep -f "path=$dir/orphan,"; }

killed_script_leaves_no_qemu() {
    tests/guest/guest.sh --out "$dir/orphan" -- sleep 100000 & # it would outlive our patience
    local script=$!
    # Not what becomes QEMU, and is not yet bound to the script.
    patiently pgrep -f "^qemu-system.*path=$dir/orphan," >/dev/null || { echo "no QEMU was started" && return 1; }
    { kill -KILL "$script" && wait "$script"; } 2>/dev/null
    patiently no_orphan
}

check "the module and the devices compile without a warning" guest_build

check "status, stdout, stderr, kernel log and files come back" \
    gives 7 out '^err$' guest_run --out "$dir/back" -- bash -c 'echo out; echo err >&2; echo file >$GUEST/file; exit 7'
check "... the file" grep -qx file "$dir/back/file"
check "... the kernel log" grep -q 'Linux version' "$dir/back/kernel.log"
check "a time-out is 124, with one line" gives 124 '' 'no end after 1 seconds' guest_run --timeout 1 -- sleep 1000
check "a dead guest is 125, with the kernel's word" \
    gives 125 '' 'guest died: .*panic' guest_run -- bash -c 'echo c >/proc/sysrq-trigger'
check "QEMU dies with a script that is killed" killed_script_leaves_no_qemu

guest_run --timeout 2500 --out "$dir/board" --bufsiz 128 -- bash -c '
    . tests/guest/virtual_board.sh
    board_plug || exit 1
    cd $GUEST
    cat /sys/module/spidev/parameters/bufsiz >bufsiz
    gpiodetect >detect
    gpioinfo >info
    gpioset gpiochip0 25=1
    gpioset gpiochip0 24=1
    printf "\x2a\x00\xff" >/dev/spidev0.0
    gpioset gpiochip0 25=0
    head -c 128 /dev/zero >/dev/spidev0.1
    head -c 129 /dev/zero | dd of=/dev/spidev0.0 bs=129 count=1 2>long
    timeout 600 gpiomon -n 4 gpiochip0 5 >edges &
    while kill -0 $! 2>/dev/null; do board_do set 5 0; board_do set 5 1; sleep 0.1; done
    board_do set 5 0
    board_do te 18 50
    timeout 600 gpiomon -r -n 3 gpiochip0 18 >te; echo $? >te_status
    board_do te 18 0
    timeout 0.5 gpiomon -r -n 1 gpiochip0 18; echo $? >no_te_status
    gpioset gpiochip0 8=1 2>busy_cs
    board_do busy 22
    gpioset gpiochip0 22=1 2>busy; gpioinfo | grep "line  22" >busy_info
    board_do free 22
    gpioset gpiochip0 22=1 2>free
    board_do dir-error 23 5
    gpioset gpiochip0 23=1 2>direction
    board_do spi-error 2 5 1
    for i in 1 2 3; do printf x >/dev/spidev0.0; done 2>spi
    gpioset gpiochip0 25=0
    board_do spi-stall 1 20000
    printf race >/dev/spidev0.0 &
    until board_events | tee -a events | grep -q "spi stall"; do sleep 0.1; done
    gpioset gpiochip0 25=1; gpioset gpiochip0 25=0
    board_do spi-go
    wait
    board_do mark the end
    board_events >>events
    board_do wire-time 1
    date +%s%N >slow_start
    for i in 1 2 3 4; do head -c 128 /dev/zero >/dev/spidev0.0; done
    board_events >slow
    board_do spi-unplug 2
    for i in 1 2 3 4; do echo x | dd of=/dev/spidev0.0 conv=nocreat status=none; done 2>unplugged
    for i in {1..1000}; do [ -e /dev/spidev0.0 ] || break; sleep 0.1; done
    ls /dev >devices
    exec /no/such/command
' >"$dir/log" 2>&1
status=$?
check "a command that is not there is 127" eval 'test $status = 127 && grep -q "No such file" "$dir/log"'
board=$dir/board
check "gpiodetect finds a Raspberry Pi's chip" grep -q 'gpiochip0 \[pinctrl-bcm2835\] (54 lines)' "$board/detect"
check "gpioinfo finds its lines by name, and the chip selects taken" \
    in_order "$board/info" '"ID_SDA"' '"GPIO7" *"spi0 CS1"' '"GPIO8" *"spi0 CS0"' '"GPIO25" *unused' '"GPIO27"'
check "bufsiz is as asked" grep -qx 128 "$board/bufsiz"
check "... and a longer message is refused" grep -q 'Message too long' "$board/long"
check "levels and transfers are told in their order, with both levels" in_order "$board/events" ' name 25 GPIO25$' \
    ' level 20001ff$' ' level 30001ff$' ' spi 0 125000000 125000000 0 8 30001ff 30001ff [0-9]* 2a00ff$' \
    ' level 10001ff$' ' spi 1 125000000 125000000 0 8 10001ff 10001ff [0-9]* 0\{256\}$' ' note the end$'
check "edges of a button arrive" in_order "$board/edges" FALLING RISING FALLING
check "edges of a tearing line arrive" grep -qx 0 "$board/te_status"
check "... until it stops" grep -qx 124 "$board/no_te_status"
check "a line that the SPI driver has is busy" grep -q 'busy' "$board/busy_cs"
check "a line that somebody has is busy, and says whose" grep -q '"somebody"' "$board/busy_info"
check "... and an error" grep -q 'Device or resource busy' "$board/busy"
check "... until it is free" test ! -s "$board/free"
check "a direction that cannot be set is an error" grep -q 'Input/output error' "$board/direction"
check "the second transfer fails, and only that" \
    test "$(grep -c 'Input/output error' "$board/spi") $(grep -c ' 78$' "$board/events")" = '1 2'
check "a line that moves during a transfer shows, even if it comes back" \
    in_order "$board/events" ' 0 8 14001df 34001df [0-9]* 72616365$' ' level 14001df$' ' note the end$'
check "transfers take their wire's time when asked" \
    awk '$2 == "spi" && $10 - $1 < 8e9 * length($11) / 2 / $5 { exit 1 } END { exit NR != 4 }' "$board/slow"
check "a board that is unplugged is gone" grep -q 'No such\|shutdown\|not found' "$board/unplugged"
check "the kernel has nothing to say against it" \
    test -z "$(grep -e 'BUG:' -e 'WARNING:' -e 'Call Trace' "$board/kernel.log")"
check "... with its devices" test -z "$(grep -e gpiochip -e spidev "$board/devices")"

tap_end
