#!/usr/bin/env bash
# What `make dist` and `make deb` pack passes where it is unpacked: the tarball `make check`, the packages lintian; and from
# the packages' files alone the library is found and draws, and the programs run.
# shellcheck disable=SC2317,SC2016,SC2046 # functions are called by check; pkg-config gives several words
set -u
cd "$(dirname "$0")/../.." || exit 1
. tests/tools/tap.sh
unset MAKEFLAGS
B=$(realpath -m "${B:-build}")
dir=$(mktemp -d) || exit 1
trap 'rm -rf "$dir"' EXIT
for tool in git:git zip:zip; do
    command -v "${tool%:*}" >/dev/null || { echo "no ${tool%:*}: apt-get install ${tool#*:}" && exit 77; }
done

tarball_passes_check() {
    make -s dist B="$B/package" && tar -xzf "$B"/package/dist/pinhole-*.tar.gz -C "$dir" && cd "$dir"/pinhole-* && make check
}

packages_are_clean() { make -s deb B="$B/package"; }

packages_hold_what_is_needed() {
    local package
    mkdir "$dir/unpacked" && for package in "$B"/package/deb/{pinhole,libpinhole-dev}_*.deb; do dpkg-deb -x "$package" "$dir/unpacked" || return 1; done
    "$dir/unpacked/usr/bin/pinhole-sim" --demo cube --crc | grep '^frame 0 crc32' &&
        [ "$(dpkg-deb -f "$B"/package/deb/pinhole_*.deb Version)" = "$("$dir/unpacked/usr/bin/pinhole-sim" --version | cut -d' ' -f2)-0pinhole1" ] &&
        zgrep -q pinhole-sim "$dir/unpacked/usr/share/man/man1/pinhole-sim.1.gz"
}

packages_draw() {
    local lib
    lib=$(dirname "$(find "$dir/unpacked/usr/lib" -name pinhole.pc)") && sed -n '/^```c$/,/^```$/p' README.md | sed '1d;/^```$/,$d' >"$dir/hello.c" &&
        cc "$dir/hello.c" $(PKG_CONFIG_PATH=$lib PKG_CONFIG_SYSROOT_DIR=$dir/unpacked pkg-config --cflags --libs pinhole) -o "$dir/hello" &&
        "$dir/hello" | diff - <(sed -n '/^```text$/,/^```$/p' README.md | sed '1d;/^```$/,$d')
}

check "the_tarball_passes_make_check_where_it_is_unpacked" tarball_passes_check
if command -v dh >/dev/null && command -v lintian >/dev/null && command -v dpkg-buildpackage >/dev/null; then
    check "the_packages_pass_lintian" packages_are_clean
    check "the_packages_hold_what_is_needed" packages_hold_what_is_needed
    check "the_packages_draw" packages_draw
else
    skip "Debian packages" "no debhelper, lintian or dpkg-dev"
fi
tap_end
