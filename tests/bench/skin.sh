#!/usr/bin/env bash
# Usage: tests/bench/skin.sh [CORE]        make bench calls it; m0plus by default
# What a model that moves costs before it is drawn (skin.c): instructions a node of the pose, and a vertex with one joint,
# with two, with two of which no neighbour has the same shares, and where joints scale the axes differently. On a
# Cortex-M0+ each has a bar, over which it exits 1. Environment: B.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} core=${1:-m0plus}
mkdir -p "$B/bench-$core"
PROGRAM=skin tests/bench/run.sh "$core" >"$B/bench-$core/skin"
awk -v core="$core" '
    NR == FNR { bar[$1] = $2; next }
    $3 == "frame" {
        each = $5 / $4
        over = core == "m0plus" && !(each > 0 && each <= bar[$1])
        printf "skin: %-10s %8.1f%s\n", $1, each, over ? " ! the bar is " bar[$1] : ""
        wrong = wrong || over
        seen++
    }
    END { exit wrong || seen != length(bar) }' - "$B/bench-$core/skin" <<END
pose 6800
one 354
two 387
two-each 958
axes 415
END
