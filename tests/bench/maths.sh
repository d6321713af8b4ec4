#!/usr/bin/env bash
# Usage: tests/bench/maths.sh
# Prints what the functions of fx.h and fx_math.h cost: instructions a call on Cortex-M0+, M3 and M4F, as the mean over
# inputs of all magnitudes, without the loop. Exits 1 when a result is another one on another core. Environment: B.
set -eu
cd "$(dirname "$0")/../.."
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
for core in m0plus m3 m4f; do PROGRAM=maths tests/bench/run.sh "$core" >"$dir/$core"; done
awk '
    FNR == 1 { core++ }
    $1 == "empty" { empty[core] = $5 }
    core == 1 { name[FNR] = $1; sum[$1] = $2; rows = FNR }
    $1 != "known-loop" && $2 != sum[$1] { print $1 ": another result on core " core > "/dev/stderr"; wrong = 1 }
    { cost[core, $1] = ($5 - empty[core]) / ($4 == 0 ? 1 : $4) }
    END {
        printf "%-24s %8s %8s %8s\n", "instructions a call", "M0+", "M3", "M4F"
        for (i = 3; i <= rows; i++) {
            printf "%-24s %8.0f %8.0f %8.0f\n", name[i], cost[1, name[i]], cost[2, name[i]], cost[3, name[i]]
        }
        exit wrong
    }' "$dir/m0plus" "$dir/m3" "$dir/m4f"
