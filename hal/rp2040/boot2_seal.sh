#!/bin/sh
# Usage: boot2_seal.sh HOSTCC CROSS ELF
# Writes the checksum that the boot ROM wants into the section .boot2 of a linked image; see boot2_seal.c.
set -eu
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
"$1" -std=c11 -O1 -o "$dir/seal" "$(dirname "$0")/boot2_seal.c"
"$2objcopy" -O binary -j .boot2 "$3" "$dir/open"
"$dir/seal" <"$dir/open" >"$dir/sealed"
"$2objcopy" --update-section .boot2="$dir/sealed" "$3"
