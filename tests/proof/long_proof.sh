#!/usr/bin/env bash
# All proofs, by module. And each line of mutants.txt breaks one thing in a copy of the core on purpose: the proof beside it
# must fail. A line that changes nothing any more fails in tests/tools/test_house.sh.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/proof/tools.sh
proof_tools || { echo "$proof_why" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

copy_broken() { # file, sed
    rm -rf "$dir/firmware" "$dir/tests" && mkdir -p "$dir/firmware" "$dir/tests" &&
        cp -r firmware/core "$dir/firmware" && cp -r tests/proof "$dir/tests" && sed -i "$2" "$dir/$1"
}

fails() { # file, sed, proof
    local said
    copy_broken "$1" "$2" || return 1
    said=$(B=$dir/build tests/proof/proof.sh --tree "$dir" "$3")
    grep -q '1 proofs, 0 proved' <<<"$said" || { echo "$said" && return 1; }
}

mkdir -p "$dir/build/proof" && ln -s "$proof_root" "$dir/build/proof/root"
for module in $(tests/proof/proof.sh --modules); do
    ! in_share || check "what_is_claimed_of_${module}_holds" tests/proof/proof.sh "$module"
done
grep -v '^#' tests/proof/mutants.txt >"$dir/mutants"
while IFS= read -r line; do
    in_share || continue
    what=${line%% | *} line=${line#* | }
    proof=${line%% | *} line=${line#* | }
    check "${proof}_sees_${what// /_}" fails "${line%% | *}" "${line#* | }" "$proof"
done <"$dir/mutants"
tap_end
