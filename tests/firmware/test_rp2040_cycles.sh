#!/usr/bin/env bash
# The emulated RP2040 counts the cycles of a small program in flash (rp2040_cycles.S): instructions as the Cortex-M0+ TRM
# has them, and a miss of the flash's cache for each word that is not in it.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here

builds() {
    : >"$dir/ram_tiers.ld" && : >"$dir/flash_tiers.ld" && # it has no functions with tiers
        arm-none-eabi-gcc -mcpu=cortex-m0plus -nostdlib -Ihal -Ihal/rp2040 -L "$dir" -T hal/rp2040/rp2040.ld -Wl,--defsym=stack_bytes=256,--defsym=stack_core1_bytes=0 -o "$dir/cycles.elf" \
            hal/rp2040/boot2.S tests/firmware/rp2040_cycles.S && hal/rp2040/boot2_seal.sh cc arm-none-eabi- "$dir/cycles.elf" &&
        arm-none-eabi-objcopy -O binary "$dir/cycles.elf" "$dir/cycles.bin"
}

counted() { # flash chip
    # shellcheck disable=SC2046 # an address a word
    node tests/firmware/rp2040_cycles.mjs "$B/rp2040js/node_modules" "$dir/cycles.bin" "$1" \
        $(arm-none-eabi-nm "$dir/cycles.elf" | awk '$3 ~ /^mark/ { print $3, $1 }' | sort | cut -d' ' -f2)
}

# What is counted with a miss of so many cycles: 64 nops in 32 words; a loop of 14 instructions, 100 times, 7 words and that
# of the mark behind; two calls of a function of 4 pushes and pops (4 + 2 + 2 + 6), 5 words; two words of one set, read ten
# times (2 + 2 * 3 + 3 a time): both stay, beside 5 words of code and 2 literals; three words: only the first two are there
# once, beside 7 words of code.
cycles_are() { # cycles of a miss, flash chip
    local m=$1 want got
    want="$((64 + 32 * m)) $((1501 + 8 * m)) $((41 + 5 * m)) $((115 + 9 * m)) $((145 + 35 * m))"
    got=$(counted "$2")
    [ "$got" = "$want" ] || { echo "counted $got, expected $want" && return 1; }
}

check "the_program_builds" builds
check "each_word_costs_a_miss_once_on_four_lines" cycles_are 45 w25q16jv
check "a_flash_whose_QE_is_clear_is_read_on_four_lines_too" cycles_are 45 w25q16jv-im
check "another_flash_is_read_by_command_03h" cycles_are 256 gd25q16c
check "one_of_Winbond_without_four_lines_too" cycles_are 256 w25x16
tap_end
