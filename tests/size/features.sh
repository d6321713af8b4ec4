#!/usr/bin/env bash
# Usage: tests/size/features.sh [--table | CORE...]       m0plus m3 m33 rv32, all by default
# Weighs each row of features.csv for each core: a program of features.c, whose macros name some features. Prints the rows anew,
# with the bytes on each core. --table prints what each feature adds to the program that it is over, for firmware/README.md,
# from the bytes that features.csv has.
# Environment: B (build directory).
set -eu
cd "$(dirname "$0")/../.."
if [ "${1:-}" = --table ]; then
    awk -F, '
        NR == 1 { print "| feature | over | Cortex-M0+ | Cortex-M3 | Cortex-M33 | RV32 |\n|---|---|---|---|---|---|"; next }
        { for (i = 4; i <= 7; i++) { bytes[$1, i] = $i } }
        $2 != "" { printf "| %s | %s |", $1, $2; for (i = 4; i <= 7; i++) { printf " %+d |", $i - bytes[$2, i] } print "" }
    ' tests/size/features.csv
    exit
fi
[ $# -gt 0 ] || set -- m0plus m3 m33 rv32
header=name,over,macros
for core; do header=$header,$core; done
echo "$header"
while IFS=, read -r name over macros _; do
    [ "$name" != name ] || continue
    row=$name,$over,$macros
    for core; do
        # shellcheck disable=SC2086 # a word each
        row=$row,$(CORE=$core tests/tools/program_size.sh $macros tests/size/features.c | awk '$1 == "all" { print $2 }')
    done
    echo "$row"
done <tests/size/features.csv
