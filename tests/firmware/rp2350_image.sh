#!/usr/bin/env bash
# Images for the RP2350, for its Arm and its RISC-V cores, keep to their budgets, and are what its boot ROM starts: vectors at
# the beginning of flash or an entry point, an image definition within the first 4 KB, UF2 blocks of the right family.
# Environment: ISA (arm, riscv). long_firmware_rp2350.sh calls it with each.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build} ISA=${ISA:-arm}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
board=pico2-display-2

of() { # ISA: what follows is about this image
    isa=$1 cross=arm-none-eabi- image=$B/firmware/$board-demos-cores2-fps30
    [ "$isa" = arm ] || cross=riscv64-unknown-elf- image=$B/firmware/$board-demos-$isa-cores2-fps30
}

builds() { # the image that test_firmware_scene.sh takes, too
    make_image firmware BOARD="$board" ISA="$isa" CORES=2 CLIP_FPS=30 >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
    cat "$dir/said"
    grep -q '^flash .* of 4194304 bytes' "$dir/said" && grep -q '^stack ' "$dir/said"
}

# 256 bytes are core 1's guard; an interrupt's frame is 32 bytes for Arm, 64 for RISC-V.
stack_of_core_1_has_a_bound() {
    local size bound frame=64
    [ "$isa" = riscv ] || frame=32
    size=$((0x$("${cross}nm" "$image.elf" | awk '$3 == "stack_core1_bytes" { print $1 }')))
    bound=$(find "${image/-demos/}-objects" -name '*.ci' -exec cat {} + | awk -v library=96 -v list=1 -v of=hal/chips/rp2/cores2.c:serve -f firmware/tools/stack.awk | awk '/^worst/ { print $2 }')
    echo "at most $bound of $size"
    [ "$bound" -gt 1000 ] && [ $((bound + frame)) -le $((size - 256)) ]
}

only_its_compilers_library() { grep -q 'libgcc\.a' "$image.map" && ! grep -qE "/lib(c|g|m|nosys)(_nano)?\.a" "$image.map"; }

bit_manipulation_is_used() { "${cross}objdump" -d "$image.elf" | grep -qE '\ssh[123]add\s'; }

words() { od -An -v -tx4 -w4 "$1" | tr -d ' '; } # of a BIN file, one a line

symbol() { "${cross}nm" "$image.elf" | awk -v name="$1" '$3 == name { print $1 }'; }

odd() { printf '%08x' $((0x$1 | 1)); } # address of Thumb code as a vector has it

# Words of the block in the order of the RP2350 datasheet, 5.9.5: marker, image type, last item, link to itself, marker; for
# RISC-V also an entry point (5.9.3.4).
definition_is_there() { # BIN
    local expected='ffffded3 10210142 000001ff 00000000 ab123579 '
    [ "$isa" = arm ] || expected="ffffded3 11010142 00000344 $(symbol rp2_reset) $(symbol ld_stack_top) 000004ff 00000000 ab123579 "
    words "$1" | head -n 1024 | awk -v expected="$expected" '
        $1 == "ffffded3" { at = NR }
        at { block = block $1 " " }
        at && $1 == "ab123579" { exit }
        END { if (block != expected) { print "block: " block; exit 1 } }'
}

other_chips_definition_is_seen() {
    LC_ALL=C sed 's/\x42\x01\(.\)[\x10\x11]/\x42\x01\1\x00/' "$image.bin" >"$dir/wrong.bin"
    ! cmp -s "$image.bin" "$dir/wrong.bin" && ! definition_is_there "$dir/wrong.bin" >/dev/null
}

vectors_are_at_the_beginning() { # stack, reset; timer 0 is interrupt 0, DMA 0 is interrupt 10
    mapfile -t vector < <(words "$image.bin" | head -n 68)
    [ "${vector[0]}" = "$(symbol ld_stack_top)" ] && [ "${vector[1]}" = "$(odd "$(symbol rp2_reset)")" ] &&
        [ "${vector[16]}" = "$(odd "$(symbol rp2_timer_interrupt)")" ] && [ "${vector[26]}" = "$(odd "$(symbol rp2_bus_interrupt)")" ]
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

image_tells_what_it_is() {
    binary_info | diff - <(printf '%s\n' 'name Pinhole demos' "version $(sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)" "board $board" \
        "attribute ISA=$isa" 'attribute CORES=2 CHANGES=1' 'feature takes a scene at 0x10080000' "end $((0x10000000 + $(stat -c %s "$image.bin")))" \
        'pin 0 function 2' 'pin 1 function 2' 'pin 18 function 1' 'pin 19 function 1' 'pin 18 clock' 'pin 19 data' 'pin 17 chip select' \
        'pin 16 D/C' 'pin 20 backlight' 'pin 12 button up' 'pin 13 button down' 'pin 14 button left' 'pin 15 button right')
}

# The words of literals: the RP2350's SPI1 or SPI0 and pads are used, those of the RP2040 are not.
registers_are_the_chips_own() {
    words "$image.bin" >"$dir/words"
    grep -q '^400800' "$dir/words" && grep -q '^400380' "$dir/words" && ! grep -Eq '^4001c0|^4003c0|^d0000060$' "$dir/words"
}

every_image() { # UF2 family
    check "an_image_for_two_cores_of_${isa}_keeps_to_its_budget" builds
    check "its_image_definition_is_within_the_first_4_KB" definition_is_there "$image.bin"
    check "... that_of_another_chip_is_seen" other_chips_definition_is_seen
    check "its_UF2_begins_with_the_block_against_erratum_E10" first_block_is_against_E10 "$image.uf2"
    check "... one_that_does_not_is_seen" a_file_without_that_block_is_seen
    check "its_UF2_holds_the_BIN_with_its_family" uf2_holds_the_bin "$1"
    check "it_tells_its_name_its_board_and_its_pins" image_tells_what_it_is
    check "the_stack_of_its_second_core_has_a_bound" stack_of_core_1_has_a_bound
}

if [ "$ISA" = arm ]; then
    of arm
    every_image e48bff59
    check "the_vectors_are_at_the_beginning_of_flash" vectors_are_at_the_beginning
    check "the_registers_are_the_chips_own" registers_are_the_chips_own
elif command -v riscv64-unknown-elf-gcc >/dev/null; then
    of riscv
    every_image e48bff5a
    check "its_only_library_is_the_compilers" only_its_compilers_library
    check "it_uses_the_bit_manipulation_of_Hazard3" bit_manipulation_is_used
else
    skip "images_for_RISC-V" "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf"
fi
tap_end
