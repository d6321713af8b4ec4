#!/usr/bin/env bash
# Usage: VERSION=x firmware/package/deb.sh      `make deb` calls it
# Builds the Debian packages pinhole and libpinhole-dev of git's HEAD, and runs lintian on them: build/deb/.
# Environment: B (build directory); DEBFULLNAME, DEBEMAIL: the packages' maintainer.
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
: "${VERSION:?}"
for tool in git:git dpkg-buildpackage:dpkg-dev dh:debhelper lintian:lintian; do
    command -v "${tool%%:*}" >/dev/null || { echo "make deb: no ${tool%%:*}: apt-get install ${tool#*:}" >&2 && exit 1; }
done
git rev-parse --verify -q HEAD >/dev/null || { echo "make deb: this is no git repository; it packs what git has" >&2 && exit 1; }
deb=$(realpath -m "$B/deb")
rm -rf "$deb" && mkdir -p "$deb"
git archive --format=tar.gz --prefix="pinhole-$VERSION/" -o "$deb/pinhole_$VERSION.orig.tar.gz" HEAD
tar -xzf "$deb/pinhole_$VERSION.orig.tar.gz" -C "$deb"
cp -r firmware/package/debian "$deb/pinhole-$VERSION/debian"
# Revision 0pinhole1, as upstreams and derived distributions number theirs: Debian's own package, -1, would replace it, and the
# changelog of a first upload to Debian (-1) would have to close a bug there.
maintainer="${DEBFULLNAME:-The Pinhole authors} <${DEBEMAIL:-packages@pinhole.invalid}>"
sed -i "s|@MAINTAINER@|$maintainer|" "$deb/pinhole-$VERSION/debian/control"
cat >"$deb/pinhole-$VERSION/debian/changelog" <<END
pinhole ($VERSION-0pinhole1) unstable; urgency=medium

  * Version $VERSION; what changed stands in firmware/README.md (Versions).

 -- $maintainer  $(git log -1 --format=%cD)
END
cd "$deb/pinhole-$VERSION"
# The package builds in a folder of its own, with nothing of the make that called.
if ! env -u B -u VERSION -u MAKEFLAGS -u MFLAGS -u MAKELEVEL dpkg-buildpackage -us -uc >"$deb/build.log" 2>&1; then
    tail -n 30 "$deb/build.log" >&2
    echo "make deb: the build failed: $B/deb/build.log has all of it" >&2
    exit 1
fi
cd "$deb"
lintian --profile debian --fail-on error,warning ./*.changes
find . -name '*.deb' -printf "$B/deb/%f\n" | sort
