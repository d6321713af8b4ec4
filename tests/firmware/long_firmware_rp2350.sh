#!/usr/bin/env bash
# Like tests/firmware/long_firmware_rp2350_emulated.sh for every RP2350 board, both instruction sets, with one core and with
# two: every demo for some frames, with buttons pressed. The rates of one board are those of tests/bench/README.md. Images of
# each kind are what the boot ROM starts (rp2350_image.sh).
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build} CHIP=rp2350 ISA
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v riscv64-unknown-elf-gcc >/dev/null || { echo "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf" && exit 77; }

every_demo() { # board, cores, option of the emulator...
    image "$1" "$2" && sweep 4 && emulate "$1" "$2" $((4 * demos)) "$dir/keys" "${@:3}" && expect "$1" $((4 * demos)) "$dir/keys" && same $((4 * demos))
}

light_without_bands() { # board: frames of the first demo are pinhole-sim --dither's, and not those with bands
    local DITHER=4
    image "$1" 2 && emulate "$1" 2 4 && expect "$1" 4 && same 4 && DITHER=0 expect "$1" 4 && ! same 4 >/dev/null
}

as_in_the_table() { # number of demos
    speed_agrees "$1" pico2-display 6
}

make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" "$B/rp2350-emulate" || exit 1
for mk in boards/*/board.mk; do
    { grep -q 'families/pico2.mk' "$mk" && in_share; } || continue
    board=$(basename "$(dirname "$mk")")
    for ISA in arm riscv; do
        check "every_demo_is_the_simulators_on_${board}_with_one_core_$ISA" every_demo "$board" 1
        check "every_demo_is_the_simulators_on_${board}_with_two_cores_$ISA" every_demo "$board" 2 --delays 7 --limit-ms 1000000
    done
done
for ISA in arm riscv; do
    ! in_share || check "frame_rates_are_as_in_the_table_$ISA" as_in_the_table "$("$B/pinhole-sim" --list | awk '$1 == "demo" && !/; by name only$/' | wc -l)"
done
! in_share || ISA=arm check "light_without_bands_is_the_simulators" light_without_bands pico2-display
for ISA in arm riscv; do
    ! in_share || check "images_for_${ISA}_are_what_its_boot_ROM_starts" tests/firmware/rp2350_image.sh
done
tap_end
