#!/usr/bin/env bash
# The UF2 file of the Feather STM32F405 is one that TinyUF2 starts: it runs in QEMU behind a program that does what TinyUF2
# does (ports/stm32f4/boards.c: board_app_valid, board_app_jump). ELF and BIN, for dfu-util, begin at the beginning of flash.
# (long_firmware.sh looks at the UF2 file's blocks.)
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
board=feather-stm32f405
image=$B/firmware/$board-demos
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

builds() {
    make -s -j2 B="$B" "$B/pinhole-emulate" "$B/pinhole-sim" && make_image firmware BOARD="$board" >"$dir/built"
}

# Assembles a boot loader with the payload behind it. VTOR 0: it leaves its own vectors in force.
boot_loader() { # VTOR
    arm-none-eabi-objcopy -I binary -O binary --interleave=512 --interleave-width=256 --byte=32 "$image.uf2" "$dir/payload.bin"
    cat >"$dir/loader.S" <<EOT
    .syntax unified
    .cpu cortex-m4
    .thumb
    .text
    .word 0x20010000, start + 1
    .global start
    .thumb_func
start:
    ldr r4, =0x08010000
    ldr r0, [r4]      /* the stack lies in RAM */
    ldr r1, =0xff000003
    ands r1, r0
    cmp r1, #0x20000000
    bne stay
    ldr r1, [r4, #4]  /* the entry lies in the application */
    cmp r1, r4
    blo stay
    ldr r2, =0x08110000
    cmp r1, r2
    bhi stay
    ldr r2, =0xe000ed08
    ldr r3, =$1 * 0x08010000 + (1 - $1) * 0x08000000
    str r3, [r2]
    msr msp, r0
    msr psp, r0
    bx r1
stay:
    b stay
    .section .app, "a"
    .incbin "$dir/payload.bin"
EOT
    arm-none-eabi-gcc -c -o "$dir/loader.o" "$dir/loader.S" &&
        arm-none-eabi-ld -Ttext=0x08000000 --section-start=.app=0x08010000 -e start -o "$dir/loader.elf" "$dir/loader.o"
}

draws_behind_a_boot_loader() { # VTOR
    printf '%s select\n' 2 4 >"$dir/keys"
    boot_loader "$1" || return 1
    timeout 600 "$B/pinhole-emulate" --machine netduinoplus2 --board "$board" --keys "$dir/keys" "$dir/loader.elf" "$dir/out" 6 >"$dir/seen" || return 1
    "$B/pinhole-sim" --board "$board" --frames 6 --keys "$dir/keys" --crc 2>/dev/null >"$dir/expected"
    [ "$(wc -l <"$dir/seen")" = 6 ] && cmp "$dir/seen" "$dir/expected"
}

elf_and_bin_begin_at_flash() { # and the second word of the BIN is the ELF's entry
    local entry
    entry=$(arm-none-eabi-readelf -h "$image.elf" | sed -n 's/.*Entry point address: *0x//p')
    arm-none-eabi-readelf -lW "$image.elf" | grep -q 'LOAD *0x[0-9a-f]* 0x08000000' && od -An -tx4 -j4 -N4 "$image.bin" | grep -qx " 0*$entry"
}

# An image that only fits without the boot loader is refused: its UF2 file would not fit.
too_large_is_refused() {
    cat >"$dir/large.c" <<EOT
#include "port.h"
const char large[1000 * 1024] = {1};
const char *volatile at = large;
int main(void) { port_log(at); return 0; }
EOT
    make_image firmware BOARD="$board" APP="$dir/large.c" >"$dir/said" 2>&1 && echo "it is built" && return 1
    grep -q 'too large for the chip: its FLASH lacks [0-9]* bytes' "$dir/said" || { cat "$dir/said" && return 1; }
}

check "the_image_builds" builds
check "behind_TinyUF2_the_image_draws_the_simulators_frames" draws_behind_a_boot_loader 1
check "it_does_so_with_the_boot_loaders_vectors_in_force" draws_behind_a_boot_loader 0
check "ELF_and_BIN_begin_at_the_beginning_of_flash" elf_and_bin_begin_at_flash
check "an_image_that_does_not_fit_behind_the_boot_loader_is_refused" too_large_is_refused
tap_end
