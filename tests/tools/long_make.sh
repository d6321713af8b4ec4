#!/usr/bin/env bash
# The Makefile does what its help says, and every option of it has an effect.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

run() { make -j2 B="$B/make" ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb "$@"; }

help_names_the_targets() {
    local target text
    text=$(make help) || return 1
    for target in all demo check test test-exhaustive lint size gallery golden install uninstall clean help; do
        grep -q "^make $target  *[a-z]" <<<"$text" || { echo "no $target" && return 1; }
    done
}

builds() { run all; }

a_second_make_does_nothing() {
    local said
    said=$(run all --no-print-directory)
    [ -z "$said" ] || [ "$said" = "make: Nothing to be done for 'all'." ] || { echo "$said" && return 1; }
}

other_flags_build_again() { # a variable
    local said
    said=$(run "$B"/make/libpinhole{,-hal}.a "$1") || { echo "$said" && return 1; }
    { grep -q 'CC *firmware/core/' <<<"$said" && grep -q 'CC *hal/' <<<"$said"; } || { echo "nothing was built again for $1" && return 1; }
}

# In a copy of the tree, of links: how many files are compiled when one comes, and when it goes.
a_new_file_compiles_alone() {
    local lib=build/libpinhole-host.a
    mkdir "$dir/tree" && cp -rs "$PWD"/{Makefile,firmware,hal,boards,host-sim} "$dir/tree" && cd "$dir/tree" || return 1
    again() { BUILT='' make -j2 CFLAGS=-O0 ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl USB=nousb "$lib" build/libpinhole-tools.a | grep -c '^  CC'; }
    [ "$(again)" -gt 100 ] && [ "$(again)" = 0 ] && echo 'int common_new_file; int common_new_file = 1;' >host-sim/common/new_file.c && [ "$(again)" = 1 ] &&
        nm "$lib" | grep -q common_new_file && rm host-sim/common/new_file.c && [ "$(again)" = 0 ] && ! nm "$lib" | grep -q common_new_file
}

empty_build_directory_is_refused() { # it would be the root directory
    local said
    said=$(make --no-print-directory B= -n all 2>&1) && return 1
    [ "$(wc -l <<<"$said")" = 1 ] && grep -q 'B= is empty' <<<"$said"
}

verbose_shows_the_commands() {
    run -n -B V=1 all | grep -q -- '-c firmware/core/fx/fx.c -o'
}

a_file_of_the_cpu_replaces_the_portable_one() {
    local kernels=$dir/firmware/core/kernels
    mkdir -p "$kernels/some_cpu" "$kernels/portable" && cp Makefile "$dir" && touch "$kernels"/portable/{a,b}.c "$kernels/some_cpu/b.c"
    make -n -C "$dir" CPU=some_cpu V=1 core-objects >"$dir/log" && grep -q -- '-Ifirmware/core/kernels/some_cpu' "$dir/log" &&
        grep -q 'portable/a\.c' "$dir/log" && grep -q 'some_cpu/b\.c' "$dir/log" && ! grep -q 'portable/b\.c' "$dir/log" &&
        make -n -C "$dir" V=1 core-objects | grep -q 'portable/b\.c'
}

the_core_cannot_include_the_hal() {
    mkdir -p "$dir/hal" "$dir/firmware/core/render" && cp Makefile "$dir" && touch "$dir/hal/hal.h"
    echo '#include "hal.h"' >"$dir/firmware/core/render/wrong.c"
    ! make -s -C "$dir" build/firmware/core/render/wrong.o
}

installs_and_uninstalls() {
    run install DESTDIR="$dir/stage" PREFIX=/usr && [ -x "$dir/stage/usr/bin/pinhole-sim" ] &&
        [ -r "$dir/stage/usr/lib/udev/rules.d/60-pinhole.rules" ] &&
        grep -qx 'ExecStart=/usr/bin/pinhole-panel .PINHOLE' "$dir/stage/usr/lib/systemd/system/pinhole.service" &&
        "$dir/stage/usr/bin/pinhole-sim" --help && run uninstall DESTDIR="$dir/stage" PREFIX=/usr &&
        [ -z "$(find "$dir/stage" -type f)" ]
}

# Prints the C block (or the text block) of a paper that holds these words, without its indent.
block() { # c or text, paper, words
    awk -v kind="$1" -v words="$3" '$1 == "```" kind { n = index($0, "`"); inside = 1; text = ""; next }
        inside && $1 == "```" { inside = 0; if (index(text, words)) printf "%s", text }
        inside { text = text substr($0, n) "\n" }' "$2"
}

boards_demos_and_panels_come_from_elsewhere() { # those of the papers
    rm -rf "${B:?}/make-boards" # a folder that was used before names boards that are gone
    mkdir -p "$dir/kits/my-kit" "$dir/empty" "$dir/demos" "$dir/panels"
    block c boards/README.md board_mine | sed 's/"mine"/"my-kit"/; s/board_mine/board_my_kit/; s/st7789_240x240/mine_240x160/' >"$dir/kits/my-kit/board.c"
    block c firmware/README.md demo_mine >"$dir/demos/mine.c"
    block c hal/README.md panel_mine >"$dir/panels/mine_240x160.c"
    block text hal/README.md mine-240x160 >"$dir/panels/mine_240x160.glass"
    make -s -j2 B="$B/make-boards" ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb CFLAGS=-O0 \
        BOARD_DIR="$dir/kits" DEMO_DIR="$dir/demos" PANEL_DIR="$dir/panels" "$B/make-boards/pinhole-sim" || return 1
    "$B/make-boards/pinhole-sim" --list | grep '^board  my-kit ' &&
        "$B/make-boards/pinhole-sim" --board my-kit --demo testcard --crc >"$dir/card" &&
        "$B/make-boards/pinhole-sim" --size 240x160 --demo testcard --crc | cmp - "$dir/card" || return 1
    # The triangle of the demo: red, as high as its size and the distance say: 2 * 80 / tan(30 degrees) / 5 lines.
    "$B/make-boards/pinhole-sim" --board my-kit --demo mine --out "$dir/mine.ppm" || return 1
    tail -c $((240 * 160 * 3)) "$dir/mine.ppm" | od -An -v -tu1 -w720 | awk '{ red = 0; for (x = 1; x < 720; x += 3) red += $x > 200 && $(x + 1) < 60; lines += red > 0 } END { print lines; exit !(lines > 53 && lines < 57) }' || return 1
    ! make -s B="$B/make-boards" BOARD_DIR="$dir/empty" all || return 1
    # Another make has no demo from elsewhere: what lists demos is compiled again. The other folders have moved, with newer files.
    mkdir "$dir/moved" && mv "$dir/kits" "$dir/panels" "$dir/moved" && touch "$dir/moved/kits/my-kit/board.c" "$dir/moved/panels/mine_240x160.c" || return 1
    make -s -j2 B="$B/make-boards" ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb CFLAGS=-O0 \
        BOARD_DIR="$dir/moved/kits" PANEL_DIR="$dir/moved/panels" "$B/make-boards/pinhole-sim" && ! "$B/make-boards/pinhole-sim" --list | grep '^demo   mine '
}

# A folder that holds a file of this name, and what make says about it in one line.
is_refused() { # DEMO or PANEL, file, words
    local more=$dir/more-$1-$2
    mkdir -p "$more" && echo 'int x;' >"$more/$2" && touch "$more/${2%.c}.glass"
    make -s B="$B/make-boards" "$1_DIR=$more" "$B/make-boards/demos_more/mine.o" "$B/make-boards/panels_more/mine.o" >"$dir/refused" 2>&1 && return 1
    cat "$dir/refused" && grep -qF "$3" "$dir/refused" && [ "$(grep -vc '^make: ' "$dir/refused")" = 1 ]
}

demos_and_panels_that_cannot_be_are_refused() {
    local panel=$dir/more-PANEL-bare
    is_refused DEMO mine.c 'defines no demo_mine' && is_refused DEMO torus.c 'torus is one of Pinhole: take another name' &&
        is_refused DEMO my-demo.c 'a name has a-z, 0-9 and _ only' && is_refused DEMO readme 'there is no NAME.c in it' &&
        is_refused PANEL mine.c 'defines no panel_mine' && is_refused PANEL sh1106_128x64.c 'is one of Pinhole: take another name' &&
        mkdir -p "$panel" && touch "$panel/mine.c" && ! make -s B="$B/make-boards" PANEL_DIR="$panel" all 2>"$dir/refused" && grep -q 'there is no mine.glass' "$dir/refused"
}

# A folder that holds one board of this name, with a board.c that defines another.
board_is_refused() { # name, words
    mkdir -p "$dir/odd-$1/$1" && echo 'const int board_other;' >"$dir/odd-$1/$1/board.c"
    make -s B="$B/make-boards" BOARD_DIR="$dir/odd-$1" "$B/make-boards/boards_more/$1/board.o" 2>"$dir/refused" && return 1
    grep -qF "$2" "$dir/refused" || { cat "$dir/refused"; return 1; }
}

an_rp2350_has_no_i2c() {
    mkdir -p "$dir/i2c/two" && printf 'PORT_BUS = i2c\ninclude boards/families/pico2.mk\n' >"$dir/i2c/two/board.mk" && echo 'int x;' >"$dir/i2c/two/board.c"
    make -s B="$B/make-boards" BOARD_DIR="$dir/i2c" BOARD=two firmware >"$dir/refused" 2>&1 && return 1
    cat "$dir/refused" && [ "$(wc -l <"$dir/refused")" = 1 ] && grep -qF 'PORT_BUS=i2c: two has an RP2350, whose port has no I2C yet' "$dir/refused"
}

boards_that_cannot_be_are_refused() {
    board_is_refused odd/name 'there is no NAME/board.c in it' && board_is_refused 'my!kit' "a board's name has a-z, 0-9 and - only" &&
        board_is_refused rpi-pirate-audio 'is a board of Pinhole: take another name' &&
        board_is_refused my-kit 'defines no board_my_kit'
}

needs_no_library() {
    run all && ! ldd "$B/make/pinhole-sim" | grep -E 'assimp|png|SDL|gpiod|usb'
}

size_fails_over_the_budget() {
    make size B="$B/make" && ! make size B="$B/make" BUDGET_CORE_BYTES=1000
}

size_counts_what_is_linked() { # less than there is, and of a function that no demo calls nothing
    make size B="$B/make" | awk '$1 == "all" { seen = $2 > 0 && $2 < $7 } $1 == "fx/fx_pow" { none = $2 == 0 && $3 > 0 } END { exit !(seen && none) }'
}

check "help_names_every_target" help_names_the_targets
check "everything_builds_without_optional_libraries" builds
check "a_second_make_does_nothing" a_second_make_does_nothing
check "other_CFLAGS_build_again" other_flags_build_again CFLAGS=-O0
check "a_new_file_of_host-sim_compiles_alone" a_new_file_compiles_alone
check "another_CPU_builds_again" other_flags_build_again CPU=armv7m
check "V_1_shows_the_commands" verbose_shows_the_commands
check "an_empty_build_directory_is_refused" empty_build_directory_is_refused
check "a_file_of_the_CPU_replaces_the_portable_one" a_file_of_the_cpu_replaces_the_portable_one
check "the_core_cannot_include_the_hal" the_core_cannot_include_the_hal
check "what_is_installed_runs_and_uninstalls" installs_and_uninstalls
check "boards_demos_and_panels_come_from_external_folders" boards_demos_and_panels_come_from_elsewhere
check "a folder without boards, odd names, names that are taken and wrong definitions are refused" boards_that_cannot_be_are_refused
check "an RP2350 board on I2C is refused in one line" an_rp2350_has_no_i2c
check "demos_and_panels_that_cannot_be_are_refused" demos_and_panels_that_cannot_be_are_refused
check "without_the_libraries_none_is_linked" needs_no_library
if command -v arm-none-eabi-gcc >/dev/null; then
    check "size_fails_over_the_budget" size_fails_over_the_budget
    check "size_counts_what_is_linked" size_counts_what_is_linked
else
    skip "size_fails_over_the_budget" "no arm-none-eabi-gcc"
    skip "size_counts_what_is_linked" "no arm-none-eabi-gcc"
fi
tap_end
