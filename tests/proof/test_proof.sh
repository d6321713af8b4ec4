#!/usr/bin/env bash
# No proof is forgotten: each function of fx.h has one, and tests/README.md has the table as it is. The proofs themselves,
# and that each fails on broken code: long_proof.sh.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh

every_function_has_a_proof() {
    local f missing=0
    while read -r f; do
        cat tests/proof/cbmc_fx*.c | grep -w "$f" >/dev/null || { echo "no proof of $f in tests/proof/cbmc_fx*.c" && missing=1; }
    done < <(sed -n '/^static/d; /^inline/d; s/^[a-z].*\<\(fx_[a-z0-9_]*\)(.*/\1/p' firmware/core/fx.h firmware/core/fx_math.h)
    return "$missing"
}

table_is_in_the_readme() {
    tests/proof/proof.sh --table | diff - <(sed -n '/^| proved by/,/^$/p' tests/README.md | grep .)
}

check "every function of fx.h has a proof" every_function_has_a_proof
check "each line that Gappa's proofs are of stands in the core" tests/proof/gappa.sh lines
check "the README's table is that of the proofs" table_is_in_the_readme
tap_end
