#!/usr/bin/env bash
# An option has one name in all programs. --help of all of them is compared: another name that an option had once still
# works, in every program that has the option.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || C` is meant
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# A line for each option of each program: program, name, its value ("-": none), its other name ("-": none).
for program in "$B"/pinhole-*; do
    [ -x "$program" ] && [ ! -d "$program" ] || continue
    "$program" --help | awk -v program="${program##*/}" '
        function put() { if (name != "") { print program, name, value, also } }
        /^  --[a-z]/ { put(); name = $1; value = NF > 1 ? "value" : "-"; also = "-" }
        /^        also: --/ { also = $2 }
        END { put() }'
done >"$dir/options"

every_program_has_options() { [ "$(cut -d' ' -f1 "$dir/options" | sort -u | wc -l)" -ge 7 ] && [ "$(wc -l <"$dir/options")" -gt 90 ]; }

an_option_has_the_same_other_name_everywhere() {
    awk '{ if ($2 in also && also[$2] != $4) { print $2 ": " also[$2] " and " $4; bad = 1 } also[$2] = $4; aliases += $4 != "-" }
        END { exit bad || !aliases }' "$dir/options"
}

no_other_name_is_an_option_of_its_own() {
    awk '{ name[$2] = $1; if ($4 != "-") { other[$4] = $2 } } END { for (o in other) { if (o in name) { print o " is " other[o] " and an option of " name[o]; bad = 1 } } exit bad }' "$dir/options"
}

# --json is a form of what is printed in one program, and a file in the other; both are promised (host-sim/README.md).
an_option_takes_a_value_everywhere_or_nowhere() {
    awk '$2 != "--json" { if ($2 in value && value[$2] != $3) { print $2 " in " $1; bad = 1 } value[$2] = $3 } END { exit bad }' "$dir/options"
}

same() { # command, with the option's name as NAME: both names give the same output
    local name
    for name in depth format; do "${@//NAME/--$name}" >"$dir/$name" 2>&1 || return 1; done
    [ -s "$dir/depth" ] && cmp "$dir/depth" "$dir/format"
}

both_names_of_the_depth_do_the_same() {
    same "$B/pinhole-sim" --demo cube --size 64x64 NAME linear-w --stats && same "$B/pinhole-depth" pairs --count 10 NAME fixed16 --csv - || return 1
    grep -q '^fixed16,' "$dir/depth" && [ "$(wc -l <"$dir/depth")" = 2 ]
}

a_message_names_the_option_as_it_was_given() {
    local name
    for name in depth format; do
        ! "$B/pinhole-sim" --crc --"$name" none 2>"$dir/said" && grep -q -- "--$name 'none': must be" "$dir/said" &&
            ! "$B/pinhole-depth" pairs --"$name" none 2>"$dir/said" && grep -q -- "--$name 'none': must be" "$dir/said" || return 1
        [ ! -x "$B/pinhole-panel" ] || { ! "$B/pinhole-panel" --board sbc-generic --"$name" none 2>"$dir/said" && grep -q -- "--$name 'none': must be" "$dir/said"; } || return 1
    done
}

lists_are_an_option_of_every_program_that_has_one() {
    [ ! -x "$B/pinhole-panel" ] || "$B/pinhole-panel" --list | cmp - <("$B/pinhole-panel" list)
}

check every_program_has_options every_program_has_options
check an_option_has_the_same_other_name_everywhere an_option_has_the_same_other_name_everywhere
check no_other_name_is_an_option_of_its_own no_other_name_is_an_option_of_its_own
check an_option_takes_a_value_everywhere_or_nowhere an_option_takes_a_value_everywhere_or_nowhere
check both_names_of_the_depth_do_the_same both_names_of_the_depth_do_the_same
check a_message_names_the_option_as_it_was_given a_message_names_the_option_as_it_was_given
check list_is_an_option_of_pinhole_panel lists_are_an_option_of_every_program_that_has_one
tap_end
