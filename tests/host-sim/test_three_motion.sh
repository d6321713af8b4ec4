#!/usr/bin/env bash
# glTF files whose nodes, skins and morph targets move are played as three.js (npm) plays them: every vertex of 80 frames,
# and of 64 files with numbers of any size five frames of each: 320 poses, right to 1/1000 of the model's radius.
# gltf-validator (npm) passes the files. Both are installed into the build directory; without node, npm or the registry
# this is skipped.
set -u
cd "$(dirname "$0")/../.." || exit 1
export B=${B:-build} CC=${CC:-cc}
dir=$B/three-motion
packages=tests/oracle/three
. tests/support/npm.sh

pkg-config --exists libpng || { echo "no libpng here" && exit 77; }
eval "make -s ${make_args-} B=$B $B/tests/oracle/three/motion_dump" || exit 1 # as tests/run.sh built it
files=()
for seed in 1 2 3; do
    node tests/oracle/three/motion_file.mjs "$dir/seed$seed.gltf" $seed || exit 1
    files+=("$dir/seed$seed.gltf")
done
for seed in {1..64}; do
    node tests/oracle/three/motion_file.mjs "$dir/far$seed.gltf" "$seed" far || exit 1
    files+=("$dir/far$seed.gltf")
done
exec node tests/oracle/three/motion.mjs "$dir/node_modules" "$B/tests/oracle/three/motion_dump" "${files[@]}"
