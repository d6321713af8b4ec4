#!/bin/sh
# Usage: firmware/tools/link.sh IMAGE.elf IMAGE.map COMPILER ARGUMENT...
# Links IMAGE.elf.part and writes IMAGE.map. If the image does not fit the chip, one line says so instead of the linker's
# many, and no file is left. firmware.mk calls it.
elf=$1 map=$2
shift 2
said=$(mktemp) || exit 1
trap 'rm -f "$said"' EXIT
if "$@" -Wl,-Map="$map.part" -o "$elf.part" 2>"$said"; then
    cat "$said" >&2
    mv "$map.part" "$map"
    exit
fi
rm -f "$elf.part" "$map.part"
sed -n "s|.*region .\([A-Z]*\). overflowed by \([0-9]*\) bytes.*|$elf: too large for the chip: its \1 lacks \2 bytes|p" "$said" |
    grep . >&2 || cat "$said" >&2
exit 1
