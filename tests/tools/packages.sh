#!/usr/bin/env bash
# Usage: tests/tools/packages.sh test|lint
# Installs the Debian packages in tests/tools/packages that are not there yet; does nothing when all are. Says first which
# and how much they take; apt's own messages are shown. As somebody who may not install it says the one command to paste.
# Nothing here ends apt: after Ctrl-C or a signal this waits until apt has left the system whole. Packages that are there
# are never removed. Always exits 0 unless it was interrupted: what cannot be had is named, with what is skipped for the
# lack of it.
# PACKAGES_INSTALL=0: only says what is missing, and the command.
set -u
cd "$(dirname "$0")" || exit 1

case "${1-}" in
test | lint) ;;
*) echo "usage: $0 test|lint" >&2 && exit 2 ;;
esac

gcc=$(gcc -dumpversion 2>/dev/null || echo 12) # gcc-N-multilib is that of this gcc

# Prints "package|what is skipped" for each package that is missing.
missing() {
    sed -n "s/^$1 *| *//p" packages | sed 's/\\|/\x01/g' | while IFS='|' read -r package probe skipped; do
        probe=${probe//$'\x01'/|}
        package=${package// /} package=${package/gcc-N-/gcc-$gcc-}
        bash -c "$probe" >/dev/null 2>&1 </dev/null || echo "$package|${skipped# }"
    done
}

root=()
[ "$(id -u)" = 0 ] || root=(sudo -n)

# In a session of its own, where the terminal's Ctrl-C does not reach it.
apt() {
    setsid "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 "$@" </dev/null &
    local pid=$! status=0
    wait $pid || status=$?
    while kill -0 $pid 2>/dev/null; do # a signal ended the wait, not apt
        wait $pid || status=$?
    done
    return $status
}

interrupted=
trap 'interrupted=1; echo "packages: interrupted; apt finishes what it has begun, so that the system stays whole" >&2' INT TERM HUP

# Names that this machine's sources do not have would keep apt from saying how much the others take.
unknown() {
    local package
    for package; do
        apt-cache show --no-all-versions "$package" >/dev/null 2>&1 || echo "$package"
    done
}

# How much apt would fetch and fill: its own two lines.
sizes() { LC_ALL=C apt-get --assume-no --no-remove install --no-install-recommends "$@" 2>/dev/null </dev/null | grep -E '^(Need to get|After this)'; }

install() { apt install --yes --no-remove --no-install-recommends "$@"; }

lacking=$(missing "$1")
[ -n "$lacking" ] || exit 0
mapfile -t packages < <(cut -d'|' -f1 <<<"$lacking")
echo "packages: ${#packages[@]} are missing: ${packages[*]}"
if ! command -v apt-get >/dev/null; then
    echo "packages: there is no apt-get here; install what your system calls these, or go without"
elif [ "${PACKAGES_INSTALL-1}" = 0 ] || { [ "$(id -u)" != 0 ] && ! sudo -n true 2>/dev/null; }; then
    echo "packages: to install them: sudo apt-get install --no-install-recommends ${packages[*]}"
else
    apt update
    mapfile -t strangers < <(unknown "${packages[@]}")
    if [ ${#strangers[@]} -gt 0 ]; then
        echo "packages: this machine's sources have no ${strangers[*]}"
        mapfile -t packages < <(printf '%s\n' "${packages[@]}" | grep -vxF "$(printf '%s\n' "${strangers[@]}")")
    fi
    sizes "${packages[@]}" | sed 's/^/packages: /'
    # One package that cannot be had must not keep the others out.
    if [ -z "$interrupted" ] && ! install "${packages[@]}"; then
        for package in "${packages[@]}"; do
            [ -n "$interrupted" ] || install "$package"
        done
    fi
    [ -z "$interrupted" ] || exit 130
    lacking=$(missing "$1")
fi
while IFS='|' read -r package skipped; do
    [ -z "$package" ] || echo "packages: $package is missing, so this is skipped: $skipped"
done <<<"$lacking"
exit 0
