#!/usr/bin/env bash
# Usage: tests/bench/rp2040_icosphere.sh      bench.sh calls it
# The fourth scene on an emulated RP2040 with pico-display-2's pins and panel. The board's images keep within its
# budget, which does not hold that scene whole, so it gets an image of its own, which may take all of the chip's RAM and
# has the mesh, which the demo makes in RAM, in flash. No triangle is left out, and every frame is pinhole-sim's, or the
# exit status is 1. That leaves room for three band buffers; the other scenes have five or more.
# Prints lines as of host-sim/emulate/speed_rp2.sh's CSV file, means of frames 2 .. 4, without flash that is as fast as RAM.
# Environment: B, CC.
set -euo pipefail
cd "$(dirname "$0")/../.."
export B=${B:-build}
dir=$B/bench-icosphere board=pico-display-2-all
rm -rf "$dir"
mkdir -p "$dir/kits/$board"
number() { sed -n "s/^$1 = \([0-9]*\).*/\1/p" "$2"; }
code=31264 # with the loops alone in RAM, not all that a frame needs, and stack and variables
scene=$(($(number CHIP_RAM_BYTES boards/families/pico.mk) - code))
sed "s/board_pico_display_2 /board_${board//-/_} /; s/BUDGET_RP2040/.scene_bytes = $scene/" boards/pico-display-2/board.c >"$dir/kits/$board/board.c"
cp boards/pico-display-2/board.mk "$dir/kits/$board"

make -s "$B/pinhole-sim" "$B/pinhole-wire" "$B/libpinhole.a" >&2
"${CC:-gcc}" -std=c11 -O2 -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app tests/bench/icosphere_flash.c "$B/libpinhole-app.a" "$B/libpinhole.a" \
    -o "$dir/icosphere_flash"
"$dir/icosphere_flash" >"$dir/mesh.h"
cp tests/bench/icosphere_image.inc "$dir/icosphere.c"

fail() {
    echo "bench: icosphere, cores: $cores: $1" >&2
    exit 1
}

run() { # folder below $dir for what comes out, options of emulate.mjs
    BOARD=pico-display-2 CORES=$cores host-sim/emulate/emulate_rp2.sh "$elf" "$dir/$1" $frames "${@:2}" >"$dir/$1.said" 2>"$dir/$1.log" ||
        fail "$(tail -n 1 "$dir/$1.log")"
}

frames=7
"$B/pinhole-sim" --size 320x240 --demo icosphere --frames $frames --crc >"$dir/expected"
for cores in 1 2; do
    make -s firmware BOARD_DIR="$dir/kits" BOARD=$board CORES=$cores APP="$(realpath "$dir")/icosphere.c" RAM_CODE=small PORT_RAM_TIERS='interrupt bus loop' PORT_AHEAD_BYTES=0 >"$dir/$cores.made" || fail "no image"
    elf=$B/firmware/$board-icosphere$([ $cores = 1 ] || echo -cores$cores)-small.elf
    run $cores --send 4:HG # after those that count: a line on the UART about frame 5
    grep '^frame [0-9]* crc32' "$dir/$cores.said" | cmp -s "$dir/expected" - || fail "not the picture of pinhole-sim"
    grep -q 'left out 0 triangles 0 vertices' "$dir/$cores.log" || fail "$(grep 'left out' "$dir/$cores.log")"
    awk -v cores=$cores -v whole="$("$B/pinhole-sim" --board pico-display-2 --demo turntable --stats 2>&1 >/dev/null | sed -n 's/.*bus \([0-9]*\) us.*/\1/p')" '
        $1 >= 2 && $1 <= 4 { n++; us += $2; bus += $3; load += $5; load1 += $6 }
        END { printf "icosphere,%d,%.2f,,%.1f,%.1f,%.1f,0\n", cores, n * 1e6 / us, load / n, load1 / n, 100 * bus / n / whole }' "$dir/$cores/report"
done
