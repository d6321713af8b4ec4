#!/bin/sh
# Usage: host-sim/page/kits.sh list | FOLDER BOARD...
# list prints which boards have an image that shows scenes, as an object of JSON: each with its chip. Else builds these
# boards' images of all demos, on two cores, and writes them as scripts that the page loads: FOLDER/BOARD.js, and
# FOLDER/BOARD-riscv.js for an RP2350's RISC-V cores. Each has the bytes of the board's flash, and the UF2 file that `make
# firmware` writes, packed by gzip. Environment: B (build directory).
set -eu
B=${B:-build}
facts() { # board: its family's make lines, too
    # shellcheck disable=SC2046 # words
    cat "boards/$1/board.mk" $(sed -n 's/^include //p' "boards/$1/board.mk")
}
chip_of() { facts "$1" | sed -n 's/^PORT *:*= *\(rp2[0-9]*\)$/\1/p'; }

if [ "$1" = list ]; then
    comma='{'
    for board in boards/*/board.mk; do
        board=$(basename "$(dirname "$board")")
        chip=$(chip_of "$board")
        [ -z "$chip" ] || { printf '%s"%s": "%s"' "$comma" "$board" "$chip" && comma=', '; }
    done
    echo '}'
    exit
fi

folder=$1
shift
mkdir -p "$folder"
for board; do
    case $(chip_of "$board") in
    rp2040) isas=- ;;
    rp2350) isas='arm riscv' ;;
    *) continue ;; # another chip, which has no PICOBOOT
    esac
    for isa in $isas; do
        more=
        [ "$isa" != riscv ] || more=-riscv
        make --no-print-directory B="$B" firmware BOARD="$board" CORES=2 ISA="${isa#-}" >/dev/null
        {
            printf "(globalThis.pinholeKits ??= {})['%s'] = { flash: %s, uf2: '" "$board$more" \
                "$(facts "$board" | sed -n 's/^CHIP_FLASH_BYTES *:*= *//p')"
            gzip -9n <"$B/firmware/$board-demos$more-cores2.uf2" | base64 -w 0
            echo "' };"
        } >"$folder/$board$more.js.part"
        mv "$folder/$board$more.js.part" "$folder/$board$more.js"
        echo "$folder/$board$more.js: $(wc -c <"$folder/$board$more.js") bytes"
    done
done
