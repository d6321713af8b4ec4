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

builds() { make -s B="$dir/make" firmware BOARD=lm3s6965evb APP=depth && [ -s "$elf" ]; }

has_no_floating_point() {
    ! arm-none-eabi-nm "$elf" | grep -E ' (__aeabi_[df](add|sub|mul|div|2)|__(add|sub|mul|div)[sd]f3|malloc|free)'
}

# Requests go in as a person types them, when the image asks: before that its UART is off. One of them is none.
types() {
    local tries=0
    until grep -q '^near' "$dir/uart" || [ $((tries++)) -ge 3000 ]; do sleep 0.1; done
    printf '0.1 1000 fixed16\r\nnonsense\n1 4 all\nend\n'
}

runs() {
    mkfifo "$dir/typed" && : >"$dir/uart" || return 1
    types >"$dir/typed" &
    timeout -k 5 2000 qemu-system-arm -M lm3s6965evb -nographic -monitor none -serial stdio -semihosting-config enable=on,target=native \
        -kernel "$elf" <"$dir/typed" >"$dir/uart" && [ "$(grep -cx 'done' "$dir/uart")" = 2 ]
}

asks_and_refuses() { [ "$(grep -c '^near \[m\], far \[m\], format' "$dir/uart")" -ge 4 ] && [ "$(grep -cx 'no such request' "$dir/uart")" = 1 ]; }

compares() {
    "$B/pinhole-depth" compare "$dir/uart" --csv - >"$dir/compared" && [ "$(sed 's/,[0-9]*,same$/,same/' "$dir/compared")" = $'near,far,format,lines,verdict\n0.1,1000,fixed16,same\n1,4,all,same' ] &&
        "$B/pinhole-depth" compare - --csv - <"$dir/uart" | cmp - "$dir/compared"
}

# The target prints the same bytes as the commands.
same_bytes() {
    "$B/pinhole-depth" pairs --near .1 --far 1000 --count 500 --csv - --format fixed16 | tail -n 1 | grep -qxFf - "$dir/uart" &&
        "$B/pinhole-depth" resolve --near 1 --far 4 --csv - --format float16,log | tail -n +2 >"$dir/host" && [ "$(grep -cxFf "$dir/host" "$dir/uart")" = "$(wc -l <"$dir/host")" ]
}

a_changed_digit_is_told() {
    local got=0
    sed '0,/^fixed16,16,0.1,1000,linear,500,/s//fixed16,16,0.1,1000,linear,500,1/' "$dir/uart" >"$dir/changed"
    "$B/pinhole-depth" compare "$dir/changed" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 1 ] && [ ! -s "$dir/stdout" ] && grep -q 'line 3 of the answer differs' "$dir/stderr"
}

a_log_cut_off_is_told() {
    head -n 12 "$dir/uart" >"$dir/changed"
    ! "$B/pinhole-depth" compare "$dir/changed" 2>"$dir/stderr" && [ "$(wc -l <"$dir/stderr")" = 1 ] &&
        ! echo nothing | "$B/pinhole-depth" compare - 2>"$dir/stderr" && grep -q 'has no answer' "$dir/stderr"
}

if ! command -v arm-none-eabi-gcc >/dev/null; then
    skip "the image of the depth lab builds" "no arm-none-eabi-gcc"
elif ! command -v qemu-system-arm >/dev/null; then
    skip "a Cortex-M3 measures what the host measures, byte for byte" "no qemu-system-arm"
else
    check "the image of the depth lab builds" builds
    check "the image has neither floating point nor a heap" has_no_floating_point
    check "the image runs to its end on a Cortex-M3" runs
    check "the image asks for near, far and format, and refuses what is none" asks_and_refuses
    check "a Cortex-M3 measures what the host measures, byte for byte" compares
    check "... and what the commands print" same_bytes
    check "compare tells a changed digit" a_changed_digit_is_told
    check "compare tells a log that was cut off" a_log_cut_off_is_told
fi
tap_end
