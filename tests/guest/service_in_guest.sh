#!/usr/bin/env bash
# The systemd unit in a guest, under a systemd of its own: run by long_guest_service.sh. Leaves in $GUEST what systemd says of the
# unit (NAME.show), what the wires carried (NAME.events) and systemd's log. Environment: B, UNIT (the unit's file).
# shellcheck source-path=SCRIPTDIR
# shellcheck disable=SC2119,SC2153 # board_plug takes no argument here; UNIT is the environment's
set -u
. tests/guest/virtual_board.sh
unit=/run/systemd/system/pinhole.service

for group in spi gpio plugdev; do groupadd -rf $group; done
mkdir -p $unit.d
sed "s|^ExecStart=[^ ]*|ExecStart=$B/pinhole-panel|" "$UNIT" >$unit
printf '[Unit]\nDefaultDependencies=no\n' | tee $unit.d/alone.conf >/run/systemd/system/only.target # nothing else is started
mount -t cgroup2 cgroup2 /sys/fs/cgroup
unshare --pid --fork --mount-proc env container=guest SYSTEMD_LOG_TARGET=console /lib/systemd/systemd --unit=only.target &
parent=$!

ctl() { nsenter -t "$(pgrep -P $parent)" -p -m -- systemctl "$@"; }
until ctl is-system-running 2>/dev/null | grep -q 'running\|degraded'; do sleep .2; done

plug() { # a board with the groups of 60-pinhole.rules
    rmmod virtual_board 2>/dev/null
    board_plug
    until [ -e /dev/spidev0.0 ] && [ -e /dev/gpiochip0 ]; do sleep .1; done
    chgrp spi /dev/spidev* && chgrp gpio /dev/gpiochip* && chmod 660 /dev/spidev* /dev/gpiochip*
}

options() { # of pinhole-panel, as `systemctl edit` sets them
    printf '[Service]\nEnvironment="PINHOLE=%s"\n%s\n' "$1" "${2-}" >$unit.d/override.conf
    ctl daemon-reload
}

show() { ctl show pinhole -p ActiveState -p Result -p ExecMainCode -p ExecMainStatus -p NRestarts >"$GUEST/$1.show"; }

# Waits until the service has ended by itself: ten minutes at most.
ends() {
    local i
    for ((i = 0; i < 3000; i++)); do
        case $(ctl show pinhole -p ActiveState --value) in inactive | failed) return ;; esac
        sleep .2
    done
}

once() { # name, options of pinhole-panel: one run to its end
    options "$2"
    ctl start pinhole
    ends
    show "$1"
}

plug
once frames "--board rpi-waveshare-1in3 --demo turntable --frames 2"
board_events >"$GUEST/frames.events"

printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >/run/one.obj # a child process reads it, with limits of its own
plug
once model "--board rpi-waveshare-1in3 --model /run/one.obj --frames 2"
board_events >"$GUEST/model.events"

usb_plug ft232h --events "$GUEST/usb.events"
chgrp -R plugdev /dev/bus/usb && chmod -R g+rwX /dev/bus/usb
once usb "--board ft232h-st7789 --frames 2"
kill "$usb_device"

plug
options "--board rpi-waveshare-1in3 --demo turntable"
board_follow /run/stopped.events
ctl start pinhole
until grep -q ' spi ' /run/stopped.events; do sleep .2; done
sleep 3
ctl stop pinhole
show stopped
board_follow_end
tail -n 40 /run/stopped.events >"$GUEST/stopped.events"

options "--no-such-option" RestartSec=1
ctl start pinhole
ends
sleep 4
show wrong
options "--board rpi-waveshare-1in3 --spi /dev/spidev9.9" RestartSec=1 # may be plugged in later
ctl start pinhole
for ((i = 0; i < 3000; i++)); do # until it was tried again and has failed again: while it runs its exit status is 0
    show absent
    if ! grep -qx NRestarts=0 "$GUEST/absent.show" && grep -qx ExecMainStatus=1 "$GUEST/absent.show"; then break; fi
    sleep .2
done
ctl stop pinhole
