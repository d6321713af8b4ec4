#!/usr/bin/env bash
# No frame costs more, and no picture is worth less, than what tests/golden/bench.csv says by over 2 %; the counter is
# validated and the frames are the simulator's (bench.sh sees to both); tests/bench/README.md shows these numbers.
# After a change for the better: make bench && cp build/bench.csv tests/golden/bench.csv
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
golden=tests/golden/bench.csv
command -v qemu-system-arm >/dev/null || { echo "no qemu-system-arm: apt-get install qemu-system-arm" && exit 77; }
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
same_compiler='12.2' # counts of another compiler are other counts
case "$(arm-none-eabi-gcc -dumpversion)" in "$same_compiler"*) ;; *) echo "not arm-none-eabi-gcc $same_compiler" && exit 77 ;; esac
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

worse() { # golden, new: lines that are worse, on the cores that both have
    awk -F, 'NR == FNR { value[$1 "," $2 "," $3] = $4; next }
        FNR > 1 && ($1 "," $2 "," $3) in value {
            seen++
            if ($4 > 1.02 * value[$1 "," $2 "," $3]) { print $1 "," $2 "," $3 ": " $4 ", was " value[$1 "," $2 "," $3] }
        }
        END { if (seen < 100) { print "only " seen + 0 " numbers to compare" } }' "$@"
}

nothing_is_worse() {
    local found
    FORMATS='kit fixed16 float16' tests/bench/bench.sh m0plus m3 m4f >"$dir/table" || return 1
    found=$(worse "$golden" "$B/bench.csv")
    [ -z "$found" ] || { echo "$found" && return 1; }
}

worse_is_seen() {
    awk -F, -v OFS=, '$1 == "m3" && $2 == "S4" && $3 == "minstr" { $4 *= 1.03 } { print }' "$golden" >"$dir/new"
    [ "$(worse "$golden" "$dir/new" | wc -l)" = 1 ]
}

readme_rows() { # as in README.md here: metric, cores; scene, then for each core ours, the bar, the best peer
    awk -F, -v metric="$1" -v cores=" $2 " '$3 == metric && $5 != "" && index(cores, " " $1 " ") { row[$2] = row[$2] sprintf(" %.2f | %s | %.2f |", $4, $5, $7) }
        END { for (s = 1; s <= 8; s++) { if ("S" s in row) { print "| S" s " |" row["S" s] } } }' "$golden"
}

readme_agrees() {
    local row
    while read -r row; do grep -qxF "$row" tests/bench/README.md || { echo "tests/bench/README.md lacks: $row" && return 1; }; done < <(readme_rows minstr_kit 'm0plus m3 m4f x86_64' && readme_rows minstr_kit 'm33 rv32' && readme_rows minstr 'm0plus m3 m4f x86_64')
}

musts() { # of the pictures and of cliffs: on every core
    awk -F, '$3 !~ /^minstr|^mcycles/ && $5 != "" && $4 + 0 > $5 + 0 { print; bad = 1 } END { exit bad }' "$B/bench.csv"
}

check "nothing_is_more_than_2_percent_worse" nothing_is_worse
check "what_is_3_percent_worse_is_seen" worse_is_seen
check "the_pictures_and_the_cliffs_reach_their_bars" musts
# shellcheck disable=SC2016 # eval expands it
check "the_JSON_has_every_row" eval '[ "$(grep -c "^{\"core\": \"" "$B/bench.json")" = $(($(wc -l <"$B/bench.csv") - 1)) ]'
check "the_README_shows_the_committed_numbers" readme_agrees
check "no_term_grows_faster_than_linearly_and_bands_are_cheap" tests/bench/growth.sh m3
check "a_pixel_that_is_blended_costs_no_more_than_its_bar" tests/bench/blends.sh m0plus
check "what_moves_costs_no_more_instructions_than_its_bar" tests/bench/skin.sh m0plus
tap_end
