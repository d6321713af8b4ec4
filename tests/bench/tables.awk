# bars.csv, test_quality's table and the lines of run.sh with the core in front: the tables of `make bench`, and
# bench.csv (-v csv=FILE) with the columns core,scene,metric,value,must,aim,best_peer. Means over a scene's frames.
BEGIN {
    core_count = split("m0plus m3 m4f m33 rv32 lx106 x86_64", cores, " ")
    split("fixed16 float16 fixed24 float24 linear-w", formats, " ")
    split("torus cube fill icosphere ground", demo, " ")
    split(".02 .02 .02 .02 .005", coverage_bar, " ")
    split("1.5e-5 1.5e-5 1.5e-5 1.5e-5 2e-5", depth_bar, " ")
}

FILENAME ~ /bars.csv$/ {
    split($0, word, ",")
    must[word[1], word[2], word[3]] = word[4]
    aim[word[1], word[2], word[3]] = word[5]
    peer[word[1], word[2], word[3]] = word[6]
    peer_name[word[1], word[2], word[3]] = word[7]
    next
}

FILENAME ~ /quality$/ { # S1 torus demo fixed16 0.0033 % 0 0 4.61e-06 5.20e-05 0.000 % 2.13
    if ($1 ~ /^S[1-5]$/ && $3 == "demo") {
        coverage[$1, $4] = $5; doubles[$1, $4] = $7; holes[$1, $4] = $8
        depth_rms[$1, $4] = $9; distance_rms[$1, $4] = $10; texels[$1, $4] = $11
    }
    next
}

FILENAME ~ /rp2040$/ { # speed_rp2.sh's CSV file: demo, cores, frames/s, with ideal flash, loads in %, ..
    split($0, word, ",")
    for (s = 1; s <= 5; s++) {
        if (word[1] == demo[s]) {
            frame_ms[s, word[2]] = 1e3 / word[3]
            mcycles[s, word[2]] = 125 / word[3] * (word[5] > word[6] ? word[5] : word[6]) / 100
            rp2040 = 1
        }
    }
    next
}

FILENAME ~ /sizes$/ { # core, code, variables
    code[$1] = $2; memory[$1] = $3; sizes = sizes " " $1
    next
}

FILENAME ~ /cliffs$/ { # core, name, usual or cliff or empty, unit, units, count; `empty` belongs to the line before
    if ($3 != "empty") { full = $6; variant = $3; next }
    cost[$1, $2, variant] = (full - $6) / $5
    unit[$2, variant] = $4
    if (variant == "cliff" && !($2 in cliff)) { cliff[$2]; cliffs[++cliff_count] = $2 }
    next
}

{
    sum[$1, $2, $3, $4] += $6
    seen[$1, $2, $3]
    if ($4 == "frame") { frames[$1, $2, $3]++ }
}

function mean(core, scene, format, stage) { return sum[core, scene, format, stage] / frames[core, scene, format] }

function row(core, scene, metric, value, must, aim, peer) {
    printf "%s,%s,%s,%s,%s,%s,%s\n", core, scene, metric, value, must, aim, peer >csv
}

# One band. float16 is held to the bars of fixed16, but by eye alone.
function table(core, format,   s, scene, all, fragments, verdict, metric, bar) {
    metric = format == "fixed16" ? "minstr" : "minstr_" format
    bar = format == "kit" ? metric : "minstr"
    printf "\n%s, %s: millions of instructions a frame\n", core, format == "kit" ? "as a kit runs, bands of 16 lines and depth AUTO" : "one band, " format " depth"
    print "scene   frame   must    aim  best peer           ratio  transform  clip, set-up   bins  spans  clears   a fragment  a triangle"
    for (s = 1; s <= 8; s++) {
        scene = "S" s
        if (!((core, scene, format) in seen)) { continue }
        all = mean(core, scene, format, "frame")
        fragments = mean(core, scene, format, "fill") - mean(core, scene, format, "clears")
        verdict = format == "float16" || !must[core, scene, bar] || all / 1e6 <= must[core, scene, bar] ? " " : "!"
        printf "%s   %8.3f%s %5s  %5s  %5s %-12s %6.2f  %9.3f  %12.3f %6.3f %6.3f  %6.3f   %10.1f  %10.0f\n", scene, all / 1e6, verdict,
            must[core, scene, bar], aim[core, scene, bar], peer[core, scene, bar], peer_name[core, scene, bar],
            peer[core, scene, bar] ? all / 1e6 / peer[core, scene, bar] : 0,
            mean(core, scene, format, "vertices") / 1e6,
            (mean(core, scene, format, "geometry") - mean(core, scene, format, "vertices")) / 1e6,
            mean(core, scene, format, "bins") / 1e6, fragments / 1e6, mean(core, scene, format, "clears") / 1e6,
            all / mean(core, scene, format, "fragments"), all / mean(core, scene, format, "triangles")
        row(core, scene, metric, sprintf("%.4f", all / 1e6), must[core, scene, bar], aim[core, scene, bar], peer[core, scene, bar])
    }
}

function formats_table(core,   f, s, line) {
    printf "\n%s: millions of instructions a frame (and of spans and clears a fragment) by depth format\n", core
    line = "scene "
    for (f = 1; f <= 5; f++) { line = line sprintf("  %16s", formats[f]) }
    print line
    for (s = 1; s <= 6; s++) {
        line = "S" s "    "
        for (f = 1; f <= 5; f++) {
            if (!((core, "S" s, formats[f]) in seen)) { line = line sprintf("  %16s", "-"); continue }
            line = line sprintf("  %8.3f (%5.1f)", mean(core, "S" s, formats[f], "frame") / 1e6,
                mean(core, "S" s, formats[f], "fill") / mean(core, "S" s, formats[f], "fragments"))
        }
        print line
    }
    for (f = 3; f <= 5; f++) {
        for (s = 1; s <= 6; s++) {
            if ((core, "S" s, formats[f]) in seen) {
                row(core, "S" s, "minstr_" formats[f], sprintf("%.4f", mean(core, "S" s, formats[f], "frame") / 1e6), "", "", "")
            }
        }
    }
}

function rp2040_table(   s, cores, name) {
    print "\nEmulated RP2040, pico-display-2 (320x240), 125 MHz, only what changed is sent: millions of cycles that the busier core"
    print "works for a frame; ms a frame on a bus that takes its time"
    print "scene   one core  two cores   one core, ms  two cores, ms"
    for (s = 1; s <= 5; s++) {
        if (!((s, 1) in frame_ms)) { printf "S%d      does not fit\n", s; continue }
        printf "S%d      %8.3f   %8.3f       %8.2f       %8.2f\n", s, mcycles[s, 1], mcycles[s, 2], frame_ms[s, 1], frame_ms[s, 2]
        for (cores = 1; cores <= 2; cores++) {
            name = cores == 1 ? "1core" : "2cores"
            row("rp2040", "S" s, "mcycles_" name, sprintf("%.3f", mcycles[s, cores]), "", "", "")
            row("rp2040", "S" s, "frame_ms_" name, sprintf("%.3f", frame_ms[s, cores]), "", "", "")
        }
    }
    print "S4 has an image of its own, which takes all of the RAM and has the mesh in flash."
}

function cliffs_table(   i, c, line, name, of, times) {
    print "\nCliffs: instructions of what is rare against what is usual (and how many times that), as a kit runs"
    line = sprintf("%-18s %-20s", "", "")
    for (c = 1; c <= core_count; c++) { line = line sprintf("  %26s", cores[c]) }
    print line
    for (i = 1; i <= cliff_count; i++) {
        name = cliffs[i]
        of = unit[name, "cliff"] (unit[name, "cliff"] == unit[name, "usual"] ? "" : " : " unit[name, "usual"])
        line = sprintf("%-18s %-20s", name, "a " of)
        for (c = 1; c <= core_count; c++) {
            if (!((cores[c], name, "cliff") in cost)) { line = line sprintf("  %26s", "-"); continue }
            times = cost[cores[c], name, "cliff"] / cost[cores[c], name, "usual"]
            line = line sprintf("  %9.1f : %7.1f (%4.1f)", cost[cores[c], name, "cliff"], cost[cores[c], name, "usual"], times)
            row(cores[c], name, "cliff", sprintf("%.1f", cost[cores[c], name, "cliff"]), "", "", "")
            if ((cores[c], name, "cliff_times") in must) { # a bar on how many times the usual it is
                row(cores[c], name, "cliff_times", sprintf("%.3f", times), must[cores[c], name, "cliff_times"], aim[cores[c], name, "cliff_times"], "")
            }
        }
        print line
    }
}

function sizes_table(   n, i, list, name, tail) {
    print "\nBytes of the images of all demos: code, variables"
    n = split(sizes, list, " ")
    for (i = 1; i <= n; i++) {
        split(list[i], name, ",")
        tail = name[2] == 1 ? "_1core" : "_2cores"
        printf "%-14s %8d %8d\n", name[1] tail, code[list[i]], memory[list[i]]
        row(name[1], "all", "code_bytes" tail, code[list[i]], "", "", "")
        row(name[1], "all", "ram_bytes" tail, memory[list[i]], "", "", "")
    }
}

function quality(core,   s, scene) {
    for (s = 1; s <= 5; s++) {
        scene = "S" s
        row(core, scene, "coverage_pct", coverage[scene, "fixed16"], coverage_bar[s], "", "")
        row(core, scene, "doubles", doubles[scene, "fixed16"], 0, 0, "")
        row(core, scene, "holes", holes[scene, "fixed16"], 0, 0, "")
        row(core, scene, "depth_rms", depth_rms[scene, "fixed16"], depth_bar[s], "", "")
        row(core, scene, "distance_rms_float16", distance_rms[scene, "float16"], "2e-4", "", "")
        row(core, scene, "wrong_texel_pct", texels[scene, "fixed16"], s == 2 ? .6 : "", "", "")
    }
}

END {
    printf "core,scene,metric,value,must,aim,best_peer\n" >csv
    for (c = 1; c <= core_count; c++) {
        if (!((cores[c], "S1", "fixed16") in seen)) { continue }
        table(cores[c], "kit")
        table(cores[c], "fixed16")
        table(cores[c], "float16")
        formats_table(cores[c])
        quality(cores[c])
    }
    if (cliff_count) { cliffs_table() }
    if (rp2040) { rp2040_table() }
    if (sizes != "") { sizes_table() }
    print "\nPictures of this build (every core drew the same bytes) against the double-precision reference; bars in brackets"
    print "scene     coverage differs, %   twice  holes   depth RMS            distance RMS float16   wrong texels, %"
    for (s = 1; s <= 5; s++) {
        scene = "S" s
        printf "%s        %-9s (%s)      %5s  %5s   %-9s (%s)   %-9s (2e-4)       %s%s\n", scene, coverage[scene, "fixed16"], coverage_bar[s],
            doubles[scene, "fixed16"], holes[scene, "fixed16"], depth_rms[scene, "fixed16"], depth_bar[s],
            distance_rms[scene, "float16"], texels[scene, "fixed16"], s == 2 ? " (.6)" : ""
    }
    print "\n! over the bar. Best peer: counted once on the same machine model, see tests/bench/bars.csv."
}
