#!/usr/bin/env bash
# R on an image's UART writes a report to paste, on every emulated chip: each line is there, and tells what the emulator
# was told that the chip is. Another chip, clock or reset makes another report.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export LONG=1
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
version=$(sed -n 's/.*PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)
compiler="gcc $(echo __VERSION__ | arm-none-eabi-gcc -E -P - | tr -d '"')"

# What stands between the marks, to $dir/report.
take_report() {
    tr -d '\r' <"$dir/log" | grep -v '^emulate: ' | awk '/^---- Pinhole report: copy from here ----$/ { on = 1 } on { print } /^---- Pinhole report: to here ----$/ { exit }' >"$dir/report"
    [ "$(tail -n 1 "$dir/report")" = '---- Pinhole report: to here ----' ] || { cat "$dir/log" && return 1; }
}

report() { # board, cores, option of the emulator...
    EVENTS_ONLY=1 emulate "$1" "$2" 22 - --send 1:RG "${@:3}" && take_report
}

has() { # line...
    local line
    for line in "$@"; do
        grep -qxF -- "$line" "$dir/report" || { echo "no '$line' in" && cat "$dir/report" && return 1; }
    done
}

# Lines of people's reports must not be wrapped, and say nothing but ASCII.
can_be_pasted() {
    awk 'length($0) >= 80 { print "too long: " $0; bad = 1 } END { exit bad || NR < 14 }' "$dir/report" && ! LC_ALL=C grep -n '[^ -~]' "$dir/report"
}

ring_is() { # kHz, as the counter found it, to 1 kHz
    local khz
    khz=$(sed -n 's/^clocks .*, ring \([0-9]*\)$/\1/p' "$dir/report")
    [ "$khz" -ge $(($1 - 1)) ] && [ "$khz" -le $(($1 + 1)) ] || { echo "ring $khz, not $1" && return 1; }
}

# A whole frame takes as long as its bits, and at most a twentieth more for the driver.
bus_time_is_right() { # us of the bits
    awk -v us="$1" '/^whole frame: / { n++; if ($3 < us || $3 > us * 1.05 || $8 != us) { print; bad = 1 } } END { exit bad || n != 1 }' "$dir/report"
}

# The example in the paper has the lines of a report: their first words, up to a number.
names() { awk '{ sub(/[0-9].*/, ""); print $1, $2 }' "$1"; }
is_the_papers_example() {
    sed -n '/^---- Pinhole report: copy/,/^---- Pinhole report: to here/p' firmware/README.md >"$dir/paper"
    diff <(names "$dir/paper") <(names "$dir/report")
}

on_an_rp2040() {
    local board=pico-display
    make_image firmware BOARD="$board" >/dev/null && report "$board" 1 && can_be_pasted && bus_time_is_right 8296 && ring_is 6500 &&
        has "Pinhole $version, demos for $board, CORES=1 CHANGES=1" "compiler $compiler" 'kit Raspberry Pi Pico with Pimoroni Pico Display Pack, 1.14", 240x135' \
            'chip RP2040, id 20002927, revision 2' 'started by: power on, or brown-out (reasons 0 100)' \
            'display st7789-135x240, 240x135, turned 90, bus 62500000 Hz' 'display id: MISO is not wired' 'TE: not wired' \
            'left out: 0 triangles 0 vertices; sent before the report: 2 frames' \
            'cube 240x135 crc32 E7B4F73C, as known' 'testcard 240x135 crc32 99FF17F2, as known' 'self-test: passed' || return 1
    grep -q '^clocks by the 12 MHz crystal, kHz: sys 125000, peri 125000, ring ' "$dir/report" && grep -q '^flash id ' "$dir/report" &&
        grep -qE '^turntable, 1 core: 16 frames in [1-9][0-9]* ms, [1-9][0-9]*\.[0-9] frames/s$' "$dir/report" && is_the_papers_example
}

another_rp2040_is_another_report() {
    local board=pico-display
    make_image firmware BOARD="$board" CORES=2 >/dev/null && report "$board" 2 --chip ring=7123456,id=0x10002927,reset=0x10000 && can_be_pasted && ring_is 7123 &&
        has "Pinhole $version, demos for $board, CORES=2 CHANGES=1" 'chip RP2040, id 10002927, revision 1' 'started by: the RUN pin (reasons 0 10000)' &&
        grep -q '^turntable, 2 cores: ' "$dir/report"
}

a_watchdog_reset_is_told() { # 1: a boot loader let it run out, as after flashing; 2: software forced it
    make_image firmware BOARD=pico-display >/dev/null && report pico-display 1 --chip reason=1 && has 'started by: a boot loader, through the watchdog (reasons 1 100)' &&
        report pico-display 1 --chip reason=2 && has 'started by: a reset by software (reasons 2 100)'
}

a_ring_that_stands_is_0() { make_image firmware BOARD=pico-display >/dev/null && report pico-display 1 --chip ring=0 && ring_is 0; }

on_an_rp2350() { # ISA, compiler
    local board=pico2-display compiler
    export ISA=$1
    compiler="gcc $(echo __VERSION__ | "$2" -E -P - | tr -d '"')"
    make -s -j2 B="$B" "$B/rp2350-emulate" && make_image firmware BOARD="$board" CORES=2 >/dev/null &&
        CHIP=rp2350 report "$board" 2 --chip ring=9876543,id=0x30004927,reset=0x40000 && can_be_pasted && bus_time_is_right 8296 && ring_is 9876 &&
        has "Pinhole $version, demos for $board, CORES=2 CHANGES=1 ISA=$1" "compiler $compiler" 'chip RP2350, id 30004927, revision 3' \
            'started by: the RUN pin (reasons 0 40000)' 'cube 240x135 crc32 E7B4F73C, as known' 'self-test: passed' || return 1
    grep -q '^clocks by the 12 MHz crystal, kHz: sys 150000, peri 125000, ring ' "$dir/report" && grep -q '^turntable, 2 cores: ' "$dir/report" &&
        CHIP=rp2350 report "$board" 2 --chip reason=1 && ring_is 11000 && has 'chip RP2350, id 20004927, revision 2' 'started by: a boot loader, through the watchdog (reasons 1 10000)'
}

# Runs an image in QEMU, sends R when a demo runs, and reads until the report ends.
in_qemu() { # board, machine's words...
    local line board=$1
    make_image firmware BOARD="$board" >/dev/null || return 1
    coproc UART { exec timeout 300 qemu-system-arm -M "${@:2}" -serial stdio -display none -monitor none -nic none -icount shift=5,sleep=off \
        -semihosting-config enable=on,target=native -kernel "$B/firmware/$board-demos.elf" 2>/dev/null; }
    local pid=$UART_PID
    : >"$dir/log"
    while IFS= read -rt 200 line <&"${UART[0]}"; do
        echo "$line" >>"$dir/log"
        [[ $line != 'demo turntable'* ]] || printf R >&"${UART[1]}"
        [[ $line != *'report: to here'* ]] || break
    done
    kill "$pid" && wait "$pid"
    take_report && can_be_pasted && has "Pinhole $version, demos for $board, CORES=1 CHANGES=0" "compiler $compiler" 'self-test: passed'
}

on_the_lm3s6965() { # QEMU's ids are those of the chip; it says nothing of resets, and its SPI takes no time
    in_qemu lm3s6965evb lm3s6965evb && has 'chip LM3S, ids 10010002 1073402E' 'clock of the 8 MHz crystal by the PLL, not measured: kHz 50000' \
        'display ssd0323-128x64, 128x64, turned 0, bus 3125000 Hz' && grep -q '^started by (since power on):.* (reasons [0-9A-F]*)$' "$dir/report"
}

on_the_stm32f4() { # QEMU has no clocks of this chip: it stays at the HSI, and the report says so
    in_qemu feather-stm32f405 netduinoplus2 -serial null -serial null && has 'clock HSI, because crystal or PLL did not start: kHz 16000' 'display id: this port cannot read it' &&
        grep -q '^chip STM32F4, id ' "$dir/report" && grep -q '^started by (since power on): (reasons 0)$' "$dir/report"
}

if (rp2040_here); then
    long "on an RP2040 each line is there, with the chip's values" on_an_rp2040
    long "another RP2040 has another report" another_rp2040_is_another_report
    long "a reset by the watchdog is told" a_watchdog_reset_is_told
    long "a ring oscillator that stands is told" a_ring_that_stands_is_0
else
    skip "on an RP2040" "no node or npm"
fi
long "on an RP2350" on_an_rp2350 arm arm-none-eabi-gcc
if command -v riscv64-unknown-elf-gcc >/dev/null; then long "on its Hazard3" on_an_rp2350 riscv riscv64-unknown-elf-gcc; else skip "on its Hazard3" "no riscv64-unknown-elf-gcc"; fi
if command -v qemu-system-arm >/dev/null; then
    unset ISA
    long "on an LM3S6965" on_the_lm3s6965
    long "on an STM32F405 without its crystal" on_the_stm32f4
else
    skip "in QEMU" "no qemu-system-arm"
fi
tap_end
