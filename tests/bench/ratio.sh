#!/usr/bin/env bash
# Usage: tests/bench/ratio.sh CORE OTHER        cores of tests/golden/bench.csv
# Prints a table of tests/bench/README.md: millions of instructions a frame on both cores, as a kit runs, and how many times
# as many CORE takes as OTHER.
set -eu
cd "$(dirname "$0")/../.."
[ $# = 2 ] || { sed -n 2p "$0" >&2 && exit 2; }
awk -F, -v core="$1" -v other="$2" '
    $3 == "minstr_kit" { count[$1, $2] = $4 }
    END {
        printf "| scene | %s | %s | times |\n|---|---|---|---|\n", core, other
        for (s = 1; ((core, "S" s) in count) && ((other, "S" s) in count); s++) {
            printf "| S%d | %.2f | %.2f | %.1f |\n", s, count[core, "S" s], count[other, "S" s], count[core, "S" s] / count[other, "S" s]
        }
        exit s == 1
    }' tests/golden/bench.csv
