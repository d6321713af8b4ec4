#!/usr/bin/env bash
# Dithered light (ph_dither) takes at most 3 % of a frame, in the scenes with Gouraud light and on each core, and gives the same
# bytes on all of them and in pinhole-sim.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
demo=([1]=torus [4]=icosphere [5]=ground)

# What dither adds, in % of a frame: CORE SCENE PERCENT.
measure() { # core
    local format scene
    for format in kit dither; do
        for scene in S1 S4 S5; do tests/bench/run.sh "$1" "$scene" "$format" || return 1; done
    done | tee "$dir/$1.all" | awk -v core="$1" '
        $3 == "frame" { sum[$1, $2] += $5 }
        $3 == "frame" { seen[$1] }
        END { for (s in seen) { print core, s, 100 * (sum[s, "dither"] / sum[s, "kit"] - 1) } }' | sort >"$dir/$1"
    awk '$2 == "dither" && $3 == "crc"' "$dir/$1.all" | sort >"$dir/$1.crc"
}

within_bounds() { # core
    measure "$1" && cat "$dir/$1" && awk '$3 > 3 { wrong = 1 } END { exit wrong || NR != 3 }' "$dir/$1"
}

same_bytes() { # core: as pinhole-sim, whose CRCs are in hexadecimal
    local scene
    for scene in 1 4 5; do
        "$B/pinhole-sim" --demo "${demo[scene]}" --size 320x240 --frames 57 --dither --crc | awk -v s="S$scene" '$2 % 8 == 0 { print s, "dither crc", $2, $4 }'
    done | while read -r line; do echo "${line% *} $((16#${line##* }))"; done | sort >"$dir/sim"
    [ "$(wc -l <"$dir/sim")" = 24 ] && diff "$dir/sim" "$dir/$1.crc"
}

make -s "$B/pinhole-sim" >&2
for core in m0plus m3 rv32 x86_64; do
    if { [ $core = rv32 ] && ! command -v qemu-system-riscv32; } || { [ $core = x86_64 ] && ! command -v valgrind; }; then
        skip "dither_takes_at_most_3_percent_on_$core" "its tools are missing"
        continue
    fi >/dev/null
    check "dither_takes_at_most_3_percent_on_$core" within_bounds $core
    check "dithered_frames_of_${core}_are_those_of_the_simulator" same_bytes $core
done
tap_end
