#!/usr/bin/env bash
# The fuzzer of binary scenes as a program of 32 bits, where an offset of 2^31 or more leaves the address space.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

if ! printf 'int main(void){return 0;}' | gcc -m32 -fsanitize=address,undefined -x c - -o "$dir/probe" 2>/dev/null || ! "$dir/probe" 2>/dev/null; then
    skip "no scene breaks a program of 32 bits" "no gcc-12-multilib, or a kernel of 64 bits alone"
    tap_end
fi

compile() {
    local app
    mapfile -t app < <(find firmware/app firmware/app/demos firmware/app/models -maxdepth 1 -name '*.c' ! -name 'runner*' ! -name 'memory_plan*' ! -name 'self_test*')
    gcc -m32 -std=c11 -O1 -g1 -fsanitize=address,undefined -fno-sanitize-recover=all -idirafter /usr/include/x86_64-linux-gnu -DPH_CHECKED=1 \
        -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/core/{render,kernels,geom,fx,effects} -Ifirmware/app -Ihal -Itests/support -o "$dir/fuzz_scene" \
        tests/app/fuzz_scene.c tests/support/fuzz.c firmware/core/{fx,geom,render,effects}/*.c firmware/core/kernels/portable/*.c "${app[@]}" -lm
}

no_scene_breaks_it() { "$dir/fuzz_scene" long; }

check "the fuzzer compiles for 32 bits" compile
check "no scene breaks a program of 32 bits" no_scene_breaks_it
tap_end
