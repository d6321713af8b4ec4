#!/usr/bin/env bash
# The small profile (PROFILE=small): its Gouraud program fits 16 KB, it draws the same bytes as the whole library, and it
# refuses what it lacks.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { cat; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
export B=${B:-build}
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
small=$B/small
make -s -j2 B="$B" "$B/libpinhole.a" && make -s -j2 B="$small" PROFILE=small CFLAGS='-O2 -g' "$small/libpinhole.a" || exit 1

build() { # output, library, program, flags...
    cc -std=c11 -O2 -Wall -Wextra "${@:4}" -Ifirmware/core -Ifirmware/core/kernels/portable "$3" "$2" -o "$1"
}
small_flags=(-DPH_PROFILE_SMALL -Ifirmware/core/render/small)

# Each scene has a line with the CRC of all pixels and all depth of its bands.
same_bytes() { # scenes
    build "$dir/whole" "$B/libpinhole.a" tests/size/small_scenes.c &&
        build "$dir/small" "$small/libpinhole.a" tests/size/small_scenes.c "${small_flags[@]}" &&
        "$dir/whole" 0 "$1" >"$dir/whole.txt" && "$dir/small" 0 "$1" >"$dir/small.txt" &&
        [ "$(wc -l <"$dir/whole.txt")" = "$1" ] && diff "$dir/whole.txt" "$dir/small.txt" | head -n 20 >"$dir/differ"
    [ ! -s "$dir/differ" ] || { cat "$dir/differ" && return 1; }
}
check "4000_random_scenes_have_the_bytes_of_the_whole_library" same_bytes 4000
all_are_drawn() { awk '$2 != 0 || $4 != 0 { bad++ } { pixels += $5 } END { exit bad > 0 || pixels < 4000 * NR }' "$dir/whole.txt"; }
check "these_scenes_are_drawn_whole_and_have_pixels" all_are_drawn

cat >"$dir/refuse.c" <<'EOF'
#include "render.h"
#include <stdio.h>
static uint64_t room[64], list[64];
static uint16_t pixels[64], depth[64];
static struct ph_renderer r;
static int begin(const struct ph_config *config, enum ph_projection_kind kind, const struct ph_scene_light *light)
{
    const struct ph_xform view = ph_xform_translate(0, 0, 0);
    struct ph_projection lens;
    const int status = ph_renderer_init(&r, config);
    ph_projection_perspective(&lens, FX_INT(60), FX_ONE, FX_ONE, FX_INT(9));
    lens.kind = kind;
    return status != PH_OK ? status : ph_frame_begin(&r, &view, &lens, light, 0);
}
static int draw(const struct ph_material *material, const uint16_t *colours)
{
    static const struct fx_vec3 at[3];
    static const uint16_t triangle[1][3] = {{0, 1, 2}};
    static const struct ph_part part = {0, 1, 0};
    const struct ph_mesh mesh = {.positions = at, .triangles = triangle, .parts = &part, .materials = material,
                                 .vertex_count = 3, .triangle_count = 1, .part_count = 1, .colours = colours};
    return ph_draw_mesh(&r, &mesh, &ph_xform_identity);
}
int main(void)
{
    const struct ph_config config = {.width = 8, .height = 8, .band_height = 8, .vertices = room, .vertex_max = 8,
                                     .triangles = list, .triangle_max = 20, .depth = depth, .depth_format = PH_DEPTH_FIXED16};
    struct ph_config other[3] = {config, config, config}; /* without a format; with samples; with what is shown */
    static const struct ph_scene_light sun = {0, 1, {{.kind = PH_LIGHT_DIRECTIONAL}}};
    static const struct ph_scene_light red = {0, 1, {{.kind = PH_LIGHT_DIRECTIONAL, .red = FX_ONE}}}, two = {0, 2, {{0}}};
    static const struct ph_blend blend = {.alpha = 3};
    const struct ph_material materials[4] = {{.shading = PH_SHADE_TEXTURE}, {.shading = PH_SHADE_WIRE}, {.blend = &blend},
                                             {.depth_bias_slope = 1}};
    static const struct ph_material plain;
    other[0].depth_format = NULL;
    other[1].samples = pixels;
    other[2].shown = pixels;
    for (int i = 0; i < 3; i++) {
        printf("%d ", begin(&other[i], PH_PERSPECTIVE, NULL));
    }
    printf("%d ", begin(&config, PH_FISHEYE, NULL));
    printf("%d ", begin(&config, PH_PERSPECTIVE, &red));
    printf("%d ", begin(&config, PH_PERSPECTIVE, &two));
    printf("%d ", draw(&plain, NULL));
    printf("%d | ", begin(&config, PH_PERSPECTIVE, &sun));
    for (int i = 0; i < 4; i++) {
        printf("%d ", draw(&materials[i], NULL));
    }
    printf("%d ", draw(&plain, pixels));
    printf("%d | ", draw(&plain, NULL));
    printf("%u ", (unsigned)ph_draw_band(&r, 0, pixels));
    printf("%u ", (unsigned)ph_frame_bands(&r));
    printf("%u ", (unsigned)ph_draw_band(&r, 0, NULL));
    printf("%u ", (unsigned)ph_draw_band(&r, 0, pixels));
    printf("%d\n", draw(&plain, NULL));
    return 0;
}
EOF
what_it_lacks_is_refused() {
    local said
    build "$dir/refuse" "$small/libpinhole.a" "$dir/refuse.c" "${small_flags[@]}" && said=$("$dir/refuse") &&
        [ "$said" = '-95 -22 -22 -22 -22 -22 -77 0 | -22 -22 -22 -22 -22 0 | 0 1 0 8 -77' ] || { echo "$said" && return 1; }
}
check "what_the_profile_lacks_is_refused" what_it_lacks_is_refused


headers_are_cpp() { echo '#include "render.h"' | "$1" -std=c++98 -Wall -Wextra -Werror -x c++ -fsyntax-only "${small_flags[@]}" -Ifirmware/core -Ifirmware/core/kernels/portable -; }
for compiler in g++ clang++; do
    if command -v $compiler >/dev/null; then check "${compiler}_takes_its_headers" headers_are_cpp $compiler; else skip "${compiler}_takes_its_headers" "no $compiler"; fi
done

if command -v arm-none-eabi-gcc >/dev/null; then
    takes_16_kb() {
        local bytes
        bytes=$(PROFILE=small tests/tools/program_size.sh tests/size/gouraud.c | awk '$1 == "all" { print $2 }')
        [ "${bytes:-99999}" -le 16384 ] || { echo "${bytes:-no} bytes" && return 1; }
    }
    check "gouraud_takes_at_most_16384_bytes" takes_16_kb
    # The rows of the paper, with numbers that are 2 % off at most.
    paper_says_so() {
        tests/size/small_table.sh >"$dir/table" && grep -A 5 -F "$(head -n 1 "$dir/table")" firmware/README.md | tr -d , | paste -d '|' "$dir/table" - | awk -F '|' '
            { print } $2 != $7 { bad++ } NR > 2 { for (i = 3; i <= 4; i++) { d = $i - $(i + 5); bad += d > $i / 50 || d < -$i / 50 } } END { exit bad || NR != 6 }'
    }
    check "its_table_in_the_papers_holds" paper_says_so
else
    skip "gouraud_takes_at_most_16384_bytes, and its table holds" "no arm-none-eabi-gcc: apt-get install gcc-arm-none-eabi"
fi
tap_end
