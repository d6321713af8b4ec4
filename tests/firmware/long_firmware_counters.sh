#!/usr/bin/env bash
# The image of all demos on an emulated RP2040, as if it had run for long: frames and the chip's clock pass 2^31, 2^32, where
# both begin anew, and 65,536 s. Its frames are pinhole-sim's of the same numbers; each takes as long, on the bus and in
# all, and the image logs the same rates, as in a run that passes none of them.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
board=pico-display clip=6
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here

elf_of() { echo "$dir/late.elf"; } # for emulate

# The image reads the number of its first frame, a word that late_image finds and sets.
builds() {
    make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-asset" "$B/pinhole-wire" || return 1
    sed -e 's/^static int run(/static volatile uint32_t first_frame = 0x7E57F00D;\n\n&/' -e 's/struct console console = {/&.line_frame = first_frame, /' \
        -e 's/for (uint32_t frame = 0; status/for (uint32_t frame = first_frame; status/' firmware/app/images/demos.c >"$dir/late.c" || return 1
    [ "$(grep -c 'first_frame' "$dir/late.c")" = 3 ] && "$B/pinhole-asset" tests/host-sim/asset/moving.gltf -o "$dir/moving.phs" --board "$board" &&
        make_image firmware BOARD="$board" APP="$dir/late.c" CORES=1 CLIP_FPS=30 && make_image firmware BOARD="$board" APP="$dir/late.c" CORES=2 CLIP_FPS=30
}

little_endian() { # a word as bytes
    local i
    for i in 0 8 16 24; do printf '%b' "\\x$(printf %02x $(($1 >> i & 255)))"; done
}

late_image() { # cores, first frame, binary scene or nothing: $dir/late.elf and .bin
    local name at file
    [ "$1" = 1 ] && name=$board-late-fps30 || name=$board-late-cores$1-fps30
    cp "$B/firmware/$name.elf" "$dir/late.elf" && cp "$B/firmware/$name.bin" "$dir/late.bin" || return 1
    at=$(LC_ALL=C grep -obUaP '\x0D\xF0\x57\x7E' "$dir/late.bin" | cut -d: -f1)
    little_endian "$2" | dd of="$dir/late.bin" bs=1 seek="$at" conv=notrunc status=none || return 1
    for file in "${@:3}"; do
        truncate -s $((0x80000)) "$dir/late.bin" && cat "$file" >>"$dir/late.bin"
    done
}

# Runs two frames of every demo, the passed count in their middle: name, cores, that count of frames, the clock then in us.
run() {
    sweep 2
    late_image "$2" $(($3 - demos)) && emulate "$board" "$2" $((2 * demos)) "$dir/keys" --clock $(($4 - $(cat "$dir/middle_us"))) || return 1
    mv "$dir/seen" "$dir/$1.seen"
    mv "$dir/log" "$dir/$1.log"
    mv "$dir/out/report" "$dir/$1.report"
}

# A run that passes nothing: frames near 2^30, a clock from 0 on. The time until its middle is the others'.
reference() { # cores
    local middle_us
    echo 0 >"$dir/middle_us"
    run "reference$1" "$1" $((1 << 30)) 0 || return 1
    middle_us=$(awk -v demos="$demos" '$1 < demos { us += $2 } END { printf "%.0f", us }' "$dir/reference$1.report")
    echo "$middle_us" >"$dir/middle_us"
    [ "$middle_us" -gt 100000 ] && grep -q '^frame 10737[0-9]*, [0-9]' "$dir/reference$1.log"
}

frames_are_the_simulators() { # name, count: each demo by itself in the simulator, and numbered from 0 as the emulator does
    local demo i=0
    while read -r demo; do
        "$B/pinhole-sim" --board "$board" --demo "$demo" --start $((($2 - demos + 2 * i) & 0xffffffff)) --frames 2 --crc 2>/dev/null || return 1
        i=$((i + 1))
    done < <("$B/pinhole-sim" --list | sed -n '/; by name only$/d; s/^demo *\([^ ]*\) .*/\1/p') | awk '{ print "frame " NR - 1 " crc32 " $4 }' >"$dir/expected"
    [ "$(wc -l <"$dir/expected")" = $((2 * demos)) ] && diff "$dir/expected" "$dir/$1.seen"
}

# A frame with a line in the log may take a few characters more or less, 87 us each.
times_do_not_jump() { # name, cores
    paste -d' ' "$dir/$1.report" "$dir/reference$2.report" | awk -v n=$((2 * demos - 1)) 'function off(a, b, most) { return a > b + most || b > a + most }
        NF != 2 * int(NF / 2) || $1 != $(NF / 2 + 1) || off($2, $(NF / 2 + 2), 900) || off($3, $(NF / 2 + 3), 1) { print; bad = 1 }
        END { if (NR < n) { print NR " frames" } exit bad || NR < n }' && diff <(rates "$1") <(rates "reference$2")
}

rates() { # name: what the image logs, without the numbers of frames
    grep -v '^emulate: ' "$dir/$1.log" | sed 's/^frame [0-9]*,/frame,/'
}

passes() { # name, cores, count of frames, clock in us
    run "$1" "$2" "$3" "$4" && frames_are_the_simulators "$1" "$3" && times_do_not_jump "$1" "$2"
}

# The time of the clip, which is no whole part of the counts, goes on.
clip_passes() { # count of frames, clock in us
    late_image 1 $(($1 - clip / 2)) "$dir/moving.phs" && emulate "$board" 1 "$clip" - --clock $(($2 - 100000)) || return 1
    "$B/pinhole-sim" --model "$dir/moving.phs" --board "$board" --start $(($1 - clip / 2)) --frames "$clip" --crc 2>/dev/null |
        awk '{ print "frame " NR - 1 " crc32 " $4 }' >"$dir/expected" && [ "$(cut -d' ' -f4 "$dir/expected" | sort -u | wc -l)" -gt 2 ] && same "$clip"
}

check "the image builds" builds
check "it runs with counts that pass nothing" reference 1
check "frames and the clock pass 2^31: no jump" passes half 1 $((1 << 31)) $((1 << 31))
check "frames and the clock begin anew at 2^32: no jump" passes whole 1 $((1 << 32)) $((1 << 32))
check "frames and the clock pass 65,536 s: no jump" passes seconds 1 $((65536 * 30)) 65536000000
check "a clip passes 2^31" clip_passes $((1 << 31)) $((1 << 31))
check "a clip passes 2^32" clip_passes $((1 << 32)) $((1 << 32))
check "a clip passes 65,536 s" clip_passes $((65536 * 30)) 65536000000
check "two cores run with counts that pass nothing" reference 2
check "frames and the clock of two cores begin anew at 2^32: no jump" passes both 2 $((1 << 32)) $((1 << 32))
tap_end
