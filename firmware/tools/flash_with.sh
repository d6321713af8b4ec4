#!/bin/sh
# Usage: firmware/tools/flash_with.sh HINT TOOL ARGUMENT...
# Runs a tool that writes a board's flash. If there is no such tool, one line on stderr says what to install; if it
# fails, one line gives HINT (what the board needs). `make flash` calls it.
hint=$1
shift
command -v "$1" >/dev/null || { echo "make flash: $1 is not here; apt-get install $1" >&2 && exit 1; }
"$@" || { echo "make flash: $1 failed; $hint" >&2 && exit 1; }
