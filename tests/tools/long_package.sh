#!/usr/bin/env bash
# Each way into another project, from an empty folder: pkg-config, CMake for this machine and for others, Arduino, ESP-IDF,
# SDL2, and the programs as they are installed. The program is the README's.
# shellcheck disable=SC2317,SC2016,SC2046,SC2015 # functions are called by check; pkg-config gives several words; || prints the log
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
tree=$PWD
B=$(realpath -m "${B:-build}")
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
stage=$dir/stage
export PKG_CONFIG_PATH=$stage/lib/pkgconfig
version=$(sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)

run() { make -s -j2 B="$B/package" ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb "$@"; }

installs() { run install PREFIX="$stage"; }

hello() { # the README's program and what it prints
    sed -n '/^```c$/,/^```$/p' README.md | sed '1d;/^```$/,$d' >"$dir/hello.c"
    sed -n '/^```text$/,/^```$/p' README.md | sed '1d;/^```$/,$d' >"$dir/expected"
    [ "$(wc -l <"$dir/expected")" = 20 ] && grep -q '<pinhole/render.h>' "$dir/hello.c"
}

empty_folder() { # name
    rm -rf "${dir:?}/$1" && mkdir "$dir/$1" && cd "$dir/$1" || return 1
}

pkg_config_draws() {
    empty_folder pkg && cp ../hello.c . && [ "$(pkg-config --modversion pinhole)" = "$version" ] &&
        cc -Wall -Wextra -Werror hello.c $(pkg-config --cflags --libs pinhole) -o hello && ./hello | diff - ../expected
}

# A CMake project of one program. The toolchain file is empty for this machine.
cmake_project() { # name, C file
    empty_folder "$1" && cp "$2" hello.c || return 1
    printf '%s\n' 'cmake_minimum_required(VERSION 3.13)' 'project(hello C)' "find_package(Pinhole ${version%.*} REQUIRED)" \
        'add_executable(hello hello.c)' 'target_link_libraries(hello PRIVATE Pinhole::pinhole)' >CMakeLists.txt
}

cmake_builds() { # more arguments of cmake
    cmake -S . -B b -DCMAKE_PREFIX_PATH="$stage" "$@" && cmake --build b -j2
}

cmake_draws() { cmake_project native ../hello.c && cmake_builds && b/hello | diff - ../expected; }

cmake_draws_from_sources() { # as a cross build does, but here it can run
    cmake_project sources ../hello.c && cmake_builds -DPICO_PLATFORM=host && b/hello | diff - ../expected
}

another_version_is_refused() { # below 1.0 an older minor is another version, too
    cmake_project refused ../hello.c || return 1
    for other in 99.0 0.8; do
        sed -i "s/Pinhole [0-9.]*/Pinhole $other/" CMakeLists.txt && rm -rf b && ! cmake_builds && ! [ -e b/hello ] || return 1
    done
}

no_such_cpu_is_refused() {
    cmake_project cpu ../hello.c && ! cmake_builds -DPICO_PLATFORM=host -DPINHOLE_CPU=z80 2>err && grep -q 'PINHOLE_CPU=z80: no such folder' err
}

toolchain() { # compiler, flags, linker flags, then the project's more arguments of cmake
    printf 'set(CMAKE_SYSTEM_NAME Generic)\nset(CMAKE_SYSTEM_PROCESSOR unknown)\nset(CMAKE_C_COMPILER %s)\nset(CMAKE_C_FLAGS_INIT "%s")\nset(CMAKE_EXE_LINKER_FLAGS_INIT "%s")\nset(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)\n' \
        "$1" "$2" "$3" >toolchain.cmake
}

cmake_builds_for_arm() { # -mcpu=, folder of kernels that must be in it
    cmake_project "$1" ../hello.c && toolchain arm-none-eabi-gcc "-mcpu=$1 -mthumb" --specs=nosys.specs &&
        cmake_builds -DCMAKE_TOOLCHAIN_FILE="$PWD/toolchain.cmake" >log 2>&1 || { cat log && return 1; }
    grep -q "kernels/$2/cull.S" log && ! grep -q 'portable/cull.c' log && arm-none-eabi-nm b/hello | grep -q ' T ph_cull$'
}

cmake_builds_for_riscv() { # no C library: what the core calls is here
    sed 's/#include <stdio.h>//; s/printf(.*/(void)i;/' "$dir/hello.c" >"$dir/bare.c"
    printf '%s\n' 'void *memset(void *p, int c, unsigned n) { char *q = p; while (n--) { *q++ = (char)c; } return p; }' \
        'void *memcpy(void *p, const void *o, unsigned n) { char *q = p; const char *r = o; while (n--) { *q++ = *r++; } return p; }' \
        'void _start(void) { main(); }' >>"$dir/bare.c"
    cmake_project riscv ../bare.c && echo 'target_link_libraries(hello PRIVATE gcc)' >>CMakeLists.txt &&
        toolchain riscv64-unknown-elf-gcc '-march=rv32imac -mabi=ilp32 -ffreestanding -fno-builtin' -nostdlib &&
        cmake_builds -DCMAKE_TOOLCHAIN_FILE="$PWD/toolchain.cmake" && riscv64-unknown-elf-nm b/hello | grep -q ' T ph_draw_band$' &&
        find b -name 'small_gouraud.S.*' | grep -q .
}

dist() { git rev-parse -q --verify HEAD >/dev/null && make -s dist B="$B/package"; }

unpack() { # file of dist, folder
    empty_folder "$2" && unzip -q "$B/package/dist/$1"
}

arduino_has_its_layout() {
    unpack "Pinhole-$version-arduino.zip" arduino && cd Pinhole || return 1
    local key
    for key in name version author maintainer sentence paragraph category url architectures; do
        grep -q "^$key=" library.properties || { echo "no $key" && return 1; }
    done
    grep -qx "version=$version" library.properties && grep -q "\"version\": \"$version\"" library.json && [ -e src/Pinhole.h ] &&
        [ -e examples/Hello/Hello.ino ] && [ -z "$(find . -name '*.[cS]' -not -path './src/*')" ]
}

arduino_draws() { # as Arduino's builder does: every source below src/, with -Isrc alone
    cd "$dir/arduino" || return 1
    local file
    for file in Pinhole/src/pinhole/*.c; do cc -w -Os -IPinhole/src -c "$file" -o "$(basename "$file").o" || return 1; done
    cc -IPinhole/src ../hello.c ./*.o -o hello && ./hello | diff - ../expected
}

arduino_compiles() { # name, the file that must have the kernel of its CPU, compiler and flags
    local file
    cd "$dir/arduino" || return 1
    for file in Pinhole/src/pinhole/*.[cS]; do
        "${@:3}" -Os -w -IPinhole/src -c "$file" -o "$(basename "$file").$1" || return 1
    done
    "${3%gcc}nm" ./*."$1" | awk '$2 == "T" { print $3 }' | sort >symbols && [ -z "$(uniq -d symbols)" ] && grep -qx ph_cull symbols &&
        "${3%gcc}nm" "$2.$1" | grep -q ' T ph_cull$'
}

# Compilers that come without a C library.
riscv() { "${@:2}" riscv64-unknown-elf-gcc -march="$1" -mabi=ilp32 -ffreestanding -isystem "$tree/firmware/bare/include"; }
xtensa() { "$@" xtensa-lx106-elf-gcc -mlongcalls -ffreestanding -isystem "$tree/firmware/bare/include"; }

# The library for small chips draws random scenes as the whole library does, and compiles for a Cortex-M0.
small_arduino_draws() {
    local file
    make -s dist PROFILE=small B="$B/package-small" && empty_folder small && unzip -q "$B/package-small/dist/Pinhole-$version-small-arduino.zip" &&
        grep -qx "name=Pinhole-small" Pinhole/library.properties || return 1
    for file in Pinhole/src/pinhole/*.c; do
        cc -w -Os -IPinhole/src -c "$file" -o "$(basename "$file").o" && arm-none-eabi-gcc -mcpu=cortex-m0 -mthumb -Os -w -IPinhole/src -c "$file" -o "$(basename "$file").m0" || return 1
    done
    cc -w -O2 -DPH_PROFILE_SMALL -IPinhole/src/pinhole "$tree/tests/size/small_scenes.c" ./*.o -o small &&
        cc -w -O2 -I"$tree/firmware/core" -I"$tree/firmware/core/kernels/portable" "$tree/tests/size/small_scenes.c" "$B/package/libpinhole.a" -o whole &&
        ./small 0 200 >drawn && ./whole 0 200 | diff - drawn && [ "$(wc -l <drawn)" = 200 ]
}

headers_compile_as_cpp() { # compiler and flags
    echo '#include <Pinhole.h>
int main() { return ph_rgb565(1, 2, 3) == 0; }' >"$dir/all.cpp"
    "$@" -Wall -Wextra -Werror -I"$dir/arduino/Pinhole/src" -c "$dir/all.cpp" -o "$dir/all.o"
}

esp_idf_builds() { # architecture as ESP-IDF calls it, its small_gouraud, compiler and flags: what ESP-IDF's function does with the component
    unpack "pinhole-$version-esp-idf.zip" esp && grep -qx "version: \"$version\"" pinhole/idf_component.yml || return 1
    printf '%s\n' 'cmake_minimum_required(VERSION 3.16)' 'project(esp C ASM)' "set(CONFIG_IDF_TARGET_ARCH_$1 y)" 'function(idf_component_register)' \
        '  cmake_parse_arguments(a "" "" "SRCS;INCLUDE_DIRS;PRIV_INCLUDE_DIRS" ${ARGN})' \
        '  set(COMPONENT_LIB component PARENT_SCOPE)' '  add_library(component STATIC ${a_SRCS})' \
        '  target_include_directories(component PUBLIC ${a_INCLUDE_DIRS} PRIVATE ${a_PRIV_INCLUDE_DIRS})' 'endfunction()' \
        'add_subdirectory(pinhole)' >CMakeLists.txt
    toolchain "$3" "${*:4}" -nostdlib &&
        cmake -S . -B b -DCMAKE_TOOLCHAIN_FILE="$PWD/toolchain.cmake" && cmake --build b -j2 && "${3%gcc}nm" b/pinhole/libcomponent.a | grep -q ' T ph_show$' &&
        [ "$(find b -name 'small_gouraud.*.obj' -printf '%f\n')" = "$2.obj" ]
}

tarball_builds() {
    empty_folder tar && tar -xzf "$B/package/dist/pinhole-$version.tar.gz" && cd "pinhole-$version" &&
        make -s -j2 B=build ASSIMP=noassimp MESHOPT=nomeshopt PNG=nopng GIF=nogif SDL=nosdl GPIOD=nogpiod DRM=nolibdrm USB=nousb build/pinhole-sim && build/pinhole-sim --demo cube --crc | diff - <("$stage/bin/pinhole-sim" --demo cube --crc)
}

# The window shows the picture that the core draws: SDL's own BMP against a program that counts pixels band by band.
sdl_example_draws() {
    local triangles
    empty_folder sdl && cp "$tree"/firmware/package/examples/{sdl2.c,triangle.h} . &&
        cc -Wall -Wextra sdl2.c $(pkg-config --cflags --libs pinhole sdl2) -o sdl && SDL_VIDEODRIVER=dummy ./sdl 17 shot.bmp || return 1
    printf '%s\n' '#include "triangle.h"' '#include <stdio.h>' 'int main(void) { struct ph_renderer r; int n = 0; triangle_init(&r, PH_PIXELS_WIRE); triangle_draw(&r, 16);' \
        'for (uint32_t b = 0, bands = ph_frame_bands(&r); b < bands; b++) { uint32_t lines = ph_draw_band(&r, b, triangle_pixels);' \
        'for (uint32_t i = 0; i < lines * WIDTH; i++) { n += triangle_pixels[i] != 0; } } printf("%d\n", n); return 0; }' >count.c
    cc count.c $(pkg-config --cflags --libs pinhole) -o count && triangles=$(./count) && [ "$triangles" -gt 1000 ] &&
        convert shot.bmp -format '%c' histogram:info: | tr -s ' ' | grep "^ $triangles: (255,16[0-9],0)"
}

man_pages_name_every_option() {
    local program option
    for program in "$stage"/bin/pinhole-*; do
        for option in $("$program" --help | awk '/^  --/ { print $1 }' | sort -u); do
            grep -q -- "${option//-/\\\\-}" "$stage/share/man/man1/$(basename "$program").1" || { echo "$program: no $option" && return 1; }
        done
    done
}

completes() { # words of the command line, a word that must be offered
    bash -c '. "$1/share/bash-completion/completions/pinhole-sim"; PATH=$1/bin:$PATH; COMP_WORDS=($2); COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
        _pinhole "${COMP_WORDS[0]}"; printf "%s\n" "${COMPREPLY[@]}"' - "$stage" "$1" | grep -qx -- "$2"
}

versions_are_one() {
    local program
    for program in "$stage"/bin/pinhole-*; do
        "$program" --version | grep -qx "${program##*/} $version" || { echo "$program" && return 1; }
    done
}

nothing_is_left() { run uninstall PREFIX="$stage" && [ -z "$(find "$stage" -type f)" ]; }

need() { # what, command, test name, check...
    if command -v "$1" >/dev/null; then check "${@:2}"; else skip "$2" "no $1"; fi
}

check "make_install_installs" installs
check "the_readme_has_a_program_and_its_picture" hello
check "every_program_tells_the_one_version" versions_are_one
need help2man "the_man_pages_name_every_option" man_pages_name_every_option
check "bash_completes_options" completes "pinhole-sim --he" --help
check "bash_completes_boards" completes "pinhole-sim --board pico-d" pico-display
check "pkg_config_from_an_empty_folder_draws" pkg_config_draws
need cmake "find_package_from_an_empty_folder_draws" cmake_draws
need cmake "the_installed_sources_draw" cmake_draws_from_sources
need cmake "find_package_refuses_a_version_that_is_not_there" another_version_is_refused
need cmake "a_CPU_without_kernels_is_refused" no_such_cpu_is_refused
if command -v cmake >/dev/null && command -v arm-none-eabi-gcc >/dev/null; then
    check "CMake_builds_for_a_Cortex-M0+" cmake_builds_for_arm cortex-m0plus armv6m
    check "CMake_builds_for_a_Cortex-M4" cmake_builds_for_arm cortex-m4 armv7m
    check "CMake_builds_for_a_Cortex-M33" cmake_builds_for_arm cortex-m33 armv7m
fi
need riscv64-unknown-elf-gcc "CMake_builds_for_rv32imac_without_a_C_library" cmake_builds_for_riscv
if command -v zip >/dev/null && command -v unzip >/dev/null && command -v git >/dev/null && check "make_dist_packs" dist; [ "$tap_failed" = 0 ]; then
    check "the_tarball_builds_where_it_is_unpacked" tarball_builds
    check "the_Arduino_library_has_its_layout" arduino_has_its_layout
    need arm-none-eabi-gcc "the_Arduino_library_for_small_chips_draws_the_same" small_arduino_draws
    check "the_Arduino_library_draws" arduino_draws
    need arm-none-eabi-gcc "the_Arduino_library_compiles_for_a_Cortex-M0+" arduino_compiles m0plus cull.S arm-none-eabi-gcc -mcpu=cortex-m0plus -mthumb
    need arm-none-eabi-gcc "the_Arduino_library_compiles_for_a_Cortex-M4" arduino_compiles m4 cull.S arm-none-eabi-gcc -mcpu=cortex-m4 -mthumb
    need riscv64-unknown-elf-gcc "the_Arduino_library_compiles_for_an_ESP32-C3" riscv rv32imc arduino_compiles c3 cull.S
    need riscv64-unknown-elf-gcc "the_Arduino_library_compiles_for_an_ESP32-C6" riscv rv32imac arduino_compiles c6 cull.S
    need riscv64-unknown-elf-gcc "the_Arduino_library_has_C_for_RISC-V_without_compressed_instructions" riscv rv32im arduino_compiles im cull.c
    need xtensa-lx106-elf-gcc "the_Arduino_library_has_C_for_Xtensa" xtensa arduino_compiles lx106 cull.c
    need g++ "its_headers_compile_as_C++98" headers_compile_as_cpp g++ -std=c++98
    need g++ "its_headers_compile_as_C++20" headers_compile_as_cpp g++ -std=c++20
    need riscv64-unknown-elf-gcc "the_ESP-IDF_component_builds_for_an_ESP32-C3" riscv rv32imc esp_idf_builds RISCV small_gouraud.S
    need riscv64-unknown-elf-gcc "the_ESP-IDF_component_builds_for_an_ESP32-C6" riscv rv32imac esp_idf_builds RISCV small_gouraud.S
    need xtensa-lx106-elf-gcc "the_ESP-IDF_component_builds_for_Xtensa" xtensa esp_idf_builds XTENSA small_gouraud.c
fi
if pkg-config --exists sdl2 && command -v convert >/dev/null; then
    check "the_SDL2_example_draws" sdl_example_draws
else
    skip "the_SDL2_example_draws" "no SDL2 or no ImageMagick"
fi
check "make_uninstall_leaves_nothing" nothing_is_left
tap_end
