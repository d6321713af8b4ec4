# shellcheck shell=bash
# A Debian 13 in a folder, for scripts: `. tests/debian13/root.sh`. It is made once, from this machine's own package
# sources with the suite's name replaced, and stays in $B/debian13/root. One script at a time uses it: the others wait.
#   debian13_make         makes it when it is not there; returns 1, with the reason in $debian13_why, when it cannot be had
#   debian13_copy         copies the tree's files to /pinhole in it; what an earlier copy built there is gone
#   debian13 COMMAND...   runs COMMAND as root in it, in /pinhole; nothing that COMMAND starts outlives it
# debian_sources, debian_cannot, debian_copy and debian_run serve any root.
# By hand: bash -c '. tests/debian13/root.sh; debian13_make && debian13_copy && debian13 make check'
# Environment: B (build directory).
B=${B:-build}
debian13_root=$(realpath -m "$B/debian13/root")
debian13_log=$B/debian13/mmdebstrap.log
# Compilers, the libraries of tests/tools/packages, what builds Debian packages, and what a virtual board needs: a kernel with
# its headers, a QEMU.
debian13_packages="make gcc clang gcc-arm-none-eabi libnewlib-arm-none-eabi qemu-system-arm pkgconf procps picotool git build-essential dpkg-dev debhelper lintian help2man $(awk -F '[| ]+' '/^test/ && $2 ~ /-dev$/ { print $2 }' tests/tools/packages | xargs)"
[ "$(uname -m)" != x86_64 ] ||
    debian13_packages+=' linux-image-amd64 linux-headers-amd64 qemu-system-x86 kmod cpio xz-utils gpiod'

# This machine's Debian in its package sources, and another suite in its place.
debian_sources() { # suite, directory for the files
    local codename file
    codename=$(. /etc/os-release && echo "$VERSION_CODENAME")
    for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
        ! grep -v '^#' "$file" 2>/dev/null | grep -w "$codename" >/dev/null ||
            sed "s/\<$codename\>/$1/g" "$file" >"$2/$(basename "$file")"
    done
}

debian_cannot() {
    [ "$(id -u)" = 0 ] || { echo "only root can make a Debian root" && return; }
    command -v mmdebstrap >/dev/null || { echo "no mmdebstrap" && return; }
    command -v unshare >/dev/null || { echo "no unshare (util-linux)" && return; }
    (. /etc/os-release && [ "$ID" = debian ]) || { echo "this machine is no Debian" && return; }
}

debian13_bootstrap() {
    local new status=0
    new=$(mktemp -d "$B/debian13/new.XXXXXX") || return 1
    mkdir "$new/sources" && debian_sources trixie "$new/sources"
    # shellcheck disable=SC2086 # the packages' names are words
    timeout 900 mmdebstrap --variant=apt --include="$(echo $debian13_packages | tr ' ' ,)" \
        --dpkgopt=force-unsafe-io --aptopt='APT::Install-Recommends "false"' --aptopt='Acquire::http::Timeout "20"' --aptopt='Acquire::Retries "2"' \
        trixie "$new/system" "$new"/sources/* >"$debian13_log" 2>&1 </dev/null &&
        echo "$debian13_packages" >"$new/system/etc/pinhole-packages" &&
        { [ ! -e "$debian13_root" ] || mv -T "$debian13_root" "$new/old"; } && mv -T "$new/system" "$debian13_root" || status=1
    rm -rf "$new"
    return $status
}

debian13_make() {
    debian13_why=$(debian_cannot)
    [ -z "$debian13_why" ] || return 1
    mkdir -p "$B/debian13"
    exec 9>"$B/debian13/lock" && flock 9
    [ "$(cat "$debian13_root/etc/pinhole-packages" 2>/dev/null)" != "$debian13_packages" ] || return 0
    debian13_bootstrap && return
    debian13_why="Debian 13 cannot be had: $(grep -m 1 '^E:' "$debian13_log" || tail -n 1 "$debian13_log")"
    return 1
}

# The files that git knows, or all but the build directory.
debian_copy() { # root
    rm -rf "$1/pinhole" && mkdir "$1/pinhole" || return 1
    { git ls-files -coz --exclude-standard 2>/dev/null | grep -z . || find . -path "./$B" -prune -o -path ./.git -prune -o -type f -print0; } |
        tar -c --null --files-from=- | tar -x --no-same-owner -C "$1/pinhole"
}

# shellcheck disable=SC2016 # $0 and $@ are the inner shell's
debian_run() { # root, command...
    unshare --mount --pid --fork --kill-child --mount-proc="$1/proc" bash -c '
        mount --rbind /dev "$0/dev" && mount -t sysfs -o ro sysfs "$0/sys" || exit 1
        env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 chroot "$0" env -C /pinhole "$@"' "$@" </dev/null
}

debian13_copy() { debian_copy "$debian13_root"; }
debian13() { debian_run "$debian13_root" "$@"; }
