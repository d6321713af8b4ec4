#!/usr/bin/env bash
# fx.hpp, the number type of C++: compiled by g++ and clang++ as C++14, 17 and 20, with warnings as errors; what it must
# refuse does not compile.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
make -s B="$B" "$B/libpinhole.a" >/dev/null || exit 1
flags=(-Wall -Wextra -Wpedantic -Wconversion -Werror -Ifirmware/core -Ifirmware/core/kernels/portable)

runs() { # compiler, standard
    "$1" -std="$2" "${flags[@]}" -O2 tests/core/fx_hpp.cpp "$B/libpinhole.a" -o "$dir/program" && "$dir/program"
}

refuses() { # compiler, expression, what is said of it
    printf '#include "fx/fx.hpp"\nusing namespace pinhole::literals;\npinhole::fixed f() { return %s; }\n' "$2" >"$dir/wrong.cpp"
    ! "$1" -std=c++14 "${flags[@]}" -fsyntax-only "$dir/wrong.cpp" 2>"$dir/said" && grep -q -- "$3" "$dir/said" || { cat "$dir/said" && return 1; }
}

for compiler in g++ clang++; do
    command -v $compiler >/dev/null || { skip "$compiler" "no $compiler" && continue; }
    for standard in c++14 c++17 c++20; do check "${compiler}_as_$standard" runs $compiler $standard; done
    check "${compiler}_refuses_a_number_with_a_fraction" refuses $compiler 0.5 'delete'
    for text in 32768_fx 1e3_fx 0x10_fx; do check "${compiler}_refuses_$text" refuses $compiler $text 'decimal number below 32768'; done
done
tap_end
