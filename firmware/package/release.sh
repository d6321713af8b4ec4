#!/usr/bin/env bash
# Usage: VERSION=x URL=https://.. firmware/package/release.sh [PART...]      `make release` calls it without a PART: all
# Collects in $B/release what is published, and uploads nothing. The parts:
#   dist        the tarball, the libraries for Arduino, PlatformIO and ESP-IDF, and that of the small profile
#   deb         the Debian packages
#   docs, page  the site as a zip file; the simulator as one HTML file
#   firmware    the demos as a UF2 file for each board whose boot loader takes one
# With CHANGES.md, which is this version's part of firmware/README.md, and SHA256SUMS. What is packed is git's HEAD, so the tree
# must be clean.
# Environment: B (build directory), URL (the public address that the manifests name).
set -eu
cd "$(dirname "$0")/../.."
B=${B:-build}
: "${VERSION:?}"
fail() { echo "make release: $1" >&2 && exit 1; }
[[ ${URL-} =~ ^https?://[a-z0-9.-]+\.[a-z]+ ]] || fail "URL='${URL-}': the public address of the project, https://.."
[ -z "$(git status --porcelain 2>&1)" ] || fail 'the tree has changes that git does not have'
changes=$(awk -v version="$VERSION" '/^### / { inside = $2 == version || $2 == version "," } inside && !/^### /' firmware/README.md | sed '/./,$!d')
[ -n "$changes" ] || fail "firmware/README.md has no changes of $VERSION"
out=$B/release
rm -rf "$out" && mkdir -p "$out"
make() { command make --no-print-directory -s B="$B" URL="$URL" "$@" >&2; }

[ $# -gt 0 ] || set -- dist deb docs page firmware
for part; do
    case $part in
    dist) make dist PROFILE=small && cp "$B"/dist/* "$out" && make dist && cp "$B"/dist/* "$out" ;;
    deb) make deb && cp "$B"/deb/*.deb "$out" ;;
    docs) make docs && (cd "$B/docs" && zip -qr -X - html) >"$out/pinhole-$VERSION-docs.zip" ;;
    page) make page && cp "$B/page/index.html" "$out/pinhole-$VERSION.html" ;;
    firmware)
        for board in boards/*/board.mk; do
            board=$(basename "${board%/board.mk}")
            make firmware BOARD="$board"
            [ ! -e "$B/firmware/$board-demos.uf2" ] || cp "$B/firmware/$board-demos.uf2" "$out/pinhole-$VERSION-$board.uf2"
        done
        ;;
    esac
done
printf '# Pinhole %s\n\n%s\n' "$VERSION" "$changes" >"$out/CHANGES.md"
(cd "$out" && sha256sum -- *) >"$B/SHA256SUMS"
mv "$B/SHA256SUMS" "$out"
cat "$out/SHA256SUMS"
