#!/usr/bin/env bash
# Programs take no more bytes than bytes.csv says: what each took when it was measured last (record), and its bar (must) from the
# moment when it was reached. A bar that is not reached yet is told as skipped, with what is measured.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT

bytes_of() { tests/tools/program_size.sh "$@" | awk '$1 == "all" { print $2 }'; }

takes_at_most() { # bytes, program...
    local bytes
    bytes=$(bytes_of "${@:2}")
    [ "${bytes:-999999}" -le "$1" ] || { echo "${*:2}: ${bytes:-no} bytes, $1 are allowed" && return 1; }
}

# Within 2 % of the record, both ways: whoever saves more writes it down.
is_as_recorded() { # record, bytes
    [ "$2" -le $(($1 * 102 / 100)) ] || { echo "$2 bytes, $1 before" && return 1; }
    [ "$2" -ge $(($1 * 98 / 100)) ] || { echo "$2 bytes, $1 before: write it into tests/size/bytes.csv" && return 1; }
}

# Which of the functions the program has that was linked last.
linked_of() { # function...
    arm-none-eabi-nm "$B/m0plus-os/program.elf" | awk -v names="$*" 'BEGIN { n = split(names, name); for (i = 1; i <= n; i++) { asked[name[i]] } }
        $3 in asked { print $3 }'
}
links() { [ -n "$(linked_of "$1")" ]; } # function

# What a program that does not name a feature must not link, each by one function of it.
links_none_of() { # function...: of the program that was linked last
    local found
    found=$(linked_of "$@" | xargs)
    [ -z "$found" ] || { echo "it links $found" && return 1; }
}

named=$(cut -d, -f5 tests/size/bytes.csv | sed 1d | tr ' ' '\n' | sort -u) # the last two programs link all of them
while IFS=, read -r program must aim record lacks; do
    [ "$program" != program ] || continue
    mv "$dir/last" "$dir/last_but_one" 2>/dev/null
    bytes=$(bytes_of "tests/size/$program.c")
    arm-none-eabi-nm "$B/m0plus-os/program.elf" >"$dir/last"
    # shellcheck disable=SC2086 # a word each
    check "${program}_links_no_feature_that_it_does_not_name" links_none_of $lacks
    check "${program}_takes_what_bytes.csv_says" is_as_recorded "$record" "${bytes:-0}"
    if [ "$record" -le "$must" ]; then
        check "${program}_takes_at_most_${must}_bytes" [ "${bytes:-999999}" -le "$must" ]
    else
        skip "${program}_takes_at_most_${must}_bytes" "$bytes today; the aim is $aim"
    fi
done <tests/size/bytes.csv
is_linked() { cat "$dir/last_but_one" "$dir/last" | grep -q " $1$"; } # function
for function in $named; do check "everything_or_points_links_$function" is_linked "$function"; done

# A call that pulls lines in is seen, and the line is named.
sed 's|^    const struct ph_config|    ph_draw_line(\&renderer, positions[0], positions[1], \&material);\n&|' tests/size/unlit.c >"$dir/unlit.c"
a_call_is_seen() {
    grep -q ph_draw_line "$dir/unlit.c" && bytes_of -Itests/size "$dir/unlit.c" >/dev/null &&
        ! links_none_of ph_light_vertex ph_setup_line >"$dir/said" && grep -qx 'it links ph_setup_line' "$dir/said"
}
check "a_call_that_pulls_a_feature_in_is_seen" a_call_is_seen

# A program whose mesh has no bounds does not link what tests them, and one that asks for them does.
sed 's|^    const int status|    struct ph_mesh mesh = {.part_count = 0};\n    struct ph_sphere bounds;\n    ph_mesh_bounds(\&mesh, \&bounds);\n&|' tests/size/unlit.c >"$dir/bounds.c"
bounds_are_linked_where_they_are_named() {
    bytes_of tests/size/everything.c >/dev/null && ! links ph_cull_spheres && bytes_of -Itests/size "$dir/bounds.c" >/dev/null && links ph_cull_spheres
}
check "bounds_are_linked_where_they_are_named" bounds_are_linked_where_they_are_named

# The user's file, the library's modules and what libgcc does have names, not those of archives and of gcc's objects.
rows_have_names() {
    tests/tools/program_size.sh tests/size/everything.c >"$dir/rows" && ! grep '\.[ao]\b\|/' "$dir/rows" || return 1
    local row
    for row in planes fill alignment 'libgcc: 64-bit division' 'the program itself'; do
        [ "$(grep -c "^$row " "$dir/rows")" = 1 ] || { echo "no row, or several: $row" && return 1; }
    done
    awk 'NR > 1 && $1 != "all" { f += $(NF - 1); r += $NF } $1 == "all" { exit !(f == $2 && r == $3) }' "$dir/rows"
}
check "rows_have_names_that_a_user_knows" rows_have_names

# More code in a program is seen.
{
    echo '#include "picture.h"'
    echo 'int main(void) { static const uint16_t more[4096] = {1}; return more[display]; }'
} >"$dir/large.c"
large_is_seen() { ! takes_at_most 8000 -Itests/size "$dir/large.c" && takes_at_most 9000 -Itests/size "$dir/large.c"; }
check "more_constants_are_seen" large_is_seen
more_is_told() { ! is_as_recorded 1000 1021 && ! is_as_recorded 1000 979 && is_as_recorded 1000 1020; }
check "more_than_2_percent_are_told" more_is_told
tap_end
