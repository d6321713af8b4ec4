#!/usr/bin/env bash
# Usage: tests/bench/growth.sh [CORE]        make bench calls it; m3 by default
# How the cost of a frame grows with triangles, fragments, depth complexity, draws, materials, keyed draws, points, pictures and text over the picture, meshes that are off the picture, bands and pixels:
# $B/bench-growth.csv (kind,x,instructions), and $B/bench-growth.png where gnuplot is. Exits 1 when a term grows faster than linearly (a further triangle, draw or
# fragment costs over 10 % more than those before it; a pixel of a larger picture more than one of a smaller), when 16 bands cost 5 % of a frame,
# when a hidden layer costs over 5 % of a visible one, when a mesh that is off the picture costs 500 instructions (1,500 on a Cortex-M0+), or one of 500 points or a pixel of a picture over it more than its bar. Environment: B.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} core=${1:-m3}
mkdir -p "$B/bench-$core"
PROGRAM=growth tests/bench/run.sh "$core" >"$B/bench-$core/growth"
! grep '^growth:' "$B/bench-$core/growth" >&2 || exit 1
{ echo kind,x,instructions && awk '$3 == "frame" { print $1 "," $4 "," $5 }' "$B/bench-$core/growth"; } >"$B/bench-growth.csv"

most=500
[ "$core" != m0plus ] || most=1500
case $core in m0plus) bar=300 glass=3 ;; m3 | m4f | m33) bar=150 glass=2 ;; *) bar=0 glass=0 ;; esac # of a point; of a pixel
awk -v most="$most" -v bar=$bar -v glass=$glass '
    $3 == "bins" { bins[$1 " " $4] = $5; next }
    $3 != "frame" { next }
    { cost[$1 " " $4] = $5 }
    $1 != "band" && $1 == kind {
        each = $1 == "pixels" ? $5 / $4 : ($5 - last) / ($4 - x) # pictures differ in shape, too
        if (each_last && each > 1.1 * each_last) {
            printf "growth: %s: from %d to %d each costs %.1f instructions, before %.1f\n", $1, x, $4, each, each_last
            wrong = 1
        }
        each_last = each
    }
    $1 != kind { each_last = 0 }
    $1 != "band" { kind = $1; x = $4; last = $5 }
    END {
        outside = (cost["outside 1024"] - cost["outside 64"]) / 960
        printf "growth: a mesh that is off the picture costs %.0f instructions\n", outside
        share = 100 * (cost["band 15"] - cost["band 240"] + bins["band 15"]) / cost["band 15"]
        printf "growth: 16 bands cost %.1f %% of a frame of 4096 triangles, of it %.2f %% sorting\n", share,
            100 * bins["band 15"] / cost["band 15"]
        hidden = 100 * (cost["hidden 16"] - cost["hidden 1"]) / (cost["visible 16"] - cost["visible 1"])
        printf "growth: a hidden layer costs %.1f %% of a visible one\n", hidden
        split("points sparks discs", kinds, " ")
        for (i = 1; i <= 3; i++) {
            each = (cost[kinds[i] " 500"] - cost[kinds[i] " 0"]) / 500
            printf "growth: one of 500 %s costs %.1f instructions\n", kinds[i], each
            wrong = wrong || (bar > 0 && i == 1 && each > bar)
        }
        each = (cost["glass 5120"] - cost["glass 640"]) / 4480
        printf "growth: a pixel of a picture over the picture costs %.2f instructions, a letter %.0f\n", each, cost["letters 64"] / 64
        wrong = wrong || (bar > 0 && each > glass)
        exit wrong || share >= 5 || !(hidden < 5) || !(outside > 0 && outside < most)
    }' <(grep -v '^pixels\|^band' "$B/bench-$core/growth"; grep '^pixels' "$B/bench-$core/growth"; grep '^band' "$B/bench-$core/growth")

command -v gnuplot >/dev/null || { echo "growth: no plot: apt-get install gnuplot-nox" >&2 && exit 0; }
gnuplot <<END
set terminal pngcairo size 1000,1140 font "sans,11"
set output "$B/bench-growth.png"
set datafile separator ","
set multiplot layout 3,2 title "Instructions a frame on Cortex-M (${core}), counted" font "sans,14"
set ylabel "millions of instructions a frame"
set grid lc rgb "#dddddd"
set key top left
set style data linespoints
set style line 1 lc rgb "#0072b2" lw 2 pt 7
points(kind) = sprintf("< grep '^%s,' $B/bench-growth.csv", kind)
set logscale xy
set title "triangles (torus, 320x240)"
set xlabel "triangles"
plot points("triangles") using 2:(\$3/1e6) ls 1 notitle
set title "fragments (flat quads, 320x240)"
set xlabel "thousands of fragments"
plot points("fragments") using (\$2/1e3):(\$3/1e6) ls 1 notitle
unset logscale
set yrange [0:5]
set title "band height (4096 triangles, 320x240)"
set xlabel "lines a band"
set logscale x
plot points("band") using 2:(\$3/1e6) ls 1 notitle
set title "resolution (4096 triangles, 128x64 .. 320x480)"
set xlabel "thousands of pixels"
plot points("pixels") using (\$2/1e3):(\$3/1e6) ls 1 notitle
unset logscale
set yrange [0:*]
set title "depth complexity (flat layers, 320x240, bands of 16 lines)"
set xlabel "full-screen layers"
set style line 2 lc rgb "#d55e00" lw 2 pt 5
plot points("visible") using 2:(\$3/1e6) ls 1 title "back to front: all visible", \
     points("hidden") using 2:(\$3/1e6) ls 2 title "front to back: all hidden but one"
set title "quads drawn one by one (320x240, bands of 16 lines)"
set xlabel "draws"
set style line 4 lc rgb "#cc79a7" lw 2 pt 13
set style line 3 lc rgb "#009e73" lw 2 pt 9
plot points("keyed") using 2:(\$3/1e6) ls 3 title "keyed texture", \
     points("materials") using 2:(\$3/1e6) ls 2 title "flat, a material each", \
     points("draws") using 2:(\$3/1e6) ls 1 title "flat, one material", \
     points("outside") using 2:(\$3/1e6) ls 4 title "off the picture, with bounds"
END
