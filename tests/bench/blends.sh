#!/usr/bin/env bash
# Usage: tests/bench/blends.sh [CORE]        make bench calls it; m0plus by default
# What blends and fog cost: instructions a pixel (blends.c), and on a Cortex-M0+ the bar of each, over which it exits 1.
# Environment: B.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} core=${1:-m0plus}
mkdir -p "$B/bench-$core"
PROGRAM=blends tests/bench/run.sh "$core" >"$B/bench-$core/blends"
! grep '^blends:' "$B/bench-$core/blends" >&2 || exit 1
awk -v core="$core" '
    NR == FNR { bar[$1] = $2; next }
    $1 == "empty" { empty = $5 }
    $3 == "frame" && $1 != "empty" {
        each = ($5 - empty) / $4
        over = core == "m0plus" && !(each > 0 && each <= bar[$1])
        printf "blends: %-20s %6.1f%s\n", $1, each, over ? " ! the bar is " bar[$1] : ""
        wrong = wrong || over
        seen++
    }
    END { exit wrong || seen != length(bar) }' - "$B/bench-$core/blends" <<END
empty-fog 5.5
flat 8.3
gouraud 10.5
texture 22
bilinear 68
texture-key 56
bilinear-key 146
texture-mask 98
flat-alpha 21.5
gouraud-alpha 35
texture-alpha 57.5
flat-add 37
gouraud-add 39
texture-add 61.5
flat-times 52
gouraud-times 54
texture-times 76.5
gouraud-times-some 69.5
texture-alphas 149
texture-alphas-add 160
flat-fog 25
END
