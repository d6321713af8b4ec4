#!/usr/bin/env bash
# Usage: tests/guest/guest.sh [--bufsiz N] [--timeout S] [--out DIR] [--memory MB] [--cpus N] [--append TEXT] [--icount]
#                             [--device TEXT]... [--monitor] -- COMMAND...
#        tests/guest/guest.sh --why | --kernel
# Runs COMMAND as root in a QEMU guest with Debian's own kernel and returns its exit status, stdout and stderr;
# 124: it took longer than S seconds (600 by default); 125: the guest died, or could not be started (one line says why).
# --why prints why no guest can run here (exit 1), or nothing (exit 0): a test then says `skip`. --kernel
# prints the version of the kernel that is taken.
#
# The guest's root is this machine's, read-only; what COMMAND writes is forgotten, but for $GUEST (/run/guest in the guest):
# that directory is DIR of --out (its files remain, with stdout, stderr, kernel.log and console.log), else a temporary
# one. COMMAND starts in the current directory, with PATH and B of the caller. --bufsiz is spidev's, on the kernel's
# command line as --append's TEXT is. The kernel is unpacked once, below $B/guest. --icount: time in the guest goes by
# the instructions that it runs, so that a time-out in it means the same on a busy machine; it takes a third longer.
# --device adds a device of QEMU's. --monitor: QEMU's monitor reads the FIFO DIR/monitor.in and writes DIR/monitor.out.
# Environment: B (build directory).
set -u
B=$(realpath -m "${B:-build}") # a guest also works elsewhere
tests=$(cd "$(dirname "$0")" && pwd)
seconds=600 icount=() devices=() monitor='' out='' memory=512 cpus=1 append=''
PATH=$PATH:/usr/sbin:/sbin

fail() { # status, text
    echo "guest.sh: $2" >&2
    exit "$1"
}

# The newest kernel that has an image and the modules for it; one with headers is preferred.
kernel_version() {
    local image version found=''
    for image in $(printf '%s\n' /boot/vmlinuz-* | sort -rV); do
        version=${image#/boot/vmlinuz-}
        [[ -r $image && -d /lib/modules/$version/kernel ]] || continue
        [ ! -e "/lib/modules/$version/build/Makefile" ] || { echo "$version" && return; }
        found=${found:-$version}
    done
    [ -n "$found" ] && echo "$found"
}

why_not() {
    [ "$(uname -m)" = x86_64 ] || { echo "this machine is no x86-64" && return; }
    command -v qemu-system-x86_64 >/dev/null || { echo "no qemu-system-x86" && return; }
    kernel_version >/dev/null || { echo "no kernel with its modules (linux-image-amd64)" && return; }
    command -v cpio >/dev/null || { echo "no cpio" && return; }
    command -v modprobe >/dev/null || { echo "no kmod" && return; }
    command -v unxz >/dev/null || { echo "no xz-utils" && return; }
    command -v gcc >/dev/null || { echo "no gcc" && return; }
}

# The ELF inside of the image: QEMU enters it directly, which saves its unpacking at every start.
unpack_kernel() { # image, file
    local at
    at=$(LC_ALL=C grep -abo $'\xfd7zXZ' "$1" | head -n 1 | cut -d: -f1)
    if [ -n "$at" ]; then
        # What follows the packed kernel is no xz: the status says so.
        tail -c +$((at + 1)) "$1" | unxz >"$2" 2>/dev/null
        [ "$(head -c 4 "$2")" = $'\x7fELF' ] && return
    fi
    cp "$1" "$2" # packed in another way: slower, but it starts too
}

# First process and the modules that reach the host's files, as QEMU's -initrd wants them.
make_initrd() { # version, directory
    local number=10 path name
    mkdir -p "$2/initrd/modules"
    gcc -std=c11 -O1 -Wall -Wextra -Werror -static -o "$2/initrd/init" "$tests/guest_init.c" || return 1
    modprobe -S "$1" -a --show-depends virtio_pci 9pnet_virtio 9p overlay | awk '$1 == "insmod" && !seen[$2]++ { print $2 }' >"$2/list"
    while read -r path; do
        number=$((number + 1))
        name=$2/initrd/modules/$number-$(basename "$path")
        cp "$path" "$name" || return 1
        [[ $name != *.xz ]] || unxz "$name" || return 1
    done <"$2/list"
    (cd "$2/initrd" && find . | cpio -o -H newc --quiet) >"$2/initrd.cpio"
}

# Makes the directory with the unpacked kernel and the initrd when it is not there.
make_kernel() { # version, directory
    local new
    [ "$2/initrd.cpio" -nt "$tests/guest_init.c" ] && [ "$2/vmlinux" -nt "/boot/vmlinuz-$1" ] && return
    new=$(mktemp -d "$B/guest/new.XXXXXX") || return 1
    if ! unpack_kernel "/boot/vmlinuz-$1" "$new/vmlinux" || ! make_initrd "$1" "$new"; then
        rm -rf "$new"
        return 1
    fi
    rm -rf "$2" && mv -T "$new" "$2"
}

# Sets $kernel to it; one script at a time.
find_kernel() {
    local version
    version=$(kernel_version)
    kernel=$B/guest/kernel-$version
    mkdir -p "$B/guest" && (flock 9 && make_kernel "$version" "$kernel") 9>"$B/guest/lock"
}

write_command() { # word...
    {
        printf 'cd %q && export GUEST=/run/guest HOME=/root PATH=%q B=%q\n' "$PWD" "$PATH" "$B"
        printf '%q ' "$@"
        echo
    } >"$out/command"
}

# QEMU, and nothing that outlives this script, however it ends.
start_qemu() {
    setpriv --pdeathsig KILL -- timeout --foreground -s KILL "$seconds" setpriv --pdeathsig KILL -- \
        qemu-system-x86_64 -accel tcg "${icount[@]}" "${devices[@]}" -M pc,usb=off -m "$memory" -smp "$cpus" -nodefaults -no-user-config -display none -no-reboot \
        -kernel "$kernel/vmlinux" -initrd "$kernel/initrd.cpio" -serial "file:$out/console.log" \
        -append "console=ttyS0 quiet loglevel=4 panic=-1 no_timer_check tsc=reliable mitigations=off nokaslr $append" \
        -fsdev local,id=host,path=/,security_model=none,readonly=on,multidevs=remap \
        -device virtio-9p-pci,fsdev=host,mount_tag=host \
        -fsdev "local,id=guest,path=$out,security_model=none" -device virtio-9p-pci,fsdev=guest,mount_tag=guest \
        </dev/null >"$out/qemu.log" 2>&1 &
    qemu=$!
    wait "$qemu"
}

arguments() {
    while [ $# -gt 0 ]; do
        case $1 in
        --) shift && command=("$@") && return ;;
        --why) why_not | grep . && exit 1 || exit 0 ;;
        --icount) icount=(-icount "shift=2,sleep=on") && shift && continue ;;
        --kernel) kernel_version && exit 0 || exit 1 ;;
        --monitor) monitor=1 && shift && continue ;;
        --device) devices+=(-device "${2:?}") ;;
        --bufsiz) append="$append spidev.bufsiz=${2:?}" ;;
        --timeout) seconds=${2:?} ;;
        --out) out=${2:?} ;;
        --memory) memory=${2:?} ;;
        --cpus) cpus=${2:?} ;;
        --append) append="$append ${2:?}" ;;
        *) fail 125 "$1: wrong option; usage is in its head" ;;
        esac
        shift 2
    done
}

command=()
arguments "$@"
[ ${#command[@]} -gt 0 ] || fail 125 "-- COMMAND is missing"
reason=$(why_not)
[ -z "$reason" ] || fail 125 "no guest can run here: $reason"
find_kernel || fail 125 "the kernel cannot be unpacked below $B/guest"
if [ -n "$out" ]; then
    mkdir -p "$out" || exit 125
else
    out=$(mktemp -d) || exit 125
    trap 'rm -rf "$out"' EXIT
fi
out=$(cd "$out" && pwd)
rm -f "$out/status" "$out/kernel.log"
: >"$out/stdout"
: >"$out/stderr"
write_command "${command[@]}"
if [ -n "$monitor" ]; then
    { [ -p "$out/monitor.in" ] || mkfifo "$out/monitor.in" "$out/monitor.out"; } || exit 125
    devices+=(-chardev "pipe,id=monitor,path=$out/monitor" -mon monitor)
fi
trap 'kill -KILL "${qemu:-}" 2>/dev/null; exit 130' INT TERM HUP
start_qemu
ended=$?
cat "$out/stdout"
cat "$out/stderr" >&2
[ -s "$out/status" ] && exit "$(cat "$out/status")"
[ $ended -ne 137 ] || fail 124 "no end after $seconds seconds"
last=$(grep -h -m 1 -e 'Kernel panic' "$out/console.log" || grep -h . "$out/qemu.log" "$out/console.log" | tail -n 1)
fail 125 "the guest died: ${last:-without a word}"
