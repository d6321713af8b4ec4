#!/usr/bin/env bash
# The tests of the core are tested: each line of mutants.txt breaks one thing in a copy of the core on purpose; the test named
# beside it must fail. A line that changes nothing any more fails in tests/tools/test_house.sh.
# (The portable core: what a CPU has of its own is held to it by tests/core/test_kernels.sh.)
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}/mutants CC=${CC:-cc}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

sources() { # file; of a header those that read it, through others too
    local file
    case $1 in
    *.h) for file in firmware/core/{fx,geom,render,effects,kernels/portable}/*.c; do
        ! $CC -MM -Ifirmware/core{,/kernels/portable,/render,/effects,/kernels} "$file" | grep -q "/${1##*/}\\b" || echo "${file#firmware/core/}"
    done ;;
    *) echo "$1" ;;
    esac
}

# Compiles the mutated files alone: they take the place of their archive members.
fails() { # file below firmware/core, sed, test
    local file object objects=()
    rm -rf "$dir/core" "$dir"/*.o
    cp -r firmware/core "$dir/core"
    sed -i "$2" "$dir/core/$1"
    for file in $(sources "$1"); do
        object=$dir/$(basename "$file").o
        $CC -std=c11 -O2 -w -I"$dir/core"{,/kernels/portable,/render,/effects,/kernels} -c "$dir/core/$file" -o "$object" || return 1
        objects+=("$object")
    done
    # shellcheck disable=SC2086 # a list of words
    $CC "$B/tests/core/$3.o" "${objects[@]}" "$B/libtests.a" "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -Wl,--as-needed $libs -lm -o "$dir/mutant" || return 1
    ! timeout 120 "$dir/mutant" >/dev/null 2>&1 </dev/null || { echo "$3 did not notice" && return 1; }
}

libs="$(for lib in cmocka osmesa mpfr gmp; do pkg-config --libs "$lib" 2>/dev/null; done)"
[ "${libs/cmocka/}" != "$libs" ] || { echo "no cmocka: apt-get install libcmocka-dev" && exit 77; }
while IFS= read -r line; do
    ! in_share || echo "$line"
done < <(grep -v '^#' tests/core/mutants.txt) >"$dir/mutants"
mapfile -t tests < <(awk -F' [|] ' '{ print $2 }' "$dir/mutants" | sort -u)
for test in "${tests[@]}"; do
    make -s CPU=portable B="$B" "$B/tests/core/$test" >"$dir/log" 2>&1 || { [ "$test" = test_mesa ] && continue; cat "$dir/log"; exit 1; }
    check "${test}_passes_untouched" "$B/tests/core/$test"
done
while IFS= read -r line; do
    what=${line%% | *} line=${line#* | }
    test=${line%% | *} line=${line#* | }
    file=${line%% | *} change=${line#* | }
    if [ -e "$B/tests/core/$test" ]; then
        check "${test}_sees_${what//[ ,]/_}" fails "${file#firmware/core/}" "$change" "$test"
    else
        skip "$test: $what" "$test is not built here"
    fi
done <"$dir/mutants"
tap_end
