#!/usr/bin/env bash
# Usage: a link to this of a compiler's name, in PATH; tests/run.sh makes them.
# That compiler through ccache, which does not know of -fcallgraph-info: the call graph that gcc writes beside an object is
# kept by the checksum of the object, and comes back with it.
# Environment: CCACHE_DIR; CCACHE_PATH: where the compiler itself is.
set -u
object=
for ((i = 1; i < $#; i++)); do
    [ "${!i}" != -o ] || { ((i++)) && object=${!i}; }
done
[[ " $* " == *" -fcallgraph-info"* && $object == *.o ]] || exec ccache "${0##*/}" "$@"

graph=${object%.o}.ci
rm -f "$graph"
ccache "${0##*/}" "$@" || exit
kept=$CCACHE_DIR/graphs/$(sha256sum <"$object" | cut -d' ' -f1)
if [ -s "$graph" ]; then
    mkdir -p "$CCACHE_DIR/graphs" && cp "$graph" "$kept.$$" && mv "$kept.$$" "$kept"
elif [ -s "$kept" ]; then
    cp "$kept" "$graph"
else
    CCACHE_DISABLE=1 exec ccache "${0##*/}" "$@"
fi
