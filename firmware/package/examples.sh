#!/usr/bin/env bash
# Usage: firmware/package/examples.sh [readme | run NAME FILE.ppm COMPILER [FLAG...]]      `make examples` calls it
# Builds the programs of firmware/package/examples that draw into a file, and writes there their pictures and README.md, and
# tests/golden/examples.txt: look at the pictures before you commit it.
#   readme  only prints README.md
#   run     builds one (or a source elsewhere) with that compiler and $B/libpinhole.a, and writes its picture
# Environment: B (build directory), CC, CXX.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
here=firmware/package/examples

# Those that are for a computer: a C program has a main() of example.h.
programs() { grep -lE 'example_save|example_run|stdout' $here/*.c $here/*.cpp | sed 's|.*/||' | sort; }

# The first comment of a source as one line, without its name.
about() { sed -n '1,/\*\/$\|^#/p' "$1" | grep -E '^(/\*|//| \* )' | sed -E 's|^(/\*\|//\| \*) ?||; s| ?\*/$||' | paste -sd' '; }

readme() {
    cat <<'MD'
# Examples

Each is a program of its own; `make examples` built all of them, ran them and wrote the pictures and this page. On a computer:

    make install-dev PREFIX=$HOME/.local
    cd firmware/package/examples
    cc triangle.c $(PKG_CONFIG_PATH=$HOME/.local/lib/pkgconfig pkg-config --cflags --libs pinhole) -o triangle && ./triangle >triangle.ppm

[example.h](example.h) has what all share: the memory, the camera, the picture as a file. [shapes.h](shapes.h) has the meshes.

MD
    echo '| picture | program | what it shows |'
    echo '|---|---|---|'
    for program in $(programs); do
        echo "| ![${program%.*}](pictures/${program%.*}.png) | [$program]($program) | $(about "$here/$program") |"
    done
    printf '\nThe same triangle ([triangle.h](triangle.h)) on displays:\n\n| program | what it is for |\n|---|---|\n'
    for program in $(cd $here && grep -lE 'triangle_(init|draw)|ph_lvgl' -- *.c *.cpp *.ino */* 2>/dev/null | sort); do
        grep -qx "$program" <(programs) || echo "| [$program]($program) | $(about "$here/$program") |"
    done
}

run() { # program, picture, compiler, flag...
    local source=$here/$1 picture=$2
    [ "${1#*/}" = "$1" ] || source=$1
    shift 2
    local flags='-std=c11'
    [ "${source%.cpp}" = "$source" ] || flags='-std=c++11'
    mkdir -p "$B/examples/include/pinhole"
    { flock 9 && cp -u firmware/core/*.h firmware/core/fx/*.hpp firmware/core/kernels/portable/fx_cpu.h "$B/examples/include/pinhole"; } 9>"$B/examples/lock" # several may run
    "$@" $flags -Wall -Werror -I"$B/examples/include" -I$here "$source" "$B/libpinhole.a" -pthread -o "$picture.program"
    "$picture.program" >"$picture"
}

compiler_of() { [ "${1%.cpp}" = "$1" ] && echo "${2:-cc}" || echo "${3:-c++}"; } # program, C, C++

case ${1-all} in
readme) readme ;;
run) shift && run "$@" ;;
all)
    mkdir -p $here/pictures
    : >"$B/examples.txt"
    for program in $(programs); do
        name=${program%.*}
        run "$program" "$B/$name.ppm" "$(compiler_of "$program" "${CC:-cc}" "${CXX:-c++}")" -O2 2>/dev/null
        "$B/pinhole-sheet" --out "$here/pictures/$name.png" --gap 0 --width 1 "$B/$name.ppm"
        echo "$program $(cksum <"$B/$name.ppm" | cut -d' ' -f1)" >>"$B/examples.txt"
        rm -f "$B/$name.ppm" "$B/$name.ppm.program"
    done
    mv "$B/examples.txt" tests/golden/examples.txt
    readme >$here/README.md
    echo "$here/README.md: $(wc -l <tests/golden/examples.txt) pictures"
    ;;
esac
