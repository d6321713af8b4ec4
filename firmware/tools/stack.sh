#!/bin/sh
# Usage: firmware/tools/stack.sh IMAGE EXTRA FROM FOLDER OBJECT...
# Prints the bytes of stack that an image of these objects needs: those of the deepest path of their call graphs and EXTRA,
# as a multiple of 64. FROM: of the paths from this function (FILE:NAME), or of all (''). An object lies in FOLDER as its
# source does in the tree, and its call graph (.ci) beside it.
# Exits 1 if there is no bound. firmware.mk calls it; IMAGE stands in messages.
set -eu
image=$1 extra=$(($2)) from=$3 folder=$4
shift 4

# A compiler through ccache leaves no call graph when it finds the object. Without one a function would seem to need little.
for object; do
    shift
    source=${object#"$folder/"}
    if [ -e "${object%.o}.ci" ]; then
        set -- "$@" "${object%.o}.ci"
    elif [ ! -e "${source%.o}.S" ]; then
        echo "$image: no call graph of ${source%.o}.c, so the stack has no bound; make clean, then CCACHE_DISABLE=1 make ..." >&2
        exit 1
    fi
done

found=$(awk -v library=96 -v list=1 -v of="$from" -f "$(dirname "$0")/stack.awk" "$@")
if echo "$found" | grep -qv '^worst '; then
    echo "$image: the stack has no bound:" >&2
    echo "$found" | grep -v '^worst ' >&2
    exit 1
fi
echo "$found" | awk -v extra="$extra" '/^worst / { print int(($2 + extra + 63) / 64) * 64 }'
