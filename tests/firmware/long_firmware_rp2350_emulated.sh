#!/usr/bin/env bash
# Images for a Pico 2 run on the emulated RP2350 (host-sim/emulate/rp2350). Frames are pinhole-sim's, byte for byte, with one
# core and with two; the wires obey the panel; requests and faults have their effect. Any complaint of the emulator fails,
# and what an image must not do is complained about. tests/firmware/long_firmware_rp2350.sh takes every board.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/firmware/emulated_rp2040.sh
. tests/firmware/rp2350_misuse.sh
unset MAKEFLAGS
export B=${B:-build} CHIP=rp2350
# shellcheck disable=SC2034 # of rp2350_misuse.sh
misuse_options=(--free-flash) # a line of flash takes longer than the words of the bus
board=pico2-display
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v riscv64-unknown-elf-gcc >/dev/null || { echo "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf" && exit 77; }

builds() { make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" "$B/rp2350-emulate" && image "$board" 1 && image "$board" 2 && ISA=riscv image "$board" 1 && ISA=riscv image "$board" 2; }

every_demo() { # cores
    sweep 2
    emulate "$board" "$1" $((2 * demos)) "$dir/keys" && expect "$board" $((2 * demos)) "$dir/keys" && same $((2 * demos)) || return 1
    [ "$1" != 1 ] || cp "$dir/log" "$dir/every.log"
}

any_delays() { # each frame has delays of its own between the cores. By hand a thousand: FRAMES=1000 SEED=1
    local frames
    sweep 2
    frames=${FRAMES:-$((2 * demos))}
    [ "$frames" -le $((2 * demos)) ] || sweep $((frames / demos))
    awk -v frames="$frames" '$1 < frames' "$dir/keys" >"$dir/some"
    emulate "$board" 2 "$frames" "$dir/some" --delays "${SEED:-1}" --limit-ms 1000000 && expect "$board" "$frames" "$dir/some" && same "$frames"
}

both_cores_work() { # the second one a tenth of the time at least
    awk '{ load += $6 } END { print "# core 1: " load / NR " %"; exit !(load / NR >= 10) }' "$dir/out/report"
}

# Two demos with one core, as `make speed` measures them, are as in the table of tests/bench/README.md.
speed_is_that_of_the_paper() { CORES=1 speed_agrees 2 "$board" 6 turntable pinhole; }

another_speed_is_seen() { # 4 % more
    awk -F, -v OFS=, 'NR > 1 { $3 *= 1.04 } { print }' "$B/speed/$board.csv" >"$dir/faster"
    speed_as_in tests/bench/README.md 2 <"$B/speed/$board.csv" && ! speed_as_in tests/bench/README.md 2 <"$dir/faster"
}

# ---- mistakes: tests/firmware/rp2350_misuse.sh has the small images that make them -----------------

moves_dc() { # "" or the lines that wait for the last bit
    misuse_image <<EOT || return 1
    store 0xd0000018, 0x10000            @ data
    store 0xd0000020, 0x20000            @ selected
    send 0x55
$1
    store 0xd0000020, 0x10000            @ a command
    send 0
1:  ldr r0, =0x4008000c
    ldr r0, [r0]
    lsls r0, r0, #27
    bmi 1b
EOT
    misuse_run || return 1
    "$B/pinhole-wire" --board "$board" "$dir/misuse.events" >"$dir/said" 2>&1
    grep -q ': D/C moved during a transfer of 1 bytes' "$dir/said"
}

dc_in_mid_word_is_caught() {
    moves_dc '' && ! moves_dc '0:  ldr r0, =0x4008000c; ldr r0, [r0]; lsls r0, r0, #27; bmi 0b' && grep -q 'frame -1: exit' "$dir/misuse.log" ||
        { cat "$dir/said" "$dir/misuse.log" && return 1; }
}

dma_of_100_bytes='store 0x50000000, 0x20000000; store 0x50000004, 0x40080008; store 0x50000008, 100; store 0x5000000c, 0x300011'

check "images_are_within_their_budgets" builds
check "every_demo_is_the_simulators" every_demo 1
check "two_cores_draw_the_same" every_demo 2
check "both_cores_work" both_cores_work
check "they_do_with_any_delays_between_them" any_delays
check "the_speed_is_that_of_the_paper" speed_is_that_of_the_paper
check "another_speed_than_that_of_the_paper_is_seen" another_speed_is_seen
export ISA=riscv
check "on_the_Hazard3_every_demo_is_the_simulators" every_demo 1
check "its_two_cores_draw_the_same" every_demo 2
check "both_of_them_work" both_cores_work
check "and_do_with_any_delays_between_them" any_delays
unset ISA
check "an_image_without_mistakes_works" works <<<"send 1; $dma_of_100_bytes"
check "D_C_that_moves_in_mid_word_is_caught" dc_in_mid_word_is_caught
# ---- what the emulator itself objects to ------------------------------------------------------------
crystal='store 0x4004800c, 47; store 0x40048000, 0xfabaa0; 7: see 0x40048004; lsls r1, r1, #1; bcc 7b'
pll="$crystal; store 0x40050008, 125; store 0x40053004, 0x21; 7: see 0x40050000; lsls r1, r1, #1; bcc 7b
     store 0x4005000c, 0x42000; store 0x40053004, 8"
check "a_clock_over_the_limit" complains "over the chip's 150" <<<"$pll; store 0x4001303c, 1; see 0x40010044; store 0x4001303c, 0x40; store 0x4001203c, 1"
check "an_isolated_pad" complains 'pin 0 is driven, but its pad is isolated' <<<'store 0x40028004, 5; store 0xd0000038, 1; store 0xd0000018, 1'
check "a_bus_without_pins" complains 'SPI0 sends, but no pin carries' <<<'store 0x40028094, 5; send 1'
check "a_DMA_channel_that_works" complains 'DMA channel 0 is set up while it works' <<<"$dma_of_100_bytes; store 0x50000000, 0x20000000"
check "a_DMA_from_nowhere" complains 'the DMA reads 1 bytes at 30000000' <<<"${dma_of_100_bytes/0x20000000/0x30000000}"
check "an_address_where_nothing_is" complains 'reads 4 bytes at 30000000, where nothing is' <<<'ldr r0, =0x30000000; ldr r0, [r0]'
check "words_that_are_not_aligned" complains 'words at 20000002 with an instruction that needs them aligned' <<<'ldr r0, =0x20000002; ldmia r0, {r1, r2}'
check "a_write_into_flash" complains 'where no RAM is' <<<'store 0x10000100, 1'
check "an_empty_FIFO_between_the_cores" complains 'core 0 read an empty FIFO' <<<'ldr r0, =0xd0000058; ldr r0, [r0]'
check "a_call_of_Arm_code" complains 'which is no Thumb code' <<<'ldr r0, =0x10000000; bx r0'
# ---- and what silicon does not take: host-sim/emulate/registers -----------------------------------
check "a_PLL_out_of_its_range" complains 'PLL_SYS FBDIV_INT (40050008) = 000000a0: FBDIV_INT: the effect of a0 is not known' <<<"$crystal; store 0x40050008, 160"
check "a_PLL_whose_crystal_is_not_stable" complains 'PLL_SYS PWR (40053004) = 00000021: the crystal was not seen' <<<'store 0x40050008, 125; store 0x40053004, 0x21'
check "a_block_in_reset" complains 'SPI0 SSPCR1 (40080004) = 00000000: the block is in reset' <<<'store 0x40022000, 0x40000; store 0x40080004, 0'
check "a_block_that_may_be_in_reset" complains 'RESET_DONE was not seen' <<<'store 0x40022000, 0x40000; store 0x40023000, 0x40000; store 0x40080004, 0'
check "a_bus_that_is_off" complains 'SPI0 SSPDR (40080008) = 00000001: the unit is off' <<<'see 0x4008000c; store 0x40080004, 0; send 1'
check "a_bus_set_up_while_it_is_on" complains 'SPI0 SSPCR0 (40080000) = 0000000f: the unit is on' <<<'store 0x40080000, 15'
check "a_bus_turned_off_in_mid_word" complains 'SPI0 SSPCR1 (40080004) = 00000000: words may be on their way' <<<'send 1; store 0x40080004, 0'
check "a_word_for_a_FIFO_that_may_be_full" complains 'SPI0 SSPDR (40080008) = 00000002: the FIFO may be full' <<<'send 1; store 0x40080008, 2'
check "a_DMA_to_a_bus_that_is_off" complains 'DMA CH0_CTRL_TRIG (5000000c) = 00300011: the SPI unit is off' <<<"store 0x40080004, 0; $dma_of_100_bytes"
check "a_register_that_is_half_written" complains 'SPI0 SSPCR0 (40080000) = 40080000: it takes whole words only' <<<'ldr r0, =0x40080000; strh r0, [r0]'
check "a_register_that_no_table_has" complains 'SPI0 ? (40080014) = 00000001: no such register' <<<'store 0x40080014, 1'
check "a_watchdog_without_ticks" complains 'WATCHDOG CTRL (400da000) = 40000000: the watchdog has no tick' <<<'store 0x400da000, 0x40000000'
tap_end
