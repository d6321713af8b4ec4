#!/usr/bin/env bash
# memcpy and memset for ARMv6-M (firmware/bare/armv6m/memory.S) under qemu-arm: every size to 100 bytes from and to every place.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
cross=arm-linux-gnueabihf-gcc
for tool in $cross qemu-arm; do
    command -v "$tool" >/dev/null || { echo "no $tool: apt-get install gcc-arm-linux-gnueabihf qemu-user" && exit 77; }
done
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
cat >"$dir/try.c" <<'END'
#include <stdint.h>
#include <stdio.h>
void *try_memcpy(void *to, const void *from, unsigned n);
void *try_memset(void *to, int value, unsigned n);
enum { SIZE = 128 };
static _Alignas(8) uint8_t from[SIZE], to[SIZE];

static int differs(unsigned a, unsigned b, unsigned n, int copies)
{
    for (unsigned i = 0; i < SIZE; i++) {
        from[i] = (uint8_t)(37 * i + 11 * n);
        to[i] = (uint8_t)~i;
    }
    void *const got = copies ? try_memcpy(to + a, from + b, n) : try_memset(to + a, 0xF00 + (int)(b + n), n);
    int wrong = got != to + a;
    for (unsigned i = 0; i < SIZE; i++) {
        const uint8_t inside = (uint8_t)(copies ? 37 * (i - a + b) + 11 * n : b + n);
        wrong |= to[i] != (i >= a && i < a + n ? inside : (uint8_t)~i);
        wrong |= from[i] != (uint8_t)(37 * i + 11 * n);
    }
    return wrong;
}

int main(void)
{
    int wrong = 0;
    for (unsigned i = 0; i < 2 * 4 * 4 * 101; i++) {
        wrong += differs(i & 3, i >> 2 & 3, (i >> 4) % 101, i < 4 * 4 * 101);
    }
    printf("%d wrong\n", wrong);
    return wrong != 0;
}
END

tried() { # memory.S
    $cross -mcpu=cortex-a15 -mthumb -O1 -static -Wl,-z,noexecstack -Dmemcpy=try_memcpy -Dmemset=try_memset "$1" "$dir/try.c" -o "$dir/try" && qemu-arm "$dir/try"
}

change_is_seen() { # sed command
    sed "$1" firmware/bare/armv6m/memory.S >"$dir/changed.S"
    ! cmp -s firmware/bare/armv6m/memory.S "$dir/changed.S" && ! tried "$dir/changed.S"
}

check "every byte is written, and no other" tried firmware/bare/armv6m/memory.S
check "a word too few is seen" change_is_seen 's/bpl 4f/b 4f/'
check "a byte too many is seen" change_is_seen 's/lsrs r2, r2, #30/lsrs r2, r2, #29/'
check "a lost place is seen" change_is_seen '0,/mov r0, r12/s//nop/'
tap_end
