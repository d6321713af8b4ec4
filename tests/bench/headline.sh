#!/usr/bin/env bash
# Usage: tests/bench/headline.sh
# Prints the headline of tests/bench/README.md: triangles and pixels a million instructions, ours and the best other
# renderer's, from golden/bench.csv and bars.csv. (At one instruction a cycle that is as much a second and MHz.)
set -eu
cd "$(dirname "$0")/../.."
awk -F, '
    BEGIN {
        n = split("m0plus m3 m4f m33 rv32 x86_64", cores, " ")
        split("Cortex-M0+,Cortex-M3,Cortex-M4F,Cortex-M33,RV32IMAC,x86-64", names, ",")
        triangles = 5120      # of S4
        pixels = 8 * 320 * 240 # of S3: eight quads that fill the picture
    }
    FILENAME ~ /bars/ { peer[$1, $2, $3] = $7; next }
    $3 == "minstr_kit" { ours[$1, $2] = $4; theirs[$1, $2] = $7 }
    function cells(core, scene, work) {
        return sprintf("| %d | %d (%s) | %.1f ", work / ours[core, scene] + .5, work / theirs[core, scene] + .5, peer[core, scene, "minstr_kit"], theirs[core, scene] / ours[core, scene])
    }
    END {
        print "| core | triangles: Pinhole | best other | times | pixels: Pinhole | best other | times |"
        print "|---|---|---|---|---|---|---|"
        for (i = 1; i <= n; i++) { print "| " names[i] " " cells(cores[i], "S4", triangles) cells(cores[i], "S3", pixels) "|" }
    }' tests/bench/bars.csv tests/golden/bench.csv
