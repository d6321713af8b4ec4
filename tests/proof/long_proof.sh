#!/usr/bin/env bash
# All proofs, by module. And each line below breaks one thing in a copy of the core on purpose: the proof beside it
# must fail. A line that changes nothing any more fails too.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/proof/tools.sh
proof_tools || { echo "$proof_why" && exit 77; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# what is broken | file | sed | proof that must fail
mutants() {
    cat <<'END'
a difference in 32 bits            | fx/fx.c            | s/((int64_t)b - a) \* t/(b - a) * t/                     | fx.lerp
a shift by 32 and more             | fx/fx_root.c       | s/>> (5 + shift/>> (35 + shift/                          | fx.sqrt
a sum that does not saturate       | fx/fx.c            | s/fx_sat64((int64_t)a + b)/a + b/                        | fx.sums
a negative that overflows          | fx/fx.c            | s/a == FX_MIN ? FX_MAX : -a/-a/                          | fx.sums
a table one entry short            | fx/fx_trig.c       | s/sine\[64 - node\]/sine[65 - node]/                     | fx.sincos
a quotient shifted by too much     | fx/fx.c            | s/>> (46 - shift)/>> (86 - shift)/                       | fx_div.div
a tangent of too many bits         | fx/fx_tan.c        | s/(1 << 27)) >> 28)/(1 << 27)) >> 13)/                   | fx_cut.tan
a remainder by 1                   | fx/fx_whole.c      | s/if (d <= 1)/if (d < 1)/                                | fx_cut.fmod
a sine shifted too far             | fx/fx_arcsin.c     | s/a \* 32768/a * 65536/                                  | fx_cut.asin
a root shifted by all its zeros    | fx/fx_root.c       | s/r >> (shift \/ 2)/r >> shift/                          | fx_cut.sqrt_u64
an entry of the table of roots     | fx/fx_root.c       | s/255, 253, 251/255, 233, 251/                           | gappa.rsqrt
a coarser step to the root         | fx/fx_root.c       | s/error >> 11/error >> 21/                               | gappa.sqrt_u64
a run of too many pixels           | render/exact.c     | s/uint32_t count = 1;/uint32_t count = 3;/               | exact.pixels_in
a run in another unit              | render/exact.c     | s/(x + (int32_t)count) \* 65536/(x + 64 * (int32_t)count) * 65536/ | exact.run
a lift beyond the range            | render/exact.c     | s/const uint64_t up = by < room ? by : room;/const uint64_t up = by;/ | exact.lift
text one digit longer              | fx/fx_text.c       | s/unit = 10000/unit = 1000000000/; s/unit > 1 \&\& whole < unit/false/ | fx_text.to_text
a reciprocal of another table      | fx/fx_root.c       | s/4088, 4072/4088, 4172/                                 | gappa.rcp
a rounding that is off             | fx.h               | s/>> 16) + 48)) >> 21/>> 16) + 4800)) >> 21/             | gappa.rcp
a quotient clamped late            | fx/fx.c            | s/n >> 15 >= d/n >> 18 >= d/                             | gappa.div
a crossing rounded twice too far   | render/clip.c      | s/(1 << 29)) >> 30/(1 << 30)) >> 30/                     | gappa.lerp
more corners than there is room    | render/clip.c      | s/ \&\& count < PH_CLIP_MAX) {/) {/                      | clip.clip_plane
a distance in 32 bits              | render/clip.c      | s/(int64_t)v->w \* 8/v->w * 8/                           | clip.distance
a longer focal length              | render/lens.h      | s/log2 <= 18 \&\&/log2 <= 28 \&\&/; s/log2 > 18/log2 > 28/ | frame.camera
less head room                     | render/depth.h     | s/float_down : 9;/float_down : 5;/                       | gappa.quotient
a divide aligned too far           | render/transform.c | s/x << (shift - 4)/x << (shift + 4)/                     | transform.project
a guard band twice as wide         | render/transform.c | s/reciprocal) >> 32);/reciprocal) >> 31);/               | gappa.reach
a code from too high a bit         | render/depth.h     | s/up = 2 + block - quotient.s/up = 12 + block - quotient.s/ | depth.codes
a slope rounded beyond its range   | render/depth.h     | s/(int32_t)gradient >> -up)/((int32_t)gradient + 1) >> -up)/ | depth.codes
a wide edge shifted out            | render/outline.c   | s/>> (43 - shift)/>> (93 - shift)/                       | setup.wide_edge
rows outside the picture           | render/outline.c   | s/y_bottom = ph_min(o.row_low, height)/y_bottom = o.row_low/ | setup.setup_outline
a gradient that changes its sign   | render/planes.c    | s/fx_sat64((px + half) >> down)/(int32_t)((px + half) >> down)/ | planes.wide_gradient
a gradient that is not halved      | render/planes.c    | s/1 - fx_clz32(ph_without_sign(gx)/-1 - fx_clz32(ph_without_sign(gx)/ | planes.short_plane
a far unit of linear-w             | render/exact.c     | s/fx_clz32(high), 30)/fx_clz32(high), 24)/               | exact.set_run
a line of two pixels               | render/line.c      | s/x_major ? 0 : 128, /x_major ? 0 : 256, /                     | line.corners
a small slope of one bit more      | render/slopes.h    | s/PH_SLOPE_BITS 15/PH_SLOPE_BITS 16/                     | setup_small.depth_gradient
END
}

copy_broken() { # file, sed
    rm -rf "$dir/firmware" "$dir/tests" && mkdir -p "$dir/firmware" "$dir/tests" &&
        cp -r firmware/core "$dir/firmware" && cp -r tests/proof "$dir/tests" && sed -i "$2" "$dir/firmware/core/$1"
    ! cmp -s "firmware/core/$1" "$dir/firmware/core/$1" || { echo "changes nothing: $2" && return 1; }
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
while IFS='|' read -r what file change proof; do
    in_share || continue
    read -r what <<<"$what" && read -r file <<<"$file" && read -r proof <<<"$proof"
    check "${proof}_sees_${what// /_}" fails "$file" "$(sed 's/^ *//; s/ *$//' <<<"$change")" "$proof"
done < <(mutants)
tap_end
