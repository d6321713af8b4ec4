#!/usr/bin/env bash
# Usage: VERSION=x firmware/package/dist.sh      `make dist` calls it
# Writes, of git's HEAD, into $B/dist:
#   pinhole-x.tar.gz            the whole tree; `make check` passes where it is unpacked
#   Pinhole-x-arduino.zip       the renderer as a library for Arduino and PlatformIO
#   pinhole-x-esp-idf.zip       the renderer as a component of ESP-IDF
# With PROFILE=small only
#   Pinhole-x-small-arduino.zip the renderer for chips of 32 KB of flash, for Arduino and PlatformIO
# Environment: B (build directory), PROFILE (whole or small), URL (the public address that manifests name).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
: "${VERSION:?}"
dist=$(realpath -m "$B/dist")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for tool in git zip; do
    command -v $tool >/dev/null || { echo "make dist: no $tool: apt-get install $tool" >&2 && exit 1; }
done
git rev-parse --verify -q HEAD >/dev/null || { echo "make dist: this is no git repository; it packs what git has" >&2 && exit 1; }
mkdir -p "$dist" "$work/tree"
git archive HEAD firmware LICENSE | tar -x -C "$work/tree"
core=$work/tree/firmware/core
here=$work/tree/firmware/package

# Fills a template. Without a public address (URL) the manifests name none, and a registry would refuse them.
fill() { sed "s|@VERSION@|$VERSION|g; s|@URL@|${URL-}|g" "$1" | if [ -n "${URL-}" ]; then cat; else sed '/^url: ""$/d; /"homepage": ""/d'; fi; }

# ---- ESP-IDF: the sources as they are, and the public headers once more as <pinhole/...> -----------------------------

esp_idf() {
    local to=$work/esp/pinhole
    mkdir -p "$to/include/pinhole" "$to/examples"
    cp -r "$core" "$work/tree/LICENSE" "$to"
    cp "$here"/examples/{esp_lcd.c,lvgl.c,ph_lvgl.c,ph_lvgl.h,triangle.h} "$to/examples"
    cp "$core"/*.h "$core"/fx/*.hpp "$core/kernels/portable/fx_cpu.h" "$to/include/pinhole"
    fill "$here/idf_component.yml.in" >"$to/idf_component.yml"
    cp "$here/esp_idf.cmake" "$to/CMakeLists.txt"
    (cd "$work/esp" && zip -qr -X "$1" pinhole)
}

# ---- Arduino: it compiles all that it finds below src/, with src/ as its only folder of headers ----------------------
# So all sources lie in one folder, where they find each other. A kernel that a CPU has of its own becomes one file that
# takes the CPU's text (.inc, which is not compiled).

guard_of() { # folder of core/kernels
    case $1 in
    armv6m) echo 'defined(__ARM_ARCH_6M__) || defined(__ARM_ARCH_8M_BASE__)' ;;
    armv7m) echo 'defined(__ARM_ARCH_7M__) || defined(__ARM_ARCH_7EM__) || defined(__ARM_ARCH_8M_MAIN__)' ;;
    rv32) echo 'defined(__riscv_mul) && defined(__riscv_compressed) && __riscv_xlen == 32' ;;
    esac
}

flat() { sed -E 's|#include "\.\./(armv[67]m)/([a-z_]+\.S)"|#include "\1_\2.inc"|; s|#include "(\.\./)+|#include "|; s|#include <(matvec.h)>|#include "\1"|' "$1"; } # file

# The text of one folder of core/kernels, if it is there, as a file that is not compiled; prints the line that takes it.
take() { # folder, name, folder that it goes to
    local of=$core/kernels/$1/$2
    [ ! -e "$of" ] || { flat "$of" >"$3/$1_$2.inc" && echo "#include \"$1_$2.inc\""; }
}

# Prints a file NAME that takes the text of the CPU that it is compiled for; where the CPU has none it takes the portable one,
# but not beside the CPU's assembly.
choose() { # name, folder that its texts go to
    local cpu word='#if'
    for cpu in armv6m armv7m rv32; do
        echo "$word $(guard_of $cpu)"
        word='#elif'
        if [ -e "$core/kernels/$cpu/$1" ]; then
            take $cpu "$1" "$2"
        elif [ ! -e "$core/kernels/$cpu/${1%.*}.S" ]; then
            take portable "$1" "$2"
        fi
    done
    echo '#else'
    take portable "$1" "$2"
    echo '#endif'
}

arduino() {
    local to=$work/arduino/Pinhole src name
    src=$to/src/pinhole
    mkdir -p "$src"
    cp "$core"/{fx,geom,render,effects}/*.[ch] "$core"/fx/*.hpp "$core"/*.h "$core"/kernels/*.inc "$src"
    for name in "$core"/kernels/*.h; do flat "$name" >"$src/${name##*/}"; done
    for name in $(find "$core"/kernels/{portable,armv6m,armv7m,rv32} -type f -printf '%f\n' | sort -u); do
        if [ "$(find "$core"/kernels/{portable,armv6m,armv7m,rv32} -name "$name" | wc -l)" = 1 ] && [[ $name == *.inc || $name == *_portable.h ]]; then
            flat "$core"/kernels/*/"$name" >"$src/$name" # what the texts of one folder share
        else
            choose "$name" "$src" >"$work/text" && mv "$work/text" "$src/$name"
        fi
    done
    library "$to"
    for name in Hello LovyanGFX Arduino_GFX; do
        mkdir -p "$to/examples/$name" && cp "$here"/examples/{$name.ino,triangle.h} "$to/examples/$name"
    done
    (cd "$work/arduino" && zip -qr -X "$1" Pinhole)
}

library() { # folder: what is around the sources
    local name
    printf '/* Pinhole %s: all public headers. */\n' "$VERSION" >"$1/src/Pinhole.h"
    for name in "$core"/*.h; do
        [ ! -e "$1/src/pinhole/${name##*/}" ] || echo "#include \"pinhole/${name##*/}\"" >>"$1/src/Pinhole.h"
    done
    fill "$here/library.properties.in" >"$1/library.properties"
    fill "$here/library.json.in" >"$1/library.json"
    cp "$work/tree/LICENSE" "$1"
}

# The small profile takes files of render/ and of the portable kernels as texts.
arduino_small() {
    local to=$work/arduino/Pinhole src name
    src=$to/src/pinhole
    mkdir -p "$src"
    cp "$core"/{fx,geom}/*.[ch] "$core"/{render,kernels,kernels/portable}/*.h "$core"/*.h "$src"
    rm "$src"/{blur,overlay,shadow}.h
    for name in "$core"/render/small/*.[ch]; do
        sed -E 's|#include "(\.\./)+(kernels/portable/)?([a-z_]+)\.c"|#include "\3.inc"|' "$name" >"$src/${name##*/}"
    done
    sed -nE 's|#include "\.\./(.*)\.c"|\1|p' "$core"/render/small/*.c | while read -r name; do
        cp "$core/render/$name.c" "$src/${name##*/}.inc"
    done
    sed -i '/^#define PH_SCENE_H/a #define PH_PROFILE_SMALL' "$src/scene.h"
    sed -i -E 's|#include "(\.\./)+|#include "|; s|#include <(matvec.h)>|#include "\1"|' "$src"/*
    library "$to"
    sed -i 's/^name=Pinhole/&-small/' "$to/library.properties"
    sed -i 's/"name": "Pinhole/&-small/' "$to/library.json"
    (cd "$work/arduino" && zip -qr -X "$1" Pinhole)
}

rm -f "$dist"/*
if [ "${PROFILE:-whole}" = small ]; then
    arduino_small "$dist/Pinhole-$VERSION-small-arduino.zip"
else
    git archive --format=tar.gz --prefix="pinhole-$VERSION/" -o "$dist/pinhole-$VERSION.tar.gz" HEAD
    esp_idf "$dist/pinhole-$VERSION-esp-idf.zip"
    arduino "$dist/Pinhole-$VERSION-arduino.zip"
fi
find "$dist" -type f -printf "$B/dist/%f\n" | sort
