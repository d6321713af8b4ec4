# shellcheck shell=bash disable=SC2154,SC2015
# Small images for the emulated RP2350, each with one mistake; needs B and dir (a folder for the results).
#   complains TEXT, assembler lines on stdin   the image's last lines; the emulator must object with this text
#   works                                      the same, without an objection
# misuse_options: options of the emulator for all of them.
# The image starts with the blocks that it uses out of reset, clk_peri on, SPI0 on with its pins, and D/C (GP16) an output.
# Beside instructions it has `store address, value`, `see address`, which reads, and `send value`, a word for SPI0.

misuse_options=()

misuse_image() {
    cat >"$dir/misuse.S" <<'EOT'
    .syntax unified
    .thumb
    .macro store address, value
    ldr r0, =\address
    ldr r1, =\value
    str r1, [r0]
    .endm
    .macro see, address
    ldr r0, =\address
    ldr r1, [r0]
    .endm
    .macro send, value
    see 0x4008000c                       @ TNF
    store 0x40080008, \value
    .endm
    .word 0x20010000, start + 1
    .fill 66, 4, 0
    .word 0xffffded3, 0x10210142, 0x000001ff, 0, 0xab123579
    .thumb_func
start:
    store 0x40010048, 0x800              @ clk_peri from clk_sys
    store 0x40023000, 0x4044244          @ out of reset: DMA, pins, pads, PLL_SYS, SPI0, UART0
    see 0x40020008
    store 0xd0000038, 0x30000            @ GP16, GP17: outputs
    store 0x40038044, 0x52               @ their pads, and those of GP18 and GP19
    store 0x40038048, 0x52
    store 0x4003804c, 0x52
    store 0x40038050, 0x52
    store 0x40028084, 5                  @ SIO
    store 0x4002808c, 5
    store 0x40028094, 1                  @ SPI0's clock and data
    store 0x4002809c, 1
    store 0x40080010, 2                  @ prescaler
    store 0x40080000, 7                  @ words of 8 bits
    store 0x40080024, 2                  @ DMA
    store 0x40080004, 2                  @ on
EOT
    cat - >>"$dir/misuse.S"
    echo '    ldr r0, =0x18; ldr r1, =0x20026; bkpt 0xab' >>"$dir/misuse.S"
    arm-none-eabi-gcc -mcpu=cortex-m33 -mthumb -nostdlib -Wl,-Ttext=0x10000000 -Wl,-e0 -o "$dir/misuse.elf" "$dir/misuse.S" &&
        arm-none-eabi-objcopy -O binary "$dir/misuse.elf" "$dir/misuse.bin"
}

# shellcheck disable=SC2120 # options are for tests that look at the wires
misuse_run() { "$B/rp2350-emulate" "$dir/misuse.bin" --dc 16 --select 17 --cores 1 --limit-ms 100 --events "$dir/misuse.events" "${misuse_options[@]}" "$@" 2>"$dir/misuse.log"; }

works() {
    misuse_image && misuse_run && grep -q 'frame -1: exit$' "$dir/misuse.log" || { cat "$dir/misuse.log" && return 1; }
}

complains() { # text
    misuse_image || return 1
    ! misuse_run && grep -qF -- "$1" "$dir/misuse.log" || { cat "$dir/misuse.log" && return 1; }
}
