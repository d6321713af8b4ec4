#!/usr/bin/env bash
# pinhole-panel on a virtual Raspberry Pi (tests/guest): the real program, kernel, spidev and libgpiod. What comes out of
# the wires is what pinhole-sim draws; what goes wrong is one line and leaves nothing behind.
# shellcheck disable=SC2317,SC2015,SC2016 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/panel_in_guest.sh
guest_begin "pinhole-panel drives a display in the virtual board"
make -s B="$B" "$B/tests/hal/test_hal" && guest_build || exit 1

# ---- what the guests do --------------------------------------------------------------------------

all_boards='
    . tests/guest/panel_in_guest.sh
    wide="--panel ili9488-320x480 --dc GPIO25 --reset GPIO27 --backlight -"
    guest_rotations 2 "0 270" $pi_boards
    fresh && board_do wire-time 1 && run timed --board rpi-waveshare-1in3 --frames 2 && board_events >$GUEST/timed.events
    run_fresh diff --board rpi-waveshare-1in3 --frames 12 --diff on
    run_fresh two --board rpi-waveshare-1in44 --board sbc-generic --spi /dev/spidev0.1 --dc GPIO22 \
        --reset GPIO23 --backlight - --frames 3
    run_fresh options --board rpi-waveshare-1in3 --demo solar --view moon --start 40 --frames 2 --overlay --depth fixed16 --band 7
    run_fresh refreshed --board rpi-waveshare-1in3 --frames 3 --diff on --refresh 1
    fresh && board_do set 13 0 && run select --board rpi-waveshare-1in3 --frames 2 && board_events >$GUEST/select.events
    fresh && board_do reply 0085855200
    run probe probe --board rpi-pitft-2in8 --panel st7789-240x320 --reset GPIO24 && board_events >$GUEST/probe.events
    fresh && board_do reply 0085855200 && board_do te 18 100 && board_do wire-time 1
    uname -srm >$GUEST/system && run report report --board rpi-pitft-2in8 --panel st7789-240x320 --reset GPIO24 --te GPIO18 --speed 20000000
    run_fresh home --panel st7735s-80x160 --spi /dev/spidev0.1 --dc pinctrl-bcm2835:4 --reset gpiochip0:17 \
        --backlight - --demo testcard --frames 2 --rotate 90 --speed 8000000
    fresh && board_do te 18 100 && run edges --board rpi-waveshare-1in3 --te GPIO18 --frames 9 && board_events >$GUEST/edges.events
    fresh && printf "2\n2\n1\n" | run identify identify --board rpi-waveshare-1in3 && board_events >$GUEST/identify.events
    run_fresh card testcard --board rpi-pitft-2in8 --frames 1
    run_fresh speedtest speedtest --board rpi-waveshare-1in44 --speed 15000000 --frames 2
    fresh && board_do wire-time 1 && run clocks speedtest --board rpi-waveshare-1in3 --speed 40000000 --frames 2
    run_fresh noedges --board rpi-waveshare-1in3 --te GPIO18 --frames 3
    run_fresh few --board rpi-waveshare-1in3 --frames 3
    run_fresh few-666 $wide --frames 3
    run_hal hal unplugged
'

faults='
    . tests/guest/panel_in_guest.sh
    wide="--panel ili9488-320x480 --dc GPIO25 --reset GPIO27 --backlight -"
    run nospi --board rpi-waveshare-1in3 --frames 2
    run doctor-nospi doctor --board rpi-waveshare-1in3
    fresh && run doctor doctor --board rpi-waveshare-1in3
    run_fresh few --board rpi-waveshare-1in3 --frames 3
    run_fresh few-666 $wide --frames 3
    board_do busy 25 && run busy --board rpi-waveshare-1in3 --frames 2
    run doctor-busy doctor --board rpi-waveshare-1in3
    fresh && board_do dir-error 27 5 && run direction --board rpi-waveshare-1in3 --frames 2 && board_events >$GUEST/direction.events
    for n in 3 4; do # mode and bits a word come first
        fresh && board_do spi-setup-error $n 22 && run clock-$n --board rpi-waveshare-1in3 --frames 2 && board_events >$GUEST/clock-$n.events
    done
    fresh && mkfifo /tmp/fifo && run fifo --board rpi-waveshare-1in3 --spi /tmp/fifo
    run folder --board rpi-waveshare-1in3 --spi /dev
    run no-chip --board rpi-waveshare-1in3 --dc /dev/null:3
    run no-line --board rpi-waveshare-1in3 --dc GPIO99
    run chip-select --board rpi-waveshare-1in3 --dc GPIO8
    run twice --board rpi-waveshare-1in3 --board rpi-waveshare-1in3
    for n in 1 2 100 230; do
        fresh && board_do spi-error $n 5 && run eio-$n --board rpi-waveshare-1in3 --frames 9 && board_events >$GUEST/eio-$n.events
    done
    fresh && chmod 600 /dev/spidev* /dev/gpiochip*
    guest_wrap="setpriv --reuid 65534 --clear-groups" run nouser --board rpi-waveshare-1in3 --frames 2
    chmod 666 /dev/spidev* && guest_wrap="setpriv --reuid 65534 --clear-groups" run nogpio --board rpi-waveshare-1in3 --frames 2
    for signal in INT TERM HUP; do
        fresh
        run_signalled $signal $signal --board rpi-waveshare-1in44 --fps 20 --frames 200
        board_events >$GUEST/$signal.events
    done
    fresh
    run_signalled killed KILL --board rpi-waveshare-1in44 --fps 20 --frames 200
    board_events >$GUEST/killed.events
    run after --board rpi-waveshare-1in44 --frames 2
    board_events >$GUEST/after.events
    run_hal hal stays
    fresh && board_do spi-unplug 200
    run unplugged --board rpi-waveshare-1in44 --frames 90
'

tests/guest/guest.sh --bufsiz 65536 --timeout 2500 --out "$dir/boards" -- bash -c "$all_boards" >"$dir/boards.log" 2>&1 ||
    { cat "$dir/boards.log"; exit 1; }
tests/guest/guest.sh --timeout 2500 --out "$dir/faults" -- bash -c "$faults" >"$dir/faults.log" 2>&1 ||
    cat "$dir/faults.log"

# ---- what came out -------------------------------------------------------------------------------
guest_out=$dir/boards

the_order_is_right() {
    local lit='init,first frame,display on,backlight on,backlight off,display off,'
    in_order rpi-waveshare-1in3-0 rpi-waveshare-1in3 "reset begins,reset ends,reset begins,reset ends,$lit" &&
        in_order rpi-pirate-audio-0 rpi-pirate-audio "$lit" &&
        in_order rpi-pitft-2in8-0 rpi-pitft-2in8 'init,first frame,display on,display off,'
}

changes_are_the_picture_in_the_end() {
    ended diff 0 "" || return 1
    "$B/pinhole-sim" --board rpi-waveshare-1in3 --frames 12 --out "$dir/sim" &&
        "$B/pinhole-wire" --board rpi-waveshare-1in3 --last --out "$dir/wire.ppm" "$guest_out/diff.events" >/dev/null &&
        cmp "$dir/sim/frame-0011.ppm" "$dir/wire.ppm"
}

two_displays_show_the_same() {
    ended two 0 "" &&
        "$B/pinhole-sim" --board rpi-waveshare-1in44 --frames 3 --crc >"$dir/first" &&
        "$B/pinhole-sim" --board sbc-generic --frames 3 --crc >"$dir/second" &&
        "$B/pinhole-wire" --board rpi-waveshare-1in44 "$guest_out/two.events" | diff "$dir/first" - &&
        "$B/pinhole-wire" --board sbc-generic --select 1 --dc GPIO22 --reset GPIO23 --backlight - "$guest_out/two.events" |
        diff "$dir/second" -
}

select_takes_the_next_demo() {
    printf '0 select 9\n' >"$dir/keys"
    ended select 0 "" && frames_as_sim select rpi-waveshare-1in3 90 --frames 2 --keys "$dir/keys"
}

options_are_the_simulators() {
    ended options 0 "" || return 1
    "$B/pinhole-wire" --board rpi-waveshare-1in3 "$guest_out/options.events" | cut -d' ' -f3- >"$dir/options" # it counts from 0
    "$B/pinhole-sim" --board rpi-waveshare-1in3 --demo solar --view moon --start 40 --frames 2 --overlay --depth fixed16 --crc |
        cut -d' ' -f3- | diff - "$dir/options" &&
        [ "$(awk '$2 == "spi" && length($11) > 1000' "$guest_out/options.events" | wc -l)" -ge 70 ] # 2 frames of 35 bands
}

# Frames of windows only are no frames to pinhole-wire: these are whole.
all_is_sent_again() { ended refreshed 0 "" && frames_as_sim refreshed rpi-waveshare-1in3 90 --frames 3; }

# Line 24 falls and rises before it is asked.
a_controller_is_reset_and_named() {
    ended probe 0 "" && grep -q '^controller: ST7789$' "$guest_out/probe.out" &&
        awk '$2 == "level" { was = high; high = index("13579bdf", substr($3, length($3) - 6, 1)) > 0; pulses += high && !was && fell; fell += was && !high }
            $2 == "read" { exit } END { exit !(pulses == 1 && high) }' "$guest_out/probe.events"
}

wires_are_given_by_hand() {
    ended home 0 "" &&
        "$B/pinhole-wire" --board sbc-generic --panel st7735s-80x160 --rotate 90 --select 1 --dc GPIO4 --reset GPIO17 \
            --backlight - "$guest_out/home.events" >"$dir/home.seen" &&
        "$B/pinhole-sim" --board waveshare-pico-lcd-0in96 --rotate 90 --demo testcard --frames 2 --crc | # it has this panel
        diff - "$dir/home.seen" && grep -q 'spi 1 8000000' "$guest_out/home.events"
}

# Between the last pixels of a frame and the first command of the next one line 18 rises.
an_edge_is_before_each_frame() {
    awk '$2 == "level" { was = high; high = index("4567cdef", substr($3, length($3) - 4, 1)) > 0; edges += high && !was }
        $2 == "spi" && length($11) > 1000 { edges = 0; frames += !pixels; pixels = 1 }
        $2 == "spi" && $11 == "2a" && pixels { pixels = 0; missed += edges == 0 }
        END { print frames " frames, " missed + 0 " without an edge"; exit frames != 9 || missed > 0 }' "$guest_out/edges.events"
}

frames_wait_for_the_edge() {
    ended edges 0 "" && an_edge_is_before_each_frame &&
        told noedges 0 "rpi-waveshare-1in3: the TE line gave no edge for 50 ms: frames are sent without waiting for it; check its wire, or use --te -"
}

the_card_is_at_every_clock() {
    ended card 0 "" && frames_as_sim card rpi-pitft-2in8 270 --demo testcard --frames 1 &&
        ended speedtest 0 "" && frames_as_sim speedtest rpi-waveshare-1in44 90 --demo testcard --frames 8 &&
        [ "$(sed -n 's/^asked *\([0-9]*\) Hz, measured *[0-9]* Hz or more: *[0-9.]* frames.s$/\1/p' "$guest_out/speedtest.out" | tr '\n' ,)" = \
            "4000000,8000000,10000000,15000000," ]
}

# The board divides 250 MHz by an even number: 31.25 MHz for 40 MHz.
the_clock_is_measured() {
    ended clocks 0 "" && awk '/^asked/ { steps++; divider = int((250e6 + $2 - 1) / $2); divider += divider % 2
            if ($5 <= 0 || $5 > 250e6 / divider) { print; bad = 1 } }
        END { exit bad || steps != 10 }' "$guest_out/clocks.out" && grep -q 'clock: asks for 40000000 Hz; the SPI controller may make less' "$dir/faults/doctor.out"
}

# Counts the transfers of the last frame but one: its pixels come after 2Ch. Events of one transfer follow each other without a pause.
pixel_transfers() { # name
    awk '$2 == "spi" && $1 != end { n++; if ($11 == "2c") { if (frames++) { print n - 5 } n = 0 } } $2 == "spi" { end = $10 }' \
        "$guest_out/$1.events" | tail -n 1
}

transfers_are_few() { # of a frame in RGB565 on 240x240, in RGB666 on 320x480
    local few wide
    few=$(pixel_transfers few) wide=$(pixel_transfers few-666)
    ended few 0 "" && ended few-666 0 "" && [ "$few $wide" = "$1 $2" ] || { echo "$few $wide, not $1 $2"; return 1; }
}

for board in $pi_boards; do
    check "on $board the wire carries what pinhole-sim draws" rotations_are_as_simulated "$board" "0 270"
done
check "reset, init, first frame, display on, backlight: in this order, and back" the_order_is_right
check "a wire that takes its time carries the same frames" eval 'ended timed 0 "" && frames_as_sim timed rpi-waveshare-1in3 90 --frames 2'
check "with --diff on the last picture is the simulator's" changes_are_the_picture_in_the_end
check "one process shows a scene on two displays" two_displays_show_the_same
check "--view, --start, --overlay, --depth and --band do what they do in pinhole-sim" options_are_the_simulators
check "--refresh sends all of the picture again" all_is_sent_again
check "the select button takes the next demo" select_takes_the_next_demo
check "probe resets the display and names the controller that answers" a_controller_is_reset_and_named
check "a display can be wired by hand, its lines named by label and offset" wires_are_given_by_hand
check "testcard and speedtest show the card, at each clock" the_card_is_at_every_clock
check "speedtest measures the clock on the wire, and doctor claims no other" the_clock_is_measured
cards_that_are_named_are_printed() {
    [ "$(cat "$guest_out/identify.status")" = 0 ] && cat >"$dir/identify" <<'END'
options  --invert off --rotate 180
board.c  .rotation = PANEL_R180,
panel    .x0 = 0, .y0 = 0, .rotation_base = 0x00, and in .init 0x20, 0,
END
    cmp "$dir/identify" "$guest_out/identify.out" && [ "$(grep -c '^Which card' "$guest_out/identify.err")" = 3 ] && released identify
}

# For 20 MHz this bus makes 250 / 14, as a Raspberry Pi does, and does not tell: 240x320 pixels of 16 bits take 68.8 ms, which is
# more than the clock asked for would take. This kernel adds to that, and is late for some of the 100 edges a second.
a_report_tells_of_system_bus_and_lines() {
    report_has report "system $(cat "$guest_out/system")" "device /dev/spidev0.0, bufsiz 65536, libgpiod $(pkg-config --modversion libgpiod)" \
        'bus asked for 20000000 Hz, SPI mode 0; the kernel does not tell what it got' \
        'display st7789-240x320, 240x320, turned 0, bus 20000000 Hz' 'display id: 04h gives 00 85 85 52 00' \
        'cube 240x320 crc32 9587B3C7, as known' 'testcard 240x320 crc32 4D81C648, as known' &&
        awk '/^TE: / { te = $2 > 10 && $2 < 102 && $3 == "edges/s," } /^whole frame: / { bus = $3 >= 68813 && $8 >= 61440 && $8 < 61500 }
            END { exit !te || !bus }' "$guest_out/report.out" || { cat "$guest_out/report.out" && return 1; }
}

check "identify prints what was named" cards_that_are_named_are_printed
check "a report tells of system, device, bus, TE, and who answers" a_report_tells_of_system_bus_and_lines
check "frames wait for the tearing-effect edge, and say so when none comes" frames_wait_for_the_edge
check "with a bufsiz of 65536 a 240x240 frame is 2 transfers, 320x480 in RGB666 is 8" transfers_are_few 2 8
check "hal_linux_with_a_bufsiz_of_65536" hal_passed hal

guest_out=$dir/faults
dark() { # name
    "$B/pinhole-wire" --board rpi-waveshare-1in44 --order "$guest_out/$1.events" | sed -n 's/^order \(.*\) [0-9.]* ms$/\1/p' |
        tail -n 2 | tr '\n' ',' | grep -qx 'backlight off,display off,' || { echo "not dark at the end"; return 1; }
}

board=rpi-waveshare-1in3
a_missing_device_is_told() {
    told nospi 1 "$board: /dev/spidev0.0 is not there: SPI is off; on a Raspberry Pi add dtparam=spi=on to config.txt and restart (other boards: their device tree overlay)"
}

a_busy_line_is_named() {
    local end='end that program, or remove the overlay that claims it'
    told busy 1 "$board: line GPIO25 (/dev/gpiochip0:25) is taken by \"somebody\"; $end" &&
        told chip-select 1 "$board: line GPIO8 (/dev/gpiochip0:8) is taken by \"spi0 CS0\"; $end" &&
        told twice 1 "$board: line GPIO25 (/dev/gpiochip0:25) is taken by \"pinhole\"; $end"
}

what_is_no_device_is_told() {
    told fifo 1 "$board: /tmp/fifo is no SPI device; give a /dev/spidev" &&
        told folder 1 "$board: /dev cannot be opened: Is a directory" &&
        told no-chip 1 "$board: /dev/null is no GPIO chip (looking for line /dev/null:3); gpiodetect lists them" &&
        told no-line 1 "$board: line GPIO99: no chip has it; name it as gpioinfo lists it, or as chip:offset (gpiochip0:25)"
}

a_refused_clock_is_told() {
    told clock-3 1 "$board: the panel does not wake up: /dev/spidev0.0: a clock of 4000000 Hz cannot be set: Invalid argument; ask for another" &&
        told clock-4 1 "$board: the panel does not wake up: /dev/spidev0.0: a clock of 40000000 Hz cannot be set: Invalid argument; ask for another" &&
        released clock-3 && released clock-4
}

a_refused_direction_is_told() {
    told direction 1 "$board: line GPIO27 (/dev/gpiochip0:27) cannot be used: Input/output error; take another line" && released direction
}

the_doctor_knows() {
    ended doctor 0 "" && ! grep -q FAIL "$guest_out/doctor.out" &&
        ended doctor-nospi 1 "" && grep -q '^FAIL  /dev/spidev0.0 is not there: SPI is off' "$guest_out/doctor-nospi.out" &&
        ended doctor-busy 1 "" && [ "$(grep -c FAIL "$guest_out/doctor-busy.out")" = 1 ] &&
        grep -q "^FAIL  D/C: line GPIO25 (/dev/gpiochip0, offset 25) is taken by 'somebody'" "$guest_out/doctor-busy.out"
}

no_permission_names_the_way() {
    told nouser 1 "$board: /dev/spidev0.0: no permission; add yourself to the group spi (usermod -aG spi NAME, then log in again) or install boards/udev/60-pinhole.rules" &&
        told nogpio 1 "$board: /dev/gpiochip0: no permission (looking for line GPIO25); add yourself to the group gpio (usermod -aG gpio NAME, then log in again) or install boards/udev/60-pinhole.rules"
}

a_failing_transfer_ends_the_run() { # number, what was going on, clock
    told "eio-$1" 1 "$board: $2: /dev/spidev0.0: sending N bytes at $3 Hz failed: Input/output error; dmesg may say more" &&
        released "eio-$1"
}

an_unplugged_board_is_told() {
    local frame='rpi-waveshare-1in44: frame N:'
    told unplugged 1 "$frame /dev/spidev0.0 is gone: the SPI device was removed while in use; start again" \
        "$frame the D/C line cannot be set: No such device"
}

a_signal_leaves_it_dark() { # signal, status
    ended "$1" "$2" "frames/s" && dark "$1" && released "$1"
}

# The panel sees both runs; what it rejects of the one that was cut off does not count.
after_a_kill_it_starts_again() {
    local restart
    ended killed 137 "frames/s" && ended after 0 "" || return 1
    restart=$(awk '{ print int($1 / 1e6); exit }' "$guest_out/after.events")
    cat "$guest_out/killed.events" "$guest_out/after.events" >"$dir/both.events"
    "$B/pinhole-wire" --board rpi-waveshare-1in44 "$dir/both.events" 2>"$dir/both.err" | tail -n 2 | cut -d' ' -f4 >"$dir/both"
    "$B/pinhole-sim" --board rpi-waveshare-1in44 --frames 2 --crc | cut -d' ' -f4 | diff - "$dir/both" &&
        awk -v restart="$restart" 'match($0, /[0-9.]+ ms:/) && substr($0, RSTART) + 0 > restart { print; bad = 1 }
            END { exit bad }' "$dir/both.err"
}

check "with a bufsiz of 4096 a 240x240 frame is 29 transfers, 320x480 in RGB666 is 113" transfers_are_few 29 113
check "a device that is not there is told" a_missing_device_is_told
check "what is no SPI device, no GPIO chip or no line is told" what_is_no_device_is_told
check "no permission is told, and the way to it" no_permission_names_the_way
check "a line that somebody has is told, and who has it" a_busy_line_is_named
check "a line that cannot become an output is told" a_refused_direction_is_told
check "a clock that cannot be set is told, lines released" a_refused_clock_is_told
for n in 1 2; do
    check "an error of transfer $n ends the run in one line, lines released" a_failing_transfer_ends_the_run $n "the panel does not wake up" 4000000
done
for n in 100 230; do
    check "an error of transfer $n ends the run in one line, lines released" a_failing_transfer_ends_the_run $n "frame N" 40000000
done
check "doctor finds what is wrong, and nothing else" the_doctor_knows
check "Ctrl-C leaves the panel dark and exits 130" a_signal_leaves_it_dark INT 130
check "SIGTERM leaves the panel dark and exits 143" a_signal_leaves_it_dark TERM 143
check "SIGHUP leaves the panel dark and exits 129" a_signal_leaves_it_dark HUP 129
check "after kill -9 the next start is clean" after_a_kill_it_starts_again
check "an unplugged board ends the run in one line" an_unplugged_board_is_told
check "hal_linux_in_the_guest" hal_passed hal
tap_end
