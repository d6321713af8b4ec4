#!/usr/bin/env bash
# What gcc's AddressSanitizer and UBSan do not see, under which tests/run.sh runs the fuzzers: data races between two cores,
# and an offset from NULL.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build} CC=${CC:-cc}
mkdir -p "$B"
same_addresses=() # ThreadSanitizer of gcc 12 does not start where the kernel places programs at more addresses than it knows
! setarch -R true 2>/dev/null || same_addresses=(setarch -R)

# In C, because assembly is not instrumented.
build() { # folder, compiler, flags...
    local folder=$1 cc=$2 flags=(-O1 -g1 -fno-omit-frame-pointer "${@:3}")
    make -s -j2 CC="$cc" CPU=portable CFLAGS="${flags[*]}" B="$folder" "$folder/libpinhole.a" &&
        "$cc" -std=c11 "${flags[@]}" -Ifirmware/core -Ifirmware/core/kernels/portable -o "$folder/fuzz_raster" tests/core/fuzz_raster.c "$folder/libpinhole.a" -lpthread
}

no_data_race() { # frames
    build "$B/tsan" "$CC" -fsanitize=thread && TSAN_OPTIONS=halt_on_error=1 "${same_addresses[@]}" "$B/tsan/fuzz_raster" threads "$1"
}

no_offset_from_null() {
    build "$B/null" clang -fsanitize=undefined -fno-sanitize-recover=all && "$B/null/fuzz_raster" 200000
}

if echo 'int main(void) { return 0; }' | "$CC" -fsanitize=thread -x c -o "$B/has_tsan" - 2>/dev/null; then
    check "two cores draw 1,000 scenes without a data race" no_data_race 1000
else
    skip "two cores draw scenes without a data race" "$CC has no ThreadSanitizer"
fi
if echo 'int main(void) { return 0; }' | clang -fsanitize=undefined -x c -o "$B/has_ubsan" - 2>/dev/null; then
    check "no pointer is moved away from NULL, not even by 0" no_offset_from_null
else
    skip "no pointer is moved away from NULL, not even by 0" "no clang with UBSan: apt-get install clang libclang-rt-dev"
fi
tap_end
