#!/usr/bin/env bash
# Usage: tests/bench/run.sh m0plus|m3|m4f|m33|rv32|rv32plain|lx106|x86_64 [SCENE|all [FORMAT|all]]
#        PROGRAM=growth tests/bench/run.sh CORE      how the cost grows (growth.c); cliffs: the rare against the usual
# Builds the benchmark for that core and runs it: one line a stage and frame, `SCENE FORMAT STAGE FRAME COUNT` (bench.c).
# Exits 1 when the counter is wrong (a loop of 1,000,000 x 2 instructions must read 2,000,000). Environment: B.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build} program=${PROGRAM:-bench} core=${1-} scene=${2:-all} format=${3:-all}
dir=$B/bench-$core
mps2='code_origin=0 data_origin=0x21000000 timer_base=0x40000000 uart_base=0x40004000 instructions_a_tick=40'
an505='code_origin=0x10000000 data_origin=0x80000000 timer_base=0x50000000 uart_base=0x50200000 instructions_a_tick=50'
virt='code_origin=0x80000000 data_origin=0x80400000'
lx60='code_origin=0x60000000 data_origin=0x60400000'
case "$core" in
m0plus) machine='arm -M mps2-an385' cpu=armv6m flags='-mcpu=cortex-m0plus -mthumb' places=$mps2 ;;
m3) machine='arm -M mps2-an385' cpu=armv7m flags='-mcpu=cortex-m3 -mthumb' places=$mps2 ;;
m4f) machine='arm -M mps2-an386' cpu=armv7m flags='-mcpu=cortex-m4 -mthumb -mfloat-abi=soft' places=$mps2 ;;
m33) machine='arm -M mps2-an505' cpu=armv7m flags='-mcpu=cortex-m33 -mthumb -mfloat-abi=soft' places=$an505 ;;
rv32) machine='riscv32 -M virt -cpu rv32,zba=true,zbb=true,zbkb=true' cpu=rv32 flags='-march=rv32imac_zicsr_zba_zbb_zbkb -mabi=ilp32' places=$virt ;;
rv32plain) machine='riscv32 -M virt' cpu=rv32 flags='-march=rv32imc_zicsr -mabi=ilp32' places=$virt ;;
lx106) machine='xtensa -M lx60-nommu -cpu lx106' cpu=portable flags='-mlongcalls -mtext-section-literals' places=$lx60 ;;
x86_64) machine='' cpu=x86_64 flags='' ;;
*) sed -n '2,3s/^# //p' "$0" >&2 && exit 2 ;;
esac
case "$core" in
rv32*) cc=riscv64-unknown-elf-gcc own='-isystem firmware/bare/include' library="-nostdlib tests/bench/machine_riscv.c tests/bench/machine_semihost.c firmware/bare/memory.c $(riscv64-unknown-elf-gcc -march=rv32imac -mabi=ilp32 -print-libgcc-file-name)" options='-bios none' ;;
lx106) cc=xtensa-lx106-elf-gcc own='-isystem firmware/bare/include' library='-nostdlib tests/bench/machine_xtensa.c tests/bench/machine_xtensa_rom.c firmware/bare/memory.c -lgcc' options='' ;;
*) cc=arm-none-eabi-gcc own='' library='tests/bench/machine_arm.c tests/bench/machine_semihost.c -lc -lgcc' options='' ;;
esac
unset MAKEFLAGS
mkdir -p "$dir"
include="-Ifirmware/core/kernels/$cpu -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ifirmware/app/demos -Itests/bench"
wrap='' sources=tests/bench/$program.c
[ "$program" != bench ] || wrap='-Wl,--wrap=ph_draw_mesh' sources="$sources tests/bench/textured_torus.c"

objects() { # compiler, flags: builds them and prints their names
    make -s -j"$(nproc)" B="$dir" CC="$1" CPU="$cpu" KIT=1 CHECKED= CFLAGS="$2" firmware-objects >&2 || return 1
    find "$dir/firmware/core" "$dir/firmware/app" -name '*.o' ! -name 'runner.o' ! -name 'memory_plan.o' ! -name 'self_test.o' ! -path '*/depthlab/*' | sort
}

bare() {
    local made
    made=$(objects $cc "$flags $own -O2 -ffreestanding -ffunction-sections -fdata-sections") || exit 1
    mapfile -t list <<<"$made"
    # shellcheck disable=SC2086,SC2046 # words
    $cc $flags $own -std=c11 -O2 -ffreestanding -fno-builtin $include $wrap -nostartfiles -Wl,--gc-sections $(printf -- '-Wl,--defsym=%s ' $places) -T tests/bench/bench.ld \
        $sources tests/bench/machine_bare.c "${list[@]}" $library -o "$dir/$program.elf"
    # shellcheck disable=SC2086 # words
    timeout 3000 qemu-system-$machine $options -icount shift=0 -display none -monitor none -serial stdio \
        -semihosting-config "enable=on,target=native,arg=bench,arg=$scene,arg=$format" -kernel "$dir/$program.elf" </dev/null
}

host() {
    local made
    made=$(objects "${CC:-gcc}" -O2) || exit 1
    mapfile -t list <<<"$made"
    # shellcheck disable=SC2086 # words
    ${CC:-gcc} -std=c11 -O2 $include $wrap $sources tests/bench/machine_host.c "${list[@]}" -o "$dir/$program"
    rm -f "$dir"/counts.*
    valgrind -q --tool=callgrind --callgrind-out-file="$dir/counts" "$dir/$program" "$scene" "$format" >"$dir/said"
    awk -v dumps="$dir/counts." '
        $5 == "counted" {
            file = dumps (++n)
            while ((getline line <file) > 0) { if (line ~ /^summary:/) { split(line, word, " "); $5 = word[2] } }
            close(file)
        }
        { print }' "$dir/said"
}

if [ -n "$machine" ]; then bare; else host; fi >"$dir/lines" || { cat "$dir/lines" && exit 1; }
awk '$1 == "known-loop" { seen = 1; wrong = $5 < 2000000 || $5 > 2000080 } END { exit wrong || !seen }' "$dir/lines" ||
    { echo "bench: the counter is wrong: $(grep known-loop "$dir/lines")" >&2 && exit 1; }
cat "$dir/lines"
