#!/usr/bin/env bash
# The page in Chromium shows every demo on every board as pinhole-sim does: frames 0 to 3, and one from the middle. An image
# and a scene that it saves as one UF2 file are those of pinhole-flash, and run on the emulated chips.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || C` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
lacks=$(tests/host-sim/page/browser.sh --lacks) || { echo "$lacks" && exit 77; }
made=$(make -s -j2 B="$B" page "$B/pinhole-sim" "$B/pinhole-asset" "$B/pinhole-flash" 2>&1) || { echo "$made" && [[ $made = *'no compiler for WebAssembly'* ]] && exit 77 || exit 1; }
mapfile -t all < <("$B/pinhole-sim" --list | sed -n 's/^board  *\([^ ]*\).*/\1/p')
for board in "${all[@]}"; do
    ! in_share || boards+=("$board")
done
check "the page draws what pinhole-sim draws on ${boards[*]}" tests/host-sim/page/browser.sh '' '' "${boards[@]}"

try=$(mktemp -d) || exit 1
trap 'rm -rf "$try"' EXIT
uses() { tests/host-sim/page/models.sh "$try" "${all[@]}" && tests/host-sim/page/browser.sh "$try" 'looks models'; }
! in_share || check "fingers, widths and models of all kinds in the page" uses
! in_share || check "the lesson by pointer, fingers and keys, its lines of C, and what lectures ask for" tests/host-sim/page/browser.sh "$try" lessons

the_readers_memory_ends() { # at 1.5 GiB, which are 24576 pages
    node -e 'const module = new WebAssembly.Module(require("fs").readFileSync(process.argv[1])), imports = {};
        for (const { module: from, name } of WebAssembly.Module.imports(module)) { (imports[from] ??= {})[name] = () => 0; }
        const { memory } = new WebAssembly.Instance(module, imports).exports, pages = memory.buffer.byteLength / 65536;
        try { memory.grow(24577 - pages); process.exit(1); } catch { memory.grow(24576 - pages); }' "$B/wasm/model.wasm"
}
check "the memory of the worker has an end" the_readers_memory_ends

printf 'v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv 0 1 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n' >"$try/box.obj"

is_the_tools() { # image's name
    local made=$1-demos-cores2
    [[ $1 != *-riscv ]] || made=${1%-riscv}-demos-riscv-cores2
    cp "$B/firmware/$made.elf" "$try/$1.elf" && "$B/pinhole-flash" "$B/firmware/$made.uf2" --scene "$try/$1.phs" --out "$try/tool.uf2" >"$try/said" &&
        cmp "$try/tool.uf2" "$try/$1.uf2"
}

# The emulated RP2350 takes the file as its boot ROM does. For the RP2040 its blocks become the flash here.
flash_of() { # chip, UF2 file
    if [ "$1" = rp2350 ]; then cat "$2"; else
        node -e 'const uf2 = require("fs").readFileSync(process.argv[1]), flash = Buffer.alloc(1 << 21, 255);
            for (let at = 0; at < uf2.length; at += 512) { uf2.copy(flash, uf2.readUInt32LE(at + 12) - 0x10000000, at + 32, at + 288); }
            process.stdout.write(flash);' "$2"
    fi
}

runs() { # image's name, board, chip
    flash_of "$3" "$try/$1.uf2" >"$try/$1.bin" && CHIP=$3 BOARD=$2 CORES=2 host-sim/emulate/emulate_rp2.sh "$try/$1.elf" "$try/out" 3 >"$try/said" 2>&1 &&
        "$B/pinhole-sim" --model "$try/$1.phs" --board "$2" --frames 3 --crc >"$try/expected" && grep '^frame' "$try/said" | diff - "$try/expected" || { cat "$try/said" && return 1; }
}

if ! in_share; then
    tap_end
elif command -v arm-none-eabi-gcc >/dev/null && command -v riscv64-unknown-elf-gcc >/dev/null; then
    check "the kits' images are made" host-sim/page/kits.sh "$B/page/kits" pico-display pico2-display-2
    cp "$B/firmware/pico-display-demos-cores2.bin" "$try/image.bin"
    check "the part To the kit" tests/host-sim/page/browser.sh "$try" send
    while read -r image board chip; do
        check "$image: the saved file is the one that pinhole-flash writes" is_the_tools "$image"
        check "... and runs on the emulated chip" runs "$image" "$board" "$chip"
    done <<<'pico-display pico-display rp2040
pico2-display-2 pico2-display-2 rp2350
pico2-display-2-riscv pico2-display-2 rp2350'
else
    skip "the part To the kit" "no compilers for its images: apt-get install gcc-arm-none-eabi libnewlib-arm-none-eabi gcc-riscv64-unknown-elf"
fi
tap_end
