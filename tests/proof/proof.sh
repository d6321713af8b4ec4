#!/usr/bin/env bash
# Usage: tests/proof/proof.sh [--tree DIR] [NAME...]
# Proves what the table below claims, on the functions of the core themselves; `make proof` runs all of it. It prints a
# line a proof as it ends, and exits 1 when a claim does not hold.
#   --tree DIR  proofs of DIR/firmware and DIR/tests/proof, for copies that are broken on purpose
#   --table     prints the table of tests/README.md, and proves nothing
#   --modules   prints the names of the modules
#   NAME        only these, e.g. clip.crossing, or all of clip
#
# CBMC (cbmc_*.c; see proof.h) translates a function with all its inputs to propositional logic: no signed sum, product
# or left shift overflows, no shift is out of range, no divisor is 0, no index leaves its array, no signed value loses
# bits when it is narrowed, no loop turns more often than said, and each CLAIM holds. Unsigned arithmetic wraps modulo
# 2^32 on purpose (planes, edges, angles), and so do conversions between signed and unsigned: they are no errors. The end
# of each harness must be reachable: a proof of nothing fails.
# Gappa (gappa.sh) bounds the rounding errors of a formula over the reals.
# Environment: B (build directory), CC.
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/proof/tools.sh
export CC=${CC:-cc} proof_tree=$PWD

# name: module.proof | functions that may return anything instead, or what another one does (proved apart) |
# turns of a loop | claim
proofs() {
    cat <<'END'
fx.sums                  |                       |  1 | sums are exact or saturate
fx.products              |                       |  1 | no overflow
fx_div.div               | fx_rcp_newton         |  3 | no overflow in the turns that Gappa allows
fx.rcp                   |                       |  1 | no overflow
fx.quotient_bits         |                       | 65 | no overflow
fx.quotient_far          | fx_rcp_newton         |  1 | no overflow
fx.rcp_newton            |                       |  1 | no overflow
fx.rcp16                 |                       |  1 | 2^15 .. 2^16 - 1
fx.lerp                  |                       |  1 | no overflow
fx.turn32_from_deg       |                       |  1 | no overflow
fx.sqrt                  |                       |  3 | no overflow
fx.rsqrt                 |                       |  3 | no overflow
fx.rsqrt_norm            |                       |  3 | no overflow
fx.rsqrt16               |                       |  1 | 2^15 .. 2^16
fx.sincos                |                       |  1 | no overflow
fx.atan2                 | fx_tangent_ratio      | 13 | no overflow
fx_math.exp2             |                       | 20 | no overflow
fx_math.exp              |                       | 20 | no overflow
fx_math.sinh             |                       | 20 | no overflow
fx_math.tanh             | fx_quotient_u64       | 20 | no overflow
fx_math.arrays           |                       |  3 | no overflow
fx_math.sums             |                       | 20 | no overflow
fx_math.log2             |                       | 20 | no overflow
fx_math.log              |                       | 20 | no overflow
fx_math.pow              |                       | 20 | no overflow
fx_math.hypot            | fx_sqrt_u64           | 20 | no overflow
fx_math.units            |                       | 20 | no overflow
fx_math.cot_half         | fx_rcp_newton         | 20 | no overflow
fx_math.whole            |                       | 20 | no overflow
fx_math.convert          |                       | 20 | no overflow
fx_cut.tan               |                       | 20 | no overflow
fx_cut.fmod              |                       |  1 | no overflow
fx_cut.asin              |                       |  1 | no overflow
fx_cut.acos              |                       |  1 | no overflow
fx_cut.sqrt_u64          | fx_rsqrt_norm         |  1 | no overflow
fx_cut.quotient          | fx_rcp_newton         |  1 | no overflow
fx_text.to_text          |                       | 24 | no overflow, fits FX_TEXT_SIZE
fx_text.to_text_rounded |                     | 24 | no overflow
fx_text.from_text        |                       | 18 | no overflow, ends within the text
clip.distance            |                       |  1 | no overflow, below 2^46
clip.between             |                       |  8 | no overflow
clip.crossing            |                       | 18 | no overflow, at most 15 halvings
clip.clip_plane          | crossing,distance     | 10 | at most PH_CLIP_MAX corners
clip.clip                | crossing,distance=any_distance,clip_plane=any_corners | 10 | no index outside
frame.camera             | ph_depth_quotient,ph_depth_linear_of,ph_lens_near | 20 | no overflow, ranges of the lens
transform.project        | ph_depth_quotient     |  1 | no overflow
depth.quotient           |                       |  1 | no overflow, exponent -3 .. 31
depth.quotient_ortho     |                       |  1 | no overflow
depth.codes              |                       |  1 | no overflow
depth.w_of               |                       |  1 | no bad shift
depth.linear_of          | w_of                  |  1 | no overflow
depth.linear             |                       |  1 | no overflow
setup.sides              |                       |  4 | no overflow; small sides are short
setup.setup_edge         | wide_edge             |  1 | no overflow
setup.wide_edge          |                       |  1 | no overflow
setup.short_edge         |                       |  1 | no overflow
setup.setup_outline      | wide_edge             |  4 | no overflow, rows within the picture
setup.small_depths       | ph_float_depths,ph_block_depths | 4 | no overflow
setup.setting            | ph_at                 |  1 | no overflow
line.corners             |                       |  4 | no overflow, in reach
line.walk                |                       |  1 | no overflow, pixels within the picture
list.first_row           |                       |  4 | no overflow, a row of the picture
planes.area              |                       |  7 | twice a triangle's area is below 2^42
planes.plane_base        |                       |  4 | no overflow, ranges of the base
planes.times_wide        | fx_mul_wide=any_product | 5 | no overflow
planes.wide_gradient     | wide_base,times_wide=any_wide_product,fx_mul_wide=any_quotient | 4 | no overflow, nothing lost
planes.short_plane       |                       |  4 | no overflow
planes.plane_through     | short_plane,wide_plane | 4 | no overflow
planes.plane_light       | short_plane,wide_plane | 4 | no overflow
planes.plane_exact       | wide_gradient         |  4 | no overflow
planes.depths            |                       |  4 | no overflow
planes.setup_depth       | depth_plane,plane_exact,ph_depth_linear_code | 34 | no overflow
planes.setup_texture     | plane_through         |  4 | no overflow
exact.in_40_bits         |                       |  1 | no overflow, below 16
exact.divide             |                       |  1 | no overflow
exact.set_plane          | divide                |  4 | no overflow, range below 1
exact.set_run            |                       |  4 | no bad shift
exact.linear_code        | ph_depth_linear_code  |  1 | no bad shift
exact.range_of           |                       |  1 | no bad shift
exact.pixels_in          |                       | 512 | 1 .. n
exact.run                | octave_of,range_of,set_run,pixels_in=any_count | 1 | no overflow
exact.lift               | linear_code,ph_lift_codes |  1 | no overflow, all depths stay below 1
exact.rows               | octave_of,range_of,set_run | 4 | no overflow
setup_small.slopes       |                       |  4 | no overflow, slopes below 2^15
setup_small.depth_gradient |                     |  4 | no overflow
setup_small.light_gradient |                     |  1 | no overflow
setup_small.setup_small  | set_planes            |  4 | no overflow
setup_small.float_depths |                       |  4 | no overflow
gappa.rcp                |                       |    | fx_rcp_norm is the floor of 2^62 / d
gappa.rsqrt              |                       |    | fx_rsqrt_norm to 2^-25 of itself
gappa.sqrt_u64           |                       |    | fx_sqrt_u64 narrows nothing, and is the floor of the root
gappa.div                |                       |    | fx_div_sat's loop turns at most twice
gappa.lerp               |                       |    | clip: lerp_q30 stays between its ends
gappa.reach              |                       |    | the guard band ends 2048 px from the centre
gappa.quotient           |                       |    | N/w to 2^-28
gappa.depth              |                       |    | d of a corner to 13 units of 2^-32 (fixed formats 21)
gappa.gradient           |                       |    | one gradient step to 9 units of its last bit
END
}

# Gappa bounds the loop of fx_div_sat, and what clip.between, clip.crossing and fx_sqrt_u64 narrow.
options() { # name
    [ "$1" = fx_div.div ] && echo --no-unwinding-assertions || echo --unwinding-assertions
    [[ $1 =~ ^(clip.(between|crossing)|fx_cut.sqrt_u64)$ ]] || echo --conversion-check
}

# What the solver found wrong, a line each; nothing when all holds. The last claim is that the end is not reached.
cbmc_proof() { # name, functions, turns
    local module=${1%%.*} proof=${1#*.} at=$B/proof/$1 core=$proof_tree/firmware/core f regex='' remove=()
    { cat "$proof_tree/tests/proof/cbmc_$module.c" && printf '\nvoid to_the_end(void)\n{\n    proof_%s();\n    CLAIM(!"the end");\n}\n' "$proof"; } |
        $CC -E -x c -iquote "$proof_tree/tests/proof" -I"$core"{,/render,/kernels,/kernels/portable} - -o "$at.i" || return
    tool goto-cc -c "$at.i" -o "$at.gb" || return
    for f in ${2//,/ }; do
        case $f in
        *=*) remove+=(--replace-calls "${f/=/:}") ;;
        *) remove+=(--remove-function-body "$f") && regex+="|$f" ;;
        esac
    done
    if [ -n "$regex" ]; then
        tool goto-instrument "${remove[@]}" "$at.gb" "$at.cut" >/dev/null 2>&1 &&
            tool goto-instrument --generate-function-body "${regex#|}" --generate-function-body-options nondet-return "$at.cut" "$at.gb" >/dev/null || return
    fi
    # shellcheck disable=SC2046 # options are words
    timeout "${PROOF_TIMEOUT:-1800}" bash -c 'tool "$@"' - cbmc "$at.gb" --function to_the_end --unwind "$3" $(options "$1") --drop-unused-functions \
        --no-standard-checks --signed-overflow-check --undefined-shift-check --div-by-zero-check --bounds-check --pointer-check >"$at.log" 2>&1
    grep -q '^VERIFICATION' "$at.log" || { echo "no answer: $(tail -n 1 "$at.log")" && return; }
    grep -q 'the end.*FAILURE' "$at.log" || echo "the end of the harness cannot be reached"
    grep ': FAILURE$' "$at.log" | grep -v 'the end\|signed to unsigned type conversion\|unsigned to signed type conversion\|^.fx_sat64.*type conversion'
}

one() { # name, functions, turns, claim
    local begin=$SECONDS found tool=CBMC
    [[ $1 != gappa.* ]] || tool=Gappa
    if [ $tool = CBMC ]; then
        found=$(cbmc_proof "$1" "$2" "$3" 2>&1)
    else
        found=$("$proof_tree/tests/proof/gappa.sh" "${1#*.}" "$proof_tree" 2>&1) || found=${found:-"Gappa says no"}
    fi
    if [ -z "$found" ]; then
        printf '%-26s %-5s proved    %4d s  %s\n' "$1" $tool $((SECONDS - begin)) "$4"
    else
        printf '%-26s %-5s NOT TRUE  %4d s  %s\n' "$1" $tool $((SECONDS - begin)) "$4"
        echo "    | ${found//$'\n'/$'\n'    | }"
    fi
}
export -f one cbmc_proof options tool

# The table by module, for tests/README.md.
table() {
    echo '| proved by | of | what |'
    echo '|---|---|---|'
    proofs | sed 's/ *| */|/g' | awk -F'|' '
        { split($1, name, ".") }
        name[1] == "gappa" { gappa = gappa "| Gappa | " name[2] " | " $4 " |\n"; next }
        name[1] != module { if (module) { print row " | no overflow |" } module = name[1]; row = "| CBMC | " module ": " name[2]; next }
        { row = row ", " name[2] }
        END { print row " | no overflow |"; printf "%s", gappa }'
}

modules() { proofs | cut -d . -f 1 | sort -u; }

while [[ ${1-} == --* ]]; do
    case $1 in
    --table) table && exit ;;
    --modules) modules && exit ;;
    --tree) proof_tree=$(realpath "$2") && shift ;;
    *) sed -n 's/^# \(Usage.*\)/\1/p' "$0" >&2 && exit 2 ;;
    esac
    shift
done
proof_tools || { echo "$proof_why" && exit 77; }
export B proof_root
wanted=" $* "
proofs | sed 's/ *| */|/g' | while IFS='|' read -r name cut turns claim; do
    [ $# = 0 ] || [[ $wanted = *" $name "* || $wanted = *" ${name%%.*} "* ]] || continue
    printf '%q %q %q %q\n' "$name" "$cut" "$turns" "$claim"
done | xargs -d '\n' -P "$(nproc)" -I{} bash -c 'one {}' | tee "$B/proof/results"
awk '/^[a-z]/ { n++; proved += $3 == "proved" } END { printf "%d proofs, %d proved\n", n, proved; exit n == 0 || n != proved }' "$B/proof/results"
