#!/bin/sh
# Usage: firmware/tools/stack.sh IMAGE OBJECTS MAIN EXTRA
# Prints the bytes of stack that an image needs: those of the deepest path of its call graph and EXTRA, as a multiple of 64.
# OBJECTS is the folder of its objects and call graphs, which may hold the mains of several images; MAIN is this one's.
# Exits 1 if there is no bound. firmware.mk calls it; IMAGE stands in messages.
set -eu
image=$1 objects=$2 main=$3 extra=$4

# A compiler through ccache leaves no call graph when it finds the object. Without one a function would seem to need little.
lacking=$(find "$objects" -name '*.o' ! -name 'main-*' | while read -r object; do
    source=${object#"$objects/"}
    source=${source%.o}.c
    [ ! -e "$source" ] || [ -e "${object%.o}.ci" ] || echo "$source"
done | head -n 1)
[ -z "$lacking" ] || { echo "$image: no call graph of $lacking, so the stack has no bound; make clean, then CCACHE_DISABLE=1 make ..." >&2 && exit 1; }

graphs=$(find "$objects" -name '*.ci' ! -name 'main-*' && find "$objects" -name "$main.ci")
# shellcheck disable=SC2086 # one file a word
found=$(awk -v library=96 -v list=1 -f "$(dirname "$0")/stack.awk" $graphs)
if echo "$found" | grep -qv '^worst '; then
    echo "$image: the stack has no bound:" >&2
    echo "$found" | grep -v '^worst ' >&2
    exit 1
fi
echo "$found" | awk -v extra="$extra" '/^worst / { print int(($2 + extra + 63) / 64) * 64 }'
