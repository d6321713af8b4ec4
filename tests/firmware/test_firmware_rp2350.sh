#!/usr/bin/env bash
# Images for the RP2350 (Cortex-M33) keep to their budgets, and are what its boot ROM starts: vectors at the beginning of
# flash, an image definition within the first 4 KB, UF2 blocks of the chip's family. No emulator runs them yet.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}/firmware-rp2350
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
board=pico2-display-2
image=$B/firmware/$board-demos-cores2

builds() {
    make -s -j2 B="$B" firmware BOARD="$board" CORES=2 >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
    cat "$dir/said"
    grep -q '^flash .* of 4194304 bytes' "$dir/said" && grep -q '^stack ' "$dir/said"
}

words() { od -An -v -tx4 -w4 "$1" | tr -d ' '; } # of a BIN file, one a line

symbol() { arm-none-eabi-nm "$image.elf" | awk -v name="$1" '$3 == name { print $1 }'; }

odd() { printf '%08x' $((0x$1 | 1)); } # address of Thumb code as a vector has it

# Words of the block in the order of the RP2350 datasheet, 5.9.5: marker, image type, last item, link to itself, marker.
definition_is_there() { # BIN
    words "$1" | head -n 1024 | awk '
        $1 == "ffffded3" { at = NR }
        at { block = block $1 " " }
        at && NR == at + 4 { exit }
        END { if (block != "ffffded3 10210142 000001ff 00000000 ab123579 ") { print "block: " block; exit 1 } }'
}

other_chips_definition_is_seen() {
    sed 's/\x42\x01\x21\x10/\x42\x01\x21\x00/' "$image.bin" >"$dir/wrong.bin"
    ! cmp -s "$image.bin" "$dir/wrong.bin" && ! definition_is_there "$dir/wrong.bin" >/dev/null
}

vectors_are_at_the_beginning() { # stack, reset; timer 0 is interrupt 0, DMA 0 is interrupt 10
    mapfile -t vector < <(words "$image.bin" | head -n 68)
    [ "${vector[0]}" = "$(symbol ld_stack_top)" ] && [ "${vector[1]}" = "$(odd "$(symbol rp2040_reset)")" ] &&
        [ "${vector[16]}" = "$(odd "$(symbol rp2040_timer_interrupt)")" ] && [ "${vector[26]}" = "$(odd "$(symbol rp2040_spi_interrupt)")" ]
}

blocks_name_the_family() {
    [ "$(od -An -v -tx4 -w512 "$image.uf2" | awk '{ print $3, $8 }' | sort -u)" = '00002000 e48bff59' ]
}

# The words of literals: the RP2350's SPI1 or SPI0 and pads are used, those of the RP2040 are not.
registers_are_the_chips_own() {
    words "$image.bin" >"$dir/words"
    grep -q '^400800' "$dir/words" && grep -q '^400380' "$dir/words" && ! grep -Eq '^4001c0|^4003c0|^d0000060$' "$dir/words"
}

check "an_image_for_two_cores_keeps_to_its_budget" builds
check "the_vectors_are_at_the_beginning_of_flash" vectors_are_at_the_beginning
check "the_image_definition_is_within_the_first_4_KB" definition_is_there "$image.bin"
check "the_image_definition_of_another_chip_is_seen" other_chips_definition_is_seen
check "UF2_blocks_name_the_family_rp2350_arm_s" blocks_name_the_family
check "the_registers_are_the_chips_own" registers_are_the_chips_own
tap_end
