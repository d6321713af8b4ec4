#!/usr/bin/env bash
# pinhole-depth advise: what it says separates does separate, at that tilt, by brute force (planes, resolve); one step
# below does not. Of a scene it foresees every pixel that shows the wrong surface.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
lab=$(realpath "${B:-build}/pinhole-depth") || exit 1
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

csv() { "$lab" "$@" --csv -; }

refuses() { # pattern, options...
    local pattern=$1 got=0
    shift
    "$lab" advise "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 2 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ ! -s "$dir/stdout" ] && grep -q "^pinhole-depth: .*$pattern" "$dir/stderr" ||
        { echo "exit $got:" "$@" && head -n 5 "$dir/stderr" "$dir/stdout" && return 1; }
}

# ---- planes

leaning() { # near, far, z, tilt, format: the separation that planes finds
    csv planes --near "$1" --far "$2" --at "$3" --tilt "$4" --format "$5" | grep "^$5," | cut -d, -f10
}

facing() { csv resolve --near "$1" --far "$2" --at "$3" --format "$4" | grep "^$4," | head -n 1 | cut -d, -f7; } # near, far, z, format

is_at_most() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a > 0 && a <= b) }'; }

# Every near plane that advise names keeps the separation; half of it does not, where the near plane decides (the fixed formats).
promise() { # separate, z, far, tilt
    csv advise --separate "$1" --at "$2" --far "$3" --tilt "$4" | tail -n +2 >"$dir/advice"
    [ "$(wc -l <"$dir/advice")" = 5 ] || return 1
    local format least safe near kept=0 half
    while IFS=, read -r format _ _ _ _ least safe _; do
        for near in "$least" "$safe"; do
            [ "$near" != none ] || continue
            is_at_most 0.0039 "$near" || { echo "$format: near $near is too small" && return 1; }
            is_at_most "$(leaning "$near" "$3" "$2" "$4" "$format")" "$1" && is_at_most "$(facing "$near" "$3" "$2" "$format")" "$1" ||
                { echo "$format near $near: not $1 at $2" && return 1; }
            kept=$((kept + 1))
        done
        case "$format $least" in
        fixed*none | float* | linear* | *" 0.0039") ;;
        *)
            half=$(awk "BEGIN { print $least / 2 }")
            ! is_at_most "$(leaning "$half" "$3" "$2" "$4" "$format")" "$1" || ! is_at_most "$(facing "$half" "$3" "$2" "$format")" "$1" ||
                { echo "$format: near $half separates $1 too" && return 1; }
            ;;
        esac
    done <"$dir/advice"
    [ "$kept" -ge 4 ]
}

promises_are_kept() { promise .05 100 100 60 && promise .02 30 100 75 && promise .5 400 1000 45 && promise .05 100 100 -60; }

# The least separation at 100 m and 60 degrees is that of the sub-pixel grid, near .0003 or not.
no_millimetre_at_100_m() {
    "$lab" advise --separate .001 --at 100 >"$dir/text" && head -n 1 "$dir/text" | grep -q '^No format separates 0.001 m .* 60 degrees: the sub-pixel grid' &&
        csv advise --separate .001 --at 100 | tail -n +2 | cut -d, -f6,7 | sort -u | grep -qx none,none &&
        ! is_at_most "$(leaning .5 100 99.9 60 float24)" .001 && csv advise --separate .001 --at 100 --tilt 0 | grep -q '^float24,24,[^n]*$'
}

# More lines make the sub-pixel grid finer.
lines_help() {
    csv advise --separate .001 --at 100 --size 1000x1000 | grep -q '^float24,24,[^n]*$'
}

# A format separates on 1000 lines what none does on 240.
lines_help_a_format() {
    csv advise --separate .002 --at 100 | tail -n +2 | cut -d, -f6 | sort -u | grep -qx none &&
        csv advise --separate .002 --at 100 --size 1000x1000 | grep -q '^fixed24,24,100,100,0.002,[1-9]'
}

near_says_what_it_separates() {
    local format said found
    for format in fixed16 float16 float24; do
        IFS=, read -r said found < <(csv advise --near .5 --at 60 --tilt 60 --format "$format" | grep "^$format," | cut -d, -f9,10)
        is_at_most "$(leaning .5 100 60 60 "$format")" "$said" && is_at_most "$(facing .5 100 60 "$format")" "$said" && is_at_most "$found" "$said" ||
            { echo "$format: $said" && return 1; }
    done
}

# One number for one question, to the digit, in every command and in the table of README.md.
commands_agree() {
    local format any facing near far
    while read -r near far; do
        for format in fixed16 float16 fixed24 float24 linear-w; do
            read -r facing any < <("$lab" resolve --near "$near" --far "$far" --at "$far" --format "$format" 2>/dev/null | sed -n 's/.* distance are \(.*\) m for .* camera, \(.*\) m at any tilt.*/\1 \2/p')
            [ -n "$any" ] && [ "$(csv advise --near "$near" --far "$far" --at "$far" --tilt 89 --format "$format" | grep "^$format," | cut -d, -f9)" = "$any" ] &&
                [ "$(csv advise --near "$near" --far "$far" --at "$far" --tilt 0 --format "$format" | grep "^$format," | cut -d, -f9)" = "$facing" ] &&
                [ "$(csv budget --near "$near" --far "$far" --at "$far" --format "$format" | grep ',all,' | cut -d, -f7)" = "$any" ] &&
                [ "$(csv slopes --size 240x240 --near "$near" --far "$far" --at "$far" --format "$format" | grep ',unlit,89,' | cut -d, -f8)" = "$any" ] &&
                [ "$(csv planes --near "$near" --far "$far" --at "$far" --tilt 89 --azimuth 45 --format "$format" | grep "^$format," | cut -d, -f9)" = "$any" ] &&
                awk -v near="$near" -v far="$far" -v facing="$facing" -v any="$any" -v format="\`$format\`" -F ' *[|,] *' '
                    function is(a, b) { return (a > b ? a - b : b - a) <= 2e-3 * b }
                    $2 == format { for (i = 3; i <= 7; i += 2) good += is($i, facing) && is($(i + 1), any) } END { exit good < 1 }' README.md ||
                { echo "$format, near $near, far $far: facing $facing, any tilt $any" && return 1; }
        done
    done <<<$'.5 100\n.1 1000\n1 1000'
}


# ---- scenes

row() { csv advise "$@" | awk -F, -v f="$format" '$1 == f { print $6, $7, $8, $10, $11; exit }'; } # of $format: pixels, overlapping, fight, wrong, unforeseen

every_wrong_pixel_is_foreseen() {
    local scene
    for scene in '--demo zfight' '--demo parallel --start 9' '--demo zfight --start 40 --size 320x240' '--demo snake --frames 3' '--demo shadow' '--demo turntable --near .01 --far 1000' \
        '--demo ground --near .1 --far 10000 --camera eye=0,2,8' '--demo solar --view moon' '--demo focus --near .02 --far 500' '--demo fisheye --frames 8 --start 30'; do
        # shellcheck disable=SC2086 # options
        csv advise $scene | awk -F, -v scene="$scene" 'NR > 1 && ($11 != 0 || $10 > $8 || $8 > $7 || $7 > $6) { print scene ": " $0; bad = 1 } END { exit bad || NR < 6 }' || return 1
    done
}

zfight_fights_in_fixed16_alone() {
    local format=fixed16 pixels overlapping fight wrong
    read -r pixels overlapping fight wrong _ < <(row --demo zfight --size 320x240)
    [ "$pixels" -gt 10000 ] && [ "$overlapping" -gt 8000 ] && [ "$fight" -gt 4000 ] && [ "$wrong" -gt 3000 ] || return 1
    format=float16
    read -r _ _ fight wrong _ < <(row --demo zfight --size 320x240)
    [ "$fight" = 0 ] && [ "$wrong" = 0 ] && "$lab" advise --demo zfight | head -n 1 | grep -q '^Take float16 (16 bits) with the near plane at 0.25 m: 0 of .* would fight\.$'
}

# The distances of a fisheye are those from the eye: as the plane of a perspective, nearly all pixels would seem off.
a_fisheye_is_measured() {
    local format=float24 pixels overlapping fight wrong unforeseen
    read -r pixels overlapping fight wrong unforeseen < <(row --demo fisheye --frames 8 --start 30)
    [ "$pixels" -gt 400000 ] && [ "$overlapping" -gt 10000 ] && [ "$fight" -gt 0 ] && [ "$fight" -lt 600 ] && [ "$wrong" -gt 0 ] && [ "$unforeseen" = 0 ] ||
        { echo "$pixels $overlapping $fight $wrong $unforeseen" && return 1; }
    "$lab" advise --demo fisheye | head -n 1 | grep -q "^Take fixed16 .* in every format: the fisheye's flat pieces and the sub-pixel grid move them"
}

# A larger near plane is worth naming: fewer pixels fight.
a_larger_near_plane_helps() {
    csv advise --demo zfight --format fixed16 | awk -F, 'NR == 2 { n = $4; fight = $8 } NR == 3 { exit !($4 > n && $8 < fight && $8 > 0) } END { if (NR != 3) exit 1 }'
}

# A sheet so far above a larger floor, seen from 28.3 m at 45 degrees; the turntable's platter stands lower.
sheet() { # metres
    awk -v gap="$1" 'BEGIN {
        print "mtllib sheet.mtl"
        for (i = 0; i < 2; i++) {
            y = (1 - i) * .2 + i * (.2 + gap); s = i ? .5 : .65
            printf "v %g %g %g\nv %g %g %g\nv %g %g %g\nv %g %g %g\nusemtl m%d\nf %d %d %d %d\n", -s, y, s, s, y, s, s, y, -s, -s, y, -s, i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4
        }
        print "v 0 -1 0\nv 0.001 -1 0\nv 0 -1 0.001\nf 9 10 11" }' >"$dir/sheet.obj"
    printf 'newmtl m0\nKd .2 .6 .2\nnewmtl m1\nKd .9 .2 .1\n' >"$dir/sheet.mtl"
}

above() { # gap, format, fov, up: the share in % of the sheet's pixels that fight with the floor
    sheet "$1"
    "$lab" advise --model "$dir/sheet.obj" --camera "eye=0,20,20,up=${4:-0,1,0}" --fov "${3:-4}" --format "$2" >"$dir/said" 2>"$dir/stderr" || return 1
    sed -n "s/^Surface 2 (#[0-9a-f]*) before surface 1 (#[0-9a-f]*): .* fight: $2 \([0-9.e+-]*\) %.*/\1/p" "$dir/said"
}

# The depth step there is z^2 / (n 65408): 22.8 .. 26 mm along the ray, by the cosine of 45 degrees 16 .. 18.4 mm up.
a_gap_of_a_step_decides() {
    local low high
    low=$(above .015 fixed16) && high=$(above .027 fixed16) || return 1
    [ "$low" = 100 ] && [ "$high" = 0 ] && [ "$(above .015 float16)" = 0 ] && [ "$(above .0005 float16)" = 100 ] || { echo "$low, $high" && return 1; }
}

# Two sheets under a parallel projection, near 1 far 100, so far apart. The share in % of the pixels that fight, and the
# pixels that show the wrong one.
parallel_sheets() { # gap, format
    cat >"$dir/parallel.gltf" <<END
{"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1, 2, 3]}], "scene": 0,
 "nodes": [{"mesh": 0, "translation": [0, 0, -50]}, {"mesh": 1, "translation": [0, 0, $(awk -v gap="$1" 'BEGIN { printf "%.6f", gap - 50 }')]}, {"camera": 0}, {"mesh": 0, "translation": [0, 0, -99]}],
 "cameras": [{"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 2, "znear": 1, "zfar": 100}}],
 "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}, {"pbrMetallicRoughness": {"baseColorFactor": [0, 0, 1, 1]}}],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}, {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 1}]}],
 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
 "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]}
END
    csv advise --model "$dir/parallel.gltf" --format "$2" | awk -F, 'NR == 2 { print $9, $10, $11 }'
}

# The step of fixed16 is (f - n) / 65408, .76 mm of the file's; a float of 3 bits of exponent has twice that here.
parallel_views_are_measured() {
    local gap format wanted said
    while read -r gap format wanted; do
        said=$(parallel_sheets "$gap" "$format")
        [ "$said" = "$wanted" ] || { echo "$format, $gap m apart: $said, not $wanted" && return 1; }
    done <<<$'.0009 fixed16 100 0 0\n.0012 fixed16 0 0 0\n.0003 float16 100 14400 0\n.0012 float24 0 0 0'
}

# At 60 degrees the distance changes by .136 m a pixel, and the grid moves both by .75 mm along the ray.
the_sub_pixel_grid_decides() {
    local up
    for up in 0,1,0 1,0,0 1,1,0; do
        [ "$(above .0003 float24 60 "$up")" = 100 ] && [ "$(above .0008 float24 60 "$up")" = 0 ] || { echo "up $up: $(above .0003 float24 60 "$up") $(above .0008 float24 60 "$up")" && return 1; }
    done
    [ "$(above .0003 float24 4)" = 0 ] && "$lab" advise --model "$dir/sheet.obj" --camera eye=0,20,20 --fov 60 | head -n 1 | grep -q 'in every format: the sub-pixel grid'
}

has_models() { sheet .1 && "$lab" advise --model "$dir/sheet.obj" >"$dir/stdout" 2>"$dir/stderr"; }

two_runs_agree() { csv advise --demo snake >"$dir/one" && csv advise --demo snake | cmp - "$dir/one"; }

options_have_an_effect() {
    local one two
    while IFS='|' read -r one two; do
        # shellcheck disable=SC2086 # options
        csv advise $one >"$dir/one" && csv advise $two >"$dir/two" && [ -s "$dir/one" ] && ! cmp -s "$dir/one" "$dir/two" || { echo "$one, $two" && return 1; }
    done <<'END'
--demo zfight|--demo cube
--demo zfight|--demo zfight --start 9
--demo zfight|--demo zfight --frames 2
--demo solar|--demo solar --view moon
--demo zfight|--demo zfight --near .5
--demo zfight|--demo zfight --far 300
--demo zfight|--demo zfight --fov 40
--demo zfight|--demo zfight --size 100x80
--demo cube|--demo cube --camera eye=0,1,3
--demo cube --camera eye=0,1,3|--demo cube --camera eye=0,1,3,target=1,0,0
--demo zfight|--demo zfight --bits 16
--demo zfight --format float16-e3|--demo zfight --format float16-e4
--at 50 --separate .1 --tilt 30|--at 50 --separate .1
--at 50 --separate .002 --size 100x100|--at 50 --separate .002
END
}

check "what advise says separates does, and half of the near plane does not" promises_are_kept
check "a millimetre at 100 m and 60 degrees is finer than the sub-pixel grid" no_millimetre_at_100_m
check "more lines help there" lines_help
check "more lines help a format" lines_help_a_format
check "a near plane separates what planes and resolve measure" near_says_what_it_separates
check "advise, planes, slopes, resolve, budget and README.md agree" commands_agree
check "every pixel that shows the wrong surface was foreseen" every_wrong_pixel_is_foreseen
check "zfight fights in fixed16 and not in float16" zfight_fights_in_fixed16_alone
check "a fisheye is measured, and what its flat pieces do" a_fisheye_is_measured
check "a larger near plane helps fixed16" a_larger_near_plane_helps
if has_models; then
    check "a sheet fights with the floor within a depth step, and not above" a_gap_of_a_step_decides
    check "a parallel view has steps of its own" parallel_views_are_measured
    check "seen from farther off it fights within the sub-pixel grid, in every format" the_sub_pixel_grid_decides
else
    skip "a parallel view has steps of its own" "this build reads no model files"
    skip "a sheet fights with the floor within a depth step, and not above" "this build reads no model files"
fi
check "each option has an effect" options_have_an_effect
check "two runs print the same bytes" two_runs_agree
while IFS='|' read -r pattern options; do
    # shellcheck disable=SC2086 # options
    check "wrong usage: $options" refuses "$pattern" $options
done <<'END'
no such demo|--demo nope
of which model|--allow-outside
no such view|--demo zfight --view nope
exclude each other|--demo cube --model x
belong to planes|--demo cube --at 3
belong to planes|--demo cube --separate 1
belong to planes|--demo cube --tilt 1
belong to a scene|--camera eye=1,2,3 --at 50 --near 1
belong to a scene|--frames 2 --at 50 --near 1
--camera 'foo': must be|--demo cube --camera foo
--camera 'target=1,2,3': must be|--demo cube --camera target=1,2,3
--frames '0': must be|--demo cube --frames 0
--near must be less than --far|--demo cube --near 5 --far 2
none of these formats|--demo cube --format log
needs --at|--separate .1
--tilt '90': must be|--at 50 --separate .1 --tilt 90
END
tap_end
