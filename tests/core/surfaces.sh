#!/usr/bin/env bash
# Usage: tests/core/surfaces.sh
# The table of tests/README.md: how far each kind of surface is from a reference in double precision. Builds and runs the
# tests that measure it; of a kind that several of their cases measure, the worst stands there. Environment: B.
set -euo pipefail
cd "$(dirname "$0")/../.."
unset MAKEFLAGS
B=${B:-build}
programs=(test_light test_texture test_texture_light test_blended test_antialias)
make -s -j2 B="$B" "${programs[@]/#/$B/tests/core/}" >&2
printf '| surface | error | measured | at most |\n|---|---|---|---|\n'
for program in "${programs[@]}"; do
    "$B/tests/core/$program" 2>&1 || echo failed
done | awk -F ' [|] ' '
    /^failed/ { failed = 1 }
    sub(/^.*surface: /, "") {
        kind = $1 " | " $2
        if (!(kind in error)) { order[++count] = kind }
        if (!(kind in error) || $3 + 0 > error[kind]) { error[kind] = $3 + 0; row[kind] = $0 }
    }
    END {
        for (i = 1; i <= count; i++) { print "| " row[order[i]] " |" }
        exit failed || count == 0
    }'
