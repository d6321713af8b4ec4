#!/usr/bin/env bash
# The same scene gives the same bytes on every target: the frames of tests/tools/frames.sh, compiled by gcc and clang at several
# levels of optimisation, for 32 and 64 bits, little and big endian, with each CPU's own files, in bands of any height. A few
# of them run here, the others in long_targets.sh.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/tools/frames.sh
unset MAKEFLAGS
built_in=${B:-build}
simulator=$built_in/pinhole-sim
B=$built_in/targets
golden=tests/golden/frames.txt
mkdir -p "$B"

same() { # file
    diff "$golden" "$1" >"$1.diff" || { echo "$(grep -c '^>' "$1.diff") frames differ, the first:" && head -n 4 "$1.diff" && return 1; }
}

target() { # name, runner or "", CC, CFLAGS, [make variable...]
    local name=$1 runner=$2
    frames_program "$B/$name" CC="$3" CFLAGS="$4" "${@:5}" || return 1
    # shellcheck disable=SC2086 # no runner is no word
    frames $runner "$B/$name/pinhole-sim" >"$B/$name.frames" && same "$B/$name.frames"
}

bands() { # lines
    frames "$simulator" --band "$1" >"$B/band-$1.frames" && same "$B/band-$1.frames"
}

# On a bare microcontroller core in bands of 16 lines: every demo at 320x240 (tests/bench/frames.c).
bare() { # core of tests/bench/run.sh
    B=$B PROGRAM=frames tests/bench/run.sh "$1" >"$B/$1.lines" || return 1
    awk '$4 == "frame" { $7 = sprintf("%08X", $7); print }' "$B/$1.lines" >"$B/$1.frames"
    diff <(grep ' auto frame 1[12] ' "$golden" | grep ' 320x240 ') "$B/$1.frames"
}

differs() { # a build that draws differently is seen
    sed '3s/.$/x/' "$golden" >"$B/wrong.frames"
    ! same "$B/wrong.frames"
}

if_there() { # tools, reason, short|long, check's arguments
    local tool
    for tool in $1; do
        command -v "$tool" >/dev/null || { skip "$4" "$2" && return; }
    done
    "${@:3}"
}

m32() { printf 'int main(void){return 0;}' | gcc -m32 -x c - -o "$B/m32.probe" 2>/dev/null; }

user() { # Debian's name of the target, QEMU's
    if command -v "qemu-$2" >/dev/null; then
        if_there "$1-gcc" "no compiler for it" long "same_frames_on_$2" target "$2" "qemu-$2" "$1-gcc" -O2 LDFLAGS=-static
    else
        skip "same_frames_on_$2" "no qemu-user"
    fi
}

# The simulator that all tests use; usually gcc's at -O2.
as_built() { make -s -j2 B="$built_in" "$simulator" && frames "$simulator" >"$B/built.frames" && same "$B/built.frames"; }

short "a_frame_that_differs_is_seen" differs
short "same_frames_as_it_is_built" as_built
for lines in 1 7 16 1024; do
    long "same_frames_in_bands_of_$lines" bands $lines
done
long "same_frames_with_the_portable_files" target portable "" gcc -O2 CPU=portable
if_there clang "no clang" long "same_frames_with_clang_O3" target clang-O3 "" clang -O3
if m32; then
    runner=$("$B/m32.probe" 2>/dev/null || echo qemu-i386) # not every kernel runs programs of 32 bits
    long "same_frames_on_32_bit_x86" target m32 "$runner" "gcc -m32" "-O2 -idirafter /usr/include/x86_64-linux-gnu"
else
    skip "same_frames_on_32_bit_x86" "no gcc-12-multilib"
fi
user s390x-linux-gnu s390x
if_there qemu-system-arm "no qemu-system-arm" long "same_frames_on_Cortex-M33" bare m33
for level in O0 O2 O3; do
    long "same_frames_with_gcc_$level" target gcc-$level "" gcc -$level
done
for cpu in armv6m armv7m rv32; do
    long "same_frames_with_the_files_for_$cpu" target $cpu-files "" gcc -O2 CPU=$cpu
done
for level in O0 O2; do
    if_there clang "no clang" long "same_frames_with_clang_$level" target clang-$level "" clang -$level
done
user aarch64-linux-gnu aarch64
user arm-linux-gnueabihf arm
if_there qemu-system-riscv32 "no qemu-system-misc" long "same_frames_on_RV32IMAC_with_Zba_Zbb_Zbkb" bare rv32
if_there qemu-system-riscv32 "no qemu-system-misc" long "same_frames_on_RV32IMC" bare rv32plain
if_there "qemu-system-xtensa xtensa-lx106-elf-gcc" "no qemu-system-misc or gcc-xtensa-lx106" long "same_frames_on_Xtensa_lx106" bare lx106
tap_end
