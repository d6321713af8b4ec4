#!/bin/sh
# Usage: firmware/tools/flash_with.sh HINT TOOL ARGUMENT...
# Runs a tool that writes a board's flash. One line on stderr says what to install where the tool is not there, and HINT
# (what the board needs) where it fails. `make flash` calls it.
hint=$1
shift
command -v "$1" >/dev/null || { echo "make flash: $1 is not here; apt-get install $1" >&2 && exit 1; }
"$@" || { echo "make flash: $1 failed; $hint" >&2 && exit 1; }
