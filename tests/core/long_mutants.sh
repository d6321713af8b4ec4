#!/usr/bin/env bash
# The tests of the core are tested: each line breaks one thing in a copy of the core on purpose; the test named beside it must
# fail. A line that changes nothing any more fails too: the code has moved on, the line should follow.
# (The portable core: what a CPU has of its own is held to it by tests/core/test_kernels.sh.)
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}/mutants CC=${CC:-cc}
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT

# what is broken | file | sed | test that must fail
mutants() {
    cat <<'END'
pixels sampled 1/32 px further left      | render/edge.h    | s/32767u/34815u/                                     | test_raster
left edges not owned                     | render/edge.h    | s/32767u/32768u/                                     | test_raster
top edges not owned                      | render/edge.h    | s/(y + 127) >> 8/(y + 128) >> 8/                     | test_raster
edges walked to 6 bits                   | render/outline.c | s/_edge(.*&\(.*long_edge\));/& \1.dx \&= ~1023;/      | test_coverage
6 sub-pixel bits                         | kernels/portable/vertices.c | s/\(v->[xy] = .*\);/\1 \& ~3;/                      | test_quality
7 sub-pixel bits                         | kernels/portable/vertices.c | s/\(v->[xy] = .*\);/\1 \& ~1;/                      | test_quality
positions truncated, not rounded         | render/transform.c| s/)1 << (down - 1)/)0 << (down - 1)/               | test_quality
principal point half a pixel off         | render/lens.h    | s/+ 256) >> 9)/+ 256) >> 9) + 128/                   | test_raster
an edge that depends on its triangle     | render/outline.c | s/_edge(.*&\(.*long_edge\));/& \1.x += 128;/           | test_watertight
a slope that depends on its triangle     | render/outline.c | s/_edge(.*&\(.*long_edge\));/& \1.dx \&= ~15;/         | test_watertight
an edge walked from far above the picture | render/outline.c | s/(slope >> 10)/(slope >> 10 \& ~0xfffff)/            | test_watertight
a crossing that depends on its direction | render/clip.c    | s/crossing(lens, b, a, db, da/crossing(lens, a, b, da, db/ | test_watertight
crossings to 10 bits                     | render/clip.c    | s/(rest >= whole))/& \& ~0xfffff/                    | test_mesa
near plane too near                      | render/clip.c    | s/- lens->near_z;/- lens->near_z \/ 2;/              | test_watertight
no far plane                             | render/clip.c    | s/lens->far_z - v->z;/lens->far_z;/                  | test_raster
depth gradients without guard bits       | render/planes.c  | s/(uint32_t)gx, (uint32_t)gy}/(uint32_t)gx \& ~0x3ffu, (uint32_t)gy \& ~0x3ffu}/; s/(uint32_t)depth.[xy] \* 256/& \& ~0x3ffu/ | test_quality
float16 spans not split at octaves       | render/planes.c  | s/if (!ph_depth_in_octave(d.*{/if (false) {/         | test_quality
fixed16 bias without its quarter         | render/planes.c  | s/PH_DEPTH_BIAS_FIXED16 +/((uint32_t)16 << 16) +/    | test_depth
codes of near ranges left unused         | render/lens.h    | s/ways->set_near != NULL ? .* : (uint32_t)/(uint32_t)/ | test_depth
float24 as coarse as float16             | render/span.h    | s/d >> 8;/d >> 16 << 8;/                             | test_depth
the last of equal 24-bit depths wins     | render/span.h    | s/code <= \*depth/code < *depth/                     | test_raster
the last of equal depths wins            | render/span.h    | s/code > \*depth/code >= *depth/                     | test_raster
the last of equal texels wins            | kernels/portable/texel_row_portable.h | s/ph_nearer16(depth, d)/(ph_nearer16(depth, d) + (*depth == d >> 16))/ | test_texture
the last of equal lit texels wins        | render/span.h    | /ph_nearer16/,/^}/ s/code <= /code < /               | test_texture
triangles not carried to the next band   | render/bands.c   | s/(t->y_bottom <= y1)/(t->y_bottom <= y1 + 1)/       | test_raster
a carried triangle begins where it did   | render/raster.c  | s/t->y_top = (int16_t)y1;//                          | test_cores
triangles not carried by two cores       | render/bands_cores.c | s/(list->y_bottom <= y1)/(list->y_bottom <= y1 + 1)/ | test_cores
triangles drawn in reverse               | render/list.h    | s/return r->list.top - 1 - n;/return r->list.to + n;/ | test_raster
depth not cleared                        | render/slots.c   | s/ph_fill(rows->depth.*//                            | test_raster
no clamp at the left border              | render/edge.h    | s/ph_max((int32_t)left >> 16, 0)/((int32_t)left >> 16)/ | test_raster
no clamp of texels at the left border    | kernels/texture_tile.h | s/left > 0 ? left : 0/left/                | test_texture
one triangle over the budget             | render/list.c    | s/most : r->config.triangle_max/most : r->config.triangle_max + 1/ | test_frame
a clamped triangle loses a column        | render/small_texels.c | s/MARGIN + 1 + MARGIN/PH_TILE/                     | test_depth_slopes
light of pieces of a row adds up         | render/small_texels.c | s/r->row.light = light;//                     | test_texture_light
a draw without its camera                | render/list.c    | s/if (lens == PH_NONE)/if (lens == 1)/               | test_frame
a colour's alphas forgotten              | render/blended.c | s/ && !o->has_keys) {/) {/                           | test_blended
a shadow goes on behind a cut triangle   | effects/shadow.c | s/ph_list_again(c->r, &c->draw)/ph_list_draw(c->r, \&c->draw)/ | test_shadow
blended rows counted by another length   | render/blended.c | s,/ stride + 1,/ n + 1,                              | test_blended
dropped triangles not counted            | render/list.h    | s/r->stats.triangles_dropped++;//                    | test_frame
light of the first corner everywhere     | render/planes.c  | s/light\[1\] - light\[0\]/0/                          | test_frame
a small triangle's edge depends on it    | kernels/portable/setup_small.c | s/set_edge(o.top, o.low, o.row_top, &long_edge);/& long_edge.x += 128;/ | test_quality
a small triangle's slope depends on it   | kernels/portable/setup_small.c | s/set_edge(o.top, o.low, o.row_top, &long_edge);/& long_edge.dx \&= ~15;/ | test_quality
a small triangle's light is its first    | kernels/portable/setup_small.c | s/(v\[1\]->light - v\[0\]->light)/0/      | test_quality
a small triangle's depth to fewer bits   | kernels/portable/setup_small.c | s/(uint32_t)depth.x \* 256/& \& ~0x3ffffu/      | test_quality
a small triangle without its lower half  | kernels/portable/setup_small.c | s/set_edge(o.mid, o.low, o.row_mid, &small->lower);/& small->lower.dx = 0;/ | test_quality
vertices truncated in the fast loop      | kernels/portable/vertices.c | s/run->round_\([xy]\) + //                           | test_quality
6 sub-pixel bits in the fast loop        | kernels/portable/vertices.c | s/>> run->down;/>> run->down \& ~3;/                 | test_quality
lines half a pixel off                   | render/line.c    | s/across \* 256 - 1/across * 256 + 32767/            | test_lines
clamped textures repeat                  | render/texture.c | s/unsigned clamp = map->wrap/unsigned clamp = 0/                    | test_texture
a texture clamped in one way is so in both | render/texture.c | s/unsigned clamp = map->wrap/unsigned clamp = 3/ | test_texture
light of texels is that of a corner      | render/texels.c  | s/small->glight = .*/small->glight = 0;/    | test_texture_light
a filter without its lower line          | kernels/texel_mix.h | s/ + down \* fv//                                  | test_texture_light
a map two levels too small               | render/mipmap.c    | s/17 - fx_clz32/19 - fx_clz32/                      | test_texture_light
texture slope left out                   | render/tile_surface.c | s/way->step = .*/way->step = 0;/                      | test_texture
ambient light lost                       | render/light.c   | s/diffuse = local->ambient/diffuse = 0/              | test_light
attenuation lost                         | render/light_point.c | s/(int32_t)(reciprocal >> (32 - shift))/16384/       | test_light
a spot without its cone                  | render/light_point.c | s/l->kind->in_cone != NULL/false/                    | test_light
highlight to another power               | render/light.h   | s/k = local->shininess_log2; k > 0/k = local->shininess_log2; k > 1/ | test_light
light of another part kept               | render/mesh_light.c | s/(uint8_t)~PH_LIT;/0xff;/                           | test_frame
depth bias ignored                       | render/planes.h  | s/return material->depth_bias < 56 .*;/return 0;/               | test_frame
steep triangles flattened                | render/setup.c   | s/ph_set_exact(r, t->material, .*//                    | test_depth_slopes
colours with the depth of large triangles| render/setup.c   | s/small \&\& (colours ||/small \&\& (false ||/        | test_depth_slopes
a tile of texture over which d wraps     | render/tile_depth.c | s/^        return false;/        ;/                   | test_depth_slopes
thin triangles left to 15 bits           | kernels/portable/setup_small.c | s/ROUGH_DEPTH = 11/ROUGH_DEPTH = -40/           | test_depth_slopes
depth beyond the corners                 | render/exact.c   | s/const bool clamped = .*/const bool clamped = false;/ | test_depth_slopes
exact depth of another octave             | render/exact.c   | s/e->unit - octave;/e->unit - 1 - octave;/           | test_depth_slopes
the slope's bias ignored                 | render/exact.c   | s/material->depth_bias_slope != 0/false/          | test_depth_slopes
light of a texture ignored               | render/planes.h  | s/corners == PH_FIRST_CORNER ?/corners == 99 ?/      | test_frame
red and blue bytes exchanged             | render/colour.c  | s/ph_wire16(/(/                                      | test_frame
tangent with a term halved               | fx/fx_tan.c      | s/Q33(2, 93555)/Q33(1, 93555)/                       | test_fx
a tangent below 45 degrees not rounded   | fx/fx_tan.c      | s/ + (1 << 27)//                                     | test_fx
exponential without its third power      | fx/fx_exp.c      | s/ + (fx_mul_wide_u(cube, sum) >> 18)//              | test_fx_math
a table of exponentials off by one       | fx/fx_exp.c      | s/0x85aac367cc487b15/0x85aac367cc487b14/             | test_fx_math
logarithm without its third power        | fx/fx_log.c      | s/ + (fx_mul_wide_u(cube, sum) >> 14)//              | test_fx_math
every negative power negative            | fx/fx_pow.c      | s/x < 0 \&\& (y \& FX_ONE) != 0/x < 0/               | test_fx_math
arc sine of 0 by a root that is too large | fx/fx_arcsin.c   | s/ << 30) - 1)/ << 30))/                             | test_fx_math
64-bit root without its remainder        | fx/fx_root.c     | s/ : rest > 2 \* (int64_t)r;/ : 0;/                  | test_fx_math
radians rounded at the wrong bit         | fx/fx_unit.c     | s/drop - 33/drop - 32/                               | test_fx_math
rounded text without its tie             | fx/fx_text_rounded.c | s/part == FX_HALF/part == 0/                     | test_fx_math
products truncated before their sum      | geom/geom_sum.h  | s/low += (uint32_t)p.*;//                            | test_geom
END
}

sources() { # file; of a header those that read it, through others too
    local file
    case $1 in
    *.h) for file in firmware/core/{fx,geom,render,effects,kernels/portable}/*.c; do
        ! $CC -MM -Ifirmware/core{,/kernels/portable,/render,/effects,/kernels} "$file" | grep -q "/${1##*/}\\b" || echo "${file#firmware/core/}"
    done ;;
    *) echo "$1" ;;
    esac
}

# Compiles the mutated files alone: they take the place of their archive members.
fails() { # file, sed, test
    local file object objects=()
    rm -rf "$dir/core" "$dir"/*.o
    cp -r firmware/core "$dir/core"
    sed -i "$2" "$dir/core/$1"
    ! cmp -s "firmware/core/$1" "$dir/core/$1" || { echo "changes nothing: $2" && return 1; }
    for file in $(sources "$1"); do
        object=$dir/$(basename "$file").o
        $CC -std=c11 -O2 -w -I"$dir/core"{,/kernels/portable,/render,/effects,/kernels} -c "$dir/core/$file" -o "$object" || return 1
        objects+=("$object")
    done
    # shellcheck disable=SC2086 # a list of words
    $CC "$B/tests/core/$3.o" "${objects[@]}" "$B/libtests.a" "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" -Wl,--as-needed $libs -lm -o "$dir/mutant" || return 1
    ! timeout 120 "$dir/mutant" >/dev/null 2>&1 </dev/null || { echo "$3 did not notice" && return 1; }
}

libs="$(for lib in cmocka osmesa mpfr gmp; do pkg-config --libs "$lib" 2>/dev/null; done)"
[ "${libs/cmocka/}" != "$libs" ] || { echo "no cmocka: apt-get install libcmocka-dev" && exit 77; }
for test in $(mutants | sed 's/.*| //' | sort -u); do
    make -s CPU=portable B="$B" "$B/tests/core/$test" >"$dir/log" 2>&1 || { [ "$test" = test_mesa ] && continue; cat "$dir/log"; exit 1; }
    check "${test}_passes_untouched" "$B/tests/core/$test"
done
while IFS='|' read -r what file change test; do
    in_share || continue
    read -r test <<<"$test"
    read -r file <<<"$file"
    if [ -e "$B/tests/core/$test" ]; then
        read -r what <<<"$what"
        check "${test}_sees_${what//[ ,]/_}" fails "$file" "$(sed 's/^ *//; s/ *$//' <<<"$change")" "$test"
    else
        skip "$test: $what" "$test is not built here"
    fi
done < <(mutants)
tap_end
