# shellcheck shell=bash
# The tools of the proofs: `. tests/proof/tools.sh`. Gappa is Debian 12's. Debian 12 has no CBMC: it is unpacked from
# Debian 13 into $B/proof/root, with the libraries that it needs, and runs from there; nothing is installed.
#   proof_tools           makes that folder when it is not there; returns 1, with the reason in $proof_why, without a tool
#   tool NAME ARGUMENT... runs cbmc, goto-cc or goto-instrument
# Environment: B (build directory).
B=${B:-build}
. tests/debian13/root.sh
proof_root=$(realpath -m "$B/proof/root")

proof_unpack() {
    local new
    new=$(mktemp -d "$B/proof/new.XXXXXX") && mkdir "$new/sources" && debian_sources trixie "$new/sources" &&
        timeout 300 mmdebstrap --variant=extract --include=cbmc --aptopt='APT::Install-Recommends "false"' \
            --aptopt='Acquire::http::Timeout "20"' --aptopt='Acquire::Retries "2"' \
            trixie "$new/root" "$new"/sources/* >"$B/proof/mmdebstrap.log" 2>&1 </dev/null &&
        rm -rf "$proof_root" && mv -T "$new/root" "$proof_root" || proof_why="Debian 13's cbmc cannot be had: $(
            grep -m 1 '^E:' "$B/proof/mmdebstrap.log" || tail -n 1 "$B/proof/mmdebstrap.log")"
    rm -rf "$new"
}

proof_tools() {
    command -v gappa >/dev/null || { proof_why='no gappa: apt-get install gappa' && return 1; }
    proof_why=
    mkdir -p "$B/proof"
    exec 8>"$B/proof/lock" && flock 8
    [ -x "$proof_root/usr/bin/cbmc" ] || proof_why=$(debian_cannot)
    [ -x "$proof_root/usr/bin/cbmc" ] || [ -n "$proof_why" ] || proof_unpack
    exec 8>&-
    [ -z "$proof_why" ]
}

tool() {
    local usr=$proof_root/usr
    "$usr/lib64/ld-linux-x86-64.so.2" --library-path "$usr/lib:$usr/lib/$(uname -m)-linux-gnu" "$usr/bin/$1" "${@:2}"
}
