#!/usr/bin/env bash
# Usage: tests/tools/lint.sh
# Reads every source with every tool that is here; exits 1 when one of them finds something. `make lint` calls it.
# Environment: B (build directory), INCLUDE (the compiler's -I flags).
set -u
cd "$(dirname "$0")/../.." || exit 1
export B=${B:-build} MAKEFLAGS=
processors=$(nproc)
read -ra include <<<"${INCLUDE:--Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/app -Ihal -Iboards -I$B/boards_all -Ihost-sim -Itests}"
folders=(firmware hal boards host-sim tests)
failed=0

sources() { find "${folders[@]}" -type f "$@" | sort; }

# The tool's findings, or a line that says it had none.
tool() { # name, command...
    local name=$1 start=$SECONDS output word=clean
    command -v "$name" >/dev/null || { echo "$name: not here, skipped" && return; }
    output=$("${@:2}" 2>&1) || { word=FINDINGS && failed=1; }
    [ $word = clean ] || printf '%s\n' "$output"
    echo "$name: $word ($((SECONDS - start)) s)"
}

format() { sources -name '*.[ch]' | xargs -r clang-format --dry-run -Werror; }

warnings() { # compiler
    make -k -s -j"$processors" B="$B/lint-$1" CC="$1" CFLAGS='-O2 -Werror' all test-programs long-programs
}

# The backend for the other version of libgpiod, which is not installed here.
other_gpiod="hal/linux/gpiod$(if pkg-config --exists 'libgpiod >= 2'; then echo 1; else echo 2; fi)/*"

# The virtual board's module needs the kernel's headers and flags; tests/guest/virtual_board.sh builds them with warnings as errors.
kernel='tests/guest/board/*'
# What no include path of this computer leads to: registers of RISC-V, structs as ARMv6-M has them, a mesh that a program
# writes, installed headers.
elsewhere=("tests/core/kernels/riscv/*" hal/rp2350/riscv/trap.c firmware/core/kernels/armv6m/offsets.c
    tests/bench/walker_host.c "firmware/package/examples/*")
# The harnesses are read by CBMC: they take in sources of the core.
proofs='tests/proof/*'

# A file that was clean is read again when it, a header or the rules have changed.
tidy_one() { # file, include paths
    local file=$1 stamp=$B/tidy/${1//\//-}
    [[ $stamp -nt $file && $stamp -nt $newest ]] || { clang-tidy --quiet "$file" -- -std=c11 -I"${file%/*}" "${@:2}" 2>/dev/null && touch "$stamp"; }
}

tidy() {
    mkdir -p "$B/tidy"
    newest=$(find "${folders[@]}" .clang-tidy \( -name '*.h' -o -name .clang-tidy \) -printf '%T@ %p\n' | sort -n | tail -n 1 | cut -d' ' -f2)
    export newest
    export -f tidy_one
    local name not=()
    for name in "$other_gpiod" "$kernel" "$proofs" "${elsewhere[@]}"; do not+=(-not -path "$name"); done
    sources -name '*.c' "${not[@]}" | xargs -r -P "$processors" -I{} bash -c 'tidy_one "$@"' - {} "${include[@]}"
}

check() {
    mkdir -p "$B/cppcheck"
    cppcheck -q -j"$processors" --cppcheck-build-dir="$B/cppcheck" --std=c11 --error-exitcode=1 --inline-suppr \
        --enable=warning,style,performance,portability --suppressions-list=tests/tools/cppcheck.suppress -U__ASSEMBLER__ \
        --template='{file}:{line}: {id}: {message}' -itests/proof "${include[@]}" "${folders[@]}"
}

shell() { { sources -name '*.sh' && echo .ci/run; } | xargs -r shellcheck -x; }

tests/tools/packages.sh lint || exit
mkdir -p "$B"
tool clang-format format
tool shellcheck shell
tool cppcheck check
tool gcc warnings gcc
tool clang warnings clang
tool clang-tidy tidy
[ $failed = 0 ] || { echo "lint: findings above" >&2 && exit 1; }
