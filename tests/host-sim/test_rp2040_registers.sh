#!/usr/bin/env bash
# rp2040-registers, to which rp2040js tells its accesses: it takes the writes of the boot stage in the right order, refuses the
# first that silicon would not take, with core, address of the code and the rule, and forgets all when the chip starts again.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
make -s B="$B" "$B/rp2040-registers" >"$dir/made" 2>&1 || { cat "$dir/made" && exit 1; }

word() { # 32 bits, the lowest byte first
    local n
    for n in 0 8 16 24; do printf '%b' "\\x$(printf %02x $(($1 >> n & 255)))"; done
}

# Records of 24 bytes: the time as a double (0), address, value, program counter, what: bit 0 a write, 1 core 1, 2 a restart, from 4
# on how many bytes.
accesses() { # lines on stdin: write|read|core1|restart ADDRESS VALUE
    local what address value
    declare -A bits=([write]=0x41 [read]=0x40 [core1]=0x43 [restart]=4)
    while read -r what address value; do
        word 0 && word 0 && word "$address" && word "$value" && word 0x20041f0c && word "${bits[$what]}"
    done
}

takes() { accesses >"$dir/in" && "$B/rp2040-registers" <"$dir/in"; }

refuses() { # line
    accesses >"$dir/in"
    ! "$B/rp2040-registers" <"$dir/in" 2>"$dir/said" && [ "$(wc -l <"$dir/said")" = 1 ] && grep -qF -- "$1" "$dir/said" || { cat "$dir/said" && return 1; }
}

off='write 0x18000008 0'
set_up='write 0x18000014 2
write 0x180000f0 1'
check "the_boot_stage_sets_up_the_SSI_while_it_is_off" takes <<<"$off
$set_up
write 0x18000008 1"
check "a_sample_delay_that_is_written_while_the_SSI_is_on_is_refused" \
    refuses 'at 0.000 ms: core 0 at 20041f0c: SSI RX_SAMPLE_DLY (180000f0) = 00000001: the SSI is on (SSIENR) and ignores it' <<<"$off
write 0x18000014 2
write 0x18000008 1
write 0x180000f0 1"
check "so_it_is_after_the_chip_starts_again" refuses 'BAUDR (18000014)' <<<"$off
restart 0 0
$set_up"
check "each_core_has_its_own_FIFO" refuses 'core 1 at 20041f0c: SIO FIFO_WR (d0000054) = 00000002: the FIFO may be full' <<<'core1 0xd0000054 1
core1 0xd0000054 2'
check "a_register_that_no_table_has_is_refused" refuses 'SSI ? (18000010) reads 00000001' <<<'read 0x18000010 1'
tap_end
