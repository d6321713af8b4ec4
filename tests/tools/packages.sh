#!/usr/bin/env bash
# Usage: tests/tools/packages.sh test|lint
# Installs the Debian packages in tests/tools/packages that are not there yet; does nothing when all are. Always exits 0:
# what cannot be had is named, with what is skipped for the lack of it.
set -u
cd "$(dirname "$0")" || exit 1

case "${1-}" in
test | lint) ;;
*) echo "usage: $0 test|lint" >&2 && exit 2 ;;
esac

# Prints "package|what is skipped" for each package that is missing.
missing() {
    sed -n "s/^$1 *| *//p" packages | sed 's/\\|/\x01/g' | while IFS='|' read -r package probe skipped; do
        probe=${probe//$'\x01'/|}
        bash -c "$probe" >/dev/null 2>&1 </dev/null || echo "${package// /}|${skipped# }"
    done
}

apt() {
    timeout 400 "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Acquire::http::Timeout=20 \
        -o Acquire::Retries=2 -o DPkg::Lock::Timeout=120 "$@" </dev/null >/dev/null 2>&1
}

lacking=$(missing "$1")
[ -n "$lacking" ] || exit 0
mapfile -t packages < <(cut -d'|' -f1 <<<"$lacking")

root=()
[ "$(id -u)" = 0 ] || root=(sudo -n)
if ! command -v apt-get >/dev/null; then
    echo "packages: no apt-get here"
elif [ "$(id -u)" != 0 ] && ! sudo -n true 2>/dev/null; then
    echo "packages: neither root nor sudo without a password"
else
    echo "packages: installing ${packages[*]}"
    apt update
    # One package that cannot be had must not keep the others out.
    apt install --no-install-recommends "${packages[@]}" ||
        for package in "${packages[@]}"; do apt install --no-install-recommends "$package"; done
    lacking=$(missing "$1")
fi
while IFS='|' read -r package skipped; do
    [ -z "$package" ] || echo "packages: $package is missing, so this is skipped: $skipped"
done <<<"$lacking"
exit 0
