#!/usr/bin/env bash
# How many files somebody touches who adds a thing of a kind: in a copy of this tree a board, a demo, a panel, a depth format, a
# shading, a CPU and an option are made up, the files that each took are counted, and what was added draws.
# shellcheck disable=SC2016,SC2317 # backticks of tables; functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/tools/frames.sh
unset MAKEFLAGS
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
git rev-parse --git-dir >/dev/null 2>&1 || { echo "no git checkout to copy" && exit 77; }
git ls-files -z | xargs -0 tar -cf - | tar -xf - -C "$dir" || exit 1
cd "$dir" || exit 1
sim=$dir/build/pinhole-sim

commit() { git add -A && git -c user.name=nobody -c user.email=nobody@localhost commit -qm "$1"; }
{ git init -q . && commit whole; } || exit 1

# Commits what was added; fails when that took more files than a number says, or when a file that it names is as it was.
took() { # most, file...
    local most=$1 file
    shift
    git add -A
    for file; do
        git diff --cached --quiet -- "$file" && echo "$file was not changed" && return 1
    done
    [ "$(git diff --cached --name-only | wc -l)" -le "$most" ] || { git diff --cached --name-only && return 1; }
    commit added
}

board() {
    local row
    mkdir boards/sim-made-up && sed 's/board_sim_st7789_240x280/board_sim_made_up/; s/sim-st7789-240x280/sim-made-up/' boards/sim-st7789-240x280/board.c >boards/sim-made-up/board.c
    row=$(grep '^| `sim-st7789-240x280`' boards/README.md | sed 's/sim-st7789-240x280/sim-made-up/')
    sed -i "/^| \`sim-st7789-240x280\`/a $row" boards/README.md
    took 2 boards/sim-made-up/board.c boards/README.md
}

demo() {
    sed 's/demo_wireframe/demo_made_up/; s/\.name = "wireframe"/.name = "made_up"/' firmware/app/demos/wireframe.c >firmware/app/demos/made_up.c
    sed -i 's/D(yard)/D(yard) D(made_up)/' firmware/app/demos/demo_scene.h
    took 2 firmware/app/demos/made_up.c firmware/app/demos/demo_scene.h
}

panel() { # a glass of 240x280 on other rows of its controller; the simulator's model has a row of its own
    sed -i 's/^const struct panel panel_st7789_240x280 = .*/&\nconst struct panel panel_made_up = ST7789("made-up", 240, 280, 0, 40, st7789_init_tall);/' hal/panel/panels_dbi.c
    sed -i 's/P(st7789_240x280)/& P(made_up)/' hal/panels.h
    sed -i '/^| `st7789-240x280`/a | `made-up` | ST7789 | 240x280 | RGB565, RGB666, RGB444 | 62.5 | simulator |' boards/README.md
    sed -i 's/^    {"st7789-240x280", \(.*\), 0, 20, \(.*\)/&\n    {"made-up", \1, 0, 40, \2/' host-sim/controllers/sim_glass.c
    took 4 hal/panel/panels_dbi.c hal/panels.h host-sim/controllers/sim_glass.c boards/README.md
}

depth_format() {
    sed -i 's/^    ROW(float16, .*/&\n    ROW(made_up,    "made-up",  FIXED,  16,  0,      true) \\/' firmware/core/render.h
    took 4 firmware/core/render.h
}

shading() { # flat, half as bright
    sed -i 's/^#define PH_SHADE_GOURAUD .*/#define PH_SHADE_MADE_UP (\&ph_shade_made_up)\n&/; s/^extern const struct ph_shading /extern const struct ph_shading ph_shade_made_up;\n&/' firmware/core/scene.h
    cat >firmware/core/render/made_up.c <<'EOT'
/* Flat shading, half as bright. */
#include "mesh.h"
#include "shading.h"

static uint16_t light_half(const struct ph_local_lights *local, const int16_t normal[3], const struct fx_vec3 *position)
{
    return ph_light_vertex(local, normal, position) / 2;
}

static const struct ph_lighting half = {.light_prepare = ph_light_prepare, .light_vertex = light_half, .parts = &ph_part_lighting};

const struct ph_shading ph_shade_made_up = {.corners = PH_FIRST_CORNER, .lighting = &half};
EOT
    took 5 firmware/core/scene.h firmware/core/render/made_up.c
}

cpu() { # which clears a picture in its own way
    mkdir firmware/core/kernels/made_up && cat >firmware/core/kernels/made_up/fill.c <<'EOT'
/* ph_fill of kernels.h, pixel by pixel. */
#include "kernels.h"

void ph_fill(uint16_t *to, uint16_t value, uint32_t n)
{
    while (n-- > 0) {
        to[n] = value;
    }
}
EOT
    sed -i 's/CPU=portable|x86_64/CPU=portable|made_up|x86_64/' Makefile
    took 2 firmware/core/kernels/made_up/fill.c Makefile
}

option() {
    sed -i 's/^    bool crc, stats,/    bool made_up;\n&/' host-sim/sim/sim_options.h
    sed -i 's/^    {"crc", NULL, /    {"made-up", NULL, "says so", NULL, .at = offsetof(struct sim_options, made_up)},\n&/' host-sim/sim/sim_options.c
    sed -i '0,/sim_options_help();/s//&\n        puts(options.made_up ? "made up" : "");/' host-sim/sim/pinhole_sim.c
    took 3 host-sim/sim/sim_options.h host-sim/sim/sim_options.c host-sim/sim/pinhole_sim.c
}

builds() { frames_program build && "$sim" --list >list; }

# Two command lines print the same CRCs, which are not none.
# shellcheck disable=SC2086 # words
same() { "$sim" $1 --crc >one && "$sim" $2 --crc >two && [ -s one ] && cmp one two; }

all_are_there() {
    grep -q '^board  sim-made-up  *240x280' list && grep -q '^demo   made_up ' list && same "--board sim-made-up" "--board sim-st7789-240x280" &&
        same "--demo made_up --size 160x120" "--demo wireframe --size 160x120" && same "--depth made-up" "--depth fixed16" &&
        "$sim" --made-up --help | grep -qx 'made up'
}

the_panel_draws() { # on the board, which takes it for its own
    sed -i 's/panel_st7789_240x280/panel_made_up/' boards/sim-made-up/board.c && builds && same "--board sim-made-up" "--board sim-st7789-240x280"
}

the_shading_draws() { # a wall that faces the light: half of what flat shading gives it
    cat >wall.c <<'EOT'
#include "render.h"

enum { SIDE = 32 };

static uint8_t red_of(const struct ph_shading *shading)
{
    static const struct fx_vec3 corners[3] = {{-FX_INT(9), -FX_INT(9), 0}, {FX_INT(9), -FX_INT(9), 0}, {0, FX_INT(9), 0}};
    static const int16_t normals[3][3] = {{0, 0, 16384}, {0, 0, 16384}, {0, 0, 16384}};
    static const uint16_t triangle[1][3] = {{0, 1, 2}};
    static const struct ph_part part = {0, 1, 0};
    static const struct ph_scene_light ahead = {.count = 1, .lights = {{.intensity = FX_ONE, .to_light_q30 = {0, 0, 1 << 30}}}};
    static struct ph_renderer r;
    static uint64_t vertices[512], list[512];
    static uint16_t depth[SIDE * SIDE], pixels[SIDE * SIDE], ramp[PH_RAMP_SIZE];
    static uint32_t bins[1];
    const struct ph_material material = {.shading = shading, .diffuse = FX_ONE, .ramp = ramp};
    const struct ph_mesh wall = {.positions = corners, .normals = normals, .triangles = triangle, .parts = &part,
                                 .materials = &material, .vertex_count = 3, .triangle_count = 1, .part_count = 1};
    const struct ph_xform view = ph_xform_translate(0, 0, FX_INT(-3));
    const struct ph_config config = {.width = SIDE, .height = SIDE, .band_height = SIDE, .vertices = vertices, .vertex_max = 16,
                                     .triangles = list, .triangle_max = 16, .bins = bins, .bin_max = 1,
                                     .depth = depth, .depth_format = PH_DEPTH_FIXED16};
    struct ph_projection lens;
    ph_material_ramp(ramp, 255, 255, 255, 0);
    return ph_projection_perspective(&lens, FX_INT(45), FX_ONE, FX_HALF, FX_INT(20)) == PH_OK && ph_renderer_init(&r, &config) == PH_OK &&
                   ph_frame_begin(&r, &view, &lens, &ahead, 0) == PH_OK && ph_draw_mesh(&r, &wall, &ph_xform_identity) == PH_OK &&
                   ph_frame_bands(&r) == 1 && ph_draw_band(&r, 0, pixels) == SIDE
               ? *(const uint8_t *)&pixels[SIDE * SIDE / 2 + SIDE / 2] >> 3
               : 255;
}

int main(void)
{
    return red_of(PH_SHADE_FLAT) != 31 || (red_of(PH_SHADE_MADE_UP) + 1) / 2 != 8;
}
EOT
    make -s B=build build/libpinhole.a && cc -Wall -Ifirmware/core -Ifirmware/core/kernels/portable wall.c -o wall build/libpinhole.a && ./wall
}

the_cpu_draws() {
    frames_program other CPU=made_up && nm other/firmware/core/kernels/made_up/fill.o | grep -q ' T ph_fill$' &&
        "$sim" --demo torus --crc >one && other/pinhole-sim --demo torus --crc | cmp - one
}

# Tests that walk through all boards, panels and demos. (test_depth pins the table of depth formats: a new one has its row there.)
tests_need_no_change() {
    local test
    for test in tests/app/test_demos tests/app/test_memory_plan tests/hal/test_boards tests/hal/test_panel; do
        { make -s -j2 B=build "build/$test" && "build/$test"; } >said 2>&1 || { grep -v ' OK \| RUN ' said && return 1; }
    done
}

check "a_board_takes_2_files" board
check "a_demo_takes_2_files" demo
check "a_panel_takes_3_files_and_a_row_in_the_papers" panel
check "a_depth_format_takes_4_files" depth_format
check "a_shading_takes_5_files" shading
check "a_CPU_takes_a_folder_and_a_line" cpu
check "an_option_takes_3_files" option
check "the_tree_builds_with_all_of_them" builds
check "all_are_there" all_are_there
check "tests_of_all_boards_panels_and_demos_need_no_change" tests_need_no_change
check "the_panel_draws" the_panel_draws
check "the_shading_draws" the_shading_draws
check "the_CPU_draws" the_cpu_draws
tap_end
