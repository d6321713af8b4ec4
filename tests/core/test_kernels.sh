#!/usr/bin/env bash
# The kernels of each CPU do what the portable ones do, bit for bit: on random input, and in every frame of
# tests/tools/frames.sh. The assembly for ARMv6-M and ARMv7-M runs under qemu-arm, whose cores know all its instructions, that
# for RV32 under qemu-riscv32, with and without the extensions that it uses where they are there.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/tools/frames.sh
unset MAKEFLAGS
B=${B:-build}/kernels
cross=arm-linux-gnueabihf-gcc core=-mcpu=cortex-a15 # one that divides, as a Cortex-M3 does
rm -rf "$B/once" && mkdir -p "$B"
for tool in $cross qemu-arm riscv64-unknown-elf-gcc; do
    command -v "$tool" >/dev/null || { echo "no $tool: apt-get install gcc-arm-linux-gnueabihf gcc-riscv64-unknown-elf qemu-user" && exit 77; }
done

kernels=firmware/core/kernels
include=(-Ifirmware/core -Ifirmware/core/render -Ifirmware/core/kernels)
loops=(fx_mul fill span_flat span_blend pairs_mix pairs_add pairs_times span_seen fog_alike line_pixels halve small_gouraud small_knee long_gouraud small_dithered knee_dithered long_dithered small_colours setup_small float_depths texture_tile texture_small texel_row_nearest texel_row_lit texel_row_smooth texel_row_smooth_lit texel_run_rows vertices cull)

c_loops() {
    cc -O2 -std=c11 -Ifirmware/core/kernels/portable "${include[@]}" tests/core/kernels/kernel_loops.c firmware/core/fx/fx_root.c "${loops[@]/%/.c}" -o "$B/c" &&
        "$B/c" >"$B/c.lines" && [ "$(wc -l <"$B/c.lines")" = $((${#loops[@]} + 1)) ] # texture_knee has no file of its own
}
loops=("${loops[@]/#/$kernels/portable/}")

# Compiles files to objects and names them in $linked. Without what is changed they are compiled once with these flags.
objects() { # compiler and flags...; files in $files
    local file object kind
    kind=$B/once/$(cksum <<<"$*" | tr ' ' -)
    mkdir -p "$kind" && linked=() || return 1
    for file in "${files[@]}"; do
        object=$kind/${file//\//.}.o
        [[ "$file $*" != *"$B/"* && -e $object ]] || "$@" -c "$file" -o "$object" || return 1
        linked+=("$object")
    done
}

thumb() { # CPU: compiles and runs $files
    local compiler=("$cross" "$core" ${without:+"$without"} -O2 -std=c11 -mthumb)
    [ ! -e "$kernels/$1/fx_clz.c" ] || files+=("$kernels/$1/fx_clz.c")
    objects "${compiler[@]}" "-I$kernels/$1" "-I$kernels/portable" "${include[@]}" && "${compiler[@]}" -static -Wl,-z,noexecstack "${linked[@]}" -o "$B/$1" &&
        qemu-arm "$B/$1"
}

riscv() { # architecture, -cpu of QEMU: compiles $files without a C library and runs them
    local compiler=(riscv64-unknown-elf-gcc "-march=$1" -mabi=ilp32)
    files+=(tests/core/kernels/riscv/start.c firmware/bare/memory.c)
    objects "${compiler[@]}" -O2 -std=c11 -ffreestanding -fno-builtin "-I$kernels/portable" "${include[@]}" -isystem firmware/bare/include -isystem tests/core/kernels/riscv &&
        "${compiler[@]}" -static -nostdlib -Wl,--no-warn-rwx-segments "${linked[@]}" "$("${compiler[@]}" -print-libgcc-file-name)" -o "$B/$1" && qemu-riscv32 -cpu "$2" "$B/$1"
}

assembled() { # CPU, folder with the .S, name: its lines in $B/NAME.lines
    local files=(tests/core/kernels/kernel_loops.c firmware/core/fx/fx_root.c) loop
    for loop in "${loops[@]##*/}"; do
        if [ -e "$2/$loop.S" ]; then files+=("$2/$loop.S"); else files+=("$kernels/portable/$loop.c"); fi
    done
    case $1 in
    rv32) riscv "${form:-rv32imc}" "${form_of_cpu:-rv32}" >"$B/$3.lines" ;;
    *) thumb "$1" >"$B/$3.lines" ;;
    esac
}

# The loops of this computer, which has a few of its own.
vector_loops() { # folder with them, name: their lines in $B/NAME.lines
    local files=() loop
    for loop in "${loops[@]}"; do
        if [ -e "$1/${loop##*/}.c" ]; then files+=("$1/${loop##*/}.c"); else files+=("$loop.c"); fi
    done
    files+=(tests/core/kernels/kernel_loops.c firmware/core/fx/fx_root.c)
    objects cc -O2 -std=c11 "-I$1" "-I$kernels/portable" "${include[@]}" && cc "${linked[@]}" -o "$B/$2" && "$B/$2" >"$B/$2.lines"
}

same_vector_loops() { vector_loops "$kernels/x86_64" x86_64 && diff "$B/c.lines" "$B/x86_64.lines"; }

vector_change_is_seen() { # file, sed command
    rm -rf "${B:?}/changed" && cp -r "$kernels/x86_64" "$B/changed" && sed -i "$2" "$B/changed/$1" || return 1
    ! cmp -s "$B/changed/$1" "$kernels/x86_64/$1" || { echo "nothing changed" && return 1; }
    vector_loops "$B/changed" changed-lines && ! diff -q "$B/c.lines" "$B/changed-lines.lines"
}

same_loops() { assembled "$1" "$kernels/$1" "$1" && diff "$B/c.lines" "$B/$1.lines"; } # CPU

# One change in the assembly of one loop is seen, and in no other loop than those that are made of it.
change_is_seen() { # CPU, loop (or file of several), sed command, loops that are made of it (this one by default)
    local file=$2
    [[ $file == *.* ]] || file+=.S
    rm -rf "${B:?}/changed" && mkdir -p "$B/changed" && cp -r "$kernels/armv6m" "$kernels/armv7m" "$kernels/rv32" "$kernels"/*.inc "$B/changed/" || return 1
    sed -i "$3" "$B/changed/$1/$file"
    ! cmp -s "$B/changed/$1/$file" "$kernels/$1/$file" || { echo "nothing changed" && return 1; }
    assembled "$1" "$B/changed/$1" changed-lines || return 1
    [ "$(diff "$B/c.lines" "$B/changed-lines.lines" | sed -n 's/^> \([a-z_]*\) .*/\1/p' | xargs)" = "${4:-$2}" ]
}

same_frames() { # CPU
    frames_program "$B/sim-$1" CC="$cross" CFLAGS="-O2 -mthumb $core" CPU="$1" LDFLAGS="-static -Wl,-z,noexecstack" || return 1
    [ -e "$B/sim-$1/$kernels/$1/small_gouraud.o" ] || { echo "the assembly is not in it" && return 1; }
    frames qemu-arm "$B/sim-$1/pinhole-sim" >"$B/$1.frames" && diff tests/golden/frames.txt "$B/$1.frames"
}

check "the_loops_in_C_run" c_loops
for cpu in armv6m armv7m; do
    short "the_loops_for_${cpu}_leave_what_those_in_C_leave" same_loops $cpu
    long "the_frames_with_the_loops_for_${cpu}_are_the_same" same_frames $cpu
done
without=-U__ARM_FEATURE_DSP long "the_loops_for_armv7m_without_DSP_leave_the_same" same_loops armv7m
long "a_lost_fraction_in_rows_for_armv6m_is_seen" change_is_seen armv6m small_gouraud 's/add r12, r2/nop/' 'small_gouraud small_knee long_gouraud small_dithered knee_dithered long_dithered'
long "a_block_too_few_in_a_long_row_for_armv7m_is_seen" change_is_seen armv7m small_gouraud 's/lsrs r0, r1, #5/lsrs r0, r1, #6/' 'long_gouraud long_dithered'
long "four_pixels_drawn_where_two_are_hidden_for_armv6m_is_seen" change_is_seen armv6m small_gouraud 's/orrs r5, r6/tst r5, r5/' 'long_gouraud long_dithered'
long "a_pixel_lost_behind_four_for_armv6m_is_seen" change_is_seen armv6m small_gouraud 's/b pixel_15/b row_end/' 'long_gouraud long_dithered'
long "a_pair_drawn_where_it_is_hidden_for_armv7m_is_seen" change_is_seen armv7m small_gouraud 's/cmp r1, #0/cmp r1, r1/' 'small_gouraud long_gouraud small_dithered long_dithered'
long "a_row_that_is_not_cut_for_armv6m_is_seen" change_is_seen armv6m small_gouraud 's/lsrs r3, r3, #1/lsrs r3, r3, #2/' 'long_gouraud long_dithered'
long "a_step_of_dithered_light_forgotten_for_armv6m_is_seen" change_is_seen armv6m small_dithered 's/LIGHT_DOWN 22/LIGHT_DOWN 25/'
long "a_knee_forgotten_for_armv7m_is_seen" change_is_seen armv7m small_gouraud 's/movhs r0, #0/movhs r0, r0/' 'small_knee knee_dithered'
long "a_lower_edge_on_the_wrong_side_of_colours_for_armv6m_is_seen" change_is_seen armv6m small_colours 's/lsls r3, r3, #2/movs r3, #0/'
long "a_reciprocal_a_bit_off_for_armv6m_is_seen" change_is_seen armv6m setup_small 's/asrs r7, r7, #17/asrs r7, r7, #16/'
long "half_the_light_for_armv7m_is_seen" change_is_seen armv7m setup_small 's/sub r12, r10, #17/sub r12, r10, #16/'
long "a_corner_of_another_octave_for_armv7m_is_seen" change_is_seen armv7m setup_small 's/rsb r9, r7, #31/rsb r9, r7, #30/'
long "a_wider_margin_for_armv6m_is_seen" change_is_seen armv6m setup_small 's/lsls r1, r1, #1 @ two/lsls r1, r1, #2 @ two/'
without=-U__ARM_FEATURE_DSP long "a_hidden_pixel_drawn_for_armv7m_is_seen" change_is_seen armv7m span_flat 's/bhs 1f/bhi 1f/'
long "a_hidden_pair_drawn_for_armv7m_is_seen" change_is_seen armv7m span_flat 's/usub16 r12, r12, lr/usub16 r12, lr, r12/'
long "a_blend_without_its_rest_for_armv6m_is_seen" change_is_seen armv6m span_blend 's/muls r6, r5/nop/'
long "a_blend_of_what_is_hidden_for_armv7m_is_seen" change_is_seen armv7m span_blend 's/bhs 2f/bhi 2f/'
long "a_mix_with_the_half_of_other_channels_for_armv6m_is_seen" change_is_seen armv6m pairs_mix 's/add r6, r10/add r6, r9/'
long "a_green_that_is_not_full_for_armv6m_is_seen" change_is_seen armv6m pairs_add 's/lsrs r7, r5, #5/lsrs r7, r5, #6/'
long "a_green_over_31_for_armv6m_is_seen" change_is_seen armv6m pairs_times 's/round r10, r7, 6/round r10, r7, 5/'
long "an_odd_pixel_forgotten_for_armv6m_is_seen" change_is_seen armv6m span_seen 's/bpl 2f/b 2f/'
long "a_last_pixel_without_fog_for_armv6m_is_seen" change_is_seen armv6m fog_alike 's/lsls r7, r7, #31/movs r7, #0/'
long "a_hidden_pixel_of_a_line_for_armv6m_is_seen" change_is_seen armv6m line_pixels 's/bls 1f/blo 1f/'
long "a_sample_counted_twice_for_armv6m_is_seen" change_is_seen armv6m halve 's/cmp r4, r6/cmp r4, r4/'
long "a_fourth_pixel_of_two_colours_for_armv7m_is_seen" change_is_seen armv7m halve 's/cmpeq r7, r7, ror #16/cmpeq r7, r7/'
long "a_texel_beside_for_armv7m_is_seen" change_is_seen armv7m texture_tile 's/r6, r10, r11, r0, r1$/r10, r6, r11, r0, r1/'
long "a_lower_edge_on_the_wrong_side_for_armv6m_is_seen" change_is_seen armv6m texture_small 's/^    bne 3f/    beq 3f/'
long "a_bend_lost_for_armv7m_is_seen" change_is_seen armv7m texture_small 's/mla r12, r12, r0, r4/mov r12, r4/'
long "texels_too_bright_for_armv6m_are_seen" change_is_seen armv6m texel_row_lit 's/lsrs r5, r5, #24/lsrs r5, r5, #23/' 'texel_row_lit texel_run_rows'
long "a_pixel_lost_before_a_hidden_one_for_armv6m_is_seen" change_is_seen armv6m texel_row_lit 's/^    forget 1/    forget 0/' 'texel_row_lit texel_run_rows'
long "a_texel_beyond_the_border_for_armv6m_is_seen" change_is_seen armv6m texel_row_smooth 's/subs r4, r6, r2/subs r4, r6, r5/' 'texel_row_smooth texel_row_smooth_lit texel_run_rows'
long "a_row_that_leaves_a_repeat_unnoticed_for_armv6m_is_seen" change_is_seen armv6m texel_smooth.inc 's/adds r2, r2, r7/nop/' 'texel_row_smooth texel_row_smooth_lit'
long "light_of_other_pixels_for_armv7m_is_seen" change_is_seen armv7m texel_row_lit 's/adds r7, r6, #1/adds r7, r6, #2/' 'texel_row_lit texel_run_rows'
long "a_highlight_that_is_drawn_for_armv6m_is_seen" change_is_seen armv6m texel_run_rows 's/^    movs r0, #33/    movs r0, #34/'
long "a_lit_row_in_the_light_of_another_for_armv6m_is_seen" change_is_seen armv6m texel_run_rows 's/^    str r2, .sp, #level.$/    str r4, [sp, #level]/'
long "light_of_a_row_beside_for_armv7m_is_seen" change_is_seen armv7m texel_run_rows 's/^    mla r4, r5, r6, r4/    mov r4, r4/'
long "a_half_lost_in_vertices_for_armv6m_is_seen" change_is_seen armv6m vertices 's/^    bcs 2f/    b 2f/'
long "a_reciprocal_one_too_large_for_armv7m_is_seen" change_is_seen armv7m vertices 's/subcs r5, r5, r6, lsr #31/movcs r5, r5/'
long "a_triangle_on_edge_that_is_drawn_for_armv6m_is_seen" change_is_seen armv6m cull 's/bmi found/ble found/'
long "a_clip_plane_forgotten_for_armv7m_is_seen" change_is_seen armv7m cull 's/tst r6, #0x3f/tst r6, #0x1f/'
long "a_carry_lost_in_a_product_for_armv6m_is_seen" change_is_seen armv6m fx_mul 's/adds r2, r0$/nop/'
long "a_pixel_too_few_for_armv6m_is_seen" change_is_seen armv6m fill 's/lsls r2, r2, #30/movs r2, #0/'
short "the_loops_for_rv32_leave_what_those_in_C_leave" same_loops rv32
form=rv32imac_zba_zbb_zbkb form_of_cpu=rv32,zba=true,zbb=true,zbkb=true long "the_loops_for_rv32_with_Zba_Zbb_Zbkb_leave_the_same" same_loops rv32
long "a_hidden_pixel_drawn_for_rv32_is_seen" change_is_seen rv32 span_flat 's/bgeu t0, t1, 1f/bgtu t0, t1, 1f/'
long "a_lost_edge_for_rv32_is_seen" change_is_seen rv32 small_gouraud 's/beqz a0, done/j done/' 'small_gouraud small_knee long_gouraud small_dithered knee_dithered long_dithered'
long "a_row_that_is_not_cut_for_rv32_is_seen" change_is_seen rv32 small_gouraud 's/srli s10, a3, 1/srli s10, a3, 2/' 'long_gouraud long_dithered'
long "a_knee_forgotten_for_rv32_is_seen" change_is_seen rv32 small_gouraud 's/add t1, t1, t3/nop/' 'small_knee knee_dithered'
long "green_of_another_row_for_rv32_is_seen" change_is_seen rv32 small_colours 's/add a0, a0, s11/nop/'
long "a_sample_counted_twice_for_rv32_is_seen" change_is_seen rv32 halve 's/turn t3, t1/mv t3, t1/'
long "a_pixel_of_two_colours_for_rv32_is_seen" change_is_seen rv32 halve 's/bne t0, t2, mean_/bne t0, t0, mean_/'
long "a_texel_beside_for_rv32_is_seen" change_is_seen rv32 texture_tile 's/ori t4, t0, 1$/ori t4, t0, 3/'
long "a_texture_that_is_not_clamped_for_rv32_is_seen" change_is_seen rv32 texture_tile 's/bnez t4, clamped/bltz t4, inside/'
long "a_bend_lost_for_rv32_is_seen" change_is_seen rv32 texture_small 's/slli s10, s10, 2/slli s10, s10, 1/'
long "a_carry_lost_in_vertices_for_rv32_is_seen" change_is_seen rv32 vertices 's/andi \\to, \\to, 15/andi \\to, \\to, 1/'
long "a_reciprocal_one_too_large_for_rv32_is_seen" change_is_seen rv32 vertices 's/bgez t2, 1f/j 1f/'
long "half_the_light_for_rv32_is_seen" change_is_seen rv32 setup_small 's/addi a1, t6, -17/addi a1, t6, -16/'
long "a_corner_of_another_octave_for_rv32_is_seen" change_is_seen rv32 setup_small 's/xori t3, t5, 31/li t3, 29/'
long "a_triangle_on_edge_that_is_drawn_for_rv32_is_seen" change_is_seen rv32 cull 's/bltu s4, s5, found/bleu s4, s5, found/'
long "a_clip_plane_forgotten_for_rv32_is_seen" change_is_seen rv32 cull 's/andi s0, s0, 0x3f/andi s0, s0, 0x1f/'
if [ "$(uname -m)" = x86_64 ]; then
    short "the_loops_for_x86_64_leave_what_the_portable_ones_leave" same_vector_loops
    long "a_hidden_pixel_drawn_for_x86_64_is_seen" vector_change_is_seen pixels8.h 's/_mm_andnot_si128(hidden, /_mm_or_si128(hidden, /'
    long "a_last_pixel_lost_for_x86_64_is_seen" vector_change_is_seen gouraud8.h 's/switch (n & 7)/switch (n \& 3)/'
    long "half_the_green_of_a_mean_for_x86_64_is_seen" vector_change_is_seen halve.c 's/_mm_slli_epi16(green, 13)/_mm_setzero_si128()/'
    long "a_sample_left_out_of_a_mean_for_x86_64_is_seen" vector_change_is_seen halve.c 's/lower + 2 \* at/lower + at/'
    long "a_texel_beside_for_x86_64_is_seen" vector_change_is_seen texels2.h 's/((uint64_t)1 << 26 | 1)/((uint64_t)1 << 27 | 1)/'
    long "a_bend_lost_for_x86_64_is_seen" vector_change_is_seen texels2_row.h 's/{2 \* bend, 0}/{0, 0}/'
    long "a_knee_forgotten_for_x86_64_is_seen" vector_change_is_seen texture_small.c 's/d < knee ? 2 \* gd : gd/gd/'
    long "another_texel_light_for_x86_64_is_seen" vector_change_is_seen texel_run_rows.c 's/level >> 5/level >> 6/'
    long "a_row_too_bright_for_x86_64_is_seen" vector_change_is_seen small_rows.h 's/_mm_extract_epi16(at, 5) >> 9/_mm_extract_epi16(at, 5) >> 8/'
else
    skip "the_loops_for_x86_64_leave_what_the_portable_ones_leave" "this computer is none"
fi
tap_end
