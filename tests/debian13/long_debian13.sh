#!/usr/bin/env bash
# Pinhole on Debian 13, whose compilers, linker, libraries and QEMU are newer than Debian 12's: everything builds without a
# warning, `make check` passes, libgpiod 2 drives the virtual board, and picotool reads what we write.
# shellcheck disable=SC2317,SC2016 # functions are called by check; "$1" is the inner shell's
set -u
cd "$(dirname "$0")/../.." || exit 1
unset MAKEFLAGS
. tests/tools/tap.sh
. tests/debian13/root.sh

# check, and how long it took.
timed() {
    local start=$SECONDS
    check "$@"
    echo "# $((SECONDS - start)) s"
}

# All with the same flags: what one builds the next finds built.
strict() { debian13 env CFLAGS='-O2 -g -Werror' "$@"; }

build() { # build directory, compiler
    strict make -k -s -j"$(nproc)" B="$1" CC="$2" all test-programs long-programs
}

frames_are_ours() { # build directory
    debian13 bash -c '. tests/tools/frames.sh; frames "$1/pinhole-sim" | diff - tests/golden/frames.txt' - "$1"
}

# A test script of the tree; it is skipped here when it skips all that it has.
script() { # name, file
    local start=$SECONDS said status
    said=$(strict "$2" 2>&1)
    status=$?
    ended() { echo "$said" && [ "$status" = 0 ]; }
    if [ $status = 0 ] && ! grep '^ok ' <<<"$said" | grep -qv '# SKIP '; then
        skip "$1" "$(sed -n 's/.*# SKIP //p' <<<"$said" | head -n 1)"
    else
        check "$1" ended
    fi
    echo "# $((SECONDS - start)) s"
}

images_build() {
    local board
    for board in pico-display lm3s6965evb feather-stm32f405; do
        debian13 make -s -j"$(nproc)" CPPFLAGS=-Werror firmware BOARD="$board" || return 1
    done
}

picotool_reads_images() {
    local kind
    for kind in uf2 elf bin; do
        debian13 picotool info -a "$image.$kind" || return 1
    done
    debian13 picotool info -a "$image.uf2" | grep -q "family ID 'rp2040'"
}

picotool_shows_what_the_image_is() {
    local kind line version
    version=$(sed -n 's/^#define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)
    for kind in uf2 elf; do
        debian13 picotool info -a "$image.$kind" | tr -s ' ' | tee /dev/stderr >"$debian13_root/tmp/info" || return 1
        for line in 'name: Pinhole demos' "version: $version" 'pico_board: pico-display' 'build attributes: CORES=1 CHANGES=1' 'features: takes a scene at 0x10080000' '0: UART0 TX' \
            '16: D/C' '18: SPI0 SCK, clock' '19: SPI0 TX, data' '20: backlight' '12: button up'; do
            grep -qxF " $line" "$debian13_root/tmp/info" || { echo "$kind: no '$line'" && return 1; }
        done
    done
}

# Every RP2350 board. The images are built outside: the compiler for RISC-V is a package of the tests there.
picotool_knows_rp2350_images() { # ISA, suffix of the image, family, image type
    local board line kind version
    version=$(sed -n 's/^#define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)
    for board in $(rp2350_boards); do
        make -s -j"$(nproc)" B="$B" firmware BOARD="$board" ISA="$1" || return 1
        for kind in uf2 elf bin; do
            cp "$B/firmware/$board-demos$2.$kind" "$debian13_root/tmp/rp2350.$kind" &&
                debian13 picotool info -a "/tmp/rp2350.$kind" | tr -s ' ' >"$debian13_root/tmp/info" || return 1
            for line in 'name: Pinhole demos' "version: $version" "pico_board: $board" 'target chip: RP2350' "image type: $4" "build attributes: ISA=$1"; do
                grep -qxF " $line" "$debian13_root/tmp/info" || { cat "$debian13_root/tmp/info" && echo "$board.$kind: no '$line'" && return 1; }
            done
            [ "$kind" != uf2 ] || grep -qF "family ID '$3'" "$debian13_root/tmp/info" || { echo "$board: not of $3" && return 1; }
        done
    done
}

rp2350_boards() {
    grep -l 'hal/rp2350\|families/pico2' boards/*/board.mk | cut -d / -f 2
}

picotool_writes_the_same_uf2() {
    debian13 picotool uf2 convert "$image.bin" /tmp/other.uf2 --offset 0x10000000 --family rp2040 &&
        debian13 cmp "$image.uf2" /tmp/other.uf2
}

picotool_verifies_the_flash() {
    debian13 bash -c '
        . tests/guest/virtual_board.sh && guest_build && head -c 2097152 /dev/urandom >/tmp/flash &&
            guest_run --timeout 200 -- bash -c ". tests/guest/virtual_board.sh; usb_plug bootsel --flash /tmp/flash &&
                build/pinhole-flash $1.uf2 --no-reboot && picotool verify $1.uf2 && picotool verify $1.bin"' - "$image"
}

# The packages of what the copy has, built there, checked by lintian and installed; the installed programs run.
debs_build() {
    debian13 bash -c 'git init -q . && git add -A && git -c user.name=tests -c user.email=tests@invalid commit -qm tests && make -s deb'
}

debs_install() {
    debian13 bash -c 'apt-get install -y --no-install-recommends ./build/deb/*.deb' || return 1
    debian13 bash -c 'cd / && for p in asset depth emulate flash panel sheet sim wire; do
        /usr/bin/pinhole-$p --version | grep . && man -w pinhole-$p || exit 1; done; pkg-config --modversion pinhole; ldd /usr/bin/pinhole-panel | grep libdrm'
}

installed_programs_draw() {
    debian13 bash -c 'cd /tmp && pinhole-sim --demo cube --crc' | diff - <(debian13 build/pinhole-sim --demo cube --crc) &&
        debian13 bash -c 'sed -n "/^#include <pinhole/,/^\`\`\`/p" README.md | grep -v "^\`" >/tmp/hello.c
            cd /tmp && cc hello.c $(pkg-config --cflags --libs pinhole) -o hello && ./hello | grep -c "#"'
}

debs_are_removed() { debian13 bash -c 'apt-get purge -y pinhole libpinhole-dev && ! ls /usr/bin/pinhole-* /usr/include/pinhole 2>/dev/null'; }

start=$SECONDS
debian13_make || { skip "Pinhole on Debian 13" "$debian13_why" && tap_end; }
echo "# the root: $((SECONDS - start)) s"
debian13_copy || exit 1

timed "gcc 14 builds everything without a warning" build build gcc
timed "clang 19 builds everything without a warning" build build/clang clang
timed "make check passes" strict make check
timed "gcc's frames are the golden ones" frames_are_ours build
timed "clang's frames are the golden ones" frames_are_ours build/clang
timed "gcc 14 builds the firmware without a warning" images_build
script "QEMU 10 runs an image" tests/firmware/long_firmware_lm3s.sh

image=build/firmware/pico-display-demos
timed "picotool reads our UF2, ELF and BIN" picotool_reads_images
timed "picotool shows name, version, board and pins" picotool_shows_what_the_image_is
timed "picotool agrees on the name, version, board and family of every RP2350 image for Arm" picotool_knows_rp2350_images arm '' rp2350-arm-s 'ARM Secure'
timed "... and for RISC-V" picotool_knows_rp2350_images riscv -riscv rp2350-riscv RISC-V
timed "picotool makes the same UF2 of our BIN" picotool_writes_the_same_uf2

timed "make deb builds packages that lintian takes" debs_build
timed "apt installs them" debs_install
timed "what is installed draws" installed_programs_draw
timed "apt takes them away" debs_are_removed

board_why=$(debian13 tests/guest/guest.sh --why)
if [ -n "$board_why" ]; then
    skip "the virtual board on Debian 13" "$board_why"
else
    timed "pinhole-panel uses libgpiod 2" debian13 bash -c 'ldd build/pinhole-panel | grep "libgpiod\.so\.3"'
    script "the backends keep hal.h's contract with libgpiod 2" tests/guest/long_guest_backends.sh
    script "pinhole-panel drives the virtual board with libgpiod 2" tests/guest/long_guest_panel.sh
    timed "picotool finds what pinhole-flash wrote" picotool_verifies_the_flash
fi
tap_end
