#!/usr/bin/env bash
# The reader of UF2 and BIN files under libFuzzer, with the sanitizers and the checks of tests/host-sim/fuzz_uf2.c: 3 minutes
# without a finding. FUZZ_S=n for another time; a finding stays in $B/log/fuzz_uf2.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
mkdir -p "$dir/corpus" "$B/log/fuzz_uf2"

build() {
    clang -std=c11 -O1 -g -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -DLIBFUZZER -Ifirmware/core -Ifirmware/app -Ihost-sim/common -Ihost-sim/flash -Itests/support \
        -o "$dir/fuzz" tests/host-sim/fuzz_uf2.c tests/support/uf2_make.c host-sim/flash/flash_file.c host-sim/flash/flash_image.c host-sim/flash/flash_uf2.c firmware/app/crc32.c
}
echo 'int LLVMFuzzerTestOneInput(const char *d, long n); int LLVMFuzzerTestOneInput(const char *d, long n) { return n > 0 && *d > 200; }' >"$dir/probe.c"
clang -fsanitize=fuzzer -o "$dir/probe" "$dir/probe.c" 2>/dev/null || { skip "libFuzzer finds nothing" "no clang with libFuzzer" && tap_end; }
build || exit 1

# Right files to start from: images and data of 1 to 5 blocks.
cc -O1 -o "$dir/seal" hal/rp2040/boot2_seal.c && cc -O1 -o "$dir/uf2" firmware/tools/image_uf2.c || exit 1
head -c 256 /dev/urandom | "$dir/seal" >"$dir/bin"
cp "$dir/bin" "$dir/corpus/bin"
for blocks in 1 5; do
    "$dir/uf2" 0xe48bff56 0x10000000 "$dir/bin" "$dir/corpus/image-$blocks"
    "$dir/uf2" 0xe48bff56 0x10100000 "$dir/bin" "$dir/corpus/data-$blocks"
    head -c 1000 /dev/urandom >>"$dir/bin"
done

finds_nothing() {
    "$dir/fuzz" -max_total_time="${FUZZ_S:-180}" -max_len=4096 -timeout=100 -artifact_prefix="$B/log/fuzz_uf2/" "$dir/corpus" 2>&1 | tail -n 40 >"$dir/log"
    grep -E '^Done [0-9]+ runs' "$dir/log" || { cat "$dir/log" && return 1; }
}
check "libFuzzer finds nothing in ${FUZZ_S:-180} s" finds_nothing
grep -E '^Done' "$dir/log" | sed 's/^/# /'
tap_end
