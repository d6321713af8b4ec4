#!/usr/bin/env bash
# The packaged examples' triangle is built as users build it: by gcc and clang, at -O0, -O2 and -Os, plain and under
# sanitizers. All programs write the same picture, in the material's colour.
# shellcheck disable=SC2317 # functions are called by check
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=${B:-build}
dir=$(mktemp -d) && trap 'rm -rf "$dir"' EXIT
make -s B="$B" "$B/libpinhole.a" >/dev/null || exit 1
mkdir "$dir/pinhole" && cp firmware/core/*.h "$dir/pinhole/"

# A program like an example's main loop: one function draws, another one shows; between them others use the stack. It
# draws at 128 depths of the stack: each time the same picture must come, the last of which is written.
cat >"$dir/show.c" <<'C'
#include "triangle.h"
#include <stdio.h>
#include <string.h>

static unsigned char picture[WIDTH * HEIGHT * 3], first[sizeof picture];

static int flush(void *context, uint32_t x, uint32_t y, uint32_t width, uint32_t height, const void *pixels)
{
    (void)context;
    memcpy(picture + (y * WIDTH + x) * 3, pixels, (size_t)width * height * 3);
    return 0;
}

static int use_stack(volatile unsigned char *rubbish, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        rubbish[i] = 0xA5;
    }
    return rubbish[n / 2] != 0xA5;
}

static int others(void)
{
    unsigned char rubbish[4096];
    return use_stack(rubbish, sizeof rubbish);
}

static int draw_below(struct ph_renderer *r, unsigned depth)
{
    volatile unsigned char room[24];
    room[depth % sizeof room] = 0;
    const int status = depth > 0 ? draw_below(r, depth - 1) : triangle_draw(r, 17);
    return status + room[depth % sizeof room];
}

int main(void)
{
    static uint16_t pixels[WIDTH * BAND * 3 / 2];
    static struct ph_renderer r;
    int status = triangle_init(&r, PH_PIXELS_RGB888);
    r.config.pixels = pixels;
    for (unsigned depth = 0; depth < 128 && status == 0; depth++) {
        status = draw_below(&r, depth);
        status = status != 0 ? status : others();
        status = status != 0 ? status : ph_show(&r, flush, NULL);
        if (depth == 0) {
            memcpy(first, picture, sizeof picture);
        }
        status = status != 0 ? status : memcmp(picture, first, sizeof picture) != 0;
    }
    return status != 0 || fwrite(picture, sizeof picture, 1, stdout) != 1;
}
C

draws() { # name, compiler with its flags
    local name=$1
    shift
    "$@" -std=c11 -Wall -Wextra -Werror -I"$dir" -Ifirmware/core/kernels/portable -Ifirmware/package/examples "$dir/show.c" "$B/libpinhole.a" -o "$dir/$name" &&
        "$dir/$name" >"$dir/$name.rgb" && [ "$(stat -c %s "$dir/$name.rgb")" = $((320 * 240 * 3)) ] && cmp "$dir/$name.rgb" "$dir/first.rgb"
}

# ph_rgb565(255, 160, 0) as RGB888: 5 and 6 bits become 8 by repeating the highest.
orange_pixels() { od -An -v -tx1 -w3 "$1" | grep -c '^ ff a2 00$'; }

has_sanitizers() { echo 'int main(void) { return 0; }' | "$1" -fsanitize=address,undefined -x c - -o "$dir/probe" 2>/dev/null; }

for cc in gcc clang; do
    command -v $cc >/dev/null || { skip "the_example_draws_with_$cc" "no $cc here" && continue; }
    for level in -O0 -O2 -Os; do
        [ -e "$dir/first.rgb" ] || draws first $cc $level >/dev/null 2>&1
        check "the_example_draws_with_${cc}_${level#-}" draws "$cc$level" $cc $level
        has_sanitizers $cc || { skip "... under_sanitizers" "$cc has none here" && continue; }
        check "... under_sanitizers" draws "$cc$level-san" $cc $level -fsanitize=address,undefined -fno-sanitize-recover=all -fsanitize-address-use-after-scope
    done
done
enough() { [ "$(orange_pixels "$dir/first.rgb")" -gt 1000 ]; }
check "the_picture_has_the_materials_colour" enough
tap_end
