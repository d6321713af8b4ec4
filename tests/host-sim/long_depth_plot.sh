#!/usr/bin/env bash
# pinhole-depth's plots and report: pictures with their titles, the same bytes every time, nothing half-written, one line
# where something is wrong or missing; and the README's table of formats is what the commands print.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
depth=$(realpath "$B")/pinhole-depth
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
small=(--near 1 --far 8 --size 48x36)

# Options that the kind takes and that make it quick.
quick() {
    case $1 in
    budget) echo "${small[*]} --format fixed16,float16 --at 2,8" ;;
    resolve) echo '--near 1 --far 8 --format fixed16,float16,ndc-q16 --at 1,2,4,8' ;;
    others) echo '--near 1 --far 8 --at 1,2,4,8' ;;
    pairs) echo '--near 1 --far 8 --count 1000' ;;
    *) : ;;
    esac
}

plot() { # kind, file
    # shellcheck disable=SC2046 # words
    "$depth" plot "$1" --out "$2" $(quick "$1")
}

words_of() { # what must stand in the SVG, a pattern a line
    case $1 in
    ndc) printf '%s\n' 'n = 0.5 m, f = 10 m' 'n = 1 m, f = 10 m' 'course 4600' ;;
    g) printf '%s\n' 'n = 1 m, f = 3 m' 'g(z)' ;;
    resolve) printf '%s\n' 'separation \[m\]' 'distance z \[m\]' 'ripe for z-fighting' 'very good' fixed16 'ndc-q16 16 bits' ;;
    others) printf '%s\n' 'recip-q16 24 bits' 'clip-q16 24 bits' float16 ;;
    pairs) printf '%s\n' '1000 pairs' '\[% of the pairs there\]' float24 'recip-q16 24 bits' 'fixed16: [0-9.]* % of all' ;;
    budget) printf '%s\n' 'sub-pixel' interpolation 'all together' 'separation \[m\]' float16 ;;
    esac
}

every_plot_is_a_picture() { # kind
    plot "$1" "$dir/$1.svg" && plot "$1" "$dir/$1.png" || return 1
    [ "$(head -c 4 "$dir/$1.png" | tail -c 3)" = PNG ] || { echo "no PNG" && return 1; }
    local word
    while read -r word; do
        sed 's/<[^>]*>//g' "$dir/$1.svg" | tr -d '\n' | grep -q -- "$word" || { echo "no '$word'" && return 1; }
    done < <(words_of "$1")
    [ "$(grep -c '<path' "$dir/$1.svg")" -ge 3 ] || { echo "no curves" && return 1; }
    ! command -v rsvg-convert >/dev/null || rsvg-convert "$dir/$1.svg" -o "$dir/converted.png"
}

twice_the_same_bytes() {
    local kind
    for kind in ndc resolve; do
        cp "$dir/$kind.svg" "$dir/once.svg" && plot "$kind" "$dir/$kind.svg" && cmp "$dir/once.svg" "$dir/$kind.svg" || return 1
    done
}

near_and_far_change_the_curve() {
    "$depth" plot ndc --near 2 --far 20 --out "$dir/other.svg" && grep -q 'n = 2 m, f = 20 m' "$dir/other.svg"
}

# The curve of z_ndc is that of the formula: half of the depth values before 2 f n / (f + n).
halves_are_those_of_the_formula() {
    grep -q 'half before 0.95 m' "$dir/ndc.svg" && grep -q 'half before 1.82 m' "$dir/ndc.svg" && grep -q 'half before 1.50 m' "$dir/g.svg"
}

# Every point that the plots of `ndc` and `g` hand to gnuplot: HAW's curve from -1 to 1, course 4600's from 0 to 1. The
# matrix rounds to 1/131072, which the division by z enlarges.
curves_are_those_of_the_documents() {
    mkdir -p "$dir/fake" && printf '#!/bin/sh\ntee "%s"\n' "$dir/script" >"$dir/fake/gnuplot" && chmod +x "$dir/fake/gnuplot" || return 1
    local kind near far tag
    while read -r kind near far tag; do
        PATH="$dir/fake:$PATH" "$depth" plot "$kind" --out "$dir/fake.svg" || return 1
        sed -n "/^\$c$tag << EOD/,/^EOD/p" "$dir/script" | awk -v n="$near" -v f="$far" -v kind="$kind" '
            function off(got, want) { return got - want > bound || want - got > bound }
            NF == 3 && $1 ~ /^-/ {
                z = -$1; points++; bound = 1e-6 + (1 + 1 / z) / 65536
                if (off($2, (f + n) / (f - n) - 2 * f * n / (f - n) / z) || off($3, f / (f - n) * (1 - n / z))) { print kind, $0; bad = 1 }
            }
            NR == 2 { first = $1 }
            NF == 3 && $1 ~ /^-/ { last = $1 }
            END { exit bad || points < 100 || first != -f || last != -n }' || return 1
    done <<'END'
ndc 0.5 10 0
ndc 1 10 1
g 1 3 0
END
}

refuses() { # status, arguments: one line, nothing on stdout
    local want=$1 got=0
    shift
    env PATH="${depth_path:-$PATH}" "$depth" "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = "$want" ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && [ ! -s "$dir/stdout" ] || { echo "status $got" && cat "$dir/stderr" && return 1; }
}

nothing_is_left() { [ -z "$(find "$dir/none" -mindepth 1)" ] || { find "$dir/none" && return 1; }; }

wrong_usage_is_refused() {
    mkdir -p "$dir/none"
    refuses 2 plot && refuses 2 plot nonsense --out "$dir/none/x.svg" && refuses 2 plot ndc && refuses 2 plot ndc --out "$dir/none/x.jpg" &&
        refuses 2 plot ndc --out "$dir/none/.svg.txt" && refuses 2 plot ndc --near 3 --far 2 --out "$dir/none/x.svg" && refuses 2 all &&
        refuses 2 planes --out "$dir/none/x.gif" && refuses 2 planes --format ndc-q16 && refuses 2 budget --format log &&
        refuses 2 planes --separation 0 && refuses 2 planes --tilt 90 && nothing_is_left
}

bad_paths_are_refused() {
    local quick_planes=(planes "${small[@]}" --format float16 --tilt 30)
    refuses 1 plot g --out "$dir/no/x.svg" && refuses 1 all --out "$dir/no/such/place" && refuses 1 all --out "$dir/ndc.svg" &&
        refuses 1 "${quick_planes[@]}" --out "$dir/no/x.ppm" && mkdir -p "$dir/none/x.svg" && refuses 1 plot g --out "$dir/none/x.svg" &&
        [ -z "$(find "$dir/none" -name '*.part')" ] && rmdir "$dir/none/x.svg" && nothing_is_left
}

missing_gnuplot_is_one_line() {
    mkdir -p "$dir/empty"
    depth_path=$dir/empty refuses 1 plot g --out "$dir/none/x.svg" || return 1
    grep -q 'apt-get install gnuplot-nox' "$dir/stderr" && nothing_is_left
}

error_picture_shows_what_is_counted() {
    "$depth" planes "${small[@]}" --far 100 --at 50 --format fixed16,float24 --tilt 30 --separation 0.005 --out "$dir/e.ppm" >"$dir/planes" || return 1
    [ "$(sed -n 2p "$dir/e.ppm" | head -1)" = "100 36" ] || { echo "size" && return 1; } # 2 x 48 and a gap of 4
    local counted orange blue wrong samples
    read -r samples wrong < <(awk '$2 == "all" { s += $5; w += $6 } END { print s, w }' "$dir/planes")
    counted=$(tail -c $((100 * 36 * 3)) "$dir/e.ppm" | od -An -v -tu1 -w3 | awk '{ n[$1" "$2" "$3]++ } END { print n["245 190 60"] + 0, n["0 92 146"] + 0 }')
    read -r orange blue <<<"$counted"
    [ "$orange" = "$wrong" ] && [ $((orange + blue)) = "$samples" ] && [ "$wrong" -gt 100 ] || { echo "$counted, not $wrong of $samples" && return 1; }
}

report_has_it_all() {
    "$depth" all --near 1 --far 4 --size 24x24 --out "$dir/report" 2>"$dir/stderr" || { cat "$dir/stderr" && return 1; }
    local name
    for name in advise resolve pairs budget planes slopes scenes monotone; do
        [ -s "$dir/report/$name.csv" ] && grep -q "pinhole-depth $name --near 1 --far 4" "$dir/report/report.md" || { echo "$name" && return 1; }
    done
    [ -s "$dir/report/planes.png" ] || return 1
    # shellcheck disable=SC2016 # backquotes of Markdown
    sed -n 3p "$dir/report/report.md" | grep -qE '^\*\*Take `[a-z0-9]+` \((16|24) bits\): with the near plane at 1 m .* from [0-9.e-]+ m on' || { echo "no answer" && return 1; }
    grep -oE '\]\([^)]+' "$dir/report/report.md" | cut -c3- | while read -r name; do [ -s "$dir/report/$name" ] || { echo "$name" && exit 1; }; done
}

# Few curves: without --format those of the renderer and some to compare with; float16's saw-tooth is sampled.
plots_can_be_read() {
    "$depth" plot resolve --near 1 --far 4 --out "$dir/few.svg" && [ "$(grep -c 'recip-q16\|over-w\|clip-q16' "$dir/few.svg")" = 0 ] || return 1
    [ "$(grep -oE ' L?[0-9.]+,[0-9.]+' "$dir/few.svg" | wc -l)" -gt 1500 ]
}

report_says_why_it_has_no_directory() {
    ln -s missing "$dir/dangling"
    ! "$depth" all --near 1 --far 4 --out "$dir/dangling" 2>"$dir/stderr" && grep -qx 'pinhole-depth: --out .*: Not a directory' "$dir/stderr"
}

# A command that the report names gives the rows that stand there.
report_rows_are_the_commands() {
    local command
    "$depth" pairs --near 1 --far 4 --csv - | diff - "$dir/report/pairs.csv" || return 1
    # shellcheck disable=SC2016 # backquotes of Markdown
    command=$(grep -o '`pinhole-depth advise [^`]*' "$dir/report/report.md" | cut -d' ' -f2-)
    # shellcheck disable=SC2086 # options
    "$depth" $command --csv - | diff - "$dir/report/advise.csv"
}

# The table between README's marks is made of resolve's S_worst.
readme_table_is_measured() {
    local near far row missing=0
    for row in "0.5 100" "0.1 1000" "1 1000"; do
        read -r near far <<<"$row"
        "$depth" resolve --near "$near" --far "$far" --format fixed16,float16,fixed24,float24,linear-w --at "$near" --csv - |
            awk -F, '$5 == "S_worst" { printf "%s %s %.3g\n", $1, $2, $7 }' >>"$dir/worst-$near-$far"
    done
    local name bits
    for name in fixed16:16 float16:16 linear-w:16 fixed24:24 float24:24; do
        bits=${name#*:} name=${name%:*}
        row="| \`$name\` |"
        for near in 0.5-100 0.1-1000 1-1000; do
            row="$row $(awk -v n="$name" -v b="$bits" '$1 == n && $2 == b { print $3 }' "$dir/worst-$near") |"
        done
        grep -qF "$row" README.md || { echo "$row" && missing=1; }
    done
    return "$missing"
}

readme_millimetres_are_measured() {
    local mm
    mm=$("$depth" budget --at 100 --format float24 --csv - | awk -F, '$6 == "sub-pixel" { printf "%.1f", $8 * 1000 }')
    grep -q "$mm mm at 100 m" README.md || { echo "$mm mm" && return 1; }
}

if command -v gnuplot >/dev/null; then
    for kind in ndc g resolve others pairs budget; do
        check "plot_${kind}_is_a_picture_with_its_titles" every_plot_is_a_picture "$kind"
    done
    check "plots_have_few_curves_and_many_samples" plots_can_be_read
    check "a_plot_is_the_same_bytes_twice" twice_the_same_bytes
    check "near_and_far_change_the_curve" near_and_far_change_the_curve
    check "halves_are_those_of_the_formula" halves_are_those_of_the_formula
    check "bad_paths_are_refused_in_one_line" bad_paths_are_refused
else
    skip "plots_are_pictures" "gnuplot is missing"
fi
check "curves_are_those_of_the_documents_at_every_point" curves_are_those_of_the_documents
check "wrong_usage_is_refused_in_one_line" wrong_usage_is_refused
check "missing_gnuplot_is_one_line" missing_gnuplot_is_one_line
check "the_error_picture_shows_what_is_counted" error_picture_shows_what_is_counted
check "the_report_has_it_all" report_has_it_all
check "a_report_says_why_it_has_no_directory" report_says_why_it_has_no_directory
check "rows_of_the_report_are_those_of_the_command" report_rows_are_the_commands
check "the_readme_table_is_what_resolve_measures" readme_table_is_measured
check "the_readme_names_the_sub_pixel_share_that_budget_measures" readme_millimetres_are_measured
tap_end
