#!/usr/bin/env bash
# pinhole-flash without a board: an image and a scene become one file, and what does not go together is one line. (What it
# does with a board: tests/guest/long_guest_flash.sh.)
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
flash=$B/pinhole-flash
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cc -O1 -o "$dir/seal" hal/rp2040/boot2_seal.c && cc -O1 -o "$dir/uf2" firmware/tools/image_uf2.c &&
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$dir/a.obj" && "$B/pinhole-asset" "$dir/a.obj" -o "$dir/a.phs" && head -c 300 "$dir/a.phs" >"$dir/half.phs" || exit 1

# An image of 8192 bytes, whose binary information says this: the header at 100h, a table at 400h, an entry at 500h, its text at 600h.
image() { # name, text
    local bin=$dir/$1.bin
    head -c 256 /dev/zero | "$dir/seal" >"$bin" && head -c 7936 /dev/zero >>"$bin"
    at() { printf '%b' "$2" | dd of="$bin" bs=1 seek=$(($1)) conv=notrunc status=none; }
    at 0x100 '\xf2\xeb\x88\x71\x00\x04\x00\x10\x04\x04\x00\x10' && at 0x110 '\x90\xa3\x1a\xe7' && at 0x400 '\x00\x05\x00\x10' &&
        at 0x504 '\x53\xb4\xf4\xa1\x00\x06\x00\x10' && at 0x600 "$2" && "$dir/uf2" 0xe48bff56 0x10000000 "$bin" "$dir/$1.uf2"
}

# Blocks of a UF2 file without their numbers, from the one with this number on.
blocks() { # file, first, how many
    local i
    for ((i = $2; i < $2 + $3; i++)); do
        tail -c +$((512 * i + 1)) "$1" | head -c 20
        tail -c +$((512 * i + 29)) "$1" | head -c 484
    done
}

one_file_has_both() {
    local scene_blocks=$((($(stat -c %s "$dir/a.phs") + 255) / 256)) bytes
    bytes=$((512 * (32 + scene_blocks)))
    "$flash" "$dir/takes.uf2" --scene "$dir/a.phs" --out "$dir/both.uf2" >"$dir/out" || return 1
    diff - "$dir/out" <<<"$dir/both.uf2: $bytes bytes; copy it onto the drive of the boot loader, RPI-RP2 or RP2350" || return 1
    "$dir/uf2" 0xe48bff56 0x10080000 "$dir/a.phs" "$dir/scene.uf2" && [ "$(stat -c %s "$dir/both.uf2")" = "$bytes" ] &&
        cmp <(blocks "$dir/both.uf2" 0 32) <(blocks "$dir/takes.uf2" 0 32) &&
        cmp <(blocks "$dir/both.uf2" 32 "$scene_blocks") <(blocks "$dir/scene.uf2" 0 "$scene_blocks")
}

refuses() { # exit status, line, argument...
    local status=0
    rm -f "$dir/no.uf2"
    "$flash" "${@:3}" >"$dir/out" 2>"$dir/err" || status=$?
    [ "$status" = "$1" ] && [ ! -e "$dir/no.uf2" ] && [ ! -s "$dir/out" ] && diff - "$dir/err" <<<"pinhole-flash: $2" || { cat "$dir/err" "$dir/out" && return 1; }
}

a_failure_keeps_the_old_file() {
    local status=0
    echo old >"$dir/kept.uf2"
    (ulimit -f 4 && exec "$flash" "$dir/takes.uf2" --scene "$dir/a.phs" --out "$dir/kept.uf2") 2>"$dir/err" || status=$?
    [ "$status" = 1 ] && grep -qx "pinhole-flash: $dir/kept.uf2: cannot be written: File too large" "$dir/err" && [ "$(cat "$dir/kept.uf2")" = old ] &&
        [ "$(echo "$dir"/kept.uf2*)" = "$dir/kept.uf2" ]
}

image takes 'takes a scene at 0x10080000' && image other 'takes a scene at 0x10090000' || exit 1
check "an image and a scene become one file" one_file_has_both
check "a disk that is full halfway keeps the old file" a_failure_keeps_the_old_file
check "a BIN takes no scene" refuses 1 "$dir/takes.bin: is no UF2 file: a scene goes into a UF2 image" "$dir/takes.bin" --scene "$dir/a.phs" --out "$dir/no.uf2"
check "an image that shows none" refuses 1 "$dir/other.uf2: '' takes no scene at 0x10080000; an image of all demos does (make firmware BOARD=x)" \
    "$dir/other.uf2" --scene "$dir/a.phs" --out "$dir/no.uf2"
check "a scene that is not whole" refuses 1 "$dir/takes.uf2: the scene is not whole, or too large" "$dir/takes.uf2" --scene "$dir/half.phs" --out "$dir/no.uf2"
check "an image that is not there" refuses 1 "$dir/none.uf2: cannot be opened: No such file or directory" "$dir/none.uf2" --scene "$dir/a.phs" --out "$dir/no.uf2"
check "a scene that is not there" refuses 1 "$dir/none.phs: cannot be opened: No such file or directory" "$dir/takes.uf2" --scene "$dir/none.phs" --out "$dir/no.uf2"
check "a place where nothing can be written" refuses 1 "$dir/none/no.uf2: cannot be written: No such file or directory" "$dir/takes.uf2" --scene "$dir/a.phs" --out "$dir/none/no.uf2"
check "a full disk" refuses 1 "/dev/full: cannot be written: No space left on device" "$dir/takes.uf2" --scene "$dir/a.phs" --out /dev/full
check "--out without a scene" refuses 2 "--out goes with --scene; see --help" "$dir/takes.uf2" --out "$dir/no.uf2"
check "... or behind an image" refuses 2 "--out goes with --scene; see --help" "$dir/a.phs" --at-scene --out "$dir/no.uf2"
check "--scene and --at-scene" refuses 2 "--scene goes into an image, --at-scene behind one; see --help" "$dir/takes.uf2" --scene "$dir/a.phs" --at-scene
check "--scene without an image" refuses 2 "an image is missing: a UF2 or BIN file; see --help" --scene "$dir/a.phs" --out "$dir/no.uf2"
check "--force without --at-scene" refuses 2 "--force goes with --at-scene; see --help" "$dir/takes.uf2" --force
tap_end
