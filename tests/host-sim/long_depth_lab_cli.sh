#!/usr/bin/env bash
# pinhole-depth: the measurements print what is promised, every option has an effect, every wrong one gives one line and
# exit 2, what is written is whole or not there. (budget, planes, plot, all have tests of their own.)
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
lab=$(realpath "${B:-build}/pinhole-depth") || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# ---- helpers

csv() { "$lab" "$@" --csv -; }

differ() { # options... -- options...
    local one=()
    while [ "$1" != -- ]; do one+=("$1") && shift; done
    shift
    csv "${one[@]}" >"$dir/one" && csv "$@" >"$dir/two" && [ -s "$dir/one" ] && [ -s "$dir/two" ] && ! cmp -s "$dir/one" "$dir/two"
}

# Exit 2, one line on stderr that matches the pattern, nothing on stdout.
refuses() { # pattern, options...
    local pattern=$1 got=0
    shift
    timeout 1000 "$lab" "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 2 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ ! -s "$dir/stdout" ] && grep -q "^pinhole-depth: .*$pattern" "$dir/stderr" ||
        { echo "exit $got:" "$@" && head -n 5 "$dir/stderr" "$dir/stdout" && return 1; }
}

# The field of the only row (behind the header) that begins with the prefix.
field() { # number, prefix, options...
    local number=$1 prefix=$2
    shift 2
    csv "$@" | grep "^$prefix" | cut -d, -f"$number"
}

# ---- what the measurements print

pairs_has_the_columns() {
    [ "$(csv pairs --count 10 | head -n 1)" = format,bits,near,far,spacing,count,equal,swap,max_wrong_m ] &&
        [ "$(csv pairs --count 10 | grep -c ',linear,10,')" -ge 28 ]
}

resolve_has_the_columns() {
    [ "$(csv resolve --at 1 --format fixed16 | head -n 1)" = format,bits,near,far,z_m,ideal_m,measured_m,ratio ] &&
        csv resolve --at 1 --format fixed16 | tail -n 1 | grep -q '^fixed16,16,0.5,100,S_worst,'
}

every_format_has_a_row() {
    csv pairs --count 10 | cut -d, -f1,2 | sort -u >"$dir/rows"
    local row
    for row in fixed16,16 float16,16 fixed24,24 float24,24 linear-w,16 ndc-q16,16 ndc-q16,24 recip-q16,16 recip-q16,24 clip-q16,16 \
        clip-q16,24 log,16 log,24 ieee32-standard,32 ieee32-infinite,32 ieee32-reversed,32 ieee32-infinite-reversed,32 ieee32-gl,32 \
        ieee32-gl-infinite,32 int24-standard,24 int24-infinite,24 int24-reversed,24 int24-infinite-reversed,24 int24-gl,24 \
        int24-gl-infinite,24; do
        grep -qx "$row" "$dir/rows" || { echo "$row" && return 1; }
    done
}

# --json has the rows of --csv: json.awk, which `make bench` uses, makes the same of the CSV.
json_is_the_csv() { # argument...
    "$lab" "$@" --json - >"$dir/json" && "$lab" "$@" --csv - | awk -f firmware/tools/json.awk | cmp - "$dir/json" &&
        grep -q '^{"format": "fixed16", "bits": 16, ' "$dir/json"
}

json_is_json() { # node reads it, and a file is as stdout
    "$lab" pairs --count 10 --json "$dir/file.json" && "$lab" pairs --count 10 --json - | cmp - "$dir/file.json" || return 1
    ! command -v node >/dev/null || [ "$(node -e 'const d = JSON.parse(require("fs").readFileSync(0)); console.log(d[0].format, d[0].count + 1)' <"$dir/file.json")" = "fixed16 11" ]
}

reed() { # name, equal, swap
    [ "$(csv pairs --near .1 --far 10000 --format "$1" | tail -n 1 | cut -d, -f1-8)" = "$1,$4,0.1,10000,linear,10000,$2,$3" ]
}

reed_published_these() {
    reed ieee32-standard 7720 1 32 && reed ieee32-infinite 7575 1 32 && reed ieee32-reversed 0 0 32 && reed ieee32-infinite-reversed 0 0 32 &&
        reed ieee32-gl 7734 0 32 && reed ieee32-gl-infinite 7663 0 32 && reed int24-standard 7720 1 24 && reed int24-infinite 7575 1 24 && reed int24-gl 7734 0 24 && reed int24-gl-infinite 7663 0 24 &&
        reed int24-reversed 7577 0 24 && reed int24-infinite-reversed 7578 0 24
}

# At .1 .. 10000 a float with 4 bits of exponent cannot tell 4,020 of 10,000 pairs apart, one with 5 bits 64; the renderer takes 5.
widths_tell_these_pairs_apart() {
    reed float16-e3 9364 0 16 && reed float16-e4 4020 0 16 && reed float16-e5 64 0 16 && reed float16-e6 2016 0 16 && reed float16 64 0 16 &&
        reed float24-e3 2327 0 24 && reed float24-e4 0 0 24 && reed float24-e5 0 0 24 && reed float24-e6 0 0 24 && reed float24 0 0 24
}

widths_are_rows_only_by_name() {
    ! csv pairs --count 10 | grep -q -- '-e[3-6],' && [ "$(csv pairs --count 10 --format float24-e3,fixed16 | cut -d, -f1 | tr '\n' ' ')" = "format fixed16 float24-e3 " ]
}

# Ours are never swapped, those of a Q16.16 reciprocal are.
swaps() {
    csv pairs --near .1 --far 1000 >"$dir/pairs"
    ! grep -E '^(fixed|float|linear|log|over)' "$dir/pairs" | cut -d, -f8 | grep -qvx 0 && [ "$(grep ^recip-q16,24 "$dir/pairs" | cut -d, -f8)" -gt 100 ]
}

reaches() { # most in thousandths of a millimetre, near, far, format
    field 7 "$4,.*S_worst" resolve --near "$2" --far "$3" --at "$3" --format "$4" | awk -v most="$1" '{ exit !($1 > 0 && $1 * 1e6 <= most * 1.05) }' ||
        { echo "$4 near $2 far $3" && return 1; }
}

ours_reach_the_table() {
    reaches 126000000 .1 1000 fixed16 && reaches 303000 .5 100 fixed16 && reaches 74000 .1 1000 float16 && reaches 5800 .5 100 float16 &&
        reaches 596000 .1 1000 fixed24 && reaches 60000 1 1000 fixed24 && reaches 300 .1 1000 float24 && reaches 240 1 1000 float24 && reaches 15300 .1 1000 linear-w && reaches 1500 .5 100 linear-w
}

monotone_passes() {
    csv monotone --near .5 --far 20 --format fixed16,float16,fixed24,float24,linear-w,log >"$dir/monotone" || return 1
    [ "$(grep -c ',pass$' "$dir/monotone")" = 8 ] && [ "$(cut -d, -f5 "$dir/monotone" | sed -n 2p)" = 1277953 ]
}

monotone_sees_swaps() { csv monotone --near .5 --far 20 --format recip-q16 | grep -q ',fail$'; }

every_anchor_holds() {
    csv anchors >"$dir/anchors" || { grep FAIL "$dir/anchors" && return 1; }
    [ "$(grep -c ",pass$" "$dir/anchors")" = 105 ] && [ "$(grep -c ",the sum alone$" "$dir/anchors")" = 4 ] && ! grep -q FAIL "$dir/anchors"
}

# Each number names its source; what is ours is not called published; recip-q16 is searched from the near plane on.
anchors_name_their_sources() {
    [ "$(awk -F, 'NR > 1 { print $2 }' "$dir/anchors" | cut -d: -f1 | sort | uniq -c | awk '{ printf "%s %s ", $2, $1 }')" = "ours 41 published 44 reproduced 24 " ] &&
        ! awk -F, '/^(Akeley|Q16.16)/ && $2 !~ /^ours/' "$dir/anchors" | grep . && grep -q 'recip-q16 (16 bits n 0.1 f 1000),ours,988,988.27713,' "$dir/anchors"
}

# View and projection one after the other: the article's percentages to the digit.
reed_with_a_view_has_his_percentages() {
    [ "$(grep -c 'view then projection' "$dir/anchors")" = 12 ] && awk -F, '/view then projection/ { split($3, stated, " "); d = $4 - stated[1]; if (d > .5 || d < -.5) { print; bad = 1 } } END { exit bad }' "$dir/anchors"
}

columns_say_predicted_or_measured() {
    "$lab" pairs --count 10 | head -n 1 | grep -q 'equal (measured) .*swapped (measured) .*(measured)' &&
        "$lab" resolve --at 1 --format fixed16 | head -n 1 | grep -q '(predicted).*(measured)'
}

# Distances from near to z, evenly spread over the logarithm, z among them.
up_to() { awk -v n="$1" -v z="$2" 'BEGIN { for (i = 1; i <= 60; i++) { w = n * exp(log(z / n) * i / 61); if (w > n + 1e-4) printf "%.5f,", w } print z }'; }

# What advise promises, resolve measures (long_depth_advise.sh: planes that lean): at every distance up to Z with that near plane and format.
promise() { # separate, z, far
    csv advise --separate "$1" --at "$2" --far "$3" --tilt 0 | tail -n +2 >"$dir/advice"
    [ "$(wc -l <"$dir/advice")" -ge 5 ] || return 1
    local format bits far z s least safe rest asked=0
    while IFS=, read -r format bits far z s least safe rest; do
        for near in "$least" "$safe"; do
            [ "$near" != none ] || continue
            asked=$((asked + 1))
            csv resolve --near "$near" --far "$far" --at "$(up_to "$near" "$z")" --format "$format" | grep "^$format,$bits," | grep -v S_worst |
                awk -F, -v most="$s" '!($7 > 0 && $7 <= most) { print "at", $5, $7; bad = 1 } END { exit bad || NR < 30 }' || { echo "$format near $near: not $s" && return 1; }
        done
    done <"$dir/advice"
    [ "$asked" -ge 4 ]
}

advice_is_kept() { promise .05 100 100 && promise .01 30 100 && promise .5 400 1000 && promise .002 5 50; }

# With the least near plane halved, a fixed format no longer separates: the advice is not just safe but tight.
advice_is_tight() {
    local near
    near=$(field 6 fixed16 advise --separate .05 --at 90 --tilt 0 --format fixed16)
    field 7 fixed16,.*,90, resolve --near "$(awk "BEGIN { print $near / 2 }")" --at 90 --format fixed16 | awk '{ exit !($1 > .05) }' || return 1
    near=$(field 6 fixed16 advise --separate .0001 --at 3 --far 3 --tilt 0 --format fixed16) # near ranges use all codes
    awk -v near="$near" 'BEGIN { exit !(near > .9 && near < 1.2) }'
}

# What advise finds, beside the bound, is the coarsest up to Z.
advice_works_backwards() {
    local said found
    said=$(field 10 float16 advise --near .2 --at 50 --tilt 0 --format float16)
    found=$(field 7 float16,.*,50, resolve --near .2 --at 50 --format float16)
    awk -v said="$said" -v found="$found" 'BEGIN { exit !(found > 0 && said >= found && said <= found * 2) }' || { echo "$said, $found" && return 1; }
}

# Up to the far plane that is S_worst, which a float has in front of it, not at it.
advice_to_far_is_s_worst() {
    local format near far said worst
    for format in fixed16 float16 fixed24 float24 linear-w; do
        while read -r near far; do
            said=$(field 10 "$format" advise --near "$near" --far "$far" --at "$far" --tilt 0 --format "$format")
            worst=$(field 7 "$format,.*,S_worst," resolve --near "$near" --far "$far" --at "$far" --format "$format" | head -n 1)
            awk -v said="$said" -v worst="$worst" 'BEGIN { exit !(worst > 0 && said <= worst && said >= worst * .98 - .0000153) }' ||
                { echo "$format $near $far: $said, $worst" && return 1; }
        done <<<$'.5 100\n10 2000'
    done
}

advice_is_in_sentences() {
    "$lab" advise --separate .05 --at 100 --near .5 >"$dir/text" && grep -q '^To separate 0.05 m at every distance up to 100 m with float16 (16 bits): the near plane at ' "$dir/text" &&
        grep -q '^With the near plane at 0.5 m, fixed16 (16 bits) separates ' "$dir/text" && head -n 1 "$dir/text" | grep -q '^Take float16 (16 bits)'
}

twice_the_same() { csv resolve --format float16,clip-q16 >"$dir/one" && csv resolve --format float16,clip-q16 >"$dir/two" && cmp "$dir/one" "$dir/two"; }

# Planes seen edge-on have a separation too, or say in words that none is right.
edge_on_planes_have_a_number() {
    local tilt z
    for tilt in 85 89 -89; do
        for z in 2 50 99; do
            csv planes --tilt "$tilt" --at "$z" --size 120x120 >"$dir/planes" || return 1
            [ "$(awk -F, 'NR > 1 && $10 + 0 > 0 && $10 < $7 + .0001' "$dir/planes" | wc -l)" = 5 ] || { cat "$dir/planes" && return 1; }
        done
    done
    csv planes --tilt 89 --near .1 --far 1000 --at .2 --format linear-w --size 120x120 >"$dir/planes" && ! grep -iE 'inf|nan' "$dir/planes" && grep -q ',none,none,0,unlit$' "$dir/planes" &&
        "$lab" planes --tilt 89 --near .1 --far 1000 --at .2 --format linear-w --size 120x120 | grep -q '^none: linear-w at 0.19'
}

# Far from the eye a step of Q16.16 is in the ninth digit.
csv_keeps_the_last_bit() {
    csv resolve --near .5 --far 1000 --format ndc-q16,recip-q16,clip-q16,fixed16 --at 999.99 | tail -n +2 | cut -d, -f7 |
        awk '{ lsbs = $1 * 65536; if (lsbs - int(lsbs + .5) > .01 || int(lsbs + .5) - lsbs > .01) { print; bad = 1 } } END { exit bad || NR < 14 }' || return 1
    [ "$(field 7 "recip-q16,16,.*S_worst" resolve --near .1 --far 1000 --at 1000 --format recip-q16 | head -n 1)" = 988.2771301 ]
}

# Floors before walls, at every place and in every shading; where a pixel is wrong it is by less than a step.
scenes_are_in_order() {
    csv scenes >"$dir/scenes" && [ "$(wc -l <"$dir/scenes")" = 126 ] || return 1
    awk -F, 'NR > 1 && ($7 < 200 || ($5 != "crossing" && $8 > 0) || $8 > 4 || $9 > $11) { print; bad = 1 } END { exit bad }' "$dir/scenes" || return 1
    csv scenes --near .1 --far 1000 | awk -F, 'NR > 1 && ($9 > $11 || ($5 == "sphere twice" && $8 > 0)) { print; bad = 1 } $1 == "fixed16" && $5 == "tiles" { coarse += $8 }
        END { exit bad || coarse < 1000 }'
}

# A bound is one for all tilts up to its own: what was measured at any of them counts.
slopes_stay_below_their_bounds() {
    csv slopes --size 120x90 --format float16,fixed24,linear-w --at 20 >"$dir/slopes" && [ "$(wc -l <"$dir/slopes")" = 91 ] &&
        awk -F, 'NR > 1 { most[$1, $6] = most[$1, $6] > $9 ? most[$1, $6] : $9; if (!($9 > 0 && $9 <= $8 && $8 < 5 * most[$1, $6])) { print; bad = 1 } }
            END { exit bad }' "$dir/slopes"
}

# One triangle has one depth, whatever its shading.
shadings_need_the_same() {
    cut -d, -f1-5,7- "$dir/slopes" | sort | uniq -c | awk '$1 != 5 && !/format/ { print; bad = 1 } END { exit bad }'
}

check "floors, walls, tiles and spheres are in order in every shading" scenes_are_in_order
check "planes of every slope and azimuth stay below their bounds" slopes_stay_below_their_bounds
check "every shading needs the same separation" shadings_need_the_same
check "--azimuth has an effect" differ planes --tilt 60 --azimuth 30 --format float16 -- planes --tilt 60 --format float16
check "--shading has an effect" differ planes --tilt 60 --shading gouraud --format float16 -- planes --tilt 60 --format float16
check "planes seen edge-on have a number or a word" edge_on_planes_have_a_number
check "CSV keeps the last bit of Q16.16" csv_keeps_the_last_bit
check "pairs prints the promised columns" pairs_has_the_columns
check "resolve prints the promised columns, S_worst last" resolve_has_the_columns
check "every promised format has a row" every_format_has_a_row
check "float32 counts are those that N. Reed published" reed_published_these
check "the bits of a float's exponent tell these pairs apart" widths_tell_these_pairs_apart
check "formats with a number of bits are measured by name alone" widths_are_rows_only_by_name
check "the renderer never swaps two distances; a Q16.16 reciprocal does" swaps
check "S_worst of the renderer's formats is the computed one or better" ours_reach_the_table
check "every distance from .5 to 20 m is in order, in every format of the renderer" monotone_passes
check "monotone sees what is not" monotone_sees_swaps
check "every anchor holds" every_anchor_holds
check "anchors name their sources" anchors_name_their_sources
check "Reed with a view has the percentages of his article" reed_with_a_view_has_his_percentages
check "columns say what is predicted and what is measured" columns_say_predicted_or_measured
check "what advise promises is measured by resolve" advice_is_kept
check "half of the near plane that advise names is not enough" advice_is_tight
check "advise says what a near plane separates" advice_works_backwards
check "advise up to the far plane says S_worst" advice_to_far_is_s_worst
check "advise speaks in sentences" advice_is_in_sentences
check "two runs print the same bytes" twice_the_same

# ---- options

writes_csv_to_a_file() { "$lab" pairs --count 10 --csv "$dir/out.csv" && csv pairs --count 10 | cmp - "$dir/out.csv" && ! ls "$dir"/*.part 2>/dev/null; }
help_names_everything() {
    "$lab" --help >"$dir/help" || return 1
    local word
    for word in pairs resolve monotone advise anchors planes slopes scenes budget plot all --near --far --depth --format --fov --size --csv --count --spacing --at --separate --separation --tilt --azimuth --shading --bits --out --help float24 ieee32-gl; do
        grep -q -- "$word" "$dir/help" || { echo "$word" && return 1; }
    done
}
several_formats_are_several_rows() { [ "$(csv pairs --count 10 --format fixed16,log | cut -d, -f1 | tr '\n' ' ')" = "format fixed16 log log " ]; }
bits_choose_formats() { [ "$(csv advise --separate .1 --at 50 --bits 24 | cut -d, -f2 | sort -u | tr '\n' ' ')" = "24 bits " ]; }
unwritable_is_one_line() {
    local got=0
    "$lab" pairs --count 10 --csv "$dir/no/x.csv" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ ! -s "$dir/stdout" ]
}
file_limit_leaves_nothing() { # 1 KiB
    local got=0
    mkdir -p "$dir/limit" && (ulimit -f 1 && exec "$lab" pairs --count 10 --csv "$dir/limit/x.csv") >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ -z "$(ls "$dir/limit")" ]
}
full_device_is_one_line() {
    local got=0
    "$lab" pairs --count 10 --csv - >/dev/full 2>"$dir/stderr" || got=$?
    [ "$got" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ]
}
no_progress_without_a_terminal() { "$lab" monotone --near .5 --far 1 2>"$dir/stderr" >"$dir/stdout" && [ ! -s "$dir/stderr" ] && [ -s "$dir/stdout" ]; }

check "--near has an effect" differ pairs --near .1 -- pairs --near .2
check "--far has an effect" differ pairs --far 100 -- pairs --far 200
check "--format has an effect" differ pairs --format fixed16 -- pairs --format float16
check "--count has an effect" differ pairs --count 100 -- pairs --count 101
check "--spacing has an effect" differ pairs --spacing linear -- pairs --spacing log
check "--at has an effect" differ resolve --at 1 --format fixed16 -- resolve --at 1,2 --format fixed16
check "--separate has an effect" differ advise --at 50 --separate .1 -- advise --at 50 --separate .2
check "--bits has an effect" bits_choose_formats
check "--csv FILE writes the whole file" writes_csv_to_a_file
check "--format takes several names" several_formats_are_several_rows
check "--help names commands, options and formats" help_names_everything
check "a file that cannot be written is one line and exit 1" unwritable_is_one_line
check "a file limit is one line and leaves nothing" file_limit_leaves_nothing
check "a full device is one line and exit 1" full_device_is_one_line
check "no progress without a terminal" no_progress_without_a_terminal

# ---- wrong usage

check "no command is wrong" refuses "which command"
check "an unknown command is wrong" refuses "no such command" resolv
check "an unknown option is wrong" refuses "no such option" pairs --deep 16
check "an option of another command is wrong" refuses "does not take it" resolve --count 10
check "near 0 is wrong" refuses "near '0'" pairs --near 0
check "a near plane below half a step is wrong, and the step is named" refuses "near '.000001'.*at least one step of Q16.16, 1/65536" pairs --near .000001
check "a separation below half a step is wrong" refuses "separation.*step of Q16.16" planes --separation .000001
check "float32 formats are for pairs" refuses "resolve measures no float32 format; pairs does" resolve --format ieee32-standard
check "a float32 format among others is for pairs" refuses "monotone measures no float32" monotone --format fixed16,int24-gl
check "a negative near plane is wrong" refuses "near" pairs --near -1
check "near over far is wrong" refuses "less than --far" pairs --near 5 --far 4
check "near equal to far is wrong" refuses "less than --far" pairs --near 4 --far 4
check "far beyond Q16.16 is wrong" refuses "far '32768'" pairs --far 32768
check "garbage behind a number is wrong" refuses "near" pairs --near 1x
check "nan is wrong" refuses "near" pairs --near nan
check "an empty value is wrong" refuses "near" pairs --near ""
check "a missing value is wrong" refuses "needs a value" pairs --near
check "0 pairs are wrong" refuses "count" pairs --count 0
check "absurdly many pairs are wrong" refuses "count" pairs --count 99999999999
check "an unknown spacing is wrong" refuses "spacing" pairs --spacing cubic
check "an unknown shading is wrong" refuses "shading" planes --shading wire
check "an azimuth of more than a turn is wrong" refuses "azimuth" planes --azimuth 361
check "an unknown format is wrong" refuses "format" pairs --format fixed17
check "a distance in front of the near plane is wrong" refuses "from --near to --far" resolve --at .1
check "a list of distances with a hole is wrong" refuses "at" resolve --at 1,,2
check "advise without a distance is wrong" refuses "needs --at" advise --separate .1
check "12 bits are wrong" refuses "bits" advise --separate .1 --at 50 --bits 12
check "a separation larger than the distance is wrong" refuses "less than --at" advise --separate 60 --at 50
check "a size of 0 is wrong" refuses "size" pairs --size 0x5
check "a field of view of 180 degrees is wrong" refuses "fov" pairs --fov 180
check "json_has_the_rows_of_csv" eval 'json_is_the_csv pairs --count 10 && json_is_the_csv budget --at 1,10 && json_is_the_csv advise --near .5 --at 20'
check "json_is_JSON" json_is_json
tap_end
