#!/usr/bin/env bash
# `make firmware` builds images, says what they take, and refuses wrong input. The images run in the other scripts here.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}/firmware-test
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
board=feather-stm32f405
image=$B/firmware/$board-demos

firmware() { make_image firmware "$@"; }

near() { # number, number, most
    awk -v a="$1" -v b="$2" -v most="$3" 'BEGIN { d = a - b; if (d < 0) { d = -d } if (d >= most) { print a " and " b; exit 1 } }'
}

builds_and_says_what_it_takes() {
    firmware BOARD="$board" >"$dir/said" || { cat "$dir/said" && return 1; }
    for kind in elf bin uf2 map; do [ -s "$image.$kind" ] || { echo "no $kind" && return 1; }; done
    cat "$dir/said"
    grep -Eq '^flash +[0-9]+ of +983040 bytes' "$dir/said" && grep -Eq '^RAM +[0-9]+ of +117964 bytes' "$dir/said" &&
        grep -Eq '^stack +[0-9]+ bytes' "$dir/said"
}

flash_is_the_size_of_the_bin() { # within the padding between sections
    local said size
    said=$(awk '/^flash/ { print $2 }' "$dir/said") size=$(stat -c %s "$image.bin")
    near "$said" "$size" 8
}

# No two program headers load to the same address, bytes or zeros. picotool refuses an ELF file with such headers.
segments_lie_apart() { # board
    [ -s "$B/firmware/$1-demos.elf" ] || firmware BOARD="$1" >/dev/null || return 1
    arm-none-eabi-readelf -lW "$B/firmware/$1-demos.elf" | awk '$1 == "LOAD" && $6 != "0x00000" { print $4, $6, $5 }' | sort | tee "$dir/segments" | awk '
        function hex(text,    i, n) { n = 0; for (i = 3; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }; return n }
        hex($1) < end { print "the segment at load address " $1 " begins within the one before"; bad = 1 }
        $3 == "0x00000" && hex($1) < 536870912 { print "the segment at load address " $1 " has no bytes"; bad = 1 }
        { end = hex($1) + hex($2) }
        END { exit bad || NR < 2 }'
}

# Read back with od and awk alone: magics, flags, addresses, numbers, family, and the payload against the BIN.
# It is made of the image that is linked for where TinyUF2 starts applications: 08010000 on an STM32F4.
uf2_holds_the_bin() {
    local bin=$B/firmware/$board-objects/uf2-$board-demos.bin
    local blocks=$((($(stat -c %s "$bin") + 255) / 256))
    od -An -v -tx4 -w512 "$image.uf2" | awk -v blocks="$blocks" '
        function hex(text,    i, n) { n = 0; for (i = 1; i <= length(text); i++) { n = n * 16 + index("0123456789abcdef", substr(text, i, 1)) - 1 }; return n }
        $1 != "0a324655" || $2 != "9e5d5157" || $3 != "00002000" || $128 != "0ab16f30" { print "magic of block " NR - 1 > "/dev/stderr"; exit 1 }
        hex($4) != hex("08010000") + 256 * (NR - 1) || hex($5) != 256 || hex($6) != NR - 1 || hex($7) != blocks || $8 != "57755a57" { print "header of block " NR - 1 > "/dev/stderr"; exit 1 }
        { for (i = 9; i <= 72; i++) { print $i } }
        END { if (NR != blocks) { print NR " blocks, not " blocks > "/dev/stderr"; exit 1 } }' >"$dir/payload" || return 1
    { cat "$bin" && head -c $((256 * blocks - $(stat -c %s "$bin"))) /dev/zero; } | od -An -v -tx4 -w4 | tr -d ' ' | cmp - "$dir/payload"
}

binary_info() { # of an RP2040 image
    od -An -v -tu1 -w16 "$B/firmware/$1.bin" | awk -f tests/firmware/binary_info.awk
}

binary_info_is_there() { # as picotool shows it; see tests/debian13
    firmware BOARD=pico-display >/dev/null && binary_info pico-display-demos | diff - <(printf '%s\n' 'name Pinhole demos' "version $(sed -n 's/^.define PH_VERSION "\(.*\)"/\1/p' firmware/core/status.h)" 'board pico-display' \
        'boot2 boot2.S, command EBh or 03h' 'attribute CORES=1 CHANGES=1' 'feature takes a scene at 0x10080000' "end $((0x10000000 + $(stat -c %s "$B/firmware/pico-display-demos.bin")))" \
        'pin 0 function 2' 'pin 1 function 2' 'pin 18 function 1' 'pin 19 function 1' 'pin 18 clock' 'pin 19 data' 'pin 17 chip select' \
        'pin 16 D/C' 'pin 20 backlight' 'pin 12 button up' 'pin 13 button down' 'pin 14 button left' 'pin 15 button right')
}

binary_info_is_the_images() { # another board, program, version, number of cores
    printf '#include "port.h"\nint main(void) { return 0; }\n' >"$dir/other.c"
    firmware BOARD=waveshare-pico-lcd-1in3 APP="$dir/other.c" VERSION=2.5-x CORES=2 CHANGES=0 >/dev/null &&
        binary_info waveshare-pico-lcd-1in3-other-cores2-whole >"$dir/info" || return 1
    local line
    for line in 'name Pinhole other' 'version 2.5-x' 'board waveshare-pico-lcd-1in3' 'attribute CORES=2 CHANGES=0' 'pin 12 reset' 'pin 3 button select'; do
        grep -qxF "$line" "$dir/info" || { cat "$dir/info" && return 1; }
    done
    ! grep feature "$dir/info" || return 1 # its main() looks for no scene
    says "VERSION='a b': a version has no spaces" firmware BOARD="$board" VERSION='a b'
}

same_sources_same_bytes() {
    CCACHE_DISABLE=1 B=$B/again firmware BOARD=pico-display >/dev/null && cmp "$B/again/firmware/pico-display-demos.bin" "$B/firmware/pico-display-demos.bin"
}

budget() { # changed pair
    CROSS=arm-none-eabi- firmware/tools/budget.sh "$image.elf" "$board" flash=1048576 ram=117964 chip_ram=196608 stack=6400 "$@" 2>&1
}

over() { # pair, pattern in the one line that says so: what, by how much, what to do
    local said
    said=$(budget "$1") && echo "accepts $1" && return 1
    grep -qx "$image.elf: [1-9][0-9]* bytes over the $2" <<<"$said" || { echo "$said" && return 1; }
}

stack_grows_with_the_program() { # whose main() has a buffer that is larger than the core's deepest path
    local bytes
    printf '%s\n' 'int main(void) { volatile char b[7168]; b[3] = 1; return b[3]; }' >"$dir/deep.c"
    bytes=$(firmware BOARD="$board" APP="$dir/deep.c" | awk '/^stack/ { print $2 }')
    [ "$bytes" -ge 7232 ] && [ "$bytes" -le 7424 ] || { echo "$bytes" && return 1; }
}

no_call_graph() { # of one object, as ccache leaves it
    local graph=$B/firmware/$board-objects/firmware/core/render/raster.ci said
    mv "$graph" "$dir" && said=$(firmware/tools/stack.sh image 40 "" "$B/firmware/$board-objects" "${graph%.ci}.o" 2>&1) && echo "accepts it" && return 1
    mv "$dir/raster.ci" "$graph" && grep -q "no call graph of firmware/core/render/raster.c, so the stack has no bound" <<<"$said" || { echo "$said" && return 1; }
}

more_than_the_chip_has() {
    local said
    said=$(budget ram=200000) && echo "accepts it" && return 1
    grep -q "allows 200000 bytes of RAM, but the chip has 196608: correct image_ram" <<<"$said" || { echo "$said" && return 1; }
}

refuses() { # pattern in its one line, C text, other variables of make...
    printf '%s\n' "$2" >"$dir/mine.c"
    firmware BOARD="$board" APP="$dir/mine.c" "${@:3}" >"$dir/out" 2>&1 && echo "accepts it" && return 1
    grep -q "$1" "$dir/out" || { cat "$dir/out" && return 1; }
}

float='volatile float x = 2; int main(void) { x = x * x; return 0; }'
recursive='volatile int n = 9; int f(int a); int f(int a) { return a > 0 ? f(a - 1) * a + n : 1; } int main(void) { return f(n); }'

a_program_of_ones_own() {
    printf '#include "port.h"\nint main(void) { port_log("here\\n"); return 0; }\n' >"$dir/mine.c"
    firmware BOARD="$board" APP="$dir/mine.c" && [ "$(stat -c %s "$B/firmware/$board-mine.bin")" -lt 16384 ]
}

template_links() { # what one copies to port a chip; every function of the ports' headers is there
    mkdir -p "$dir/kits/none-yet" &&
        sed 's/board_feather_stm32f405/board_none_yet/; s/feather-stm32f405/none-yet/' boards/feather-stm32f405/board.c >"$dir/kits/none-yet/board.c" &&
        printf '%s\n' 'PORT = template' 'CHIP_FLASH_BYTES = 1048576' 'CHIP_RAM_BYTES = 262144' >"$dir/kits/none-yet/board.mk" &&
        firmware BOARD_DIR="$dir/kits" BOARD=none-yet && [ -s "$B/firmware/none-yet-demos.bin" ] || return 1
    local name
    while read -r name; do
        arm-none-eabi-nm "$B"/firmware/none-yet-objects/hal/{template/template,chips/cortexm/start,chips/cortexm/one_core}.o | grep -q " T $name\$" || { echo "$name" && return 1; }
    done < <(sed -n 's/.*[ *]\(port_[a-z_]*\)(.*/\1/p' hal/port.h hal/chips/cortexm/start.h)
    segments_lie_apart none-yet && says 'hal/template drives no chip' flash BOARD_DIR="$dir/kits" BOARD=none-yet
}

no_such_board() {
    local said
    said=$(make -s B="$B" firmware BOARD=nonsense 2>&1) && return 1
    grep -q "BOARD=nonsense: no .*lm3s6965evb" <<<"$said" || { echo "$said" && return 1; }
    said=$(make -s B="$B" firmware 2>&1) && return 1
    grep -q "BOARD= is missing.*lm3s6965evb" <<<"$said" || { echo "$said" && return 1; }
}

says() { # pattern of its one line, make's arguments...
    local said
    said=$(make -s B="$B" "${@:2}" 2>&1) && return 1
    grep -q "$1" <<<"$said" || { echo "$said" && return 1; }
}

ram_text() { arm-none-eabi-size -A "$B/firmware/$1.elf" | awk '$1 == ".ram_text" { print $2 }'; } # of an RP2040 image

less_code_in_ram() {
    firmware BOARD=pico-display CORES=2 >/dev/null && firmware BOARD=pico-display CORES=2 RAM_CODE=small >/dev/null || return 1
    echo "# code in RAM: $(ram_text pico-display-demos-cores2) bytes, with RAM_CODE=small $(ram_text pico-display-demos-cores2-small)"
    [ $(($(ram_text pico-display-demos-cores2) - $(ram_text pico-display-demos-cores2-small))) -ge 20480 ]
}

wrong_values_are_told() {
    says "RAM_CODE=large: pico-display has small" firmware BOARD=pico-display RAM_CODE=large && says "RAM_CODE=small: $board has no other" firmware BOARD="$board" RAM_CODE=small &&
    says "CORES=3: pico-display has 1 2" firmware BOARD=pico-display CORES=3 && says "CORES=2: $board has 1" firmware BOARD="$board" CORES=2 &&
        says "APP=nonsense: there is no firmware/app/images/nonsense.c" firmware BOARD="$board" APP=nonsense &&
        says "FRAMES='0': a whole number" emulate BOARD="$board" FRAMES=0 && says "FRAMES='x': a whole number" emulate BOARD="$board" FRAMES=x &&
        says "no nowhere-gcc here: apt-get install gcc-arm-none-eabi" firmware BOARD="$board" CROSS=nowhere- &&
        says "only the boards of an RP2040" speed BOARD="$board" && says "BOARD= is missing" speed
}

# Names that make or the shell would split, or build elsewhere.
names_that_cannot_be_are_told() {
    local name
    for name in "a b" "it's" 'a;b' 'a&b' 'a(b)' 'a"b' 'a%'; do
        says "APP='$name.c': make takes no names with" firmware BOARD="$board" APP="$name.c" &&
            says "SCENE='$name.obj': make takes no names with" firmware BOARD="$board" SCENE="$name.obj" &&
            says "BOARD='\\?$name" firmware BOARD="$name" || return 1
    done
    says "BOARD='../boards/$board': no such board" firmware BOARD="../boards/$board" || return 1
    ! make -s B="$dir/a b" all >"$dir/out" 2>&1 && grep -q "B='$dir/a b': make takes no folder with spaces" "$dir/out"
}

names_of_other_tongues_can_be() {
    mkdir -p "$dir/früh" && a_program_of_ones_own && cp "$dir/mine.c" "$dir/früh/übung#1.c" && firmware BOARD="$board" APP="$dir/früh/übung#1.c" &&
        [ -s "$B/firmware/$board-übung#1.uf2" ]
}

too_large() { # C text, pattern of the one line that is not make's
    local left
    printf '%s\n' "$1" >"$dir/large.c"
    ! firmware BOARD="$board" APP="$dir/large.c" >"$dir/out" 2>"$dir/err" || return 1
    [ "$(grep -vc '^make' "$dir/err")" = 1 ] && grep -qx "$B/firmware/$board-large.elf: $2" "$dir/err" || { cat "$dir/err" && return 1; }
    for left in "$B/firmware/$board-large".{bin,uf2,elf.part,map.part}; do [ ! -e "$left" ] || { echo "$left stays" && return 1; }; done
}

too_large_is_one_line_and_leaves_nothing() {
    too_large 'static const char big[1200000] = {1}; int main(void) { volatile int i = 3; return big[i]; }' 'too large for the chip: its FLASH lacks [0-9]* bytes' &&
        too_large 'static char big[150000]; int main(void) { volatile int i = 3; return big[i]++; }' 'too large for the chip: its RAM lacks [0-9]* bytes' &&
        too_large 'static char big[120000]; int main(void) { volatile int i = 3; return big[i]++; }' '[0-9]* bytes over the RAM of .*: take fewer variables and buffers into the program'
}

size_adds_up() {
    make -s B="$B" size BOARD="$board" >"$dir/size" || return 1
    grep -q '^firmware/core/render/raster ' "$dir/size" || { cat "$dir/size" && return 1; }
    awk 'NR > 1 && $1 != "all" { f += $(NF - 1); r += $NF } $1 == "all" { exit !(f == $2 && r == $3) }' "$dir/size" || return 1
    grep -q '^stack ' "$dir/size" && grep -q '^alignment ' "$dir/size" || { echo "no stack or no alignment" && return 1; }
    grep -q '^the program itself ' "$dir/size" && grep -q '^libgcc: 64-bit division ' "$dir/size" && ! grep '\.[ao]\b' "$dir/size"
}

# What `make size` adds up is what `make firmware` says: all of flash and RAM has a name.
sizes_are_those_of_the_image() { # board
    local said
    make_image firmware BOARD="$1" >"$dir/said" && make -s B="$B" size BOARD="$1" >"$dir/size" || return 1
    said=$(awk '$1 == "flash" || $1 == "RAM" { printf "%d ", $2 }' "$dir/said")
    awk -v said="$said" '$1 == "all" { all = $2 " " $3 " " } END { if (all != said) { print all ", not " said; exit 1 } }' "$dir/size"
}

# Full by design does not read as nearly broken: what is free is said in bytes, and whom the scenes leave it to.
what_is_free_is_said_in_bytes() {
    grep -Eq '^flash .* bytes, [0-9]+ free$' "$dir/said" &&
        grep -Eq '^RAM .* bytes, [0-9]+ free: scenes have [0-9]+, the stack [0-9]+; the chip has [0-9]+' "$dir/said" && ! grep -q '9[0-9] %' "$dir/said"
}

# What an image for one core may take of the chip's RAM.
at_most_60_percent() {
    local mk found=0
    local -A database=()
    for mk in boards/*/board.mk; do
        local name=${mk#boards/} ram chip
        name=${name%/board.mk}
        ram=$(make -s B="$B" BOARD="$name" "$B/board-facts" && "$B/board-facts" image_ram 1) || return 1
        [ -n "${database[$(cat "$mk")]-}" ] || database[$(cat "$mk")]=$(make -np BOARD="$name" help 2>/dev/null | sed -n 's/^CHIP_RAM_BYTES :*= *//p')
        chip=${database[$(cat "$mk")]}
        found=$((found + 1))
        { [ "$ram" -gt 0 ] && [ $((100 * ram)) -le $((60 * chip)) ]; } || { echo "$name: $ram of $chip" && return 1; }
    done
    [ "$found" -ge 2 ]
}

# 2 KB more code in the core, where most boards run it from RAM, and 256 bytes more in struct ph_renderer.
code_may_grow() {
    local tree=$dir/tree board cores
    mkdir -p "$tree" && cp -a Makefile firmware hal boards host-sim "$tree/" && cd "$tree" || return 1
    sed -i 's/^struct ph_renderer {$/&\n    uint32_t more[64];/' firmware/core/render.h
    sed -i '/^PH_TIER(mesh) int ph_draw_mesh(/,/^}/s/^{$/{ more();/' firmware/core/render/mesh.c
    sed -i 's/^PH_TIER(mesh) int ph_draw_mesh(/PH_TIER(mesh) static __attribute__((noinline)) void more(void) { __asm__ volatile(".rept 1022\\n nop\\n .endr"); }\n&/' firmware/core/render/mesh.c
    grep -q more firmware/core/render.h && grep -q '^{ more' firmware/core/render/mesh.c || return 1
    for board in pico-display-2 pico2-display lm3s6965evb feather-stm32f405; do
        for cores in 1 2; do
            [[ $cores = 1 || $board = pico* ]] || continue
            make -s -j2 B=build firmware BOARD="$board" CORES="$cores" ISA="$([[ $board != pico2* ]] || echo riscv)" >said 2>&1 || { cat said && return 1; }
            arm-none-eabi-nm -S "build/firmware/$board-demos$([ "$cores" = 2 ] && echo -cores2).elf" 2>/dev/null | grep -q ' t more$' || [[ $board = pico2* ]] || return 1
        done
    done
}

target_sizes_are_those_counted_with() {
    size() { # bytes more of a vertex, a reference, a slot, a triangle
        printf '#include "list.h"\n#include "triangle.h"\n#include "vertex.h"\n_Static_assert(sizeof(struct ph_vertex) == PH_VERTEX_BYTES_32 + %s && sizeof(struct ph_ref) == PH_REFERENCE_BYTES + %s && sizeof(struct ph_triangle) == PH_SLOT_BYTES_32 + %s && sizeof(struct ph_vertex) + sizeof(struct ph_ref) == PH_TRIANGLE_BYTES_32 + %s, "");\n' "$@" |
            arm-none-eabi-gcc -mcpu=cortex-m3 -mthumb -Ifirmware/core/kernels/armv7m -Ifirmware/core/kernels/portable -Ifirmware/core -Ifirmware/core/render -x c -fsyntax-only - 2>"$dir/wrong"
    }
    size 0 0 0 0 || { cat "$dir/wrong" && return 1; }
    ! size 4 0 0 0 && ! size 0 4 0 0 && ! size 0 0 4 0 && ! size 0 0 0 4
}

check "an_image_is_built_and_says_what_it_takes" builds_and_says_what_it_takes
check "the_flash_that_it_says_is_the_size_of_the_BIN" flash_is_the_size_of_the_bin
for of in "$board" lm3s6965evb pico-display; do
    check "the_program_headers_of_${of}_do_not_overlap" segments_lie_apart "$of"
done
check "the_UF2_holds_the_BIN_with_the_chips_family" uf2_holds_the_bin
check "an_RP2040_image_tells_its_name_its_board_and_its_pins" binary_info_is_there
check "it_tells_those_of_the_image_that_was_built" binary_info_is_the_images
check "the_same_sources_give_the_same_image" same_sources_same_bytes
check "within_the_budget_it_passes" budget
check "over_the_flash_it_fails" over flash=90000 "flash of $board: take less into the image.*"
check "over_the_RAM_it_fails" over ram=100000 "RAM of $board: give scenes so much less.* about [1-9][0-9]* triangles.*"
check "the_stack_is_what_the_deepest_path_takes" stack_grows_with_the_program
check "a_stack_without_a_call_graph_fails" no_call_graph
check "a_board_with_more_RAM_than_its_chip_fails" more_than_the_chip_has
check "code_and_variables_may_grow" code_may_grow
check "floating_point_is_refused" refuses 'floating point, heap' "$float"
check "a_heap_is_refused" refuses 'floating point, heap' '#include <stdlib.h>
void *_sbrk(int n); void *_sbrk(int n) { (void)n; return 0; }
int main(void) { return malloc(8) != 0; }'
check "recursion_is_refused" refuses 'recursion' "$recursive"
if command -v riscv64-unknown-elf-gcc >/dev/null; then
    check "floating_point_is_refused_on_RISC-V" refuses 'floating point, heap' "$float" BOARD=pico2-display ISA=riscv
    check "recursion_is_refused_on_RISC-V" refuses 'recursion' "$recursive" BOARD=pico2-display ISA=riscv
else
    skip "refusals_on_RISC-V" "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf"
fi
check "a_program_of_ones_own_becomes_an_image" a_program_of_ones_own
check "the_template_of_a_port_becomes_an_image" template_links
check "a_board_that_is_not_there_is_one_clear_line" no_such_board
check "with_less_code_in_RAM_an_image_takes_less_of_it" less_code_in_ram
check "wrong_values_are_one_clear_line" wrong_values_are_told
check "names_that_cannot_be_are_one_clear_line" names_that_cannot_be_are_told
check "names_of_other_tongues_can_be" names_of_other_tongues_can_be
check "what_is_too_large_is_one_line_and_leaves_nothing" too_large_is_one_line_and_leaves_nothing
check "the_sizes_of_the_modules_add_up" size_adds_up
for of in "$board" pico-display pico2-display; do
    check "all_of_flash_and_RAM_of_${of}_has_a_name" sizes_are_those_of_the_image "$of"
done
check "what_is_free_is_said_in_bytes" what_is_free_is_said_in_bytes
check "no_board_gives_Pinhole_more_than_60_percent_of_its_RAM" at_most_60_percent
check "the_sizes_that_the_memory_plan_counts_with_are_the_targets" target_sizes_are_those_counted_with
tap_end
