#!/usr/bin/env bash
# What an RP2040 image makes of flash chips (host-sim/emulate/rp2040/flash_chips.mjs): each is read by the fastest read that it
# tells of and that is safe, and shows the same frames. The model of the SSI objects to what silicon would disregard.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export LONG=1
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
rp2040_here
board=pico-display

builds() { make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" && image "$board" 1 && expect "$board" 2; }

is_read_by() { # chip, command, divider
    emulate "$board" 1 2 - --flash "$1" && same 2 && read_by "$2" "$3" 47
}

read_by() { # command, divider, units of the crystal's start-up; in $dir/log
    grep -qx "emulate: flash is read by $1, divider $2, delay 1; the crystal had $3 x 256 cycles to start" "$dir/log" || { tail -n 5 "$dir/log" && return 1; }
}

# A small image: its main() is $dir/$1.c; files that stand in for those of the board's image: flash.c, board.c, cores2.c.
bare() { # name, file...
    local name=$1 flags="-std=c11 -mcpu=cortex-m0plus -mthumb -O2 -ffreestanding -ffunction-sections -fdata-sections" file others=()
    rm -f "$dir/$1"-*.o
    shift
    for file in "$dir/$name.c" "$@"; do
        # shellcheck disable=SC2086 # a flag a word
        arm-none-eabi-gcc $flags -Ihal -Ihal/rp2040 -Iboards -c "$file" -o "$dir/$name-$(basename "${file%.*}").o" || return 1
        others+=(! -path "*/$(basename "${file%.*}").o")
    done
    [[ $* != *cores2.c* ]] || others+=(! -name one_core.o)
    # shellcheck disable=SC2046,SC2086
    arm-none-eabi-gcc $flags -nostartfiles -L hal/rp2040 -L "$B/firmware/$board-objects/cores1" -T hal/rp2040/rp2040.ld -Wl,--gc-sections -Wl,--defsym=stack_bytes=6656,--defsym=stack_core1_bytes=0 \
        -o "$dir/$name.elf" "$dir/$name"-*.o $(find "$B/firmware/$board-objects/hal" "$B/firmware/$board-objects/boards" "$B/firmware/$board-objects/firmware/bare" -name '*.o' "${others[@]}") \
        "$B/firmware/$board-objects/board_here.o" --specs=nano.specs &&
        hal/rp2040/boot2_seal.sh cc arm-none-eabi- "$dir/$name.elf" && arm-none-eabi-objcopy -O binary "$dir/$name.elf" "$dir/$name.bin"
}

run_bare() { # name, chip, cores
    EVENTS_ONLY=1 BOARD=$board CORES=${3-1} host-sim/emulate/emulate_rp2.sh "$dir/$1.elf" "$dir/out" 1 --flash "$2" --limit-ms 2000 >/dev/null 2>"$dir/log"
}

ends() { printf '#include "port.h"\nint main(void) { return 0; }\n' >"$dir/$1.c"; }

# Tells what it measured of the flash, twice, and whether the stack's paint is there again: id, command, divider, delay, good delays.
measuring() {
    cat >"$dir/measure.c" <<'EOT'
#include "port.h"
#include "chips/rp2/flash.h"
static void put(uint32_t value, int digits)
{
    char text[10] = " ";
    for (int i = 0; i < digits; i++) { text[1 + i] = "0123456789abcdef"[value >> 4 * (digits - 1 - i) & 15]; }
    text[1 + digits] = '\0';
    port_log(text);
}
int main(void)
{
    for (int i = 0; i < 2; i++) {
        struct rp2_flash_facts f;
        rp2_flash_measure(&f);
        put((uint32_t)f.id[0] << 16 | (uint32_t)f.id[1] << 8 | f.id[2], 6);
        put(f.command, 2), put(f.divider, 1), put(f.delay, 1), put(f.good_delays, 2);
        port_log(port_stack_used() < 2048 ? " dry\r\n" : " wet\r\n");
    }
    return 0;
}
EOT
}

# Delays: with divider 2 only one is right both when everything is as slow as can be and when it is as fast as can be.
measures() { # cores, chip, what is told
    local second=()
    [ "$1" = 1 ] || second=(hal/chips/rp2/cores2.c)
    measuring && bare measure "${second[@]}" && run_bare measure "$2" "$1" || return 1
    { [ "$(tr -d '\r' <"$dir/log" | grep -cx " $3 dry")" = 2 ] && grep -qx 'emulate: ended in frame -1: exit' "$dir/log"; } || { cat "$dir/log" && return 1; }
}

as_its_board_says() { # what is added to board.c, command, divider, units of the crystal's start-up
    sed "s/    .band_height/    $1,\n&/" "boards/$board/board.c" | sed "s:families/:$PWD/boards/families/:" >"$dir/board.c" && ends says && bare says "$dir/board.c" && run_bare says w25q16jv || return 1
    grep -qx 'emulate: ended in frame -1: exit' "$dir/log" && read_by "$2" "$3" "$4"
}

# What would wear a flash, or read it wrongly, is seen: flash.c or boot2.S with a fault, on a chip.
objects_to() { # chip, pattern in the emulator's line, file, sed expression
    sed "$4" "hal/rp2040/$3" >"$dir/$3" || return 1
    ! cmp -s "hal/rp2040/$3" "$dir/$3" || { echo "nothing is changed" && return 1; }
    ends seeded && bare seeded "$dir/$3" || return 1
    run_bare seeded "$1" && echo "nobody objects" && return 1
    grep -q "^emulate: at .*$2" "$dir/log" || { cat "$dir/log" && return 1; }
}

runs_from_ram_alone() { # while it sets flash up: .once calls nothing outside, and has no word of flash
    measuring && bare measure || return 1
    local from to
    read -r from to < <(arm-none-eabi-nm "$dir/measure.elf" | awk '$3 == "ld_stack" { a = $1 } $3 == "ld_once_end" { b = $1 } END { print a, b }')
    [ $((0x$to - 0x$from)) -gt 800 ] || return 1
    arm-none-eabi-objdump -d -j .once "$dir/measure.elf" >"$dir/once" && grep -q '<probe>:' "$dir/once" &&
        ! grep -E '[[:space:]](blx?|b(\.[nw])?)[[:space:]]+1[0-9a-f]{7}|_veneer|\.word[[:space:]]+0x1[01]' "$dir/once"
}

check "images_are_built" builds
long "a_W25Q_is_read_on_four_lines_at_half_the_clock" is_read_by w25q16jv EBh 2
long "one_whose_QE_is_clear_too" is_read_by w25q16jv-im EBh 2
long "a_clone_of_GigaDevice_is_read_on_four_lines_at_a_quarter" is_read_by gd25q16c EBh 4
long "one_that_takes_no_read_without_a_command_is_read_by_6Bh" is_read_by zb25vq16 6Bh 4
long "one_that_tells_nothing_is_read_by_03h" is_read_by plain 3h 4
long "QE_by_two_bytes_of_status" is_read_by xm25qh16 EBh 4
long "QE_by_a_command_of_its_own" is_read_by p25q16h EBh 4
long "QE_in_the_first_register" is_read_by is25lp016 EBh 4
long "no_QE" is_read_by no-qe EBh 4
long "data_alone_on_four_lines" is_read_by output-only 6Bh 4
long "a_QE_that_would_wear_is_left_alone" is_read_by qe-wears 3h 4
long "and_used_where_it_is_set" is_read_by qe-is-set EBh 4
long "a_table_without_QE_of_an_unknown_maker" is_read_by short-table 3h 4
long "a_table_that_is_wrong_is_found_out" is_read_by liar 3h 4
long "Winbond_without_four_lines" is_read_by w25x16 3h 4
long "the_facts_of_a_W25Q_are_measured_and_flash_is_as_before" measures 1 w25q16jv 'ef4015 eb 2 1 02'
long "with_two_cores_too" measures 2 w25q16jv 'ef4015 eb 2 1 02'
long "those_of_a_clone" measures 1 gd25q16c 'c84015 eb 4 1 07'
long "those_of_one_that_tells_nothing" measures 1 plain '1f4601 03 4 1 07'
long "what_sets_flash_up_runs_from_RAM_alone" runs_from_ram_alone
long "a_board_may_say_half_the_clock" as_its_board_says '.flash = BOARD_FLASH_HALF' EBh 4 47
long "a_board_may_say_command_03h" as_its_board_says '.flash = BOARD_FLASH_SERIAL' 3h 4 47
long "a_board_may_say_how_long_its_crystal_takes" as_its_board_says '.crystal_start_ms = 64' EBh 2 3008
long "a_status_that_wears_is_seen" objects_to xm25qh16 'written for good' flash.c 's/transfer(0x50, 0, 1)/transfer(0x06, 0, 1)/'
long "a_status_without_50h_is_seen" objects_to xm25qh16 'without 50h before' flash.c 's/transfer(0x50, 0, 1);//'
long "one_byte_of_status_is_seen" objects_to xm25qh16 '1 bytes of status' flash.c 's/<< 16, 3)/<< 16, 2)/'
long "wrong_dummy_clocks_are_seen" objects_to gd25q16c 'takes 4 dummy clocks after EBh' flash.c 's/DUMMY(reads \& 31)/DUMMY((reads \& 31) + 1)/'
long "a_read_before_QE_is_seen" objects_to gd25q16c 'EBh while its bit QE is 0' flash.c 's/ \&\& enable_quad(table, words)//'
long "a_delay_set_while_on_is_seen" objects_to gd25q16c 'RX_SAMPLE_DLY is written while SSIENR is 1' flash.c 's/    REG(SSI_SSIENR) = 0;.*//'
long "a_delay_that_is_too_long_is_seen" objects_to gd25q16c 'RX_SAMPLE_DLY 2' flash.c 's/REG(SSI_RX_SAMPLE_DLY) = delay/REG(SSI_RX_SAMPLE_DLY) = 2/'
long "an_odd_divider_is_seen" objects_to gd25q16c 'BAUDR is set to 5h' flash.c 's/REG(SSI_BAUDR) = divider/REG(SSI_BAUDR) = divider | 1/'
long "a_reserved_bit_of_CTRLR0_is_seen" objects_to gd25q16c 'CTRLR0 is set to' flash.c 's/REG(SSI_CTRLR0) = control/REG(SSI_CTRLR0) = control | 1U << 23/'
long "a_command_that_is_no_longer_taken_is_seen" objects_to w25q16jv 'expects' flash.c 's/quad = (read \& COMMAND) == 0/quad = false/'
long "a_boot_stage_that_wears_the_status_is_seen" objects_to w25q16jv-im 'written for good' boot2.S 's/movs r0, #0x50/movs r0, #0x06/'
long "a_boot_stage_that_reads_before_QE_is_seen" objects_to w25q16jv-im 'EBh while its bit QE is 0' boot2.S '/bne quad/s/bne/b/'
tap_end
