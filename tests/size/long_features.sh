#!/usr/bin/env bash
# What each feature costs, alone and with others, on each core: features.csv has the bytes (2 % slack), firmware/README.md
# shows them, and the pictures are those of a program that links the whole library.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says which fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi" && exit 77; }
make -s -j2 B="$B" "$B/libpinhole.a" || exit 1

weigh() { # core, macros...: bytes; the program stays in $B
    CORE=$1 tests/tools/program_size.sh "${@:2}" tests/size/features.c | awk '$1 == "all" { print $2 }'
}

# Compares with a record; where it takes more it says what the unlit program does not have.
takes() { # core, record, macros...
    local bytes prefix=arm-none-eabi-
    [ "$1" != rv32 ] || prefix=riscv64-unknown-elf-
    bytes=$(weigh "$1" "${@:3}")
    [ "${bytes:-0}" -ge $(($2 * 98 / 100)) ] || { echo "${bytes:-no} bytes, $2 before: tests/size/features.sh prints the rows anew" && return 1; }
    [ "$bytes" -gt $(($2 * 102 / 100)) ] || return 0
    echo "$bytes bytes, $2 before; it links"
    "${prefix}nm" "$B/$1-os/program.elf" | awk '$2 ~ /[tTrR]/ { print $3 }' | sort -u >"$dir/has"
    weigh "$1" >/dev/null
    "${prefix}nm" "$B/$1-os/program.elf" | awk '$2 ~ /[tTrR]/ { print $3 }' | sort -u | comm -13 - "$dir/has" | grep '^ph_' | head -n 20
    return 1
}

rows_hold() { # core, its column
    local name macros record failed=0
    while IFS=, read -r name _ macros rest; do
        [ "$name" != name ] || continue
        record=$(cut -d, -f"$2" <<<"$rest")
        # shellcheck disable=SC2086 # a word each
        takes "$1" "$record" $macros >"$dir/said" || { echo "$name:" && cat "$dir/said" && failed=1; }
    done <tests/size/features.csv
    return "$failed"
}

column=1
for core in m0plus m3 m33 rv32; do
    if ! in_share; then
        :
    elif [ $core = rv32 ] && ! command -v riscv64-unknown-elf-gcc >/dev/null; then
        skip "features_take_what_features.csv_says_on_$core" "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf"
    else
        check "features_take_what_features.csv_says_on_$core" rows_hold $core $column
    fi
    column=$((column + 1))
done

# Wrong on purpose: a line in the unlit program.
a_line_is_seen() {
    local record
    record=$(grep '^unlit,' tests/size/features.csv | cut -d, -f4)
    ! takes m0plus "$record" -DLINE >"$dir/said" && cat "$dir/said" && grep -qx ph_draw_line "$dir/said"
}
check "what_pulls_a_feature_in_is_seen_and_named" a_line_is_seen

draws() { # program, macros and flags...
    cc -std=c11 -Wall -Wextra -O1 -DSHOWN "${@:2}" -Ifirmware/core -Ifirmware/core/kernels/portable -Ifirmware/app -o "$dir/$1" && "$dir/$1"
}
pictures_are_equal() {
    local name macros drawn
    while IFS=, read -r name _ macros _; do
        [ "$name" != name ] || continue
        # shellcheck disable=SC2086 # a word each
        drawn=$(draws few $macros tests/size/features.c firmware/app/crc32.c "$B/libpinhole.a") && [ "${drawn#* }" -gt 100 ] &&
            [ "$drawn" = "$(draws all $macros tests/size/features.c firmware/app/crc32.c -Wl,--whole-archive "$B/libpinhole.a" -Wl,--no-whole-archive)" ] || { echo "$name: $drawn" && return 1; }
    done <tests/size/features.csv
}
check "pictures_are_those_of_the_whole_library" pictures_are_equal

paper_has_it() { tests/size/features.sh --table >"$dir/table" && grep -A $(($(wc -l <"$dir/table") - 1)) -F "$(head -n 1 "$dir/table")" firmware/README.md | diff "$dir/table" -; }
check "the_papers_have_the_table" paper_has_it
tap_end
