#!/usr/bin/env bash
# Projections, views and nodes are compared with three.js (npm) in 10,000 seeded cases; all are within 2 LSB of Q16.16.
# three.js is installed into the build directory; without node, npm or the registry this is skipped.
set -u
cd "$(dirname "$0")/../.." || exit 1
export B=${B:-build} CC=${CC:-cc}
dir=$B/three

packages=tests/oracle/three
. tests/support/npm.sh

eval "make -s ${make_args-} B=$B $B/libpinhole.a" && # as tests/run.sh built it
    $CC -std=c11 -O1 -Ifirmware/core/kernels/portable -Ifirmware/core tests/oracle/three/camera_dump.c "$B/libpinhole.a" -o "$dir/camera_dump" ||
    exit 1
exec node tests/oracle/three/oracle.mjs "$dir/node_modules" "$dir/camera_dump"
