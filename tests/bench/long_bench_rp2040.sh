#!/usr/bin/env bash
# As tests/bench/long_bench.sh, for the emulated RP2040, the two cores of an RP2350 and Xtensa's lx106: no scene takes over 2 % more cycles, and no image over 2 % more code
# or RAM, than tests/golden/bench.csv says. After a change for the better: see there.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
for tool in "arm-none-eabi-gcc gcc-arm-none-eabi" "node nodejs" "npm npm"; do
    command -v "${tool% *}" >/dev/null || { echo "no ${tool% *}: apt-get install ${tool#* }" && exit 77; }
done
golden=tests/golden/bench.csv
grep -q '^rp2040,.*,mcycles_1core,' "$golden" || { echo "$golden has no cycles of an RP2040 yet" && exit 77; }

nothing_is_worse() { # numbers that there must be, their unit or "", core...
    FORMATS='kit fixed16' tests/bench/bench.sh "${@:3}" >/dev/null || return 1
    awk -F, -v cores=" ${*:3} " -v metric="$2" -v least="$1" 'NR == FNR { value[$1 "," $2 "," $3] = $4; next }
        index(cores, " " $1 " ") && index($3, metric) == 1 && ($1 "," $2 "," $3) in value {
            seen++
            if ($4 > 1.02 * value[$1 "," $2 "," $3]) { print $1 "," $2 "," $3 ": " $4 ", was " value[$1 "," $2 "," $3]; bad = 1 }
        }
        END { if (seen < least) { print "only " seen + 0 " numbers to compare"; bad = 1 } exit bad }' "$golden" "$B/bench.csv"
}

check "nothing_is_more_than_2_percent_worse_on_an_RP2040" nothing_is_worse 22 "" rp2040
if command -v riscv64-unknown-elf-gcc >/dev/null && command -v qemu-system-riscv32 >/dev/null && command -v qemu-system-arm >/dev/null; then
    check "nothing_is_more_than_2_percent_worse_on_Cortex-M33_and_RV32" nothing_is_worse 32 minstr m33 rv32
else
    skip "nothing_is_more_than_2_percent_worse_on_Cortex-M33_and_RV32" "no qemu-system-arm, qemu-system-misc or gcc-riscv64-unknown-elf"
fi
if command -v xtensa-lx106-elf-gcc >/dev/null && command -v qemu-system-xtensa >/dev/null; then
    check "nothing_is_more_than_2_percent_worse_on_Xtensa_lx106" nothing_is_worse 16 minstr lx106
else
    skip "nothing_is_more_than_2_percent_worse_on_Xtensa_lx106" "no gcc-xtensa-lx106 or qemu-system-misc"
fi
tap_end
