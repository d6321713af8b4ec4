#!/bin/sh
# Usage: firmware/package/man.sh PROGRAM FILE      `make install` calls it
# Writes the program's man page, which help2man makes of its --help. Without help2man there is none, and a line says so.
set -eu
name=$(basename "$1")
case $name in
pinhole-asset) what="make a model file into a scene for a display kit" ;;
pinhole-depth) what="measure what fixed-point depth resolves" ;;
pinhole-emulate) what="run a display kit's image in an emulator" ;;
pinhole-flash) what="write an image into the flash of an RP2040" ;;
pinhole-panel) what="show 3D scenes on an SPI display" ;;
pinhole-sheet) what="put pictures on one sheet" ;;
pinhole-sim) what="draw what the glass of a display kit would show" ;;
pinhole-wire) what="decode the wires of a display kit" ;;
*) echo "man.sh: $name has no description here" >&2 && exit 1 ;;
esac
if ! command -v help2man >/dev/null; then
    echo "no man page of $name: apt-get install help2man" >&2
    exit 0
fi
help2man --no-info --name="$what" --output="$2" "$1"
