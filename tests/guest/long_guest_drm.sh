#!/usr/bin/env bash
# pinhole-panel --drm on displays that a real kernel drives: bochs (page flips) and virtio-gpu (DIRTYFB). What QEMU shows is
# byte for byte what pinhole-sim draws, keys are buttons, and the console is back afterwards, however the program ends.
# shellcheck disable=SC2317,SC2016,SC2015 # functions are called by check; $GUEST is the guest's; `A && B || { cat; return 1; }`
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
. tests/guest/virtual_board.sh
unset MAKEFLAGS
export B
why=$(tests/guest/guest.sh --why)
[ -n "$why" ] || pkg-config --exists libdrm || why="no libdrm-dev"
[ -n "$why" ] || find "/lib/modules/$(guest_kernel)" -name 'bochs.ko*' | grep -q . || why="the kernel has no driver bochs"
command -v convert >/dev/null || why="no ImageMagick"
[ -z "$why" ] || { skip "pinhole-panel draws on the kernel's displays" "$why" && tap_end; }
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
make -s -j2 B="$B" "$B/pinhole-panel" "$B/pinhole-sim" || exit 1

# ---- what the guest does -------------------------------------------------------------------------
# The guest asks the host for what only QEMU can do: `ask NAME COMMAND` gives the monitor a command, and waits for its end.
guest='
    ask() { echo "${@:2}" >$GUEST/$1.new; mv $GUEST/$1.new $GUEST/$1.ask; until [ -e $GUEST/$1.done ]; do sleep 0.05; done; }
    shot() { ask $1 screendump $GUEST_HOST/$1.ppm $2; }
    begin() { # name, argument...
        env --default-signal=INT $B/pinhole-panel --fps 1 --stats "${@:2}" >$GUEST/$1.out 2>$GUEST/$1.err &
        pid=$!
        until grep -q frames/s $GUEST/$1.err || ! kill -0 $pid; do sleep 0.05; done
    }
    # The program stands while QEMU looks, between two frames: where it sleeps until the next is due.
    hold() {
        for ((i = 0; i < 300; i++)); do ! grep -q nanosleep /proc/$pid/wchan && kill -0 $pid && sleep 0.01 || break; done
        kill -STOP $pid; sleep 1; shot $1 $2; kill -CONT $pid
    }
    end() { kill -$2 $pid; wait $pid; echo $? >$GUEST/$1.status; }
    plain() { $B/pinhole-panel "${@:2}" >$GUEST/$1.out 2>$GUEST/$1.err; echo $? >$GUEST/$1.status; }

    modprobe -a bochs && sleep 0.3 && modprobe -a virtio_gpu virtio_input evdev || exit 1
    until [ -e /dev/dri/card1 ] && grep -q "EV=120013" /proc/bus/input/devices; do sleep 0.1; done
    plain list list
    shot bochs-before bochs; shot gpu-before gpu
    begin bochs --drm card0 --demo cube
    hold bochs bochs
    plain second --drm card0 --frames 1
    end bochs INT; shot bochs-after bochs
    begin gpu --drm card1:Virtual-2 --demo cube
    hold gpu gpu
    end gpu TERM; shot gpu-after gpu
    begin turned --drm card1 --demo cube --rotate 90
    hold turned gpu
    end turned KILL; sleep 0.2; shot turned-after gpu
    begin keys --drm card1
    ask press sendkey ret
    lines=$(wc -l <$GUEST/keys.err)
    until [ $(wc -l <$GUEST/keys.err) -gt $((lines + 2)) ] || ! kill -0 $pid; do sleep 0.05; done
    hold keys gpu
    end keys HUP
    plain none --drm card1:DP-7
    setpriv --reuid 65534 --clear-groups $B/pinhole-panel --drm 2>$GUEST/nobody.err; echo $? >$GUEST/nobody.status
    script -qc "stty -g >$GUEST/tty-before; $B/pinhole-panel --drm --frames 9 --fps 9 --demo testcard &
        sleep 0.7; stty -a >$GUEST/tty-during; wait; stty -g >$GUEST/tty-after" /dev/null >/dev/null
'

# ---- the host's part -----------------------------------------------------------------------------
out=$dir/kms
mkdir -p "$out" && mkfifo "$out/monitor.in" "$out/monitor.out"

# A picture is whole when it has the bytes that its head tells of.
is_whole() { [ "$(stat -c %s "$1" 2>/dev/null || echo 0)" = "$(head -n 2 "$1" 2>/dev/null | tr '\0' ' ' | awk 'NR == 2 { print 15 + 3 * $1 * $2 + (length($0) - 7) }')" ]; }

obey() { # file with a command of the monitor
    local command
    command=$(cat "$1")
    echo "$command" >&3
    # shellcheck disable=SC2086 # words
    set -- "$1" $command
    if [ "$2" = screendump ]; then
        until is_whole "$3"; do sleep 0.05; done
    fi
    touch "${1%.ask}.done"
    rm "$1"
}

exec 3<>"$out/monitor.in" 4<>"$out/monitor.out"
cat <&4 >/dev/null &
reader=$!
tests/guest/guest.sh --device bochs-display,id=bochs,xres=640,yres=480 --device virtio-gpu-pci,id=gpu,xres=1280,yres=800 \
    --device virtio-keyboard-pci --monitor --append vt.global_cursor_default=0 --timeout 500 --out "$out" -- \
    env GUEST_HOST="$out" bash -c "$guest" >"$dir/log" 2>&1 3>&- 4>&- &
machine=$!
while kill -0 $machine 2>/dev/null; do
    for asked in "$out"/*.ask; do
        [ ! -e "$asked" ] || obey "$asked"
    done
    sleep 0.05
done
wait $machine
status=$?
kill $reader

# ---- what came out -------------------------------------------------------------------------------

ended() { # name, status
    [ "$(cat "$out/$1.status")" = "$2" ] || { echo "status $(cat "$out/$1.status")" && cat "$out/$1.err" && return 1; }
}

pixels() { tail -c $((3 * $2)) "$1"; } # file, how many

crc_of() { gzip -1 | tail -c 8 | head -c 4 | od -An -tx4 | tr -d ' ' | tr a-f A-F; } # gzip ends with the CRC-32 and the size

# What QEMU shows is one of the first 400 frames, since it looked at some moment on a machine of some speed. The display's
# way back to a picture of pinhole-sim, and from there to the display, is ImageMagick's.
is_a_frame() { # name, pixels of the display, way back, way to the display, pinhole-sim's argument...
    local crc count
    # shellcheck disable=SC2086 # words of $3 and $4
    convert "$out/$1.ppm" $3 -depth 8 "$dir/small.ppm" && convert "$dir/small.ppm" $4 -depth 8 "$dir/large.ppm" || return 1
    cmp <(pixels "$dir/large.ppm" "$2") <(pixels "$out/$1.ppm" "$2") || return 1
    count=$(convert "$dir/small.ppm" -format '%[fx:w*h]' info:)
    crc=$(pixels "$dir/small.ppm" "$count" | crc_of)
    "$B/pinhole-sim" --frames 400 --crc "${@:5}" | grep -q " crc32 $crc\$" || { echo "$1.ppm is none of them: $crc" && return 1; }
}

says_once() { # name, text
    [ "$(wc -l <"$out/$1.err")" = 1 ] && grep -qF -- "$2" "$out/$1.err" || { cat "$out/$1.err" && return 1; }
}

console_is_back() { cmp "$out/$1-before.ppm" "$out/$2-after.ppm"; }

changes_are_less() { # name, bytes of all of a frame: what DIRTYFB is given
    awk -v all="$2" '{ for (i = 1; i < NF; i++) { if ($(i + 1) ~ /^bytes\/frame/ && $i < all * 0.9) { ok = 1 } } } END { exit !ok }' "$out/$1.err" ||
        { cat "$out/$1.err" && return 1; }
}

terminal_is_as_before() {
    cmp "$out/tty-before" "$out/tty-after"
}

check "the guest ran" test "$status" = 0
check "list names the displays and their sizes" eval 'grep -qE "^drm +card0:Virtual-1 +640x480" "$out/list.out" && grep -qE "^drm +card1:Virtual-2 +1280x800" "$out/list.out"'
check "bochs shows what pinhole-sim draws" is_a_frame bochs 307200 '' '' --size 640x480 --demo cube
check "... a second program is told who has the display" says_once second 'no permission'
check "... and leaves it alone" ended second 1
check "Ctrl-C ends it with 130" ended bochs 130
check "... and gives the console back" console_is_back bochs bochs
check "virtio-gpu shows it twice as large" is_a_frame gpu 1024000 '-sample 50%' '-sample 200%' --size 640x400 --demo cube
check "... and is given changes only" changes_are_less gpu 4096000
check "SIGTERM ends it with 143" ended gpu 143
check "... and gives the console back" console_is_back gpu gpu
check "a turned picture is turned clockwise" is_a_frame turned 1024000 '-sample 50% -rotate -90' '-rotate 90 -sample 200%' --size 400x640 --demo cube
check "the kernel gives the console back after SIGKILL" console_is_back gpu turned
check "Enter takes the next demo" is_a_frame keys 1024000 '-sample 50%' '-sample 200%' --size 640x400 --demo testcard
check "SIGHUP ends it with 129" ended keys 129
check "a display that is not there is one line" says_once none 'no such display is connected'
check "... and status 1" ended none 1
check "without permission it says which group" says_once nobody 'join the group video'
check "the terminal is as before" terminal_is_as_before
[ "$tap_failed" = 0 ] || sed 's/^/# /' "$dir/log" "$out/kernel.log" | tail -n 40
tap_end
