#!/usr/bin/env bash
# pinhole-sim --window on a virtual screen: what it shows is what the glass shows, at the rate of the kit's bus, and the
# keyboard is the kit's buttons. Some of what is tried is left to long_window.sh.
# shellcheck disable=SC2317,SC2015 # functions are called by check; `A && B || { echo; return 1; }` says why it fails
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
B=${B:-build}
sim=$(realpath "$B/pinhole-sim") || exit 1
dir=$(mktemp -d) || exit 1
xvfb=
trap 'kill $xvfb 2>/dev/null; rm -rf "$dir"' EXIT
kit=(--board pico-display-2)
title='Pico Display Pack 2.0'

# Starts pinhole-sim with these options and waits for a picture in its window: its process in $pid, its window in $id.
start() {
    "$sim" --window "${kit[@]}" "$@" >"$dir/stdout" 2>"$dir/stderr" &
    pid=$!
    id=$(timeout 600 xdotool search --sync --onlyvisible --name "$title" | head -n 1)
    [ -n "$id" ] && patiently has_a_picture
}

patiently() { # command: until it succeeds, ten minutes at most
    local i
    for ((i = 0; i < 6000; i++)); do "$@" && return; sleep .1; done
    false
}

has_a_picture() { [ "$(import -window "$id" -format %k info: 2>/dev/null || echo 1)" -gt 1 ]; }

ended() { # the process of the window: its exit status, killed after ten minutes
    local i
    for ((i = 0; i < 6000; i++)); do
        kill -0 "$pid" 2>/dev/null || break
        sleep .1
    done
    kill -9 "$pid" 2>/dev/null
    wait "$pid"
}

shot() { # file: the window, scaled down again
    import -window "$id" "$dir/shot.ppm" && identify -format '%wx%h' "$dir/shot.ppm" >"$dir/shot.size" &&
        convert "$dir/shot.ppm" -sample 50% -depth 8 "$1"
}

is_the_glass() { # file, demo: same pixels
    "$sim" "${kit[@]}" --demo "$2" --out "$dir/glass.ppm" && cmp "$dir/glass.ppm" "$1"
}

shows() { shot "$2" && is_the_glass "$2" "$1" >"$dir/compared" 2>&1; } # demo, file for the picture

it_shows_the_glass_scaled_by_two() { # 320x240 on a screen of 1024x768
    start --demo testcard && patiently shows testcard "$dir/a.ppm"
    xdotool key --window 0 Escape
    ended && [ "$(cat "$dir/shot.size")" = 640x480 ] && is_the_glass "$dir/a.ppm" testcard &&
        cmp <(convert "$dir/shot.ppm" -depth 8 rgb:-) <(convert "$dir/glass.ppm" -scale 200% -depth 8 rgb:-)
}

escape_ends_it() {
    start && xdotool key Escape && ended
}

closing_it_ends_it() {
    cat >"$dir/close.c" <<'END'
#include <X11/Xlib.h>
#include <stdlib.h>
int main(int argc, char **argv) /* asks a window to close, as a window manager does */
{
    Display *d = XOpenDisplay(NULL);
    if (argc != 2 || d == NULL) {
        return 1;
    }
    XEvent e = {.xclient = {.type = ClientMessage, .window = strtoul(argv[1], NULL, 0), .format = 32}};
    e.xclient.message_type = XInternAtom(d, "WM_PROTOCOLS", False);
    e.xclient.data.l[0] = (long)XInternAtom(d, "WM_DELETE_WINDOW", False);
    XSendEvent(d, e.xclient.window, False, NoEventMask, &e);
    return XCloseDisplay(d);
}
END
    cc "$dir/close.c" -lX11 -o "$dir/close" && start && "$dir/close" "$id" && ended
}

titled() { [[ $(xdotool getwindowname "$id") = "turntable - "*", 320x240$1" ]]; } # what follows the size

it_pauses_steps_and_saves() {
    (cd "$dir" && start --demo turntable && xdotool key p && patiently titled ' - paused' &&
        xdotool key s && patiently saved 1 && xdotool key --delay 0 n s && patiently saved 2 && xdotool key p && patiently titled '' &&
        xdotool key Escape && ended) || return 1
    local file frame
    for file in "$dir"/pinhole-turntable-*.png; do # one frame, and the next
        frame=${file##*-} && frame=$((10#${frame%.png}))
        "$sim" "${kit[@]}" --demo turntable --start "$frame" --check "$file" || return 1
        echo "$frame"
    done | xargs | awk '{ exit !($2 == $1 + 1) }'
}

saved() { [ "$(grep -c 'pinhole-turntable-[0-9]*.png is saved$' "$dir/stderr")" = "$1" ]; } # pictures

a_signal_ends_it() {
    start && kill "$pid"
    ended
    [ $? = 143 ]
}

a_signal_keeps_the_gif() { # that the window records
    local signal status
    [ -e /usr/include/gif_lib.h ] || return 0
    for signal in INT TERM; do
        rm -f "$dir/record.gif"
        env --default-signal=INT "$sim" --window "${kit[@]}" --out "$dir/record.gif" >"$dir/stdout" 2>"$dir/stderr" &
        pid=$!
        id=$(timeout 600 xdotool search --sync --onlyvisible --name "$title" | head -n 1)
        [ -n "$id" ] && patiently has_a_picture && kill "-$signal" "$pid"
        ended
        status=$?
        [ "$status" -gt 128 ] && [ "$(identify "$dir/record.gif" | wc -l)" -ge 1 ] && ! ls "$dir/record.gif"?* 2>/dev/null || { echo "exit $status" && return 1; }
    done
}

select_takes_the_next_demo() { # the second on the list is a still picture
    local key
    for key in Return space; do
        start --demo turntable && xdotool key "$key" && patiently shows testcard "$dir/b.ppm"
        xdotool key Escape
        ended && is_the_glass "$dir/b.ppm" testcard || return 1
    done
}

an_arrow_moves_the_camera() { # key: from some frame on, and not before
    "$sim" "${kit[@]}" --demo turntable --frames 20 --crc >"$dir/alone" && start --demo turntable --crc &&
        xdotool keydown "$1" && sleep 1.5 && xdotool keyup "$1" key Escape
    ended && [ "$(head -n 1 "$dir/stdout")" = "$(head -n 1 "$dir/alone")" ] || return 1
    "$sim" "${kit[@]}" --demo turntable --frames "$(wc -l <"$dir/stdout")" --crc >"$dir/alone"
    ! cmp -s "$dir/stdout" "$dir/alone"
}

# Runs until Escape; what was printed last is the frame that these options give.
ends_like() { # option...
    local frame
    xdotool key Escape
    ended && frame=$(wc -l <"$dir/stdout") && "$sim" --frames "$frame" --crc "$@" | tail -n 1 | cmp - <(tail -n 1 "$dir/stdout")
}

# 128 pixels of the screen are 64 of the picture, a quarter of a turn, as 64 frames of an arrow; a notch is an eighth of the way that the camera can come
# nearer, as 4 frames of an arrow.
the_mouse_turns_and_the_wheel_moves() {
    printf '0 left 64\n0 up 8\n' >"$dir/keys"
    start --demo turntable --crc && xdotool mousemove --window "$id" 300 200 mousedown 1 && sleep .2 &&
        xdotool mousemove --window "$id" 350 200 mousemove --window "$id" 428 200 && sleep .2 &&
        xdotool mouseup 1 mousemove --window "$id" 100 100 click 4 click 4 && sleep 2 || return 1
    ends_like "${kit[@]}" --demo turntable --keys "$dir/keys"
}

# The camera rises while the mouse goes down, and is back where it was when the mouse is.
the_mouse_lifts_the_camera() {
    local back
    printf '' >"$dir/keys"
    for back in 240 200; do
        start --demo turntable --crc && xdotool mousemove --window "$id" 300 200 mousedown 1 && sleep .2 &&
            xdotool mousemove --window "$id" 300 240 && sleep .2 && xdotool mousemove --window "$id" 300 "$back" && sleep .2 &&
            xdotool mouseup 1 mousemove --window "$id" 100 100 && sleep 2 || return 1
        if [ "$back" = 200 ]; then
            ends_like "${kit[@]}" --demo turntable --keys "$dir/keys" || return 1
        elif ends_like "${kit[@]}" --demo turntable --keys "$dir/keys"; then
            return 1
        fi
    done
}

without_a_kit_the_glass_follows_the_window() { # 8 pixels of the screen for one of the picture's
    local kit=(--size 96x64) title='no kit'
    start --demo cube --camera eye=2,1,5 --crc && xdotool windowsize "$id" 808 480 && sleep 2 || return 1
    ends_like --size 101x60 --demo cube --camera eye=2,1,5
}

a_kit_keeps_its_glass() {
    start --demo cube --crc && xdotool windowsize "$id" 500 480 && sleep 1 || return 1
    ends_like "${kit[@]}" --demo cube
}

# A quarter of the glass: all of it is seen, not its middle. (Nearest pixels differ by .21, a crop by .49.)
a_small_window_shows_all_of_the_glass() {
    local far
    start --demo testcard && xdotool windowsize "$id" 160 120 && patiently has_size 160x120 && sleep 1 && import -window "$id" "$dir/small.ppm"
    xdotool key --window 0 Escape
    ended && "$sim" "${kit[@]}" --demo testcard --out "$dir/glass.ppm" && convert "$dir/glass.ppm" -sample 160x120 "$dir/half.ppm" || return 1
    far=$(compare -metric RMSE "$dir/half.ppm" "$dir/small.ppm" null: 2>&1 | sed 's/.*(\(.*\))/\1/')
    awk -v far="$far" 'BEGIN { print far; exit !(far < .3) }'
}
has_size() { [ "$(import -window "$id" -format %wx%h info: 2>/dev/null)" = "$1" ]; }

frames_limit_it() {
    "$sim" --window "${kit[@]}" --frames 7 --crc >"$dir/seven" && cmp "$dir/seven" <("$sim" "${kit[@]}" --frames 7 --crc)
}

milliseconds() { # of a command
    local before
    before=$(date +%s%3N)
    "$@" >"$dir/stdout" || return 1
    echo $(($(date +%s%3N) - before))
}

it_keeps_the_rate_of_the_bus() { # 40 frames; the bus takes 19.7 ms, faster ones are held at 60 a second
    local us ms least options
    for options in "${kit[*]}" "--size 32x32"; do
        read -ra options <<<"$options"
        us=$("$sim" "${options[@]}" --demo cube --stats 2>&1 | sed -n 's/.* bus \([0-9]*\) us.*/\1/p')
        least=$(((us > 16667 ? us : 16667) * 39 / 1000))
        ms=$(milliseconds "$sim" --window "${options[@]}" --demo cube --frames 40)
        [ "$ms" -ge "$least" ] && [ "$ms" -le $((least * 2 + 30000)) ] || { echo "$ms ms, not $least" && return 1; }
    done
    [ "$us" -lt 16667 ]
}

refuses() { # pattern, command...: exit 1 and one line
    local pattern=$1 got=0
    shift
    timeout 600 "$@" >"$dir/stdout" 2>"$dir/stderr" || got=$?
    [ "$got" = 1 ] && [ "$(wc -l <"$dir/stderr")" = 1 ] && grep -q "^pinhole.*$pattern" "$dir/stderr" && [ ! -s "$dir/stdout" ] ||
        { echo "exit $got" && cat "$dir/stderr" && return 1; }
}

without_sdl2_it_says_what_to_install() { # nosdl's window comes before the library's
    local libraries wraps
    # shellcheck disable=SC2016 # make's variable
    read -ra wraps < <(sed -n 's|^$(B)/pinhole-sim:.* \(-Wl[^ ]*\).*|\1|p' Makefile | xargs)
    read -ra libraries < <({ pkg-config --libs assimp; pkg-config --libs libpng; pkg-config --libs libjpeg; pkg-config --libs libwebp; [ ! -e /usr/include/gif_lib.h ] || echo -lgif; [ ! -e /usr/include/meshoptimizer.h ] || echo -lmeshoptimizer; } 2>/dev/null | xargs)
    ${CC:-cc} -std=c11 -Ifirmware/core -Ihost-sim/common -Ihost-sim/sim host-sim/sim/nosdl/sim_window.c "$B/host-sim/sim/pinhole_sim.o" "$B"/libpinhole-{host,app,hal}.a "$B/libpinhole.a" \
        "${wraps[@]}" "${libraries[@]}" -lm -o "$dir/nosdl" && refuses libsdl2-dev "$dir/nosdl" --window &&
        "$dir/nosdl" --crc --size 8x8
}

quick=(it_shows_the_glass_scaled_by_two it_pauses_steps_and_saves the_mouse_turns_and_the_wheel_moves without_a_kit_the_glass_follows_the_window frames_limit_it)
tests=(escape_ends_it closing_it_ends_it a_signal_ends_it a_signal_keeps_the_gif select_takes_the_next_demo the_mouse_lifts_the_camera a_kit_keeps_its_glass
    a_small_window_shows_all_of_the_glass it_keeps_the_rate_of_the_bus)

long without_sdl2_it_says_what_to_install without_sdl2_it_says_what_to_install
missing=
pkg-config --exists sdl2 || missing=libsdl2-dev
for need in Xvfb:xvfb xdotool:xdotool import:imagemagick; do
    command -v "${need%:*}" >/dev/null || missing=${need#*:}
done
if [ -n "$missing" ]; then
    for name in "${quick[@]}" "${tests[@]}" left_moves_the_camera up_moves_the_camera without_a_screen_it_is_one_line; do skip "$name" "no $missing"; done
    tap_end
fi

short without_a_screen_it_is_one_line refuses "no screen" env -u DISPLAY -u WAYLAND_DISPLAY -u XDG_RUNTIME_DIR "$sim" --window
Xvfb -displayfd 3 -screen 0 1024x768x24 -nolisten tcp 3>"$dir/display" >"$dir/xvfb.log" 2>&1 &
xvfb=$!
for ((i = 0; i < 6000; i++)); do [ ! -s "$dir/display" ] || break; sleep .1; done
DISPLAY=:$(cat "$dir/display")
export DISPLAY
unset SDL_VIDEODRIVER WAYLAND_DISPLAY
for name in "${quick[@]}"; do short "$name" "$name"; done
short left_moves_the_camera an_arrow_moves_the_camera Left
for name in "${tests[@]}"; do long "$name" "$name"; done
long up_moves_the_camera an_arrow_moves_the_camera Up
tap_end
