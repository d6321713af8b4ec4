#!/usr/bin/env bash
# `make flash`: what it calls for which board, and the one line when the tool is not there or fails. The tools are scripts
# here that say how they were called. (pinhole-flash itself: long_guest_flash.sh.)
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir "$dir/tools" "$dir/none" "$dir/b"
for tool in tools/dfu-util tools/openocd b/pinhole-flash; do
    # shellcheck disable=SC2016 # the script's own
    printf '#!/bin/sh\necho "${0##*/}"; for word; do echo "$word"; done\nexit "${TOOL_STATUS:-0}"\n' >"$dir/$tool" && chmod +x "$dir/$tool"
done

# The image counts as made.
flash() {
    PATH=$dir/tools:$PATH make -s B="$dir/b" -o firmware -o "$dir/b/pinhole-flash" flash "$@"
}

calls() { # arguments of make, word...
    local arguments=$1
    shift
    # shellcheck disable=SC2086 # words
    flash $arguments >"$dir/called" 2>"$dir/err" || { cat "$dir/err" && return 1; }
    diff <(printf '%s\n' "$@") "$dir/called"
}

fails_in_one_line() {
    TOOL_STATUS=74 flash BOARD=feather-stm32f405 >"$dir/out" 2>"$dir/err" && return 1
    [ "$(grep -vc '^make[][0-9]*: \*\*\*' "$dir/err")" = 1 ] &&
        grep -qxF 'make flash: dfu-util failed; start the chip in its boot loader (0483:df11): BOOT0 high while it is reset, or send B to its UART' "$dir/err"
}

lacks() { # tool
    local shell
    shell=$(command -v sh)
    PATH=$dir/none "$shell" firmware/tools/flash_with.sh hint "$1" argument >"$dir/out" 2>&1 && return 1
    diff "$dir/out" - <<<"make flash: $1 is not here; apt-get install $1"
}

no_board() {
    make -s B="$dir/b" flash >"$dir/out" 2>&1 && return 1
    grep -q '^BOARD= is missing; microcontroller boards are: .*pico-display' "$dir/out"
}

an_image_is_made_first() {
    make -n B="$dir/b" flash BOARD=pico-display 2>/dev/null >"$dir/plan"
    grep -q 'pinhole_flash.c' "$dir/plan" && awk '/-c firmware\/core\/render|OUT=/ { image = 1 } /pico-display-demos.uf2.$/ || /pico-display-demos.uf2. *$/ { last = image } END { exit !last }' "$dir/plan"
}

check "an RP2040 gets its UF2 from pinhole-flash" calls "BOARD=pico-display" pinhole-flash "$dir/b/firmware/pico-display-demos.uf2"
check "... the one of several that SERIAL names" calls "BOARD=pico-display APP=depth SERIAL=1:7" \
    pinhole-flash "$dir/b/firmware/pico-display-depth.uf2" --serial 1:7
check "an RP2350 gets its UF2 for the cores that ISA names" calls "BOARD=pico2-display ISA=riscv CORES=2 SERIAL=E6" \
    pinhole-flash "$dir/b/firmware/pico2-display-demos-riscv-cores2.uf2" --serial E6
check "... and a binary scene behind its image" calls "BOARD=pico2-display SCENE=my.phs" pinhole-flash my.phs --at-scene
check "an STM32 gets its BIN from dfu-util, at the start of its flash" calls "BOARD=feather-stm32f405" \
    dfu-util --device 0483:df11 --alt 0 --dfuse-address 0x08000000:leave --download "$dir/b/firmware/feather-stm32f405-demos.bin"
check "an LM3S6965 gets its ELF from openocd" calls "BOARD=lm3s6965evb" \
    openocd -f board/ek-lm3s6965.cfg -c "program {$dir/b/firmware/lm3s6965evb-demos.elf} verify reset exit"
check "a tool that fails is one line with what the board needs" fails_in_one_line
check "dfu-util that is not there is one line" lacks dfu-util
check "openocd that is not there is one line" lacks openocd
check "without BOARD it names the boards" no_board
if command -v arm-none-eabi-gcc >/dev/null; then
    check "the image is made first" an_image_is_made_first
else
    skip "the image is made first" "no arm-none-eabi-gcc here"
fi
if command -v dfu-util >/dev/null; then
    check "dfu-util knows these options" eval '! dfu-util --device 0483:df11 --alt 0 --dfuse-address 0x08000000:leave --download README.md 2>&1 | grep -i usage'
else
    skip "dfu-util knows these options" "it is not installed"
fi
if command -v openocd >/dev/null; then
    check "openocd knows this board" eval 'openocd -f board/ek-lm3s6965.cfg -c shutdown'
else
    skip "openocd knows this board" "it is not installed"
fi
tap_end
