#!/usr/bin/env bash
# Usage: tests/tools/golden.sh
# Writes tests/golden/frames.txt from this build. Look at the pictures before you commit what it changed; what makes
# them right is not this file but the references in test_quality, test_raster and test_mesa. `make golden` calls it.
set -eu -o pipefail
cd "$(dirname "$0")/../.."
. tests/tools/frames.sh
mkdir -p tests/golden
frames "${B:-build}/pinhole-sim" >"${B:-build}/frames.txt"
mv "${B:-build}/frames.txt" tests/golden/frames.txt
echo "tests/golden/frames.txt: $(wc -l <tests/golden/frames.txt) frames" >&2
