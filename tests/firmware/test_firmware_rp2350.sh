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

# As picotool 2.1 writes it (elf2uf2.cpp, gen_abs_block): family "absolute", the first of two, in the last page of 16 MB,
# 256 bytes EFh, and the tag that says to later boot loaders that they may skip it.
first_block_is_against_E10() { # UF2
    od -An -v -tx4 -w512 -N512 "$1" | awk '
        { head = $1 " " $2 " " $3 " " $4 " " $5 " " $6 " " $7 " " $8
          for (i = 9; i <= 72; i++) { bad += $i != "efefefef" }
          for (i = 74; i < 128; i++) { bad += $i != "00000000" } }
        END { if (bad || $73 != "9957e304" || $128 != "0ab16f30" || head != "0a324655 9e5d5157 0000a000 10ffff00 00000100 00000000 00000002 e48bff57") { print head; exit 1 } }'
}

a_file_without_that_block_is_seen() { tail -c +513 "$image.uf2" >"$dir/late.uf2" && ! first_block_is_against_E10 "$dir/late.uf2" >/dev/null; }

uf2_holds_the_bin() { # family
    local blocks=$((($(stat -c %s "$image.bin") + 255) / 256))
    tail -c +513 "$image.uf2" | od -An -v -tx4 -w512 | awk -v family="$1" -v blocks="$(printf '%08x' "$blocks")" '
        $3 != "00002000" || $4 != sprintf("%08x", 268435456 + 256 * (NR - 1)) || $6 != sprintf("%08x", NR - 1) || $7 != blocks || $8 != family { print "block " NR - 1 > "/dev/stderr"; exit 1 }
        { for (i = 9; i <= 72; i++) { print $i } }' >"$dir/payload" || return 1
    { cat "$image.bin" && head -c $((256 * blocks - $(stat -c %s "$image.bin"))) /dev/zero; } >"$dir/padded" && words "$dir/padded" | cmp - "$dir/payload"
}

binary_info() { od -An -v -tu1 -w16 "$image.bin" | awk -v rp2350=1 -f tests/firmware/binary_info.awk; }

image_tells_what_it_is() { # ISA
    binary_info | diff - <(printf '%s\n' 'name Pinhole demos' "version $(sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/version.h)" "board $board" \
        "attribute ISA=$1" 'attribute CORES=2 CHANGES=1' "end $((0x10000000 + $(stat -c %s "$image.bin")))" \
        'pin 0 function 2' 'pin 1 function 2' 'pin 18 function 1' 'pin 19 function 1' 'pin 18 clock' 'pin 19 data' 'pin 17 chip select' \
        'pin 16 D/C' 'pin 20 backlight' 'pin 12 button up' 'pin 13 button down' 'pin 14 button left' 'pin 15 button right')
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
check "the_UF2_begins_with_the_block_against_erratum_E10" first_block_is_against_E10 "$image.uf2"
check "... one that does not is seen" a_file_without_that_block_is_seen
check "the_UF2_holds_the_BIN_with_the_family_rp2350_arm_s" uf2_holds_the_bin e48bff59
check "the_image_tells_its_name_its_board_and_its_pins" image_tells_what_it_is arm
check "the_registers_are_the_chips_own" registers_are_the_chips_own
tap_end
