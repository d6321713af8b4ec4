#!/usr/bin/env bash
# Usage: tests/bench/rp2040_walker.sh [FRAMES]
# A skinned, textured figure of 4,774 triangles and 19 joints, as high as the picture, walks 64 frames (FRAMES) on an
# emulated RP2040 of 125 MHz with pico-display-2's pins and panel, on one core and on two, with the flash's cache. Its
# mesh lies in flash. Each frame is the computer's, no triangle is left out, and the image keeps within 60 % of the chip's
# RAM, with RAM_CODE=small, or the exit status is 1.
# Prints: cores, frames/s, frames/s of the slowest frame, RAM of the image in % of the chip's.
# Environment: B, CC, CORES ("1 2"); LINES_A_BAND, BUFFERS (of the bands), SCENE_BYTES (of RAM, for scenes);
# LIGHT (daylight, which is one lamp, or two_lamps).
set -euo pipefail
cd "$(dirname "$0")/../.."
export B=${B:-build}
dir=$B/bench-walker board=pico-display-2-walker frames=${1:-64} scene=${SCENE_BYTES:-117000} light=${LIGHT:-daylight} most=162201 # 60 % of 264 KiB
rm -rf "$dir"
mkdir -p "$dir/kits/$board"
sed "s/board_pico_display_2 /board_${board//-/_} /; s/BUDGET_RP2040/.scene_bytes = $scene, .image_ram = {$most, $most}/; s/\.band_height = 16/.band_height = ${LINES_A_BAND:-10}, .band_buffers = ${BUFFERS:-2}/" boards/pico-display-2/board.c >"$dir/kits/$board/board.c"
cp boards/pico-display-2/board.mk "$dir/kits/$board"

make -s "$B/pinhole-wire" "$B/libpinhole.a" "$B/libpinhole-app.a" "$B/libpinhole-host.a" >&2
on_host() { # program, include folder...
    "${CC:-gcc}" -std=c11 -O2 -Wno-unused -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ihal -Ihost-sim/common \
        -DWALKER_LIGHT="demo_$light" "${@:2}" "tests/bench/$1.c" "$B/libpinhole-host.a" "$B/libpinhole-app.a" "$B/libpinhole.a" -o "$dir/$1"
}
on_host walker_flash
"$dir/walker_flash" >"$dir/walker_mesh.h"
on_host walker_host -I"$dir"
"$dir/walker_host" | head -n "$frames" >"$dir/expected"
sed "s|\"walker.inc\"|\"$(realpath tests/bench/walker.inc)\"|" tests/bench/walker_image.inc >"$dir/walker.c"

fail() {
    echo "bench: walker, cores: $cores: $1" >&2
    exit 1
}

for cores in ${CORES:-1 2}; do
    make -s firmware BOARD_DIR="$dir/kits" BOARD=$board CORES="$cores" APP="$(realpath "$dir")/walker.c" CPPFLAGS="-I$(realpath "$dir") -DWALKER_LIGHT=demo_$light" \
        RAM_CODE=small >"$dir/$cores.made" 2>&1 || fail "no image: $(tail -n 3 "$dir/$cores.made")"
    elf=$B/firmware/$board-walker$([ "$cores" = 1 ] || echo "-cores$cores")-small.elf
    BOARD=pico-display-2 CORES=$cores host-sim/emulate/emulate_rp2.sh "$elf" "$dir/$cores" "$((frames + 2))" --send "$((frames)):HG" \
        --limit-ms 100000 >"$dir/$cores.said" 2>"$dir/$cores.log" || fail "$(tail -n 1 "$dir/$cores.log")"
    grep '^frame [0-9]* crc32' "$dir/$cores.said" | head -n "$frames" | cmp -s "$dir/expected" - || fail "not the picture of this computer"
    grep -q 'left out 0 triangles 0 vertices' "$dir/$cores.log" || fail "$(grep 'left out' "$dir/$cores.log")"
    awk -v cores="$cores" -v frames="$frames" -v ram="$(sed -n 's/^RAM *\([0-9]*\) .*/\1/p' "$dir/$cores.made")" '
        $1 >= 1 && $1 < frames { n++; us += $2; most = $2 > most ? $2 : most }
        END { printf "walker,%d,%.2f,%.2f,%.1f\n", cores, n * 1e6 / us, 1e6 / most, 100 * ram / 270336 }' "$dir/$cores/report"
done
