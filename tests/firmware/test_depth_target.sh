#!/usr/bin/env bash
# The depth lab on a microcontroller core: what the image prints on its UART is what the host program prints.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
elf=$dir/make/firmware/lm3s6965evb-depth.elf
formats=fixed16,float16,fixed24,float24,linear-w,over-w,ndc-q16,recip-q16,clip-q16,log

builds() { make -s B="$dir/make" firmware BOARD=lm3s6965evb APP=depth && [ -s "$elf" ]; }

has_no_floating_point() {
    ! arm-none-eabi-nm "$elf" | grep -E ' (__aeabi_[df](add|sub|mul|div|2)|__(add|sub|mul|div)[sd]f3|malloc|free)'
}

runs() {
    timeout -k 5 2000 qemu-system-arm -M lm3s6965evb -nographic -monitor none -serial "file:$dir/uart" \
        -semihosting-config enable=on,target=native -kernel "$elf" </dev/null && [ "$(tail -n 1 "$dir/uart")" = 'done' ]
}

same_bytes() {
    {
        "$B/pinhole-depth" pairs --near .1 --far 1000 --count 500 --csv - --format "$formats" &&
            "$B/pinhole-depth" resolve --near 1 --far 4 --csv - --format "$formats" && echo 'done'
    } >"$dir/host" && [ "$(wc -l <"$dir/host")" -gt 60 ] && cmp "$dir/host" "$dir/uart"
}

if ! command -v arm-none-eabi-gcc >/dev/null; then
    skip "the image of the depth lab builds" "no arm-none-eabi-gcc"
elif ! command -v qemu-system-arm >/dev/null; then
    skip "a Cortex-M3 measures what the host measures, byte for byte" "no qemu-system-arm"
else
    check "the image of the depth lab builds" builds
    check "the image has neither floating point nor a heap" has_no_floating_point
    check "the image runs to its end on a Cortex-M3" runs
    check "a Cortex-M3 measures what the host measures, byte for byte" same_bytes
fi
tap_end
