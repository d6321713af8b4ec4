#!/usr/bin/env bash
# Every global symbol of hal has a prefix that says whose it is: the folder's name, and board_ for boards; rp2_ for what the
# RP2040 and the RP2350 have in common. The ports of microcontrollers also define the functions of port.h, port_..., and those that the compiler calls, __aeabi_...
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

others() { # prefixes, object or library: the symbols without one of them
    nm -g --defined-only "$2" | awk 'NF == 3 { print $3 }' | grep -vE "^($1)_"
}

library() {
    make -s -j2 B="$B" "$B/libpinhole-hal.a" && ! others 'linux|kms|ft232h|null|panel|board' "$B/libpinhole-hal.a"
}

port() { # folder below hal, its prefixes, compiler and its flags
    local file wrong=0
    local chip=$1
    [ "$1" != chips/rp2 ] || chip=rp2040 # whose registers.h and cpu.h
    for file in "hal/$1"/*.[cS]; do
        case $file in */boot2_seal.c) continue ;; esac # runs on the machine that builds
        "${@:3}" -O1 -ffreestanding -Ihal "-Ihal/$chip" "-Ihal/${chip%/*}" -c "$file" -o "$dir/object.o" || return 1
        ! others "$2|port|__aeabi" "$dir/object.o" || wrong=1
    done
    return "$wrong"
}

prefix_is_missed() {
    echo 'int spi_open(void); int spi_open(void) { return 0; }' >"$dir/wrong.c" && cc -c "$dir/wrong.c" -o "$dir/wrong.o" &&
        [ "$(others linux "$dir/wrong.o")" = spi_open ]
}

check "a_symbol_without_a_prefix_is_seen" prefix_is_missed
check "the_library_exports_only_names_with_its_prefixes" library
named() { # folder, its prefixes, compiler and its flags
    if command -v "$3" >/dev/null; then
        check "the_port_${1}_exports_only_names_with_its_prefixes" port "$@"
    else
        skip "the_port_${1}_exports_only_names_with_its_prefixes" "no $3"
    fi
}
for folder in lm3s6965 stm32f4 template chips/cortexm chips/rp2; do named "$folder" "${folder#*/}" arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb; done
for folder in rp2040 rp2350 rp2350/arm; do named "$folder" "${folder%/*}|rp2" arm-none-eabi-gcc -mcpu=cortex-m33 -mthumb -Ihal/rp2350/arm; done
named rp2350/riscv 'rp2350|rp2' riscv64-unknown-elf-gcc -march=rv32imac_zicsr -mabi=ilp32
tap_end
