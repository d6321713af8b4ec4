#!/usr/bin/env bash
# Usage: tests/bench/bench.sh [CORE...]        make bench calls it; cores: m0plus m3 m4f m33 rv32 lx106 x86_64 rp2040, all by default
# Instructions a frame of the eight scenes and what the same build's pictures are worth, next to the bars and the best
# peer (bars.csv: both were measured once, on the same machine model, elsewhere); cycles on an emulated RP2040; how the
# cost grows. Leaves $B/bench.csv, the same as $B/bench.json, $B/bench-growth.csv, $B/bench-growth.png.
# Environment: B; FORMATS (depth formats of the microcontrollers' cores; all of them by default).
set -euo pipefail
cd "$(dirname "$0")/../.."
export B=${B:-build}
[ $# -gt 0 ] || set -- m0plus m3 m4f m33 rv32 lx106 x86_64 rp2040
dir=$B/bench
rm -rf "$dir"
mkdir -p "$dir"
: >"$dir/lines"
: >"$dir/rp2040"
: >"$dir/cliffs"
: >"$dir/sizes"

say() { printf 'bench: %s\n' "$1" >&2; }

missing() { # core: what it needs and is not here
    case "$1" in
    x86_64) command -v valgrind >/dev/null || echo valgrind ;;
    rp2040) for tool in node npm arm-none-eabi-gcc; do command -v $tool >/dev/null || echo $tool; done ;;
    rv32) command -v qemu-system-riscv32 >/dev/null || echo qemu-system-misc
          command -v riscv64-unknown-elf-gcc >/dev/null || echo gcc-riscv64-unknown-elf ;;
    lx106) command -v qemu-system-xtensa >/dev/null || echo qemu-system-misc
           command -v xtensa-lx106-elf-gcc >/dev/null || echo gcc-xtensa-lx106 ;;
    *) command -v qemu-system-arm >/dev/null || echo qemu-system-arm
       command -v arm-none-eabi-gcc >/dev/null || echo gcc-arm-none-eabi ;;
    esac
}

# Code and variables of the image of all demos, and its frames a second. The icosphere does not fit in with the others.
on_rp2040() {
    local cores
    FIRST_DEMO=fill host-sim/emulate/speed_rp2.sh pico-display-2 >"$dir/speed" || grep -q '!' "$dir/speed"
    cp "$B/speed/pico-display-2.csv" "$dir/rp2040"
    host-sim/emulate/speed_rp2.sh pico-display-2 6 torus cube ground >"$dir/speed" || grep -q '!' "$dir/speed"
    tests/bench/rp2040_icosphere.sh >"$dir/icosphere"
    cat "$B/speed/pico-display-2.csv" "$dir/icosphere" >>"$dir/rp2040"
    for cores in 1 2; do
        arm-none-eabi-size "$B/firmware/pico-display-2-demos$([ $cores = 1 ] || echo -cores2).elf" | awk -v cores=$cores 'END { print "rp2040," cores, $1, $2 + $3 }'
    done >>"$dir/sizes"
}

# CORE SCENE FORMAT STAGE FRAME COUNT
for core in "$@"; do
    lack=$(missing "$core" | xargs)
    [ -z "$lack" ] || { echo "bench: $core is left out: apt-get install $lack" >&2 && continue; }
    say "$core"
    if [ "$core" = rp2040 ]; then
        on_rp2040
        continue
    fi
    if [ "$core" = x86_64 ]; then list='kit fixed16 float16'; else list=${FORMATS:-all}; fi
    for format in $list; do tests/bench/run.sh "$core" all "$format"; done | awk -v core="$core" 'NF == 5 && $1 ~ /^S/ { print core, $0 }' >>"$dir/lines"
    PROGRAM=cliffs tests/bench/run.sh "$core" | sed -n "/known-loop/!s/^/$core /p" >>"$dir/cliffs"
done

# The pictures are those of the simulator, on every core; those of S6, S7 and S8, which are no demos, are the same on all of them.
say "frame CRCs"
make -s "$B/pinhole-sim" "$B/tests/core/test_quality" >&2
n=0
for demo in torus cube fill icosphere ground; do
    n=$((n + 1))
    awk -v s=S$n '$2 == s { print $3 }' "$dir/lines" | sort -u | while read -r format; do
        "$B/pinhole-sim" --demo $demo --size 320x240 --frames 57 --depth "${format/kit/auto}" --crc |
            awk -v scene=S$n -v format="$format" '$2 % 8 == 0 { print scene, format, $2, $4 }'
    done
done >"$dir/sim"
awk -v only="$*" 'function value(hex,   i, v) { for (i = 1; i <= 8; i++) { v = v * 16 + index("0123456789abcdef", tolower(substr(hex, i, 1))) - 1 } return v }
     NR == FNR { crc[$1 " " $2 " " $3] = value($4); next }
     $4 == "crc" { seen++; if ($2 ~ /^S[678]$/ && !(($2 " " $3 " " $5) in crc)) { crc[$2 " " $3 " " $5] = $6 } if (crc[$2 " " $3 " " $5] != $6) { print "bench: " $0 ": not the picture of pinhole-sim"; wrong = 1 } }
     $4 == "dropped" && $6 != 0 { print "bench: " $0; wrong = 1 }
     END { exit wrong || (!seen && only != "rp2040") }' "$dir/sim" "$dir/lines" >&2

say "quality"
"$B/tests/core/test_quality" >"$dir/quality"

awk -v dir="$dir" -v csv="$B/bench.csv" -f tests/bench/tables.awk tests/bench/bars.csv "$dir/quality" "$dir/rp2040" "$dir/sizes" "$dir/cliffs" "$dir/lines"
awk -f firmware/tools/json.awk "$B/bench.csv" >"$B/bench.json"
printf '\nThe bars that hold by the least, in %% of the bar (below 0: missed):\n'
awk -F, 'NR > 1 && $5 + 0 > 0 { printf "%.2f %s %s %s: %s of %s\n", 100 * (1 - $4 / $5), $1, $2, $3, $4, $5 }' "$B/bench.csv" | sort -n | head -n 8
case " $* " in *' m3 '*)
    say "growth"
    tests/bench/growth.sh m3 ;;
esac
case " $* " in *' m0plus '*)
    say "blends"
    tests/bench/blends.sh m0plus
    say "skin"
    tests/bench/skin.sh m0plus ;;
esac
