#!/usr/bin/env bash
# The emulated RP2350's decoders against QEMU's: programs of random instructions leave the same registers and flags.
# SEED=n takes others. What an image's frames do not use is seen here, too.
# shellcheck disable=SC2317,SC2015,SC2086 # functions are called by check; `A && B || { cat; return 1; }` says why it fails; $rv32 is words
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export B=${B:-build}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
for tool in "arm-none-eabi-gcc gcc-arm-none-eabi" "riscv64-unknown-elf-gcc gcc-riscv64-unknown-elf" "qemu-arm qemu-user" "qemu-riscv32 qemu-user"; do
    command -v "${tool% *}" >/dev/null || { echo "no ${tool% *}: apt-get install ${tool#* }" && exit 77; }
done
make -s B="$B" "$B/rp2350-emulate" || exit 1

# Instructions: D, N, M, A are registers, I, J numbers below 32, K one below 256. Each is tried this often.
tries=40
arm='adds D,N,M;adcs D,N,M;subs D,N,M;sbcs D,N,M;rsbs D,N,M;ands D,N,M;orrs D,N,M;eors D,N,M;bics D,N,M;orns D,N,M;mvns D,M;
 adds D,N,#K;subs D,N,#K;adc.w D,N,M,lsl #I;sbcs D,N,M,asr #J;adds.w D,N,M,ror #J;rrxs D,M;eors.w D,N,M,lsr #J;
 lsls D,N,M;lsrs D,N,M;asrs D,N,M;rors D,N,M;lsls D,N,#I;lsrs D,N,#J;asrs D,N,#J;rors D,N,#J;ands D,N,#0xff000000;teq N,M;tst N,M;cmp N,M;cmn N,M;
 mul D,N,M;mla D,N,M,A;mls D,N,M,A;sdiv D,N,M;udiv D,N,M;smull D,A,N,M;umull D,A,N,M;smlal D,A,N,M;umlal D,A,N,M;umaal D,A,N,M;
 smulbb D,N,M;smultt D,N,M;smultb D,N,M;smlabt D,N,M,A;smlatt D,N,M,A;smulwb D,N,M;smlawt D,N,M,A;smlalbt D,A,N,M;smlald D,A,N,M;smlsldx D,A,N,M;
 smuad D,N,M;smuadx D,N,M;smlad D,N,M,A;smladx D,N,M,A;smusd D,N,M;smlsdx D,N,M,A;smmul D,N,M;smmulr D,N,M;smmla D,N,M,A;smmlar D,N,M,A;smmlsr D,N,M,A;
 usad8 D,N,M;usada8 D,N,M,A;sadd16 D,N,M;uadd16 D,N,M;qadd16 D,N,M;uqadd16 D,N,M;shadd16 D,N,M;uhsub16 D,N,M;ssub16 D,N,M;usub16 D,N,M;sasx D,N,M;usax D,N,M;qsax D,N,M;
 uhasx D,N,M;sadd8 D,N,M;uadd8 D,N,M;usub8 D,N,M;qsub8 D,N,M;uqsub8 D,N,M;shadd8 D,N,M;sel D,N,M;pkhbt D,N,M,lsl #I;pkhtb D,N,M,asr #J;
 qadd D,N,M;qsub D,N,M;qdadd D,N,M;qdsub D,N,M;ssat D,#J,N;usat D,#I,N;ssat D,#J,N,asr #J;usat D,#I,N,lsl #I;ssat16 D,#9,N;usat16 D,#7,N;
 sxtb D,N;sxth D,N,ror #8;uxtb D,N,ror #16;uxtah D,N,M;sxtab D,N,M,ror #24;sxtb16 D,N;uxtab16 D,N,M,ror #8;ubfx D,N,#3,#J2;sbfx D,N,#5,#J2;bfi D,N,#7,#J2;bfc D,#2,#J2;
 clz D,N;rbit D,N;rev D,N;rev16 D,N;revsh D,N;movw D,#0xK7;movt D,#0xK7;addw D,N,#K;
 ite cs\;addcs D,N,M\;subcc D,M,N;itte mi\;movmi D,N\;lslmi D,M,#3\;eorpl D,N,M;push {M}\;stl N,[sp]\;lda D,[sp]\;add sp,#4;push {M}\;stlb N,[sp]\;ldah D,[sp]\;add sp,#4;
 push {M}\;stlh N,[sp]\;ldab D,[sp]\;pop {A}\;it gt\;mulgt D,M,D;itt ls\;cmpls N,M\;addls D,#1'
riscv='add D,N,M;sub D,N,M;sll D,N,M;srl D,N,M;sra D,N,M;slt D,N,M;sltu D,N,M;xor D,N,M;or D,N,M;and D,N,M;addi D,N,K;xori D,N,-K;slti D,N,K;sltiu D,N,-K;
 slli D,N,I;srli D,N,I;srai D,N,I;lui D,0x12K;mul D,N,M;mulh D,N,M;mulhsu D,N,M;mulhu D,N,M;div D,N,M;divu D,N,M;rem D,N,M;remu D,N,M;
 sh1add D,N,M;sh2add D,N,M;sh3add D,N,M;andn D,N,M;orn D,N,M;xnor D,N,M;clz D,N;ctz D,N;cpop D,N;max D,N,M;maxu D,N,M;min D,N,M;minu D,N,M;sext.b D,N;sext.h D,N;zext.h D,N;
 rol D,N,M;ror D,N,M;rori D,N,I;orc.b D,N;rev8 D,N;bset D,N,M;bclr D,N,M;bext D,N,M;binv D,N,M;bseti D,N,I;bclri D,N,I;bexti D,N,I;binvi D,N,I;
 pack D,N,M;packh D,N,M;brev8 D,N;zip D,N;unzip D,N;mv D,N;add D,D,M;and D,D,M;sub D,D,M;xor D,D,M;or D,D,M;addi D,D,-I;andi D,D,I;srli D,D,J;srai D,D,J;slli D,D,J;li D,-K;
 bltu N,M,1f\;not D,D\;1:;bge N,M,1f\;neg D,D\;1:;bne N,M,1f\;addi D,D,3\;1:;beqz D,1f\;addi D,D,1\;1:'

# Before each instruction one register gets a number that is often near an edge; all go into a sum (r8, s2).
random_program() { # isa
    local text=$arm
    [ "$1" = arm ] || text=$riscv
    awk -v isa="$1" -v text="$text" -v tries="$tries" -v seed="${SEED:-1}" '
        function below(n) { return int(rand() * n) }
        function register() { return isa == "arm" ? "r" below(8) : "a" below(6) }
        function edge() { v = below(8); return v == 0 ? 0 : v == 1 ? 4294967295 : v == 2 ? 2147483648 : v == 3 ? 2147483647 : v == 4 ? below(64) : below(65536) * 65536 + below(65536) }
        BEGIN {
            srand(seed); gsub(/\n/, " ", text); gsub(/\\;/, "\1", text); n = split(text, code, / *; */)
            for (i = 0; i < tries * n; i++) {
                line = code[i % n + 1]
                gsub(/^ +/, "", line)
                d = register(); do { a = register() } while (a == d)
                split(line, part, "\1"); out = ""
                for (k = 1; k in part; k++) {
                    w = part[k]; split("", part2)
                    op = w; sub(/ .*/, "", op); rest = substr(w, length(op) + 1)
                    gsub(/J2/, 1 + below(25), rest); gsub(/K7/, 1000 + below(8000), rest)
                    gsub(/D/, d, rest); gsub(/A/, a, rest); gsub(/N/, register(), rest); gsub(/M/, register(), rest)
                    gsub(/I/, below(isa == "arm" ? 31 : 32), rest); gsub(/J/, 1 + below(30), rest); gsub(/K/, 1 + below(200), rest)
                    out = out op rest "\n"; delete part[k]
                }
                if (isa == "arm") { printf "ldr %s, =%.0f\n%smrs r9, apsr\nand r9, r9, r10\neor r8, r8, r9\nadd r8, r8, %s\neor r8, r8, %s, ror #7\nror r8, r8, #27\n", register(), edge(), out, d, a }
                else { printf "li %s, %.0f\n%sadd s2, s2, %s\nslli s3, s2, 5\nsrli s2, s2, 27\nor s2, s2, s3\nadd s2, s2, %s\n", register(), edge(), out, d, a }
                if (isa == "arm" && i % 20 == 19) { print "b 9f\n.ltorg\n9:" }
            }
        }'
}

# QEMU writes the sum to its output; the chip has no output, so its bus sends it.
on_qemu() { # isa
    if [ "$1" = arm ]; then
        { echo '.syntax unified; .thumb; .global _start; .thumb_func; _start: bl begin'
          echo 'ldr r1, =sum; str r8, [r1]; mov r0, #1; mov r2, #4; mov r7, #4; svc 0; mov r0, #0; mov r7, #1; svc 0; .ltorg; .bss; sum: .word 0; .text'
          cat "$dir/arm.S"; } >"$dir/qemu.S"
        arm-none-eabi-gcc -march=armv7ve -mthumb -Wa,-march=armv8-a,-mno-warn-deprecated -nostdlib -o "$dir/qemu.elf" "$dir/qemu.S" && qemu-arm -cpu max "$dir/qemu.elf" >"$dir/bytes"
    else
        { echo '.global _start; _start: jal begin'
          echo 'la a1, sum; sw s2, 0(a1); li a0, 1; li a2, 4; li a7, 64; ecall; li a0, 0; li a7, 93; ecall; .bss; sum: .word 0; .text'
          cat "$dir/riscv.S"; } >"$dir/qemu.S"
        riscv64-unknown-elf-gcc $rv32 -nostdlib -o "$dir/qemu.elf" "$dir/qemu.S" && qemu-riscv32 -cpu rv32,zba=true,zbb=true,zbs=true,zbkb=true "$dir/qemu.elf" >"$dir/bytes"
    fi || return 1
    od -An -v -tx1 "$dir/bytes" | tr -d ' \n'
}

rv32='-march=rv32imac_zicsr_zba_zbb_zbs_zbkb -mabi=ilp32'
# clk_peri, then out of reset: pins, pads, SPI0; RESET_DONE is read between these and the pads, functions and bus.
resets='0x40010048 0x800 0x40023000 0x40240'
registers='0x4003804c 0x52 0x40038050 0x52 0x40028094 1 0x4002809c 1 0x40080010 2 0x40080000 7 0x40080004 2'

on_the_chip() { # isa
    if [ "$1" = arm ]; then
        { echo '.syntax unified; .thumb; .word 0x20010000, _start + 1; .fill 66, 4, 0; .word 0xffffded3, 0x10210142, 0x1ff, 0, 0xab123579; .thumb_func; _start:'
          printf 'ldr r0, =%s; ldr r1, =%s; str r1, [r0]\n' $resets
          echo 'ldr r0, =0x40020008; ldr r0, [r0]'
          printf 'ldr r0, =%s; ldr r1, =%s; str r1, [r0]\n' $registers
          echo 'bl begin; ldr r1, =0x40080008; .rept 4; ldr r0, [r1, #4]; uxtb r0, r8; str r0, [r1]; lsr r8, #8; .endr; 8: ldr r0, [r1, #4]; lsls r0, #27; bmi 8b'
          echo 'ldr r0, =0x18; ldr r1, =0x20026; bkpt 0xab; .ltorg'; cat "$dir/arm.S"; } >"$dir/chip.S"
        arm-none-eabi-gcc -mcpu=cortex-m33 -mthumb -nostdlib -Wl,-Ttext=0x10000000,-e0 -o "$dir/chip.elf" "$dir/chip.S"
    else
        { echo '.word 0xffffded3, 0x11010142, 0x344, _start, 0x20010000, 0x4ff, 0, 0xab123579; _start:'
          printf 'li a0, %s; li a1, %s; sw a1, 0(a0)\n' $resets
          echo 'li a0, 0x40020008; lw a0, 0(a0)'
          printf 'li a0, %s; li a1, %s; sw a1, 0(a0)\n' $registers
          echo 'jal begin; li a1, 0x40080008; .rept 4; lw a0, 4(a1); andi a0, s2, 255; sw a0, 0(a1); srli s2, s2, 8; .endr; 8: lw a0, 4(a1); andi a0, a0, 16; bnez a0, 8b'
          echo 'li a0, 0x18; li a1, 0x20026; .option norvc; .balign 16; slli x0, x0, 0x1f; ebreak; srai x0, x0, 7; .option rvc'; cat "$dir/riscv.S"; } >"$dir/chip.S"
        riscv64-unknown-elf-gcc $rv32 -nostdlib -Wl,-Ttext=0x10000000,-e0 -o "$dir/chip.elf" "$dir/chip.S"
    fi || return 1
    "$([ "$1" = arm ] && echo arm-none-eabi || echo riscv64-unknown-elf)-objcopy" -O binary "$dir/chip.elf" "$dir/chip.bin" &&
        "$B/rp2350-emulate" "$dir/chip.bin" --dc 16 --cores 1 --events "$dir/events" 2>"$dir/log" || { cat "$dir/log" && return 1; }
    awk '$2 == "spi" { printf "%s", $11 }' "$dir/events"
}

makes_program() { # isa
    {
        if [ "$1" = arm ]; then echo '.thumb_func; begin: mov r11, lr; ldr r8, =0x12345678; ldr r10, =0xf80f0000; ands r0, r0, #0; b 9f; .ltorg; 9:'
        else echo 'begin: mv s4, ra; li s2, 0x12345678'; fi
        for ((i = 0; i < 8; i++)); do [ "$1" = arm ] && echo "movs r$i, #$i" || [ "$i" -gt 5 ] || echo "li a$i, $i"; done
        random_program "$1"
        if [ "$1" = arm ]; then echo 'bx r11; .ltorg'; else echo 'jr s4'; fi
    } >"$dir/$1.S"
}

same_sums() { # isa
    local qemu chip
    makes_program "$1" && qemu=$(on_qemu "$1") && chip=$(on_the_chip "$1") || { echo "$qemu $chip" && return 1; }
    echo "# QEMU $qemu, the chip $chip"
    [ ${#qemu} = 8 ] && [ "$qemu" = "$chip" ]
}

check "Cortex_M33" same_sums arm
check "Hazard3" same_sums riscv
tap_end
