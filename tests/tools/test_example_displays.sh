#!/usr/bin/env bash
# The triangle on other people's displays: the examples for pico-sdk, Arduino (three libraries), ESP-IDF, Zephyr and LVGL compile
# against small stand-ins of what they call (displays/), run, and all show the same picture: that of ph_show alone.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
make -s B="$B" "$B/libpinhole.a" >/dev/null || exit 1
mkdir "$dir/pinhole" && cp firmware/core/*.h firmware/core/kernels/portable/fx_cpu.h "$dir/pinhole"
here=firmware/package/examples
flags=(-O1 -Wall -Werror -Wno-unused-function -I"$dir" -Itests/tools/displays -I"$here")

cat >"$dir/shown.c" <<'C'
#include "triangle.h"
#include "stand_in.h"
static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    (void)context;
    return stand_in_take(x, y, width, height, pixels, false);
}
int main(void)
{
    static struct ph_renderer r;
    int status = triangle_init(&r, PH_PIXELS_WIRE);
    for (uint32_t frame = 0; status == 0; frame++) {
        status = triangle_draw(&r, frame);
        status = status != 0 ? status : ph_show(&r, flush, NULL);
    }
    return 1;
}
C

runs() { # program, compiler and what it compiles...
    local name=$1
    shift
    "$@" "${flags[@]}" "$B/libpinhole.a" -o "$dir/$name" && timeout 20 "$dir/$name" >"$dir/$name.raw"
}

shows() { runs "$@" && cmp "$dir/$1.raw" "$dir/shown.raw"; }

# libpinhole.a stands behind the sources on the command line.
c() { gcc -std=gnu11 "$@"; }
sketch() { local source=$1 && shift && g++ -std=c++11 -include Arduino.h -x c++ "$source" -x none "$@"; }

is_orange() { [ "$(od -An -v -tx1 -w2 "$dir/shown.raw" | grep -c '^ fd 00$')" -gt 5000 ]; }

widget() { # how it is built
    c "${flags[@]}" "$@" tests/tools/displays/lvgl_widget.c tests/tools/displays/lvgl.c "$here/ph_lvgl.c" "$B/libpinhole.a" -o "$dir/widget" && "$dir/widget"
}

lines() { [ "$(wc -l <"$here/ph_lvgl.c")" -lt 300 ]; }

check "ph_show_draws_the_triangle" runs shown c "$dir/shown.c"
check "... in_its_colour" is_orange
check "esp_lcd.c_shows_it" shows esp_lcd c $here/esp_lcd.c tests/tools/displays/esp_main.c
check "pico.c_shows_it" shows pico c $here/pico.c
check "zephyr.c_shows_it" shows zephyr c $here/zephyr.c
check "zephyr.c_shows_it_in_the_order_of_the_machine" shows zephyr_native c -DNATIVE $here/zephyr.c
if command -v g++ >/dev/null; then
    for name in Hello LovyanGFX Arduino_GFX; do check "$name.ino_shows_it" shows $name sketch $here/$name.ino; done
else
    skip "the sketches show it" "no g++ here"
fi
check "lvgl.c_compiles" c "${flags[@]}" -c $here/lvgl.c -o "$dir/lvgl.o"
check "the_widget_shows_what_ph_show_makes" widget -Wextra
check "... in_one_band" widget -DBAND_HEIGHT=48
check "the_widget_has_less_than_300_lines" lines
tap_end
