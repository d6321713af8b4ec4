#!/usr/bin/env bash
# How an RP2350's images read their flash, on the emulated chip: the fast read of a W25Q with either instruction set, the
# ROM's for a flash that tells nothing, the same frames with each; what a miss of the cache costs, and how many there are.
# What the QMI and the flash do not stand is objected to.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export LONG=1
. tests/firmware/emulated_rp2040.sh
. tests/firmware/rp2350_misuse.sh
unset MAKEFLAGS
export B=${B:-build} CHIP=rp2350 ISA
board=pico2-display
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v riscv64-unknown-elf-gcc >/dev/null || { echo "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf" && exit 77; }

builds() {
    make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" "$B/rp2350-emulate" || return 1
    for ISA in arm riscv; do
        image "$board" 1 && measuring 1 && measuring 2 || return 1
    done
}

measuring() { # cores
    make_image firmware BOARD="$board" APP=tests/firmware/rp2350_flash_cost.c CORES="$1" >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
}

# ---- how the flash is read ---------------------------------------------------------------------------

# M0_TIMING, M0_RFMT and M0_RCMD by the data sheet, 12.14.6. Ours: COOLDOWN 1, MIN_DESELECT 1, RXDELAY 2, CLKDIV; on four
# lines a suffix of 8 bits, dummy clocks of 16 bits, no prefix; mode bits A0h. The ROM's: PAGEBREAK 1024, MIN_DESELECT 7,
# RXDELAY 2, CLKDIV 3, a prefix.
four_lines=$((4 << 16 | 2 << 14 | 2 << 8 | 2 << 6 | 2 << 4 | 2 << 2))
reads_on() { printf '%08x %08x %08x' $((1 << 30 | 1 << 12 | 2 << 8 | $1)) $four_lines $((0xa0 << 8 | 0xeb)); } # CLKDIV
rom_timing=$((1 << 30 | 2 << 28 | 7 << 12 | 2 << 8 | 3))
rom_quad=$(printf '%08x %08x %08x' $rom_timing $((four_lines | 1 << 12)) $((0xeb)))
rom_dual=$(printf '%08x %08x %08x' $rom_timing $((1 << 12 | 2 << 14 | 1 << 8 | 1 << 6 | 1 << 4 | 1 << 2)) $((0xbb)))
rom_serial=$(printf '%08x %08x %08x' $rom_timing $((1 << 12 | 2 << 16)) $((0x0b)))

is_read() { # registers
    local seen
    seen=$(sed -n 's/^emulate: M0_TIMING \(.*\), M0_RFMT \(.*\), M0_RCMD \([0-9a-f]*\);.*/\1 \2 \3/p' "$dir/log")
    [ "$seen" = "$1" ] || { echo "registers $seen, not $1" && tail -n 5 "$dir/log" && return 1; }
}

draws() { # flash, registers; frames of the ISA's image
    emulate "$board" 1 3 - --flash "$1" && expect "$board" 3 && same 3 && is_read "$2"
}

# ---- what it costs ------------------------------------------------------------------------------------

run() { # cores, flash
    local elf=$B/firmware/$board-rp2350_flash_cost
    [ "$ISA" = arm ] || elf=$elf-$ISA
    [ "$1" = 1 ] || elf=$elf-cores$1
    "$B/rp2350-emulate" "$elf.bin" --dc 16 --cores "$1" --frames 1 --events /dev/null --flash "$2" 2>"$dir/log"
    tr -d '\r' <"$dir/log" >"$dir/told"
    grep -q '^emulate: ended in frame -1: exit$' "$dir/told" || { cat "$dir/told" && return 1; }
}

told() { awk -v name="$1" '$1 == name { print $2; exit }' "$dir/told"; }

# 1000 misses at 150 MHz. A read takes clocks x CLKDIV and 6 cycles; before one that does not go on, but comes within 64
# cycles, 1 cycle to release the flash, and half a clock and MIN_DESELECT until it is selected again. What goes on takes its
# 64 bits of data alone.
costs() { # flash, clocks of a read, of its data, CLKDIV, MIN_DESELECT
    run 1 "$1" && awk -v soon="$(told soon)" -v late="$(told late)" -v on="$(told next)" -v clocks="$2" -v data="$3" -v divider="$4" -v off="$5" '
        function is(what, us, cycles,    want) { want = cycles * 1000 / 150; if (us < want - 3 || us > want + 3) { print what ": " us " us, expected " want; bad = 1 } }
        BEGIN {
            is("soon", soon, clocks * divider + 6 + 1 + int((divider + 1) / 2) + off)
            is("late", late, clocks * divider + 6)
            is("next", on, data * divider + 6)
            exit bad
        }'
}

# YasOS counted 178 and 126 cycles on silicon: 36 and 28 clocks with CLKDIV 4, 27 and 7 cycles between two reads.
sum_is_silicons() { [ $((36 * 4 + 6 + 1 + 27)) = 178 ] && [ $((28 * 4 + 6 + 1 + 7)) = 126 ]; }

# Walks over as much as the cache has never miss. Over 24 KB three lines share two places, and a line that comes in throws out
# either of them: when lines a, b, c come in turns, the next one is there if that after it was thrown out, so that a hit
# follows a miss half of the time, and a miss follows each hit: 2 of 3 miss, 2048 a walk. Eight walks, to 2 %.
misses_are_those_of_two_ways() {
    run 1 ef4016,2 && [ "$(told 8KB) $(told 16KB)" = '0 0' ] && awk -v n="$(told 24KB)" 'BEGIN { want = 8 * 2048; if (n < .98 * want || n > 1.02 * want) { print n, want; exit 1 } }'
}

# Bits that change 5 to 7.5 ns behind the clock's edge are sampled at (2 + RXDELAY) / 2 cycles of 6.67 ns, and must be there
# until a period of 13.3 ns after they may change: RXDELAY 1, 2 and 3.
measures() { # cores, flash, id, divider, bits of good delays
    run "$1" "$2" && [ "$(told id) $(told command) $(told divider) $(told delay) $(told good)" = "$((0x$3)) $((0xeb)) $4 2 $5" ] || { cat "$dir/told" && return 1; }
}

good() { # CLKDIV, earliest and latest ns: bits of the delays that are right
    awk -v divider="$1" -v earliest="$2" -v latest="$3" 'BEGIN { cycle = 1000 / 150; for (d = 7; d >= 0; d--) { at = (divider + d) * cycle / 2; n = 2 * n + (at >= latest && at <= divider * cycle + earliest) } print n }'
}

as_its_board_says() { # a name, what is added to board.c, registers
    mkdir -p "$dir/$1" && cp "boards/$board/board.mk" "$dir/$1" && sed "s/    .band_height/    $2,\n&/" "boards/$board/board.c" >"$dir/$1/board.c" || return 1
    printf '#include "port.h"\nint main(void) { port_exit(0); return 0; }\n' >"$dir/$1.c"
    make_image firmware BOARD="$board" BOARD_HOME="$dir/$1" APP="$dir/$1.c" >"$dir/said" 2>&1 || { cat "$dir/said" && return 1; }
    "$B/rp2350-emulate" "$B/firmware/$board-$1.bin" --dc 16 --cores 1 --frames 1 --events /dev/null 2>"$dir/log"
    grep -q 'ended in frame -1: exit$' "$dir/log" && is_read "$3"
}

# ---- mistakes -------------------------------------------------------------------------------------------

# A program that runs from RAM, with direct mode on and the QMI idle: r4 has the QMI's address.
from_ram() { # assembler lines on stdin
    cat <<'EOT'
    adr r0, 5f; ldr r1, =0x20000000; movs r2, #0
4:  ldr r3, [r0, r2]; str r3, [r1, r2]; adds r2, #4; cmp r2, #0x200; bne 4b
    ldr r4, =0x400d0000; adds r1, #1; bx r1
    .ltorg
    .balign 4
5:  movw r1, #1; movt r1, #0x780; str r1, [r4]
6:  ldr r0, [r4]; lsls r0, #30; bmi 6b
    .macro set offset, value
    movw r1, #(\value) & 0xffff; movt r1, #(\value) >> 16; str r1, [r4, #\offset]
    .endm
    .macro settle
1:  ldr r0, [r4]; lsls r0, #30; bmi 1b
    .endm
EOT
    cat -
    echo '    movs r0, #0x18; movw r1, #0x0026; movt r1, #2; bkpt 0xab'
}

objects() { from_ram | complains "$1"; } # text; lines on stdin

reads='set 0, 0x7800000; movw r5, #0x1000; movt r5, #0x1000; ldr r0, [r5]'

check "images_are_built" builds
for ISA in arm riscv; do
    long "a_W25Q_is_read_on_at_75_MHz_$ISA" draws ef4016,2 "$(reads_on 2)"
    long "one_whose_QE_is_0_too_$ISA" draws ef7015,0 "$(reads_on 2)"
    long "one_that_keeps_QE_at_0_stays_on_two_lines_$ISA" draws ef4016,0,locked "$rom_dual"
    long "an_unknown_one_stays_as_the_ROM_left_it_$ISA" draws a14016,2 "$rom_quad"
    long "one_that_tells_so_is_read_on_at_50_MHz_$ISA" draws a14016,0,sfdp "$(reads_on 3)"
    long "one_without_four_lines_stays_on_one_$ISA" draws ef3015 "$rom_serial"
    long "a_miss_takes_56_cycles_and_what_lies_between_reads_$ISA" costs ef4016,2 28 16 2 1
    long "as_the_ROM_leaves_it_108_$ISA" costs a14016,2 36 16 3 7
    long "as_many_lines_miss_as_two_ways_cannot_hold_$ISA" misses_are_those_of_two_ways
    long "its_facts_are_measured_$ISA" measures 1 ef4016,2 ef4016 2 "$(good 2 5 7.5)"
    long "with_two_cores_too_$ISA" measures 2 ef4016,2 ef4016 2 "$(good 2 5 7.5)"
    long "and_those_of_a_slow_one_$ISA" measures 1 c84016,2,3080:10000 c84016 3 "$(good 3 3.08 10)"
done
ISA=arm
long "the_constant_is_what_silicon_has" sum_is_silicons
long "the_data_sheets_extremes_leave_3_ns" draws ef4016,2,3080:10000 "$(reads_on 2)"
long "GigaDevices_flash_is_read_on_at_50_MHz" draws c84016,0 "$(reads_on 3)"
long "a_board_may_say_half_the_clock" as_its_board_says half '.flash = BOARD_FLASH_HALF' "$(reads_on 4)"
long "a_board_may_say_command_03h" as_its_board_says serial '.flash = BOARD_FLASH_SERIAL' "$(printf '%08x %08x %08x' $((1 << 30 | 1 << 12 | 2 << 8 | 6)) $((1 << 12)) 3)"

long "a_program_without_mistakes_works" eval 'from_ram <<<"set 0, 0x7800000" | works'
long "flash_in_direct_mode" objects 'reads flash at 10001000 while the QMI is in direct mode' <<<'movw r5, #0x1000; movt r5, #0x1000; ldr r0, [r5]'
long "a_command_that_is_not_sent" objects 'flash is read without a command, which the flash expects' <<<"set 0x10, 0x482a8; $reads"
long "a_command_too_much" objects 'flash is read with a command, which the flash takes for an address' <<<"set 0x14, 0xa0eb; $reads; ldr r0, [r5, #0x800]"
long "dummy_clocks_too_few" objects 'which is not how it answers' <<<"set 0x10, 0x392a8; $reads"
crystal='store 0x4004800c, 47; store 0x40048000, 0xfabaa0; 7: see 0x40048004; lsls r1, r1, #1; bcc 7b'
at_150_mhz="$crystal; store 0x40050008, 125; store 0x40053004, 0x21; 7: see 0x40050000; lsls r1, r1, #1; bcc 7b
    store 0x4005000c, 0x52000; store 0x40053004, 8
    store 0x4001303c, 1; see 0x40010044; store 0x4001303c, 0x40; store 0x4001203c, 1"
long "a_clock_that_is_too_fast_for_the_pads" objects 'flash is read at 150.0 MHz with slow pads' <<<"$at_150_mhz; set 0x0c, 0x40000201; $reads; .ltorg"
long "a_sample_that_is_too_early" objects 'change less than 3 ns from where M0_TIMING 40000003 samples' <<<"$at_150_mhz; set 0x0c, 0x40000003; $reads; .ltorg"
long "a_reserved_bit_of_M0_TIMING" objects 'M0_TIMING (400d000c) = 40000803: bits 800 are not in the table' <<<'set 0x0c, 0x40000803'
long "a_field_that_is_not_modelled" objects 'M0_RFMT (400d0010) = 100492a8: bits 10000000 are not in the table' <<<'set 0x10, 0x100492a8'
long "a_window_that_changes_while_a_read_goes_on" objects 'M0_RFMT (400d0010) = 000482a8: flash may be read meanwhile' <<<"$reads; set 0x10, 0x482a8"
long "a_flash_that_is_selected_while_a_read_goes_on" objects 'selects or releases the flash while the QMI is busy' <<<"$reads; set 0, 0x7800005"
long "a_flash_that_is_released_too_early" objects 'selects or releases the flash while the QMI is busy' <<<'set 0, 0x7800005; set 4, 0x9f; set 0, 0x7800001'
long "a_byte_that_nobody_is_selected_for" objects 'or nothing selects the flash' <<<'set 4, 0x9f'
long "an_answer_that_is_not_there_yet" objects 'DIRECT_RX is read, but is empty' <<<'set 0, 0x7800005; set 4, 0x9f; ldr r0, [r4, #8]'
long "too_many_bytes_at_once" objects 'DIRECT_RX is full' <<<'set 0, 0x7800005; set 4, 0x9f; set 4, 0; set 4, 0; set 4, 0; set 4, 0'
long "the_second_chip_select" objects 'DIRECT_CSR (400d0000) = 07800009: bits 8 are not in the table' <<<'set 0, 0x7800009'
long "an_unknown_command" objects 'the flash got a command c7, which is not modelled' <<<'set 0, 0x7800005; set 4, 0xc7'
long "a_status_that_wears" objects 'written without 50h, or not both' <<<'set 0, 0x7800005; set 4, 1; set 4, 0; set 4, 2; settle; set 0, 0x7800001'
long "pads_that_are_off" objects 'SD[0] (40040008) = 00000156: bits 100 are not in the table' <<<"store 0x40040008, 0x156; $reads; .ltorg"
long "another_voltage" objects '(40040000) = 00000001: no such register in the table' <<<'store 0x40040000, 1; .ltorg'
long "a_window_without_a_device" objects '(400d0020) = 00000000: no such register in the table' <<<'set 0x20, 0'
long "an_address_beyond_the_flash" complains 'reads 4 bytes at 11000000, where nothing is' <<<'ldr r0, =0x11000000; ldr r0, [r0]'
tap_end
