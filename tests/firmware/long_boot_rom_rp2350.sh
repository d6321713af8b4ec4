#!/usr/bin/env bash
# The boot ROM of an RP2350 of revision A2 starts our images. Its rules are in host-sim/emulate/rp2350/rom_*.c, written from the
# datasheet (5.5, 5.9, errata E10, E13, E22) and not from what builds our images. Each UF2 file is taken by its boot loader,
# and its image draws a first frame, which is the simulator's. Files and images with one mistake are refused, and for that
# mistake.
# shellcheck disable=SC2317,SC2015,SC2034 # functions are called by check; `A && B || { cat; return 1; }` says why it fails; mistakes use variables
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
export LONG=1
. tests/firmware/emulated_rp2040.sh
unset MAKEFLAGS
export B=${B:-build} CHIP=rp2350 ISA=arm
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
command -v arm-none-eabi-gcc >/dev/null || { echo "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi" && exit 77; }
command -v riscv64-unknown-elf-gcc >/dev/null || { echo "no riscv64-unknown-elf-gcc: apt-get install gcc-riscv64-unknown-elf" && exit 77; }
make -s -j2 B="$B" "$B/pinhole-sim" "$B/pinhole-wire" "$B/rp2350-emulate" || exit 1

starts_from_uf2() { # board, cores
    image "$1" "$2" || return 1
    elf=$(elf_of "$1" "$2")
    cp "$elf" "$dir/boot.elf" && cp "${elf%.elf}.uf2" "$dir/boot.bin" && BOARD=$1 CORES=$2 host-sim/emulate/emulate_rp2.sh "$dir/boot.elf" "$dir/out" 1 >"$dir/said" 2>"$dir/log" ||
        { tail -n 5 "$dir/log" && return 1; }
    grep '^frame [0-9]* crc32' "$dir/said" >"$dir/seen"
    expect "$1" 1 && same 1
}

# ---- files with one mistake --------------------------------------------------------------------

begin() { # of the image that follows: its instruction set, cores
    ISA=$1
    whole=$(elf_of pico2-display "$2")
    whole=${whole%.elf}
    size=$(stat -c %s "$whole.bin")
    first=$(od -An -v -tx4 -w4 "$whole.bin" | awk '$1 == "ffffded3" { print 4 * (NR - 1); exit }')
    [ "$ISA" = arm ] && type=0x10210142 link=$((first + 12)) || type=0x11010142 link=$((first + 24))
    entry=$((0x$(arm-none-eabi-nm "$whole.elf" | awk '$3 == "rp2_reset" { print $1 }')))
    stack=$((0x$(arm-none-eabi-nm "$whole.elf" | awk '$3 == "ld_stack_top" { print $1 }')))
    [ "$ISA" = riscv ] || entry=$((entry | 1))
}

put() { # file, offset, words
    local word
    for word in "${@:3}"; do
        printf '\\x%02x' $((word & 255)) $((word >> 8 & 255)) $((word >> 16 & 255)) $((word >> 24 & 255))
    done | xargs -0 printf | dd of="$1" bs=1 seek="$2" conv=notrunc status=none
}

image_word() { put "$dir/bad" "$1" "${@:2}"; }                       # offset, words
in_front() { { head -c "$1" /dev/zero && cat "$whole.bin"; } >"$dir/bad"; } # bytes

# A block behind the image, to which the first one links. NEXT is where it links to; it is back to the first.
block() { # items as words
    local at=${AT:-$size}
    image_word "$link" $((at - first))
    image_word "$at" 0xffffded3 "$@" $(($# << 8 | 0xff)) $((${NEXT:-$first} - at)) 0xab123579
}

uf2_word() { put "$dir/bad" $((512 * $1 + $2)) "$3"; }                                        # block, offset, word
every_uf2_word() { for ((i = 1; i < uf2_blocks; i++)); do uf2_word "$i" "$1" "$2"; done; } # of the image

run() { "$B/rp2350-emulate" "$dir/bad" --dc 16 --cores 2 --events /dev/null "$@" >"$dir/said" 2>&1; }

refused() { # bin or uf2, line, what to change
    cp "$whole.$1" "$dir/bad" && uf2_blocks=$(($(stat -c %s "$dir/bad") / 512)) && eval "$3" && ! cmp -s "$whole.$1" "$dir/bad" || return 1
    run --frames 1 --limit-ms 1 && echo "started" && return 1
    grep -qxF -- "emulate: $2: the boot ROM would not start this image" "$dir/said" || { cat "$dir/said" && return 1; }
}

started() { # bin or uf2, what to change
    cp "$whole.$1" "$dir/bad" && eval "$2" && ! cmp -s "$whole.$1" "$dir/bad" && run --frames 1 || { cat "$dir/said" && return 1; }
}

each() { # stdin: name | bin or uf2 | the line, or "started" | what to change
    local name file line change
    while IFS='|' read -r name file line change; do
        name=${ISA}:_$(sed 's/ *$//; s/ /_/g' <<<"$name") line=$(sed 's/^ *//; s/ *$//' <<<"$line")
        if [ "$line" = started ]; then long "$name" started "${file// /}" "$change"; else long "$name" refused "${file// /}" "$line" "$change"; fi
    done
}

mistakes_of_images() {
    begin arm 2
    each <<'EOT'
a block behind the image is read          | bin | started | block $type
so are a vector table and an entry        | bin | started | block $type 0x203 0x10000000 0x344 $entry $stack
a version and an unknown item             | bin | started | block $type 0x248 0x10002 0x155
no start mark                             | bin | there is no block in the first 4 KB | image_word $first 0xfeffded3
no end mark                               | bin | a block does not end with the end mark | image_word $((first + 16)) 0xac123579
an item without a size                    | bin | an item of a block has no size | image_word $((first + 4)) 0x10210042
a last item with a wrong size             | bin | the last item of a block has a wrong size | image_word $((first + 8)) 0x2ff
no last item                              | bin | there is no block in the first 4 KB | image_word $((first + 4)) 0x1021ff42
a block beyond 4 KB                       | bin | there is no block in the first 4 KB | in_front 4096
a block that ends beyond 4 KB             | bin | the first block ends beyond the first 4 KB | in_front $((4088 - first))
the RP2040                                | bin | the image definition is for another chip | image_word $((first + 4)) 0x00210142
data                                      | bin | no block defines a program | image_word $((first + 4)) 0x10220142
a third CPU                               | bin | the image definition is for no CPU of this chip | image_word $((first + 4)) 0x12210142
Non-secure mode                           | bin | the image definition is for Non-secure mode | image_word $((first + 4)) 0x10110142
a reserved security                       | bin | the image definition has a reserved security | image_word $((first + 4)) 0x10310142
an image on trial                         | bin | the image is one to try before it is bought (TBYB), which a normal boot ignores | image_word $((first + 4)) 0x90210142
a link to no block                        | bin | a block links to an address where no block is | image_word $link 8
a link to half a word                     | bin | the link of a block is no multiple of 4 | image_word $link 6
a link to before the first block          | bin | a block links to an address before the first block | image_word $link -4
a link out of the flash                   | bin | a block links to an address outside of the flash | image_word $link 0x1000000
a second block that links to itself       | bin | a block that is not the first links to itself | NEXT=$size block $type
a loop that does not close                | bin | the blocks never lead back to the first one (erratum RP2350-E22: the ROM hangs) | AT=$((size + 32)) NEXT=$size block $type; NEXT=$((size + 32)) block $type
a second block without an end mark        | bin | a block does not end with the end mark | block $type; image_word $((size + 16)) 0
a second block without a last item        | bin | a block has no last item | block 0x1021ff42
another chip's definition before ours     | bin | the image definition is for another chip | block $type; image_word $((first + 4)) 0x00210142
one for RISC-V beside ours                | bin | started | block 0x11010142
a definition of 384 bytes                 | bin | started | block $type 0x5b55 $(seq 90); image_word $((first + 4)) 0x000001fe
... of more is ignored                    | bin | no block defines a program | block $type 0x5c55 $(seq 91); image_word $((first + 4)) 0x000001fe
vectors at a wrong alignment              | bin | the vector table has a wrong alignment | block $type 0x203 0x10000100
vectors outside of the image              | bin | the vector table lies outside of the image | block $type 0x203 0x10800000
a VECTOR_TABLE of three words             | bin | the VECTOR_TABLE item has a wrong size | block $type 0x303 0x10000000 0
an ENTRY_POINT of two words               | bin | the ENTRY_POINT item has a wrong size | block $type 0x244 $entry
an entry without the Thumb bit            | bin | the entry point is no Thumb code | block $type 0x344 $((entry - 1)) $stack
an entry outside of the image             | bin | the entry point lies outside of the image | block $type 0x344 0x10800001 $stack
a reset vector without the Thumb bit      | bin | the entry point is no Thumb code | image_word 4 $((entry - 1))
an odd stack pointer                      | bin | the stack pointer has a wrong alignment | image_word 0 $((stack + 1))
a stack pointer to half an alignment      | bin | the stack pointer has a wrong alignment | image_word 0 $((stack + 4))
a stack outside of RAM                    | bin | the stack pointer lies outside of RAM | image_word 0 0x20082008
a limit of the stack within it            | bin | started | block $type 0x444 $entry $stack 0x20000000
a limit of the stack above it             | bin | the limit of the stack lies above the stack pointer | block $type 0x444 $entry $stack $((stack + 8))
a HASH_DEF alone                          | bin | a HASH_DEF item has neither a HASH_VALUE nor a SIGNATURE | block $type 0x01000247 3
a HASH_DEF of three words                 | bin | the HASH_DEF item has a wrong size | block $type 0x01000347 3 0
a HASH_VALUE alone                        | bin | a hash or a signature has no HASH_DEF item | block $type 0x24b 1
a HASH_VALUE with an unknown hash         | bin | a hash or a signature has no HASH_DEF item | block $type 0x02000247 3 0x24b 1
a HASH_VALUE of ten words                 | bin | the HASH_VALUE item has a wrong size | block $type 0x01000247 3 0xa4b 1 2 3 4 5 6 7 8 9
a hash of more words than the block has   | bin | the hash covers more words than the block has | block $type 0x01000247 6 0x24b 1
a hash                                    | bin | the image has a hash, which is not modelled | block $type 0x01000247 3 0x24b 1
a SIGNATURE of two words                  | bin | the SIGNATURE item has a wrong size | block $type 0x01000247 3 0x01000209 1
a SIGNATURE alone                         | bin | a hash or a signature has no HASH_DEF item | block $type 0x01002109 $(seq 32)
a signature, which secure boot alone reads | bin | started | block $type 0x01000247 3 0x01002109 $(seq 32)
a LOAD_MAP of a wrong size                | bin | the LOAD_MAP item has a wrong size | block $type 0x81000506 0x10000000 0x10000000 0x10000100 0
a LOAD_MAP of two entries in one          | bin | the LOAD_MAP item has a wrong size | block $type 0x82000406 0x10000000 0x10000000 0x10000100
a LOAD_MAP at a wrong alignment           | bin | an address or a size of the load map is no multiple of 4 | block $type 0x81000406 0x10000000 0x20000002 0x20000100
a LOAD_MAP                                | bin | the image has a load map, which is not modelled | block $type 0x81000406 0x10000000 0x20000000 0x20000100
a VERSION of a wrong size                 | bin | the VERSION item has a wrong size | block $type 0x01000248 0x10000
a rollback version of 24 in one row       | bin | the rollback version has no room in its rows | block $type 0x01000348 0x10000 0x00500018
... of 23                                 | bin | started | block $type 0x01000348 0x10000 0x00500017
a window delta of a wrong size            | bin | the ROLLING_WINDOW_DELTA item has a wrong size | block $type 0x305 0 0
a window delta of 256                     | bin | the rolling window delta has a wrong alignment | block $type 0x205 256
a window delta of -4096                   | bin | the rolling window delta has a wrong alignment | block $type 0x205 -4096
a window delta of 4096                    | bin | the image has a rolling window, which is not modelled | block $type 0x205 4096
a partition table beside the image        | bin | started | block 0x0100040a 0xfc07c000 0xfc002000 0xfc060000
a partition table alone                   | bin | a partition table has no image definition beside it, and partitions are not modelled | block 0x0100040a 0xfc07c000 0xfc002000 0xfc060000; image_word $((first + 4)) 0x000001fe
a partition table of a wrong size         | bin | the partition table has a wrong size | block 0x0200040a 0xfc07c000 0xfc002000 0xfc060000
a partition table of 17 partitions        | bin | the partition table has a wrong size | block 0x1100240a $(seq 35)
a partition table with a hash             | bin | the partition table has a hash, which is not modelled | block 0x0100040a 0xfc07c000 0xfc002000 0xfc060000 0x01000247 5 0x24b 1
EOT
    begin riscv 1
    each <<'EOT'
a block behind the image is read          | bin | started | block $type 0x344 $entry $stack
one for secure mode, which Arm alone has  | bin | started | block 0x11210142 0x344 $entry $stack
a vector table, which Arm alone has       | bin | started | block $type 0x203 0x100 0x344 $entry $stack
no entry point                            | bin | without an entry point a RISC-V image starts at its first byte, and no code is there | block $type
no entry point, and Arm vectors in front  | bin | without an entry point a RISC-V image starts at its first byte, and no code is there | in_front 8; first=$((first + 8)) link=$((link + 8)) size=$((size + 8)); block $type; image_word 0 0x20082000 0x10000101
an odd entry point                        | bin | the entry point is odd | image_word $((first + 12)) $((entry + 1))
an entry outside of the image             | bin | the entry point lies outside of the image | image_word $((first + 12)) 0x20000000
a stack pointer to half an alignment      | bin | the stack pointer has a wrong alignment | image_word $((first + 16)) $((stack + 8))
a stack outside of RAM                    | bin | the stack pointer lies outside of RAM | image_word $((first + 16)) 0x20000000
EOT
}

mistakes_of_files() {
    begin arm 2
    each <<'EOT'
blocks in another order                   | uf2 | started | head -c 512 $whole.uf2 >$dir/bad; tail -c +1025 $whole.uf2 >>$dir/bad; head -c 1024 $whole.uf2 | tail -c 512 >>$dir/bad
no block against E10                      | uf2 | the UF2 file does not begin with the block against erratum RP2350-E10 | tail -c +513 $whole.uf2 >$dir/bad
one that ends the transfer                | uf2 | the UF2 file does not begin with the block against erratum RP2350-E10 | uf2_word 0 24 1
one that later revisions do not skip      | uf2 | the UF2 file does not begin with the block against erratum RP2350-E10 | uf2_word 0 288 0
one at the beginning of flash             | uf2 | the UF2 file does not begin with the block against erratum RP2350-E10 | uf2_word 0 12 0x10000000
the RP2040's family                       | uf2 | a block of the UF2 file has a family that an RP2350 ignores | every_uf2_word 28 0xe48bff56
the Non-secure family                     | uf2 | a block of the UF2 file has a family that an RP2350 ignores | every_uf2_word 28 0xe48bff5b
the family of RISC-V                      | uf2 | the UF2 file's family is not that of the image definition | every_uf2_word 28 0xe48bff5a
the family of data                        | uf2 | the UF2 file's family is not that of the image definition | every_uf2_word 28 0xe48bff58
one block of another family               | uf2 | a block of the UF2 file has another count or family than those before: what was sent is discarded | uf2_word 3 28 0xe48bff5a
one block of another count                | uf2 | a block of the UF2 file has another count or family than those before: what was sent is discarded | uf2_word 3 24 $uf2_blocks
a number beyond the count                 | uf2 | the number of a block of the UF2 file is not below their count | uf2_word 3 20 $((uf2_blocks - 1))
a number twice                            | uf2 | two blocks of the UF2 file have the same number | uf2_word 3 20 1
a block is missing                        | uf2 | blocks of the UF2 file are missing | head -c -512 $whole.uf2 >$dir/bad
the last block is cut                     | uf2 | blocks of the UF2 file are missing | head -c -1 $whole.uf2 >$dir/bad
no family                                 | uf2 | a block of the UF2 file has no family | uf2_word 2 8 0
not for the main flash                    | uf2 | a block of the UF2 file is not for the main flash | uf2_word 2 8 0x2001
a payload of 255 bytes                    | uf2 | a block of the UF2 file has no 256 bytes | uf2_word 2 16 255
a payload of 476 bytes                    | uf2 | a block of the UF2 file has no 256 bytes | uf2_word 2 16 476
an address within a page                  | uf2 | the address of a block of the UF2 file is none of a page of flash | uf2_word 2 12 0x10000180
an address in RAM                         | uf2 | the address of a block of the UF2 file is none of a page of flash | uf2_word 2 12 0x20000000
wrong magic                               | uf2 | a block of the UF2 file has wrong magic numbers | uf2_word 2 508 0
EOT
    begin riscv 1
    each <<'EOT'
the family of Arm                         | uf2 | the UF2 file's family is not that of the image definition | every_uf2_word 28 0xe48bff59
EOT
}

long "an_image_for_Arm_starts_from_its_UF2_file" starts_from_uf2 pico2-display 2
ISA=riscv
long "an_image_for_RISC-V_starts_from_its_UF2_file" starts_from_uf2 pico2-display 1
if [ -z "${LONG-}" ]; then
    mistakes_of_images
    mistakes_of_files
fi
for mk in boards/*/board.mk; do
    grep -q 'families/pico2.mk' "$mk" || continue
    board=$(basename "$(dirname "$mk")")
    for ISA in arm riscv; do
        long "${board}_starts_with_one_core_of_$ISA" starts_from_uf2 "$board" 1
        long "${board}_starts_with_two_cores_of_$ISA" starts_from_uf2 "$board" 2
    done
done
tap_end
