#!/usr/bin/env bash
# Cameras and nodes against three.js (npm), 10,000 seeded cases, within 2 LSB of
# Q16.16. three.js is installed into the build directory; without node, npm or the registry this is skipped.
set -u
cd "$(dirname "$0")/../.." || exit 1
export B=${B:-build} CC=${CC:-cc}
dir=$B/three

command -v node >/dev/null || { echo "no node: apt-get install nodejs" && exit 77; }
mkdir -p "$dir" || exit 1
if ! cmp -s tests/oracle/three/package.json "$dir/package.json" || [ ! -e "$dir/node_modules/three/package.json" ]; then
    command -v npm >/dev/null || { echo "no npm: apt-get install npm" && exit 77; }
    rm -rf "$dir/package.json" "$dir/node_modules"
    mkdir -p "$dir/new" && cp tests/oracle/three/package.json "$dir/new/" || exit 1
    if ! timeout 120 npm install --prefix "$dir/new" --no-package-lock --ignore-scripts --no-audit --no-fund --fetch-retries=1 \
        >"$dir/npm.log" 2>&1; then
        echo "npm did not get three.js: $(grep -m1 'npm.*ERR\|npm error' "$dir/npm.log")" && exit 77
    fi
    mv "$dir/new/node_modules" "$dir/new/package.json" "$dir/" || exit 1
fi

eval "make -s ${make_args-} B=$B $B/libpinhole.a" && # as tests/run.sh built it
    $CC -std=c11 -O1 -Ifirmware/core/kernels/portable -Ifirmware/core tests/oracle/three/camera_dump.c "$B/libpinhole.a" -o "$dir/camera_dump" ||
    exit 1
exec node tests/oracle/three/oracle.mjs "$dir/node_modules" "$dir/camera_dump"
