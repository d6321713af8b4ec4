#!/usr/bin/env bash
# pinhole-panel in the virtual board, at length: every board in every rotation at three sizes of spidev's messages, 100
# unplugs at random moments, ThreadSanitizer and valgrind. (long_guest_panel.sh has the rest.)
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/panel_in_guest.sh
guest_begin "pinhole-panel drives every board in every rotation" libusb-1.0
make -s B="$B" all && guest_build || exit 1
seed=${SEED:-$RANDOM}

in_guest() { # name, script, guest.sh's option...
    guest_out=$dir/$1
    mkdir -p "$guest_out"
    tests/guest/guest.sh --timeout 4000 "${@:3}" --out "$guest_out" -- bash -c ". tests/guest/panel_in_guest.sh; $2" >"$guest_out/log" 2>&1 ||
        cat "$guest_out/log"
}

for bufsiz in 64 4096 65536; do
    in_share || continue
    in_guest "bufsiz-$bufsiz" 'guest_rotations 2 "0 90 180 270" $pi_boards' --bufsiz "$bufsiz"
    for board in $pi_boards; do
        check "on $board the wire carries what pinhole-sim draws, bufsiz $bufsiz" rotations_are_as_simulated "$board" "0 90 180 270"
    done
done
if in_share; then # a memory LCD is turned by 0 and 180 degrees alone
    in_guest lines 'guest_rotations 2 "0 180" rpi-sharp-2in7-spi' --bufsiz 64
    check "on rpi-sharp-2in7-spi the wire carries what pinhole-sim draws" rotations_are_as_simulated rpi-sharp-2in7-spi "0 180"
fi
if in_share; then
    in_guest usb 'guest_usb_rotations 2 "0 90 180 270" $usb_boards' --icount
    for board in $usb_boards; do
        check "on $board the wire carries what pinhole-sim draws" rotations_are_as_simulated "$board" "0 90 180 270"
    done
fi

unplugs='
    RANDOM='$seed'
    for i in {1..50}; do
        guest_limit=3000 run_usb "usb-$i" "--unplug-after $((RANDOM * 20))" --board ft232h-st7789 --frames 20
        fresh && board_do spi-unplug $((RANDOM % 600 + 1))
        guest_limit=3000 run "spi-$i" --board rpi-waveshare-1in44 --frames 20
    done
'
# Wherever the unplugging came: one line and exit 1; or it was over before.
unplugged() { # kind
    local i late=0
    for i in {1..50}; do
        if [ "$(cat "$guest_out/$1-$i.status")" = 0 ] && [ ! -s "$guest_out/$1-$i.err" ]; then
            late=$((late + 1))
        else
            ended "$1-$i" 1 "pinhole-panel: " && one_line "$1-$i" || { echo "number $i"; return 1; }
        fi
    done
    [ "$late" -lt 20 ] || { echo "$late of 50 came too late" && return 1; }
}
if in_share; then
    in_guest unplugs "$unplugs" --icount
    check "50 unplugs of an FT232H at random moments (SEED=$seed) end in one line each" unplugged usb
    check "50 unplugs of a board at random moments (SEED=$seed) end in one line each" unplugged spi
fi

checked='
    fresh && guest_wrap="valgrind -q --error-exitcode=99 --leak-check=full --suppressions=tests/tools/valgrind.suppress" guest_limit=3000 \
        run valgrind --board rpi-waveshare-1in44 --frames 3 --diff on
    fresh && B=$B/tsan guest_limit=3000 run threads --board rpi-waveshare-1in44 --frames 30
    fresh && B=$B/tsan guest_limit=3000 run threads-diff --board rpi-waveshare-1in44 --frames 30 --diff on
    usb_plug ft232h && B=$B/tsan guest_limit=3000 run threads-usb --board ft232h-st7789 --frames 10 --diff on
    kill $usb_device
    fresh && board_do spi-error 150 5 && B=$B/tsan guest_limit=3000 run threads-eio --board rpi-waveshare-1in44 --frames 30
'
if in_share; then
    make -s B="$B/tsan" CFLAGS='-O1 -g -fsanitize=thread' "$B/tsan/pinhole-panel" >"$dir/make" 2>&1 || cat "$dir/make"
    in_guest checked "$checked" --memory 1500 --cpus 2
    if command -v valgrind >/dev/null; then
        check "valgrind finds nothing" ended valgrind 0 ""
    else
        skip "valgrind finds nothing" "it is not installed"
    fi
    check "ThreadSanitizer finds nothing" ended threads 0 ""
    check "ThreadSanitizer finds nothing with --diff on" ended threads-diff 0 ""
    check "ThreadSanitizer finds nothing over USB with --diff on" ended threads-usb 0 ""
    check "ThreadSanitizer finds nothing when a transfer fails" eval 'ended threads-eio 1 "/dev/spidev0.0" && one_line threads-eio'
fi
tap_end
